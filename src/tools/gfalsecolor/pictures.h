/* The pictures that gfalsecolor reads. */
#ifndef TOOLS_GFALSECOLOR_PICTURES_H
#define TOOLS_GFALSECOLOR_PICTURES_H

#include "tools/common/tool.h"
#include "tools/gfalsecolor/options.h"

/* All of one size. Those that were not asked for are null. */
typedef struct false_color_pictures {
    image *input, *background, *reference;
} false_color_pictures;

/* To be destroyed even where this fails. */
graze_status false_color_pictures_read(false_color_pictures *, const false_color_options *, const tool_arguments *,
                                       const graze_report *);
void false_color_pictures_destroy(false_color_pictures *);

#endif
