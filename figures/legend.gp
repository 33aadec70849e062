# The heading above and the legend below what another script has drawn: `heading`, for each of `curves` its name and line, and a
# `caption`, which may be empty. Drawn by hand: gnuplot's own legend makes all columns as wide as the longest name.
reset
unset border
unset tics
unset grid
unset key
set margins 0, 0, 0, 0
set origin 0, 0
set size 1, 0.1
set xrange [0:1]
set yrange [0:1]
set label 1 heading at screen 0.5, 0.955 center font ",14"
set label 2 caption at screen 0.5, 0.025 center font ",10"
height = strlen(caption) ? 0.07 : 0.05
# Of each curve 4 characters of line and 1 blank before its name; 3 blanks between curves.
character = GPVAL_TERM_HCHAR / real(GPVAL_TERM_XSIZE)
left = 0.5 - character * ((sum [k = 1:curves] strlen(name(k)) + 8) - 3) / 2
do for [k = 1:curves] {
    set arrow k from screen left, height to screen left + 4 * character, height nohead linetype line(k)
    set label k + 2 name(k) at screen left + 5 * character, height left
    left = left + character * (strlen(name(k)) + 8)
}
plot NaN notitle
unset multiplot
