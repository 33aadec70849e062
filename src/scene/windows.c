/* Finding windows, and sampling them by solid angle. */
#include "scene/windows.h"

#include <math.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/even_steps.h"
#include "geometry/crossing.h"
#include "geometry/solid_angle.h"
#include "scene/light.h"

/* Of more panes the largest are looked at: every point asks all that are windows how much it sees of them. */
#define MOST_WINDOWS 256

/* From each side of a pane so many rays look for the sky. */
#define LOOKS 64

/* A pane is a window if so much of its outside sees the sky, and no more than this part of that does inside. */
#define LEAST_SKY 0.02
#define DARKER    0.5

/* From the windows so many walks of so many steps go through the rooms, and look about at each: where an opening is
 * seen in less than a thousandth of all directions it may be missed, and is not much. */
enum { WALKS = 256, STEPS = 4, LOOKS_ABOUT = 4 };

typedef struct scene_window {
    shape shape;   /* a polygon, turned inside, */
    int surface;   /* of this surface */
    double radius; /* about its center */
} scene_window;

typedef struct scene_windows {
    int count;
    scene_window of[];
} scene_windows;

static bool may_be_window(const graze_scene *scene, size_t i) {
    const scene_material *m = &scene->materials[scene->surfaces[i].material];
    return scene->shapes[i].kind == SHAPE_POLYGON && m->kind == SCENE_REFLECTOR && m->reflector.kind == GRAZE_GLASS;
}

/* A point of a triangle. */
static vec3 place_in(const shape *s, const uint32_t triangle[3], double u, double v) {
    const vec3 *p = s->polygon.vertices;
    double a = 1 - sqrt(u), b = (1 - a) * v;
    return vec3_add(vec3_add(vec3_scale(a, p[triangle[0]]), vec3_scale(b, p[triangle[1]])),
                    vec3_scale(1 - a - b, p[triangle[2]]));
}

static vec3 place_in_pane(const shape *s, int i) {
    return place_in(s, s->polygon.triangles[i % s->polygon.triangle_count], even_step(i + 0.5, EVEN_STEP_X),
                    even_step(i + 0.5, EVEN_STEP_Y));
}

static bool is_sky_there(const graze_scene *scene, vec3 direction) {
    for (size_t i = scene->first_source; i < scene->first_copied; i++)
        if (scene_light_is_sky(&scene->lights[i]) && light_source_shines_from(scene, (int)i, direction))
            return true;
    return false;
}

/* A direction above a surface, one of many that are spread by their cosines, by two numbers in [0,1). */
static vec3 direction_above(vec3 normal, double height, double turn) {
    frame axes = frame_around(normal);
    double sine = sqrt(height), angle = 2 * PI * turn;
    return frame_to_world(&axes, vec3_make(sine * cos(angle), sine * sin(angle), sqrt(1 - height)));
}

/* How much of the directions from one side of a pane, by their cosines, show the sky. */
static double sky_seen(const graze_scene *scene, int64_t surface, const shape *s, double side) {
    vec3 normal = vec3_scale(side, s->polygon.normal);
    int seen = 0;
    for (int i = 0; i < LOOKS; i++) {
        vec3 direction = direction_above(normal, (i + 0.5) / LOOKS, even_step(i, GOLDEN_SECTION));
        geometry_ray ray = {
            .origin = place_in_pane(s, i), .direction = direction, .far = GEOMETRY_FAR, .from = surface};
        seen += is_sky_there(scene, direction) && !geometry_occluded_but_for_panes(scene->geometry, &ray, -1, NULL);
    }
    return (double)seen / LOOKS;
}

/* Whether a sun shines on the outside of a pane that is turned inside. */
static bool sun_comes_in(const graze_scene *scene, int64_t surface, const shape *s) {
    for (size_t i = scene->first_source; i < scene->first_copied; i++) {
        const scene_light *sun = &scene->lights[i];
        if (scene_light_is_sky(sun) || light_is_ambient(sun) || vec3_dot(sun->center, s->polygon.normal) >= 0)
            continue;
        for (int k = 0; k < LOOKS; k++) {
            geometry_ray ray = {
                .origin = place_in_pane(s, k), .direction = sun->center, .far = GEOMETRY_FAR, .from = surface};
            if (!geometry_occluded_but_for_panes(scene->geometry, &ray, -1, NULL))
                return true;
        }
    }
    return false;
}

