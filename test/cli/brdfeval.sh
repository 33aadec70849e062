#!/bin/bash
# brdfeval as its users run it: queries, fields, formats, bad input, bad output, threads. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
brdfeval=$BIN/brdfeval

# prints NAME EXPECTED INPUT ARGUMENTS...: brdfeval must answer with these numbers, each within a millionth; - stands for any
prints() {
    local name=$1 expected=$2 input=$3
    shift 3
    printf '%b' "$input" | "$brdfeval" "$@" >out 2>err
    local got=$?
    [ $got -eq 0 ] && awk -v want="$expected" '
        { for (i = 1; i <= NF; i++) got[++n] = $i }
        END {
            if (split(want, w) != n) exit 1
            for (i = 1; i <= n; i++) {
                d = got[i] - w[i]; if (d < 0) d = -d
                m = w[i] < 0 ? -w[i] : w[i]
                if (w[i] != "-" && d > 1e-6 * m) exit 1
            }
        }' out
    local status=$?
    echo "expected $expected, exit status $got" >>err
    result $status "$name" out err
}

pair=".8 0 .6 0 .6 .8\n" # h = (.8 .6 1.4)
mirror=".6 0 .8 -.6 0 .8\n"

# eval: the four models by hand. With alpha = .5 and .25, E/(pi ax ay) = exp(-(1.6^2 + 2.4^2)/1.96)/.392699.
prints "the new model" ".0281309192" "$pair" -ax .5 -ay .25
prints "... is the default" ".0281309192" "$pair" -m gmd -ax .5 -ay .25
prints "Ward" ".0131741846" "$pair" -m ward -ax .5 -ay .25
prints "Ward-Duer" ".0190152976" "$pair" -m ward-duer -ax .5 -ay .25
prints "Ward-Neumann" ".0114091785" "$pair" -m ward-neumann -ax .5 -ay .25
prints "-a is both roughnesses" "12.4339799" "$mirror" -a .1
prints "... unless a later option says otherwise" "6.2169900" "$mirror" -a .1 -ay .2
prints "roughness is 0.1 by default" "12.4339799" "$mirror"
prints "-rs and -rd" "6.2488209" "$mirror" -rs .5 -rd .1
prints "-rd alone" "12.4658109" "$mirror" -rd .1
prints "all fields in the mirror direction" "12.4339799 9.9471839 9.9471839 1 9.9471839 1" "$mirror" -o fcpwPW
prints "fields in any order, and again" "1 12.4339799 1" "$mirror" -o wfw
prints "-o as one word" "1 12.4339799" "$mirror" -owf
prints "weights are those of the specular reflectance" ".5 .5" "$mirror" -rs .5 -o wW
prints "below the surface there is nothing" "0 0 0 0 0 0" "0 0 -1 0 0 1\n" -rd .5 -o fcpwPW
prints "... nor seen from there" "0 0 0 0 0 0" "0 0 1 .6 0 -.8\n" -rd .5 -o fcpwPW
prints "... nor on the horizon" "0 0" "1 0 0 0 0 1\n0 0 1 0 1 0\n"
prints "angles in degrees" "12.4339799 12.4339799" \
    "36.86989764584402 0 36.86989764584402 180\n36.86989764584402 -100 36.86989764584402 80\n" --angles
prints "... also a whole turn, either way" "12.4339799 12.4339799" \
    "-323.13010235415598 360 36.86989764584402 -180\n36.86989764584402 -360 323.13010235415598 360\n" --angles
prints "90 degrees is the horizon" "0" "90 0 45 0\n" --angles
prints "any length is taken" "12.4339799" "6e200 0 8e200 -6e-200 0 8e-200\n"
printf "%b" "$mirror" | "$brdfeval" >exact
for length in 1.0000009 1.0000011; do
    awk -v OFMT=%.17g "BEGIN { print .6 * $length, 0, .8 * $length, -.6, 0, .8 }" | "$brdfeval" >"length $length"
done
check "lengths off by rounding are left alone" sh -c "! cmp -s 'length 1.0000009' exact"
check "... others not" test "$(cut -c1-10 <"length 1.0000011")" = "$(cut -c1-10 <exact)"

