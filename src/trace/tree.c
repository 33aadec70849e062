/* The rays that an answer consists of: each after those that follow from it. */
#include <stdlib.h>

#include "base/report.h"
#include "trace/describe.h"
#include "trace/observer.h"

/* What is told of one path, in the order in which its rays were cast. A path is a chain of reflected rays, with shadow
 * rays beside it: read from its end, every ray comes after all that follow from it. */
typedef struct recording {
    path_event *events;
    size_t count, capacity;
    bool failed; /* out of memory */
} recording;

static void record(void *user, const path_event *event) {
    recording *r = user;
    if (r->count == r->capacity) {
        size_t capacity = r->capacity ? 2 * r->capacity : 64;
        path_event *events = realloc(r->events, capacity * sizeof *events);
        if (!events) {
            r->failed = true;
            return;
        }
        r->events = events;
        r->capacity = capacity;
    }
    r->events[r->count++] = *event;
}

/* A tree while it is told from the ends of its paths. */
typedef struct telling {
    const graze_scene *scene;
    void (*visit)(void *user, const graze_tree_ray *);
    void *user;
    double share;   /* of a path in the answer */
    rgb mirrored;   /* contribution of the mirrored ray that was told last and belongs to the next one; else 0 */
    double further; /* its length; GRAZE_FAR where there is none, or it meets nothing */
} telling;

static double mirrored_distance(double distance, double further) {
    return distance < GRAZE_FAR && further < GRAZE_FAR ? distance + further : GRAZE_FAR;
}

static void tell_ray(telling *t, const path_event *event, rgb contribution) {
    graze_tree_ray ray = {.depth = event->depth,
                          .shadow = event->kind == PATH_SHADOW,
                          .origin = event->origin,
                          .direction = event->hit.direction,
                          .hit = describe_hit(t->scene, &event->hit, GRAZE_RADIANCE),
                          .coefficient = rgb_scale(t->share, event->coefficient),
                          .contribution = rgb_scale(t->share, contribution),
                          .mirrored_distance = GRAZE_FAR};
    ray.radiance = event->hit.light >= 0 ? event->radiance : rgb_share(contribution, event->coefficient);
    if (event->kind == PATH_RAY) {
        ray.mirrored = rgb_share(t->mirrored, event->coefficient);
        ray.mirrored_distance = mirrored_distance(event->hit.distance, t->further);
        t->mirrored = event->mirrored ? contribution : rgb_gray(0);
        t->further = event->mirrored ? event->hit.distance : GRAZE_FAR;
    }
    t->visit(t->user, &ray);
}

/* Tells the rays of a path but the first. */
static void tell_path(telling *t, const recording *r) {
    rgb contribution = {0, 0, 0};
    t->mirrored = rgb_gray(0);
    t->further = GRAZE_FAR;
    for (size_t i = r->count; i-- > 0;) {
        const path_event *event = &r->events[i];
        contribution = rgb_add(contribution, event->contribution);
        if (event->kind != PATH_SURFACE)
            tell_ray(t, event, event->kind == PATH_SHADOW ? event->contribution : contribution);
    }
}

/* Takes the paths and tells all but the ray that they share, whose radiance and mirror are summed up. */
static graze_status tell_paths(telling *t, path_context context, const path_hit *first, graze_tree_ray *root,
                               uint64_t stream, uint32_t paths, const graze_report *report) {
    recording r = {0};
    const path_observer observer = {record, &r};
    bool sensor = context.settings->quantity == GRAZE_IRRADIANCE;
    uint64_t key = sampler_key(context.settings->seed, stream, 0);
    context.observer = &observer;
    for (uint32_t i = 0; i < paths && !r.failed; i++) {
        sampler points = sampler_start(key, i);
        r.count = 0;
        path_sample sample;
        if (sensor)
            path_irradiance(&context, root->origin, root->direction, &points, &sample);
        else
            path_radiance(&context, first, &points, &sample);
        tell_path(t, &r);
        root->radiance = rgb_add_scaled(root->radiance, t->share, sample.radiance);
        root->mirrored = rgb_add_scaled(root->mirrored, t->share, t->mirrored);
        if (t->further < GRAZE_FAR)
            root->mirrored_distance = mirrored_distance(root->hit.distance, t->further);
    }
    free(r.events);
    return r.failed ? report_out_of_memory(report) : GRAZE_OK;
}

graze_status graze_trace_tree(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray,
                              uint64_t stream, uint32_t paths, void (*visit)(void *user, const graze_tree_ray *),
                              void *user, const graze_report *report) {
    graze_trace_settings whole = *settings;
    whole.part = GRAZE_WHOLE;
    const path_context context = {.scene = scene, .settings = &whole};
    graze_tree_ray root = {.origin = ray->origin,
                           .hit = describe_nothing(ray->origin),
                           .coefficient = {1, 1, 1},
                           .mirrored_distance = GRAZE_FAR};
    telling t = {.scene = scene, .visit = visit, .user = user, .share = 1.0 / paths};
    double limit;
    graze_status status = GRAZE_OK;
    if (describe_ray(ray, &root.direction, &limit)) {
        path_hit first = {.surface = -1, .light = -1, .distance = GEOMETRY_FAR, .point = ray->origin};
        if (whole.quantity != GRAZE_IRRADIANCE) {
            first = path_cast(&context, ray->origin, root.direction, limit, -1);
            root.hit = describe_hit(scene, &first, settings->quantity);
        }
        status = tell_paths(&t, context, &first, &root, stream, paths, report);
    }
    root.contribution = root.radiance;
    if (status == GRAZE_OK)
        visit(user, &root);
    return status;
}