/* Adds a pane, if it is a window. False: there is no memory. */
static bool add_pane(graze_scene *scene, scene_windows *windows, int index) {
    shape s = scene->shapes[index];
    double before = sky_seen(scene, index, &s, 1), behind = sky_seen(scene, index, &s, -1);
    if (fmax(before, behind) < LEAST_SKY || fmin(before, behind) > DARKER * fmax(before, behind))
        return true;
    if ((before > behind && !shape_turn_polygon(&s, scene->memory)) || !shape_prepare_light(&s, scene->memory))
        return false;
    scene->sun_comes_in = scene->sun_comes_in || sun_comes_in(scene, index, &s);
    scene_window *w = &windows->of[windows->count++];
    w->shape = s;
    w->surface = index;
    w->radius = 0;
    for (uint32_t i = 0; i < s.polygon.vertex_count; i++)
        w->radius = fmax(w->radius, vec3_length(vec3_subtract(s.polygon.vertices[i], s.polygon.center)));
    return true;
}

/* Whether a ray comes to the sky, and not through a window. */
static bool is_through_opening(const graze_scene *scene, const scene_windows *windows, const geometry_ray *ray) {
    double distance;
    if (!is_sky_there(scene, ray->direction) || geometry_occluded_but_for_panes(scene->geometry, ray, -1, NULL))
        return false;
    for (int i = 0; i < windows->count; i++)
        if (shape_front_crossing(&windows->of[i].shape, ray->origin, ray->direction, &distance))
            return false;
    return true;
}

static bool is_window(const scene_windows *windows, int64_t surface) {
    for (int i = 0; i < windows->count; i++)
        if (windows->of[i].surface == surface)
            return true;
    return false;
}

/* Goes to the next surface that light does not pass. False: there is none, or the ray leaves by a window. */
static bool go_to_next(const graze_scene *scene, const scene_windows *windows, geometry_ray *ray, geometry_hit *hit) {
    while (geometry_intersect(scene->geometry, ray, hit)) {
        ray->origin = hit->point;
        ray->from = hit->surface;
        if (!geometry_passes(scene->geometry, hit->surface))
            return true;
        if (is_window(windows, hit->surface))
            return false;
    }
    return false;
}

/* Whether some of the sky comes in where no windows are: through openings, or panes that are not among them. */
static bool has_openings(const graze_scene *scene, const scene_windows *windows) {
    for (int walk = 0, number = 0; walk < WALKS; walk++) {
        const scene_window *window = &windows->of[walk % windows->count];
        geometry_ray ray = {
            .origin = place_in_pane(&window->shape, walk), .far = GEOMETRY_FAR, .from = window->surface};
        vec3 normal = window->shape.polygon.normal;
        for (int step = 0; step <= STEPS; step++) {
            for (int look = 0; look < (step == 0 ? 1 : LOOKS_ABOUT); look++, number++) {
                ray.direction =
                    direction_above(normal, even_step(number + 0.5, EVEN_STEP_X), even_step(number + 0.5, EVEN_STEP_Y));
                if (is_through_opening(scene, windows, &ray))
                    return true;
            }
            geometry_hit hit;
            if (!go_to_next(scene, windows, &ray, &hit))
                break;
            normal = vec3_dot(hit.normal, ray.direction) < 0 ? hit.normal : vec3_negate(hit.normal);
        }
    }
    return false;
}

typedef struct pane {
    double area;
    int surface;
} pane;

/* The largest first. */
static int by_area(const void *a, const void *b) {
    const pane *x = a, *y = b;
    return x->area != y->area ? (x->area > y->area ? -1 : 1) : x->surface - y->surface;
}