# In the mirror direction at a cosine c the lobe is 1/(4 pi a^2 c^2), too large for a number, while this times c is not.
grazing="1 0 1e-150 -1 0 1e-150\n"
prints "a lobe too large, times its cosine" "7.957747154594767e160" "$grazing" -a 1e-6 -o c
prints "... times a small reflectance" "7.957747154594767e305" "$grazing" -a 1e-6 -rs 1e-5
prints "... too large even so" "1.797693134862315e308" "$grazing" -a 1e-6 -rs .9
prints "... beside a diffuse part" "7.957747154594767e159" "$grazing" -a 1e-6 -rs .1 -rd .5 -o c
grazing="1 0 1e-15 -1 0 1e-15\n"
printf "$grazing" | python3 -c 'import sys, array; array.array("f", map(float, sys.stdin.read().split())).tofile(sys.stdout.buffer)' >grazing.flt
single() { "$brdfeval" -a 1e-6 -ff "${@:2}" <grazing.flt | python3 -c 'import sys, array; a = array.array("f", sys.stdin.buffer.read()); print(" ".join("%.5e" % x for x in a)); sys.exit(" ".join("%.5e" % x for x in a) != sys.argv[1])' "$1"; }
check "a lobe too large for floats, times its cosine" single "3.40282e+38 7.95775e+25 7.95775e+25" -o fcp
check "... times a small reflectance" single "7.95775e+30 1.00000e-10" -rs 1e-10 -o fw

# sample, pair, albedo.
prints "Ward's sampling at s = 0 is the mirror direction" "-.6 0 .8 9.9471839 1" ".6 0 .8 0 .3\n" -q sample
prints "... along x" ".3846154 0 .9230769 - .96" "0 0 1 .6321205588 0\n" -q sample -ax .2 -rs 1
prints "... elsewhere" "- - .9230769 - .96" "0 0 1 .6321205588 .37\n" -q sample -a .2
prints "... rejected" "- - - 0 0" "1 0 1e-9 .5 .5\n" -q sample
prints "paired sampling keeps the first" ".96 0 .28 - .4375" "0 0 1 .6321205588 0 0\n" -q pair -a .75
prints "... or the second" "-.96 0 .28 - .4375" "0 0 1 .6321205588 0 .6\n" -q pair -a .75
prints "... rejected below the surface" "- - - 0 0" ".6 0 -.8 .5 .5 .5\n" -q pair
prints "samples of a view in degrees" "-.6 0 .8 9.9471839 .5" "36.86989764584402 0 0 .3\n" -q sample --angles -rs .5
prints "albedo" ".990000 .973957 .861043" "0 0\n60 10\n89 20\n" -q albedo --angles
prints "albedo with both reflectances" ".595" "0 0 1\n" -q albedo -rs .5 -rd .1
prints "albedo below the surface" "0" "0 0 -1\n" -q albedo -rd .5
prints "no records, no answers" "" ""
prints "fields of samples" ".8 - -.6" ".6 0 .8 0 .3\n" -q sample -o zpx
prints "... of pairs" ".4375 .28 .4375" "0 0 1 .6321205588 0 0\n" -q pair -a .75 -oWzW
prints "the share of samples accepted, before the albedo" "1 .990000 1" "0 0 1\n" -q albedo -o AaA -ax .1 -ay .1
prints "... 1/2 at the horizon, whatever the model and the reflectances" ".5" "89.99999999 30\n" -q albedo -oA --angles -m ward -rs .3 -rd .2
prints "... 0 below" "0 0" "0 .6 -.8\n" -q albedo -o aA

# The mean albedo: the integral of the albedo over the cosine's square m^2, by Simpson's rule over x with m = (1 - x^2)^2, which
# takes out the square root in Ward's model; in four azimuths of a quadrant.
for setting in "-a .1" "-m ward -ax .3 -ay .2 -rs .5 -rd .1"; do
    awk 'BEGIN { for (i = 0; i < 4; i++) for (j = 0; j < 400; j++) {
        x = j / 400; m = (1 - x * x) ^ 2; phi = (2 * i + 1) * atan2(1, 1) / 4
        printf "%.17g %.17g %.17g\n", sqrt(1 - m * m) * cos(phi), sqrt(1 - m * m) * sin(phi), m } }' |
        "$brdfeval" -q albedo $setting | awk '{ j = (NR - 1) % 400; x = j / 400
            sum += $1 * 8 * x * (1 - x * x) ^ 3 * (j % 2 ? 4 : 2) / 1200 / 4 } END { printf "%.9f", sum }' >integral
    prints "mean albedo, $setting" "$(cat integral)" "" -q mean $setting
