/* Flat mirrors and panes of glass, in which lights are sampled, and which lights they may show to a point. */
#include "scene/mirrors.h"

#include <stdlib.h>

#include "geometry/crossing.h"
#include "scene/builder.h"

/* Each vertex asks all mirrors which lights they show: of so many planes of panes that takes as long as the rest of a
 * path. They add little; what smaller ones show is left to luck. */
#define MOST_PLANES 32
/* Of more panes than this the largest are looked at, lest finding their planes takes long. */
#define MOST_PANES 2048
/* Lights are looked at one by one up to so many. */
#define FEW_LIGHTS 8

void scene_mirrors_note(scene_builder *b, int index) {
    graze_scene *scene = b->scene;
    const scene_material *m = &scene->materials[scene->surfaces[index].material];
    const bool mirror = scene_material_shows_lights(m), pane = scene_material_shows_lights_faintly(m);
    if (!mirror && !pane)
        return;
    if (!shape_is_flat(&scene->shapes[index])) {
        scene->has_mirrors = scene->has_mirrors || mirror;
        return;
    }
    int *grown = realloc(scene->mirror_surfaces, (scene->mirror_surface_count + 1) * sizeof *grown);
    if (!grown) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    scene->mirror_surfaces = grown;
    scene->mirror_surfaces[scene->mirror_surface_count++] = index;
    scene->surfaces[index].mirrors = pane || m->alternate < 0 || m->keeps_front;
}

/* Spheres are so much larger than they need be, so that roundings do not matter. */
#define SLACK (1 + 1e-9)

static void bound(const shape *s, vec3 *middle, double *radius) {
    vec3 lower, upper;
    shape_bounds(s, &lower, &upper);
    *middle = vec3_scale(0.5, vec3_add(lower, upper));
    *radius = vec3_length(vec3_subtract(upper, lower)) / 2 * SLACK;
    if (s->kind == SHAPE_SPHERE)
        *radius = s->sphere.radius * SLACK;
    if (s->kind == SHAPE_RING)
        *radius = s->ring.r1 * SLACK;
    if (s->kind != SHAPE_POLYGON)
        return;
    double farthest = 0;
    *middle = shape_pull(s, *middle);
    for (uint32_t i = 0; i < s->polygon.vertex_count; i++)
        farthest = fmax(farthest, vec3_length(vec3_subtract(s->polygon.vertices[i], *middle)));
    *radius = farthest * SLACK;
}

/* A mirror with all that tells mirrors apart. */
typedef struct draft {
    scene_mirror mirror;
    double area;
    int surface;
    int plane; /* the number of the first draft that is in the same plane; each mirror has its own */
} draft;

static draft draft_of(const graze_scene *scene, int surface, int plane) {
    const shape *s = &scene->shapes[surface];
    draft d = {.surface = surface, .plane = plane, .area = shape_area(s), .mirror = {.plane = shape_plane_of(s)}};
    d.mirror.pane = scene_material_shows_lights_faintly(&scene->materials[scene->surfaces[surface].material]);
    bound(s, &d.mirror.middle, &d.mirror.radius);
    return d;
}

/* What is in one plane but for so much of its size, or of an angle of 1, is so but for what coordinates in files say.
 */
#define ONE_PLANE 1e-5

static bool are_in_one_plane(const scene_mirror *a, const scene_mirror *b) {
    const vec3 n = a->plane.normal;
    return a->pane && b->pane && vec3_length(vec3_cross(n, b->plane.normal)) < ONE_PLANE &&
           fabs(vec3_dot(n, vec3_subtract(b->plane.point, a->plane.point))) < ONE_PLANE * fmin(a->radius, b->radius);
}

/* Has the sphere around a mirror be around another, too. */
static void enclose(scene_mirror *m, const scene_mirror *other) {
    vec3 apart = vec3_subtract(other->middle, m->middle);
    double distance = vec3_length(apart);
    if (distance + other->radius <= m->radius)
        return;
    double radius = (distance + m->radius + other->radius) / 2;
    m->middle = vec3_add_scaled(m->middle, distance > 0 ? (radius - m->radius) / distance : 0, apart);
    m->radius = radius * SLACK;
}

