#!/bin/bash
# brdffit as its users run it: files, conventions, outputs, pictures, mistakes. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
brdffit=$BIN/brdffit

"$BIN/brdfeval" -ax .1 -ay .1 -rs .05 -rd .2 --grid tl=15:75:15,pl=0,tv=-80:80:4,pv=180 >plane.csv || exit 2

# Colours and anisotropy: light and views all round.
printf 'void metal2 gold\n4 1 0 0 .\n0\n6 .8 .5 .2 .7 .2 .1\nvoid plastic2 red\n4 1 0 0 .\n0\n6 .6 .1 .1 .05 .2 .1\n' >materials.rad
for name in gold red; do
    "$BIN/brdfeval" -M materials.rad $name --grid tl=10:70:20,pl=0:150:30,tv=5:75:10,pv=10:350:20 >$name.csv || exit 2
done

# found MODEL PARAMETER EXPECTED TOLERANCE FILE.json: in the first channel
found() {
    "${PYTHON:-python3}" - "$@" <<'PYTHON'
import json, sys
model, parameter, expected, tolerance, file = sys.argv[1:]
fit = next(f for f in json.load(open(file))["models"] if f["model"] == model)
value = fit["channels"][0][parameter]["value"]
sys.exit(abs(value - float(expected)) > float(tolerance) and f"{parameter} is {value}")
PYTHON
}

quiet "a table of brdfeval's is read and fitted without a warning" "$brdffit" -m gmd plane.csv
quiet "... all models" "$brdffit" --output json plane.csv
cp check.log plane.json
check "... the roughness is found" found gmd alpha_x .1 1e-9 plane.json
check "... and rs" found gmd rs .05 1e-9 plane.json
check "... and rd" found gmd rd .2 1e-9 plane.json
check "Ward has more specular reflectance for the same data" found ward rs .1 .03 plane.json

"$brdffit" plane.csv >table
check "the table has a column for each model" grep -qE '^ +gmd +ward +ward-duer +ward-neumann$' table
check "... and rows for each number" test "$(grep -cE '^(alpha|rs|rd|residual_20|rms_20|condition) ' table)" = 6
check "... and says what was assumed" grep -qF -- '--angles degrees (assumed)' table
check "... and ends with the material" test "$(tail -n 1 table)" = "6 0.21053 0.21053 0.21053 0.05 0.1 0.1"
"$brdffit" plane.csv | cmp -s - table
result $? "the same data give the same bytes"
"$brdffit" - <plane.csv | sed 's/standard input/plane.csv/' | cmp -s - table
result $? "- is standard input"
head -n 100 plane.csv >one.csv
{ head -n 1 plane.csv; tail -n +101 plane.csv; } >two.csv
"$brdffit" --output json one.csv two.csv >both.json
check "two files are taken together" found ward rs \
    "$("${PYTHON:-python3}" -c 'import json; print(json.load(open("plane.json"))["models"][1]["channels"][0]["rs"]["value"])')" 1e-9 both.json

# Conventions as they can be told: data changed one way and read back that way.
awk -F, -v OFS=, 'NR == 1 { print "theta_i,phi_i,theta_o,phi_o,f"; next }
    { r = atan2(0, -1) / 180; print $3 * r, $4 * r - 2 * atan2(1, 0), $1 * r, $2 * r, $5 * cos($1 * r) }' plane.csv >odd.csv
"$brdffit" -m gmd --angles radians --light out --mirror same --quantity brdf-cosine-out --output json odd.csv >odd.json
check "unit, light, mirror and quantity as told" found gmd alpha_x .1 1e-5 odd.json
check "... and said" grep -q '"mirror": {"value": "same", "known": "as told"}' odd.json
"$brdffit" -m gmd --light out --mirror same --quantity brdf-cosine-out odd.csv >out 2>err
check "radians read as degrees are noticed" grep -qF -- "--angles radians" err
"$brdffit" -w- -m gmd --light out --mirror same --quantity brdf-cosine-out odd.csv 2>&1 >out | cmp -s - /dev/null
result $? "... but not with -w-"

"$brdffit" -m gmd --anisotropic --output rad --name brushed gold.csv 2>&1 | grep -v '^#' >gold.rad
check "gold becomes a metal2" cmp gold.rad <(printf 'void metal2 brushed\n4 1 0 0 .\n0\n6 0.8 0.5 0.2 0.7 0.2 0.1\n')
"$brdffit" -m gmd --anisotropic --output rad red.csv 2>&1 | grep -v '^#' >red.rad
check "red plastic becomes a plastic2" cmp red.rad <(printf 'void plastic2 fitted\n4 1 0 0 .\n0\n6 0.6 0.1 0.1 0.05 0.2 0.1\n')
for angle in 65 70 75 80 85; do
    "$brdffit" -m gmd --total-reflectance .175 --max-angle $angle --output rad "$GRAZE_ROOT/figures/linoleum.csv"
