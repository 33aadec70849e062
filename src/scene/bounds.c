/* Bounds of bodies in copies: each part's surfaces of the material once, in copies of parts as in the scene. */
#include "scene/bounds.h"

#include <stdlib.h>

/* The groups of a geometry: of each part its surfaces of the material, and those in its copies; and behind these, of
 * each part all, for copies whose own modifier is the material. The scene itself is the first part. */
typedef struct collection {
    const graze_scene *scene;
    int material;
    geometry_group *groups; /* two for each part */
    bool *holds;            /* by part: it has such surfaces, or copies that do */
    bool *placed;           /* by group */
    shape *shapes;          /* room for those of the next group, */
    geometry_placement *placements;
} collection;

static bool is_of_material(const collection *c, const scene_surface *s) {
    return s->material == c->material;
}

static bool is_copy_of(const collection *c, const scene_part *part, size_t copy) {
    const geometry_placement *placement = &part->placements[copy];
    return placement->replaces ? is_of_material(c, &part->replacing[copy]) : c->holds[placement->group];
}

/* Parts are behind those that hold copies of them. Gives how many copies there are in parts, and their surfaces of the
 * material. */
static void find_holders(collection *c, size_t *copies, size_t *surfaces) {
    *copies = *surfaces = 0;
    for (size_t i = c->scene->part_count; i-- > 0;) {
        const scene_part *part = &c->scene->parts[i];
        const size_t before = *surfaces;
        for (size_t k = 0; k < part->surface_count && i > 0; k++)
            *surfaces += is_of_material(c, &part->surfaces[k]);
        c->holds[i] = *surfaces > before;
        for (size_t k = 0; k < part->copy_count && !c->holds[i]; k++)
            c->holds[i] = is_copy_of(c, part, k);
        *copies += part->copy_count;
    }
}

static void add_shapes(collection *c, geometry_group *group, const scene_part *part) {
    group->shapes = c->shapes;
    for (size_t k = 0; k < part->surface_count; k++)
        if (is_of_material(c, &part->surfaces[k]))
            *c->shapes++ = part->shapes[k];
    group->shape_count = (size_t)(c->shapes - group->shapes);
}

/* `all`: a modifier around them is the material. */
static void add_copies(collection *c, geometry_group *group, const scene_part *part, bool all) {
    group->placements = c->placements;
    for (size_t k = 0; k < part->copy_count; k++) {
        const geometry_placement *copy = &part->placements[k];
        if (!all && !is_copy_of(c, part, k))
            continue;
        const bool whole = all || copy->replaces;
        const int of = copy->group + (whole ? (int)c->scene->part_count : 0);
        c->placed[of] = true;
        *c->placements++ = (geometry_placement){.group = of, .transform = copy->transform, .replaces = whole};
    }
    group->placement_count = (size_t)(c->placements - group->placements);
}

/* Groups are behind those that hold copies of them. Those that are placed nowhere stay empty. */
static void fill_groups(collection *c) {
    const size_t parts = c->scene->part_count;
    c->placed[0] = true;
    for (size_t i = 0; i < 2 * parts; i++) {
        const scene_part *part = &c->scene->parts[i % parts];
        const bool all = i >= parts;
        if (!c->placed[i])
            continue;
        if (all)
            c->groups[i] = (geometry_group){.shapes = part->shapes, .shape_count = part->surface_count};
        else if (i > 0)
            add_shapes(c, &c->groups[i], part);
        add_copies(c, &c->groups[i], part, all);
    }
}

/* All groups, but for the scene's own surfaces. */
static bool collect(collection *c, scene_bounds *b) {
    const size_t parts = c->scene->part_count;
    c->holds = calloc(parts, sizeof *c->holds);
    c->placed = calloc(2 * parts, sizeof *c->placed);
    if (c->holds && c->placed) {
        size_t copies, surfaces;
        find_holders(c, &copies, &surfaces);
        c->shapes = b->shapes = malloc((surfaces + 1) * sizeof *b->shapes);
        c->placements = b->placements = malloc((2 * copies + 1) * sizeof *b->placements);
        if (b->shapes && b->placements)
            fill_groups(c);
    }
    free(c->holds);
    free(c->placed);
    return b->shapes && b->placements;
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
    c.groups[0].shapes = own;
    c.groups[0].shape_count = own_count;
    graze_status status = geometry_build(&b->geometry, c.groups, count, threads, report);
    free(c.groups);
    return status;
}

void scene_bounds_destroy(scene_bounds *b) {
    geometry_destroy(b->geometry);
    free(b->shapes);
    free(b->placements);
}
