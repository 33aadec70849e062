/* Modifiers of a scene that a test writes. */
#ifndef TEST_MATERIAL_WRITTEN_MODIFIERS_H
#define TEST_MATERIAL_WRITTEN_MODIFIERS_H

#include "material/modifier.h"
#include "rad/scene_file.h"
#include "support/written_file.h"

typedef struct written_modifiers {
    rad_scene *scene;
    material_modifiers *modifiers; /* null where the scene is refused */
    const rad_primitive *last;     /* the last of the text */
    int number;                    /* its index */
    graze_status status;
} written_modifiers;

/* Reads a scene from its text. Leaves what was reported in `messages`. */
static inline written_modifiers written_modifiers_read(const char *text) {
    written_modifiers w = {.scene = NULL};
    written_file file = written_file_make(text, strlen(text));
    const char *names[] = {file.name};
    messages[0] = 0;
    w.status = rad_scene_read(&w.scene, names, 1, &remembering);
    unlink(file.name);
    if (w.status)
        return w;
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(w.scene, &count);
    w.number = (int)count - 1;
    w.last = &primitives[w.number];
    w.modifiers = material_modifiers_create(primitives, count, &remembering);
    assert_non_null(w.modifiers);
    return w;
}

static inline void written_modifiers_destroy(written_modifiers *w) {
    material_modifiers_destroy(w->modifiers);
    rad_scene_destroy(w->scene);
}

#endif
