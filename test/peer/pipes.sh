#!/bin/bash
# Radiance's own programs before and after Graze's in pipes, and pictures and views passed between them. TAP.
source "$(dirname "$0")/../support/tap.sh"
cd "$work" || exit 2
export PATH="$BIN:${GRAZE_PEER_BIN:?}:$PATH" RAYPATH=".:${GRAZE_PEER_RAYPATH:?}" LC_ALL=C
set -o pipefail

# same A B: two texts are equal, and not empty.
same() { [ -n "$1" ] && [ "$1" = "$2" ] && return; diff <(printf "%s\n" "$1") <(printf "%s\n" "$2"); return 1; }
# close A B: numbers equal within RGBE's steps (a part in 128, half a step of each of two roundings).
close() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; if (d < 0) d = -d; if (a > 0 && d <= a / 128) exit 0; print a, "and", b; exit 1 }'; }

# Everything shines by itself, so that no answer needs a random number.
cat >glows.rad <<'END'
void glow white 0 0 4 2 2 2 0
void glow red 0 0 4 3 .5 .25 0
void glow blue 0 0 4 .125 .5 4 0
void glow dusk 0 0 4 .3 .2 .6 0
red sphere ball 0 0 4  .31 .2 .1 .83
blue polygon tile 0 0 12  -3.1 3.2 -1.7  2.9 3.2 -1.7  2.8 3.6 1.9  -3.2 3.6 1.9
white ring disk 0 0 8  -1.3 -.4 .7  .3 1 -.2  .2 .9
white cylinder pole 0 0 7  1.7 .3 -1.2  1.4 .9 1.8  .17
dusk source sky 0 0 4  0 .2 1 240
END
cat >lit.rad <<'END'
void plastic grey 0 0 5 .5 .4 .3 .05 .1
grey sphere ball 0 0 4  0 0 0 1
void light lamp_light 0 0 3 100 100 100
lamp_light sphere lamp 0 0 4  2 -3 4 .3
END
oconv glows.rad >glows.oct
view='-vp .2 -4 .3 -vd -.05 1 -.04 -vu .1 0 1'
size='-x 61 -y 47'
views=("-vtv $view -vh 60 -vv 50 -vs .1 -vl -.2" "-vtl $view -vh 5 -vv 4" "-vtc $view -vh 120 -vv 60"
    "-vth $view -vh 150 -vv 140" "-vta $view -vh 200 -vv 180 -vl .1" "-vts $view -vh 160 -vv 150")

