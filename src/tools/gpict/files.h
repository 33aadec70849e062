/* The files of one picture: where it goes, and what is beside it on the way. */
#ifndef TOOLS_GPICT_FILES_H
#define TOOLS_GPICT_FILES_H

#include "base/arena.h"
#include "image/image.h"
#include "picture/picture.h"
#include "tools/gpict/options.h"

typedef struct picture_files {
    const char *pictures[OUTPUT_LIMIT];
    int count;
    const char *contours, *depth; /* null: none */
    const char *checkpoint;       /* null: there is no place for one */
    const char *preview;          /* the same */
    bool preview_wanted;          /* the user has asked for one beforehand */
    const char *begun;            /* what -r names; null: nothing */
    const char *recover;          /* a checkpoint to go on with; null: the picture is to be begun */
} picture_files;

/* Finds the names for a frame of that number, 0 where there is no sequence. What -r names must be there. */
graze_status files_find(picture_files *, arena *, const gpict_options *, int number, const graze_report *);
/* Whether they can be written, and are all different. */
graze_status files_check(const picture_files *, const graze_report *);
/* Whether the formats have room for the size. */
graze_status files_check_size(const picture_files *, int width, int height, const graze_report *);
/* Whether all pictures are there already. */
bool files_are_there(const picture_files *);
/* What the files want to know of each pixel. */
picture_content files_content(const picture_files *);
/* Writes all of them, or to standard output where there is no picture among them. */
graze_status files_write(const picture_files *, const gpict_options *, const image *, const graze_report *);

#endif
