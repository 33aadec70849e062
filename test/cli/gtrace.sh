#!/bin/bash
# gtrace as its users run it: formats, letters, bad input, bad output, threads. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
gtrace=$BIN/gtrace

cat >room.rad <<'END'
void metal2 shiny 4 1 1 0 . 0 6 .6 .6 .6 .8 .1 .2
shiny polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
void light white 0 0 3 9 9 9
white sphere lamp 0 0 4 0 3 2 .3
END
down="0 0 1 0 0 -1\n"
for i in $(seq 200); do echo "0 $((i % 7 - 3)) 1 .$i 1 -1"; done >rays

# What is printed.
check "names and lengths" test "$(printf "$down" | "$gtrace" -h -osmMLl room.rad)" = \
    "$(printf 'floor\tshiny\tshiny\t1.000000e+00\t1.000000e+00\t')"
cat room.rad >alias.rad
printf 'void alias other shiny\nother ring disk 0 0 8 5 5 1 0 0 1 0 1\n' >>alias.rad
check "an alias's modifier and material" test "$(echo "5 5 2 0 0 -1" | "$gtrace" -h -osmM alias.rad)" = "$(printf 'disk\tother\tshiny\t')"
check "nothing hit" test "$(echo "0 0 1 1 0 0" | "$gtrace" -h -osmLNp room.rad)" = \
    "$(printf '*\t*\t1.000000e+10\t0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t1.000000e+00\t')"
check "a zero direction asks for an empty record" test "$(echo "1 2 3 0 0 0" | "$gtrace" -h -ovLs room.rad)" = \
    "$(printf '0.000000e+00\t0.000000e+00\t0.000000e+00\t1.000000e+10\t*\t')"
check "-ld does not look at its end" test "$(echo "0 0 1 0 0 -1" | "$gtrace" -h -ld -osp room.rad)" = "$(printf '*\t%e\t%e\t%e\t' 0 0 0)"
check "-ld looks no farther" test "$(echo "0 0 1 0 0 -.5" | "$gtrace" -h -ld -os room.rad)" = "$(printf '*\t')"
check "the light's radiance, without error" test "$(echo "0 0 2 0 1 0" | "$gtrace" -h -ove room.rad)" = \
    "$(printf '9.000000e+00\t9.000000e+00\t9.000000e+00\t0.000000e+00\t0.000000e+00\t0.000000e+00\t')"
"$gtrace" -ff -ov room.rad </dev/null >header
check "header of float answers" grep -q '^FORMAT=float$' header
check "header counts the numbers" grep -q '^NCOMP=3$' header
check "header names the order of bytes" grep -q '^BigEndian=0$' header
check "-x and -y print the resolution" test "$(head -2 rays | "$gtrace" -h -x 2 -y 1 -os room.rad | head -1)" = "-Y 1 +X 2"
check "-y ends the run" test "$("$gtrace" -h -y 5 -os room.rad <rays | wc -l)" -eq 5
"$gtrace" -ab 3 -av .1 .2 .3 -ovL -defaults >defaults
sed 's/#.*//' defaults >reread
check "defaults can be read again" sh -c "'$gtrace' @reread -defaults | cmp - defaults"

# Formats tell the same numbers.
"$gtrace" -h -fad room.rad <rays >doubles
"$gtrace" -h -faf room.rad <rays >floats
"$gtrace" -h -fac room.rad <rays >colors
check "double answers have 24 bytes" test "$(wc -c <doubles)" -eq 4800
check "float answers have 12 bytes" test "$(wc -c <floats)" -eq 2400
check "color answers have 4 bytes" test "$(wc -c <colors)" -eq 800
"$gtrace" -h -faa -ood room.rad <rays >ascii
"$gtrace" -h -fad -ood room.rad <rays | "$gtrace" -h -fda -ood room.rad >ascii2
check "rays in doubles are the rays in ASCII" cmp ascii ascii2

