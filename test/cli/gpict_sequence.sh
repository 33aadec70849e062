#!/bin/bash
# gpict's sequences, distances, and the options that it has from rpict. TAP.
source "$(dirname "$0")/../support/tap.sh"
source "$(dirname "$0")/../support/rooms.sh"
cd "$work" || exit 2
gpict=$BIN/gpict

ball_and_lamp >room.rad
cat >views <<'END'
VIEW= -vp 0 0 0 -vd 0 1 0 -vh 40 -vv 40
a line without a view
rvu -vtv -vp .3 0 0

VIEW= -vtl -vh 3 -vv 3
END
small=(-x 16 -y 16 --samples 8)

# One stream, or a file each.
"$gpict" -S 3 "${small[@]}" room.rad <views >all.hdr
check "a picture for each view" test "$(grep -ac '^FORMAT=' all.hdr)" -eq 3
check "... numbered from the first" test "$(grep -a '^FRAME=' all.hdr | tr '\n' ' ')" = "FRAME=3 FRAME=4 FRAME=5 "
check "... each with its view, which goes on from the one before" grep -aq "^VIEW=  *-vtl -vp 0.3 0 0 -vd 0 1 0 .* -vh 3 -vv 3" all.hdr
"$gpict" -S 3 "${small[@]}" -o f%03d.hdr -o f%d.exr -z z%d.flt room.rad <views
check "files with numbers" test -s f003.hdr -a -s f004.hdr -a -s f005.hdr -a -s f5.exr -a -s z3.flt
sed 1d all.hdr | grep -av "^.*gpict" | head -c 300 >a
"$gpict" -S 3 "${small[@]}" -o g%d.hdr room.rad < <(head -n 1 views)
"$gpict" "${small[@]}" -vp 0 0 0 -vd 0 1 0 -vh 40 -vv 40 -o one.hdr room.rad
check "a frame is the picture of its view" sh -c "tail -c 700 one.hdr >a; tail -c 700 g3.hdr | cmp - a"
cp f004.hdr before
rm f003.hdr
"$gpict" -S 3 "${small[@]}" -o f%03d.hdr room.rad <views 2>err
check "frames that are there are passed over" test "$(grep -c 'there already' err)" -eq 2
check "... and are left; the others come" sh -c "cmp f004.hdr before && test -s f003.hdr"
"$gpict" -S 0 "${small[@]}" -o zero.hdr room.rad <views
check "-S 0 is no sequence" sh -c "grep -aq '^VIEW= -vtv -vp 0 0 0' zero.hdr && ! grep -aq ^FRAME= zero.hdr"
fails "names without a number" 1 "%d" "" "$gpict" -S 1 -o f.hdr room.rad
fails "names with two" 1 "%d" "" "$gpict" -S 1 -o %d%d.hdr room.rad
fails "names with something else" 1 "%d" "" "$gpict" -S 1 -o %s.hdr room.rad
fails "distances without a number" 1 "%d" "" "$gpict" -S 1 -o %d.hdr -z z room.rad
fails "the scene where the views come from" 1 "-" "" "$gpict" -S 1 -
fails "a view that is none" 1 "standard input:2: zero view direction" "\nVIEW= -vd 0 0 0\nVIEW= -vd 0 1 0\n" "$gpict" -S 1 "${small[@]}" -o h%d.hdr room.rad
check "... does not keep the others back" test ! -e h1.hdr -a -s h2.hdr
printf 'VIEW= -vp 0 0 0 -vh 30\nVIEW= -vh 50\n' | "$gpict" -S 1 "${small[@]}" -o right%d.hdr room.rad
fails "a view that cannot be" 1 "standard input:2: " "VIEW= -vp 0 0 0 -vh 30\nVIEW= -vp 5 5 5 -vh 400\nVIEW= -vh 50\n" "$gpict" -S 1 "${small[@]}" -o h%d.hdr room.rad
check "... changes nothing for the next" sh -c "grep -a ^VIEW= right2.hdr >a; grep -a ^VIEW= h3.hdr | cmp - a"
fails "a view with a word amiss" 1 "standard input:1:7: option '-vd'" "VIEW= -vd 0 y 0\nVIEW= -vd 0 1 0\n" "$gpict" -S 1 "${small[@]}" -o i%d.hdr room.rad
check "... has its number all the same" test ! -e i1.hdr -a -s i2.hdr

