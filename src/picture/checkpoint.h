/* Checkpoints: a picture under way in a file, from which it can go on to the same bytes, whatever happens in between.
 *
 * The file holds the exact bits of all finished pixels, the picture's view and size, and what else its bytes depend on:
 * the question. It is made for the machine and the version of Graze that wrote it, for as long as the picture takes. */
#ifndef PICTURE_CHECKPOINT_H
#define PICTURE_CHECKPOINT_H

#include "picture/picture.h"

/* What belongs to a picture besides its pixels. */
typedef struct checkpoint_labels {
    const char *question; /* lines, each of something that the bytes depend on, besides view and size */
    const char *command;  /* that the picture was begun with */
} checkpoint_labels;

/* Writes the picture as it stands, while it may be going on in other threads. The file is replaced as a whole: whoever
 * looks finds the last checkpoint or this one. FILE.new is used on the way. */
graze_status checkpoint_write(const rendering *, const char *file, const checkpoint_labels *, const graze_report *);

/* Removes the file and FILE.new, where they are and are checkpoints. */
void checkpoint_remove(const char *file);

/* Whether the file begins as checkpoints do. */
bool checkpoint_is(const char *file);

/* A checkpoint as read from a file. */
typedef struct checkpoint checkpoint;

/* An input error if the file is not there, is no checkpoint, is damaged, or is of another machine or version. */
graze_status checkpoint_read(checkpoint **, const char *file, const graze_report *);
void checkpoint_destroy(checkpoint *); /* null is let pass */

/* The picture's own view, prepared, the size and the pixels' aspect into the settings; the others are left. */
void checkpoint_settings(const checkpoint *, picture_settings *);
const char *checkpoint_command(const checkpoint *);

/* Puts the finished pixels into a picture just begun with these settings. The questions must be the same: where they
 * are not, the error names the first line that differs (of a line `scene NUMBER` only that the scene differs). So must
 * be the layers, unless the checkpoint has more. */
graze_status checkpoint_resume(const checkpoint *, rendering *, const char *question, const graze_report *);

#endif
