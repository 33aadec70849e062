/* Glows in copies: they light as ambient ones do, each copy of each from where it stands, and are sampled there. */
#include <stdlib.h>

#include "geometry/placed.h"
#include "scene/builder.h"

/* Of more, none is sampled: reflection alone finds them. */
#define MOST_LIGHTS ((size_t)1 << 17)

/* What is in a part, and in all copies in it. */
typedef struct census {
    int64_t surfaces;
    size_t lights; /* that can be sampled; no more than MOST_LIGHTS + 1 */
} census;

typedef struct adding {
    scene_builder *builder;
    census *parts; /* by part */
    scene_light *next;
} adding;

/* Where a copy stands, and what stands for all that is in it. */
typedef struct stand {
    const rad_transform *transform; /* to the scene */
    const rad_transform *frame;     /* from where the material is written; null: it is the scene */
    int light;                      /* of all surfaces; -1: none; or: */
} stand;

enum { OWN_LIGHTS = -2 };

/* Whether light from there counts for more than the eye. */
static bool lights_others(const graze_scene *scene, int light) {
    return light >= (int)scene->light_count && scene->lights[light].glow && scene->lights[light].glow_radius >= 0;
}

/* Light samples know patterns by points in space, not by those of a mesh. */
static bool can_be_sampled(const graze_scene *scene, const scene_part *part, const scene_surface *s) {
    return lights_others(scene, s->light) && scene_material_emits(&scene->materials[s->material]) &&
           !(scene->lights[s->light].modifiers && part->mesh && part->mesh->uv);
}

static void count_lights(census *c, size_t lights) {
    c->lights = c->lights + lights > MOST_LIGHTS ? MOST_LIGHTS + 1 : c->lights + lights;
}

static void count_surface(graze_scene *scene, const scene_part *part, const scene_surface *s, census *c, size_t times) {
    if (!lights_others(scene, s->light))
        return;
    if (can_be_sampled(scene, part, s))
        count_lights(c, times);
    else
        scene->meets_glows = true;
}

static census census_of(graze_scene *scene, const census *parts, int number) {
    const scene_part *part = &scene->parts[number];
    census c = {.surfaces = (int64_t)part->surface_count};
    for (size_t i = 0; i < part->surface_count; i++)
        count_surface(scene, part, &part->surfaces[i], &c, 1);
    for (size_t i = 0; i < part->copy_count; i++) {
        const geometry_placement *copy = &part->placements[i];
        const census *in = &parts[copy->group];
        const size_t most = (size_t)(in->surfaces < (int64_t)MOST_LIGHTS ? in->surfaces : (int64_t)MOST_LIGHTS + 1);
        if (in->surfaces > INT64_MAX - c.surfaces)
            c = (census){.surfaces = INT64_MAX - in->surfaces, .lights = MOST_LIGHTS + 1};
        c.surfaces += in->surfaces;
        if (copy->replaces)
            count_surface(scene, &scene->parts[copy->group], &part->replacing[i], &c, most);
        else
            count_lights(&c, in->lights);
    }
    return c;
}

/* The polygon itself, not only what shape_placed tells of it. */
static bool place_polygon(shape *placed, const shape *s, const rad_transform *t, arena *memory) {
    const uint32_t count = shape_vertex_count(s), triangles = s->polygon.triangle_count;
    vec3 *vertices = arena_allocate(memory, count * sizeof *vertices);
    uint32_t(*corners)[3] = arena_allocate(memory, (triangles + 1) * sizeof *corners);
    if (!vertices || !corners)
        return false;
    for (uint32_t i = 0; i < count; i++)
        vertices[i] = rad_transform_point(t, s->polygon.vertices[i]);
    for (uint32_t i = 0; i < triangles; i++) {
        const uint32_t *from = s->polygon.triangles[i];
        corners[i][0] = from[0];
        corners[i][1] = from[t->mirrored ? 2 : 1];
        corners[i][2] = from[t->mirrored ? 1 : 2];
    }
    placed->polygon.vertices = vertices;
    placed->polygon.triangles = (const uint32_t(*)[3])corners;
    return shape_prepare_light(placed, memory);
}

static shape *placed_shape(const shape *s, const rad_transform *t, arena *memory) {
    shape *placed = arena_allocate(memory, sizeof *placed);
    if (!placed)
        return NULL;
    *placed = shape_placed(s, t);
    return s->kind != SHAPE_POLYGON || place_polygon(placed, s, t, memory) ? placed : NULL;
}

/* Keeps what the walk through the parts forgets. */
static const rad_transform *keep(const rad_transform *t, arena *memory) {
    rad_transform *kept = arena_allocate(memory, sizeof *kept);
    if (kept)
        *kept = *t;
    return kept;
}

