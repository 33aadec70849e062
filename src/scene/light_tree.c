/* Putting lights in order, and grouping them. */
#include "scene/light_tree.h"

#include <stdlib.h>

#include "scene/light_summary.h"
#include "scene/light_weights.h"

typedef struct builder {
    light_tree *tree;
    const scene_light *lights;
    light_summary *summaries; /* by light */
    light_place *order;       /* the lights that are sampled */
    size_t count;
    size_t *begin, *end; /* by group: its part of `order` */
    size_t *near;        /* by group: how many entries are no sources */
} builder;

static int compare_places(const void *a, const void *b) {
    const light_place *p = a, *q = b;
    return p->key != q->key ? (p->key > q->key) - (p->key < q->key) : (p->light > q->light) - (p->light < q->light);
}

static double coordinate(vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static void sort_along_widest(builder *b, size_t begin, size_t end) {
    double lower[3], upper[3];
    int widest = 0;
    for (int axis = 0; axis < 3; axis++) {
        lower[axis] = INFINITY;
        upper[axis] = -INFINITY;
        for (size_t i = begin; i < end; i++) {
            double x = coordinate(b->summaries[b->order[i].light].middle, axis);
            lower[axis] = fmin(lower[axis], x);
            upper[axis] = fmax(upper[axis], x);
        }
        if (upper[axis] - lower[axis] > upper[widest] - lower[widest])
            widest = axis;
    }
    for (size_t i = begin; i < end; i++)
        b->order[i].key = coordinate(b->summaries[b->order[i].light].middle, widest);
    qsort(b->order + begin, end - begin, sizeof *b->order, compare_places);
}

/* Makes parts as near in number as can be, each of lights that are near each other, and near to the parts beside it. */
static void order_in_parts(builder *b, size_t begin, size_t end, size_t parts) {
    if (parts <= 1 || end - begin <= 1)
        return;
    sort_along_widest(b, begin, end);
    size_t first = parts / 2, middle = begin + (end - begin) * first / parts;
    order_in_parts(b, begin, middle, first);
    order_in_parts(b, middle, end, parts - first);
}

static int add_group(builder *b, size_t begin, size_t end, int parent) {
    light_tree *t = b->tree;
    int index = (int)t->group_count++;
    t->groups[index] = (light_group){.parent = parent};
    b->begin[index] = begin;
    b->end[index] = end;
    return index;
}

/* As many as make the whole way down to a light shortest. */
static size_t parts_of(size_t count) {
    size_t parts = 16;
    while (parts < LIGHT_GROUP_MOST / 2 && parts * parts < count)
        parts *= 2;
    return parts < count ? parts : count;
}

static size_t add_parts(builder *b, size_t begin, size_t end, int parent) {
    if (begin == end)
        return 0;
    size_t parts = parts_of(end - begin);
    order_in_parts(b, begin, end, parts);
    for (size_t done = 0; done < parts; done++)
        (void)add_group(b, begin + (end - begin) * done / parts, begin + (end - begin) * (done + 1) / parts, parent);
    return parts;
}

static int blocks_for(size_t entries) {
    return (int)((entries + LIGHT_LANES - 1) / LIGHT_LANES);
}

/* Divides a group into groups, unless it is of lights. Sources stand behind all others, and have groups of their own.
 */
static void divide(builder *b, int index, size_t first_source) {
    light_tree *t = b->tree;
    size_t begin = b->begin[index], end = b->end[index];
    size_t middle = first_source < begin ? begin : first_source > end ? end : first_source;
    size_t near = middle - begin, far = end - middle;
    t->groups[index].of_lights = end - begin <= LIGHT_GROUP_MOST - LIGHT_LANES;
    if (t->groups[index].of_lights) {
        order_in_parts(b, begin, middle, near);
        order_in_parts(b, middle, end, far);
    } else {
        near = add_parts(b, begin, middle, index);
        far = add_parts(b, middle, end, index);
    }
    light_group *g = &t->groups[index];
    b->near[index] = near;
    g->far_blocks = blocks_for(far);
    g->blocks = blocks_for(near) + g->far_blocks;
    g->first = t->entry_count;
    t->entry_count += (size_t)g->blocks * LIGHT_LANES;
}

static bool allocate_floats(float **arrays[], size_t arrays_count, size_t count, arena *memory) {
    for (size_t i = 0; i < arrays_count; i++) {
        *arrays[i] = arena_allocate(memory, count * sizeof **arrays[i]);
        if (!*arrays[i])
            return false;
        for (size_t k = 0; k < count; k++)
            (*arrays[i])[k] = 0;
    }
    return true;
}

static bool allocate_entries(light_entries *e, size_t count, arena *memory) {
    float **floats[] = {&e->ax,
                        &e->ay,
                        &e->az,
                        &e->cosine,
                        &e->sine,
                        &e->all_around,
                        &e->quarter_per_radius,
                        &e->radius,
                        &e->spread,
                        &e->core,
                        &e->area,
                        &e->red,
                        &e->green,
                        &e->blue,
                        &e->spot_x,
                        &e->ambient_red,
                        &e->ambient_green,
                        &e->ambient_blue,
                        &e->spot_y,
                        &e->spot_z,
                        &e->spot_cosine,
                        &e->spot_focus};
    double **doubles[] = {&e->x, &e->y, &e->z};
    if (!allocate_floats(floats, sizeof floats / sizeof *floats, count, memory))
        return false;
    for (size_t i = 0; i < sizeof doubles / sizeof *doubles; i++) {
        *doubles[i] = arena_allocate(memory, count * sizeof **doubles[i]);
        if (!*doubles[i])
            return false;
    }
    e->child = arena_allocate(memory, count * sizeof *e->child);
    if (!e->child)
        return false;
    for (size_t i = 0; i < count; i++) {
        e->x[i] = e->y[i] = e->z[i] = 0;
        e->radius[i] = e->core[i] = 1;
        e->child[i] = -1;
    }
    return true;
}

static float bounded(double x, double least) {
    return (float)fmin(fmax(x, least), 100 * LIGHT_FAR * LIGHT_FAR);
}

static float part_of(double x, double most) {
    return x > 0 ? (float)fmax(x / most, 1e-30) : 0;
}

static void store(const light_tree *t, size_t at, const light_summary *m, double most) {
    const light_entries *e = &t->entries;
    e->x[at] = m->middle.x;
    e->y[at] = m->middle.y;
    e->z[at] = m->middle.z;
    e->ax[at] = (float)m->axis.x;
    e->ay[at] = (float)m->axis.y;
    e->az[at] = (float)m->axis.z;
    e->cosine[at] = (float)m->cosine;
    e->sine[at] = (float)sqrt(fmax(0, 1 - m->cosine * m->cosine));
    e->all_around[at] = m->cosine > -1 ? 0 : 1;
    e->radius[at] = bounded(m->radius, LIGHT_LEAST);
    e->quarter_per_radius[at] = 0.25f / e->radius[at];
    e->spread[at] = bounded(m->spread, LIGHT_LEAST * LIGHT_LEAST);
    e->core[at] = bounded(m->core, LIGHT_LEAST * LIGHT_LEAST);
    e->area[at] = bounded(m->area, 1e-30);
    e->red[at] = part_of(m->radiance.r, most);
    e->green[at] = part_of(m->radiance.g, most);
    e->blue[at] = part_of(m->radiance.b, most);
    e->ambient_red[at] = part_of(m->ambient.r, most);
    e->ambient_green[at] = part_of(m->ambient.g, most);
    e->ambient_blue[at] = part_of(m->ambient.b, most);
    e->spot_cosine[at] = -2;
}

static void store_spot(const light_entries *e, size_t at, const scene_light *light, double per_unit) {
    e->spot_x[at] = (float)light->spot_axis.x;
    e->spot_y[at] = (float)light->spot_axis.y;
    e->spot_z[at] = (float)light->spot_axis.z;
    e->spot_cosine[at] = (float)light->spot_cosine;
    e->spot_focus[at] = bounded(light->spot_focus * per_unit, 0);
}

/* The entry that is number `index` of a group in its order, where the first `near` are no sources: first lanes, then
 * blocks. */
static size_t entry_at(const light_group *g, size_t index, size_t near) {
    size_t near_blocks = (size_t)(g->blocks - g->far_blocks), blocks = near_blocks, first = g->first;
    if (index >= near) {
        index -= near;
        first += near_blocks * LIGHT_LANES;
        blocks = (size_t)g->far_blocks;
    }
    return first + index % blocks * LIGHT_LANES + index / blocks;
}

static void fill_lights(const builder *b, int index, double most) {
    light_tree *t = b->tree;
    for (size_t i = b->begin[index]; i < b->end[index]; i++) {
        int light = b->order[i].light;
        size_t at = entry_at(&t->groups[index], i - b->begin[index], b->near[index]);
        store(t, at, &b->summaries[light], most);
        if (b->lights[light].spot)
            store_spot(&t->entries, at, &b->lights[light], t->per_unit);
        t->entries.child[at] = light;
        t->group_of[light] = index;
        t->entry_of[light] = at;
    }
}

static void fill_entries(const builder *b, double most) {
    light_tree *t = b->tree;
    size_t *children = b->begin + t->group_count; /* of each group, so far */
    for (size_t i = 0; i < t->group_count; i++)
        children[i] = 0;
    for (int i = 0; i < (int)t->group_count; i++) {
        light_group *g = &t->groups[i];
        if (g->of_lights)
            fill_lights(b, i, most);
        if (g->parent < 0)
            continue;
        light_summary all = light_summarize_all(b->summaries, b->order + b->begin[i], b->end[i] - b->begin[i]);
        g->parent_entry = entry_at(&t->groups[g->parent], children[g->parent]++, b->near[g->parent]);
        store(t, g->parent_entry, &all, most);
        t->entries.child[g->parent_entry] = i;
    }
}

/* The middle of the lights that are shapes, and their extent. */
static void measure_extent(light_tree *t, const scene_light *lights, size_t count) {
    vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = vec3_negate(lower);
    for (size_t i = 0; i < count; i++) {
        vec3 low, high;
        if (!lights[i].shape)
            continue;
        shape_bounds(lights[i].shape, &low, &high);
        lower = vec3_min(lower, low);
        upper = vec3_max(upper, high);
    }
    double extent = vec3_max_abs(vec3_subtract(upper, lower));
    bool usable = extent > 0 && isfinite(extent);
    t->per_unit = usable ? 1 / extent : 1;
    t->middle = usable ? vec3_scale(0.5, vec3_add(lower, upper)) : (vec3){0, 0, 0};
}

static double clamp_coordinate(double x) {
    return fmin(fmax(x, -LIGHT_MOST), LIGHT_MOST);
}

vec3 light_tree_point(const light_tree *t, vec3 point) {
    vec3 p = vec3_scale(t->per_unit, vec3_subtract(point, t->middle));
    return (vec3){clamp_coordinate(p.x), clamp_coordinate(p.y), clamp_coordinate(p.z)};
}

/* Of shapes, or of sources. */
static void summarize_lights(builder *b, size_t count, bool sources, double *most) {
    light_tree *t = b->tree;
    for (size_t i = 0; i < count; i++) {
        const scene_light *light = &b->lights[i];
        if (sources != !light->shape)
            continue;
        t->group_of[i] = -1;
        t->entry_of[i] = 0;
        if (light->glow && light->glow_radius < 0)
            continue;
        b->summaries[i] = light_summarize(t, light);
        b->order[b->count++].light = (int)i;
        t->has_glows = t->has_glows || light->glow;
        t->has_spots = t->has_spots || light->spot;
        *most = fmax(*most, rgb_max(light->typical));
    }
}

static graze_status build(builder *b, size_t count, arena *memory, const graze_report *report) {
    light_tree *t = b->tree;
    size_t groups = count / 2 + 18;
    double most = 0;
    t->group_of = arena_allocate(memory, (count + 1) * sizeof *t->group_of);
    t->entry_of = arena_allocate(memory, (count + 1) * sizeof *t->entry_of);
    t->groups = arena_allocate(memory, groups * sizeof *t->groups);
    b->summaries = malloc((count + 1) * sizeof *b->summaries);
    b->order = malloc((count + 1) * sizeof *b->order);
    b->begin = malloc(2 * groups * sizeof *b->begin);
    b->end = malloc(groups * sizeof *b->end);
    b->near = malloc(groups * sizeof *b->near);
    if (!t->group_of || !t->entry_of || !t->groups || !b->summaries || !b->order || !b->begin || !b->end || !b->near)
        return report_out_of_memory(report);
    measure_extent(t, b->lights, count);
    summarize_lights(b, count, false, &most);
    const size_t first_source = b->count;
    summarize_lights(b, count, true, &most);
    (void)add_group(b, 0, b->count, -1);
    for (size_t i = 0; i < t->group_count; i++)
        divide(b, (int)i, first_source);
    if (!allocate_entries(&t->entries, t->entry_count + 1, memory))
        return report_out_of_memory(report);
    fill_entries(b, most);
    return GRAZE_OK;
}

graze_status light_tree_build(light_tree *tree, const scene_light *lights, size_t count, arena *memory,
                              const graze_report *report) {
    builder b = {.tree = tree, .lights = lights};
    *tree = (light_tree){.weigh = light_weights_best()};
    graze_status status = build(&b, count, memory, report);
    free(b.summaries);
    free(b.order);
    free(b.begin);
    free(b.end);
    free(b.near);
    return status;
}
