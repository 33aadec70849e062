#!/bin/bash
# The tree's own rules: which folder may include which (USES_ in the Makefile), no exit below src/tools, pure mathematics in
# src/brdf, a line of purpose at the top of each file. Each rule is first tried on a small tree that breaks it. TAP.
set -u
cd "${GRAZE_ROOT:?}" || exit 2
temporary=$(mktemp -d) || exit 2
trap 'rm -rf "$temporary"' EXIT
number=0

# Every rule prints the offences it finds in the tree at hand, "FILE: WHAT", and nothing when there are none.

sources() { find "$@" -type f \( -name '*.c' -o -name '*.h' -o -name '*.cpp' \) 2>/dev/null | LC_ALL=C sort; }

# A file without its comments; `code` also without what stands in quotes.
uncommented() {
    awk -v RS='\001' '{
        while (match($0, /\/\*|\/\/|"([^"\\\n]|\\.)*"|\047([^\047\\\n]|\\.)+\047/)) {
            token = substr($0, RSTART, RLENGTH)
            printf "%s", substr($0, 1, RSTART - 1)
            rest = substr($0, RSTART + RLENGTH)
            if (token == "/*") { end = index(rest, "*/"); rest = end ? substr(rest, end + 2) : ""; printf " " }
            else if (token == "//") { end = index(rest, "\n"); rest = end ? substr(rest, end) : "" }
            else printf "%s", token
            $0 = rest
        }
        printf "%s", $0
    }' "$1"
}
code() { uncommented "$1" | sed -E 's/"([^"\\]|\\.)*"/""/g'; }

# "FOLDER USED" for each folder and each that it may use, what those use included.
permitted() {
    sed -nE 's/^USES_([a-z]+) *:= *(.*)/\1 \2/p' Makefile | awk '
        { for (i = 2; i <= NF; i++) { uses[$1, $i] = 1; name[$i] = 1 } name[$1] = 1 }
        END {
            for (k in name) for (i in name) for (j in name) if (uses[i, k] && uses[k, j]) uses[i, j] = 1
            for (i in name) for (j in name) if (uses[i, j]) print i, j
        }'
}

