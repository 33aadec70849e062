# Our own: how far the weights of samples scatter. The caller sets `roughness` and `data`.
load here."/style.gp"
heading = sprintf("Standard deviation of the sampling weight, new model, α = %s", roughness)
quantity = "standard deviation"
highest = 1.2
curves = 2
file(k) = sprintf("%s/weight-%s-%s.csv", data, roughness, word("sample pair", k))
field(k) = "deviation"
name(k) = k == 1 ? "Ward’s sampling" : "paired sampling"
line(k) = k == 1 ? 2 : 4
caption = ""
load here."/over_angle.gp"
load here."/legend.gp"