done
prints "the mean albedo again and again" "$("$brdfeval" -q mean -o mm)" "" -q mean -omm
check "... in binary" test "$("$brdfeval" -q mean -fad | od -An -tfD | awk '{ printf "%.12g", $1 }')" = "$("$brdfeval" -q mean | awk '{ printf "%.12g", $1 }')"
check "... leaves its input alone" test "$(printf '1\n2\n' | { "$brdfeval" -q mean >mean; cat; } | wc -l)" -eq 2

# Records for all that follows.
awk 'BEGIN { srand(7); for (i = 0; i < 2000; i++) printf "%.17g %.17g %.17g %.17g %.17g %.17g\n",
    rand() - .5, rand() - .5, rand() / 2, rand() - .5, rand() - .5, rand() / 2 }' >pairs
awk 'BEGIN { srand(8); for (i = 0; i < 2000; i++) printf "%.17g %.17g %.17g %.17g %.17g %.17g\n",
    rand() - .5, rand() - .5, rand() / 2, rand(), rand(), rand() }' >views
cut -d' ' -f1-5 views >views5
head -20 views | cut -d' ' -f1-3 >views3

# Order does not matter to the value: the same bits.
awk '{ print $4, $5, $6, $1, $2, $3 }' pairs >exchanged
for model in gmd ward ward-duer ward-neumann; do
    "$brdfeval" -m $model -ax .2 -ay .3 <pairs >there
    "$brdfeval" -m $model -ax .2 -ay .3 <exchanged >back
    check "$model: exchanged directions give the same bits" cmp there back
done
check "... of numbers that are not all zero" bash -c "[ \$(grep -vc '^0' there) -gt 1000 ]"

# Formats tell the same numbers.
"$brdfeval" -o fcpwPW -faa <pairs >ascii
"$brdfeval" -o fcpwPW -fad <pairs >doubles
"$brdfeval" -o fcpwPW -faf <pairs >floats
check "six doubles are 48 bytes" test "$(wc -c <doubles)" -eq 96000
check "six floats are 24 bytes" test "$(wc -c <floats)" -eq 48000
od -An -v -w48 -tfD doubles | awk '{ for (i = 1; i <= NF; i++) printf "%.9g ", $i; print "" }' >from_doubles
awk '{ for (i = 1; i <= NF; i++) printf "%.9g ", $i; print "" }' ascii >from_ascii
check "doubles are the numbers in ASCII" cmp from_doubles from_ascii
od -An -v -w24 -tfF floats | awk '{ for (i = 1; i <= NF; i++) printf "%.5g ", $i; print "" }' >from_floats
check "floats are, too" bash -c "awk '{ for (i = 1; i <= NF; i++) printf \"%.5g \", \$i; print \"\" }' ascii |
    paste - from_floats | awk '{ for (i = 1; i <= 6; i++) { d = \$i - \$(i + 6); if (d * d > 1e-8 * \$i * \$i && \$i > 1e-37) exit 1 } }'"

# Six weights are a pair of directions above the surface: through doubles or through ASCII, the same bits arrive.
"$brdfeval" -o wWwwWW -faa <pairs | tee six | "$brdfeval" -a .5 -fad -o fcpwPW >through_ascii
"$brdfeval" -o wWwwWW -fad <pairs | "$brdfeval" -a .5 -fdd -o fcpwPW >through_doubles
check "doubles survive the way through ASCII to the bit" cmp through_ascii through_doubles
check "... all of them" test "$(wc -c <through_ascii)" -eq 96000
check "... printed in full" grep -qE '[0-9]{16}' six
"$brdfeval" -faa -o fcpwPW <pairs >first
check "answers are the same at a second time" cmp first ascii

