#!/bin/bash
# gpict interrupted: whatever happens on the way, a picture goes on from its checkpoint to the same bytes. TAP.
source "$(dirname "$0")/../support/tap.sh"
source "$(dirname "$0")/../support/rooms.sh"
cd "$work" || exit 2
gpict=$BIN/gpict

closed_room >room.rad
view=(-vp 0 0 0 -vd 0 1 0 -vh 40 -vv 40)
often=(--checkpoint-interval .02)
# What takes long enough to be interrupted, and a picture of it that was not.
slow=("${view[@]}" -x 40 -y 30 -pa 0 --samples 400 -ab 2 "${often[@]}")

# begun FILE: waits until the picture that runs as $! has a checkpoint, another one than before (by its inode).
begun() {
    local before=${2:-none} now
    while kill -0 $! 2>/dev/null; do
        now=$(stat -c %i "$1" 2>/dev/null) && [ "$now" != "$before" ] && return
    done
    false
}
# ended SIGNAL: ends $! and gives its status.
ended() { kill "-$1" $! 2>/dev/null; wait $! 2>/dev/null; }

"$gpict" -n 2 "${slow[@]}" -o p.exr room.rad
check "a picture in peace leaves no checkpoint" test -s p.exr -a ! -e p.exr.checkpoint -a ! -e p.exr.checkpoint.new
mv p.exr whole.exr

# Killed several times, on different numbers of threads.
"$gpict" -n 2 "${slow[@]}" -o p.exr room.rad & begun p.exr.checkpoint
ended KILL
check "kill -9 leaves a checkpoint and no picture" test -s p.exr.checkpoint -a ! -e p.exr
for n in 1 3; do
    "$gpict" -n $n -ro p.exr "${slow[@]}" room.rad & begun p.exr.checkpoint "$(stat -c %i p.exr.checkpoint)"
    ended KILL
done
check "... and so it does again" test -s p.exr.checkpoint -a ! -e p.exr
cp p.exr.checkpoint kept
quiet "it goes on" "$gpict" -ro p.exr --samples 400 -ab 2 room.rad
check "... to the same bytes" cmp p.exr whole.exr
check "... and takes the checkpoint away" test ! -e p.exr.checkpoint
check "a checkpoint may be named itself, and the picture go elsewhere" "$gpict" -r kept -o q.exr --samples 400 -ab 2 room.rad
check "... with the same bytes" cmp q.exr whole.exr
"$gpict" -ro p.exr --samples 400 -ab 2 room.rad 2>err
check "-ro of a finished picture has nothing to do" test $? -eq 0
check "... and says so" grep -q "there already" err
check "... and leaves it" cmp p.exr whole.exr

# To standard output, with a checkpoint by name; and stopped kindly.
"$gpict" "${slow[@]}" --checkpoint c room.rad >whole.hdr
"$gpict" "${slow[@]}" --checkpoint c room.rad >part.hdr 2>err & begun c
ended TERM
check "SIGTERM ends it as it ends others" test $? -eq 143
check "... says how to go on" grep -q -- "-r c goes on" err
check "... and writes no picture" test ! -s part.hdr
cp c kept
check "from there it goes on" sh -c "$gpict -r c --samples 400 -ab 2 room.rad | cmp - whole.hdr"
check "... and its checkpoint goes" test ! -e c

# A checkpoint is of one question.
go_on=("$gpict" -r kept -o x.hdr -ab 2)
fails "other samples" 1 "begun with '--samples 400' and cannot go on with '--samples 401'" "" "${go_on[@]}" --samples 401 room.rad
fails "another seed" 1 "'--seed 0' and cannot go on with '--seed 1'" "" "${go_on[@]}" --samples 400 --seed 1 room.rad
fails "a lens" 1 "'-pd 0'" "" "${go_on[@]}" --samples 400 -pd .1 room.rad
sed 's/9 9 9/9 9 8/' room.rad >other.rad
fails "other definitions" 1 "begun with another scene" "" "${go_on[@]}" --samples 400 -e other=1 room.rad
fails "another scene" 1 "begun with another scene" "" "${go_on[@]}" --samples 400 other.rad
fails "another view" 1 "another view" "" "${go_on[@]}" --samples 400 -vp 1 0 0 room.rad
fails "another size" 1 "begun as 40 x 30 pixels" "" "${go_on[@]}" --samples 400 -x 41 -y 30 -pa 0 room.rad
fails "layers that it has not" 1 "without the layers" "" "$gpict" -r kept -o x.exr -ab 2 --samples 400 room.rad
fails "no checkpoint" 1 "nowhere: nothing to go on with: neither it nor its checkpoint, nowhere.checkpoint, is there" "" "$gpict" -r nowhere room.rad
fails "a picture for a checkpoint" 1 "whole.hdr: nothing to go on with: it has no checkpoint beside it, whole.hdr.checkpoint, and is none" "" "$gpict" -r whole.hdr room.rad
head -c 1000 kept >short
fails "a checkpoint cut short" 1 "short: this checkpoint is damaged" "" "$gpict" -r short room.rad
head -c 5 kept >shorter
fails "a checkpoint cut to nearly nothing" 1 "shorter: nothing to go on with: it has no checkpoint beside it, shorter.checkpoint, and is none itself, or one whose beginning is damaged" "" "$gpict" -r shorter room.rad
check "and it is still there" test -s kept
grep -v '^#' room.rad | sed 's/  */ /g' >same.rad
cp kept again
check "the same scene in other words is the same" "${go_on[@]}" --samples 400 same.rad
fails "one that has an effect at 0 may not be 0" 1 "'-aa 0.1' and cannot go on with '-aa 0'" "" "$gpict" -r again -o y.hdr -ab 2 --samples 400 -aa 0 room.rad
check "options without effect may differ" "$gpict" -r again -o y.hdr -ab 2 --samples 400 -aa .3 -ad 64 -ds .5 -u- -cs 9 -e log -ap map room.rad

