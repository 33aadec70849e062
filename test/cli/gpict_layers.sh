#!/bin/bash
# gpict's OpenEXR pictures as OpenImageIO's oiiotool reads them: layers, what they add up to, and the header. TAP.
source "$(dirname "$0")/../support/tap.sh"
source "$(dirname "$0")/../support/rooms.sh"
cd "$work" || exit 2

closed_room >room.rad
"$BIN/gpict" -vh 90 -vv 90 -x 40 -y 40 -ab 2 --samples 32 -o a.exr room.rad
oiiotool --info -v a.exr >info 2>&1
says() { check "the header says $1" grep -qF -- "$1" info; }
says "40 x   40, 20 channel, float openexr"
says 'chromaticities: 0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 0.333333, 0.333333'
says 'whiteLuminance: 179'
says 'exposure: 1'
says 'radianceView: " -vtv -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 90 -vv 90'
says 'gpict -vh 90 -vv 90 -x 40 -y 40 -ab 2 --samples 32 -o a.exr room.rad"'
says 'software: "Graze'
for layer in R G B standard_error.{R,G,B} samples.Y depth.Z normal.{X,Y,Z} {albedo,direct,indirect}.{R,G,B}; do
    check "there is $layer" sh -c "grep '^    channel list:' info | tr -d ',' | tr ' ' '\n' | grep -qxF $layer"
done

# layer NAME FILE: that layer as a picture.
layer() { oiiotool a.exr --ch "$1.R,$1.G,$1.B" --chnames R,G,B -o "$2"; }
layer direct direct.exr
layer indirect indirect.exr
layer albedo albedo.exr
oiiotool a.exr --ch R,G,B -o value.exr
oiiotool direct.exr indirect.exr --add -o sum.exr
check "value = direct + indirect" oiiotool --fail 1e-6 --diff sum.exr value.exr
# channel_range FILE: least and largest values, channel by channel.
range() { oiiotool --stats "$1" | awk '/Stats M/ { print $2, $3, $4, $5 }'; }
range albedo.exr >albedo
# Gray walls .5; the ball's red .95 x .7 + .05 in the limit of looking straight at it; lights 0.
check "albedos are those of the materials" awk '/Min/ && $2 != 0 { exit 1 } /Max/ && ($2 < .7 || $2 > .72 || $3 < .499 || $3 > .51) { exit 1 }' albedo
range indirect.exr >indirect
check "there is indirect light, and none is negative" awk '/Min/ && $2 < 0 { exit 1 } /Max/ && !($2 > 0.001) { exit 1 }' indirect
plan
