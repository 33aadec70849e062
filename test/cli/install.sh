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
# Every function that a public header declares GRAZE_API is in both libraries.
api_complete() {
    local name names
    names=$(cat include/graze/*.h | tr '\n' ' ' | sed -E 's/__attribute__\(\(([^()]|\([^()]*\))*\)\)//g' | grep -oE 'GRAZE_API [^(;]*\(' | grep -oE '[a-z_0-9]+\($' | tr -d '(' | sort -u)
    [ -n "$names" ] || return 1
    for name in $names; do
        nm -D --defined-only "$library" | grep -q " T $name\$" || { echo "not in libgraze.so: $name"; return 1; }
        nm -g --defined-only "$root/lib/libgraze.a" | grep -q " T $name\$" || { echo "not in libgraze.a: $name"; return 1; }
    done
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
check "everything is where it belongs" has bin/gtrace bin/gpict bin/brdfeval lib/libgraze.a lib/libgraze.so \
    lib/libgraze.so.0 lib/pkgconfig/graze.pc lib/graze/oiio.so include/graze/graze.h share/doc/graze/LICENSE
for tool in "$BIN"/*; do
    check "$(basename "$tool") has a manual page" has "share/man/man1/$(basename "$tool").1"
done
for page in "$root"/share/man/man?/*; do
    check "$(basename "$page") formats" bash -c 'w=$(groff -k -Tutf8 -ww -man -z "$0" 2>&1); echo "$w"; [ -z "$w" ]' "$page"
done
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
materials_alone() { "${CC:-cc}" -I"$root/include" examples/link_material.c "$root/lib/libgraze.a" -lm -o "$work/alone" && "$work/alone"; }
check "materials link with nothing but libm" materials_alone
check "make uninstall" make_quietly uninstall
check "nothing is left" test -z "$(installed_files)"
plan
