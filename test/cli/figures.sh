#!/bin/bash
# `make figures`: pictures in both formats, and claims that fail where they do not hold. TAP.
source "$(dirname "$0")/../support/tap.sh"
draw=$GRAZE_ROOT/figures/draw

# What is rendered is rendered coarsely.
export GRAZE_SHORT=1
"$draw" "$BIN" "$work/out" >"$work/log" 2>"$work/err"
result $? "figures are drawn, and all claims hold" "$work/log" "$work/err"
check "... without a word of complaint" test ! -s "$work/err"
check "... and each claim says what was found" test "$(grep -c '^ok  ' "$work/log")" -ge 150
for name in figure2 figure3 figure4 figure5 figure6 figure7 figure8 figure9 figure10 figure11 weight; do
    # A curve that was not drawn leaves far fewer bytes.
    check "$name.png is a picture" sh -c "head -c 8 '$work/out/$name.png' | od -An -tx1 | grep -q '89 50 4e 47 0d 0a 1a 0a' &&
        test \$(wc -c <'$work/out/$name.png') -gt 25000"
    check "$name.svg is a whole document" sh -c "head -c 300 '$work/out/$name.svg' | grep -q '<svg' &&
        tail -n 2 '$work/out/$name.svg' | grep -q '</svg>' && test \$(wc -c <'$work/out/$name.svg') -gt 25000"
    check "... that tells no path" sh -c "! grep -qF '$work' '$work/out/$name.svg'"
done

# The page of the manual: its pictures, and its claims, of which only those on renderings depend on how finely they are done.
cp -R "$GRAZE_ROOT/man/figures" "$work/page"
check "the page is brought up to date" "$GRAZE_ROOT/figures/page" "$work/out" "$work/page"
lasting() { grep -v -e '^| Figure \(2\|8\|11\):' "$1/README.md"; }
diff <(lasting "$GRAZE_ROOT/man/figures") <(lasting "$work/page") >"$work/log"
result $? "... and says what it said: else make figures-page" "$work/log"
check "... as many claims on renderings as before" test "$(wc -l <"$GRAZE_ROOT/man/figures/README.md")" -eq "$(wc -l <"$work/page/README.md")"
grep -o '([a-z0-9]*\.png)' "$work/page/README.md" | tr -d '()' | sort >"$work/shown"
check "... and tells of fits at a bound" grep -qx -- "- ward: rs is at its upper bound" "$work/page/README.md"
check "... and shows all pictures" sh -c "cd '$work/out' && ls *.png | diff - '$work/shown'"

# Tools without answers.
mkdir "$work/bin"
for tool in gnuplot brdfeval brdffit gtrace gpict; do ln -s /bin/true "$work/bin/$tool"; done
PATH=$work/bin:$PATH "$draw" "$work/bin" "$work/nothing" >"$work/log" 2>&1
check "the exit status tells of tools without answers" test $? -eq 1

