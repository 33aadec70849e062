# Figures 2 and 8: the luminance of the grazing scene, found in two ways, with the same contour lines. The caller sets `number`
# and `data`, and for each panel the table, `file1` and `file2`, and its title, `title1` and `title2`.
load here."/style.gp"
heading = sprintf("Figure %d. The grazing surface seen at 1°, and the luminaire: lines of equal luminance", number)
levels = "10 30 100 300 1000"
colours = "#440154 #3B528B #21918C #35B779 #E69F00"
curves = words(levels)
name(k) = word(levels, k).(k == curves ? " cd/m²" : "")
line(k) = 10 + k
do for [k = 1:curves] { set linetype 10 + k linecolor rgb word(colours, k) linewidth 2 }
caption = number == 2 ? "Red: the reflection is brighter than the luminaire itself." : ""
file(i) = sprintf("%s/grazing-%s.csv", data, i == 1 ? file1 : file2)
decades(value) = log10(value > 1 ? value : 1)
# A reflection is shown as such however bright it is.
stats file(1) using (strcol("surface") eq "luminaire" ? column("value") : NaN) name "luminaire" nooutput
brightest = decades(luminaire_max)
of_luminaire = brightest + 1
too_bright = brightest + 0.5
shade(value, surface) = surface eq "luminaire" ? of_luminaire : decades(value) > brightest ? too_bright : decades(value)

# Lines are of the surface alone. Through single values they would show each one's noise: 3 x 3 are averaged, in both panels.
on_surface(value) = strcol("surface") eq "surface" ? decades(value) : NaN
set contour base
unset surface
do for [k = 1:curves] {
    set cntrparam levels discrete decades(word(levels, k) + 0)
    do for [i = 1:2] {
        eval sprintf("set table $lines%d_%d", i, k)
        splot file(i) using "x":"y":(on_surface(column("smooth")))
        unset table
    }
}
unset contour
set surface

set multiplot
unset grid
unset colorbox
set palette maxcolors 0 defined (0 "#FFFFFF", brightest + 0.1 "#BEBEBE", brightest + 0.1 "#C1121F", \
    brightest + 0.9 "#C1121F", brightest + 0.9 "#FFE9A0", of_luminaire "#FFE9A0")
set cbrange [0:of_luminaire]
set xrange [-4:4]
set yrange [-4.2:2.4]
set tmargin at screen 0.83
set bmargin at screen 0.19
do for [i = 1:2] {
    set lmargin at screen (i == 1 ? 0.06 : 0.54)
    set rmargin at screen (i == 1 ? 0.50 : 0.98)
    set label 1 (i == 1 ? title1 : title2) at graph 0.5, 1.05 center font ",11.5"
    set border
    set xtics 1 format "%g°" out nomirror scale 0.5
    set ytics 1 format "%g°" out nomirror scale 0.5
    set label 2 "luminaire" at 0, 1.42 center font ",10" front
    set datafile separator comma
    set datafile columnheaders
    plot file(i) using "x":"y":(shade(column("value"), strcol("surface"))) with image
    set datafile separator whitespace
    unset datafile columnheaders
    unset label
    unset border
    unset xtics
    unset ytics
    # A data block's name cannot be put together but so.
    do for [k = 1:curves] { eval sprintf("plot $lines%d_%d using 1:2 with lines linetype line(%d)", i, k, k) }
}
load here."/legend.gp"
