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
# White mirrors, whose reflectance has no Fresnel term: trees of rays without a random number.
cat >mirrors.rad <<'END'
void metal mirror 0 0 5 1 1 1 1 0
void alias silver mirror
void glow red 0 0 4 3 .5 .25 0
void glow blue 0 0 4 .125 .5 4 0
void glow dusk 0 0 4 .3 .2 .6 0
mirror polygon left 0 0 12 -1 -2 -2  -1 4 -2  -1 4 2  -1 -2 2
silver polygon right 0 0 12 1.5 -2 -2  1.5 -2 2  1.5 4 2  1.5 4 -2
mirror sphere ball 0 0 4 .2 1.5 0 .4
red ring coal 0 0 8 0 4 0 0 -1 0 0 .9
blue polygon tile 0 0 12  -1 -2 -1  1.5 -2 -1  1.5 -2 1  -1 -2 1
dusk source sky 0 0 4  0 0 1 100
END
oconv glows.rad >glows.oct
oconv mirrors.rad >mirrors.oct
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
# rtrace's answers beside gtrace's, among the mirrors: both_trace OPTIONS. It leaves the normals of sources uninitialised, so n
# and N are asked of rays that meet none.
mirror_rays() { cnt 20 | rcalc -of -e '$1=$1/10-.97;$2=-1.9;$3=.13;$4=sin($1*37);$5=1;$6=cos($1*91)/4'; }
both_trace() {
    mirror_rays | rtrace -w -h -lr 3 -st 0 -ffa "$@" mirrors.oct >theirs.txt && mirror_rays | gtrace -h -lr 3 -ffa "$@" mirrors.rad >ours.txt &&
        [ -s ours.txt ] && diff theirs.txt ours.txt
}
trees_of_rtrace() { both_trace -otodvVwWLcpsmMrxX~; }
trees_with_shadows() { both_trace -oTsV; }
answers_behind_trees() { both_trace -oovots; }
excluded_from_trees() { both_trace -te silver -te dusk -otmv; }
included_in_trees() { both_trace -ti red -otmv; }
lists_in_files() {
    printf 'silver\n  dusk\tblue' >list
    both_trace -tE list -otmv && both_trace -tI list -otmv
}
mirrored_parts() { both_trace -orxX; }
normals_of_trees() { both_trace -te dusk -otnN; }
empty_records() {
    rays() { echo 0 0 0 0 1 0; echo 1 2 3 0 0 0; echo 0 0 0 0 -1 0; }
    same "$(rays | gtrace -h "$@" mirrors.rad)" "$(rays | rtrace -h -w -lr 3 -st 0 "$@" mirrors.oct)"
}
every_letter_of_nothing() {
    local letters=odvVwWlLcpnNsmMrRxX~
    same "$(echo 1 2 3 0 0 0 | gtrace -h -w -o$letters mirrors.rad)" "$(echo 1 2 3 0 0 0 | rtrace -h -w -o$letters mirrors.oct)"
}
numbers_in_headers() {
    local letters
    for letters in v oovs odVWrx smM~ lLRXw; do
        same "$(gtrace -w -ff -o$letters "$@" glows.rad </dev/null | getinfo | grep -E 'NCOMP|FORMAT')" \
            "$(rtrace -w -ff -o$letters "$@" glows.oct </dev/null | getinfo | grep -E 'NCOMP|FORMAT')" || return 1
    done
}
# colors PART OPTION...: values and contributions in other colors, to such a part of their sum.
colors() {
    local part=$1
    shift
    rtrace -w -h "$@" -ovV glows.oct <rays.txt >theirs.txt && gtrace -w -h "$@" -ovV glows.rad <rays.txt >ours.txt || return 1
    paste theirs.txt ours.txt | awk -v part="$part" '{
        sum = 0; for (i = 1; i <= NF / 2; i++) sum += $i
        for (i = 1; i <= NF / 2; i++) { d = $i - $(i + NF / 2); if (d > part * sum || -d > part * sum) { print; bad = 1 } }
        lit += sum > 0 } END { exit bad || lit < 5 }'
}
color_bytes() {
    gtrace -ffc -pXYZ glows.rad <rays.flt >ours.xyz && rtrace -w -ffc -pXYZ glows.oct <rays.flt >theirs.xyz || return 1
    same "$(getinfo <ours.xyz | grep FORMAT)" "$(getinfo <theirs.xyz | grep FORMAT)" &&
        same "$(getinfo <ours.xyz | awk '/PRIMARIES/ { printf "%.4f %.4f %.4f\n", $2, $5, $9 }')" \
            "$(getinfo <theirs.xyz | awk '/PRIMARIES/ { printf "%.4f %.4f %.4f\n", $2, $5, $9 }')" &&
        paste <(getinfo - <ours.xyz | od -An -v -tu1 -w4) <(getinfo - <theirs.xyz | od -An -v -tu1 -w4) |
        awk '{ for (i = 1; i <= 4; i++) { d = $i - $(i + 4); if (d > 1 || d < -1) { print; bad = 1 } } } END { exit bad || NR != 20 }'
}
double_precision() { same "$(rcalc -od -if6 -e '$1=$1;$2=$2;$3=$3;$4=$4;$5=$5;$6=$6' rays.flt | gtrace -h -fdd glows.rad | rcalc -id3 -e '$1=$1;$2=$2;$3=$3')" \
    "$(gtrace -h -fff glows.rad <rays.flt | rcalc -if3 -e '$1=$1;$2=$2;$3=$3')"; }
