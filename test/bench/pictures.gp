# Time versus error, a panel a scene. The caller sets `data`, a folder with SCENE.csv, `scenes`, `out` and `here`, the folder of
# the figures' style. A block of a file is a curve, its name on the first line.
load here."/style.gp"
set logscale xy
set format x "10^{%L}"
set format y "%g%%"
set xlabel "seconds"
set ylabel "error"
set grid xtics ytics
set key top right samplen 2 spacing 1.1
colours = "#0072B2 #009E73 #D55E00 #E69F00"
do for [k = 1:4] { set linetype k linecolor rgb word(colours, k) linewidth 2 dashtype solid pointtype 2 * k + 3 pointsize 0.7 }
columns = words(scenes) > 1 ? 2 : 1
rows = (words(scenes) + columns - 1) / columns
do for [format = 1:2] {
    if (format == 1) { set terminal svg size 480 * columns, 330 * rows font "sans,12" background "white"; set output out.".svg" }
    if (format == 2) { set terminal pngcairo size 480 * columns, 330 * rows font "sans,10"; set output out.".png" }
    set multiplot layout rows, columns
    do for [s = 1:words(scenes)] {
        file = data."/".word(scenes, s).".csv"
        set title word(scenes, s)
        stats file using 1:2 nooutput
        plot for [k = 0:STATS_blocks - 1] file index k using 1:(100 * $2) with linespoints title columnheader(1)
    }
    unset multiplot
    set output
}
