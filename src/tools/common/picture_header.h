/* What tells, in a picture's header, how it was made. */
#ifndef TOOLS_COMMON_PICTURE_HEADER_H
#define TOOLS_COMMON_PICTURE_HEADER_H

#include "image/image.h"
#include "tools/common/tool.h"

/* Where the text of the command line lies. */
typedef struct picture_header {
    char command[TOOL_COMMAND_SIZE];
} picture_header;

/* Gives the picture the command line and Graze's name; both have to outlive it. */
void picture_header_set(picture_header *, image *, const tool_arguments *);

#endif
