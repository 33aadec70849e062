#!/bin/bash
# The manual as a test: every example in man/man1/*.1 and README.md (```console) is run and must print what the page shows,
# each page formats without a warning, and a page and its tool's --help name the same options. TAP.
#
# A line "$ COMMAND" is run, joined with the next one where it ends in a backslash; the lines below it, if any, are the
# output it must give ("..." alone stands for any lines). A page's examples share one folder, in which `scenes` is a copy of
# the tree's. A command may fail only where the page shows an "error:". Blanks at lines' ends, which nobody sees, do not count.
set -u
shopt -s nullglob extglob
cd "${GRAZE_ROOT:?}" || exit 2
temporary=$(mktemp -d) || exit 2
trap 'rm -rf "$temporary"' EXIT
number=0

result() { # ok|"not ok" DESCRIPTION
    number=$((number + 1))
    printf '%s %d - %s\n' "$1" "$number" "$2"
}
comment() {
    sed 's/^/# /'
    echo
}

# The text of roff, macros' names and quotes gone.
unescape() {
    sed -E -e 's/^\.(BI|BR|IB|IR|RB|RI|B|I) +//' -e 's/\\f\[[A-Z]*\]//g; s/\\f[A-Z]//g; s/\\[&%|^]//g' \
        -e 's/\\-/-/g; s/\\\(aq/'"'"'/g; s/\\\(dq/"/g; s/\\\(ti/~/g; s/\\\(ha/^/g; s/\\\(ga/`/g; s/\\ / /g; s/\\\(bs/\\/g; s/\\\(rs/\\/g; s/\\e/\\/g; s/\\t/\t/g'
}

# The examples of a page: "$ ..." lines with what stands below them.
examples() {
    case $1 in
    *.md) awk '/^```/ { inside = !inside && /^```console/; next } inside' "$1" ;;
    *) awk '/^\.EX/ { inside = 1; next } /^\.EE/ { inside = 0 } inside' "$1" | unescape ;;
    esac
}

# Turns expected lines into a pattern for the whole output.
pattern_of() {
    local line pattern=
    while IFS= read -r line; do
        if [ "$line" = ... ]; then
            pattern+='?(*'$'\n'')'
        else
            pattern+=$(printf '%s' "$line" | sed 's/[][\\*?()|!@+]/\\&/g')$'\n'
        fi
    done
    printf '%s.' "$pattern"
}

RADIANCE='getinfo|oconv|pcond|pcomb|pfilt|pvalue|rcalc|rtrace|rpict|total|vwrays|xform|ra_[a-z0-9]+|falsecolor'

# One example: $command with the lines of $shown below it.
run_example() {
    local status output pattern name
    name="$page: $(printf '%s' "${command%%$'\n'*}" | tr -d '#')"
    if [ -z "${GRAZE_PEER_BIN:-}" ] && printf '%s\n' "$command" | grep -Eq "(^|[|;&(!\` ])($RADIANCE)( |\$)"; then
        result ok "$name # SKIP needs Radiance's tools"
        return
    fi
    (
        cd "$folder" || exit 2
        export PATH="$BIN:${GRAZE_PEER_BIN:+$GRAZE_PEER_BIN:}$PATH" RAYPATH=".:${GRAZE_PEER_RAYPATH:-}"
        timeout 300 bash -o pipefail -c "$command" </dev/null
    ) >"$temporary/output" 2>&1
    status=$?
    if [ $status -ne 0 ] && [[ $shown != *error:* ]]; then
        result "not ok" "$name"
        { echo "exit status $status"; head -n 20 "$temporary/output"; } | comment
        return
    fi
    if [ -n "$shown" ]; then
        # $(...) would drop empty lines at the end; the dot keeps them.
        output=$(sed 's/[ \t]*$//' "$temporary/output" && echo .)
        [[ $output == *$'\n'. ]] || output=${output%.}$'\n.'
        pattern=$(printf '%s' "$shown" | sed 's/[ \t]*$//' | pattern_of)
        # shellcheck disable=SC2053
        if [[ ${output%.} != ${pattern%.} ]]; then
            result "not ok" "$name"
            { echo "the page shows:"; printf '%s' "$shown" | head -n 20; echo "the command prints:"; head -n 20 "$temporary/output"; } | comment
            return
        fi
    fi
    result ok "$name"
}

check_examples() {
    local page=$1 folder command='' shown='' line continued=
    folder=$temporary/$(basename "$page")
    mkdir "$folder" && cp -r scenes "$folder/scenes"
    while IFS= read -r line; do
        if [ -n "$continued" ]; then
            command+=$'\n'${line#> }
        elif [[ $line == '$ '* ]]; then
            [ -n "$command" ] && run_example
            command=${line#'$ '} shown=
        elif [ -n "$command" ]; then
            shown+=$line$'\n'
            continue
        else
            continue
        fi
        continued=
        [[ $line == *\\ ]] && continued=yes
    done < <(examples "$page")
    [ -n "$command" ] && run_example
}

# The options in a text, one a line; the suffix that an option of --help or a page shows in capitals or brackets is cut off.
options_in() {
    grep -oE '(^|[][ ,|(])--?[A-Za-z][-A-Za-z0-9]*' | sed -E 's/^[][ ,|(]//; s/^(-[a-z]+)[A-Z]+$/\1/; s/-$//' | sort -u
}

check_options() {
    local page=$1 tool missing
    tool=$(basename "$page" .1)
    [ -x "$BIN/$tool" ] || { result "not ok" "$page: there is such a tool"; return; }
    "$BIN/$tool" --help | sed -nE 's/^  (--?[A-Za-z][-A-Za-z0-9]*).*/\1/p' | options_in >"$temporary/help"
    unescape <"$page" | tr '"' ' ' | options_in >"$temporary/named"
    awk '/^\.T[PQ]/ { getline; print }' "$page" | unescape | tr '"' ' ' | options_in >"$temporary/tags"
    missing=$(comm -23 "$temporary/help" "$temporary/named" | tr '\n' ' ')
    if [ -s "$temporary/help" ] && [ -z "$missing" ]; then
        result ok "$page: names every option of --help"
    else
        result "not ok" "$page: names every option of --help"
        echo "# missing: $missing"
    fi
    # Radiance's -version and -help do the same as --version and --help, which stand for them in --help.
    missing=$(comm -13 "$temporary/help" "$temporary/tags" | grep -vxE -e '-version|-help' | tr '\n' ' ')
    if [ -s "$temporary/tags" ] && [ -z "$missing" ]; then
        result ok "$page: describes no option that $tool has not"
    else
        result "not ok" "$page: describes no option that $tool has not"
        echo "# not in --help: $missing"
    fi
}

for page in man/man?/*.[0-9]; do
    warnings=$(groff -t -k -Tutf8 -ww -man -z "$page" 2>&1)
    if [ -z "$warnings" ]; then
        result ok "$page: formats without warnings"
    else
        result "not ok" "$page: formats without warnings"
        printf '%s\n' "$warnings" | head -n 20 | comment
    fi
done
for page in man/man1/*.1; do
    check_options "$page"
done
for page in README.md man/man1/*.1 man/man7/*.7; do
    check_examples "$page"
done
# Every tool has its page.
for tool in src/tools/*.c; do
    tool=$(basename "$tool" .c)
    if [ -f "man/man1/$tool.1" ]; then result ok "$tool has a page"; else result "not ok" "$tool has a page"; fi
done
echo "1..$number"