claims() {
    (cd "$GRAZE_ROOT/figures" && awk -f claims.awk -f claims_model.awk -f claims_fit.awk -f claims_render.awk "$1"/*.csv) >"$work/log"
}

mkdir "$work/empty"
for table in "$work"/out/data/*.csv; do head -n 1 "$table" >"$work/empty/${table##*/}"; done
claims "$work/empty"
check "the exit status tells of claims that fail" test $? -eq 1
check "... which are all, where there are no numbers" grep -q '^160 claims, 160 failed' "$work/log"

# Ward's model in place of the new one.
cp -R "$work/out/data" "$work/ward"
for table in "$work"/ward/*-ward.csv; do cp "$table" "${table%ward.csv}gmd.csv"; done
claims "$work/ward"
check "another model than the new one is noticed" test $? -eq 1
check "... where it reflects too much" grep -q '^FAILED.* any angle' "$work/log"
check "... where its peak is elsewhere" grep -q '^FAILED.*(23)' "$work/log"
check "... not where it does not matter" grep -q '^ok.*(32)' "$work/log"

# unsound DESCRIPTION CLAIM FILE AWK: with a table changed so, exactly the claims that CLAIM matches fail.
unsound() {
    rm -rf "$work/changed"
    cp -R "$work/out/data" "$work/changed"
    awk -F, -v OFS=, -v CONVFMT=%.17g "$4" "$work/out/data/$3" >"$work/changed/$3"
    ! claims "$work/changed" &&
        grep '^FAILED' "$work/log" >"$work/failed" && ! grep -vq -- "$2" "$work/failed"
    result $? "$1" "$work/log"
}
unsound "an albedo off by a millionth" "new model at 60 deg" albedo-0.1-gmd.csv '$1 == 60 { $2 += 1e-6 } 1'
unsound "an albedo above 1" "any angle" albedo-0.2-gmd.csv '$1 == 88 { $2 = 1 } NR > 1 && $1 == 50 { $2 = 1.000001 } 1'
unsound "a Ward model that keeps to its bound" "Ward's model near" albedo-0.1-ward.csv 'NR > 1 && $2 > 1 { $2 = 1 } 1'
unsound "an anisotropic albedo above 1" "azimuth 45 deg.*any angle" anisotropic-0.05x0.2-gmd.csv \
    '$1 == 60 && $2 == 45 { $3 = 1.000001 } 1'
unsound "an anisotropic albedo off by a millionth" "0.2: albedo of the new model at 0 deg" anisotropic-0.05x0.2-gmd.csv \
    '$1 == 0 && $2 == 0 { $3 += 1e-6 } 1'
unsound "an anisotropic albedo that stays low" "azimuth 75 deg.*horizon, 89" anisotropic-0.05x0.2-gmd.csv \
    '$2 == 75 && $1 > 89 { $3 = .9 } 1'
unsound "samples that are accepted at one azimuth" "azimuth 90 deg.*(32)" anisotropic-0.05x0.2-gmd.csv '$2 == 90 { $4 = 1 } 1'
unsound "an azimuth that is missing" "azimuth 30 deg" anisotropic-0.05x0.2-gmd.csv '$2 != 30'
unsound "samples that are all accepted" "accepted samples" albedo-0.2-gmd.csv 'NR > 1 { $3 = 1 } 1'
unsound "a peak that is off by a tenth of a degree" "(23)" plane-0.25-gmd.csv \
    '$1 == 50 && $3 > 50.05 && $3 < 50.15 { $5 *= 1.01 } 1'
unsound "a mirror direction off by a billionth" "(12)" plane-0.1-ward-duer.csv \
    '$1 == 25 && $3 > 24.95 && $3 < 25.05 { $5 *= 1 + 1e-9 } 1'
unsound "models that differ" "apart" plane-0.1-ward-duer.csv '$1 == 0 && $3 == 3 { $5 *= 1.02 } 1'
unsound "a weight that scatters" "paired sampling" weight-0.1-pair.csv '$1 == 60 { $3 *= 1.05 } 1'
unsound "a weight that is biased" "paired sampling: mean" weight-0.1-pair.csv '$1 == 89 { $2 += .001 } 1'
unsound "a weight above 1" "paired sampling" weight-0.1-pair.csv 'NR == 9 { $4 = 1.000001 } 1'
unsound "a pair that is rejected" "paired.*rejected at any angle" weight-0.1-pair.csv '$1 == 20 { $5 = 1 / 75025 } 1'
unsound "a pair that is rejected near the horizon" "paired.*rejected" weight-0.1-pair.csv '$1 == 89.9 { $5 = 1 / 75025 } 1'
unsound "Ward's samples that are not rejected" "Ward's sampling: share.*at 89 deg" weight-0.1-sample.csv '$1 == 89 { $5 -= .001 } 1'
unsound "a peak at the horizon where one is above it" "from 50.*above the horizon (22)" plane-0.25-gmd.csv \
    '$1 == 50 && $3 > 89.85 { $5 = 3.6 } 1'
unsound "a peak above the horizon where there is none" "at the horizon (22)" plane-0.25-gmd.csv \
    '$1 == 75 && $3 > 87.95 && $3 < 88.05 { $5 = 59 } 1'
unsound "a fit that is off" "roughness of the new model" fit-linoleum-gmd.csv 'NR > 1 { $1 = .032 } 1'
unsound "errors in another order" "error of Ward" fit-linoleum-ward-duer.csv 'NR > 1 { $7 = 1546 } 1'
unsound "models that are equal off the centre" "beside Figure 11: \.\.\." half-linoleum-ward-duer.csv '$3 > 0 && NR > 1 { $5 *= 9 } 1'
unsound "a bound that is reached below 75 degrees too" "up to 75 deg.*Ward, higher" fit75-linoleum-ward.csv 'NR > 1 { $3 = .175 } 1'
unsound "models that differ below 75 degrees" "up to 75 deg.*Ward-Duer" fit75-linoleum-ward-duer.csv 'NR > 1 { $3 = .03; $7 = 2 } 1'
unsound "a reflection not brighter than the luminaire" "Figure 2: brightest" grazing-ward-duer-light.csv \
    '$5 == "surface" && $3 > 17000 { $3 = 17000 } 1'
unsound "a reflection brighter than the luminaire" "Figure 8" grazing-gmd-light.csv \
    '$5 == "surface" && $2 > .58 && $2 < .65 && $1 > -1.4 && $1 < 1.4 { $3 = 18000 } 1'
unsound "sampling without weights that is not too bright" "Figure 2" grazing-ward-duer-unweighted.csv 'NR > 1 { $3 /= 2 } 1'
unsound "sampling with weights that is too bright" "Figure 8" grazing-gmd-brdf.csv 'NR > 1 && NF > 1 { $3 *= 1.3 } 1'
unsound "samples that tell little" "Figure 8: .*standard error" grazing-gmd-brdf.csv 'NR > 1 && NF > 1 { $4 *= 20 } 1'
unsound "a highlight that is half a ring" "Figure 11: ring: least" linoleum-highlight-difference.csv \
    'NR > 1 && NF > 1 && $1 > -1.9 { $6 = ($6 + 1) / 2 - 1 } 1'
unsound "a highlight that is five times as bright all over" "Figure 11: \.\.\. at the" linoleum-highlight-difference.csv \
    'NR > 1 && NF > 1 && $6 < 0 { $6 = .01 } 1'
unsound "a line that is missing" "at 35 deg" albedo-0.05-gmd.csv '$1 != 35'
plan
