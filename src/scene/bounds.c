/* Bounds of bodies in copies: each part's surfaces of the material once, placed where the scene's copies stand. */
#include "scene/bounds.h"

#include <stdlib.h>

/* The groups of a geometry: the scene's own surfaces; of each part those of the material; and behind these, of each
 * part all, for copies whose own modifier is the material. */
typedef struct collection {
    const graze_scene *scene;
    int material;
    geometry_group *groups; /* two for each part */
    bool *holds;            /* by part: it has such surfaces, or copies that do */
    geometry_placement *placements;
    size_t count, capacity;
    bool failed;
} collection;

static bool is_copy_of(const collection *c, const scene_copy *copy) {
    return copy->replaces ? copy->surface.material == c->material : c->holds[copy->part];
}

/* Parts are behind those that hold copies of them. */
static void find_holders(collection *c, const size_t *counts) {
    for (size_t i = c->scene->part_count; i-- > 0;) {
        const scene_part *part = &c->scene->parts[i];
        c->holds[i] = i > 0 && counts[i] > 0;
        for (size_t k = 0; k < part->copy_count && !c->holds[i]; k++)
            c->holds[i] = is_copy_of(c, &part->copies[k]);
    }
}

static void put(collection *c, size_t group, const rad_transform *transform) {
    if (c->groups[group].shape_count == 0 || c->failed)
        return;
    if (c->count == c->capacity) {
        size_t capacity = c->capacity ? 2 * c->capacity : 8;
        geometry_placement *grown = realloc(c->placements, capacity * sizeof *grown);
        c->failed = !grown;
        if (!grown)
            return;
        c->placements = grown;
        c->capacity = capacity;
    }
    c->placements[c->count++] = (geometry_placement){(int)group, *transform};
}

/* Places what the copies in a part hold, which stands there by the transform (null: the scene itself); all that they
 * hold where a modifier around them is the material. */
static void place_copies(collection *c, int number, const rad_transform *transform, bool all) {
    const scene_part *part = &c->scene->parts[number];
    for (size_t i = 0; i < part->copy_count; i++) {
        const scene_copy *copy = &part->copies[i];
        if (!all && !is_copy_of(c, copy))
            continue;
        const rad_transform *inner = &part->placements[i].transform;
        const rad_transform to = transform ? rad_transform_then(inner, transform) : *inner;
        const bool whole = all || copy->replaces;
        put(c, (size_t)copy->part + (whole ? c->scene->part_count : 0), &to);
        place_copies(c, copy->part, &to, whole);
    }
}

/* How many surfaces of each part are of the material; of all parts that are copied. */
static size_t count_surfaces(const graze_scene *scene, int material, size_t *counts) {
    size_t sum = 0;
    for (size_t i = 1; i < scene->part_count; i++) {
        for (size_t k = 0; k < scene->parts[i].surface_count; k++)
            counts[i] += scene->parts[i].surfaces[k].material == material;
        sum += counts[i];
    }
    return sum;
}

static void fill_groups(collection *c, shape *shapes, const size_t *counts) {
    const size_t parts = c->scene->part_count;
    for (size_t i = 1; i < parts; i++) {
        const scene_part *part = &c->scene->parts[i];
        c->groups[i] = (geometry_group){.shapes = shapes, .shape_count = counts[i]};
        c->groups[parts + i] = (geometry_group){.shapes = part->shapes, .shape_count = part->surface_count};
        for (size_t k = 0; k < part->surface_count; k++)
            if (part->surfaces[k].material == c->material)
                *shapes++ = part->shapes[k];
    }
}

/* Groups that are placed nowhere need not be built. */
static void leave_out_unplaced(collection *c) {
    for (size_t i = 1; i < 2 * c->scene->part_count; i++) {
        bool placed = false;
        for (size_t k = 0; k < c->count && !placed; k++)
            placed = c->placements[k].group == (int)i;
        if (!placed)
            c->groups[i].shape_count = 0;
    }
}

/* All groups but the first, and where they are placed. */
static bool collect(collection *c, scene_bounds *b) {
    const size_t parts = c->scene->part_count;
    size_t *counts = calloc(parts + 1, sizeof *counts);
    c->holds = calloc(parts + 1, sizeof *c->holds);
    if (counts && c->holds)
        b->shapes = malloc((count_surfaces(c->scene, c->material, counts) + 1) * sizeof *b->shapes);
    if (b->shapes) {
        find_holders(c, counts);
        fill_groups(c, b->shapes, counts);
        if (c->holds[0])
            place_copies(c, 0, NULL, false);
        leave_out_unplaced(c);
    }
    free(counts);
    free(c->holds);
    b->placements = c->placements;
    return b->shapes && !c->failed;
}

graze_status scene_bounds_build(scene_bounds *b, const graze_scene *scene, int material, const shape *own,
                                size_t own_count, int threads, const graze_report *report) {
    const size_t count = scene->part_count ? 2 * scene->part_count : 1;
    collection c = {.scene = scene, .material = material, .groups = calloc(count, sizeof *c.groups)};
    *b = (scene_bounds){0};
    if (!c.groups || (scene->part_count && !collect(&c, b))) {
        free(c.groups);
        return report_out_of_memory(report);
    }
    c.groups[0] = (geometry_group){own, own_count, c.placements, c.count};
    graze_status status = geometry_build(&b->geometry, c.groups, count, threads, report);
    free(c.groups);
    return status;
}

void scene_bounds_destroy(scene_bounds *b) {
    geometry_destroy(b->geometry);
    free(b->shapes);
    free(b->placements);
}
