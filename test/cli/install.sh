#!/bin/bash
# What `make install` puts down: its layout, the libraries' names and symbols, and that a stranger's program builds against
# it by pkg-config, shared and static. TAP.
source "$(dirname "$0")/../support/tap.sh"
if [ -n "${GRAZE_SANITIZED:-}" ]; then
    echo "1..0 # SKIP the libraries are not built with sanitizers"
    exit
fi
cd "$GRAZE_ROOT" || exit 2

staging=$work/staging
prefix=/opt/graze
root=$staging$prefix
export PKG_CONFIG_PATH=$root/lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$staging
library=$root/lib/libgraze.so.0

not() { ! "$@"; }
installed_files() { (cd "$root" && find . ! -type d | LC_ALL=C sort); }
has() { for file in "$@"; do [ -s "$root/$file" ] || { echo "missing: $file"; return 1; }; done; }
soname() { [ "$(objdump -p "$library" | awk '$1 == "SONAME" { print $2 }')" = libgraze.so.0 ]; }
# Prints the names that do not begin with graze_, and fails if there are any or no graze_ name at all.
only_graze() {
    awk '$3 ~ /^graze_/ { ours++; next } { print; foreign++ } END { exit foreign || !ours }'
}
shared_symbols() { nm -D --defined-only "$library" | only_graze; }
static_symbols() { nm -g --defined-only "$root/lib/libgraze.a" | awk 'NF == 3' | only_graze; }
# The functions that the public headers declare GRAZE_API.
api() {
    cat include/graze/*.h | tr '\n' ' ' | sed -E 's/__attribute__\(\(([^()]|\([^()]*\))*\)\)//g' |
        grep -oE 'GRAZE_API [^(;]*\(' | grep -oE '[a-z_0-9]+\($' | tr -d '(' | sort -u
}
# All of them are in both libraries.
api_complete() {
    local name names
    names=$(api)
    [ -n "$names" ] || return 1
    for name in $names; do
        nm -D --defined-only "$library" | grep -q " T $name\$" || { echo "not in libgraze.so: $name"; return 1; }
        nm -g --defined-only "$root/lib/libgraze.a" | grep -q " T $name\$" || { echo "not in libgraze.a: $name"; return 1; }
    done
}
# man(1) finds a page for each, and the page shows the function's declaration.
manual_complete() {
    local name page pages=$root/share/man/man3
    for name in $(api); do
        [ -s "$pages/$name.3" ] || { echo "no page: $name"; return 1; }
        page=$(sed -n 's|^\.so man3/||p' "$pages/$name.3")
        grep -q "^\.BI\? .*[ *]$name(" "$pages/${page:-$name.3}" || { echo "not in the synopsis: $name"; return 1; }
    done
}
manual_links() {
    local link
    ! for link in $(grep -l '^\.so ' "$root"/share/man/man?/*); do
        [ -f "$root/share/man/$(sed -n 's/^\.so //p' "$link")" ] || echo "$link"
    done | grep .
}
compiled() { # EXAMPLE OUTPUT shared|static
    local flags libs
    flags=$(pkg-config --cflags graze) || return 1
    if [ "$3" = static ]; then
        # Only Graze itself is linked statically: Debian has no static Embree.
        libs="-L$root/lib -l:libgraze.a $(pkg-config --static --libs-only-l --libs-only-other graze | sed 's/-lgraze//')"
    else
        libs=$(pkg-config --libs graze) || return 1
    fi
    # shellcheck disable=SC2086
    "${CC:-cc}" -std=c11 -Wall -Wextra -Werror $flags -o "$2" "$1" $libs -lm
}
runs() { LD_LIBRARY_PATH=$root/lib "$@" </dev/null; }

make_quietly() { "${MAKE:-make}" --no-print-directory "$@" PREFIX=$prefix DESTDIR="$staging"; }

check "make install" make_quietly install
installed_files >"$work/files"
check "everything is where it belongs" has bin/gtrace bin/gpict bin/brdfeval bin/brdffit lib/libgraze.a lib/libgraze.so \
    lib/libgraze.so.0 lib/pkgconfig/graze.pc lib/graze/oiio.so include/graze/graze.h share/doc/graze/LICENSE
figures_complete() {
    local picture pictures
    pictures=$(grep -o '([a-z0-9]*\.png)' man/figures/README.md | tr -d '()')
    [ -n "$pictures" ] && has share/doc/graze/figures/README.md || return 1
    for picture in $pictures; do has "share/doc/graze/figures/$picture" || return 1; done
}
check "the page of figures has all its pictures" figures_complete
check "... and is where the manual says" grep -qF 'share/doc/graze/figures/README.md' "$root/share/man/man1/gpict.1"
check "the page on accuracy and speed is there" has share/doc/graze/performance/README.md
check "... and its plot" has share/doc/graze/performance/pictures.png
for tool in "$BIN"/*; do
    check "$(basename "$tool") has a manual page" has "share/man/man1/$(basename "$tool").1"
done
for page in "$root"/share/man/man?/*; do
    if grep -q '^\.so ' "$page"; then continue; fi
    check "$(basename "$page") formats" bash -c 'w=$(groff -t -k -Tutf8 -ww -man -z "$0" 2>&1); echo "$w"; [ -z "$w" ]' "$page"
done
check "every function of the headers has its manual page" manual_complete
check "manual pages by other names lead to pages that there are" manual_links
check "SONAME is libgraze.so.0" soname
check "the shared library shows only graze_*" shared_symbols
check "the static library shows only graze_*" static_symbols
check "both hold all that the headers declare" api_complete
check "nothing of the build's folders is in what is installed" not grep -rlF "$GRAZE_ROOT" "$root/lib/pkgconfig" "$root/include" "$root/share"
check "pkg-config knows the version" test "$(pkg-config --modversion graze)" = "$("$BIN/gtrace" --version | awk '{ print $NF }')"
for example in examples/*.c; do
    name=$(basename "$example" .c)
    for kind in shared static; do
        check "$name builds, $kind" compiled "$example" "$work/$name.$kind" $kind
        check "$name runs, $kind" runs "$work/$name.$kind"
    done
done
check "an installed tool runs" runs "$root/bin/gtrace" --version
# What Graze needs no other library for needs nothing but libm when it is linked statically.
alone() { # PROGRAM COMPILER... EXAMPLE
    local program=$1
    shift
    "$@" -Wall -Wextra -Wpedantic -Werror "-I$root/include" -x none "$root/lib/libgraze.a" -lm -o "$program" && "$program" >"$program.out"
}
for example in link_material link_brdf; do
    check "$example, static, with nothing but libm" alone "$work/alone" "${CC:-cc}" -std=c11 "examples/$example.c"
done
brdf_in_cpp() { # shared|static
    local libs=("$root/lib/libgraze.a" -lm)
    [ "$1" = static ] || read -r -a libs < <(pkg-config --libs graze)
    # shellcheck disable=SC2046
    "${CXX:-c++}" -std=c++17 -Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags graze) -x c++ examples/link_brdf.c -x none \
        "${libs[@]}" -o "$work/cpp" && runs "$work/cpp" >"$work/cpp.out" && cmp "$work/alone.out" "$work/cpp.out"
}
check "link_brdf in C++17, static" brdf_in_cpp static
check "link_brdf in C++17, shared" brdf_in_cpp shared
# Copied into another program's tree, the module gives the same, whatever the compiler makes of it.
module_alone() { # OPTION...
    "${CC:-cc}" -std=c11 "$@" -Iinclude -Isrc src/brdf/*.c examples/link_brdf.c -lm -o "$work/module" &&
        "$work/module" >"$work/module.out" && cmp "$work/alone.out" "$work/module.out"
}
check "src/brdf builds alone" module_alone
check "src/brdf builds alone, optimised for this processor" module_alone -O2 -march=native
check "make uninstall" make_quietly uninstall
check "nothing is left" test -z "$(installed_files)"
plan
