#!/bin/bash
# brdfeval --grid: tables of planes and hemispheres, as CSV and in NumPy's format, against records that ask for the same. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
brdfeval=$BIN/brdfeval
python=${PYTHON:-python3}

# An NPY file as a line of its names, one of its shape, and its points as CSV, with nothing of NumPy.
cat >read_npy.py <<'EOF'
import ast, struct, sys
data = open(sys.argv[1], "rb").read()
assert data[:8] == b"\x93NUMPY\x01\x00", data[:8]
length = struct.unpack("<H", data[8:10])[0]
assert (10 + length) % 64 == 0 and data[9 + length:10 + length] == b"\n"
header = ast.literal_eval(data[10:10 + length].decode("ascii"))
assert set(header) == {"descr", "fortran_order", "shape"} and header["fortran_order"] is False
order = {"<f8": "<", ">f8": ">"}[header["descr"][0][1]]
assert len({kind for name, kind in header["descr"]}) == 1
names = [name for name, kind in header["descr"]]
assert len(set(names)) == len(names)
count = 1
for size in header["shape"]:
    count *= size
assert len(data) == 10 + length + 8 * count * len(names), len(data)
print(*header["shape"], file=sys.stderr)
print(",".join(names))
for row in struct.iter_unpack(order + "d" * len(names), data[10 + length:]):
    print(",".join("%.17g" % x for x in row))
