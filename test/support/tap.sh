# What the shell tests share; to be sourced. Gives a folder of its own that goes away at the end ($work), and prints TAP.
set -u
: "${GRAZE_ROOT:=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)}"
: "${BIN:=$GRAZE_ROOT/bin}"
export GRAZE_ROOT BIN
work=$(mktemp -d) || exit 2
trap 'rm -rf "$work"' EXIT
results=0

# result STATUS DESCRIPTION [LOG...]: one test's result; the logs are shown where it failed.
result() {
    local status=$1 description=$2
    shift 2
    results=$((results + 1))
    if [ "$status" -eq 0 ]; then
        echo "ok $results - $description"
    else
        echo "not ok $results - $description"
        [ $# -eq 0 ] || cat "$@" | tail -n 20 | sed 's/^/# /'
    fi
}

# check DESCRIPTION COMMAND...: the command must succeed.
check() {
    local description=$1
    shift
    "$@" >"$work/check.log" 2>&1
    result $? "$description" "$work/check.log"
}

# quiet DESCRIPTION COMMAND...: the command must succeed without a word on standard error.
quiet() {
    local description=$1
    shift
    "$@" >"$work/check.log" 2>"$work/err" && [ ! -s "$work/err" ]
    result $? "$description" "$work/err" "$work/check.log"
}

# fails DESCRIPTION STATUS TEXT INPUT COMMAND...: the command, fed the input (as printf %b has it), must end with the status and
# say the text on standard error. What it printed is left in $work/out.
fails() {
    local description=$1 status=$2 text=$3 input=$4
    shift 4
    printf '%b' "$input" | "$@" >"$work/out" 2>"$work/err"
    local got=$?
    echo "exit status $got" >>"$work/err"
    [ "$got" -eq "$status" ] && grep -qF -- "$text" "$work/err"
    result $? "$description" "$work/err"
}

# The plan, at the end.
plan() { echo "1..$results"; }
