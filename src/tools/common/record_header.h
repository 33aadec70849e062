/* The header that Radiance's tools expect before records. */
#ifndef TOOLS_COMMON_RECORD_HEADER_H
#define TOOLS_COMMON_RECORD_HEADER_H

#include "base/records.h"
#include "tools/common/tool.h"

typedef struct record_header {
    int numbers;             /* in a record; 0: that differs */
    char format;             /* a f d; or c, four-byte colors */
    bool xyz;                /* those are of X, Y and Z */
    const double *primaries; /* x and y of the primaries and white, where they are not Radiance's; else null */
} record_header;

/* Appends it, with the command line. No dates: the same question gets the same bytes. */
void record_header_append(record_buffer *, const tool_arguments *, const record_header *);

#endif
