/* Reading mists, and walking through them.
 *
 * A ray is inside of a mist where it leaves it ahead more often than it enters it: so nothing need be known of how it
 * came there. */
#include "scene/mist.h"

#include <stdlib.h>
#include <string.h>

graze_status scene_mist_read(mist_material *m, const rad_primitive *p, const graze_report *report) {
    const double *a = p->reals;
    if (p->real_count != 0 && p->real_count != 3 && p->real_count != 6 && p->real_count != 7)
        return rad_primitive_error(report, p, "needs 0, 3, 6 or 7 real arguments, not %u", (unsigned)p->real_count);
    for (uint32_t i = 0; i < p->real_count && i < 6; i++)
        if (!(a[i] >= 0 && a[i] <= (i < 3 ? 1e100 : 1)))
            return rad_primitive_error(report, p, "real argument %u is not in its range: 0 .. 1e100, albedos 0 .. 1",
                                       (unsigned)i + 1);
    if (p->real_count > 6 && !(a[6] > -1 && a[6] < 1))
        return rad_primitive_error(report, p, "the eccentricity must be between -1 and 1");
    *m = (mist_material){.has_albedo = p->real_count > 5, .has_eccentricity = p->real_count > 6};
    if (p->real_count > 2)
        m->extinction = (rgb){a[0], a[1], a[2]};
    if (m->has_albedo)
        m->albedo = (rgb){a[3], a[4], a[5]};
    if (m->has_eccentricity)
        m->eccentricity = a[6];
    return GRAZE_OK;
}

/* The last light of that name, or -1. */
static int find_light(const graze_scene *scene, const char *name) {
    for (size_t i = scene->light_count; i-- > 0;)
        if (!scene->lights[i].only_seen && !strcmp(scene_name(scene, scene->lights[i].primitive), name))
            return (int)i;
    return -1;
}

static graze_status find_lights(graze_scene *scene, mist_material *m, const rad_primitive *p,
                                const graze_report *report) {
    m->lights = calloc(p->string_count + 1, sizeof *m->lights);
    if (!m->lights)
        return report_out_of_memory(report);
    for (uint32_t i = 0; i < p->string_count; i++) {
        int light = find_light(scene, p->strings[i]);
        bool known = false;
        for (int k = 0; k < m->light_count; k++)
            known = known || m->lights[k] == light;
        if (light < 0 && strchr(p->strings[i], '>'))
            rad_primitive_warning(report, p, "what a mirror or a prism throws, as '%.64s', is not scattered",
                                  p->strings[i]);
        else if (light < 0)
            rad_primitive_warning(report, p, "there is no light '%.64s', which it could scatter", p->strings[i]);
        else if (known)
            rad_primitive_warning(report, p, "light '%.64s' is listed twice", p->strings[i]);
        else
            m->lights[m->light_count++] = light;
    }
    return GRAZE_OK;
}

graze_status scene_mist_make(graze_scene *scene, int threads, const graze_report *report) {
    scene_mist *mist = scene->mist;
    graze_status status = GRAZE_OK;
    for (size_t i = 0; mist && i < scene->material_count && status == GRAZE_OK; i++) {
        if (scene->materials[i].mist < 0)
            continue;
        mist_material *m = &mist->of[scene->materials[i].mist];
        status = find_lights(scene, m, &scene->primitives[scene->materials[i].primitive], report);
        if (status == GRAZE_OK)
            status = scene_bounds_build(&m->bounds, scene, (int)i, m->own, m->own_count, threads, report);
    }
    return status;
}

void scene_mist_destroy(scene_mist *mist) {
    if (!mist)
        return;
    for (int i = 0; i < mist->count; i++) {
        scene_bounds_destroy(&mist->of[i].bounds);
        free(mist->of[i].own);
        free(mist->of[i].lights);
    }
    free(mist);
}

/* Steps to where the ray next meets a boundary: the distance from there, or INFINITY. */
static double step(const geometry *g, geometry_ray *ray, int *change) {
    geometry_hit hit;
    if (!geometry_intersect(g, ray, &hit))
        return INFINITY;
    ray->origin = hit.point;
    ray->from = hit.surface;
    *change = vec3_dot(hit.normal, ray->direction) > 0 ? -1 : 1;
    return hit.distance;
}

void mist_walk_begin(mist_walk *w, const graze_scene *scene, const mist_medium *everywhere, vec3 origin, vec3 direction,
                     double distance) {
    w->mist = scene->mist;
    w->everywhere = *everywhere;
    w->direction = direction;
    w->at = 0;
    w->distance = distance;
    for (int i = 0; w->mist && i < w->mist->count; i++) {
        const geometry *g = w->mist->of[i].bounds.geometry;
        const geometry_ray start = {.origin = origin, .direction = direction, .far = GEOMETRY_FAR, .from = -1};
        geometry_ray ahead = start;
        int change;
        w->of[i].ray = start;
        w->of[i].balance = 0;
        while (step(g, &ahead, &change) < INFINITY)
            w->of[i].balance -= change;
        w->of[i].next = step(g, &w->of[i].ray, &w->of[i].change);
    }
}

/* Where mists overlap, the last one that says so has the albedo and the eccentricity. */
static void find_medium(const mist_walk *w, mist_span *span) {
    span->medium = w->everywhere;
    span->mists = 0;
    for (int i = 0; w->mist && i < w->mist->count; i++) {
        const mist_material *m = &w->mist->of[i];
        if (w->of[i].balance <= 0)
            continue;
        span->mists |= UINT32_C(1) << i;
        span->medium.extinction = rgb_add(span->medium.extinction, m->extinction);
        if (m->has_albedo)
            span->medium.albedo = m->albedo;
        if (m->has_eccentricity)
            span->medium.eccentricity = m->eccentricity;
    }
}

/* Takes the boundary that the ray meets next, if it is before the end of its way, and tells whether the mist begins or
 * ends there: where bodies of one mist overlap, it does not. */
static bool cross_boundary(mist_walk *w, double *at, bool *changes) {
    int first = -1;
    *at = w->distance;
    for (int i = 0; w->mist && i < w->mist->count; i++)
        if (w->of[i].next < *at) {
            *at = w->of[i].next;
            first = i;
        }
    if (first < 0)
        return false;
    bool before = w->of[first].balance > 0;
    w->of[first].balance += w->of[first].change;
    w->of[first].next += step(w->mist->of[first].bounds.geometry, &w->of[first].ray, &w->of[first].change);
    *changes = before != (w->of[first].balance > 0);
    return true;
}

bool mist_walk_next(mist_walk *w, mist_span *span) {
    if (!(w->at < w->distance))
        return false;
    find_medium(w, span);
    span->start = w->at;
    bool changes = false;
    while (!changes && cross_boundary(w, &span->end, &changes)) {
    }
    w->at = span->end;
    return true;
}