defaults_of_rtrace() {
    rtrace -defaults | sed -e 's/#.*//' >rtrace.options
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
octree_of_files() { same "$(gtrace -h -ovLsN glows.oct <rays.txt)" "$(rtrace -h -w -ovLsN glows.oct <rays.txt)"; }
frozen_octree() {
    oconv -f glows.rad >frozen.oct
    mkdir -p elsewhere && cp frozen.oct rays.txt elsewhere && cd elsewhere || return 1
    same "$(gtrace -h -ovLsNmM frozen.oct <rays.txt)" "$(rtrace -h -w -ovLsNmM frozen.oct <rays.txt)"
    local status=$?
    cd .. && return $status
}
included_octree() {
    oconv -b -10 -10 -10 20 glows.rad >first.oct &&
        oconv -i first.oct '!echo red sphere small 0 0 4 .2 -3 .1 .2' >second.oct &&
        same "$(gtrace -h -ovLsN second.oct <rays.txt)" "$(rtrace -h -w -ovLsN second.oct <rays.txt)"
}
oconv_in_a_command() { same "$(gtrace -h -ovLsN '!oconv -f glows.rad' <rays.txt)" "$(rtrace -h -w -ovLsN frozen.oct <rays.txt)"; }
no_oconv() { same "$(echo '0 -5 .1 0 1 0' | gtrace -h -os '!xform -t 0 0 .1 glows.rad')" "$(echo '0 -5 .1 0 1 0' | rtrace -h -w -os '!oconv "!xform -t 0 0 .1 glows.rad"')"; }

quiet "vwrays | gtrace -ffc makes a picture of vwrays' size" header_is_a_picture
quiet "its pixels are what pvalue makes of the floats" bytes_like_radiance
quiet "pfilt averages it" filtered
quiet "vwrays | gtrace | pfilt | pvalue in one pipe" one_pipe
quiet "rays by rcalc, ASCII and float; answers back into rcalc" rays_by_rcalc
quiet "getinfo - strips the header of binary answers" header_stripped
quiet "the header names format, components and byte order" header_fields
quiet "ASCII answers are rtrace's to the letter" same_numbers_as_rtrace
quiet "trees of rays are rtrace's to the letter" trees_of_rtrace
quiet "... with shadow rays, of which there are none" trees_with_shadows
quiet "... with answers behind them" answers_behind_trees
quiet "... without some modifiers" excluded_from_trees
quiet "... of one modifier alone" included_in_trees
quiet "... by files of names" lists_in_files
quiet "... normals" normals_of_trees
quiet "what mirrors show, and the rest" mirrored_parts
quiet "directions of zero ask for rtrace's empty records" empty_records -ovLs
quiet "... behind trees" empty_records -ovts
quiet "... of every letter" every_letter_of_nothing
quiet "headers count rtrace's numbers" numbers_in_headers
quiet "... of one-number colors" numbers_in_headers -pY
for p in -pXYZ -pY -pS -pM -pA; do quiet "colors: $p" colors 2e-6 $p; done
# Radiance has the inverse of its sensors' matrix to four digits.
quiet "colors: -pc" colors 2e-4 -pc .7 .3 .2 .7 .15 .05 .3127 .3290
quiet "colors: -pc of Radiance's own primaries" colors 2e-4 -pc .640 .330 .290 .600 .150 .060 .3333 .3333
quiet "four-byte XYZ" color_bytes
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
quiet "an octree as scene: the files that it names" octree_of_files
quiet "a frozen octree as scene" frozen_octree
quiet "an octree that includes another" included_octree
quiet "oconv in a !command" oconv_in_a_command
plan
