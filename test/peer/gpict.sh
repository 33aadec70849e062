#!/bin/bash
# gpict beside real Radiance: the same rays for every view, the same lens and shutter, and pictures that Radiance reads. TAP.
# Wants GRAZE_PEER_BIN, GRAZE_PEER_RAYPATH and PYTHON with numpy.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
export PATH="${GRAZE_PEER_BIN:?}:$PATH" RAYPATH=".:${GRAZE_PEER_RAYPATH:-}" LC_ALL=C
gpict=$BIN/gpict

cat >room.rad <<'END'
void plastic red 0 0 5 .7 .1 .1 0 0
red sphere ball 0 0 4 0 5 0 1
void plastic blue 0 0 5 .1 .1 .7 0 0
blue sphere small 0 0 4 .8 3 .3 .3
void light white 0 0 3 9 9 9
white sphere lamp 0 0 4 2 3 2 .3
END
oconv room.rad >room.oct || exit 2

# near FILE FILE TOLERANCE: floats that agree to this part of the larger of each two.
near() {
    ${PYTHON:-python3} - "$@" <<'END'
import sys
import numpy as np
a, b = (np.fromfile(f, np.float32).astype(float) for f in sys.argv[1:3])
assert a.size == b.size, (a.size, b.size)
assert len(set(a)) > 100, "a dull picture"
bad = np.abs(a - b) > float(sys.argv[3]) * np.maximum(a, b)
assert not bad.any(), (np.flatnonzero(bad)[:5], a[bad][:5], b[bad][:5])
END
}

# The distances of what is seen through every pixel's centre: points, directions and clipping are all in them.
for type in v l c h a s; do
    size="-vh 50 -vv 40"
    [ $type = l ] && size="-vh 4 -vv 3"
    for clip in "" "-vo 3.2 -va 4.6"; do
        view="-vt$type -vp .1 .2 .3 -vd .1 1 .05 -vu .1 0 1 $size -vs .1 -vl -.2 $clip"
        rm -f theirs.hdr theirs.z
        # shellcheck disable=SC2086
        rpict $view -x 60 -y 60 -ps 1 -pj 0 -z theirs.z -o theirs.hdr room.oct 2>/dev/null
        # shellcheck disable=SC2086
        "$gpict" $view -x 60 -y 60 -pj 0 --samples 2 -z ours.z -o ours.hdr room.rad
        check "view -vt$type $clip: the rays are rpict's" near theirs.z ours.z 1e-4
    done
done

# Blur, of surfaces in light that comes from everywhere alike: rpict has one sample a pixel, so its picture is made large and
# averaged down.
light="-av 1 1 1 -dv- -vh 40 -vv 40"
# The difference of a and b is what chance makes of it, and less than the blur.
alike() {
    ${PYTHON:-python3} - "$@" <<'END'
import sys
import numpy as np
a, b, sharp = (np.fromfile(f, np.float32).astype(float) for f in ("a", "b", "sharp"))
rms = lambda x: float(np.sqrt(np.mean(x * x)))
print("difference", rms(a - b), "blur", rms(a - sharp))
assert rms(a - b) < 0.012, rms(a - b)
assert rms(a - sharp) > 0.03, rms(a - sharp)
END
}
# With 400 samples, a pixel half of .7 and half of 0 is off by .0175 + .0175 / sqrt(2) at most; few are.
averaged() { pfilt -1 -x 30 -y 30 "$1" | pvalue -h -H -df; }
floats() { pvalue -h -H -df "$1"; }
# shellcheck disable=SC2086
{
    "$gpict" $light -x 30 -y 30 --samples 400 room.rad >sharp.hdr
    floats sharp.hdr >sharp
    rpict $light -vd 0 1.5 0 -pd .5 -ps 1 -pj 1 -x 600 -y 600 room.oct >theirs.hdr 2>/dev/null
    "$gpict" $light -vd 0 1.5 0 -pd .5 --samples 400 -x 30 -y 30 room.rad >ours.hdr
}
averaged theirs.hdr >a
floats ours.hdr >b
check "depth of field blurs as rpict's" alike
printf 'VIEW= -vp 0 0 0\nVIEW= -vp .8 0 0\n' >views
# shellcheck disable=SC2086
{
    rm -f theirs?.hdr
    rpict $light -S 1 -pm .8 -ps 1 -pj 1 -x 600 -y 600 -o theirs%d.hdr room.oct <views 2>/dev/null
    "$gpict" $light -S 1 -pm .8 --samples 400 -x 30 -y 30 -o ours%d.hdr room.rad <views
    "$gpict" $light -vp .8 0 0 -x 30 -y 30 --samples 400 room.rad >sharp.hdr
}
floats sharp.hdr >sharp
averaged theirs2.hdr >a
floats ours2.hdr >b
check "motion blurs as rpict's" alike

