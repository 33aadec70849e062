#!/bin/bash
# The public headers as a stranger's compiler sees them: each stands alone, twice, in pedantic C11 and in C++17, and what it
# declares keeps its C name in C++. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$GRAZE_ROOT" || exit 2

warnings=(-Wall -Wextra -Wpedantic -pedantic-errors -Werror)
compile_c() { "${CC:-cc}" -std=c11 "${warnings[@]}" -Wstrict-prototypes -Iinclude -c -o "$work/c.o" -x c "$1"; }
compile_cpp() { "${CXX:-c++}" -std=c++17 "${warnings[@]}" -Iinclude -c -o "$work/cpp.o" -x c++ "$1"; }

# The functions a header declares.
declared() { tr '\n' ' ' <"$1" | grep -oE 'GRAZE_API [^(;]*\(' | grep -oE '[a-z_0-9]+\($' | tr -d '('; }

# From C++, each function's address is asked for by the name that the C library has.
c_names() {
    local name names
    names=$(declared "$1")
    [ -n "$names" ] || { echo "no function found in $1"; return 1; }
    {
        echo "#include <graze/$(basename "$1")>"
        echo "using function = void (*)();"
        echo "extern const function functions[];"
        echo "const function functions[] = {"
        for name in $names; do echo "    reinterpret_cast<function>($name),"; done
        echo "};"
    } >"$work/names.cpp"
    compile_cpp "$work/names.cpp" || return 1
    for name in $names; do
        nm -u "$work/cpp.o" | grep -qw "$name" || { echo "$name is not extern \"C\""; return 1; }
    done
}

umbrella() {
    local header missing=0
    for header in include/graze/*.h; do
        [ "$header" = include/graze/graze.h ] || grep -q "#include \"graze/$(basename "$header")\"" include/graze/graze.h ||
            { echo "graze.h leaves out $header"; missing=1; }
    done
    return $missing
}

for header in include/graze/*.h; do
    name=$(basename "$header")
    # The declaration keeps the file from being empty, which C does not allow.
    printf '#include <graze/%s>\n#include <graze/%s>\nextern int nothing_else;\n' "$name" "$name" >"$work/alone"
    check "$name stands alone in C11" compile_c "$work/alone"
    check "$name stands alone in C++17" compile_cpp "$work/alone"
    if grep -q '^GRAZE_API' "$header"; then
        check "the functions of $name keep their C names in C++" c_names "$header"
    fi
done
check "graze.h includes all others" umbrella
plan