static void add_light(adding *a, const stand *at, int seen, const shape *s, int64_t number) {
    graze_scene *scene = a->builder->scene;
    scene_light light = scene->lights[seen];
    light.shape = placed_shape(s, at->transform, scene->memory);
    light.surface = number;
    light.frame = light.modifiers && at->frame ? keep(at->frame, scene->memory) : NULL;
    light.seen_as = seen;
    if (!light.shape || (light.modifiers && at->frame && !light.frame))
        scene_fail(a->builder, report_out_of_memory(a->builder->report));
    *a->next++ = light;
}

static void add_part(adding *a, int number, const stand *at, int64_t first);

static void add_copies(adding *a, int number, const stand *at, int64_t first) {
    const graze_scene *scene = a->builder->scene;
    const scene_part *part = &scene->parts[number];
    for (size_t i = 0; i < part->copy_count; i++) {
        const geometry_placement *copy = &part->placements[i];
        const rad_transform *inner = &copy->transform;
        rad_transform whole = at->transform ? rad_transform_then(inner, at->transform) : *inner;
        stand there = {&whole, at->light == OWN_LIGHTS ? &whole : at->frame, at->light};
        if (at->light == OWN_LIGHTS && copy->replaces) {
            bool sampled = can_be_sampled(scene, &scene->parts[copy->group], &part->replacing[i]);
            there.frame = at->transform;
            there.light = sampled ? part->replacing[i].light : -1;
        }
        if (there.light != -1)
            add_part(a, copy->group, &there, first);
        first += a->parts[copy->group].surfaces;
    }
}

/* In the order of their numbers. */
static void add_part(adding *a, int number, const stand *at, int64_t first) {
    const graze_scene *scene = a->builder->scene;
    const scene_part *part = &scene->parts[number];
    if (at->light == OWN_LIGHTS && a->parts[number].lights == 0)
        return;
    for (size_t i = 0; i < part->surface_count && number > 0; i++) {
        const scene_surface *s = &part->surfaces[i];
        int light = at->light != OWN_LIGHTS ? at->light : can_be_sampled(scene, part, s) ? s->light : -1;
        if (light >= 0)
            add_light(a, at, light, &part->shapes[i], first + (int64_t)i);
    }
    add_copies(a, number, at, first + (int64_t)part->surface_count);
}

/* Lights that only are seen have been moved back. */
static void renumber(graze_scene *scene, int from, int by) {
    for (size_t i = 0; i < scene->material_count; i++)
        if (scene_material_emits(&scene->materials[i]) && scene->materials[i].seen_light >= from)
            scene->materials[i].seen_light += by;
    for (size_t k = 0; k < scene->part_count; k++) {
        const scene_part *part = &scene->parts[k];
        for (size_t i = 0; i < part->surface_count; i++)
            if (part->surfaces[i].light >= from)
                part->surfaces[i].light += by;
        for (size_t i = 0; i < part->copy_count; i++)
            if (part->replacing[i].light >= from)
                part->replacing[i].light += by;
    }
}

/* Puts them behind all that light others. */
static void insert_lights(scene_builder *b, const scene_light *added, size_t count) {
    graze_scene *scene = b->scene;
    const size_t first = scene->light_count, behind = scene->seen_light_count;
    scene_light *all = realloc(scene->lights, (first + count + behind) * sizeof *all);
    if (!all) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    scene->lights = all;
    for (size_t i = behind; i-- > 0;)
        all[first + count + i] = all[first + i];
    for (size_t i = 0; i < count; i++) {
        all[first + i] = added[i];
        all[first + i].seen_as += (int)count;
    }
    renumber(scene, (int)first, (int)count);
    scene->light_count += count;
}

static void add_all(scene_builder *b, census *parts) {
    size_t count = parts[0].lights;
    if (count == 0)
        return;
    scene_light *added = malloc(count * sizeof *added);
    adding a = {b, parts, added};
    const stand scene_itself = {.light = OWN_LIGHTS};
    if (added)
        add_part(&a, 0, &scene_itself, 0);
    else
        scene_fail(b, report_out_of_memory(b->report));
    if (b->status == GRAZE_OK)
        insert_lights(b, added, (size_t)(a.next - added));
    free(added);
}

void scene_add_copied_lights(scene_builder *b) {
    graze_scene *scene = b->scene;
    for (size_t i = 0; i < scene->surface_count; i++)
        scene->meets_glows = scene->meets_glows || lights_others(scene, scene->surfaces[i].light);
    if (scene->part_count == 0)
        return;
    census *parts = malloc(scene->part_count * sizeof *parts);
    if (!parts) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    for (size_t i = scene->part_count; i-- > 0;)
        parts[i] = census_of(scene, parts, (int)i);
    if (parts[0].lights > MOST_LIGHTS)
        scene->meets_glows = true;
    else
        add_all(b, parts);
    free(parts);
}