# A sequence goes on where it was: frame by frame, and in the middle of one.
slow=(-x 40 -y 40 --samples 800 -pm .5 --checkpoint-interval .02)
"$gpict" -S 1 "${slow[@]}" -o p%d.hdr room.rad <views
mkdir whole && mv p?.hdr whole
"$gpict" -S 1 "${slow[@]}" -o p%d.hdr room.rad <views &
while kill -0 $! 2>/dev/null && [ ! -e p2.hdr.checkpoint ]; do :; done
kill -9 $!
wait $! 2>/dev/null
check "kill -9 in the second frame" test -s p1.hdr -a -s p2.hdr.checkpoint -a ! -e p2.hdr
cp p2.hdr.checkpoint kept
"$gpict" -S 1 "${slow[@]}" -ro p%d.hdr room.rad <views 2>err
check "-ro with %d finishes the sequence" sh -c "cmp p1.hdr whole/p1.hdr && cmp p2.hdr whole/p2.hdr"
# The third was begun by the second command, whose name stands in its header.
sed 's/-ro p/-o p/' p3.hdr >p3
check "... to the same bytes" cmp p3 whole/p3.hdr
rm p2.hdr p3.hdr
mv kept p2.hdr.checkpoint
"$gpict" -S 1 "${slow[@]}" -o p%d.hdr -r 2 room.rad <views 2>err
check "-r with a frame's number goes on with that one" sh -c "cmp p2.hdr whole/p2.hdr && test ! -e p2.hdr.checkpoint && test -s p3.hdr"

# Motion: the second frame of the sequence is blurred from the first view to as far beyond.
check "-pm blurs" sh -c "! tail -c 500 p2.hdr | cmp - f004.hdr"
printf 'VIEW= -vp 0 0 0\nVIEW= -vp 0 0 0\n' >still
"$gpict" -S 1 "${small[@]}" -pm .9 -pj 0 -o s%d.hdr -vh 40 -vv 40 room.rad <still
"$gpict" -S 1 "${small[@]}" -pj 0 -o t%d.hdr -vh 40 -vv 40 room.rad <still
check "... nothing that does not move" test "$(tail -c 200 s2.hdr | cksum)" = "$(tail -c 200 t2.hdr | cksum)"

# Distances: native floats, top to bottom.
"$gpict" -x 16 -y 16 --samples 4 -vtl -vp 0 0 0 -vd 0 1 0 -vh 4 -vv 4 -vo 1 -z z.flt room.rad >one.hdr
check "-z: a float for each pixel" test "$(wc -c <z.flt)" -eq 1024
# 9.5 pixels of a quarter from the top corner: past the ball; next to the axis: from the fore plane to the ball's front.
check "-z: how far the ball is, and the sky" sh -c "od -An -v -tfF -w4 z.flt | awk 'NR == 1 { far = \$1 } NR == 120 { near = \$1 } END { exit !(far == 1e10 && near > 3 && near < 3.02) }'"
"$gpict" -x 16 -y 16 --samples 4 -vth -vh 180 -vv 180 -z z.flt -o one.exr room.rad
check "-z: 0 where a fisheye sees nothing" sh -c "od -An -v -tfF -w4 z.flt | head -n 1 | grep -qx ' *0'"
fails "-z where nothing can be written" 1 "nowhere/z" "" "$gpict" "${small[@]}" -z nowhere/z room.rad
fails "-z over the picture" 1 "written twice" "" "$gpict" "${small[@]}" -z a.hdr -o a.hdr room.rad

# A lens: what is in focus stays sharp, what is not does not.
ball=(-vp 0 0 0 -vh 40 -vv 40 -x 40 -y 40 --samples 64 -z z.flt)
"$gpict" "${ball[@]}" -vd 0 5 0 -o sharp.hdr room.rad
"$gpict" "${ball[@]}" -vd 0 5 0 -pd .4 -o focus.hdr room.rad
"$gpict" "${ball[@]}" -vd 0 1 0 -pd .4 -o blur.hdr room.rad
check "-pd changes the picture, the more the farther from the focus" sh -c "! cmp -s focus.hdr blur.hdr"
for type in v l c h a s; do
    check "a lens for view type $type" "$gpict" -vt$type -vd 0 4 0 -vh 60 -vv 60 -pd .1 -vo .5 -va 20 "${small[@]}" -o type.hdr room.rad
done