done 2>&1 | grep -c '^void plastic2 ' >grey
check "data without colour become a plastic2, whatever rounding says" test "$(cat grey)" = 5
echo "0 0 0 0 0 1" | "$BIN/brdfeval" -M red.rad fitted >out 2>&1
check "brdfeval takes the material" "$BIN/brdfeval" -M red.rad fitted -q mean
"$brdffit" -m gmd --anisotropic --roughness separate --output json gold.csv >separate.json
check "each channel may have its own roughness" found gmd alpha_y .1 1e-6 separate.json
check "... three fits" test "$(grep -c degrees_of_freedom separate.json)" = 3
"$brdffit" -m gmd --anisotropic --channels f_b --output json gold.csv >blue.json
check "one channel of three" found gmd rs .14 1e-6 blue.json
"$brdffit" -m gmd --anisotropic --total-reflectance .8,.5,.2 --output json gold.csv >total.json
check "total reflectance of each channel" found gmd rd .24 1e-6 total.json
for loss in plain log; do
    "$brdffit" -m gmd --loss $loss --max-angle 60 --output json plane.csv >loss.json
    check "--loss $loss, --max-angle" found gmd alpha_x .1 1e-9 loss.json
done
check "... pairs within the angle" grep -q '"pairs": 124,' loss.json

"$brdffit" -m gmd --anisotropic plane.csv >out 2>err
check "what one plane cannot tell is warned of" grep -qE "undetermined|hardly tell" err
printf 'theta_i,theta_o,f\n' >matt.csv
for t in 0 20 40 60; do printf '30,%d,.1\n' $t; done >>matt.csv
"$brdffit" -m gmd matt.csv >out 2>err
check "a matt surface has no roughness" grep -qx "brdffit: warning: gmd: alpha is undetermined" err
check "... and no other that is as good" test "$(grep -c "as good" err)" = 0
check "... and no lobe" grep -qE "rs is (at its lower bound|known to worse|undetermined)" err

# Pictures.
fails "the plot's suffix" 1 "'fit.jpg' ends in none of .svg .png .gp" "" "$brdffit" --plot fit.jpg plane.csv
check "gnuplot's script" "$brdffit" --plot "fit.gp" plane.csv
check "... a panel for each of five angles" test "$(grep -c '^plot \$' fit.gp)" = 5
check "... with all models" grep -q "title 'ward-neumann'" fit.gp
check "... each with dashes of its own" test "$(sed -n '/^plot NaN/,$p' fit.gp | grep -o 'dashtype.* title' | sort -u | wc -l)" = 4
check "... named once, in the last plot, below the panels" test "$(grep -c "with .* title '" fit.gp) $(sed -n '/^plot NaN/,$p' fit.gp | grep -c "with .* title '")" = "5 5"
check "... the measured points" test "$(sed -n '/^.measured3 /,/^END/p' fit.gp | grep -c '^-*[0-9]')" = 41
# range AXIS: of the first panel, from and to.
range() { sed -n "s/^set $1range \[\(.*\):\(.*\)\]\$/\1 \2/p" gap.gp | head -n 1; }
# A peak at 30 degrees that no measurement hits: ALPHA.
gap() {
    "$BIN/brdfeval" -a "$1" -rs .05 -rd .01 --grid tl=30,pl=0,tv=-80:80:10,pv=180 | awk -F, '$3 != 30' >gap.csv
    "$brdffit" -w- -m gmd --plot gap.gp gap.csv >gap.out
    highest=$(awk -F, 'NR > 1 && $5 > most { most = $5 } END { print most }' gap.csv)
}
shown() { range y | awk -v highest="$highest" -v low="$1" -v high="$2" '{ exit !($1 == 0 && $2 > low * highest && $2 < high * highest) }'; }
gap .1
check "a fit's peak between two measurements is seen" shown 1.9 2.1
gap .06
check "... if it is not above them by more than four times" shown 4.3999 4.4001
check "... and views where there is little to see are not" test "$(range x)" = "$(sed -n '/^.fit0_0 /,/^END/p' gap.gp |
    awk -v most="$(awk -v highest="$highest" 'BEGIN { print 4 * highest }')" '$2 + 0 > .05 * most { last = $1; first = first ? first : $1 }
        END { print first - 10, last + 10 }')"
fails "no plane of incidence" 1 "no three measurements share a plane" \
    'theta_i,phi_i,theta_o,phi_o,f\n30,0,10,90,.1\n30,0,30,90,.1\n30,0,50,90,.1\n30,0,70,90,.1\n' \
    "$brdffit" -w- -m gmd --plot fit.gp -
if command -v gnuplot >/dev/null; then
    name='| touch harm; $(touch harm) '\''"`.svg'
    check "an SVG, whatever its name" "$brdffit" --plot "$name" plane.csv
    check "... is one" grep -q '<svg' "$name"
    check "... and nothing else happened" test ! -e harm
    check "a PNG" "$brdffit" --plot fit.png plane.csv
    check "... is one" test "$(head -c 4 fit.png | tail -c 3)" = PNG