# Every format in, every format out: rays that all formats hold exactly, made of origins, which answers repeat.
mkdir formats
for i in $(seq 16); do echo "0 -3 $((i % 4)).5 0 0 1 .25 1 -.$((i % 2 * 25 + 12))5 0 0 1"; done >halves
cut -d ' ' -f 1-3,7-9 halves >formats/a
for f in f d; do "$gtrace" -h -fa$f -oo room.rad <halves >formats/$f; done
for out in a f d; do
    "$gtrace" -h -fa$out -ooLN room.rad <formats/a >answers.$out
    for in in f d; do check "-f$in$out answers as -fa$out" cmp answers.$out <("$gtrace" -h -f$in$out -ooLN room.rad <formats/$in); done
done
"$gtrace" -h -fac room.rad <formats/a >answers.c
for in in f d; do check "-f${in}c answers as -fac" cmp answers.c <("$gtrace" -h -f${in}c room.rad <formats/$in); done
check "-f with one letter is that letter twice" cmp answers.d <("$gtrace" -h -fd -ooLN room.rad <formats/d)

# The same bytes, whatever the threads; other seeds, other bytes. (Strategies that sample lights need no random numbers
# here.)
for n in 1 2 5; do "$gtrace" -h -ab 1 --strategy brdf -n $n -fad -ove room.rad <rays >n$n; done
check "one thread and two" cmp n1 n2
check "one thread and five" cmp n1 n5
"$gtrace" -h -ab 1 --strategy brdf --seed 1 -fad -ove room.rad <rays >seed
check "another seed" sh -c '! cmp -s n1 seed'
check "the same ray gets its own stream" sh -c "printf '$down$down' | $gtrace -h --strategy brdf room.rad | uniq | wc -l | grep -qx 2"

# Models of materials, and strategies.
ask() { printf "$down" | "$gtrace" -h --error .005 "$@" room.rad; }
check "--model is the new model's unless it says otherwise" test "$(ask)" = "$(ask --model gmd)"
check "--model changes all materials" test "$(ask)" != "$(ask --model ward)"
check "... or one" test "$(ask --model ward)" = "$(ask --model gmd --model=shiny=ward)"
check "... the more specific wins" test "$(ask --model shiny=ward-duer --model ward)" = "$(ask --model ward-duer)"
check "... then the last" test "$(ask --model ward-neumann)" = "$(ask --model ward --model ward-neumann)"
"$gtrace" --model ward --model 'a b=ward-duer' -defaults | grep -q "^--model ward --model 'a b=ward-duer'"
result $? "-defaults tells the models"
fails "a model that there is not" 1 "models: gmd ward ward-duer ward-neumann" "" "$gtrace" --model wart room.rad
fails "a model for no material" 1 "'dull'" "" "$gtrace" --model dull=ward room.rad
fails "a model for a light" 1 "room.rad:3:1: light white" "" "$gtrace" --model white=ward room.rad
fails "a model for a material without a name" 1 "name" "" "$gtrace" --model =ward room.rad
fails "--model without a model" 1 "--model" "" "$gtrace" --model

# An interactive client is answered before it sends more.
check "answers come before the next ray is sent" bash -c '
    coproc '"$gtrace"' -h -os room.rad
    for i in 1 2 3; do
        echo "0 0 1 0 0 -1" >&${COPROC[1]}
        read -t 20 answer <&${COPROC[0]} || exit 1
        [ "$answer" = floor ] || exit 1
    done'

# Bad rays: what was answered stays.
fails "a word in a ray" 1 "record 2" "${down}0 0 x 0 0 1\n" "$gtrace" -h -os room.rad
check "... with the answers before it" test "$(cat out)" = "$(printf 'floor\t')"
fails "nan in a ray" 1 "record 1" "0 0 nan 0 0 1\n" "$gtrace" -h room.rad
fails "inf in a ray" 1 "record 1" "0 0 inf 0 0 1\n" "$gtrace" -h room.rad
fails "a ray cut short" 1 "record 2" "${down}0 0 1" "$gtrace" -h room.rad
fails "a binary ray cut short" 1 "record 1" "abcdefg" "$gtrace" -h -ff room.rad
fails "a binary ray that is not finite" 1 "record 1" '\0377\0377\0377\0377\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0' "$gtrace" -h -ff room.rad
fails "fewer rays than promised" 1 "ended after 1 of 4" "$down" "$gtrace" -h -x 2 -y 2 room.rad

