#!/bin/bash
# Radiance's options one by one: those that do something, those that do nothing and say so in the manual, those refused. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
gtrace=$BIN/gtrace

cat >room.rad <<'END_OF_SCENE'
void metal2 shiny 4 1 1 0 . 0 6 .6 .6 .6 .8 .1 .2
void plastic grey 0 0 5 .5 .4 .3 0 0
void alias dull grey
shiny polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
dull polygon wall 0 0 12 -9 9 0 9 9 0 9 9 9 -9 9 9
void light white 0 0 3 9 9 9
white sphere lamp 0 0 4 0 3 2 .3
void glow dusk 0 0 4 .3 .2 .6 0
dusk source sky 0 0 4 0 0 1 180
END_OF_SCENE
for i in $(seq 20); do echo "0 $((i % 7 - 3)) 1 .$i 1 -.5"; done >rays
echo "0 0 2 0 1 0" >>rays
ask() { "$gtrace" -h --samples 16 "$@" room.rad <rays; }
ask >plain

# same OPTION...: accepted, without a word, and without effect.
same() { quiet "$* changes nothing" same_bytes "$@"; }
same_bytes() { ask "$@" >answers && cmp answers plain; }
# other OPTION...: accepted, without a word, with effect.
other() { quiet "$* has an effect" other_bytes "$@"; }
other_bytes() { ask "$@" >answers && ! cmp -s answers plain; }

for option in "-aa .1" "-ar 256" "-as 64" "-ad 64" "-aw 8" "-af nowhere.amb" "-ap nowhere.pm" "-ap nowhere.pm 40" "-ap nowhere.pm 40 50" \
    "-am 1.5" "-ac 4" "-aC 1M" "-dt .1" "-dc .5" "-dj .9" "-ds .2" "-dr 1" "-dp 256" "-ss 4" "-u" "-u+" "-u-" "-me 0 0 0" "-ma .5 .5 .5" \
    "-mg .8" "-ms 1" "-cs 3" "-cs 20" "-cw 380 780" "-co" "-co+" "-pRGB" "-P control" "-PP control" "-e A:1" "-e f(x)=x" \
    "-n 3" "-w" "-x 1" "-ti shiny"; do
    # shellcheck disable=SC2086
    same $option
done
for option in "-ab 1" "-av .1 .1 .1" "-i" "-I" "-ld -ov" "-dv- -ov" "-lr 1 -ab 1" "-pY" "-orv" "-otv"; do
    # shellcheck disable=SC2086
    other $option
done
check "-n is not kept from being 0" bash -c '! '"$gtrace"' -n 0 room.rad </dev/null 2>/dev/null'
check "no server is left, and no file of it" test ! -e control

fails "an albedo above 1" 1 "-ma" "" "$gtrace" -ma 1 2 1 room.rad
fails "spectra" 1 "spectra are not supported" "" "$gtrace" -co+ -cs 20 room.rad
fails "a wavelength that is none" 1 "'red'" "" "$gtrace" -cw 380 red room.rad
fails "-P without its file" 1 "'-P'" "" "$gtrace" -P
fails "-PQ" 1 "'-PQ'" "" "$gtrace" -PQ control room.rad
fails "-f without its file" 1 "'-f'" "" "$gtrace" -f
fails "-e without its word" 1 "'-e'" "" "$gtrace" -e
fails "-e with an empty one" 1 "option '-e' has an empty argument" "" "$gtrace" -e '' room.rad
fails "-f with an empty one" 1 "option '-f' has an empty argument" "" "$gtrace" -f '' room.rad

# What real clients say.
down="0 0 1 0 0 -1\n"
client() { quiet "$1" client_runs "${@:2}"; }
client_runs() { printf '%b' "$down" | "$gtrace" "$@" room.rad >answers && [ "$(wc -l <answers)" -eq 1 ]; }
client "bifacial_radiance" -i -ab 2 -aa .1 -ar 256 -ad 2048 -as 256 -h -oovs
client "... with high accuracy" -i -ab 5 -aa .08 -ar 512 -ad 2048 -as 512 -h -oovs
check "... which reads origin, value and name by column" grep -qE '^([-+.0-9e]+	){6}floor	$' answers
client "honeybee-radiance" -I -h -ab 2 -ad 5000 -lw 2e-05 -aa 0.1 -ar 300 -as 16 -dc .75 -dj .5 -dp 512 -dr 0 -ds .25 -dt .25 -lr 6 -ss .7 -st .5
printf '%b' "$down" | "$gtrace" -h -faf -ood room.rad >ray.float
quiet "pyradiance: floats, a header, many processes" sh -c "'$gtrace' -ff -h+ -ab 1 -n 4 room.rad <ray.float | tail -c 12 | od -An -tf4 | grep -q '[0-9]'"
quiet "bifacial_radiance's picture" sh -c "'$BIN/gpict' -dp 256 -ar 48 -ms 1 -ds .2 -dj .9 -dt .1 -x 4 -y 4 -vp 0 0 1 -i room.rad >picture.hdr"