# A picture that cannot be written is not lost.
cp whole.hdr d.hdr
mkdir d
"$gpict" "${slow[@]}" -o d/p.hdr --checkpoint c room.rad 2>err & begun c
rm -r d
wait $!
check "a folder that goes away is an error" test $? -ne 0
check "... that keeps the picture" grep -q "is kept here" err
mkdir d
check "... for another attempt" sh -c "$gpict -r c -o d/p.hdr --samples 400 -ab 2 room.rad && test -s d/p.hdr"
rm -rf d

# A checkpoint that cannot be written is told once, and when it works again.
mkdir e
"$gpict" "${slow[@]}" -t 1 --checkpoint e/c room.rad >part.hdr 2>err & begun e/c
mv e f
while kill -0 $! 2>/dev/null && ! grep -q "e/c" err; do :; done
mkdir e
begun e/c
ended TERM
check "a checkpoint that fails is told once" test "$(grep '^gpict: warning: e/c' err | grep -vc 'written again')" -eq 1
check "... and when it works again" grep -q "e/c: checkpoints are written again" err

# Previews and lines of progress.
"$gpict" "${slow[@]}" -o s.hdr room.rad 2>err & begun s.hdr.checkpoint
while kill -0 $! && [ ! -e s.preview.hdr ]; do kill -USR1 $!; done 2>/dev/null
while kill -0 $! && ! grep -q " paths, " err; do kill -CONT $!; done 2>/dev/null
ended TERM
check "SIGUSR1 writes a preview" grep -aq -- "-Y  *30 +X  *40" s.preview.hdr
check "SIGCONT says how far it is" grep -q "gpict: [0-9]* paths, [0-9.]*% after .* error .* hours left" err
rm -f s.*
"$gpict" "${slow[@]}" --checkpoint c --preview q.png --preview-interval .02 room.rad >s.hdr 2>err & while kill -0 $! && [ ! -e q.png ]; do :; done 2>/dev/null
ended TERM
check "--preview-interval does without being asked" test "$(head -c 4 q.png | od -An -tx1 | tr -d ' ')" = 89504e47
fails "--preview-interval without a name" 1 "--preview" "" "$gpict" --preview-interval 1 room.rad
fails "--preview where nothing can be written" 1 "nowhere/p.hdr" "" "$gpict" --preview nowhere/p.hdr room.rad
check "-t says in the end how it was" sh -c "$gpict -t 1000 ${view[*]} -x 8 -y 8 --samples 4 room.rad 2>&1 >s.hdr | grep '256 paths, 100.00%'"
check "nothing else is said without a terminal" sh -c "$gpict ${view[*]} -x 8 -y 8 --samples 4 room.rad 2>&1 >s.hdr | cmp - /dev/null"
if script -qec true /dev/null >s 2>&1; then
    TERM=xterm script -qec "$gpict ${view[*]} -x 8 -y 8 --samples 4 -o s.hdr room.rad" /dev/null >bar
    check "a terminal gets a bar" grep -q "rendering .*left" bar
    NO_COLOR=1 TERM=xterm script -qec "$gpict ${view[*]} -x 8 -y 8 --samples 4 -o s.hdr room.rad" /dev/null >bar
    check "... but not where NO_COLOR says no" test ! -s bar
fi

# A checkpoint replaces nothing else, and where none can be written is said at once.
cp room.rad mine.rad
fails "--checkpoint where something else is" 1 "is no checkpoint" "" "$gpict" --checkpoint mine.rad -o none.hdr mine.rad
check "... which stays" cmp room.rad mine.rad
fails "--checkpoint where the picture is to be" 1 "written twice" "" "$gpict" --checkpoint none.hdr -o none.hdr room.rad
fails "--preview where the picture is to be" 1 "written twice" "" "$gpict" --preview none.hdr -o none.hdr room.rad
"$gpict" "${slow[@]}" -o s.hdr -o s.preview.hdr room.rad 2>err & begun s.hdr.checkpoint
while kill -0 $! && ! grep -q "no file for a preview" err; do kill -USR1 $!; done 2>/dev/null
wait $!
check "a preview that has no name of its own is not written over a picture" sh -c "grep -q 'no file for a preview' err && tail -c 700 s.hdr >a && tail -c 700 s.preview.hdr | cmp - a"
fails "--checkpoint where nothing can be written" 1 "nowhere/c" "" "$gpict" --checkpoint nowhere/c -o none.hdr room.rad
plan
