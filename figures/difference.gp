# Figure 11: how much brighter the new model's linoleum is than Ward–Dür's, in false colour. The caller sets `data`.
load here."/style.gp"
heading = "Figure 11. Relative difference in luminance, (new − Ward–Dür) / Ward–Dür"
curves = 0
name(k) = ""
line(k) = 0
caption = ""
file(i) = sprintf("%s/linoleum-%s-difference.csv", data, i == 1 ? "whole" : "highlight")
set multiplot
unset grid
set palette defined (-1 "#2166AC", 0 "#FFFFFF", 0.5 "#FEE8A8", 1.5 "#FDAE61", 2.7 "#D73027", 4 "#67001F")
set cbrange [-1:4]
set cbtics ("−1" -1, "0" 0, "+1" 1, "+2" 2, "+3" 3, "+4: ×5" 4) out
set colorbox user origin screen 0.9, 0.13 size screen 0.018, 0.7
set size ratio -1
set tmargin at screen 0.83
set bmargin at screen 0.13
do for [i = 1:2] {
    set lmargin at screen (i == 1 ? 0.05 : 0.485)
    set rmargin at screen (i == 1 ? 0.44 : 0.875)
    if (i == 2) { set xrange [-2.9:-0.9]; set yrange [0.9:2.9] } else { set xrange [-6.5:6.5]; set yrange [-6.5:6.5] }
    step = i == 1 ? 3 : 0.5
    set xtics step format "%g°" out nomirror
    set ytics step format "%g°" out nomirror
    set label 1 (i == 1 ? "the sphere" : "its left highlight") at graph 0.5, 1.05 center font ",12"
    plot file(i) using "x":"y":"difference" with image
    unset colorbox
}
load here."/legend.gp"
