#!/bin/bash
# brdfeval -M: reflectance in RGB from the materials of scene files, against numbers worked out by hand and against the options
# that mean the same. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
brdfeval=$BIN/brdfeval

cat >scene.rad <<'EOF'
# Some materials, and what is none.
void plastic red 0 0 5 .5 .1 .1 .05 .1
void metal2 brushed 4 0 1 0 . 0 6 .8 .6 .4 .9 .05 .2
void metal2 turned 6 0 1 0 . -rx 30 0 6 .8 .6 .4 .9 .05 .2
void plastic2 white 4 1 0 0 . 0 6 1 1 1 .5 .05 .2
void metal2 astray 4 0 0 0 . 0 6 1 1 1 .5 .3 .4
void plastic matte 0 0 5 .8 .6 .4 0 0
void metal black 0 0 5 0 0 0 .9 0
void metal chrome 0 0 5 .8 .8 .8 .9 .001
void metal nearly 0 0 5 .8 .8 .8 .9 .0011
void plastic bright 0 0 5 1e200 .5 .5 .5 .2
void plastic twice 0 0 5 .9 .9 .9 .05 .1
void alias scarlet red
inherit alias crimson scarlet
void brightfunc stripes 2 x . 0 0
stripes plastic striped 0 0 5 .5 .1 .1 .05 .1
stripes alias painted red
void light lamp 0 0 3 1 1 1
void mist pane 0 0 0
red polygon floor 0 0 9 0 0 0 1 0 0 0 1 0
red polygon twice 0 0 9 0 0 0 1 0 0 0 1 0
void plastic twice 0 0 5 .5 .1 .1 .05 .1
void metal glaring 0 0 5 1.7e308 1e308 1 .9 .2
EOF
mirror=".6 0 .8 -.6 0 .8\n"

# prints NAME EXPECTED INPUT ARGUMENTS...: the answers are these numbers, each within a millionth
prints() {
    local name=$1 expected=$2 input=$3
    shift 3
    printf '%b' "$input" | "$brdfeval" "$@" >out 2>err
    local got=$?
    [ $got -eq 0 ] && [ ! -s err ] && awk -v want="$expected" '
        { for (i = 1; i <= NF; i++) got[++n] = $i }
        END {
            if (split(want, w) != n) exit 1
            for (i = 1; i <= n; i++) { d = got[i] - w[i]; if (d < 0) d = -d; if (d > 1e-6 * (w[i] < 0 ? -w[i] : w[i])) exit 1 }
        }' out
    local status=$?
    echo "expected $expected, exit status $got" >>err
    result $status "$name" out err
}

# In the mirror direction the lobe is 1/(4 pi ax ay .64); its weights are 1, and so are densities lobe x .8.
prints "plastic: the lobe is white" ".7728962 .6519384 .6519384" "$mirror" -M scene.rad red
prints "metal2: both parts are coloured" "8.9779303 6.7334478 4.4889652" "$mirror" -M scene.rad brushed
prints "all fields" "8.9779303 6.7334478 4.4889652 7.1823443 5.3867582 3.5911721 9.9471839 .72 .54 .36 9.9471839 .72 .54 .36" \
    "$mirror" -M scene.rad brushed -o fcpwPW
prints "another model" "0.02750546 0.02062909 0.01375273" ".8 0 .6 -.6 0 .8\n" -M scene.rad brushed -m ward-neumann -o f
prints "Ward's sampling" "-.6 0 .8 9.9471839 .72 .54 .36" ".6 0 .8 0 .3\n" -M scene.rad brushed -q sample
prints "paired sampling, two fields" ".05 .05 .05 .8" ".6 0 .8 0 .3 0\n" -M scene.rad red -q pair -o Wz
prints "albedo: .475, .095 and .095, and .05 of .99" ".5245 .1445 .1445 1" "0 0 1\n" -M scene.rad red -q albedo -oaA
prints "no lobe" ".2546479 .1909859 .1273240 0 0 0" "$mirror" -M scene.rad matte -o fw
prints "neither part" "0 0 0" "$mirror" -M scene.rad black
prints "below the surface" "0 0 0" "0 0 -1 0 0 1\n" -M scene.rad red
prints "an alias" ".7728962 .6519384 .6519384" "$mirror" -M scene.rad scarlet
prints "an alias of an alias" ".7728962 .6519384 .6519384" "$mirror" -M scene.rad crimson
prints "the last of a name counts, among materials" ".7728962 .6519384 .6519384" "$mirror" -M scene.rad twice
prints "a command" ".05 .05 .05" "$mirror" -M "!cat scene.rad" red -o w
prints "-m after -M" "0.02750546 0.02062909 0.01375273" ".8 0 .6 -.6 0 .8\n" -M scene.rad brushed -o f -m ward-neumann

# The same bits as from options.
awk 'BEGIN { srand(3); for (i = 0; i < 500; i++) printf "%.17g %.17g %.17g %.17g %.17g %.17g\n",
    rand() - .5, rand() - .5, rand() / 2, rand() - .5, rand() - .5, rand() / 2 }' >pairs