EOF
as_numbers() { "$python" -c 'import sys
print(sys.stdin.readline(), end="")
for line in sys.stdin: print(",".join("%.17g" % float(x) for x in line.split(",")))'; }

# table DESCRIPTION NAMES SHAPE SPEC OPTIONS...: the columns' names; as many points as the shape says; the answers that records of
# the inputs get, to the bit; the same in NPY; the same bytes on any number of threads.
table() {
    local description=$1 names=$2 shape=$3 spec=$4
    shift 4
    "$brdfeval" --grid "$spec" "$@" >table 2>err
    result $? "$description" err
    check "... columns" test "$(head -1 table)" = "$names"
    check "... points" test "$(($(wc -l <table) - 1))" -eq "$((${shape// /*} + 0))"
    local inputs
    inputs=$(echo "$names" | tr , '\n' | grep -cE '^(theta|phi|[stu]$)')
    tail -n +2 table | cut -d, -f1-"$inputs" | tr , ' ' | "$brdfeval" --angles "$@" | sed 's/\t$//' | tr '\t' , >answers
    check "... answers" sh -c "tail -n +2 table | cut -d, -f$((inputs + 1))- | cmp - answers"
    "$brdfeval" --npy --grid "$spec" "$@" >table.npy
    "$python" read_npy.py table.npy >from_npy 2>shape
    result $? "... NPY" shape
    as_numbers <table >from_csv
    check "... has the same numbers" cmp from_npy from_csv
    check "... and dimensions" test "$(cat shape)" = "$shape"
    for n in 2 3 4; do
        check "... one thread and $n" sh -c "'$brdfeval' -n $n --grid '$spec' $* | cmp - table"
        check "... in NPY" sh -c "'$brdfeval' -n $n -x 7 --npy --grid '$spec' $* | cmp - table.npy"
    done
}
table "a plane" "theta_l,phi_l,theta_v,phi_v,f" "179" "tl=60,pl=180,tv=-89:89:1" -a .2
table "a hemisphere, in more than one portion" "theta_l,phi_l,theta_v,phi_v,f,c,p,w,P,W" "3 31 61" "tl=0:80/3 tv=0:90:3 pv=0:360/61" -ax .2 -ay .3 -rd .1 -o fcpwPW
table "order is as named" "theta_l,phi_l,theta_v,phi_v,f" "2 3 4 2" "pv=0:9/2,tl=10:30:10,pl=1:4/4,tv=20:10:-10" -ax .2 -ay .3
table "albedos" "theta_v,phi_v,a,A" "46" "tv=0:90:2" -q albedo -o aA -a .2
table "samples" "theta_v,phi_v,s,t,lx,ly,lz,p,w" "2 9 8" "tv=30:60/2,s=/9,t=/8" -q sample -ax .2 -ay .4
table "pairs" "theta_v,phi_v,s,t,u,P,W" "5 4 2" "s=/5,t=0:.75:.25,u=/2,tv=80" -q pair -o PW -a .3
echo "void metal2 brass 4 1 0 0 . 0 6 .68 .27 .002 .9 .1 .2" >brass.rad
table "a material" "theta_l,phi_l,theta_v,phi_v,f_r,f_g,f_b,p,w_r,w_g,w_b" "10" "tl=0:81:9,tv=40,pv=180" -M brass.rad brass -o fpw
check "a scene from standard input" sh -c "'$brdfeval' -M - brass -o fpw --grid tl=0:81:9,tv=40,pv=180 <brass.rad | cmp - table"
# One point has no dimensions: one array of one structure.
"$brdfeval" --npy --grid tl=5 >table.npy
check "a single point" test "$("$python" read_npy.py table.npy 2>shape | wc -l) $(tr -d '\n' <shape)" = "2 "
table "other than one thread's portions" "theta_l,phi_l,theta_v,phi_v,f" "101 103" "tl=0:90/101,tv=0:90/103" -a .5

# Values.
# values DESCRIPTION EXPECTED VALUES: of theta_v
values() {
    "$brdfeval" -q albedo --grid "tv=$3" -rs 0 >out 2>err
    check "$1" test "$(tail -n +2 out | cut -d, -f1 | tr '\n' ' ' | sed 's/ $//')" = "$2"
}
values "one value" "37.5" 37.5
values "steps" "0 1 2 3" 0:3:1
values "steps that do not meet the end" "0 0.3 0.6 0.9" 0:1:.3
values "steps of a tenth, without rounding errors to be seen" "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 1" 0:1:.1
values "an end beside a step does not bend the values before it" "0 30 60 89.9999999999999" 0:89.9999999999999:30
values "... down" "1 0.7 0.4 0.10000000000000009" 1:.10000000000000009:-.3
values "steps down" "3 2 1 0 -1" 3:-1:-1
values "the end in spite of rounding" "89.9 89.92 89.94 89.96 89.98 90" 89.9:90:.02
values "a step too far" "0" 0:1:2
values "no way to go" "7" 7:7:1
values "points with both ends" "-30 -10 10 30" -30:30/4
values "one point" "4" 4:4/1
values "exponents and signs" "-100 100" -1e2:+1E2/2
check "a theta below 0 is the opposite azimuth" test "$("$brdfeval" --grid tl=40,tv=-20,pl=10,pv=30 | tail -1 | cut -d, -f5)" = \
    "$(echo "40 10 20 210" | "$brdfeval" --angles | tr -d '\t')"
check "an end just below 1" test "$("$brdfeval" -q pair --grid "s=0:.9999999999999999:.1" | tail -n +2 | cut -d, -f3 | tr '\n' ' ')" = \
    "0 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9 0.9999999999999999 "
"$brdfeval" --npy -q albedo --grid "tv=.1:1.2000000000000002:.12345678901234567" >steps.npy
check "steps of no decimal are FROM + i STEP" "$python" -c 'import struct, sys
data = open("steps.npy", "rb").read(); data = data[10 + struct.unpack("<H", data[8:10])[0]:]
values = [v for v, _, _ in struct.iter_unpack("=ddd", data)]
sys.exit(values != [.1 + i * .12345678901234567 for i in range(9)])'
check "midpoints" test "$("$brdfeval" -q sample --grid s=/4 | tail -n +2 | cut -d, -f3 | tr '\n' ' ')" = "0.125 0.375 0.625 0.875 "
check "a symmetric grid is symmetric to the bit" sh -c "'$brdfeval' -q albedo -rs 0 --grid tv=-1:1/14 | awk -F, 'NR > 1 { v[NR - 1] = \$1 }
    END { for (i = 1; i <= 14; i++) if (v[i] + v[15 - i] != 0) exit 1 }'"

# Independent of all else: the table of a hemisphere integrates to the albedo. The trapezoidal rule is exact for many digits
# over the circle; over theta, halving the step must quarter the error, and taking that out leaves a millionth.
for setting in "-a .3" "-ax .2 -ay .4" "-a .4 -m ward-neumann" "-a .5 -rs .5 -rd .3"; do
    for step in 1 .5; do
        # shellcheck disable=SC2086
        "$brdfeval" $setting -o c --grid "tv=50,pv=30,tl=0:90:$step,pl=0:356:4" | awk -F, -v step=$step '
            NR > 1 { r = atan2(0, -1) / 180; sum += $5 * sin($1 * r) } END { printf "%.9f ", sum * step * r * 4 * r }'
    done >integrals
    # shellcheck disable=SC2086
    "$brdfeval" -q albedo $setting --grid tv=50,pv=30 | tail -1 | cut -d, -f3 >>integrals
    check "a hemisphere integrates to the albedo, $setting" awk '{ whole = (4 * $2 - $1) / 3; d = whole / $3 - 1; print $0, whole; exit d * d > 1e-12 }' integrals
done
# ... and the mean of samples' weights over a grid of random numbers is the albedo, too.
check "weights' mean is the albedo" sh -c "'$brdfeval' -q pair -a .3 -o W --grid tv=70,s=/300,t=/300 | awk -F, 'NR > 1 { sum += \$6 } END { printf \"%.4f\", sum / (NR - 1) }' >mean
    '$brdfeval' -q albedo -a .3 --grid tv=70 | awk -F, 'NR > 1 { printf \"%.4f\", \$3 }' | cmp - mean"

# A table of any size: only what is read is made.
"$brdfeval" --grid "tl=0:90/1000000,tv=0:90/1000000" 2>err | head -3 >out
check "a table too large to finish begins at once" test "$(wc -l <out)" -eq 3
check "... and ends with its reader" grep -q "cannot write" err

# Wrong descriptions.
refuses() { fails "$1" 1 "$2" "" "$brdfeval" --grid "${@:3}"; }
refuses "no assignment" "'' names no values" ""
refuses "nothing but commas" "names no values" ", ,"
refuses "a word" "'sixty' at character 6: expected NAME=VALUE" "tl=0,sixty"
refuses "no value" "'tl=' at character 1: expected" "tl="
refuses "no number" "'tl=x' at character 1: expected" "tl=x"
refuses "a number and more" "'tl=1x' at character 1: expected" "tl=1x"
refuses "an end without a step" "'tl=1:2' at character 1: expected" "tl=1:2"
refuses "a step missing" "'tl=1:2:' at character 1: expected" "tl=1:2:"
refuses "four numbers" "'tl=1:2:1:1' at character 1: expected" "tl=1:2:1:1"
refuses "infinity" "'tl=1e999' at character 1: expected" "tl=1e999"
refuses "nan" "'tl=nan' at character 1: expected" "tl=nan"
refuses "an unknown input" "'tx=1' at character 6: there is no such input; inputs: tl pl tv pv" "tl=0,tx=1"
refuses "an input of another query" "'tl=1' at character 1: there is no such input; inputs: tv pv s t u" "tl=1" -q pair
refuses "an input twice" "'tl=1' at character 6: this input has values already" "tl=1 tl=1"
refuses "steps of 0" "too many steps" "tl=0:1:0"
refuses "steps away" "these steps do not lead from FROM to TO" "tl=0:1:-1"
refuses "no points" "COUNT has to be a whole number, at least 1" "tl=0:1/0"
refuses "half a point" "COUNT has to be a whole number" "tl=0:1/2.5"
refuses "a word for a count" "COUNT has to be a whole number" "tl=0:1/x"
refuses "one point with two ends" "a single value cannot be at both ends" "tl=0:1/1"
refuses "midpoints of angles" "'tl=/4' at character 1: expected" "tl=/4"
refuses "too many steps" "too many steps" "tl=0:1:1e-300"
refuses "too many points" "'tv=0:1/9e9' at character 12: too many points" "tl=0:1/9e9,tv=0:1/9e9"
refuses "a random number of 1" "less than 1" "s=0:1/5" -q sample
refuses "a random number below 0" "at least 0" "t=-.5:0:.1" -q sample
refuses "binary answers" "-fad does not go with --grid" "tl=5" -fad
refuses "a header" "-h does not go with --grid" "tl=5" -h
refuses "--angles" "leave out --angles" "tl=5" --angles
refuses "a field twice" "-o: a table can have the field 'f' only once" "tl=5" -o fcf
fails "--npy without a table" 1 "it needs --grid" "" "$brdfeval" --npy
check "ASCII is what it prints" sh -c "'$brdfeval' -fa --grid tl=5 >/dev/null"
if [ -w /dev/full ]; then
    "$brdfeval" --grid tl=0:90:1 >/dev/full 2>err
    check "a full disk" test "$? $(grep -c "No space" err)" = "2 1"
fi

# Progress on a terminal, and nowhere else.
cat >on_terminal.py <<'EOF'
import os, pty, subprocess, sys
master, slave = pty.openpty()
with open(sys.argv[1], "rb") as records, open(sys.argv[2], "wb") as answers:
    process = subprocess.Popen(sys.argv[3:], stdin=records, stdout=slave if sys.argv[2] == "/dev/null" else answers, stderr=slave)
    os.close(slave)
    while True:
        try:
            some = os.read(master, 4096)
        except OSError:
            break
        if not some:
            break
        sys.stdout.buffer.write(some)
    sys.exit(process.wait())
EOF
export TERM=xterm
unset NO_COLOR
for i in {1..3000}; do echo ".6 0 .8 -.6 0 .8"; done >records
"$python" on_terminal.py /dev/null out "$brdfeval" --grid tl=0:90:1,pl=0:359:1 >shown
check "a table shows how far it is" grep -q 'tabulating .*%' shown
check "... and is whole" test "$(wc -l <out)" -eq 32761
"$python" on_terminal.py records out "$brdfeval" >shown
check "so do records from a file" grep -q 'evaluating .*%' shown
check "... which are all answered" test "$(wc -l <out)" -eq 3000
NO_COLOR=1 "$python" on_terminal.py records out "$brdfeval" >shown
check "not with NO_COLOR" test ! -s shown
"$python" on_terminal.py records /dev/null "$brdfeval" >shown
check "not where answers go to the same terminal" sh -c "! grep -q evaluating shown"
"$python" on_terminal.py /dev/null /dev/null "$brdfeval" --grid tl=0:90:30 >shown
check "... nor a table" sh -c "grep -q theta_l shown && ! grep -q tabulating shown"
plan