# Floats are answered in floats, close to what doubles say of the same floats.
pack() { # the numbers of an ASCII file as floats, as they are nearest to them
    "${PYTHON:-python3}" -c 'import array, sys; array.array("f", map(float, sys.stdin.read().split())).tofile(sys.stdout.buffer)'
}
# unit N: the first N vectors of each line are made unit vectors.
unit() {
    awk -v n="$1" '{ for (i = 1; i <= 3 * n; i += 3) { length_of = sqrt($i * $i + $(i + 1) * $(i + 1) + $(i + 2) * $(i + 2))
        for (k = i; k < i + 3; k++) $k = sprintf("%.12g", $k / length_of) } print }'
}
unit 2 <pairs | pack >unit_floats
pack <pairs >long_floats
unit 1 <views | pack >view_floats
unit 1 <views5 | pack >view_floats5
unit 1 <views3 | pack >view_floats3
# floats RELATIVE FIELDS FILE OPTIONS...: each field of -ff is this close to what -fd says, or below what a float can hold.
floats() {
    local relative=$1 fields=$2 file=$3
    shift 3
    "$brdfeval" -ff "$@" <"$file" | od -An -v -w$((4 * fields)) -tfF >single
    "$brdfeval" -ffd "$@" <"$file" | od -An -v -w$((8 * fields)) -tfD | paste single - | awk -v n="$fields" -v relative="$relative" '
        { for (i = 1; i <= n; i++) {
            got = $i + 0; want = $(i + n) + 0; d = got - want; if (d < 0) d = -d; size = want < 0 ? -want : want
            if (d > relative * size + 1e-37 && size < 3e38) { print NR, i, got, want; wrong = 1 } } }
        END { exit wrong || NR == 0 }'
}
check "floats: all fields, unit vectors" floats 2e-6 6 unit_floats -ax .2 -ay .3 -o fcpwPW
# Rounding when they are normalised moves directions by 6e-8, which the exponent, up to 87, magnifies.
check "floats: vectors of other lengths" floats 2e-5 6 long_floats -ax .2 -ay .3 -o fcpwPW
check "floats: both reflectances" floats 2e-6 2 unit_floats -a .4 -rs .5 -rd .25 -o fc
check "floats: Ward's sampling" floats 1e-5 5 view_floats5 -q sample -a .3
check "floats: paired sampling" floats 1e-5 5 view_floats -q pair -a .3
check "floats: albedo" floats 1e-7 2 view_floats3 -q albedo -a .3 -o aA
check "floats: one field is the same among others" sh -c "'$brdfeval' -ff -o fcw <long_floats | od -An -v -w12 -tx4 | awk '{ print \$3 }' >third
    '$brdfeval' -ff -o w <long_floats | od -An -v -w4 -tx4 | awk '{ print \$1 }' | cmp - third"
"${PYTHON:-python3}" -c 'import array, sys
a = array.array("f", open("long_floats", "rb").read())
for i in range(0, len(a), 6): a[i:i + 6] = a[i + 3:i + 6] + a[i:i + 3]
a.tofile(sys.stdout.buffer)' >exchanged_floats
"$brdfeval" -ff -ax .2 -ay .3 <long_floats >there
check "floats: exchanged directions give the same bits" sh -c "'$brdfeval' -ff -ax .2 -ay .3 <exchanged_floats | cmp - there"
for n in 2 3 4; do
    check "floats: one thread and $n" sh -c "'$brdfeval' -n $n -ff -ax .2 -ay .3 <long_floats | cmp - there"
done
check "floats: with -x" sh -c "'$brdfeval' -n 2 -x 3 -ff -ax .2 -ay .3 <long_floats | cmp - there"
# A record that has to be mended does not change its neighbours.
{ head -c 2400 unit_floats; head -c 24 long_floats; tail -c +2401 unit_floats; } >mixed_floats
check "floats: a long vector among unit vectors" sh -c "'$brdfeval' -ff <mixed_floats >mixed; '$brdfeval' -ff <unit_floats >unmixed
    { head -c 400 mixed; tail -c +405 mixed; } | cmp - unmixed"
echo 0 0 1 0 0 1 | pack | "$brdfeval" -ff >upright
for length in 1.0000009 1.0000012; do echo 0 0 $length 0 0 1 | pack | "$brdfeval" -ff >"upright $length"; done
check "floats: lengths off by rounding are left alone" sh -c "! cmp -s 'upright 1.0000009' upright"
check "... others not" cmp "upright 1.0000012" upright
check "floats: directions in degrees" floats 1e-7 1 unit_floats --angles -q albedo -rs 0 -rd .5

