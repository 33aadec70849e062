/* What fuzz targets share. A target is fed bytes by libFuzzer (`make fuzz`), or by replay.c (`make test`). */
#ifndef FUZZ_TARGET_H
#define FUZZ_TARGET_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* Both have these names for everyone. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What does not hold ends the program, and so the input is found. */
#define MUST(condition)                                                                                                \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);                             \
            abort();                                                                                                   \
        }                                                                                                              \
    } while (0)

#endif
