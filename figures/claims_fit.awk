# Claims on the fits of Table 1 and Figure 9, and on the numbers behind Figure 11; see claims.awk. The paper's numbers are in
# table1.csv: its measurements are not at hand, and the synthetic ones are to show the same order and the same shifts.
quantity == "table1" {
    paper_specular[$column["model"]] = $column["rs"]
    paper_alpha[$column["model"]] = $column["alpha"]
    paper_residual[$column["model"]] = $column["residual"]
}

quantity == "fit" {
    alpha[what] = $column["alpha"]
    alpha_error[what] = $column["alpha_error"]
    specular[what] = $column["rs"]
    specular_error[what] = $column["rs_error"]
    residual[what] = $column["residual"]
    if ($column["rs_at_bound"])
        bound[what] = ", at its bound, rd = " $column["rd"]
}

# Up to 75 degrees.
quantity == "fit75" {
    specular75[what] = $column["rs"]
    residual75[what] = $column["residual"]
    if ($column["rs_at_bound"])
        bound75[what] = ", at its bound, rd = " $column["rd"]
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

function paper(found) { return " (paper: " found ")" }

# The share of the second model's error in the first's.
function paper_ratio(model, other) {
    return paper(paper_residual[model] "/" paper_residual[other] sprintf(" = %.1f", ratio(paper_residual[model], paper_residual[other])))
}

# The value in the mirror direction, (12): rd/pi + rs/(4 pi alpha^2), the total reflectance being 0.175.
function paper_mirror(model) {
    return paper_alpha[model] == "" ? "" : \
        (0.175 - paper_specular[model]) / pi + paper_specular[model] / (4 * pi * paper_alpha[model] ^ 2)
}

function check_fit(    new_specular, new_alpha) {
    new_specular = paper_specular["gmd"]
    new_alpha = paper_alpha["gmd"]
    near(specular["gmd"], new_specular, 4 * specular_error["gmd"], \
         "Table 1: specular reflectance of the new model" paper(new_specular))
    near(alpha["gmd"], new_alpha, 4 * alpha_error["gmd"], "Table 1: roughness of the new model" paper(new_alpha))
    near(residual["gmd"], paper_residual["gmd"], 0.2, "Table 1: error of the new model (20)" paper(paper_residual["gmd"]))
    above(ratio(residual["ward-duer"], residual["gmd"]), 2, \
          "Table 1: error of Ward-Duer in those of the new model" paper_ratio("ward-duer", "gmd"))
    above(ratio(residual["ward"], residual["ward-duer"]), 2, \
          "Table 1: error of Ward in those of Ward-Duer" paper_ratio("ward", "ward-duer"))
    between(specular["ward-duer"], 0.4 * new_specular, 0.8 * new_specular, \
            "Table 1: specular reflectance of Ward-Duer, lower than the new model's" paper(paper_specular["ward-duer"]))
    between(alpha["ward-duer"], 0.6 * new_alpha, 0.9 * new_alpha, \
            "Table 1: roughness of Ward-Duer, lower" paper(paper_alpha["ward-duer"]))
    above(specular["ward"], 1.5 * new_specular, \
          "Table 1: specular reflectance of Ward, higher" bound["ward"] paper(paper_specular["ward"]))
    between(alpha["ward"], 0.6 * new_alpha, new_alpha, "Table 1: roughness of Ward, lower" paper(paper_alpha["ward"]))
    near(ratio(residual75["ward-duer"], residual75["gmd"]), 1, 0.05, \
         "Table 1, data up to 75 deg alone: error of Ward-Duer in those of the new model")
    above(ratio(residual75["ward"], residual75["ward-duer"]), 2, \
          "Table 1, data up to 75 deg alone: error of Ward in those of Ward-Duer")
    between(specular75["ward-duer"], 0.9 * new_specular, 1.1 * new_specular, \
            "Table 1, data up to 75 deg alone: specular reflectance of Ward-Duer, that of the new model")
    between(specular75["ward"], 1.5 * new_specular, 0.175, \
            "Table 1, data up to 75 deg alone: specular reflectance of Ward, higher" bound75["ward"])

    near(ratio_in_mirror, ratio(paper_mirror("gmd"), paper_mirror("ward-duer")), 1e-9, \
         "beside Figure 11: new model over Ward-Duer, the paper's parameters, in the mirror direction (12)")
    between(largest_ratio, 4, 6.5, "beside Figure 11: ... at most, for light and viewer near the normal (paper: up to 5)")
    between(largest_ratio_at, 2, 3.5, "beside Figure 11: ... with the half vector so many degrees off")
}
