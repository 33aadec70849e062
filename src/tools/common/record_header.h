/* The header that Radiance's tools expect before records. */
#ifndef TOOLS_COMMON_RECORD_HEADER_H
#define TOOLS_COMMON_RECORD_HEADER_H

#include "base/records.h"
#include "tools/common/tool.h"

/* Appends it: the command line, how many numbers a record has, and the format: a f d, or c for four-byte colors. No
 * dates: the same question gets the same bytes. */
void record_header_append(record_buffer *, const tool_arguments *, int numbers, char format);

#endif
