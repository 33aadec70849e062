# The heading above and the legend below what another script has drawn: `heading`, and for each of `curves` its name and line.
reset
unset border
unset tics
unset grid
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set label 1 heading at screen 0.5, 0.955 center font ",14"
set key center center horizontal maxcols 5 samplen 3 width 1 reverse Left
plot for [k = 1:curves] NaN with lines linetype line(k) title name(k)
unset multiplot
