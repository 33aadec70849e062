# Figure 10: the linoleum sphere and one of its highlights, with the fitted Ward–Dür and the fitted new model. The caller sets
# `data`.
load here."/style.gp"
heading = "Figure 10. A sphere of red linoleum, and its left highlight"
curves = 0
name(k) = ""
line(k) = 0
caption = "Parameters as in Table 1. The total reflectance is the same, so the diffuse colours differ, being total − specular: Ward–Dür’s is paler."
set multiplot
unset grid
unset tics
unset border
set datafile separator whitespace
set size ratio -1
model(i) = word("ward-duer gmd", i)
title(i) = i == 1 ? "Ward–Dür" : "new model"
picture(part, i) = sprintf("%s/linoleum-%s-%s.png", data, part, model(i))
set tmargin at screen 0.84
set bmargin at screen 0.085
do for [j = 1:4] {
    i = 2 - j % 2
    part = j <= 2 ? "whole" : "highlight"
    set lmargin at screen 0.01 + 0.2475 * (j - 1)
    set rmargin at screen 0.2475 * j
    set label 1 title(i).(j <= 2 ? "" : ", highlight") at graph 0.5, 1.06 center font ",12"
    set autoscale fix
    plot picture(part, i) binary filetype=png with rgbimage
}
load here."/legend.gp"