# shellcheck disable=SC2086
{
header_is_a_picture() {
    vwrays -ff $size $view | gtrace -ffc $(vwrays -d $size $view) glows.rad >a.hdr &&
        rpict -w $size $view glows.oct >r.hdr && same "$(getinfo -d <a.hdr)" "$(getinfo -d <r.hdr | sed 's/  */ /g')" &&
        same "$(pvalue -h -H a.hdr | wc -l)" "$(vwrays $size $view | wc -l)"
}
bytes_like_radiance() {
    vwrays -ff $size $view | gtrace -h -fff glows.rad >floats
    pvalue -r -h -df -y $(getinfo -d <a.hdr | awk '{ print $2 " +x " $4 }') floats >b.hdr && same "$(pvalue -h -H a.hdr)" "$(pvalue -h -H b.hdr)"
}
filtered() {
    pfilt -1 -x /2 -y /2 a.hdr >half.hdr && close "$(pvalue -h -H -d -b half.hdr | total -m)" "$(pvalue -h -H -d -b a.hdr | total -m)"
}
one_pipe() {
    same "$(vwrays -ff -x 60 -y 60 $view | gtrace -ffc -x 60 -y 60 glows.rad | pfilt -1 -x /3 -y /3 | pvalue -h -H -d -b | wc -l)" 400
}
rays_by_rcalc() {
    local first second
    cnt 20 | rcalc -e '$1=$1/10-.97;$2=-5;$3=.13;$4=0;$5=1;$6=0' >rays.txt
    cnt 20 | rcalc -of -e '$1=$1/10-.97;$2=-5;$3=.13;$4=0;$5=1;$6=0' >rays.flt
    first=$(gtrace -h glows.rad <rays.txt | rcalc -e '$1=.265*$1+.670*$2+.065*$3')
    second=$(gtrace -h -ff glows.rad <rays.flt | rcalc -if3 -e '$1=.265*$1+.670*$2+.065*$3')
    same "$first" "$second"
}
header_stripped() {
    local plain
    plain=$(gtrace -h -ff glows.rad <rays.flt | od -An -tx1)
    same "$plain" "$(gtrace -ff glows.rad <rays.flt | getinfo - | od -An -tx1)"
}
header_fields() {
    gtrace -ff -ovL glows.rad <rays.flt >answers && getinfo <answers >header
    grep -q 'FORMAT= *float' header && grep -q 'NCOMP=4' header && grep -q BigEndian=0 header || { cat header; return 1; }
}
same_numbers_as_rtrace() { same "$(gtrace -h -ovLsN glows.rad <rays.txt)" "$(rtrace -h -w -ovLsN glows.oct <rays.txt)"; }
double_precision() { same "$(rcalc -od -if6 -e '$1=$1;$2=$2;$3=$3;$4=$4;$5=$5;$6=$6' rays.flt | gtrace -h -fdd glows.rad | rcalc -id3 -e '$1=$1;$2=$2;$3=$3')" \
    "$(gtrace -h -fff glows.rad <rays.flt | rcalc -if3 -e '$1=$1;$2=$2;$3=$3')"; }
defaults_of_rtrace() {
    # Mist and photon maps, which Graze has not.
    rtrace -defaults | sed -e 's/#.*//' -e '/^-m[eags] /d' -e '/^-am /d' >rtrace.options
    same "$(gtrace @rtrace.options -h- glows.rad <rays.txt)" "$(gtrace -h glows.rad <rays.txt)"
}

# Pictures pixel by pixel as rpict makes them with one ray through each pixel's middle.
picture_like_rpict() {
    gpict $1 $size -pj 0 --samples 2 glows.rad >g.hdr && rpict -w -ps 1 -pj 0 $1 $size glows.oct >r.hdr || return 1
    same "$(getinfo -d <g.hdr)" "$(getinfo -d <r.hdr)" && same "$(pvalue -h g.hdr)" "$(pvalue -h r.hdr)" && return
    diff <(pvalue -h g.hdr) <(pvalue -h r.hdr)
    return 1
}
view_read_back() { same "$(vwrays -vf g.hdr $size)" "$(vwrays -vf r.hdr $size)"; }
view_of_radiance() {
    gpict -vf r.hdr $size -pj 0 --samples 2 glows.rad >again.hdr && same "$(pvalue -h again.hdr)" "$(pvalue -h g.hdr)"
}
view_of_a_file() {
    printf 'rvu -vtv -vp 1 1 1 -vd 0 0 -1\nrvu %s\n' "$1" >view.vf
    gpict -vf view.vf $size -pj 0 --samples 2 glows.rad >again.hdr && same "$(pvalue -h again.hdr)" "$(pvalue -h g.hdr)" &&
        same "$(vwrays -vf view.vf $size)" "$(vwrays -vf again.hdr $size)"
}
rays_of_the_picture() {
    vwrays -ff -vf g.hdr $size | gtrace -ffc $(vwrays -d -vf g.hdr $size) glows.rad >traced.hdr &&
        same "$(pvalue -h -H traced.hdr)" "$(pvalue -h -H g.hdr)"
}
}
lit_picture() {
    gpict -x 48 -y 48 -vp 0 -5 2 -vd 0 5 -2 --samples 64 lit.rad >lit.hdr && pfilt -1 -e 2 lit.hdr | pcomb -s .5 - >combined.hdr
    close "$(pvalue -h -H -d -b lit.hdr | total -m)" "$(pvalue -h -H -d -b combined.hdr | total -m)"
}
no_oconv() { same "$(echo '0 -5 .1 0 1 0' | gtrace -h -os '!xform -t 0 0 .1 glows.rad')" "$(echo '0 -5 .1 0 1 0' | rtrace -h -w -os '!oconv "!xform -t 0 0 .1 glows.rad"')"; }

quiet "vwrays | gtrace -ffc makes a picture of vwrays' size" header_is_a_picture
quiet "its pixels are what pvalue makes of the floats" bytes_like_radiance
quiet "pfilt averages it" filtered
quiet "vwrays | gtrace | pfilt | pvalue in one pipe" one_pipe
quiet "rays by rcalc, ASCII and float; answers back into rcalc" rays_by_rcalc
quiet "getinfo - strips the header of binary answers" header_stripped
quiet "the header names format, components and byte order" header_fields
quiet "ASCII answers are rtrace's to the letter" same_numbers_as_rtrace
quiet "doubles in and out" double_precision
quiet "what rtrace -defaults prints are options" defaults_of_rtrace
for v in "${views[@]}"; do
    quiet "gpict's pixels are rpict's: ${v:0:4}" picture_like_rpict "$v"
    quiet "vwrays reads the picture's VIEW= line: ${v:0:4}" view_read_back
    quiet "gpict -vf of a picture by rpict: ${v:0:4}" view_of_radiance
    quiet "gpict -vf of a view file: ${v:0:4}" view_of_a_file "$v"
    quiet "vwrays -vf picture | gtrace gives the picture: ${v:0:4}" rays_of_the_picture
done
quiet "pfilt and pcomb over a lit picture" lit_picture
quiet "a !command as scene" no_oconv
fails "a real octree is told from a scene" 1 "an octree is not read yet" "" gtrace glows.oct
plan