/* Mirrors first, then panes, the largest planes first; surfaces of one plane stay together, in their order. */
static int by_plane(const void *a, const void *b) {
    const draft *x = a, *y = b;
    if (x->mirror.pane != y->mirror.pane)
        return x->mirror.pane ? 1 : -1;
    if (x->plane != y->plane && x->mirror.pane && x->area != y->area)
        return x->area > y->area ? -1 : 1;
    if (x->plane != y->plane)
        return x->plane < y->plane ? -1 : 1;
    return x->surface < y->surface ? -1 : x->surface > y->surface;
}

/* Has mirrors come first, then panes by area, and gives how many are left of these. */
static size_t leave_smallest_out(graze_scene *scene, draft *drafts, size_t count) {
    size_t panes = 0, kept = 0;
    qsort(drafts, count, sizeof *drafts, by_plane);
    for (size_t i = 0; i < count; i++) {
        panes += drafts[i].mirror.pane;
        if (panes <= MOST_PANES)
            kept++;
        else
            scene->surfaces[drafts[i].surface].mirrors = false;
    }
    return kept;
}

/* Finds their planes, and has their areas be those of all in the plane. */
static void find_planes(draft *drafts, size_t count) {
    for (size_t i = 0; i < count; i++) {
        drafts[i].plane = (int)i;
        for (size_t k = 0; drafts[i].mirror.pane && k < i && drafts[i].plane == (int)i; k++)
            if (drafts[k].plane == (int)k && are_in_one_plane(&drafts[k].mirror, &drafts[i].mirror)) {
                drafts[i].plane = (int)k;
                drafts[k].area += drafts[i].area;
            }
    }
    for (size_t i = 0; i < count; i++)
        drafts[i].area = drafts[drafts[i].plane].area;
}

static void keep(graze_scene *scene, const draft *drafts, size_t count) {
    size_t planes = 0;
    scene->mirror_surface_count = 0;
    for (size_t i = 0; i < count; i++) {
        const draft *d = &drafts[i];
        bool begins = i == 0 || d->plane != d[-1].plane;
        planes += begins && d->mirror.pane;
        if (planes > MOST_PLANES) {
            scene->surfaces[d->surface].mirrors = false;
            continue;
        }
        scene->mirror_surfaces[scene->mirror_surface_count++] = d->surface;
        if (begins) {
            scene->mirrors[scene->mirror_count] = d->mirror;
            scene->mirrors[scene->mirror_count++].first = (int)i;
        }
        scene_mirror *m = &scene->mirrors[scene->mirror_count - 1];
        enclose(m, &d->mirror);
        m->count++;
        scene->mirror_of[d->surface] = (int)(m - scene->mirrors);
    }
}

static scene_mirrored_light bound_light(const scene_light *light) {
    scene_mirrored_light made = {
        .source = !light->shape, .ambient = light_is_ambient(light), .brightness = rgb_brightness(light->typical)};
    if (light->shape) {
        bound(light->shape, &made.middle, &made.radius);
        return made;
    }
    made.middle = light->center;
    made.radius = sin(light->half_angle);
    made.cosine = cos(light->half_angle);
    return made;
}

graze_status scene_mirrors_make(graze_scene *scene, const graze_report *report) {
    size_t count = scene->mirror_surface_count;
    if (count == 0 || scene->light_count == 0)
        return GRAZE_OK;
    draft *drafts = malloc(count * sizeof *drafts);
    scene->mirrors = malloc(count * sizeof *scene->mirrors);
    scene->mirror_of = malloc(scene->surface_count * sizeof *scene->mirror_of);
    if (!drafts || !scene->mirrors || !scene->mirror_of) {
        free(drafts);
        return report_out_of_memory(report);
    }
    for (size_t i = 0; i < count; i++)
        drafts[i] = draft_of(scene, scene->mirror_surfaces[i], (int)i);
    count = leave_smallest_out(scene, drafts, count);
    find_planes(drafts, count);
    qsort(drafts, count, sizeof *drafts, by_plane);
    keep(scene, drafts, count);
    free(drafts);
    if (scene->light_count > FEW_LIGHTS)
        return GRAZE_OK;
    scene->mirrored_lights = malloc(scene->light_count * sizeof *scene->mirrored_lights);
    if (!scene->mirrored_lights)
        return report_out_of_memory(report);
    for (size_t i = 0; i < scene->light_count; i++)
        scene->mirrored_lights[i] = bound_light(&scene->lights[i]);
    return GRAZE_OK;
}

/* About what a pane reflects of light that meets it at this cosine. */
static double faintness(double cosine) {
    double left = 1 - fmin(cosine, 1), square = left * left;
    return 0.08 + 0.92 * square * square * left;
}

