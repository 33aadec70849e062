/* The legend beside a picture: colours, and the numbers they stand for. */
#ifndef IMAGE_LEGEND_H
#define IMAGE_LEGEND_H

#include "image/canvas.h"
#include "image/levels.h"

typedef struct image_legend_entry {
    int level;
    double at; /* 0 at the lower end of the scale, 1 at the upper one */
    char text[IMAGE_SCALE_TEXT];
    unsigned char color[3]; /* of the dash, where the legend has dashes */
} image_legend_entry;

typedef struct image_legend {
    const char *label;                 /* over all */
    const image_legend_entry *entries; /* from the lowest to the highest */
    int count;
    /* The colour of the bar at 0 .. 1, false where it has none. Null: a dash for each entry in place of a bar. */
    bool (*color)(const void *user, double at, unsigned char color[3]);
    const void *user;
    bool centered; /* the scale is as long on both sides of 0, and all of its levels but 0 have entries */
    /* A colour that is not on the scale, and what it means; null: none. */
    const char *note;
    unsigned char note_color[3];
} image_legend;

/* An entry for each level, with at most so many decimals as image_scale_text has it; to be freed. Null when out of
 * memory. */
image_legend_entry *image_legend_entries(const image_levels *, int decimals, int *count);

/* In pixels; `scale` pixels to a dot of the letters. */
typedef struct image_legend_size {
    int width, height;
    double scale;
} image_legend_size;

/* The size for a picture of that height; `width` and `height` are what the user wants, negative for what suits. No
 * legend where either is 0: all is 0 then. Letters are smaller where dashes have room for all their texts only so. */
image_legend_size image_legend_fit(const image_legend *, int picture_height, int width, int height);
/* Draws it at the left, from the top. Where there is not room for the texts of all entries, every second, third ... has
 * one, the highest in any case; around 0, these are counted from 0 and the ends have theirs, or 0 alone. Dashes without
 * a text are half as long. */
void image_legend_draw(const image_legend *, const image_legend_size *, image_canvas *);

#endif
