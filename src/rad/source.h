/* One text being read, as the files that read it see it. */
#ifndef RAD_SOURCE_H
#define RAD_SOURCE_H

#include "rad/reader.h"
#include "rad/words.h"

typedef struct rad_source {
    rad_reader *reader;
    rad_words words;
    const char *name;
    const rad_context *context;
    const rad_sink *sink;
    uint32_t arguments_most; /* of a kind, that a primitive may have */
    bool any;                /* primitives found */
} rad_source;

static inline place rad_source_place(const rad_source *s, int line, int column) {
    return (place){.file = s->name, .line = line, .column = column, .parent = s->context->parent};
}

/* A place for as long as the reader's memory; null where that is short. */
place *rad_keep_place(rad_reader *, place);

/* Reads the primitive that begins here, and keeps its place, which *where may change. */
graze_status rad_source_primitive(rad_source *, int line, int column, rad_raw *, place **where);
/* Reads primitives, comments and commands up to the first that begins at `until` or later. */
graze_status rad_source_read(rad_source *, const char *until);

#endif
