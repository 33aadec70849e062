/* What one run of xform reads, keeps, and sends on transformed. */
#ifndef RAD_XFORM_JOB_H
#define RAD_XFORM_JOB_H

#include "base/whole_file.h"
#include "rad/filter.h"
#include "rad/reader.h"

enum { RAD_KEPT_FILES = 16 }; /* an array reads each of its files once, if they are not more */

/* Primitives that are needed again, or that the next stage of a pipeline waits for. */
typedef struct rad_list {
    rad_raw *items;
    size_t count, capacity;
} rad_list;

/* One stage of a pipeline being done. */
typedef struct rad_job {
    rad_reader *reader;
    const rad_context *context;
    const place *where;   /* for messages: where the command is written, or the line of its argument file */
    const place *command; /* what brings in files */
    const rad_sink *sink;
    rad_list *input;           /* its standard input; or null: there is nothing on it */
    const whole_file *options; /* its standard input, where that is an argument file */
    bool once;                 /* no array and no argument file: everything is read and transformed once */
    long instances;
    struct {
        const char *name;
        bool expand;
        rad_list primitives;
    } files[RAD_KEPT_FILES];
    int file_count, next_file;
} rad_job;

/* What a sink that appends to a list has as its `user`; rad_list_append is its `take`. */
typedef struct rad_list_sink {
    rad_reader *reader;
    rad_list *list;
} rad_list_sink;

graze_status rad_list_append(void *user, rad_raw *);
void rad_list_free(rad_list *);

/* Where primitives go when they have been through the filter. */
typedef struct rad_filter_sink {
    rad_reader *reader;
    const rad_filter *filter;
    const rad_sink *sink;
} rad_filter_sink;

/* Sends copies of a list's primitives through the filter: the list is needed again. */
graze_status rad_job_filter_list(const rad_job *, const rad_list *, rad_filter_sink *);

/* The primitives of a file, with those that its commands bring in if they are to be expanded. */
graze_status rad_job_filter_file(rad_job *, const char *name, bool expand, rad_filter_sink *);

#endif
