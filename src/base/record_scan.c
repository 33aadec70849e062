/* Looking at records many bytes at a time, in the vectors that gcc and clang have for every processor. */
#include "base/record_scan.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/text.h"

typedef uint8_t bytes16 __attribute__((vector_size(16)));
typedef uint64_t bits2 __attribute__((vector_size(16)));
typedef float floats4 __attribute__((vector_size(16)));
typedef double doubles2 __attribute__((vector_size(16)));

/* A vector of byte counts is added up before one can overflow. */
enum { VECTORS_MAX = 255 };

/* A function that counts in the whole vectors of bytes[0 .. length), VECTORS_MAX of them at most, and gives how many
 * bytes that are. A blank is what text_is_blank says; comparisons set all bits of a byte, which is -1. */
#define DEFINE_COUNT(name, vector)                                                                                     \
    static size_t name(const char *bytes, size_t length, size_t *words, size_t *lines) {                               \
        size_t whole = length - length % sizeof(vector);                                                               \
        if (whole > VECTORS_MAX * sizeof(vector))                                                                      \
            whole = VECTORS_MAX * sizeof(vector);                                                                      \
        vector word_ends = {0}, line_ends = {0};                                                                       \
        for (const char *p = bytes; p < bytes + whole; p += sizeof(vector)) {                                          \
            vector before, v;                                                                                          \
            memcpy(&before, p - 1, sizeof before);                                                                     \
            memcpy(&v, p, sizeof v);                                                                                   \
            vector blank_before = (vector)(before == ' ') | (vector)(before - '\t' <= '\r' - '\t');                    \
            vector blank = (vector)(v == ' ') | (vector)(v - '\t' <= '\r' - '\t');                                     \
            word_ends -= blank & ~blank_before;                                                                        \
            line_ends -= (vector)(v == '\n');                                                                          \
        }                                                                                                              \
        for (size_t i = 0; i < sizeof(vector); i++) {                                                                  \
            *words += word_ends[i];                                                                                    \
            *lines += line_ends[i];                                                                                    \
        }                                                                                                              \
        return whole;                                                                                                  \
    }                                                                                                                  \
    _Static_assert(VECTORS_MAX <= UINT8_MAX, "each vector can end a word")

DEFINE_COUNT(count_in_16, bytes16);
#ifdef __x86_64__
typedef uint8_t bytes32 __attribute__((vector_size(32)));
__attribute__((target("avx2"))) DEFINE_COUNT(count_in_32, bytes32);
#endif

static size_t count_in_vectors(const char *bytes, size_t length, size_t *words, size_t *lines) {
#ifdef __x86_64__
    if (length >= sizeof(bytes32) && __builtin_cpu_supports("avx2"))
        return count_in_32(bytes, length, words, lines);
#endif
    return count_in_16(bytes, length, words, lines);
}

void record_count_ends(const char *bytes, size_t length, size_t *words, size_t *lines) {
    const char *end = bytes + length;
    while (end - bytes >= (ptrdiff_t)sizeof(bytes16))
        bytes += count_in_vectors(bytes, (size_t)(end - bytes), words, lines);
    for (; bytes < end; bytes++) {
        *words += text_is_blank(*bytes) && !text_is_blank(bytes[-1]);
        *lines += *bytes == '\n';
    }
}

/* A function that gives how many values there are before the first that is not finite. A number times 0 is 0 if it is
 * finite, and else NaN: that looks whether there is any of those, which is quick, before it looks where. */
#define DEFINE_FINITE(name, real, vector)                                                                              \
    size_t name(const real *values, size_t count) {                                                                    \
        enum { LANES = sizeof(vector) / sizeof(real) };                                                                \
        bits2 found = {0};                                                                                             \
        size_t i = 0;                                                                                                  \
        for (; i + LANES <= count; i += LANES) {                                                                       \
            vector v;                                                                                                  \
            memcpy(&v, values + i, sizeof v);                                                                          \
            found |= (bits2)(v * 0 != 0);                                                                              \
        }                                                                                                              \
        if (found[0] | found[1])                                                                                       \
            i = 0;                                                                                                     \
        while (i < count && isfinite(values[i]))                                                                       \
            i++;                                                                                                       \
        return i;                                                                                                      \
    }                                                                                                                  \
    _Static_assert(sizeof(bits2) == sizeof(vector), "all bits of a comparison are looked at")

DEFINE_FINITE(record_finite_floats, float, floats4);
DEFINE_FINITE(record_finite_doubles, double, doubles2);
