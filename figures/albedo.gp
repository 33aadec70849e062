# Figures 6 and 7: directional albedos at one roughness. The caller sets `number`, `roughness` and `data`.
load here."/style.gp"
heading = sprintf("Figure %d. Directional albedo, α = %s, ρ_s = 1", number, roughness)
quantity = "albedo; share accepted"
highest = 1.6
curves = 5
file(k) = sprintf("%s/albedo-%s-%s.csv", data, roughness, word(models, k == 5 ? 4 : k))
field(k) = k == 5 ? "A" : "a"
name(k) = k == 5 ? "samples accepted" : word(titles, k)
line(k) = k
caption = ""
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead linecolor rgb "#808080" back
load here."/over_angle.gp"
load here."/legend.gp"
