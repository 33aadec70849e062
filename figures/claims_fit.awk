# Claims on the fits of Table 1 and Figure 9, and on the numbers behind Figure 11; see claims.awk. The paper's numbers stand in the
# claims: its measurements are not at hand, and the synthetic ones are to show the same order and the same shifts.
quantity == "fit" {
    alpha[what] = $column["alpha"]
    alpha_error[what] = $column["alpha_error"]
    specular[what] = $column["rs"]
    specular_error[what] = $column["rs_error"]
    residual[what] = $column["residual"]
}

quantity == "half" {
    half_value[what, $column["theta_v"]] = $column["f"]
    if (what == "ward-duer")
        half_ratio($column["theta_v"] / 2, ratio(half_value["gmd", $column["theta_v"]], $column["f"]))
}

function half_ratio(angle, brighter) {
    if (angle == 0)
        ratio_in_mirror = brighter
    if (brighter > largest_ratio) {
        largest_ratio = brighter
        largest_ratio_at = angle
    }
}

function check_fit(    new_specular, new_alpha) {
    new_specular = 0.04982
    new_alpha = 0.03172
    near(specular["gmd"], new_specular, 4 * specular_error["gmd"], \
         "Table 1: specular reflectance of the new model (paper: 0.04982)")
    near(alpha["gmd"], new_alpha, 4 * alpha_error["gmd"], "Table 1: roughness of the new model (paper: 0.03172)")
    near(residual["gmd"], 0.9241, 0.2, "Table 1: error of the new model (20) (paper: 0.9241)")
    above(ratio(residual["ward-duer"], residual["gmd"]), 2, \
          "Table 1: error of Ward-Duer in those of the new model (paper: 2.8846/0.9241 = 3.1)")
    above(ratio(residual["ward"], residual["ward-duer"]), 2, \
          "Table 1: error of Ward in those of Ward-Duer (paper: 6.8269/2.8846 = 2.4)")
    between(specular["ward-duer"], 0.4 * new_specular, 0.8 * new_specular, \
            "Table 1: specular reflectance of Ward-Duer, lower than the new model's (paper: 0.02605)")
    between(alpha["ward-duer"], 0.6 * new_alpha, 0.9 * new_alpha, "Table 1: roughness of Ward-Duer, lower (paper: 0.02122)")
    above(specular["ward"], 1.5 * new_specular, "Table 1: specular reflectance of Ward, higher (paper: 0.08508)")
    between(alpha["ward"], 0.6 * new_alpha, new_alpha, "Table 1: roughness of Ward, lower (paper: 0.02935)")

    # Both models give rs/(4 pi alpha^2) in the mirror direction, (12).
    near(ratio_in_mirror, \
         (0.12518 / pi + 0.04982 / (4 * pi * 0.03172 ^ 2)) / (0.14895 / pi + 0.02605 / (4 * pi * 0.02122 ^ 2)), 1e-9, \
         "beside Figure 11: new model over Ward-Duer, the paper's parameters, in the mirror direction (12)")
    between(largest_ratio, 4, 6.5, "beside Figure 11: ... at most, for light and viewer near the normal (paper: up to 5)")
    between(largest_ratio_at, 2, 3.5, "beside Figure 11: ... with the half vector so many degrees off")
}
