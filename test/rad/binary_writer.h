/* Radiance's binary files as tests make them. */
#ifndef TEST_RAD_BINARY_WRITER_H
#define TEST_RAD_BINARY_WRITER_H

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef struct binary {
    char bytes[8192];
    size_t length;
} binary;

static inline void put_integer(binary *b, int64_t value, int size) {
    for (int i = size - 1; i >= 0; i--)
        b->bytes[b->length++] = (char)(value >> 8 * i & 0xff);
}

static inline void put_text(binary *b, const char *text) {
    size_t length = strlen(text) + 1;
    memcpy(b->bytes + b->length, text, length);
    b->length += length;
}

/* A text without its zero. */
static inline void put_line(binary *b, const char *text) {
    put_text(b, text);
    b->length--;
}

static inline void put_real(binary *b, double value) {
    int exponent;
    double fraction = frexp(value, &exponent);
    put_integer(b, (int64_t)(fraction * 0x7fffffff), 4);
    put_integer(b, exponent, 1);
}

static inline void put_octree_head(binary *b, int object_size) {
    put_line(b, "#?RADIANCE\noconv -f room.rad\nFORMAT=Radiance_octree\n\n");
    put_integer(b, 283 + object_size, 2);
    for (int i = 0; i < 4; i++)
        put_text(b, i < 3 ? "-1.5" : "3");
}

/* An octree, not frozen, of one scene file of so many primitives. */
static inline binary octree_of_file(const char *file, int primitives) {
    binary b = {.length = 0};
    put_octree_head(&b, 4);
    put_text(&b, file);
    put_text(&b, "");
    put_integer(&b, primitives, 4);
    put_integer(&b, 0, 1);
    return b;
}

#endif