"$brdfeval" -ax .05 -ay .2 -rs .5 -rd .5 -o fcpwPW <pairs >options
"$brdfeval" -M scene.rad white -o fcpwPW <pairs | awk -v OFS='\t' '{ print $1, $4, $7, $8, $11, $12, "" }' >material
check "white plastic2 is what options say, along x and y" cmp options material
"$brdfeval" -M scene.rad white -o fcw <pairs | awk '!($1 == $2 && $2 == $3 && $4 == $5 && $5 == $6 && $7 == $8 && $8 == $9) { wrong = 1 } END { exit wrong || NR != 500 }'
result $? "... in all three colours"
"$brdfeval" -M scene.rad brushed <pairs >brushed
check "the orientation does not matter where there is no surface" sh -c "'$brdfeval' -M scene.rad turned <pairs | cmp - brushed"
for n in 1 3; do "$brdfeval" -M scene.rad brushed -faf -o fW -n $n <pairs >floats$n; done
check "six floats a record" test "$(wc -c <floats1)" -eq 12000
check "... on any number of threads" cmp floats1 floats3
check "the header counts numbers, not letters" sh -c "'$brdfeval' -h -M scene.rad red -o fpW </dev/null | grep -x NCOMP=7"
"$brdfeval" -M scene.rad white -q mean >mean
check "the mean albedo" sh -c "'$brdfeval' -q mean -ax .05 -ay .2 -rs .5 -rd .5 | awk '{ print \$1, \$1, \$1 }' OFS='\t' ORS='\t\n' | cmp - mean"
check "a scene on standard input, where that is free" sh -c "'$brdfeval' -M - white -q mean <scene.rad | cmp - mean"

cp pairs recordsa
"${PYTHON:-python3}" -c 'import array, sys; array.array("f", map(float, sys.stdin.read().split())).tofile(sys.stdout.buffer)' <pairs >recordsf
# Colours beyond all bounds stay finite numbers.
"$brdfeval" -M scene.rad bright -faf -o fc <pairs 2>err | od -An -v -tfF >out
check "a number too large is the largest number" grep -q 3.4028235e+38 out
check "... never an infinity" sh -c "! grep -qiE 'inf|nan' out"
check "a colour above 1 is warned of" grep -q "^brdfeval: warning: scene.rad:11:1: plastic bright: unphysical" err
for format in -fad -ffd; do
    "$brdfeval" -M scene.rad glaring $format -o fcW <records${format:2:1} 2>err | od -An -v -tfD | tr -s ' \n' '\n' >out
    check "... of doubles, $format" grep -q 1.797693134862315 out
    check "... for value, cosine and weight" sh -c "! grep -qiE 'inf|nan' out"
done
"$brdfeval" -M scene.rad glaring -ff -o fcW <recordsf 2>err | od -An -v -tfF | tr -s ' \n' '\n' >out
check "... of floats, -ff" grep -q 3.4028235e+38 out
check "... for value, cosine and weight" sh -c "! grep -qiE 'inf|nan' out"
printf "$mirror" | "$brdfeval" -M scene.rad astray >out 2>err
check "an orientation that is null is warned of" grep -q "warning: scene.rad:6:1: metal2 astray: its orientation vector is null" err
check "... and makes the lobe isotropic" sh -c "printf '$mirror' | '$brdfeval' -a 0.35355339059327379 -rs .5 -rd .5 | awk '{ print \$1, \$1, \$1 }' OFS='\t' ORS='\t\n' | cmp - out"
check "a roughness above the mirrors'" sh -c "echo 0 0 1 0 0 1 | '$brdfeval' -M scene.rad nearly"

# What is wrong is told with its place.
refuses() { fails "$1" 1 "$2" "$mirror" "$brdfeval" -M scene.rad "${@:3}"; }
refuses "a mirror" "scene.rad:9:1: metal chrome: is a mirror" chrome
refuses "densities of what is diffuse alone" "reflects nothing specularly: it has no lobe for 'P'" matte -o fwP
refuses "... samples" "no lobe for 'x'" matte -q sample
refuses "a lamp" "scene.rad:18:1: light lamp: shines" lamp
refuses "another type" "scene.rad:19:1: mist pane: mist is not supported yet" pane
refuses "a pattern" "scene.rad:15:1: brightfunc stripes: modifies plastic striped, which is not supported yet" striped
refuses "... through an alias" "scene.rad:15:1: brightfunc stripes: modifies plastic painted" painted
refuses "the pattern itself" "scene.rad:15:1: brightfunc stripes: brightfunc is not supported yet" stripes
refuses "a surface" "scene.rad:20:1: polygon floor: is a surface" floor
refuses "no such material" "scene.rad: there is no material 'blue'; it has glaring, twice, pane, lamp, painted" blue
fails "a scene without materials" 1 "empty.rad: there is no material 'red'" "" sh -c ": >empty.rad; '$brdfeval' -M empty.rad red"
{ for i in {1..100}; do echo "void plastic material_number_$i 0 0 5 1 1 1 0 0"; done; } >long.rad
fails "of very many materials some are named" 1 "material_number_100, material_number_99" "" "$brdfeval" -M long.rad red
echo "void plastic red 0 0 4 .5 .1 .1 .05" >short.rad
fails "a wrong number of arguments" 1 "short.rad:1:1: plastic red: 4 real arguments, but it needs 5" "" "$brdfeval" -M short.rad red
echo "void plastik red" >wrong.rad
fails "a scene that cannot be read" 1 "wrong.rad:1:" "" "$brdfeval" -M wrong.rad red
fails "no such file" 1 "nowhere.rad" "" "$brdfeval" -M nowhere.rad red
fails "a directory" 1 "Is a directory" "" "$brdfeval" -M . red
fails "a name missing" 1 "-M: expected a scene file, and the name of a material in it" "" "$brdfeval" -M scene.rad
fails "a longer name" 1 "'-Mx'" "" "$brdfeval" -Mx scene.rad red
fails "a scene and records on standard input" 1 "-M: the file cannot be '-'" "" "$brdfeval" -M - red
for option in "-a .2" "-ax .2" "-ay .2" "-rs .5" "-rd 0"; do
    # shellcheck disable=SC2086
    refuses "with ${option% *} behind it" "${option% *} does not go with it" red $option
done
fails "with -a before it" 1 "-a does not go with it" "" "$brdfeval" -a .1 -M scene.rad red
plan
