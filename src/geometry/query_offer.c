/* Which crossings of a ray count: what is at its origin or behind its end does not, and of surfaces that coincide one.
 */
#include <math.h>

#include "geometry/query.h"

/* The sine of the angle up to which they may be turned against each other: where they are as close as double precision
 * tells, small ones that are far from the origin may be, by more. */
#define PARALLEL         1e-6
#define PARALLEL_TOUCHES 1e-4

/* A surface's largest coordinate. */
static double reach(const query *q, int64_t surface) {
    const geometry_tree *scene = &q->geometry->trees[0];
    if (surface < (int64_t)scene->shape_count)
        return scene->reach[surface];
    return geometry_placed_reach(q->geometry, surface);
}

/* The larger of two surfaces' coordinates. */
static double reach_of(const query *q, int64_t a, int64_t b) {
    return double_max(reach(q, a), reach(q, b));
}

/* The normal of a surface at one of its points. */
static vec3 normal_at(const query *q, int64_t surface, vec3 point) {
    const geometry_tree *scene = &q->geometry->trees[0];
    if (surface < (int64_t)scene->shape_count)
        return shape_normal(&scene->shapes[surface], point);
    shape placed = geometry_placed_shape(q->geometry, surface);
    return shape_normal(&placed, point);
}

/* Whether surfaces that are so far apart, with these coordinates and normals, are meant to coincide. */
static bool coincide(const query *q, double apart, double coordinates, vec3 normal, vec3 other) {
    if (apart > query_coincidence(q, coordinates))
        return false;
    bool touches = apart <= GEOMETRY_DESCRIBED * coordinates + GEOMETRY_ON_SURFACE * q->size;
    return vec3_length(vec3_cross(normal, other)) <= (touches ? PARALLEL_TOUCHES : PARALLEL);
}

bool query_coincide(const query *q, const candidate *a, const candidate *b) {
    double apart = fabs((a->distance - b->distance) * a->slope);
    if (apart > q->farthest_coincidence)
        return false;
    return coincide(q, apart, reach_of(q, a->surface, b->surface), a->normal, b->normal);
}

/* Than one that may be null. */
static bool is_before(const candidate *a, const candidate *b) {
    return !b || a->distance < b->distance || (a->distance == b->distance && a->surface > b->surface);
}

/* Of shining surfaces that coincide the last one is hit, whichever of them roundings make the nearest: so that
 * blocks() can tell. */
static bool outshines(const query *q, const candidate *a, const candidate *b) {
    if (!b)
        return true;
    return query_coincide(q, a, b) ? a->surface > b->surface : a->distance < b->distance;
}

/* Whether a crossing close to the end of a shadow ray coincides with the target there. */
static bool is_at_target(const query *q, const candidate *c) {
    double apart = fabs((q->far - c->distance) * c->slope);
    if (q->target < 0)
        return apart <= query_coincidence(q, reach(q, c->surface));
    vec3 end = vec3_add_scaled(q->origin, q->far, q->direction);
    return coincide(q, apart, reach_of(q, c->surface, q->target), c->normal, normal_at(q, q->target, end));
}

/* Whether a crossing keeps the ray from its end. What coincides with the target does not, unless it is what
 * geometry_intersect would find there. */
static bool blocks(const query *q, const candidate *c) {
    double ahead = q->far - c->distance;
    if (fabs(ahead * c->slope) > q->farthest_coincidence || !is_at_target(q, c))
        return ahead >= 0;
    if (q->target < 0 || !c->shines || c->slope >= 0)
        return false;
    return !geometry_shines(q->geometry, q->target) || c->surface > q->target;
}

/* What is curved is met twice, and what is in a copy no candidate tells all of: either counts as many. */
static void count_pane(query *q, const candidate *c) {
    if (!c->triangle || (q->panes > 0 && c->surface != q->pane.surface)) {
        q->panes = 2;
    } else if (q->panes == 0) {
        q->panes = 1;
        q->pane = *c;
    }
}

static void block(query *q, const candidate *c) {
    if (q->passes_panes && geometry_passes(q->geometry, c->surface))
        count_pane(q, c);
    else
        q->found_any = true;
}

/* Whether a crossing is at the ray's origin: of a surface that the origin lies on, or one that coincides with the
 * surface that the ray leaves. Others that meet that one at an angle are hit however close they are. */
static bool is_at_origin(const query *q, const candidate *c) {
    if (c->distance <= q->at_once)
        return true;
    double height = fabs(c->distance * c->slope);
    /* Twice as far as from the surface left, which itself may be the other one of two that coincide. */
    if (height > 2 * q->farthest_coincidence)
        return false;
    if (height <= GEOMETRY_ON_SURFACE * (q->size + reach(q, c->surface)))
        return true;
    if (q->from < 0)
        return false;
    return coincide(q, height / 2, reach_of(q, c->surface, q->from), c->normal, normal_at(q, q->from, q->origin));
}

bool query_in_reach(const query *q, const candidate *c) {
    return c->distance > 0 && (c->distance <= q->far || q->any) && !is_at_origin(q, c);
}

/* Where the next candidate goes: to a place that is not one of the three best's. */
static candidate *free_place(query *q) {
    candidate *c = q->candidates;
    while (c == q->nearest || c == q->nearest_front || c == q->nearest_shining)
        c++;
    return c;
}

/* Keeps the crossing if it is one of the best. */
static bool keep(query *q, const candidate *c) {
    bool front = c->slope < 0, first = is_before(c, q->nearest);
    if (front && is_before(c, q->nearest_front))
        q->nearest_front = c;
    if (front && c->shines && outshines(q, c, q->nearest_shining))
        q->nearest_shining = c;
    if (first)
        q->nearest = c;
    q->next = free_place(q);
    return first;
}

bool query_offer(query *q) {
    const candidate *c = q->next;
    if (!q->any)
        return keep(q, c);
    if (!q->found_any && blocks(q, c))
        block(q, c);
    return q->found_any;
}
