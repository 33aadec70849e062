/* Shapes of surfaces: what can be made of them in any order, and what is said of them in theirs. */
#include "scene/shapes.h"

#include <stdlib.h>

#include "base/parallel.h"

/* From so many surfaces on threads are worth their start; each is given so many at a time. */
enum { MANY = 20000, BLOCK_SIZE = 1024 };

/* Threads at work, each with memory of its own. */
typedef struct workshop {
    scene_shapes *made;
    arena **memory; /* by worker */
} workshop;

static void make_block(void *user, size_t index, int worker) {
    const workshop *w = user;
    scene_shapes *made = w->made;
    size_t end = (index + 1) * BLOCK_SIZE < made->count ? (index + 1) * BLOCK_SIZE : made->count;
    for (size_t i = index * BLOCK_SIZE; i < end; i++) {
        bool said_something = false, degenerate = false;
        const graze_report quiet = report_to_flag(&said_something);
        graze_status status = shape_from_primitive(&made->shapes[i], &degenerate, &made->all[made->primitives[i]],
                                                   w->memory[worker], &quiet);
        made->ready[i] = !status && !degenerate && !said_something;
    }
}

/* The caller's thread uses the scene's memory, which then gets what others have used. */
static bool make_all(scene_shapes *made, arena *memory, int threads) {
    /* Pointers are what is wanted. NOLINTNEXTLINE(bugprone-sizeof-expression) */
    arena **memories = calloc((size_t)threads, sizeof *memories);
    if (!memories)
        return false;
    bool room = true;
    memories[0] = memory;
    for (int i = 1; i < threads && room; i++) {
        memories[i] = arena_create();
        room = memories[i] != NULL;
    }
    if (room)
        parallel_for(threads, (made->count + BLOCK_SIZE - 1) / BLOCK_SIZE, make_block, &(workshop){made, memories});
    for (int i = 1; i < threads && memories[i]; i++)
        arena_absorb(memory, memories[i]);
    free(memories);
    return room;
}

graze_status scene_shapes_make(scene_shapes *made, scene_builder *b, size_t first, size_t end, shape *shapes) {
    *made = (scene_shapes){.all = b->scene->primitives, .shapes = shapes};
    made->primitives = malloc((end - first + 1) * sizeof *made->primitives);
    made->ready = malloc((end - first + 1) * sizeof *made->ready);
    bool room = made->primitives && made->ready;
    for (size_t i = first; i < end && room; i++)
        if (scene_has_shape(&made->all[i]))
            made->primitives[made->count++] = (int)i;
    room = room && make_all(made, b->scene->memory, made->count < MANY ? 1 : scene_builder_threads(b));
    return room ? GRAZE_OK : report_out_of_memory(b->report);
}

void scene_shapes_free(scene_shapes *made) {
    free(made->primitives);
    free(made->ready);
}

/* A flat surface across its own orientation vector: told here, once, for no ray could tell it. */
static void check_orientation(const scene_builder *b, const rad_primitive *surface, const shape *s,
                              const scene_material *material) {
    if (!shape_is_flat(s) || material->kind != SCENE_REFLECTOR || !material->reflector.has_orientation)
        return;
    const vec3 normal = shape_plane_of(s).normal;
    graze_surface probe;
    int illegal = 0;
    graze_surface_prepare(&probe, &material->reflector, normal, normal, &illegal);
    if (illegal)
        rad_primitive_warning(b->report, surface,
                              "lies across the orientation vector of its material, which is then isotropic");
}

/* Makes once more what was not ready, and says why. False: there is no surface. */
static bool put_shape(scene_builder *b, const scene_shapes *made, size_t surface, shape *s) {
    if (made->ready[surface]) {
        if (s != &made->shapes[surface])
            *s = made->shapes[surface];
        return true;
    }
    bool degenerate = false;
    graze_status status =
        shape_from_primitive(s, &degenerate, &made->all[made->primitives[surface]], b->scene->memory, b->report);
    if (status)
        scene_fail(b, status);
    return !status && !degenerate;
}

int scene_shapes_take(scene_builder *b, const scene_shapes *made, size_t surface, shape *s) {
    const rad_primitive *p = &made->all[made->primitives[surface]];
    int number = scene_material_of_surface(b, p);
    if (!put_shape(b, made, surface, s) || number < 0)
        return -1;
    const scene_material *material = &b->scene->materials[number];
    check_orientation(b, p, s, material);
    s->shines = scene_material_emits(material);
    s->passes = scene_material_is_pane(b->scene, material);
    return number;
}