table_is_sound() {
    local folder
    permitted >"$temporary/permitted"
    awk '$1 == $2 { print "Makefile: " $1 " may, by others, use itself" }' "$temporary/permitted"
    for folder in src/*/; do
        folder=$(basename "$folder")
        [ "$folder" = tools ] || grep -q "^USES_$folder *:=" Makefile || echo "Makefile: no USES_$folder"
    done
}

includes_keep_to_the_table() {
    local file folder included used
    permitted >"$temporary/permitted"
    for file in $(sources src); do
        folder=${file#src/} folder=${folder%%/*}
        for included in $(uncommented "$file" | sed -nE 's/^[[:space:]]*#[[:space:]]*include[[:space:]]*"([^"]*)".*/\1/p'); do
            used=${included%%/*}
            if [ "$used" = "$included" ] || [ "$used" = .. ]; then
                echo "$file: \"$included\" does not name its folder"
            elif [ "$used" != "$folder" ] && [ "$used" != graze ] && { [ "$folder" != tools ] || [ ! -d "src/$used" ]; } &&
                ! grep -qx "$folder $used" "$temporary/permitted"; then
                echo "$file: $folder may not use \"$included\""
            fi
        done
    done
}

public_headers_use_public_headers_only() {
    local file
    for file in $(sources include); do
        uncommented "$file" | grep -E '^[[:space:]]*#[[:space:]]*include[[:space:]]*"' | grep -v '"graze/' | sed "s|^|$file: |"
    done
}

# _exit is let pass: a forked child whose exec failed has no other way out.
nothing_below_the_tools_exits() {
    local file
    for file in $(sources src); do
        [[ $file == src/tools/* ]] ||
            code "$file" | grep -nE '\b(exit|_Exit|quick_exit|abort|assert)[[:space:]]*\(' | sed "s|^|$file: line |"
    done
}

brdf_is_pure_mathematics() {
    local file
    for file in $(sources src/brdf); do
        code "$file" | grep -nEw 'malloc|calloc|realloc|free|alloca|aligned_alloc|FILE|f?printf|fopen|fputs|puts|errno|_Thread_local' |
            sed "s|^|$file: line |"
        uncommented "$file" | grep -E '^[[:space:]]*#[[:space:]]*include[[:space:]]*<' |
            grep -vE '<(math|float|limits|stdbool|stddef|stdint|string)\.h>' | sed "s|^|$file: |"
    done
}

every_file_begins_with_its_purpose() {
    local file first
    for file in $(sources src include test examples); do
        IFS= read -r first <"$file"
        [[ $first =~ ^(/\*|//)\ [A-Za-z].{5} ]] || echo "$file: begins with \"$first\""
    done
}

# holds DESCRIPTION RULE: in this tree.
holds() {
    number=$((number + 1))
    "$2" >"$temporary/offences"
    if [ ! -s "$temporary/offences" ]; then
        echo "ok $number - $1"
    else
        echo "not ok $number - $1"
        sed 's/^/# /' "$temporary/offences"
    fi
}

# notices RULE EXPECTED: in the tree of offences, the rule names these files and no others.
notices() {
    local found
    number=$((number + 1))
    found=$(cd "$temporary/tree" && "$1" | sed 's/:.*//' | LC_ALL=C sort -u | tr '\n' ' ')
    if [ "$found" = "$2 " ]; then
        echo "ok $number - notices offences: $1"
    else
        echo "not ok $number - notices offences: $1"
        echo "# found: $found"
        echo "# expected: $2"
    fi
}

# plant FILE: standard input, below a line of purpose, into the tree of offences.
plant() {
    mkdir -p "$temporary/tree/$(dirname "$1")" && { echo "/* What this file is good for. */"; cat; } >"$temporary/tree/$1"
}
printf 'USES_base :=\nUSES_brdf :=\nUSES_rad := base\nUSES_scene := rad\nUSES_one := two\nUSES_two := one\n' |
    { mkdir -p "$temporary/tree" && cat >"$temporary/tree/Makefile"; }
plant src/base/up.c <<<'#include "rad/view.h"'
plant src/base/quoted.c <<<'const char *s = "abort(1) /* "; /* exit(1) malloc(1) #include "rad/view.h" */ // abort(2)'
plant src/brdf/allocates.c <<<'void *f(void) { return malloc(1); }'
plant src/brdf/prints.c <<<'#include <stdio.h>'
plant src/brdf/pure.c <<<'#include <math.h>'
plant src/rad/bare.h <<<'#include "view.h"'
plant src/rad/leaves.c <<<'void f(void) { exit(1); }'
plant src/rad/child.c <<<'void f(void) { _exit(127); }'
plant src/rad/stops.c <<<'void f(void) { abort (); }'
plant src/scene/down.c <<<'#include "base/report.h"'
plant src/tools/tool.c <<<'#include "scene/down.h"
int main(void) { exit(0); }'
plant src/tools/lost.c <<<'#include "nowhere/lost.h"'
plant src/unlisted/some.c </dev/null
plant include/graze/inner.h <<<'#include "rad/view.h"'
mkdir -p "$temporary/tree/test" && echo '#include <math.h>' >"$temporary/tree/test/purposeless.c"

notices table_is_sound "Makefile"
notices includes_keep_to_the_table "src/base/up.c src/rad/bare.h src/tools/lost.c"
notices public_headers_use_public_headers_only "include/graze/inner.h"
notices nothing_below_the_tools_exits "src/rad/leaves.c src/rad/stops.c"
notices brdf_is_pure_mathematics "src/brdf/allocates.c src/brdf/prints.c"
notices every_file_begins_with_its_purpose "test/purposeless.c"

holds "the table of folders covers src and has no circles" table_is_sound
holds "a folder includes only what the Makefile's table lets it use" includes_keep_to_the_table
holds "public headers include public headers only" public_headers_use_public_headers_only
holds "nothing below src/tools ends the program" nothing_below_the_tools_exits
holds "src/brdf allocates, reads and writes nothing" brdf_is_pure_mathematics
holds "every file begins with its purpose" every_file_begins_with_its_purpose
echo "1..$number"
