/* Headers of CSV and NPY tables. */
#include "tools/brdfeval/table_text.h"

#include <stdio.h>

/* Calls name(...) with the name of each column: inputs, then numbers of the answer. */
static void for_each_column(const evaluation *e, const grid *g, record_buffer *out,
                            void (*append)(record_buffer *, int index, const char *name)) {
    int index = 0;
    for (; index < g->input_count; index++)
        append(out, index, g->names[index]);
    for (int i = 0; i < e->field_count; i++) {
        int channels = evaluation_channels(e, e->fields[i]);
        for (int channel = 0; channel < channels; channel++) {
            char name[16];
            snprintf(name, sizeof name, channels > 1 ? "%s_%c" : "%s", e->fields[i]->name, "rgb"[channel]);
            append(out, index++, name);
        }
    }
}

static void append_csv_name(record_buffer *out, int index, const char *name) {
    record_append_text(out, index ? "," : "");
    record_append_text(out, name);
}

void table_append_csv_header(record_buffer *out, const evaluation *e, const grid *g) {
    for_each_column(e, g, out, append_csv_name);
    record_append_text(out, "\n");
}

static void append_npy_name(record_buffer *out, int index, const char *name) {
    char text[64];
    snprintf(text, sizeof text, "%s('%s', '%cf8')", index ? ", " : "", name, record_is_big_endian() ? '>' : '<');
    record_append_text(out, text);
}

static void append_shape(record_buffer *out, const grid *g) {
    record_append_text(out, "(");
    for (int i = 0; i < g->axis_count; i++) {
        char text[32];
        snprintf(text, sizeof text, "%llu, ", (unsigned long long)g->axes[i].count);
        if (g->axes[i].count > 1)
            record_append_text(out, text);
    }
    record_append_text(out, ")");
}

/* Magic, version, length of what follows (two bytes, low first): a Python literal, filled up with blanks so that data
 * begin at a multiple of 64. */
void table_append_npy_header(record_buffer *out, const evaluation *e, const grid *g) {
    enum { ALIGNMENT = 64, FIXED = 10 };
    record_buffer literal = {0};
    record_append_text(&literal, "{'descr': [");
    for_each_column(e, g, &literal, append_npy_name);
    record_append_text(&literal, "], 'fortran_order': False, 'shape': ");
    append_shape(&literal, g);
    record_append_text(&literal, ", }");
    while ((FIXED + literal.length + 1) % ALIGNMENT && !literal.failed)
        record_append_text(&literal, " ");
    record_append_text(&literal, "\n");

    const unsigned char length[] = {literal.length & 255, (literal.length >> 8) & 255};
    record_append_bytes(out, "\x93NUMPY\x01\x00", 8);
    record_append_bytes(out, length, sizeof length);
    record_append_bytes(out, literal.bytes, literal.length);
    out->failed = out->failed || literal.failed;
    record_buffer_free(&literal);
}