# The finished picture knows nothing of the order in which its pixels came.
for ps in 1 4 16; do "$gpict" -vh 40 -vv 40 -ps $ps -pt .2 "${small[@]}" room.rad | tail -c 400 >ps$ps; done
check "-ps and -pt change no pixel" sh -c "cmp ps1 ps4 && cmp ps1 ps16"
check "-ps below 1 is 1, with a warning" sh -c "$gpict -ps 0 ${small[*]} -o ps.hdr room.rad 2>&1 | grep -q 'the spacing is 1$'"
check "-ps above 16 is 16, with a warning" sh -c "$gpict -ps 20 ${small[*]} -o ps.hdr room.rad 2>&1 | grep -q 'the spacing is 16'"

"$gpict" -defaults >defaults
check "-defaults can be read again" sh -c "$gpict @defaults -defaults | cmp - defaults"
"$gpict" -o a.hdr -o 'b c.exr' -ro d.hdr -e 'x = 1' -f y.cal -vtl -defaults >defaults
check "... with files and definitions" sh -c "$gpict @defaults -defaults | cmp - defaults"
for words in "-o a.hdr -o 'b c.exr'" "-ro d.hdr" "-e 'x = 1' -f y.cal" -vtl; do
    check "... has $words" sh -c "cut -f 1 defaults | grep -qxF -- \"\$1\"" - "$words"
done
"$gpict" -r e.hdr -o a.hdr -defaults | cut -f 1 | grep -qx -- "-r e.hdr"
result $? "... or -r"

# The scene by standard input, as rpict takes it.
"$gpict" "${small[@]}" room.rad | sed 1,2d >one.hdr
check "a scene by standard input" sh -c "'$gpict' ${small[*]} <room.rad | sed 1,2d | cmp - one.hdr"
check "... named by a minus sign" sh -c "'$gpict' ${small[*]} - <room.rad | sed 1,2d | cmp - one.hdr"
fails "none for a sequence, whose views come there" 1 "no scene" "" "$gpict" -S 1 "${small[@]}" -o h%d.hdr

# The command lines of rpict's users.
accepted() { check "accepts $*" "$gpict" "${small[@]}" "$@" -o accepted.hdr room.rad; }
accepted -i -u -bv -dt .1 -dc .5 -dj .9 -ds .2 -dr 1 -dp 256 -dv -ss 1 -st .1 -av .1 .1 .1 -aw 0 -ab 1 -ar 48 -aa .1 -ad 1536 -as 392
accepted -dp 256 -ar 48 -ms 1 -ds .2 -dj .9 -dt .1 -dc .5 -dr 1 -ss 1 -st .1 -ab 2 -aa .1 -ad 1536 -as 392 -av 25 25 25 -lr 8 -lw 1e-4
accepted -pa 1 -pj .67 -pm 0 -pd 0 -ps 4 -pt .05 -t 0 -w+ -pRGB -vtv -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 45 -vv 45 -vo 0 -va 0 -vs 0 -vl 0
echo red >mods
echo "a = 2;" >x.cal
accepted -ae red -aE mods -ap photons 50 -am 1 -ac 100 -aC 4k -me 0 0 0 -ma .1 .1 .1 -mg .5 -ms 2 -cs 3 -cw 780 380 -f x.cal -e 'a=1;' -P server
accepted -ai red -aI mods -PP pool -w- -lr -10 -n 2
"$gpict" -x 4 -y 4 -e messages -ps 20 -t 1000 --samples 4 -o accepted.hdr room.rad 2>err
check "-e takes all messages" sh -c "grep -q 'the spacing is 16' messages && grep -q ' paths, ' messages && test ! -s err"

# Colours.
for colors in XYZ "c .64 .33 .3 .6 .15 .06 .3127 .329"; do
    # shellcheck disable=SC2086
    "$gpict" "${small[@]}" -p$colors -o colors.hdr -o colors.exr -vh 40 -vv 40 room.rad
    # shellcheck disable=SC2086
    "$gpict" "${small[@]}" -p$colors -vh 40 -vv 40 room.rad >out.hdr
    check "-p$colors: the same to standard output" test "$(tail -c 500 out.hdr | cksum)" = "$(tail -c 500 colors.hdr | cksum)"
    case $colors in
    XYZ) check "-pXYZ says so" grep -aqx 'FORMAT=32-bit_rle_xyze' colors.hdr ;;
    *) check "-pc says so" grep -aqx 'PRIMARIES= 0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329' colors.hdr ;;
    esac
    check "... and .exr has Radiance's" sh -c "oiiotool --info -v colors.exr | grep -q 'chromaticities: 0.64, 0.33, 0.29, 0.6'"
done
fails "-pY makes no picture" 1 "three colors" "" "$gpict" -pY room.rad
plan