# The same bytes, whatever the threads and the flush interval.
for query in "eval -o fcpwPW:pairs" "sample:views5" "pair:views" "albedo:views3"; do
    for n in 1 2 5; do "$brdfeval" -q ${query%:*} -n $n -ax .2 -ay .4 <"${query#*:}" >n$n; done
    check "-q ${query%%[ :]*}: one thread and two" cmp n1 n2
    check "-q ${query%%[ :]*}: one thread and five" cmp n1 n5
    "$brdfeval" -q ${query%:*} -n 2 -x 3 -ax .2 -ay .4 <"${query#*:}" >x3
    check "-q ${query%%[ :]*}: with -x" cmp n1 x3
    check "-q ${query%%[ :]*}: an answer a record" test "$(wc -l <n1)" -eq "$(wc -l <"${query#*:}")"
done

# Header.
"$brdfeval" -h -ofc </dev/null >header
check "header: the first line" test "$(head -1 header)" = "#?RADIANCE"
check "header: ASCII" grep -qx 'FORMAT=ascii' header
check "header: how many numbers" grep -qx 'NCOMP=2' header
check "header: ends with an empty line" test -z "$(tail -1 header)"
check "header: the command line" grep -q 'brdfeval -h -ofc$' header
"$brdfeval" -h -fad -q pair </dev/null >header
check "header: doubles" grep -qx 'FORMAT=double' header
check "header: five numbers" grep -qx 'NCOMP=5' header
"$brdfeval" -h -fad -q albedo -oaAa </dev/null >header
check "header: fields of albedo" grep -qx 'NCOMP=3' header
"$brdfeval" -h+ -faf </dev/null >header
check "header: floats" grep -qx 'FORMAT=float' header
check "header: order of bytes" grep -qx 'BigEndian=0' header
check "no header without -h" test -z "$("$brdfeval" </dev/null)"

# An interactive client is answered before it sends more.
check "answers come before the next record is sent" bash -c '
    coproc '"$brdfeval"'
    for i in 1 2 3; do
        echo ".6 0 .8 -.6 0 .8" >&${COPROC[1]}
        read -t 20 answer <&${COPROC[0]} || exit 1
        [[ $answer = 12.43397* ]] || exit 1
    done'

# Bad records: what was answered stays.
fails "a word in a record" 1 "record 2" "${mirror}0 0 x 0 0 1\n" "$brdfeval"
check "... with the answers before it" test "$(wc -l <out)" -eq 1
fails "nan" 1 "record 1" "0 0 nan 0 0 1\n" "$brdfeval"
fails "inf" 1 "record 3" "$mirror${mirror}0 0 1 0 0 inf\n" "$brdfeval"
check "... with the answers before it" test "$(wc -l <out)" -eq 2
fails "a number too large" 1 "record 1" "0 0 1e999 0 0 1\n" "$brdfeval"
fails "a record cut short" 1 "record 2" "${mirror}0 0 1" "$brdfeval"
fails "numbers behind the last record" 1 "record 2 is cut short" "${mirror}1\n" "$brdfeval"
fails "a record in doubles cut short" 1 "record 1" "abcdefg" "$brdfeval" -fd
fails "a float that is not finite" 1 "record 1" '\0377\0377\0377\0377\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0' "$brdfeval" -ff
fails "a light without direction" 1 "record 2: the direction to the light is zero" "${mirror}0 0 0 0 0 1\n" "$brdfeval"
check "... with the answers before it" test "$(wc -l <out)" -eq 1
fails "a viewer without direction" 1 "record 1: the direction to the viewer is zero" "0 0 1 0 0 0\n" "$brdfeval"
fails "a sample's viewer without direction" 1 "record 1: the direction to the viewer is zero" "0 0 0 .1 .2\n" "$brdfeval" -q sample
fails "s of 1" 1 "record 2: s is 1" "0 0 1 .1 .2\n0 0 1 1 .2\n" "$brdfeval" -q sample
check "... with the answers before it" test "$(wc -l <out)" -eq 1
fails "t below 0" 1 "record 1: t is -0.1" "0 0 1 .1 -.1\n" "$brdfeval" -q sample
fails "u of 2" 1 "record 1: u is 2" "0 0 1 .1 .1 2\n" "$brdfeval" -q pair
while read -r angle at record; do
    fails "$at of $angle degrees" 1 "record 2: ${at/-/ of the } is $angle, but has to be between -360 and 360 degrees" \
        "0 0 0 0\n$record\n0 0 0 0\n" "$brdfeval" --angles
    check "... with the record before answered" test "$(wc -l <out)" -eq 1
done <<'END'
360.0001 theta-light 360.0001 0 0 0
-361 phi-light 0 -361 0 0
1e+308 theta-viewer 0 0 1e308 0
-1e+308 phi-viewer 360 360 -360 -1e308
END
fails "a sample's viewer beyond 360 degrees" 1 "record 1: theta of the viewer is 400" "400 0 .1 .2 .3\n" "$brdfeval" -q pair --angles
fails "... behind a record with a bad random number" 1 "record 1: s is 2" "0 0 2 0\n400 0 0 0\n" "$brdfeval" -q sample --angles
fails "... after an answer in doubles" 1 "record 2: phi of the viewer is 720" \
    '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0200\0206\0100' "$brdfeval" -q albedo --angles -fda
fails "floats: a light without direction" 1 "record 2: the direction to the light is zero" \
    "$(printf '\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0200\\077%.0s' 1 2)$(printf '\\0%.0s' {1..24})" "$brdfeval" -ff
check "... with the answers before it" test "$(wc -c <out)" -eq 4
# not_finite FIELDS INPUT OPTIONS...: the first number of 300 that is not finite is found, wherever it stands and whatever it is.
not_finite() {
    "${PYTHON:-python3}" - "$@" <<'END'
import array, os, subprocess, sys
fields, file, options = int(sys.argv[1]), sys.argv[2], sys.argv[3:]
good = array.array("f", open(file, "rb").read(300 * fields * 4))
for index in range(fields):
    for record, value in ((0, float("nan")), (299, float("-inf")), (257, float("inf")), (100, float("nan"))):
        bad = good[:]
        bad[record * fields + index] = value
        if record == 100: # the first of several in this record and the next, and more than that is wrong with it
            for k in range(index + 1, 2 * fields):
                bad[record * fields + k] = float("inf")
            for k in range(index):
                bad[record * fields + k] = 0
        run = subprocess.run([os.environ["BIN"] + "/brdfeval", "-ff", "-o", "p", *options], input=bad.tobytes(),
                             capture_output=True)
        said = f"record {record + 1}: its number {index + 1} is not finite"
        if run.returncode != 1 or said not in run.stderr.decode() or len(run.stdout) != 4 * record:
            sys.exit(f"{said}, not: {run.stderr}, {len(run.stdout)} bytes")
END
}
check "floats: numbers that are not finite" not_finite 6 unit_floats
check "... of directions that have to be normalised" not_finite 6 long_floats
check "... of samples" not_finite 5 view_floats5 -q sample
check "... of pairs, on three threads" not_finite 6 view_floats -q pair -o P -n 3
fails "floats: a record cut short" 1 "record 1" "abcdefgh" "$brdfeval" -ff
{ seq 1000 | sed "s/.*/.6 0 .8 -.6 0 .8/"; echo 0 0 0 0 0 1; seq 1000 | sed "s/.*/.6 0 .8 -.6 0 .8/"; } >late
for n in 1 4; do
    "$brdfeval" -n $n <late >out 2>err
    check "a bad record far down, -n $n" test "$? $(wc -l <out) $(grep -c 'record 1001:' err)" = "1 1000 1"
done
fails "more numbers in a line are the next record's" 1 "record 3 is cut short" "0 0 1 0 0 1 .5\n0 0 1 0 0 1 .5\n" "$brdfeval"
check "... in one stream" test "$(wc -l <out)" -eq 2

# Bad options.
fails "an unknown model" 1 "'phong'" "" "$brdfeval" -m phong
fails "an unknown query" 1 "'what'" "" "$brdfeval" -q what
fails "an unknown field" 1 "'x'" "" "$brdfeval" -o fx
fails "a field of another query" 1 "-q albedo has no field 'f'; its fields: aA" "" "$brdfeval" -q albedo -o f
fails "65 fields" 1 "-o: expected 1 to 64" "" "$brdfeval" -o "$(printf 'f%.0s' {1..65})"
fails "the mean of a grid" 1 "--grid does not go with it" "" "$brdfeval" -q mean --grid tv=0
fails "the mean in degrees" 1 "--angles does not go with it" "" "$brdfeval" -q mean --angles
fails "no field" 1 "-o" "" "$brdfeval" -o ""
fails "an unknown format" 1 "-fx" "" "$brdfeval" -fx
fails "three formats" 1 "-fafd" "" "$brdfeval" -fafd
fails "roughness 0" 1 "-a" "" "$brdfeval" -a 0
fails "roughness 0 along x" 1 "-ax" "" "$brdfeval" -ax 0
fails "too large a roughness" 1 "-ay" "" "$brdfeval" -ay 11
fails "roughness in words" 1 "'rough'" "" "$brdfeval" -a rough
fails "a roughness missing" 1 "-a" "" "$brdfeval" -a
fails "a reflectance above 1" 1 "-rs" "" "$brdfeval" -rs 1.5
fails "a reflectance below 0" 1 "-rd" "" "$brdfeval" -rd -.1
fails "no reflectance" 1 "'nothing'" "" "$brdfeval" -rd
fails "a longer name" 1 "-axe" "" "$brdfeval" -axe 1
fails "an unknown option" 1 "-abc" "" "$brdfeval" -abc 1
fails "no threads" 1 "-n" "" "$brdfeval" -n 0
fails "an operand" 1 "'file'" "" "$brdfeval" file
fails "a missing option file" 1 "nowhere" "" "$brdfeval" @nowhere

# What every tool has.
"$brdfeval" -m ward -a .3 -ay .2 -rs .6 -rd .1 -q pair -o zP --angles -fad -h -x 7 -n 3 -defaults >defaults
sed 's/#.*//' defaults >reread
check "defaults can be read again" sh -c "'$brdfeval' @reread -defaults | cmp - defaults"
check "... and are not the default's" sh -c "! '$brdfeval' -defaults | cmp -s - defaults"
for given in "" "-q albedo" "-q sample -o zx" "-M file.rad name" "-q mean -M !cat\ a\ b it's" "--grid tl=0:1/3,tv=5 --npy"; do
    printf '%s\n' "$given" | sed "s/'/\\\\'/g" >given
    "$brdfeval" @given -defaults >defaults
    sed 's/\t#.*//' defaults >reread
    check "defaults of '$(echo "$given" | tr -d '#')' can be read again" sh -c "'$brdfeval' @reread -defaults | cmp - defaults"
done
# ... whatever words they hold.
quoted() { echo "'$(printf '%s' "$1" | sed "s/'/'\\\\''/g")'"; }
long=$(printf '%9000s' '' | tr ' ' x)
for word in @here '$THERE' $'two\nlines' $'a\rb\tc' "it's" 'a "b" \' '#x' "" @ "$long"; do
    echo "-M $(quoted "$word") $(quoted "$word") -n 2" >given
    "$brdfeval" @given -defaults >defaults
    check "... with '$(echo "${word:0:20}" | tr '\n\r\t#' '    ')'" sh -c "'$brdfeval' @defaults -defaults | cmp - defaults"
    "$brdfeval" @given 2>given_err
    "$brdfeval" @defaults 2>err
    check "... which are the same words" sh -c "cmp given_err err && grep -q 'cannot open' err"
done
check "--help names the options" sh -c "'$brdfeval' --help | grep -q -- --angles"
check "--version" sh -c "'$brdfeval' --version | grep -q '^[^ ]* *[0-9Gr]'"
export ROUGH="-a .2 -rs 1"
check "options from the environment" test "$(printf "$mirror" | "$brdfeval" '$ROUGH')" = "$(printf "$mirror" | "$brdfeval" -a .2)"

# Bad output.
if [ -w /dev/full ]; then
    "$brdfeval" <pairs >/dev/full 2>err
    check "a full disk" test $? -eq 2
    check "... says so" grep -q "No space" err
fi
(for i in $(seq 50); do cat pairs; done | "$brdfeval" -o fcpwPW 2>err; echo "${PIPESTATUS[1]}" >status) | head -1 >/dev/null
check "a closed pipe" test "$(cat status)" -eq 2
plan
