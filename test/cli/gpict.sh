#!/bin/bash
# gpict as its users run it: outputs, views, threads, bad input, bad output. TAP.
source "$(dirname "$0")/../support/tap.sh"
source "$(dirname "$0")/../support/rooms.sh"
cd "$work" || exit 2
gpict=$BIN/gpict

ball_and_lamp >room.rad
view="-vp 0 0 0 -vd 0 1 0 -vh 40 -vv 40"

# What is written.
"$gpict" $view -x 30 -y 20 room.rad >a.hdr
check "HDR to standard output" grep -aq '^FORMAT=32-bit_rle_rgbe$' a.hdr
check "with its view" grep -aq '^VIEW= -vtv -vp 0 0 0 -vd 0 1 0' a.hdr
check "as large as the view's shape allows" grep -aq '^-Y *20 +X *20' a.hdr
"$gpict" $view -x 30 -y 20 -pa 0 room.rad >b.hdr
check "or as large as was said" grep -aq '^-Y *20 +X *30' b.hdr
"$gpict" $view -x 20 -y 20 -o c.hdr -o c.exr -o c.png --contours lines.png room.rad
check "HDR, EXR, PNG and contours at once" test -s c.hdr -a -s c.exr -a -s c.png -a -s lines.png
check "EXR is EXR" test "$(head -c 4 c.exr | od -An -tx1 | tr -d ' ')" = 762f3101
check "PNG is PNG" test "$(head -c 4 c.png | od -An -tx1 | tr -d ' ')" = 89504e47
check "the view of a picture" sh -c "$gpict -vf a.hdr -x 30 -y 20 room.rad | tail -c 500 > d && tail -c 500 a.hdr | cmp - d"
for type in v l c h a s; do
    "$gpict" -vt$type -vp 0 0 0 -vd 0 1 0 -vh 60 -vv 60 -x 16 -y 16 --samples 4 room.rad >type 2>err
    check "view type $type" test $? -eq 0 -a -s type
done
check "a scene on standard input" sh -c "$gpict $view -x 30 -y 20 - <room.rad | tail -c 500 | cmp - d"
check "two scenes are one description" sh -c "head -2 room.rad >one.rad; tail -n +3 room.rad >two.rad;
    $gpict $view -x 30 -y 20 one.rad two.rad | tail -c 500 | cmp - d"

# The same bytes, whatever the threads.
for n in 1 2 5; do "$gpict" $view -n $n -x 20 -y 20 -o n$n.exr room.rad; done
sed -i 's/-n [0-9]/-n N/; s/n[0-9]\.exr/nN.exr/' n1.exr n2.exr n5.exr
check "one thread and two" cmp n1.exr n2.exr
check "one thread and five" cmp n1.exr n5.exr

# Bad options and scenes.
fails "no scene" 1 "standard input: there is no scene on it" "" "$gpict" $view
fails "... nor named" 1 "standard input: there is no scene on it" "" "$gpict" $view -
fails "a null view direction" 1 "direction" "" "$gpict" -vd 0 0 0 room.rad
fails "up along the view" 1 "up" "" "$gpict" -vd 0 0 1 room.rad
fails "a view of 200 degrees" 1 "view" "" "$gpict" -vh 200 room.rad
fails "an unknown view type" 1 "unknown view type" "" "$gpict" -vtx room.rad
fails "a view option cut short" 1 "-vp" "" "$gpict" -vp 1 2
fails "a directory for a view file" 1 "Is a directory" "" "$gpict" -vf . room.rad
fails "a view file without a view" 1 "room.rad" "" "$gpict" -vf room.rad room.rad
fails "a missing view file" 1 "nowhere" "" "$gpict" -vf nowhere room.rad
fails "a picture of no size" 1 "-x" "" "$gpict" -x 0 room.rad
fails "an unknown suffix" 1 "strange" "" "$gpict" -o picture.strange room.rad
fails "a missing scene" 1 "nowhere.rad" "" "$gpict" nowhere.rad

fails "the same file twice" 1 "written twice" "" "$gpict" -o a.hdr -o a.hdr room.rad
fails "standard input twice" 1 "only one" "" "$gpict" - -
mkdir -p folder.hdr
fails "a directory for a picture" 1 "Is a directory" "" "$gpict" -o folder.hdr room.rad
rmdir folder.hdr
"$gpict" -vtc -vh 360 -vv 179 -x 16 -y 16 --samples 2 room.rad >flat
check "a view too flat for its pixels has one row at least" test -s flat
rm flat
"$gpict" $view -x 20 -y 20 -o UP.EXR room.rad
check "layers whatever the suffix's case" grep -aq standard_error UP.EXR
rm UP.EXR
(ulimit -f 1; "$gpict" $view -x 200 -y 200 --samples 2 -o big.hdr room.rad 2>big.err)
check "a file at its limit is told" test $? -eq 2 -a -s big.err -a ! -e big.hdr
rm -f big.err

# Bad output.
fails "a folder that is not there" 1 "nowhere/a.hdr" "" "$gpict" $view -x 4 -y 4 -o nowhere/a.hdr room.rad
if [ -w /dev/full ]; then
    "$gpict" $view -x 64 -y 64 --samples 2 room.rad >/dev/full 2>err
    check "a full disk" test $? -eq 2
    check "... says so" grep -q "No space" err
fi
if [ -z "${GRAZE_SANITIZED:-}" ]; then # whose shadow memory is larger than that
    fails "a picture larger than the memory" 2 "a picture of 100000 x 100000 pixels takes 170 GB" "" \
        sh -c "ulimit -v 4000000; exec $gpict $view -x 100000 -y 100000 -pa 0 room.rad"
fi
check "nothing half-done is left behind" sh -c '! ls -A | grep -v -e "\.rad$" -e "^[abc]\.hdr$" -e "^c\.exr$" -e "^c\.png$" -e "^lines\.png$" -e "^[d]$" -e "^n[125]\.exr$" -e "^type$" -e "^err$" -e "^out$" -e "^check.log$"'
plan
