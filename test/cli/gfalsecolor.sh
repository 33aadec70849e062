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
# A ramp from left to right, 60 x 40 pixels, the brightest 1.910 = 341.9 cd/m2: ramp FILE EXPONENT, 201 as printf has it.
ramp() {
    local row= i
    for ((i = 0; i < 60; i++)); do row+=$(printf '\\%03o\\%03o\\%03o\\%s' $((8 + 4 * i)) $((8 + 4 * i)) $((8 + 4 * i)) "$2"); done
    {
        printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40 +X 60\n'
        for ((i = 0; i < 40; i++)); do printf "$row"; done
    } >"$1"
}
# The size and pixels of a picture, without its header, which holds the command line.
pixels() { sed -n '/^-Y/,$p' "$1"; }
same_pixels() { [ -s "$1" ] && [ -s "$2" ] && cmp <(pixels "$1") <(pixels "$2"); }
other_pixels() { [ -s "$1" ] && [ -s "$2" ] && ! cmp -s <(pixels "$1") <(pixels "$2"); }
fails_to() { ! "$@"; }
drawn() { "$tool" $2 >"$1" 2>"$1.err" || { cat "$1.err"; return 1; }; }
compare() { drawn one.out "$2" && drawn other.out "$3" && "$1" one.out other.out; }
# same DESCRIPTION WORDS WORDS: with these options and operands gfalsecolor draws the same; other: another picture.
same() { check "$1" compare same_pixels "$2" "$3"; }
other() { check "$1" compare other_pixels "$2" "$3"; }
# all_differ DESCRIPTION WORDS...: no two of them draw the same.
digests() { for words; do drawn one.out "$words" && pixels one.out | cksum; done; }
all_differ() { check "$1" test "$(digests "${@:2}" | sort -u | wc -l)" -eq $(($# - 1)); }

picture one.hdr 1 '\200\200\200\201' 60
picture exposed.hdr 4 '\200\200\200\203' 60
picture small.hdr 1 '\200\200\200\201' 20
picture black.hdr 1 '\0\0\0\0' 60
picture half.hdr 1 '\200\200\200\200' 60
ramp ramp.hdr 201
ramp half-ramp.hdr 200

# The tests' own tools.
"$tool" ramp.hdr >a.hdr
sed '1a COMMENT=' a.hdr >b.hdr
check "headers do not count" same_pixels a.hdr b.hdr
check "... nor make a difference" fails_to other_pixels a.hdr b.hdr
"$tool" one.hdr >b.hdr
check "pixels do" other_pixels a.hdr b.hdr
check "... and are not the same" fails_to same_pixels a.hdr b.hdr

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

# Scales. The pixel of one.hdr is 1.0039 x 179 = 179.7 cd/m2.
same "above the scale's end all is alike" "-lw 0 -s 10 one.hdr" "-lw 0 -s 179 one.hdr"
other "-s" "-lw 0 -s 200 ramp.hdr" "-lw 0 -s 400 ramp.hdr"
same "its default is 1000" "ramp.hdr" "-s 1000 ramp.hdr"
same "which is there to be said" "-s 1000 ramp.hdr" "-s 10 -s default ramp.hdr"
same "-s auto is the next round end" "-s auto ramp.hdr" "-s 400 ramp.hdr"
same "... of as many steps" "-n 7 -s auto ramp.hdr" "-n 7 -s 350 ramp.hdr"
same "... a for short" "-s a ramp.hdr" "-s 400 ramp.hdr"
same "... of black is 1" "-s auto black.hdr" "-s 1 black.hdr"
same "-m" "-s 2 -m 1 -l lm ramp.hdr" "-s 2 -m 2 -l lm half-ramp.hdr"
same "its default is 179" "ramp.hdr" "-m 179 ramp.hdr"
other "-m matters" "ramp.hdr" "-m 1 ramp.hdr"
same "-log: halfway down two powers of ten is a tenth" "-lw 0 -m 1 -log 2 -s 10.0390625 one.hdr" "-lw 0 -m 1 -s 2.0078125 one.hdr"
same "... a quarter down four" "-lw 0 -m 1 -log 4 -s 10.0390625 one.hdr" "-lw 0 -m 1 -s 1.3385416666666667 one.hdr"
same "... with the same end" "-lw 0 -log 2 -s 10 one.hdr" "-lw 0 -s 10 one.hdr"
same "... black is the lowest colour" "-lw 0 -log 2 black.hdr" "-lw 0 black.hdr"
all_differ "... and is another scale" "-log 1 ramp.hdr" "-log 2 ramp.hdr" "ramp.hdr"
same "-log 0 is linear" "-log 0 ramp.hdr" "ramp.hdr"
same "-n: one step has one colour" "-lw 0 -cp -n 1 -s 400 ramp.hdr" "-lw 0 -cp -n 1 -s 400 one.hdr"
same "its default is 8" "-cp ramp.hdr" "-cp -n 8 ramp.hdr"
all_differ "-n matters to any style" "-s 400 ramp.hdr" "-n 5 -s 400 ramp.hdr" "-cp ramp.hdr" "-cp -n 5 ramp.hdr" \
    "-cl ramp.hdr" "-cl -n 5 ramp.hdr" "-cb ramp.hdr" "-cb -n 5 ramp.hdr"

# Looks.
all_differ "the styles" "-lw 0 -s auto ramp.hdr" "-lw 0 -s auto -cl ramp.hdr" "-lw 0 -s auto -cb ramp.hdr" "-lw 0 -s auto -cp ramp.hdr" \
    "-lw 0 -s auto -c0 ramp.hdr"
same "-c0 has no colours, and no legend" "-c0 ramp.hdr" "-c0 -pal hot -s 1 black.hdr"
palettes="def spec pm3d hot eco tbo viridis gray diverging vivid"
choices=()
for palette in $palettes; do choices+=("-pal $palette -s auto ramp.hdr"); done
all_differ "the palettes" "${choices[@]}"
same "def is the default" "-s auto ramp.hdr" "-pal def -s auto ramp.hdr"
check "the unknown palette's message knows them all" sh -c "$tool -pal x one.hdr 2>&1 | tr -d , | grep -q 'known are $palettes\$'"
other "-e" "ramp.hdr" "-e ramp.hdr"
other "... alone" "-c0 ramp.hdr" "-c0 -e ramp.hdr"
other "... in this picture" "-c0 -e half-ramp.hdr" "-c0 -e ramp.hdr"
same "-e twice is none" "ramp.hdr" "-e -e ramp.hdr"
other "-l" "ramp.hdr" "-l lux ramp.hdr"
same "its default is cd/m2" "ramp.hdr" "-l cd/m2 ramp.hdr"
other "-d" "-s 100 ramp.hdr" "-s 100 -d 0 ramp.hdr"
same "... at most so many decimals" "-s 100 ramp.hdr" "-s 100 -d 3 ramp.hdr"
same "... auto" "-s 100 ramp.hdr" "-s 100 -d 0 -d auto ramp.hdr"
same "-lw auto, -lh auto" "ramp.hdr" "-lw 30 -lh 70 -lw auto -lh auto ramp.hdr"
same "no height, no legend" "-lh 0 ramp.hdr" "-lw 0 ramp.hdr"
quiet "a label of any characters" "$tool" -l 'A label: {x} ~' -o label.png one.hdr

# The picture drawn on.
for style in -cl -cb -c0; do
    same "$style: -ip is -i and -p" "$style -s auto -ip ramp.hdr" "$style -s auto -p ramp.hdr -i ramp.hdr"
    other "$style: -p is the picture drawn on" "$style -p ramp.hdr one.hdr" "$style -p half.hdr one.hdr"
    other "$style: ... else black" "$style -ip ramp.hdr" "$style -i ramp.hdr"
done
same "-p alone is seen without colours" "-c0 -p half-ramp.hdr one.hdr" "-c0 -ip half-ramp.hdr"
same "-ip where colours cover it" "-ip ramp.hdr" "-i ramp.hdr"
other "--exposure" "-cb -ip ramp.hdr --exposure 0.25" "-cb -ip ramp.hdr --exposure .5"
same "... twice of the half" "-c0 --exposure .5 -p half-ramp.hdr one.hdr" "-c0 --exposure .25 -p ramp.hdr one.hdr"
same "... 0 is by the picture" "-c0 --exposure 0 -ip ramp.hdr" "-c0 -ip ramp.hdr"

# Differences.
same "none" "-lw 0 -s 1 --relative-difference one.hdr one.hdr" "-lw 0 -s 1 --relative-difference ramp.hdr ramp.hdr"
all_differ "none, less and more" "-lw 0 -s 1 --relative-difference one.hdr one.hdr" "-lw 0 -s 1 --relative-difference one.hdr half.hdr" \
    "-lw 0 -s 1 --relative-difference half.hdr one.hdr"
same "half as bright is the end of a scale to a half, as black is of one to 1" "-lw 0 -s .5 --relative-difference one.hdr half.hdr" \
    "-lw 0 -s 1 --relative-difference one.hdr black.hdr"
same "the scale is automatic" "--relative-difference one.hdr half.hdr" "-s auto --relative-difference one.hdr half.hdr"
same "... by default" "--relative-difference one.hdr half.hdr" "-s default --relative-difference one.hdr half.hdr"
same "... to a round number" "--relative-difference one.hdr half.hdr" "-s .5 --relative-difference one.hdr half.hdr"
other "1000 is 1000 here too" "--relative-difference one.hdr half.hdr" "-s 1000 --relative-difference one.hdr half.hdr"
same "diverging is the default" "--relative-difference one.hdr ramp.hdr" "-pal diverging --relative-difference one.hdr ramp.hdr"
same "... and a label" "--relative-difference one.hdr ramp.hdr" "-l (A-B)/B --relative-difference one.hdr ramp.hdr"
same "M cancels out" "--relative-difference one.hdr ramp.hdr" "-m 1 --relative-difference one.hdr ramp.hdr"
quiet "nothing to compare with" "$tool" --relative-difference black.hdr -o none.png one.hdr
quiet "by itself" "$tool" --relative-difference half.hdr -e -cl -o auto.png one.hdr
"$tool" -lw 0 -s 1 --relative-difference one.hdr half.hdr >less.hdr
check "one of both on standard input" sh -c "$tool -lw 0 -s 1 --relative-difference - half.hdr <one.hdr >b.hdr"
check "... gives the same difference" same_pixels less.hdr b.hdr

# Where options come from.
"$tool" -lw 0 -s 10 one.hdr >top.hdr
echo '-lw 0 -s 10' >options
check "options from a file" sh -c "$tool @options one.hdr >b.hdr"
check "... as given" same_pixels top.hdr b.hdr
check "options from the environment" sh -c "FALSE='-lw 0 -s 10' $tool '\$FALSE' one.hdr >b.hdr"
check "... as given " same_pixels top.hdr b.hdr
"$tool" -lw 30 -s 7 -cl -l 'a b' -d 2 -log 1.5 -m 2 -n 3 -e -pal hot -ip x --exposure .5 -defaults >defaults
check "-defaults can be read again" sh -c "$tool @defaults -defaults | cmp - defaults"
for words in "-lw 30" "-s 7" -cl "-l 'a b'" "-d 2" "-log 1.5" "-m 2" "-n 3" "-e+" "-pal hot" "-ip x" "--exposure 0.5" "-lh auto"; do
    check "... has $words" sh -c "cut -f 1 defaults | grep -qxF -- \"\$1\"" - "$words"
done
"$tool" -defaults >defaults
check "the defaults' defaults, too" sh -c "$tool @defaults -defaults | cmp - defaults"
same "... draw the same" "@defaults ramp.hdr" "ramp.hdr"
same "... and the same difference" "@defaults --relative-difference one.hdr half.hdr" "--relative-difference one.hdr half.hdr"
"$tool" -s auto -defaults >defaults
same "... with -s auto" "@defaults ramp.hdr" "-s auto ramp.hdr"
check "--help shows letters at their name" sh -c "$tool --help | grep -q '^  -cX '"

# Bad options and pictures.
fails "a missing picture" 1 "nowhere.hdr" "" "$tool" nowhere.hdr
fails "nothing on standard input" 1 "standard input" "" "$tool"
fails "no picture on standard input" 1 "standard input" "hello\n" "$tool"
fails "two pictures" 1 "only one picture" "" "$tool" one.hdr half.hdr
fails "options behind the picture" 1 "options stand before" "" "$tool" one.hdr -cl
fails "standard input twice" 1 "standard input can be only one" "" "$tool" -cl -p -
fails "two pictures to draw on" 1 "-ip" "" "$tool" -p one.hdr -ip one.hdr
for style in "-s 1" -cp; do
    fails "-p unseen ($style)" 1 "-p would not be seen" "" "$tool" $style -p one.hdr one.hdr
    fails "--exposure unseen ($style)" 1 "--exposure is for the picture drawn on" "" "$tool" $style --exposure 2 -ip one.hdr
done
fails "--exposure of no picture" 1 "--exposure is for the picture drawn on" "" "$tool" -cl --exposure 2 one.hdr
fails "pictures of two sizes" 1 "small.hdr: the picture is 20 x 40 pixels large, the input 60 x 40" "" "$tool" --relative-difference small.hdr one.hdr
fails "a logarithm of differences" 1 "-log" "" "$tool" -log 2 --relative-difference half.hdr one.hdr
fails "an unknown palette" 1 "known are def, spec" "" "$tool" -pal rainbow one.hdr
fails "an unknown style" 1 "-cx" "" "$tool" -cx one.hdr
fails "a scale of nothing" 1 "-s" "" "$tool" -s 0 one.hdr
fails "a scale that is no number" 1 "'x'" "" "$tool" -s x one.hdr
fails "a scale that is a picture" 1 "'a.hdr'" "" "$tool" -s a.hdr
for option in -lw -lh -d; do
    for word in 0.5 1e1 -1 a automatic 20000 x ""; do
        fails "$option '$word'" 1 "'$option' needs auto or a whole number from 0 to " "" "$tool" $option "$word" one.hdr
    done
    fails "$option alone" 1 "'$option' needs a whole number or auto" "" "$tool" $option
done
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