# What Radiance's programs make of our pictures.
"$gpict" -S 7 -vp .1 .2 .3 -vtv -vh 40 -vv 30 -x 64 -y 64 --samples 4 -o p%d.hdr room.rad <<<'VIEW= -vs .1'
check "getinfo finds the view" sh -c "getinfo p7.hdr | grep -q '^	VIEW= -vtv -vp 0.1 0.2 0.3 -vd 0 1 0 -vu 0 0 1 -vh 40 -vv 30 -vo 0 -va 0 -vs 0.1 -vl 0'"
check "... the frame, the command and the size" sh -c "getinfo p7.hdr | grep -q '^	FRAME=7' && getinfo p7.hdr | grep -q 'gpict -S 7 -vp .1' && getinfo -d p7.hdr | grep -q -- '-Y *47 +X *64'"
check "vwrays takes the view" sh -c "[ \"\$(vwrays -d -vf p7.hdr -x 64 -y 64)\" = '-x 64 -y 47' ]"
check "rpict takes the view" sh -c "rpict -vf p7.hdr -x 8 -y 8 room.oct 2>/dev/null | getinfo | grep -q 'vs 0.1'"
check "pfilt filters it" sh -c "pfilt -x 32 -y 23 p7.hdr | getinfo -d | grep -q -- '-Y *23 +X *32'"
check "ra_tiff converts it" sh -c "ra_tiff p7.hdr p.tif && test -s p.tif"
check "pvalue reads it" sh -c "[ \$(pvalue -h -H p7.hdr | wc -l) = $((64 * 47)) ]"
# Other colours, brought back to Radiance's by Radiance: RGBE's precision is 1/128 of the largest channel, twice.
colors=(-vh 40 -vv 40 -x 32 -y 32 --samples 16)
"$gpict" "${colors[@]}" -o rgb.hdr room.rad
floats rgb.hdr >sharp
for option in "-pXYZ" "-pc .64 .33 .3 .6 .15 .06 .3127 .329"; do
    # shellcheck disable=SC2086
    "$gpict" "${colors[@]}" $option -o other.hdr room.rad
    ra_xyze -r -o other.hdr >back.hdr
    floats back.hdr >a
    check "$option: ra_xyze brings the colors back" "${PYTHON:-python3}" -c '
import numpy as np
a, b = (np.fromfile(f, np.float32).astype(float).reshape(-1, 3) for f in ("a", "sharp"))
assert b.max() > 0.01
assert (np.abs(a - b).max(1) <= 0.02 * b.max(1)).all(), np.abs(a - b).max()'
done
# Distances as pinterp wants them: the picture from where it was is itself.
"$gpict" -vh 40 -vv 40 -x 64 -y 64 -pj 0 --samples 4 -z q.z -o q.hdr room.rad
check "pinterp takes picture and distances" sh -c "pinterp -vf q.hdr -x 64 -y 64 -ff q.hdr q.z >r.hdr 2>/dev/null && pvalue -h -H -df q.hdr >a && pvalue -h -H -df r.hdr | cmp - a"
plan