# Bad options.
fails "an unknown option" 1 "-q" "" "$gtrace" -q room.rad
fails "an option without its argument" 1 "-ab" "" "$gtrace" -ab
fails "a word for a number" 1 "-ab" "" "$gtrace" -ab two room.rad
fails "a number out of range" 1 "-ab" "" "$gtrace" -ab -1 room.rad
fails "an infinite number" 1 "-lw" "" "$gtrace" -lw inf room.rad
fails "an unknown format" 1 "-fxy" "" "$gtrace" -fxy room.rad
fails "an unknown letter" 1 "'q'" "" "$gtrace" -ovq room.rad
fails "colors of more than the value" 1 "-ov" "" "$gtrace" -fac -ovl room.rad
fails "an unknown strategy" 1 "'fast'" "" "$gtrace" --strategy fast room.rad
fails "the error of one sample" 1 "2 or more" "" "$gtrace" --samples 1 -ove room.rad
fails "no scene" 1 "no scene" "" "$gtrace"
fails "standard input as a scene" 1 "standard input" "" "$gtrace" -
fails "irradiance of nothing" 1 "-os" "" "$gtrace" -i -os room.rad
fails "a missing option file" 1 "nowhere" "" "$gtrace" @nowhere

# Bad scenes.
fails "a missing scene" 1 "nowhere.rad" "" "$gtrace" nowhere.rad
fails "a directory for a scene" 1 "Is a directory" "" "$gtrace" .
fails "a file for a directory" 1 "Not a directory" "" "$gtrace" room.rad/room.rad
[ ! -r /proc/self/mem ] || fails "a scene that fails to be read" 2 "Input/output error" "" "$gtrace" /proc/self/mem
echo "void plastic p 0 0 5 1 1 1 0" >cut.rad
fails "a scene cut short" 1 "cut.rad:1" "" "$gtrace" cut.rad
printf '#comment\nvoid aBSDF g 5 a.xml 0 0 1 . 0 0\ng sphere s 0 0 4 0 0 0 1\n' >bsdf.rad
fails "a type not supported" 1 "bsdf.rad:2:1: aBSDF g" "" "$gtrace" bsdf.rad
printf 'void plastic g 0 0 5 .5 .5 .5 0 0\ng mesh i 1 /dev/zero 0 0\n' >endless.rad
fails "a mesh without an end" 1 "endless.rad:2:1: mesh i: cannot read /dev/zero: it is a device" "" "$gtrace" endless.rad
printf 'void brightdata d 4 noneg /dev/zero . Px 0 0\nd plastic g 0 0 5 .5 .5 .5 0 0\ng sphere s 0 0 4 0 0 0 1\n' >endless.rad
fails "data without an end" 1 "endless.rad:1:1: brightdata d: cannot read /dev/zero" "" "$gtrace" endless.rad
printf 'void colorpict c 7 noop noop noop cut.rad . Px Py 0 0\nc plastic g 0 0 5 1 1 1 0 0\ng sphere s 0 0 4 0 0 0 1\n' >nopicture.rad
fails "a picture that is none" 1 "(from colorpict c at nopicture.rad:1:1)" "" "$gtrace" nopicture.rad
printf 'nobody sphere s 0 0 4 0 0 0 1\n' >undefined.rad
fails "an undefined modifier" 1 "undefined.rad:1:1: sphere s: undefined modifier" "" "$gtrace" undefined.rad
printf '\n!cat undefined.rad\n' >inner.rad
printf '  !xform -n a inner.rad\n' >outer.rad
fails "a mistake in what commands bring in" 1 \
    '`!cat undefined.rad`:1:1: sphere a.s: undefined modifier "nobody" (from inner.rad:2:1, from `!xform -n a inner.rad`, from outer.rad:1:3)' \
    "" "$gtrace" outer.rad
printf '!xform -n a endless.rad\n' >endless.rad
fails "a scene within itself" 1 "endless.rad: brings in itself" "" "$gtrace" endless.rad
printf 'void brightfunc f 2 sin(Px . 0 0 f plastic p 0 0 5 1 1 1 0 0 p sphere s 0 0 4 0 0 0 1\n' >formula.rad
fails "a wrong expression" 1 "formula.rad:1:1: brightfunc f: in the expression 'sin(Px'" "" "$gtrace" formula.rad
printf '#?RADIANCE\noconv room.rad\nFORMAT=Radiance_octree\n\n\001\002' >room.oct
fails "a damaged octree" 1 "room.oct: octree: incompatible format (byte " "" "$gtrace" room.oct
fails "a failing command" 1 "exit 3" "" "$gtrace" '!exit 3'

