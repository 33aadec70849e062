/* rpict's -z: distances in a file. */
#ifndef TOOLS_GPICT_DEPTH_FILE_H
#define TOOLS_GPICT_DEPTH_FILE_H

#include <stddef.h>

#include "base/report.h"

/* Writes the floats as the machine has them, and nothing else. The file appears whole or not at all. */
graze_status depth_file_write(const float *depths, size_t count, const char *file, const graze_report *);

#endif