/* The panes of the scene's own, largest first; null without memory. */
static pane *find_panes(const graze_scene *scene, size_t *count) {
    *count = 0;
    for (size_t i = 0; i < scene->surface_count; i++)
        *count += may_be_window(scene, i);
    pane *panes = malloc((*count + 1) * sizeof *panes);
    *count = 0;
    for (size_t i = 0; i < scene->surface_count && panes; i++)
        if (may_be_window(scene, i))
            panes[(*count)++] = (pane){scene->shapes[i].polygon.area, (int)i};
    if (panes)
        qsort(panes, *count, sizeof *panes, by_area);
    return panes;
}

graze_status scene_windows_find(graze_scene *scene, const graze_report *report) {
    size_t count;
    if (!scene->has_sky || !scene->has_panes)
        return GRAZE_OK;
    pane *panes = find_panes(scene, &count);
    count = count < MOST_WINDOWS ? count : MOST_WINDOWS;
    scene_windows *windows = arena_allocate(scene->memory, sizeof *windows + count * sizeof *windows->of);
    bool ok = panes && windows;
    if (ok)
        windows->count = 0;
    for (size_t i = 0; ok && i < count; i++)
        ok = add_pane(scene, windows, panes[i].surface);
    free(panes);
    if (ok && windows->count > 0) {
        scene->windows = windows;
        scene->sky_beside_windows = windows->count > WINDOWS_SEEN_MOST || has_openings(scene, windows);
    }
    return ok ? GRAZE_OK : report_out_of_memory(report);
}

/* About how much light comes in from a window; 0: it is not seen from inside, above the horizon. */
static double weight_of(const scene_window *w, vec3 point, vec3 normal) {
    vec3 towards = vec3_subtract(w->shape.polygon.center, point);
    double before = -vec3_dot(w->shape.polygon.normal, towards), height = vec3_dot(normal, towards);
    double square = vec3_dot(towards, towards), radius2 = w->radius * w->radius;
    if (before <= 0 || height <= -w->radius)
        return 0;
    double cosine = fmax((height + 0.5 * w->radius) / sqrt(square + radius2), 0.05);
    return w->shape.polygon.area * cosine * (before + 0.1 * w->radius) / ((square + radius2) * sqrt(square + radius2));
}

/* Keeps what has most weight: where there is no room, in place of the least. */
static void insert(window_choice *c, int index, double weight) {
    int at = c->count;
    if (c->count == WINDOWS_SEEN_MOST) {
        at = 0;
        for (int i = 1; i < c->count; i++)
            at = c->share[i] < c->share[at] ? i : at;
        if (c->share[at] >= weight)
            return;
    } else {
        c->count++;
    }
    c->share[at] = weight;
    c->index[at] = index;
}

void window_choice_prepare(window_choice *c, const graze_scene *scene, vec3 point, vec3 normal, int draws) {
    const scene_windows *windows = scene->windows;
    double sum = 0;
    c->windows = windows;
    c->point = point;
    c->count = 0;
    for (int i = 0; i < windows->count; i++) {
        double weight = weight_of(&windows->of[i], point, normal);
        if (weight > 0)
            insert(c, i, weight);
    }
    for (int i = 0; i < c->count; i++)
        sum += c->share[i];
    for (int i = 0; i < c->count; i++) {
        c->share[i] /= sum;
        c->expectation[i] = c->count <= draws ? 1 : draws * c->share[i];
    }
}

int window_choose(const window_choice *c, double random) {
    int i = 0;
    while (i + 1 < c->count && random >= c->share[i])
        random -= c->share[i++];
    return i;
}

bool window_draw(const window_choice *c, int which, const double random[2], vec3 *direction) {
    const solid_angle_sample s =
        solid_angle_draw(&c->windows->of[c->index[which]].shape, c->point, random[0], random[1]);
    *direction = s.direction;
    return s.density > 0;
}

double window_density(const window_choice *c, vec3 direction) {
    double sum = 0, distance;
    for (int i = 0; i < c->count; i++) {
        const shape *s = &c->windows->of[c->index[i]].shape;
        if (shape_front_crossing(s, c->point, direction, &distance))
            sum += c->expectation[i] * solid_angle_density(s, c->point, direction,
                                                           vec3_add_scaled(c->point, distance, direction),
                                                           s->polygon.normal);
    }
    return sum;
}
