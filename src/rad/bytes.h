/* Radiance's binary files, read front to back: big-endian integers, numbers of five bytes, texts that a zero byte ends.
 */
#ifndef RAD_BYTES_H
#define RAD_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/report.h"
#include "base/whole_file.h"

/* Past the end, or after a failure, all reads give 0; `status` tells at the end, or wherever somebody cares. */
typedef struct rad_bytes {
    const char *begin, *next, *end;
    const char *what; /* for messages: "octree" */
    const place *where;
    const graze_report *report;
    graze_status status; /* of the first failure, which has been reported */
} rad_bytes;

/* `where` names the file, and must outlive the bytes. */
rad_bytes rad_bytes_of(const whole_file *, const char *what, const place *where, const graze_report *);

/* Of `size` bytes, 1 to 8, with sign. */
int64_t rad_bytes_integer(rad_bytes *, int size);
/* The same without. */
uint64_t rad_bytes_count(rad_bytes *, int size);
/* Four bytes of a fraction, one of an exponent of two; as Radiance reads it. */
double rad_bytes_real(rad_bytes *);
/* Never null; lives as long as the file. */
const char *rad_bytes_text(rad_bytes *);
void rad_bytes_skip(rad_bytes *, size_t count);

/* "FILE: WHAT: TEXT (byte N)", unless there was a failure before. */
void rad_bytes_fail(rad_bytes *, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Whether the text is a Radiance file of that format, by its header: `Radiance_octree`. */
bool rad_bytes_have_format(const whole_file *, const char *format);
/* Passes the header, and the number behind it that tells the format's version: `lowest` and the size of an object's
 * number, which is returned (0 after a failure). */
int rad_bytes_begin(rad_bytes *, int lowest);
/* Passes the octree itself. */
void rad_bytes_skip_tree(rad_bytes *, int object_size);

#endif
