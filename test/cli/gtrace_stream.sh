#!/bin/bash
# gtrace as a filter: what it holds in memory does not grow with what passes. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
gtrace=$BIN/gtrace
if [ ! -r /proc/self/status ] || [ -n "${GRAZE_SANITIZED:-}" ]; then
    echo "1..0 # SKIP peak memory is not known here, or not gtrace's own"
    exit
fi

printf 'void plastic grey 0 0 5 .5 .5 .5 0 0 grey sphere ball 0 0 4 0 0 0 1\n' >ball.rad
for i in $(seq 64); do echo "0 -3 .$i 0 1 0"; done | "$gtrace" -h -fad -ood ball.rad >rays
# 2^19 rays of 48 bytes: 24 MiB.
for i in $(seq 13); do cat rays rays >more && mv more rays; done

# Peak memory in KiB of gtrace once it has answered that many rays, with more to come.
peak() { # COUNT OPTION...
    local count=$1
    shift
    mkfifo in out
    "$gtrace" -h "$@" ball.rad <in >out &
    local pid=$!
    exec 5>in 6<out
    head -c $((count * 48)) rays >&5 &
    head -c $((count * 8)) <&6 | wc -c | grep -qx $((count * 8)) && awk '$1 == "VmHWM:" { print $2 }' "/proc/$pid/status"
    exec 5>&- 6<&-
    wait "$pid"
    rm in out
}
# With what is under way, 8192 rays a thread, gtrace takes 12 and 18 MiB; it would take 36 if it kept what passes.
for threads in 2 7; do
    kibibytes=$(peak 524288 -fd -oL -n $threads)
    check "2^19 rays, 24 MiB in and 4 MiB out, on $threads threads: $kibibytes KiB" test "$kibibytes" -lt $((24 * 1024))
done
plan
