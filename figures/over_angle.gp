# Curves over the angle: all angles on the left, the last ten degrees on a logarithmic scale on the right, since near the horizon
# everything happens. Another script says before what is drawn.
set multiplot
set yrange [0:highest]
set tmargin at screen 0.87
set bmargin at screen 0.23

set lmargin at screen 0.08
set rmargin at screen 0.53
set xrange [0:90]
set xtics 15 format "%g°"
set xlabel "angle from the normal, θ"
set ylabel quantity
plot for [k = 1:curves] file(k) using "theta_v":field(k) with lines linetype line(k)

set lmargin at screen 0.585
set rmargin at screen 0.965
set logscale x
set xrange [10:0.001]
set xtics ("10°" 10, "1°" 1, "0.1°" 0.1, "0.01°" 0.01, "0.001°" 0.001)
set xlabel "height above the surface, 90° − θ"
unset ylabel
set ytics format ""
plot for [k = 1:curves] file(k) using (90 - column("theta_v")):field(k) with lines linetype line(k)