bool scene_mirror_see(const scene_mirror *m, vec3 point, vec3 normal, scene_mirror_sight *sight) {
    vec3 towards = vec3_subtract(m->middle, point);
    double height = -vec3_dot(m->plane.normal, towards);
    if (height == 0 || (height < 0 && !m->pane) || !(vec3_dot(towards, normal) + m->radius > 0))
        return false;
    vec3 from_image = vec3_add_scaled(towards, 2 * height, m->plane.normal);
    double square = vec3_dot(towards, towards), share = m->radius * m->radius / square;
    sight->mirror = m;
    sight->side = height > 0 ? 1 : -1;
    sight->image = vec3_add_scaled(point, -2 * height, m->plane.normal);
    sight->towards = vec3_scale(1 / sqrt(square), from_image);
    sight->sine = share < 1 ? sqrt(share) : 1;
    sight->cosine = share < 1 ? sqrt(1 - share) : -1;
    sight->reflects = m->pane ? faintness(fabs(height) / sqrt(square)) : 1;
    sight->share = fmin(share, 1);
    return true;
}

/* Directions that are so much farther apart may still meet. */
#define ROUNDING 1e-9

/* Whether two cones of directions meet whose axes have this cosine; half their angles are told by sines and cosines,
 * the first one's is less than a right angle. */
static bool meet(double between, double sine, double cosine, double other_sine, double other_cosine) {
    bool all_around = sine * other_cosine + cosine * other_sine <= 0;
    return all_around || between >= cosine * other_cosine - sine * other_sine - ROUNDING;
}

double scene_mirror_shows(const scene_mirror_sight *s, const scene_mirrored_light *light) {
    const vec3 n = s->mirror->plane.normal;
    if (light->source) {
        bool below = light->cosine > 0 && s->side * vec3_dot(n, light->middle) + light->radius <= 0;
        bool shown =
            !below && meet(vec3_dot(s->towards, light->middle), s->sine, s->cosine, light->radius, light->cosine);
        double share = light->cosine > 0 ? light->radius * light->radius : 1;
        return shown ? s->reflects * light->brightness * share : 0;
    }
    vec3 apart = vec3_subtract(light->middle, s->image);
    double square = vec3_dot(apart, apart), share = fmin(light->radius * light->radius / square, 1);
    if (s->side * vec3_dot(n, vec3_subtract(light->middle, s->mirror->plane.point)) + light->radius <= 0)
        return 0;
    double between = vec3_dot(s->towards, apart) / sqrt(square);
    bool shown = share >= 1 || meet(between, s->sine, s->cosine, sqrt(share), sqrt(1 - share));
    return shown ? s->reflects * light->brightness * share : 0;
}

bool scene_mirror_shows_part(const graze_scene *scene, const scene_mirror_sight *s, const scene_mirrored_light *light) {
    const vec3 n = s->mirror->plane.normal;
    vec3 axis = light->middle;
    double sine = light->radius, cosine = light->cosine;
    if (!light->source) {
        axis = vec3_subtract(light->middle, s->image);
        sine = light->radius / vec3_length(axis);
        cosine = sqrt(fmax(1 - sine * sine, 0));
        axis = vec3_scale(1 / vec3_length(axis), axis);
    }
    double rise = s->side * vec3_dot(n, axis), slant = sqrt(fmax(1 - rise * rise, 0));
    double lowest = rise * cosine - slant * sine; /* of the rise of the cone's directions */
    if (!(sine < 1 && cosine > 0 && lowest > 0))
        return true;
    double way = -s->side * vec3_dot(n, vec3_subtract(s->image, s->mirror->plane.point)) / rise;
    /* From there to the farthest point of the ellipse that the cone is in the plane, by the law of sines. */
    double reach = way * sine / lowest * SLACK;
    vec3 at = vec3_add_scaled(s->image, way, axis);
    for (int i = s->mirror->first; i < s->mirror->first + s->mirror->count; i++)
        if (shape_outline_distance(&scene->shapes[scene->mirror_surfaces[i]], at) <= reach)
            return true;
    return false;
}

int scene_mirror_at(const graze_scene *scene, const scene_mirror *m, vec3 point) {
    for (int i = m->first; i < m->first + m->count; i++)
        if (shape_flat_contains(&scene->shapes[scene->mirror_surfaces[i]], point))
            return scene->mirror_surfaces[i];
    return -1;
}