printf 'void light l 0 0 3 1e200 1 1 l sphere s 0 0 4 0 0 0 1\n' >bright.rad
fails "radiance beyond computing" 1 "light l: radiance above 1e100" "" "$gtrace" bright.rad
printf 'void plastic p 0 0 5 1 1 1 0 0 p sphere s 0 0 4 0 0 1e12 1\n' >far.rad
fails "coordinates beyond sight" 1 "sphere s" "" "$gtrace" far.rad
printf 'void plastic p 0 0 5 1 1 1 0 0 p sphere "a\nb" 0 0 4 0 0 1 1\n' >name.rad
fails "a name of two lines" 1 "control character" "" "$gtrace" name.rad
check "a sensor far away is answered" sh -c "echo '1e34 0 0 -1 0 0' | '$gtrace' -h -I -ov room.rad"
printf 'void plastic p 0 0 5 1 1 1 1e4 0 p bubble s 0 0 4 0 0 0 1 void light l 0 0 3 1 1 1 l sphere t 0 0 4 .5 0 0 .1\n' >growing.rad
check "light that grows without bound stays finite" sh -c "echo '0 0 .5 .001 0 1' | '$gtrace' -w- -h -ove growing.rad | grep -vE 'inf|nan'"
check "-w- silences the scene's warnings" sh -c "'$gtrace' -w- -h growing.rad </dev/null 2>&1 | wc -c | grep -qx 0"
check "... which are there" sh -c "'$gtrace' -h growing.rad </dev/null 2>&1 | grep -q 'growing.rad:1:1: plastic p'"

# What floats and colors cannot hold.
printf 'void light l 0 0 3 1e90 1 1e100 l sphere lamp 0 0 4 0 0 3 1 void plastic p 0 0 5 1e9 1 1 0 0 p ring r 0 0 8 0 0 0 0 0 1 0 1\n' >huge.rad
for direction in 1 -1; do
    printf "0 0 1 0 0 $direction\n" >ray
    check "radiance beyond floats, towards $direction" sh -c \
        "'$gtrace' -w- -h -faf -ov huge.rad <ray | od -An -tf4 | grep -qE '^ *3.4028235e\+38 +[0-9.e-]+ +3.4028235e\+38'"
    check "... and colors" sh -c "'$gtrace' -w- -h -fac -ov huge.rad <ray | od -An -tu1 | grep -q '255 *[0-9]* *255 *255'"
    check "... and doubles" sh -c "'$gtrace' -w- -h -faa -ovex huge.rad <ray | grep -E 'e.1?[0-9][0-9]' | grep -vE 'inf|nan'"
done
check "pictures hold no infinity" sh -c "'$BIN/gpict' -w- -vp 0 0 1 -vd 0 0 1 -vu 0 1 0 -x 4 -y 4 -o huge.exr -o huge.hdr huge.rad && oiiotool --stats huge.exr | grep -q 'Stats InfCount: 0 0 0'"

# Bad output.
if [ -w /dev/full ]; then
    "$gtrace" -h room.rad <rays >/dev/full 2>err
    check "a full disk" test $? -eq 2
    check "... says so" grep -q "No space" err
    check "a lost warning" sh -c "'$gtrace' -h huge.rad <rays >out 2>/dev/full; test \$? -eq 2 -a -s out"
fi
check "... on a closed stream" sh -c "'$gtrace' -h huge.rad <rays >out 2>&-; test \$? -eq 2 -a -s out"
check "a closed stream that nothing is written to" sh -c "'$gtrace' -w- -h huge.rad <rays >out 2>&-; test \$? -eq 0 -a -s out"
check "closed standard input and output" sh -c "! '$gtrace' -w- -h huge.rad <&- 2>err && ! '$gtrace' -w- -h huge.rad <rays >&- 2>>err && test \$(grep -c 'Bad file' err) -eq 2"
("$gtrace" -h -ab 1 room.rad 2>err <<<"$(for i in $(seq 100); do cat rays; done)"; echo $? >status) | head -1 >/dev/null
check "a closed pipe" test "$(cat status)" -eq 2
plan
