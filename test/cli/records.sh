#!/bin/bash
# Records through a tool, on one thread and several: the first error ends the run, and everything before it is answered. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
gtrace=$BIN/gtrace

echo "void light white 0 0 3 9 9 9 white sphere lamp 0 0 4 0 3 2 .3" >room.rad
ray="0 0 2 0 1 0"
yes "$ray" | head -1000 >rays
"$gtrace" -h -os room.rad <rays >all
check "a thousand rays" test "$(sort all | uniq -c | awk '{ print $1, $2 }')" = "1000 lamp"
for format in f d; do
    "$gtrace" -h -fa$format -ood room.rad <rays >"rays.$format"
    check "-f$format" test "$("$gtrace" -h -f${format}a -os room.rad <"rays.$format" | wc -l)" -eq 1000
done

# ends NAME RECORD MESSAGE FORMAT FILE: on any number of threads one error, and all answers before it.
ends() {
    local good=1
    for n in 1 2 3 4; do
        "$gtrace" -h -n $n -f$4a -os room.rad <"$5" >out 2>err
        [ $? -eq 1 ] && [ "$(wc -l <out)" -eq $(($2 - 1)) ] && [ "$(wc -l <err)" -eq 1 ] && grep -q "record $2$3" err || { good=0; break; }
    done
    check "$1" test $good -eq 1
}
sed '300s/2/two/; 310s/2/too/; 500s/2/nan/; 1000s/.*/1 2/' rays >words
ends "the first of several words that are no numbers" 300 ": 'two' is not a number" a words
check "... with its line and column" grep -q 'standard input:300:5: record' err
sed '64s/2/x/; 65s/2/x/' rays >words
ends "the last record of a chunk" 64 ": 'x'" a words
sed '65s/2/1e999/; 129s/2/x/' rays >words
ends "the first record of a chunk" 65 ": '1e999' is too large" a words
sed '1s/0/x/; 2s/0/x/' rays >words
ends "the first record" 1 ": 'x'" a words
sed '1000s/ 0$//' rays >words
ends "a record cut short behind good ones" 1000 " is cut short: 5 of 6 numbers" a words
sed '999s/2/x/; 1000s/ 0$//' rays >words
ends "a record cut short behind a bad one" 999 ": 'x'" a words
{ head -c 7224 rays.f; printf '\377\377\377\377'; tail -c +7229 rays.f; printf 'cut'; } >bad.f
ends "a float that is not finite" 302 ": its number 1 is not finite" f bad.f
{ cat rays.f; printf 'cut'; } >bad.f
ends "floats cut short" 1001 " is cut short: 3 of 24 bytes" f bad.f
{ cat rays.d; printf 'cut'; } >bad.d
ends "doubles cut short" 1001 " is cut short: 3 of 48 bytes" d bad.d

# Numbers of records.
for n in 1 4; do
    check "too many are left alone, -n $n" test "$(sed '71s/.*/x/' rays | "$gtrace" -h -n $n -y 70 -os room.rad 2>&1 | wc -l)" -eq 70
    fails "too few, -n $n" 1 "standard input ended after 70 of 71 records" "$(for i in $(seq 70); do printf "$ray\\\\n"; done)" \
        "$gtrace" -h -n $n -y 71 -os room.rad
    check "... are answered" test "$(wc -l <out)" -eq 70
    fails "too few and a bad one, -n $n" 1 "record 2" "$ray\nx" "$gtrace" -h -n $n -y 71 -os room.rad
    check "... has one message" test "$(grep -c error: err)" -eq 1
done

# Inputs and outputs that stay open or fail.
mkfifo pipe
exec 3<>pipe
[ ! -r /proc/self/mem ] || exec 4</proc/self/mem
for n in 1 4; do
    printf "$ray\n$ray\n0 0 x 0 0 1\n" >&3
    timeout 60 "$gtrace" -h -n $n -os room.rad <pipe >out 2>err
    check "a bad record ends the run though more may come, -n $n" test "$? $(wc -l <out) $(wc -l <err)" = "1 2 1"
    (sleep 1 >/dev/null; printf "$ray\n" >&3) &
    timeout 60 "$gtrace" -h -n $n -os room.rad <pipe 2>err | true
    check "a closed output ends the run though more may come, -n $n" test "${PIPESTATUS[0]} $(wc -l <err)" = "2 1"
    wait
    "$gtrace" -h -n $n -os room.rad <. >out 2>err
    check "a directory for input, -n $n" test "$? $(cat err)" = \
        "1 gtrace: error: standard input: record 1: cannot read: Is a directory"
    if [ -r /proc/self/mem ]; then # nothing is at address 0
        "$gtrace" -h -n $n -os room.rad <&4 >out 2>err
        check "a failing read, -n $n" test "$? $(cat err)" = \
            "2 gtrace: error: standard input: record 1: cannot read: Input/output error"
    fi
    "$gtrace" -h -n $n -os room.rad <&- >out 2>err
    check "no input at all, -n $n" test "$? $(grep -c 'Bad file descriptor' err)" = "2 1"
    "$gtrace" -h -n $n -os room.rad <rays >/dev/full 2>err
    check "a full disk, -n $n" test "$? $(grep -c 'No space left' err)" = "2 1"
done
exec 3>&- 4<&-
plan
