# Claims on the reflectance model, Figures 3 to 7 and beside them; see claims.awk.
quantity == "plane" {
    key = subject SUBSEP what SUBSEP $column["theta_l"]
    view = $column["theta_v"]
    value = $column["f"]
    f[key, sprintf("%.1f", view)] = value
    if (value > peak[key]) {
        peak[key] = value
        peak_at[key] = view
    }
    if (view > last_view[key])
        last_view[key] = view
    value *= cosine(view)
    if (value > cosine_peak[key]) {
        cosine_peak[key] = value
        cosine_peak_at[key] = view
    }
}

quantity == "albedo" {
    view = sprintf("%.5f", $column["theta_v"])
    albedo[subject, what, view] = $column["a"]
    if ($column["a"] > largest[subject, what])
        largest[subject, what] = $column["a"]
    if (what == "gmd")
        accepted[subject, view] = $column["A"]
}

quantity == "anisotropic" {
    view = sprintf("%.5f", $column["theta_v"])
    azimuth = $column["phi_v"]
    lobe_albedo[azimuth, view] = $column["a"]
    lobe_accepted[azimuth, view] = $column["A"]
    if ($column["a"] > largest_lobe_albedo[azimuth])
        largest_lobe_albedo[azimuth] = $column["a"]
}

quantity == "weight" {
    view = sprintf("%.5f", $column["theta_v"])
    mean[what, view] = $column["mean"]
    deviation[what, view] = $column["deviation"]
    rejected[what, view] = $column["rejected"]
    if (!(what in most_rejected) || $column["rejected"] > most_rejected[what])
        most_rejected[what] = $column["rejected"]
    if ($column["largest"] > largest_weight[what])
        largest_weight[what] = $column["largest"]
}

# How far the new model and Ward-Duer are apart at most, viewers within 60 degrees; nothing where a number is missing.
function apart(roughness, light,    view, new, duer, most) {
    for (view = -600; view <= 600; view++) {
        new = f[roughness, "gmd", light, sprintf("%.1f", view / 10)]
        duer = f[roughness, "ward-duer", light, sprintf("%.1f", view / 10)]
        if (new == "" || duer == "")
            return ""
        most = greater(most, distance(new, duer))
    }
    return most
}

function check_plane(figure, roughness,    head, count, light, i, view, mirror, new, duer, most) {
    count = split("0 25 50 75", light, " ")
    for (i = 1; i <= count; i++) {
        head = sprintf("Figure %d, alpha %s, light from %d deg: ", figure, roughness, light[i])
        view = sprintf("%.1f", light[i])
        mirror = 1 / (4 * pi * roughness ^ 2 * cosine(light[i]) ^ 2)
        new = f[roughness, "gmd", light[i], view]
        duer = f[roughness, "ward-duer", light[i], view]
        near(new, mirror, 1e-12 * mirror, head "f of the new model in the mirror direction (12)")
        near(duer, mirror, 1e-12 * mirror, head "f of Ward-Duer in the mirror direction (12)")
        near(cosine_peak_at[roughness, "gmd", light[i]], light[i], 0.05, head "f cos of the new model peaks there (23)")
        # The widest lobe under the lowest light has no peak above the horizon: f rises up to the last viewer.
        if (roughness == "0.25" && light[i] == 75)
            near(peak_at[roughness, "gmd", light[i]], 89.9, 0.05, head "f of the new model is largest at the horizon (22)")
        else if (light[i] > 0)
            between(peak_at[roughness, "gmd", light[i]], light[i], last_view[roughness, "gmd", light[i]], \
                    head "f of the new model peaks below, above the horizon (22)")
        if (light[i] <= 60) {
            most = apart(roughness, light[i])
            at_most(most == "" ? "" : most / mirror, roughness ^ 2 / 2, \
                    head "new model and Ward-Duer apart, viewers within 60 deg, as a share of the peak")
        }
    }
    new = f[roughness, "gmd", 75, "89.9"]
    duer = f[roughness, "ward-duer", 75, "89.9"]
    above(new > 0 ? duer / new : "", 10, head "factor between new model and Ward-Duer, viewer at 89.9 deg")
}

