# Figure 9: the synthetic linoleum and the fits of all models, a panel an incident angle. The caller sets `data`.
load here."/style.gp"
heading = "Figure 9. Fits to 222 pairs: synthetic linoleum"
curves = 5
name(k) = k == 5 ? "● data" : word(titles, k)
line(k) = k == 5 ? 6 : k
caption = "The paper’s data were not published: these are the new model’s values with noise. Ward’s and Ward–Neumann’s fits end at a bound, with no diffuse part."
# The data have a dot in their name in place of a line.
set linetype 6 linecolor rgb "#FFFFFF"
set multiplot
incidences = "30 60 70 75 80 85"
tops = "20 35 50 90 200 800"
steps = "5 10 10 20 50 200"
do for [i = 1:6] {
    theta = word(incidences, i) + 0
    column_at = (i - 1) % 3
    set lmargin at screen 0.06 + 0.32 * column_at
    set rmargin at screen 0.34 + 0.32 * column_at
    set tmargin at screen (i <= 3 ? 0.855 : 0.48)
    set bmargin at screen (i <= 3 ? 0.58 : 0.205)
    set xrange [theta - 20 : theta + 20 < 90 ? theta + 20 : 90]
    set yrange [0 : word(tops, i) + 0]
    set ytics word(steps, i) + 0
    set xtics 10 format "%g°"
    set label 1 sprintf("light from %d°", theta) at graph 0.03, 0.9 left font ",10.5"
    if (i > 3) { set xlabel "viewing angle" offset 0, 0.4 } else { unset xlabel }
    if (column_at == 0) { set ylabel "f in 1/sr" } else { unset ylabel }
    at_light(x) = column("theta_l") == theta ? x : NaN
    # Ward–Dür comes last of the lines: it hides behind the new model otherwise.
    plot for [m in "1 3 4 2"] data."/curve-linoleum-".word(models, int(m)).".csv" using (at_light(column("theta_v"))):"f" \
            with lines linetype line(int(m)), \
        here."/linoleum.csv" using (at_light(column("theta_v"))):"f" with points pointtype 7 pointsize 0.5 linecolor rgb "#000000"
}
load here."/legend.gp"
