#!/bin/bash
# The tools where memory runs out: each of their allocations fails in turn. TAP.
source "$(dirname "$0")/../support/tap.sh"
case ${BUILD:=build} in /*) ;; *) BUILD=$GRAZE_ROOT/$BUILD ;; esac
corpus=$GRAZE_ROOT/test/fuzz/corpus
cd "$work" || exit 2
exhaust() {
    local tool=$1
    shift
    "$BUILD/test/no_memory/$tool" "$@"
}

# A scene of all kinds of things. Binary files: the first byte of the corpus' says what they are.
tail -c +2 "$corpus/parts/mesh" >shape.rtm
tail -c +2 "$corpus/parts/instance" >nested.oct
printf '#?RADIANCE\noconv part.rad\nFORMAT=Radiance_octree\n\n\001\037-1.5\0-1.5\0-1.5\0003\0part.rad\0\0\0\0\0\002\0' >b.oct
printf 'void plastic red 0 0 5 .7 .1 .1 .05 .1\nred polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n' >part.rad
printf 'void glow small 0 0 4 3 3 3 0\nsmall sphere s 0 0 4 0 0 1 .05\n' >lamp.rad
printf -- '-t 0 0 1\n-t 0 1 1\n' >places
printf 'g=Px*.1;\nf(x,y,z)=x+y*.5;\no(x,y,z)=x;\nid(x)=x;\n' >all.cal
printf '2\n0 1 3\n0 1 2\n1 2 3 4 5 6\n' >two.dat
printf 'red\nnone\n' >modifiers
printf 'rvu -vp 0 .2 5 -vd 0 0 -1 -vu 0 1 0 -vh 40 -vv 40\n' >room.vf
cat >room.rad <<'EOF'
void light l 0 0 3 9 9 9
l sphere lamp 0 0 4 2 0 3 .2
l ring disc 0 0 8 1 1 3 0 0 -1 0 .2
void spotlight o 0 0 7 9 9 9 20 0 0 -1
o polygon spot 0 0 9 -1 -1 3 -1 -.8 3 -.8 -1 3
void glow sky 0 0 4 1 1 1 0
sky source all 0 0 4 0 0 1 360
l source sun 0 0 4 0 1 1 1
void glow g 0 0 4 5 5 5 2
g tube t 0 0 7 -1 -1 2 1 -1 2 .1
void brightdata far 5 id two.dat all.cal Px Py 0 0
far light ies 0 0 3 5 5 5
ies polygon panel 0 0 9 -1 1 3 -.8 1 3 -1 1.2 3
void glass pane 0 0 3 .9 .9 .9
void illum i 1 pane 0 3 4 4 4
i ring w 0 0 8 0 0 3 0 0 -1 0 1
void mirror m 1 pane 0 3 .8 .8 .8
m polygon reflector 0 0 12 -3 -3 0 -3 3 0 -3 3 3 -3 -3 3
void mist fog 1 lamp 0 7 .1 .2 .3 .9 .9 .8 .5
fog sphere cloud 0 0 4 0 0 1 3
void plastic red 0 0 5 .7 .1 .1 .05 .1
red sphere ball 0 0 4 0 0 0 1
void antimatter hole 2 red void 0 0
hole sphere cut 0 0 4 .5 0 .5 .6
void prism1 p 5 g 1 0 f(Dx,Dy,Dz) all.cal 0 0
p ring prism 0 0 8 0 0 1.2 0 0 1 0 .3
void metal2 b 4 1 0 0 . 0 6 .6 .6 .6 .9 .1 .3
void mixfunc x 4 red b Px all.cal 0 0
void mixfunc y 4 x void .3 . 0 0
y polygon floor 0 0 12 -2 -2 0 2 -2 0 2 2 0 -2 2 0
void mixdata z 7 red b id two.dat all.cal Px Py 0 0
z cone mixed 0 0 8 0 0 -1 0 0 1 .5 .2
void mixpict mp 7 red b red picture.hdr . Px Py 0 0
mp cylinder mixed2 0 0 7 -1 0 0 1 0 0 .5
void colorpict cp 7 red green blue picture.hdr . Px Py 0 0
cp trans tr 0 0 7 .5 .5 .5 .1 .1 .5 .5
tr bubble bub 0 0 4 .2 .2 .8 .3
void colordata cd 9 f f f two.dat two.dat two.dat all.cal Px Py 0 0
cd brightfunc bf 2 Px+Py . 0 0
bf colorfunc pf 4 f(Px,Py,1) .5 g all.cal 0 1 2
pf transfunc mf 2 f all.cal 0 6 .5 .5 .5 .3 .4 .2
mf cup u 0 0 8 0 0 0 0 1 0 .3 .6
void texfunc tx 4 Nx*.3 Ny g all.cal 0 0
tx texdata td 9 f f f two.dat two.dat two.dat all.cal Px Py 0 0
td BRTDfunc bt 10 .1 .1 .1 .2 0 0 f f f all.cal 0 9 .2 .2 .2 .3 .3 .3 .1 .1 .1
bt ring r 0 0 8 0 0 -1 0 0 1 0 5
void plasdata a 5 f two.dat all.cal o o 0 4 .5 .5 .5 .1
a cylinder c 0 0 7 -1 0 0 1 0 0 .5
void WGMDfunc wg 13 void .2 .1 .3 void .3 0 .2 void 0 1 0 . 0 9 .2 .2 .2 .1 .1 .1 .2 .2 .2
wg cone k 0 0 8 0 0 -1 0 0 .5 1 .2
void ashik2 h 4 1 1 0 . 0 8 .2 .2 .2 .3 .3 .3 100 1000
h sphere hs 0 0 4 1 -1 1 .2
void interface e 0 0 8 .9 .9 .9 1.3 .8 .8 .8 1
e sphere es 0 0 4 0 1 1 .2
void dielectric die 0 0 5 .9 .9 .8 1.5 0
die sphere ds 0 0 4 -1 1 1 .2
void alias other b
other sphere os 0 0 4 -1 -1 1 .2
!xform -n moved -a 3 -t 1 0 0 lamp.rad | xform -f places
!printf 'void plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere s 0 0 4 0 -1 1 .2\n'
void instance held 5 nested.oct -t 3 0 0
0 0
void instance held2 1 b.oct 0 0
red mesh tri 5 shape.rtm -t 0 3 0 0 0
EOF
printf 'void light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 3 1\nvoid plastic p 0 0 5 .5 .5 .5 .05 .1\np ring r 0 0 8 0 0 0 0 0 1 0 3\n' >small.rad
"$BIN/gpict" -n 1 -vf room.vf -x 8 -y 8 --samples 1 -o picture.hdr small.rad || exit 2
printf '0 0 5 0 0 -1\n0 .2 1.5 .6 0 -.8\n' >rays
printf '.2 .1 .9 .3 .1 .8\n' >eval
printf '.2 .1 .9 .3 .5\n' >sample
printf '.2 .1 .9\n' >albedo
: >mean
"$BIN/brdfeval" -ax .1 -ay .1 --grid tl=15:75:30,pl=0,tv=-80:80:20,pv=180 >plane.csv || exit 2

check "gtrace ends well" exhaust gtrace -n 1 -ab 1 --samples 4 room.rad <rays
check "... with all its options" exhaust gtrace -n 1 -w- -ab 1 --samples 4 -e 'k(x)=x;' -f all.cal -aE modifiers -tI modifiers \
    --model p=ward -otvn small.rad <rays
check "gpict ends well" exhaust gpict -n 1 -vf room.vf -x 8 -y 8 -ps 1 --error .5 -ab 1 -pa 0 small.rad
check "... into files" exhaust gpict -n 1 -vf room.vf -x 8 -y 8 --samples 2 -ab 0 -z depth.zbf -o layers.exr small.rad
for query in eval sample albedo mean; do
    check "brdfeval ends well: $query" exhaust brdfeval -q $query <$query
done
check "... of a material of a scene" exhaust brdfeval -M part.rad red <eval
check "... a table" exhaust brdfeval --grid tl=10:70:20,pl=0,tv=5:75:20,pv=180
check "brdffit ends well" exhaust brdffit plane.csv
check "... with a picture" exhaust brdffit --output json --plot fit.gp plane.csv
# Of the formats of measurements there are only files too short for a fit.
for file in alta alta-half cornell pab table; do
    tail -c +3 "$corpus/measurements/$file" >measured
    check "... a short file of $file" env EXPECTED_STATUS=1 "$BUILD/test/no_memory/brdffit" measured
done
check "gfalsecolor ends well" exhaust gfalsecolor -cl picture.hdr
check "... comparing" exhaust gfalsecolor --relative-difference picture.hdr -o false.exr picture.hdr
plan
