/* A number that tells bytes apart: 64 bits, FNV-1a. Against accidents, not against those who look for collisions. */
#ifndef BASE_FINGERPRINT_H
#define BASE_FINGERPRINT_H

#include <stddef.h>
#include <stdint.h>

#define FINGERPRINT_OF_NOTHING UINT64_C(0xcbf29ce484222325)

/* The fingerprint of all that went into `before`, and these bytes behind it. */
static inline uint64_t fingerprint_add(uint64_t before, const void *bytes, size_t size) {
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; i++)
        before = (before ^ b[i]) * UINT64_C(0x100000001b3);
    return before;
}

#endif
