#!/bin/bash
# gtrace -ot and -oT: the rays that answers consist of. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
gtrace=$BIN/gtrace

cat >room.rad <<'END_OF_SCENE'
void metal2 shiny 4 1 1 0 . 0 6 .6 .6 .6 .8 .1 .2
void plastic glazed 0 0 5 .5 .4 .3 .2 0
void light white 0 0 3 9 8 7
void glow dusk 0 0 4 .3 .2 .6 0
shiny polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0
glazed sphere ball 0 0 4 0 1 1 .7
white sphere lamp 0 0 4 0 -3 3 .3
dusk source sky 0 0 4 0 0 1 180
END_OF_SCENE
for i in $(seq 60); do echo "0 -4 1.$i .0$((i % 40 + 10)) 1 -.$((i % 30 + 10))"; done >rays
tree() { "$gtrace" -h -ab 2 "$@" room.rad <rays; }

# Answers are the last lines of trees, with nothing before them but their parts.
tree -otv >trees
check "one ray of depth 0 for each ray" test "$(grep -c '^[^	]' trees)" -eq 60
check "deeper ones before it" test "$(grep -c '^	' trees)" -gt 60
check "... several deep" grep -q '^		[^	]' trees
check "none skips a depth" awk '{ match($0, /^\t*/); depth = RLENGTH; if (NR > 1 && depth < last - 1) exit 1; last = depth } END { exit last != 0 }' trees
# Lines of so many words: answers, where rays have fewer letters.
of() { awk -v words="$1" 'NF == words'; }
check "letters before t are of the answer" test "$(tree -oovts | of 6 | wc -l)" -eq 60
check "... which is that of the tree" test "$(tree -ovts | of 3)" = "$(tree -otv | grep '^[^	]')"
check "... behind it" test "$(tree -ovts | grep -n '^[0-9]' | head -n 1 | cut -d : -f 1)" -eq "$(($(tree -ots | grep -n '^[a-z*]' | head -n 1 | cut -d : -f 1) + 1))"

# Contributions of the deepest rays sum up to the answer, shadow rays included.
sums() { awk '{ match($0, /^\t*/); depth = RLENGTH
    if (below[depth + 1] != "") { a = $1 - below[depth + 1]; if (a > 2e-6 * $1 || -a > 2e-6 * $1) { print; bad = 1 } many++; delete below[depth + 1] }
    below[depth] += $1; if (depth == 0) delete below } END { exit bad || many < 60 }'; }
for paths in 1 8; do check "contributions of $paths paths sum up" sums < <(tree -oTV --samples $paths); done
check "-oT has shadow rays to lamps, -ot has none" test "$(tree -oTs | grep -c lamp)" -gt "$(tree -ots | grep -c lamp)"
check "--samples asks for so many paths" test "$(tree -ots --samples 8 | wc -l)" -gt "$(($(tree -ots | wc -l) * 3))"
mean() { awk '{ sum += $1 } END { printf "%.4f\n", sum / NR }'; }
check "the mean over many paths is the answer" awk -v a="$(tree -ovts --samples 256 | of 3 | mean)" -v b="$(tree --samples 4096 | mean)" 'BEGIN { exit !(a / b > .98 && a / b < 1.02) }'
check "weights are 1 at the root" test "$(tree -otwW | grep '^[^	]' | sort -u)" = "$(printf '1.000000e+00\t1.000000e+00\t1.000000e+00\t1.000000e+00\t')"

# The same bytes, whatever the threads.
for n in 1 2 5; do tree -n $n -oTodvVwWlLpnNsmM --samples 4 >n$n; done
check "one thread and two" cmp n1 n2
check "one thread and five" cmp n1 n5

# Modifiers.
check "-ti tells of one modifier" test "$(tree -ti white -oTm | tr -d '\t' | sort -u)" = white
check "-te of all others" test "$(tree -te white -te dusk -oTm | tr -d '\t' | sort -u | tr '\n' ' ')" = "glazed shiny "
check "... rays that meet nothing are not excluded" test "$(echo "0 0 5 1 0 -.001" | "$gtrace" -h -ld -te shiny -otm room.rad)" = "$(printf '*\t')"
check "... nor included" test -z "$(echo "0 0 5 1 0 -.001" | "$gtrace" -h -ld -ti shiny -otm room.rad)"
check "without t or T they do nothing" cmp <(tree -ti white) <(tree)

check "the header counts no numbers" bash -c "! '$gtrace' -otv room.rad </dev/null | grep NCOMP"
check "binary trees have tabs and numbers" test "$(head -n 1 rays | "$gtrace" -h -fad -otw room.rad | tail -c 8 | od -An -tf8 | tr -d ' ')" = 1
check "a ray at a time" bash -c '
    coproc '"$gtrace"' -h -ots room.rad
    for i in 1 2 3; do
        echo "0 0 5 0 0 1" >&${COPROC[1]}
        read -t 20 answer <&${COPROC[0]} || exit 1
        [ "$answer" = sky ] || exit 1
    done'
fails "e, which only answers have" 1 "standard error" "" "$gtrace" -otve room.rad
fails "... before t, too" 1 "standard error" "" "$gtrace" -oetv room.rad
fails "t and T" 1 "once" "" "$gtrace" -otTv room.rad
fails "t alone" 1 "no letters" "" "$gtrace" -ot room.rad
fails "t in four-byte colors" 1 "-fc" "" "$gtrace" -fac -otv room.rad
check "one path a tree is allowed" test "$(tree --samples 1 -ovts | of 3 | wc -l)" -eq 60
check "t without letters behind it is no tree" cmp <(tree -ovt) <(tree -ov)
"$gtrace" -h -oVW room.rad <rays 2>&1 >/dev/null | grep -q 'without t or T'
result $? "V and W without t or T get a warning"
plan
