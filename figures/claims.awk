# Checks the claims that go with the figures against the tables that `draw` had filled. Prints a line a claim, the number found
# beside the expected one; the exit status is 1 where one does not hold. Numbers in brackets are the paper's equations. The claims
# themselves are in claims_*.awk, to be given after this file.
#
# Tables are called QUANTITY-SUBJECT-WHAT.csv. The subject is a roughness, or two:
#   plane, albedo - ROUGHNESS - MODEL    anisotropic - 0.05x0.2 - MODEL    weight - ROUGHNESS - SAMPLING
# a material:
#   fit, fit75, curve, half, times - linoleum - MODEL
# a model, of the grazing scene, or a part of the linoleum sphere:
#   grazing - MODEL - STRATEGY    linoleum - PART - MODEL, or "difference"
# and table1.csv, the paper's Table 1, has neither.
BEGIN {
    FS = ","
    pi = atan2(0, -1)
    printf "%-6s  %-12s  %-24s  %s\n", "", "found", "expected", "claim"
}

FNR == 1 {
    name = FILENAME
    sub(/.*\//, "", name)
    sub(/\.csv$/, "", name)
    split(name, part, "-")
    quantity = part[1]
    subject = part[2]
    what = substr(name, length(quantity) + length(subject) + 3)
    delete column
    for (i = 1; i <= NF; i++)
        column[$i] = i
    next
}

function cosine(degrees) { return cos(degrees * pi / 180) }
function distance(a, b) { return a > b ? a - b : b - a }

function line(holds, found, expected, claim) {
    found = found == "" ? "missing" : sprintf("%.7g", found)
    printf "%-6s  %-12s  %-24s  %s\n", holds ? "ok" : "FAILED", found, expected, claim
    claims++
    failed += !holds
}
function near(found, expected, tolerance, claim) {
    line(found != "" && expected != "" && distance(found, expected) <= tolerance, found, \
         sprintf("%.7g within %.2g", expected, tolerance), claim)
}
function above(found, bound, claim) { line(found != "" && found > bound, found, sprintf("> %.7g", bound), claim) }
function between(found, low, high, claim) {
    line(found != "" && high != "" && found > low && found < high, found, sprintf("%.7g to %.7g", low, high), claim)
}
function at_most(found, bound, claim) { line(found != "" && found <= bound, found, sprintf("<= %.7g", bound), claim) }

function ratio(a, b) { return a != "" && b > 0 ? a / b : "" }
function complement(share) { return share == "" ? "" : 1 - share }
function greater(a, b) { return a > b ? a : b }

END {
    check_model()
    check_fit()
    check_renderings()
    printf "%d claims, %d failed\n", claims, failed
    exit failed > 0
}