# Definitions for function files. What they give is what rtrace gives.
mkdir -p library
echo 'bright = 5*other;' >library/own.cal
echo 'other = 2*Dz;' >library/outer.cal
for file in . own.cal; do
    printf 'void brightfunc p 2 bright %s 0 0\np glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 360\n' "$file" >"by_$file.rad"
done
# defined VALUE FILE OPTION...: the value that the scene with that function file has with the options.
defined() { check "${*:3}: ${2/#./no file} gives $1" defined_gives "$@"; }
defined_gives() { RAYPATH=:library "$gtrace" -h -w- -pA "${@:3}" "by_$2.rad" <<<"0 0 0 0 0 1" >answers; test "$(<answers)" = "$(printf '%e\t' "$1")"; }
defined 3 . -e bright=3
defined 6 . -e 'b(x) : 2*x; bright = b(3)'
defined 2 . -f outer.cal -e bright=other
defined 2 . -f outer.cal -e bright:2
defined 9 . -e bright=3 -e bright=9
defined 2 . -e bright=7 -e other=4 -f outer.cal -e bright=other
defined 4 . -f outer.cal -e bright=other -e other=4
defined 8 . -e A1=8 -e bright=A1
defined 10 own.cal -f outer.cal
defined 10 own.cal -f outer.cal -e bright=7
defined 35 own.cal -e 'other`own=7' -e other=1
unset -f defined
fails "a definition that is none" 1 "-e bright=:1:8: the expression ends too early" "" "$gtrace" -e x=1 -e bright= by_..rad
fails "... also where nothing needs it" 1 "-e x=:1:3" "" "$gtrace" -e x= room.rad
fails "a name that is still not defined" 1 "there is no variable other" "" env RAYPATH=:library "$gtrace" -e 'other`else=1' by_own.cal.rad
fails "a function file that is not there" 1 "no function file nowhere.cal" "" "$gtrace" -f nowhere.cal room.rad
printf 'a = 1;\n= 2;\n' >wrong.cal
fails "a function file with a mistake" 1 "wrong.cal:2:1" "" "$gtrace" -f wrong.cal room.rad
RAYPATH=:library "$gtrace" -h -f outer.cal -e 'A1=8' by_own.cal.rad </dev/null 2>&1 | grep -q "warning: -e A1=8:1:1: 'A1' is defined again"
result $? "a name that all scenes have gets a warning"

# Modifiers that interreflection leaves out or is for.
ambient() { echo "0 0 1 0 1 .5" | "$gtrace" -h --samples 64 -ab 1 -av .1 .1 .1 "$@" room.rad; }
left_out=$(ambient -ab 0)
check "-ae leaves a modifier out" test "$(ambient -ae dull)" = "$left_out"
check "... by its own name, not by its material's" test "$(ambient -ae shiny -ae white)" = "$(ambient)"
check "-ai takes one alone" test "$(ambient -ai shiny)" = "$left_out"
check "... or several" test "$(ambient -ai shiny -ai dull)" = "$(ambient)"
printf 'shiny\n\tdull ' >list
check "-aE names a file of them" test "$(ambient -aE list)" = "$left_out"
check "-aI, too" test "$(ambient -aI list)" = "$(ambient)"
mkdir -p library && printf 'dull' >library/far.list
check "... along RAYPATH" test "$(RAYPATH=:$PWD/library ambient -aE far.list)" = "$left_out"
ambient -ae nobody 2>&1 >/dev/null | grep -q "'nobody'"
result $? "a modifier that is not there gets a warning"
fails "some left out and some alone" 1 "not both" "" "$gtrace" -ae dull -ai shiny room.rad
fails "a file that is not there" 1 "nowhere" "" "$gtrace" -aE nowhere room.rad
: >empty
check "a file without names excludes nothing" test "$(ambient -aE empty 2>err)" = "$(ambient)"
check "... with a warning" grep -q "warning: empty: no modifier" err
check "... and includes nothing" test "$(ambient -aI empty 2>err)" = "$left_out"
check "... which -defaults knows" test "$("$gtrace" -aI empty -te x -defaults 2>err | grep '^-[at][eEiI]' | cut -f 1 | tr '\n' ' ')" = "-te x -aI /dev/null "
fails "... and not with others" 1 "not both" "" "$gtrace" -aI empty -ae dull room.rad
fails "-ae without a name" 1 "'-ae'" "" "$gtrace" -ae