else
    for i in 1 2 3 4 5; do echo "ok $((results += 1)) - pictures # SKIP needs gnuplot"; done
fi
fails "no gnuplot" 2 "cannot run gnuplot" "" env PATH=/nonexistent "$brdffit" --plot none.svg plane.csv
check "... leaves no file" test ! -e none.svg
mkdir broken && printf '#!/bin/sh\nexit 3\n' >broken/gnuplot && chmod +x broken/gnuplot
fails "a gnuplot that fails" 2 "gnuplot" "" env PATH="$work/broken:$PATH" "$brdffit" --plot none.svg plane.csv
fails "a picture that cannot be made" 1 "cannot create it" "" "$brdffit" --plot no/where.gp plane.csv

# Mistakes.
fails "no file" 1 "no file of measurements" "" "$brdffit"
fails "a file that is not there" 1 "none.csv: cannot open it" "" "$brdffit" none.csv
fails "a directory" 1 "$work: cannot read it: Is a directory" "" "$brdffit" "$work"
fails "an empty file" 1 "standard input: there is no table in it" "" "$brdffit" -
printf 'theta_i,theta_o,f\n30,40,\000\n' >zero.csv
fails "no text" 1 "zero.csv: is neither text nor a MERL table" "" "$brdffit" zero.csv
fails "values beyond all measure" 1 "standard input:2: a value of 1e+200 is out of range" \
    'theta_i,theta_o,f\n30,40,1e200\n' "$brdffit" -
for value in 1e300 1e100 1e99; do
    sed "5s/,[^,]*\$/,$value/" plane.csv >huge.csv
    fails "... $value" 1 "huge.csv:5: a value of ${value/e/e+} is out of range: a BRDF is at most 1e+50" "" "$brdffit" huge.csv
done
# All that a fit is given is as large as can be, or as small.
awk -F, -v OFS=, 'NR == 1 { print $0, "weight" } NR > 1 { $5 = "1e50"; print $0, NR % 2 ? "1e50" : "1e-50" }' plane.csv >huge.csv
for loss in cosine plain log; do
    "$brdffit" -w- --loss $loss --anisotropic --output json huge.csv >huge.json 2>err
    check "the largest values and weights that are read have a JSON, --loss $loss" "${PYTHON:-python3}" -c '
import json
def refuse(word): raise ValueError(word)
found = json.load(open("huge.json"), parse_constant=refuse)
assert all(m["residual_20"] > 1e100 and m["rms_20"] > 1e49 for m in found["models"])'
done
fails "angles beyond all measure" 1 "standard input:2:4: expected a polar angle of at most 180 degrees in size, not '1e9'" \
    'theta_i,theta_o,f\n30,1e9,1\n' "$brdffit" -
fails "a header alone" 1 "standard input: there are no lines of data" 'theta_i,theta_o,f\n' "$brdffit" -
fails "standard input twice" 1 "only one of the files" "" "$brdffit" - -
fails "bad numbers have a place" 1 "standard input:2:4: expected a finite number, the theta_o, not 'x'" \
    'theta_i,theta_o,f\n30,x,1\n' "$brdffit" -
fails "too few data" 1 "too few" 'theta_i,theta_o,f\n30,30,1\n30,40,1\n' "$brdffit" -
fails "no such model" 1 "expected one of gmd ward ward-duer ward-neumann all" "" "$brdffit" -m phong plane.csv
fails "... which is said before files are opened" 1 "there is no 'phong'" "" "$brdffit" -m phong none.csv
fails "bytes that would control a terminal are shown as numbers" 1 "there is no '\\x1B[31mward'" "" "$brdffit" -m $'\033[31mward' plane.csv
fails "no such loss" 1 "--loss" "" "$brdffit" --loss l1 plane.csv
fails "no such output" 1 "--output" "" "$brdffit" --output xml plane.csv
fails "both isotropic and not" 1 "exclude each other" "" "$brdffit" --isotropic --anisotropic plane.csv
fails "a material of another model" 1 "are the model gmd" "" "$brdffit" -m ward --output rad plane.csv
fails "a total that is none" 1 "--total-reflectance" "" "$brdffit" --total-reflectance 1.5 plane.csv
fails "... or not as many as channels" 1 "2 numbers for 1 channels" "" "$brdffit" --total-reflectance .5,.5 plane.csv
fails "a name of two words" 1 "--name" "" "$brdffit" --name "a b" plane.csv
fails "no such channel" 1 "there is no channel 'g'" "" "$brdffit" --channels g plane.csv
fails "no angle is left" 1 "no measurement is within the angle" "" "$brdffit" --max-angle 5 plane.csv
"$brdffit" plane.csv >/dev/full 2>err
check "a full disk is the system's mistake" test $? -eq 2
plan
