# Figures 3 to 5: the models in the plane of incidence, as polar plots. The caller sets `number`, `roughness` and `data`.
load here."/style.gp"
incidences = "0 25 50 75"
table(model) = sprintf("%s/plane-%s-%s.csv", data, roughness, model)
heading = sprintf("Figure %d. BRDF in the plane of incidence, α = %s, ρ_s = 1", number, roughness)
curves = 4
name(k) = word(titles, k)
line(k) = k
caption = "Light from 0°: the curves nearly coincide. Viewers up to 89.9°; " \
    ."curves are cut off beyond the outermost circle."
set multiplot
unset border
unset grid
unset tics

set angles degrees
set margins 0, 0, 0, 0
set size 0.46, 0.37
set size ratio -1
do for [i = 1:4] {
    theta = real(word(incidences, i))
    set origin 0.03 + 0.48 * ((i - 1) % 2), i <= 2 ? 0.535 : 0.125
    # Circles at multiples of 1, 2 or 5 times a power of 10, the outermost just beyond the new model's peak.
    set autoscale
    stats table("gmd") using (column("theta_l") == theta ? column("f") : NaN) nooutput
    decade = 10.0 ** floor(log10(STATS_max / 2))
    step = decade * (STATS_max < 4 * decade ? 1 : STATS_max < 8 * decade ? 2 : 5)
    rings = ceil(1.05 * STATS_max / step)
    rim = rings * step
    set for [k = 1:6] label k sprintf(k <= rings ? "%g" : "", k * step) at -k / real(rings), -0.06 center font ",10"
    set arrow 9 from -1, 0 to 1, 0 nohead linecolor rgb "#404040" linewidth 0.8 back
    do for [k = -2:2] {
        set arrow 12 + k from 0, 0 to sin(30 * k), cos(30 * k) nohead linecolor rgb faint linewidth 0.8 back
        set label 12 + k sprintf("%s%d°", k < 0 ? "−" : "", 30 * abs(k)) \
            at (1.06 + 0.03 * abs(k)) * sin(30 * k), 1.07 * cos(30 * k) center font ",10"
    }
    set arrow 20 from -sin(theta), cos(theta) to 0, 0 \
        head size 0.05, 20 filled linecolor rgb "#404040" linewidth 1.5 front
    set label 20 sprintf("light from %s°", word(incidences, i)) at -1.0, 1.1 left
    set label 21 "f in 1/sr" at 1.0, -0.06 right font ",10"
    set xrange [-1.12:1.12]
    set yrange [-0.02:1.2]
    radius(f) = f > rim ? NaN : f / rim
    x(r) = column("theta_l") == theta ? r * sin(column("theta_v")) : NaN
    y(r) = r * cos(column("theta_v"))
    # Circles first. Ward–Dür comes last: it hides behind the new model otherwise.
    plot for [k = 1:rings] table("gmd") every 7 using (x(k / real(rings))):(y(k / real(rings))) \
            with lines linecolor rgb (k < rings ? faint : "#404040") linewidth 0.8 dashtype solid, \
        for [m in "1 3 4 2"] table(word(models, int(m))) using (x(radius(column("f")))):(y(radius(column("f")))) \
            with lines linetype line(int(m))
}
load here."/legend.gp"