# Colors.
value() { echo "0 0 2 0 1 0" | "$gtrace" -h "$@" room.rad; }
check "-pY: one number, in lumens" test "$(value -pY)" = "$(printf '1.611000e+03\t')"
check "-pA: the mean" test "$(value -pA)" = "$(printf '9.000000e+00\t')"
check "-pXYZ" test "$(value -pXYZ)" = "$(printf '1.611000e+03\t1.611000e+03\t1.611000e+03\t')"
check "-pc of other primaries leaves white alone" test "$(value -pc .7 .3 .2 .7 .15 .05 .3127 .3290)" = "$(value)"
check "nothing is negative outside the primaries" bash -c "! echo '0 0 1 0 0 1' | '$gtrace' -h -pc .35 .33 .33 .35 .32 .32 .3333 .3333 room.rad | grep -q -- '-[0-9.]*e'"
check "an error is told in the same color" test "$(echo "0 0 2 0 1 -1" | "$gtrace" -h -pY -oe --samples 16 room.rad | wc -w)" -eq 1
"$gtrace" -pXYZ room.rad </dev/null >header
check "the header tells primaries" grep -q '^PRIMARIES= 1 0 0 1 0 0 0.333333 0.333333$' header
check "... and counts the numbers" grep -q '^NCOMP=2$' <("$gtrace" -pY -ove room.rad </dev/null)
check "four-byte XYZ says so" grep -q '^FORMAT=32-bit_rle_xyze$' <("$gtrace" -fac -pXYZ room.rad </dev/null)
fails "four bytes of one number" 1 "one number" "" "$gtrace" -fac -pY room.rad
fails "unknown colors" 1 "'-pQ'" "" "$gtrace" -pQ room.rad
fails "too few chromaticities" 1 "8 numbers" "" "$gtrace" -pc .64 .33 room.rad
fails "primaries without colors" 1 "no colors" "" "$gtrace" -pc 0 0 0 0 0 0 0 0 room.rad

# Mirrors.
cat >mirror.rad <<'END_OF_SCENE'
void metal mirror 0 0 5 1 1 1 1 0
void light white 0 0 3 9 9 9
mirror polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
white ring lamp 0 0 8 0 4 3 0 0 -1 0 1
END_OF_SCENE
check "lengths and values by way of a mirror" test "$(echo "0 -4 3 0 4 -3" | "$gtrace" -h -olLRXrx mirror.rad)" = \
    "$(printf '1.000000e+01\t5.000000e+00\t1.000000e+01\t5.000000e+00\t9.000000e+00\t9.000000e+00\t9.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t')"
check "four-byte colors of what a mirror shows" cmp <(echo "0 -4 3 0 4 -3" | "$gtrace" -h -fac -or mirror.rad) <(echo "0 -4 3 0 4 -3" | "$gtrace" -h -fac mirror.rad)
check "... and of the rest" test "$(echo "0 -4 3 0 4 -3" | "$gtrace" -h -fac -ox mirror.rad | od -An -tx1)" = " 00 00 00 00"
echo "0 -4 3 0 4 -3" | "$gtrace" -h -i -orx mirror.rad 2>&1 >answer | grep -q 'no mirrors'
result $? "-i has no mirrors, and says so"

# What a sensor has of a mirror is nothing, and its value is not counted twice for that.
check "-I with what mirrors show" test "$(value -I -orxv -w- | cut -f 1-3,4-6)" = "$(value -I -ovx -w- | awk '{ print "0.000000e+00\t0.000000e+00\t0.000000e+00\t" $4 "\t" $5 "\t" $6 }')"
check "... the value is the same" test "$(value -I -ovl -w- | cut -f 1-3)" = "$(value -I | cut -f 1-3)"

