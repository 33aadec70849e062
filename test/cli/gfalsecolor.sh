#!/bin/bash
# gfalsecolor as its users run it: pictures in and out, scales, differences, bad input, bad output. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
tool=$BIN/gfalsecolor

# An HDR picture of one color: picture FILE EXPOSURE PIXEL WIDTH, with PIXEL the four bytes as printf has them.
picture() {
    {
        printf '#?RADIANCE\nEXPOSURE=%s\nFORMAT=32-bit_rle_rgbe\n\n-Y 40 +X %d\n' "$2" "$4"
        for ((i = 0; i < 40 * $4; i++)); do printf "$3"; done
    } >"$1"
}
# The pixels of a picture, without its header.
pixels() { sed -n '/^-Y/,$p' "$1"; }
same_pixels() { cmp <(pixels "$1") <(pixels "$2"); }

picture one.hdr 1 '\200\200\200\201' 60
picture exposed.hdr 4 '\200\200\200\203' 60
picture small.hdr 1 '\200\200\200\201' 20
picture black.hdr 1 '\0\0\0\0' 60
picture half.hdr 1 '\200\200\200\200' 60

# In and out.
"$tool" one.hdr >a.hdr 2>err
check "HDR to standard output" grep -aq '^FORMAT=32-bit_rle_rgbe$' a.hdr
check "without a word" test ! -s err
check "the command in its header" grep -aq '^.*gfalsecolor one.hdr$' a.hdr
check "standard input" sh -c "$tool <one.hdr >b.hdr"
check "... gives the same" same_pixels a.hdr b.hdr
check "so does -" sh -c "$tool - <one.hdr >b.hdr"
check "... the same" same_pixels a.hdr b.hdr
check "so does -i" sh -c "$tool -i one.hdr >b.hdr"
check "... the same " same_pixels a.hdr b.hdr
check "a picture's exposure is divided out" sh -c "$tool exposed.hdr >b.hdr"
check "... the same pixels" same_pixels a.hdr b.hdr
check "a file as its suffix says" "$tool" -o a.png one.hdr
check "PNG is PNG" test "$(head -c 4 a.png | od -An -tx1 | tr -d ' ')" = 89504e47
check "EXR" "$tool" -o a.exr one.hdr
check "is EXR" test "$(head -c 4 a.exr | od -An -tx1 | tr -d ' ')" = 762f3101
check "PNG, too, is read" "$tool" -o c.png a.png
check "and EXR" "$tool" -o c.exr a.exr
check "no legend, the picture's size" sh -c "$tool -lw 0 one.hdr | grep -aq '^-Y *40 +X *60'"
check "a legend as wide as is said" sh -c "$tool -lw 100 -lh 200 one.hdr | grep -aq '^-Y *200 +X *160'"
check "all palettes" sh -c "$tool -palettes | grep -aq '^-Y'"

# The pixel is 1.002 x 179 = 179.3 cd/m2.
"$tool" -lw 0 -s 10 one.hdr >top.hdr
"$tool" -lw 0 -s 179 one.hdr >b.hdr
check "above the scale's end all is alike" same_pixels top.hdr b.hdr
"$tool" -lw 0 -s 1 -m 1 one.hdr >b.hdr
check "-m" same_pixels top.hdr b.hdr
"$tool" -lw 0 -s 10 -log 2 one.hdr >b.hdr
check "a logarithmic scale has the same end" same_pixels top.hdr b.hdr
"$tool" -lw 0 -log 1 -s 1000 one.hdr >log.hdr
"$tool" -lw 0 -s 1000 one.hdr >b.hdr
check "but is another scale" sh -c "! cmp -s log.hdr b.hdr"
"$tool" -lw 0 -log 2 -s 1000 black.hdr >log.hdr
"$tool" -lw 0 black.hdr >b.hdr
check "black is the lowest color on either" same_pixels log.hdr b.hdr
for style in -cl -cb -cp -c0 -e; do
    quiet "$style" "$tool" $style -ip one.hdr -n 5 -o style.png
done
"$tool" -c0 -p half.hdr one.hdr >b.hdr
"$tool" -c0 -ip half.hdr >c.hdr
check "-p is the picture drawn on" same_pixels b.hdr c.hdr
for palette in def spec pm3d hot eco tbo viridis gray diverging; do
    quiet "palette $palette" "$tool" -pal $palette -s auto -l 'A label: {x} ~' -d 1 -o palette.png one.hdr
