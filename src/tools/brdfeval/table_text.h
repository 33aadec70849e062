/* How tables begin. */
#ifndef TOOLS_BRDFEVAL_TABLE_TEXT_H
#define TOOLS_BRDFEVAL_TABLE_TEXT_H

#include "base/records.h"
#include "tools/brdfeval/evaluation.h"
#include "tools/brdfeval/grid.h"

/* The line with the columns' names. */
void table_append_csv_header(record_buffer *, const evaluation *, const grid *);

/* NumPy's format 1.0: an array of structures of doubles in this machine's byte order, with an axis for each of the
 * grid's that has more than one value. */
void table_append_npy_header(record_buffer *, const evaluation *, const grid *);

#endif
