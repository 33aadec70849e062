/* Rays as they are asked for, and the answers. */
#include <math.h>

#include "geometry/few.h"
#include "geometry/query.h"

/* An origin that is given from outside is as good as its first digits. */
#define GIVEN_ORIGIN 1e-6

/* Embree takes no care of rays that are none; beyond 1e100 our own squares would overflow. */
static bool is_ray(const geometry_ray *ray) {
    double length2 = vec3_dot(ray->direction, ray->direction);
    return length2 > 0 && length2 < 2 && vec3_dot(ray->origin, ray->origin) < 1e50;
}

/* Of surfaces that coincide, such as the two sides of a sheet, the one counts that faces the ray; and of those that do,
 * such as a ceiling and a lamp in its plane, the one that shines. */
static const candidate *visible(const query *q) {
    const candidate *nearest = q->nearest;
    if (!nearest)
        return NULL;
    if (q->nearest_shining && query_coincide(q, nearest, q->nearest_shining))
        return q->nearest_shining;
    bool covered = nearest->slope >= 0 && q->nearest_front && query_coincide(q, nearest, q->nearest_front);
    return covered ? q->nearest_front : nearest;
}

/* All but candidates and misses, which are set before they are read: to clear them would take longer than many a query.
 */
static void prepare(query *q, const geometry *g, const geometry_ray *ray) {
    q->geometry = g;
    q->origin = ray->origin;
    q->direction = ray->direction;
    q->size = vec3_max_abs(ray->origin);
    q->at_once = ray->from < 0 ? double_min(GIVEN_ORIGIN * q->size, GEOMETRY_FTINY) : 0;
    q->farthest_coincidence = query_coincidence(q, g->largest_reach);
    q->far = ray->far;
    q->from = ray->from;
    q->target = -1;
    q->any = q->found_any = q->passes_panes = false;
    q->nearest = q->nearest_front = q->nearest_shining = NULL;
    q->next = q->candidates;
    q->around = NULL;
    q->miss_count = 0;
}

/* False: the ray passes all by. */
static bool trace(query *q) {
    const geometry_tree *tree = &q->geometry->trees[0];
    /* query_clip sets the rest. */
    visit *v = &q->scene;
    v->tree = tree;
    v->transform = NULL;
    v->replacing = NULL;
    v->first = 0;
    v->center = tree->center;
    v->radius = tree->radius;
    v->unit = 1 / tree->scale;
    q->visit = v;
    if (tree->few) {
        tree->few->look(q);
        return true;
    }
    embree_context_init(&q->context);
    if (!query_clip(q, &q->scene))
        return false;
    query_cast(q);
    if (q->miss_count > 0)
        query_look_after_misses(q);
    return true;
}

static inline void describe_hit(const geometry *g, const candidate *found, geometry_hit *hit) {
    const geometry_triangle *triangle = found->triangle;
    const geometry_tree *scene = &g->trees[0];
    if (triangle) {
        /* shape_pull() without another look into memory */
        double height = vec3_dot(triangle->normal, vec3_subtract(hit->point, triangle->center));
        hit->point = vec3_add_scaled(hit->point, -height, triangle->normal);
        hit->normal = triangle->normal;
        return;
    }
    const bool is_copied = found->surface >= (int64_t)scene->shape_count;
    shape placed;
    if (is_copied)
        placed = geometry_placed_shape(g, found->surface);
    const shape *s = is_copied ? &placed : &scene->shapes[found->surface];
    hit->point = shape_pull(s, hit->point);
    hit->normal = shape_normal(s, hit->point);
}

static inline void set_hit(const geometry *g, const geometry_ray *ray, const candidate *found, geometry_hit *hit) {
    hit->surface = found->surface;
    hit->distance = found->distance;
    hit->point = vec3_add_scaled(ray->origin, found->distance, ray->direction);
    describe_hit(g, found, hit);
}

bool geometry_intersect(const geometry *g, const geometry_ray *ray, geometry_hit *hit) {
    hit->surface = -1;
    if (g->empty || !is_ray(ray))
        return false;
    query q;
    prepare(&q, g, ray);
    const candidate *found = trace(&q) ? visible(&q) : NULL;
    if (!found)
        return false;
    set_hit(g, ray, found, hit);
    return true;
}

/* Whether the way is shut, by more than panes where these are let pass; `q` tells of them. */
static bool is_occluded(query *q, const geometry *g, const geometry_ray *ray, int64_t target, bool passes_panes) {
    if (g->empty || !is_ray(ray))
        return false;
    prepare(q, g, ray);
    q->target = target;
    q->any = true;
    q->passes_panes = passes_panes;
    return trace(q) && q->found_any;
}

bool geometry_occluded(const geometry *g, const geometry_ray *ray, int64_t target) {
    query q;
    return is_occluded(&q, g, ray, target, false);
}

bool geometry_occluded_but_for_panes(const geometry *g, const geometry_ray *ray, int64_t target,
                                     geometry_panes *panes) {
    query q;
    q.panes = 0;
    bool occluded = is_occluded(&q, g, ray, target, true);
    if (!panes)
        return occluded;
    panes->count = occluded ? 0 : q.panes;
    if (panes->count == 1)
        set_hit(g, ray, &q.pane, &panes->only);
    return occluded;
}