done

# Differences.
"$tool" -lw 0 -s 1 --relative-difference one.hdr one.hdr >zero.hdr
"$tool" -lw 0 -s 1 --relative-difference one.hdr half.hdr >less.hdr
"$tool" -lw 0 -s 1 --relative-difference half.hdr one.hdr >more.hdr
check "a difference, and none" sh -c "! cmp -s zero.hdr less.hdr && ! cmp -s zero.hdr more.hdr && ! cmp -s less.hdr more.hdr"
"$tool" -lw 0 -s .5 --relative-difference one.hdr half.hdr >half-scale.hdr
"$tool" -lw 0 -s 1 --relative-difference one.hdr black.hdr >none.hdr
check "half as bright is the end of a scale to a half, as black is of one to 1" same_pixels half-scale.hdr none.hdr
quiet "nothing to compare with" "$tool" --relative-difference black.hdr -o none.png one.hdr
quiet "by itself" "$tool" --relative-difference half.hdr -e -cl -o auto.png one.hdr
check "one of both on standard input" sh -c "$tool -lw 0 -s 1 --relative-difference - half.hdr <one.hdr >b.hdr"
check "... gives the same difference" same_pixels less.hdr b.hdr

# Where options come from.
echo '-lw 0 -s 10' >options
check "options from a file" sh -c "$tool @options one.hdr >b.hdr"
check "... as given" same_pixels top.hdr b.hdr
check "options from the environment" sh -c "FALSE='-lw 0 -s 10' $tool '\$FALSE' one.hdr >b.hdr"
check "... as given " same_pixels top.hdr b.hdr
"$tool" -lw 30 -s 7 -cl -l 'a b' -defaults | sed 's/#.*//' >defaults
check "-defaults can be read again" sh -c "$tool @defaults -defaults | sed 's/#.*//' | cmp - defaults"
check "-defaults has what was given" sh -c "grep -q '^-lw 30' defaults && grep -q '^-s 7' defaults && grep -q '^-cl' defaults"

# Bad options and pictures.
fails "a missing picture" 1 "nowhere.hdr" "" "$tool" nowhere.hdr
fails "nothing on standard input" 1 "standard input" "" "$tool"
fails "no picture on standard input" 1 "standard input" "hello\n" "$tool"
fails "two pictures" 1 "only one picture" "" "$tool" one.hdr half.hdr
fails "options behind the picture" 1 "options stand before" "" "$tool" one.hdr -cl
fails "standard input twice" 1 "standard input can be only one" "" "$tool" -p -
fails "two pictures to draw on" 1 "-ip" "" "$tool" -p one.hdr -ip one.hdr
fails "pictures of two sizes" 1 "small.hdr: the picture is 20 x 40 pixels large, the input 60 x 40" "" "$tool" --relative-difference small.hdr one.hdr
fails "a logarithm of differences" 1 "-log" "" "$tool" -log 2 --relative-difference half.hdr one.hdr
fails "an unknown palette" 1 "known are def, spec" "" "$tool" -pal rainbow one.hdr
fails "an unknown style" 1 "-cx" "" "$tool" -cx one.hdr
fails "a scale of nothing" 1 "-s" "" "$tool" -s 0 one.hdr
fails "a scale that is no number" 1 "'x'" "" "$tool" -s x one.hdr
fails "no divisions" 1 "-n" "" "$tool" -n 0 one.hdr
fails "an option cut short" 1 "-s" "" "$tool" -s
fails "an expression for red" 1 "not supported; -pal" "" "$tool" -r v one.hdr
fails "an unknown option" 1 "unknown option '-bogus'" "" "$tool" -bogus one.hdr
fails "an unknown suffix" 1 "strange" "" "$tool" -o a.strange one.hdr
head -c 2000 one.hdr >short.hdr
fails "a picture cut short" 1 "short.hdr" "" "$tool" short.hdr

# Bad output.
fails "a folder that is not there" 1 "nowhere/a.png" "" "$tool" -o nowhere/a.png one.hdr
if [ -w /dev/full ]; then
    "$tool" one.hdr >/dev/full 2>err
    check "a full disk" test $? -eq 2
    check "... says so" grep -q "No space" err
fi
plan
