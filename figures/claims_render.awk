# Claims on the renderings, Figures 2, 8, 10 and 11; see claims.awk.
quantity == "grazing" && $column["surface"] == "surface" {
    way = subject "-" what
    # 8 x 8 points.
    block = int(($column["x"] + 4) * 1.5) SUBSEP int(($column["y"] + 5) * 1.5)
    light[way] += $column["value"]
    variance[way] += $column["error"] ^ 2
    light_in[way, block] += $column["value"]
    if ($column["x"] > -1.3 && $column["x"] < 1.3)
        light_before[way, $column["y"]] += $column["value"]
    variance_in[way, block] += $column["error"] ^ 2
    if (!(block in blocks))
        block_count++
    blocks[block]
}

quantity == "grazing" && $column["surface"] == "luminaire" && $column["x"] > -1.3 && $column["x"] < 1.3 {
    light_of_luminaire[subject "-" what, $column["y"]] += $column["value"]
}

quantity == "linoleum" && subject == "highlight" && what == "difference" && NF > 1 {
    points++
    point_x[points] = $column["x"]
    point_y[points] = $column["y"]
    brighter[points] = 1 + $column["difference"]
    if ($column["new"] > peak_luminance) {
        peak_luminance = $column["new"]
        centre = points
    }
}

quantity == "times" {
    rounds++
    time_ratio[rounds] = ratio($column["gmd"], $column["ward-duer"])
}

# Of the blocks that are not nearly dark: the ratio between two ways to find the light, its mean and at most, and how many
# standard errors apart they are, at most and in the root mean square.
function compare_blocks(a, b,    block, count, error, off, squares, factors) {
    mean_factor = largest_factor = most_apart = scatter = ""
    for (block in blocks) {
        if (light_in[b, block] < 0.01 * light[b] / block_count)
            continue
        factors += ratio(light_in[a, block], light_in[b, block])
        largest_factor = greater(largest_factor, ratio(light_in[a, block], light_in[b, block]))
        error = sqrt(variance_in[a, block] + variance_in[b, block])
        off = ratio(distance(light_in[a, block], light_in[b, block]), error)
        most_apart = greater(most_apart, off)
        squares += off ^ 2
        count++
    }
    if (count) {
        mean_factor = factors / count
        scatter = sqrt(squares / count)
    }
}

# The largest sum over a row of points in front of the luminaire, and the same of it.
function brightest_row(sums, way,    key, part, most) {
    for (key in sums) {
        split(key, part, SUBSEP)
        if (part[1] == way)
            most = greater(most, sums[key])
    }
    return most
}
function over_luminaire(way) { return ratio(brightest_row(light_before, way), brightest_row(light_of_luminaire, way)) }

function relative_variance(way) { return ratio(variance[way], light[way] ^ 2) }

function check_grazing(    new, error) {
    compare_blocks("ward-duer-unweighted", "ward-duer-light")
    above(mean_factor, 1.2, \
          "Figure 2: luminance by sampling without weights over evaluation, mean of blocks of 0.67 deg (paper: they differ)")
    above(largest_factor, 1.5, "Figure 2: ... at most")
    above(over_luminaire("ward-duer-light"), 1, \
          "Figure 2: brightest row of the reflection by Ward-Duer over the luminaire itself (it reflects more than it gets)")
    compare_blocks("gmd-brdf", "gmd-light")
    new = ratio(light["gmd-brdf"], light["gmd-light"])
    error = new == "" ? "" : new * sqrt(relative_variance("gmd-brdf") + relative_variance("gmd-light"))
    near(new, 1, 4 * error, "Figure 8: luminance by sampling with weights (16) over evaluation (18), all (paper: they agree)")
    at_most(error, 0.02, "Figure 8: ... and the standard error of that")
    near(mean_factor, 1, 0.05, "Figure 8: ... mean of blocks of 0.67 deg")
    at_most(most_apart, 5, "Figure 8: ... blocks of 0.67 deg apart at most, in standard errors")
    at_most(scatter, 1.3, "Figure 8: ... the root mean square of these")
    at_most(over_luminaire("gmd-light"), 1, \
            "Figure 8: brightest row of the reflection by the new model over the luminaire itself (it reflects no more)")
}

# In eight directions around the highlight's centre: the largest ratio of the new model to Ward-Duer, and where it is.
function check_highlight(    i, x, y, sector, most, at, all, least, nearest, farthest) {
    for (i = 1; i <= points; i++) {
        x = point_x[i] - point_x[centre]
        y = point_y[i] - point_y[centre]
        sector = int((atan2(y, x) / pi + 1) * 4) % 8
        if (brighter[i] > most[sector]) {
            most[sector] = brighter[i]
            at[sector] = sqrt(x * x + y * y)
        }
    }
    for (sector in most) {
        all = greater(all, most[sector])
        farthest = greater(farthest, at[sector])
        least = least == "" || most[sector] < least ? most[sector] : least
        nearest = nearest == "" || at[sector] < nearest ? at[sector] : nearest
    }
    between(all, 4, 6, "Figure 11: new model over Ward-Duer at most, around a highlight (paper: up to 5)")
    between(points ? brighter[centre] : "", 0.7, 1, "Figure 11: ... at the highlight's centre, which is a little darker")
    above(ratio(least, all), 0.8, "Figure 11: ring: least of the largest ratios in eight directions, over the largest")
    above(nearest, 0.15, "Figure 11: ring: where it is nearest to the centre, in degrees of the view")
    at_most(ratio(farthest, nearest), 1.5, "Figure 11: ring: where it is farthest over where it is nearest")
}

# No claim, for it depends on what else the machine does.
function say_times(    i, k, swap) {
    for (i = 1; i <= rounds; i++)
        for (k = i + 1; k <= rounds; k++)
            if (time_ratio[k] < time_ratio[i]) {
                swap = time_ratio[i]
                time_ratio[i] = time_ratio[k]
                time_ratio[k] = swap
            }
    if (rounds)
        printf "%-6s  %-12.3g  %-24s  %s\n", "-", time_ratio[int((rounds + 1) / 2)], "1, but not claimed", \
            "rendering time of the new model over that of Ward-Duer, median of " rounds " (paper: unchanged)"
}

function check_renderings() {
    check_grazing()
    check_highlight()
    say_times()
}
