/* A fingerprint of the primitives. */
#include "scene/fingerprint.h"

#include <string.h>

#include "base/fingerprint.h"

static uint64_t add_number(uint64_t f, int64_t number) {
    return fingerprint_add(f, &number, sizeof number);
}

/* With the zero byte, which keeps words apart. */
static uint64_t add_word(uint64_t f, const char *word) {
    return fingerprint_add(f, word, strlen(word) + 1);
}

static uint64_t add_primitive(uint64_t f, const rad_primitive *p) {
    f = add_number(f, p->type);
    f = add_number(f, p->modifier);
    f = add_word(f, p->id);
    f = add_number(f, p->string_count);
    for (uint32_t i = 0; i < p->string_count; i++)
        f = add_word(f, p->strings[i]);
    f = add_number(f, p->real_count);
    return fingerprint_add(f, p->reals, p->real_count * sizeof *p->reals);
}

uint64_t scene_fingerprint(const graze_scene *scene) {
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(scene->description, &count);
    uint64_t f = FINGERPRINT_OF_NOTHING;
    for (size_t i = 0; i < count; i++)
        f = add_primitive(f, &primitives[i]);
    return f;
}
