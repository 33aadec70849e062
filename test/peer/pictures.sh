#!/bin/bash
# Pictures between Graze and real Radiance: each reads what the other writes. TAP. Wants GRAZE_PEER_BIN, GRAZE_PEER_RAYPATH
# and the archives below BUILD.
source "$(dirname "$0")/../support/tap.sh"
build=$(cd "${BUILD:?}" && pwd) || exit 2
"${CC:-cc}" -std=c11 -D_POSIX_C_SOURCE=200809L -Iinclude -Isrc ${EXTRA_CFLAGS:-} -o "$work/pictures" test/peer/pictures.c \
    "$build/libimage.a" "$build/libbase.a" -lOpenEXRCore -ldl -lm -pthread || exit 2
cd "$work" || exit 2
export PATH="$work:${GRAZE_PEER_BIN:?}:$PATH" RAYPATH=".:${GRAZE_PEER_RAYPATH:-}" LC_ALL=C
set -o pipefail

# Radiance's decoded floats of a picture are ours, bit for bit.
same_floats() {
    pvalue -h -H -df "$1" >theirs && pictures floats "$1" >ours && [ -s ours ] && cmp theirs ours
}
# A picture through Radiance and back again: its values to within this share of each pixel's largest component.
radiance_reads_ours() { pictures make "a$1.hdr" "$1" "$2" && same_floats "a$1.hdr"; }
view_and_size() {
    getinfo -d <a64.hdr | grep -q '^-Y  *48 +X  *64$' && getinfo a64.hdr | grep -q '^	VIEW= -vtv -vp 1 2 3 ' &&
        [ "$(vwrays -d -vf a64.hdr -x 64 -y 64)" = "-x 64 -y 47" ]
}
filtered() { pfilt -1 -x 32 -y 24 a64.hdr >f.hdr && same_floats f.hdr; }
with_exposure() { pfilt -1 -e 3.7 a64.hdr >e.hdr && pictures near a64.hdr e.hdr .012; }
with_two_exposures() { pfilt -1 -e 3.7 a64.hdr | pfilt -1 -e .01 >e.hdr && pictures near a64.hdr e.hdr .02; }
color_corrected() { pfilt -1 -er 2 -eg 1 -eb .5 a64.hdr >c.hdr && grep -aq COLORCORR c.hdr && pictures near a64.hdr c.hdr .03; }
xyze() { ra_xyze $1 a64.hdr >x.hdr && grep -aq 'FORMAT=32-bit_rle_xyze' x.hdr && pictures near a64.hdr x.hdr .04; }
primaries() {
    ra_xyze -r -p .64 .33 .30 .60 .15 .06 .3127 .3290 a64.hdr >p.hdr && grep -aq '^PRIMARIES=' p.hdr &&
        pictures near a64.hdr p.hdr .04
}
raw_values() { pvalue -h -df a64.hdr | pvalue -r -h -df >r.hdr && same_floats r.hdr && pictures near a64.hdr r.hdr .004; }
narrow() { pvalue -h -df a7.hdr | pvalue -r -h -df >r.hdr && same_floats r.hdr && pictures near a7.hdr r.hdr .004; }
aspect() { pfilt -1 -p 2 -x 32 -y 48 a64.hdr >f.hdr && grep -aq '^PIXASPECT=' f.hdr && pictures copy f.hdr g.hdr && grep -aq '^PIXASPECT=' g.hdr; }
# Radiance says which colour is where, by coordinates, in the picture as it stands and in our copy of it, top to bottom.
same_places() {
    local from=$1
    shift
    "$@" "$from" >o.hdr && pictures copy o.hdr g.hdr && getinfo -d <g.hdr | grep -q '^-Y .*+X' &&
        ! getinfo -d <o.hdr | grep -q '^-Y .*+X' && pvalue -h -H o.hdr | sort >theirs && pvalue -h -H g.hdr | sort >ours &&
        [ "$(uniq theirs | wc -l)" = 3072 ] && diff theirs ours
}

for size in "1 3" "7 5" "8 5" "16 3" "17 3" "64 48" "129 9" "1000 20" "32767 2" "32768 2"; do
    # shellcheck disable=SC2086
    check "pvalue reads ${size/ / x } of ours, bit for bit" radiance_reads_ours $size
done
check "getinfo and vwrays find size and view" view_and_size
check "pfilt's picture, bit for bit" filtered
check "EXPOSURE= by pfilt" with_exposure
check "two EXPOSURE= by pfilt" with_two_exposures
check "COLORCORR= by pfilt" color_corrected
check "PIXASPECT= by pfilt" aspect
check "XYZE by ra_xyze, flat" xyze -u
check "XYZE by ra_xyze, run-length encoded" xyze -c
check "XYZE by ra_xyze at the original exposure" xyze -o
check "PRIMARIES= by ra_xyze" primaries
check "pvalue -r of floats" raw_values
check "pvalue -r of a narrow picture" narrow
check "turned left to right" same_places a64.hdr pflip -h
check "turned upside down" same_places a64.hdr pflip -v
check "turned both ways" same_places a64.hdr pflip -h -v
pflip -h a64.hdr >h.hdr
pflip -v a64.hdr >v.hdr
pflip -h -v a64.hdr >hv.hdr
for picture in a64 h v hv; do
    check "scanlines that are columns: $picture" same_places $picture.hdr protate
done
plan