function check_albedo(figure, roughness, reference,    head, count, angle, expected, i) {
    head = sprintf("%s, alpha %s: ", figure, roughness)
    count = split("0 35 60 75 85 89", angle, " ")
    split(reference, expected, " ")
    for (i = 1; i <= count; i++)
        near(albedo[roughness, "gmd", sprintf("%.5f", angle[i])], expected[i], 5e-7, \
             head "albedo of the new model at " angle[i] " deg")
    at_most(largest[roughness, "gmd"], 1, head "albedo of the new model at any angle")
    near(albedo[roughness, "gmd", "89.99999"], 1, 1e-4, head "albedo of the new model at the horizon, 89.99999 deg")
}

function check_other_albedos(figure, roughness,    head) {
    head = sprintf("%s, alpha %s: ", figure, roughness)
    above(largest[roughness, "ward"], 1, head "albedo of Ward's model near the horizon")
    above(largest[roughness, "ward-duer"], 1, head "albedo of Ward-Duer near the horizon")
    near(accepted[roughness, "89.99999"], 0.5, 1e-4, head "share of accepted samples at the horizon (32)")
}

function check_anisotropic(    head, count, azimuth, i) {
    near(lobe_albedo[0, "0.00000"], 1 - (0.05 ^ 2 + 0.2 ^ 2) / 2, 5e-7, \
         "beside Figure 7, alpha 0.05 and 0.2: albedo of the new model at 0 deg")
    count = split("0 15 30 45 60 75 90", azimuth, " ")
    for (i = 1; i <= count; i++) {
        head = "beside Figure 7, alpha 0.05 and 0.2, azimuth " azimuth[i] " deg: "
        at_most(largest_lobe_albedo[azimuth[i]], 1, head "albedo of the new model at any angle")
        near(lobe_albedo[azimuth[i], "89.99999"], 1, 1e-4, head "albedo of the new model at the horizon, 89.99999 deg")
        near(lobe_accepted[azimuth[i], "89.99999"], 0.5, 1e-4, head "share of accepted samples at the horizon (32)")
    }
}

# Expected numbers hold within half a unit of their last digit.
function check_weights(what, title, bound, reference,    head, count, angle, expected, view, i) {
    head = "weight, alpha 0.1, " title ": "
    count = split("60 89 89.9", angle, " ")
    split(reference, expected, " ")
    for (i = 1; i <= count; i++) {
        view = sprintf("%.5f", angle[i])
        near(deviation[what, view], expected[i], 5 / 10 ^ (length(expected[i]) - 1), \
             head "standard deviation at " angle[i] " deg")
        near(mean[what, view], albedo["0.1", "gmd", view], 5e-4, head "mean, the albedo, at " angle[i] " deg (16)")
        if (what == "pair")
            at_most(rejected[what, view], 0, head "share of samples rejected at " angle[i] " deg")
        else
            near(rejected[what, view], complement(accepted["0.1", view]), 5e-4, \
                 head "share of samples rejected at " angle[i] " deg")
    }
    at_most(largest_weight[what], bound, head "maximum at any angle (15)")
}

function check_model() {
    check_plane(3, "0.05")
    check_plane(4, "0.1")
    check_plane(5, "0.25")
    check_albedo("beside Figure 6", "0.05", "0.997500 0.996883 0.993688 0.979010 0.872044 0.824792")
    check_albedo("Figure 6", "0.1", "0.990000 0.987481 0.973957 0.917524 0.812771 0.861043")
    check_other_albedos("Figure 6", "0.1")
    check_albedo("Figure 7", "0.2", "0.960000 0.949092 0.897580 0.821169 0.805507 0.898875")
    check_other_albedos("Figure 7", "0.2")
    check_anisotropic()
    check_weights("sample", "Ward's sampling", 2, "0.135 0.827 0.964")
    check_weights("pair", "paired sampling", 1, "0.0320 0.0754 0.0467")
    at_most(most_rejected["pair"], 0, "weight, alpha 0.1, paired sampling: share of samples rejected at any angle")
}