# A surface that is passed from behind is what was met; the light and the length seen are those of what is behind it.
cat >hidden.rad <<'END_OF_SCENE'
void plastic grey 0 0 5 .5 .5 .5 0 0
void glow lit 0 0 4 2 2 2 0
grey polygon sheet 0 0 12 -1 -1 1 1 -1 1 1 1 1 -1 1 1
lit polygon ceiling 0 0 12 -1 -1 3 -1 1 3 1 1 3 1 -1 3
END_OF_SCENE
cat >mixed.rad <<END
void texfunc lean 4 .3 .2 0 . 0 0
lean plastic leaning 0 0 5 .5 .5 .5 0 0
void plastic plain 0 0 5 .5 .5 .5 0 0
void mixfunc half 4 leaning plain .5 . 0 0
half ring plate 0 0 8 0 0 0 0 0 1 0 1
void mixfunc veil 4 lean plain .5 . 0 0
veil ring curtain 0 0 8 5 0 0 0 0 1 0 1
END
check "-on of a mixture is the same from both sides, without what shades nothing" test \
    "$(printf '%s\n' "0 0 1 0 0 -1" "0 0 -1 0 0 1" "5 0 1 0 0 -1" "5 0 -1 0 0 1" | "$gtrace" -h -on mixed.rad | awk '{ printf "%.3f %.3f %.3f ", $1, $2, $3 }')" = \
    "0.148 0.098 0.984 0.148 0.098 0.984 0.000 0.000 1.000 0.000 0.000 1.000 "
check "-bv-" test "$(echo "0 0 .5 0 0 1" | "$gtrace" -h -bv- -ovlXLsmpnN hidden.rad)" = \
    "$(printf '%e\t' 2 2 2 2.5 2.5 .5; printf 'sheet\tgrey\t'; printf '%e\t' 0 0 1 0 0 1 0 0 1)"
check "... without light" test "$(echo "0 0 .5 0 0 1" | "$gtrace" -h -bv- -oLs hidden.rad)" = "$(printf '%e\tsheet\t' .5)"

# Messages.
"$gtrace" -e messages -h -oV room.rad <rays >answers 2>err
check "-e: nothing on standard error" test ! -s err
check "... the answers are there" test "$(wc -l <answers)" -eq 21
check "... messages are in the file, below the command" bash -c "grep -q 'PID [0-9]*: .*gtrace -e messages -h -oV room.rad' messages && tail -n 1 messages | grep -q 'warning: -oV'"
fails "... and errors" 1 "" "" "$gtrace" -e messages nowhere.rad
check "... at its end" bash -c "tail -n 1 messages | grep -q 'error: .*nowhere.rad' && grep -q 'warning: -oV' messages"
fails "... a file that cannot be written" 1 "no/where" "" "$gtrace" -e no/where room.rad

# Features.
check "-features lists" grep -q '^OutputFormats=a,f,d,c$' <("$gtrace" -features)
check "-features checks" "$gtrace" -features PathTracing Outputs=v,e
check "... of scenes" "$gtrace" -features VirtualSources MaterialMixtures Instancing=TriangleMesh ScatteringModels=WGMD Antimatter ParticipatingMedia=Mist
check "... parts of one" test "$("$gtrace" -features InputFormats)" = InputFormats=a,f,d
fails "a feature that is not there" 1 "missing feature - TabulatedBSDFs" "" "$gtrace" -features PathTracing TabulatedBSDFs
fails "a part that is not there" 1 "missing feature - Outputs=v,q" "" "$gtrace" -features Outputs=v,q
fails "-features behind another option" 1 "first" "" "$gtrace" -w -features

# All that can be set is printed, and read again.
"$gtrace" -ae 'a b' -aE list -te x -tI list -pc .7 .3 .2 .7 .15 .05 .3127 .3290 -e log -fad -oTsV -me 0 0 0 -cs 20 -ac 3 -defaults >defaults 2>err
check "-te and -tI do not go together, with -defaults either" grep -q 'not both' err
"$gtrace" -ae 'a b' -aE list -ti x -tI list -pc .7 .3 .2 .7 .15 .05 .3127 .3290 -e log -e 'a = 1;b = 2' -f x.cal -e c:2 -fad -oTsV -me .1 .2 .3 -ma .5 .6 .7 -mg .5 -cs 20 -ac 3 -defaults >defaults
check "-defaults tells what was set" bash -c "grep -q \"^-ae 'a b' -ae shiny -ae dull\" defaults && grep -q '^-ti x -ti shiny -ti dull' defaults && grep -q '^-pc 0.7 0.3' defaults && grep -q \"^-e log -e 'a = 1;b = 2' -f x.cal -e c:2\" defaults"
check "... of mist" bash -c "grep -q '^-me 0.1 0.2 0.3' defaults && grep -q '^-ma 0.5 0.6 0.7' defaults && grep -q '^-mg 0.5' defaults"
check "... re-readable" bash -c "'$gtrace' @<(sed 's/#.*//' defaults) -defaults | cmp - defaults"
plan
