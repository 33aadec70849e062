/* The convex hull of a patch and a light, after E. Haines and J. Wallace, "Shaft culling for efficient ray-cast
 * radiosity", 1991: between planes that touch both. */
#include "geometry/patch_sight.h"

#include "base/angle.h"
#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* Boxes and surfaces that are looked at before an answer is given up, and once something is in the way, in the hope of
 * a surface that hides all. */
#define TESTS       160
#define TESTS_MIXED 16

enum { PATCH_CORNERS = 4, MOST_PLANES = 32 };

/* Below this sine between an edge and what it is joined with, their plane is not known well enough. */
#define LEAST_SINE 1e-6
/* What is so far on the wrong side of a plane, of unit vectors, is its own rounding. */
#define ROUNDING 1e-14

/* Its normal is a unit vector, on the hull's side. */
typedef struct plane {
    vec3 normal, point;
    bool front; /* the light's own */
} plane;

typedef struct hull {
    const geometry *geometry;
    const geometry_patch *patch;
    /* The light's outline, or that of what surrounds it; of a source, directions. */
    vec3 light[SHAFT_LIGHT_CORNERS];
    int light_count;
    bool far;
    double ball_radius; /* of a sphere, and: */
    vec3 ball_center;
    double near; /* surfaces this close may coincide, by geometry.h */
    double size; /* the largest coordinate of patch and light */
    plane planes[MOST_PLANES];
    int plane_count;
    vec3 lower, upper;
} hull;

/* By how much the light's corner is above a plane; of directions, by the sine of the angle. */
static double height_of_light(const hull *h, int corner, vec3 normal, vec3 point) {
    return vec3_dot(normal, h->far ? h->light[corner] : vec3_subtract(h->light[corner], point));
}

static shaft_span span_of_light(const hull *h, vec3 normal, vec3 point) {
    shaft_span span = {INFINITY, -INFINITY};
    if (h->ball_radius > 0) {
        double middle = vec3_dot(normal, vec3_subtract(h->ball_center, point));
        return (shaft_span){middle - h->ball_radius, middle + h->ball_radius};
    }
    for (int i = 0; i < h->light_count; i++) {
        double height = height_of_light(h, i, normal, point);
        span.low = double_min(span.low, height);
        span.high = double_max(span.high, height);
    }
    return span;
}

static shaft_span span_of_patch(const geometry_patch *patch, vec3 normal, vec3 point) {
    shaft_span span = {INFINITY, -INFINITY};
    for (int i = 0; i < PATCH_CORNERS; i++) {
        double height = vec3_dot(normal, vec3_subtract(patch->corners[i], point));
        span.low = double_min(span.low, height);
        span.high = double_max(span.high, height);
    }
    return span;
}

static void add_plane(hull *h, vec3 normal, vec3 point) {
    if (h->plane_count < MOST_PLANES)
        h->planes[h->plane_count++] = (plane){normal, point, false};
}

/* The plane through a point, along two vectors, if all of the hull is on one side. */
static void try_plane(hull *h, vec3 point, vec3 first, vec3 second) {
    vec3 normal = vec3_cross(first, second);
    double length = vec3_length(normal);
    if (!(length > LEAST_SINE * vec3_length(first) * vec3_length(second)))
        return;
    normal = vec3_scale(1 / length, normal);
    double rounding = ROUNDING * h->size;
    shaft_span patch = span_of_patch(h->patch, normal, point), light = span_of_light(h, normal, point);
    double least = h->far ? ROUNDING : rounding;
    if (patch.low >= -rounding && light.low >= -least)
        add_plane(h, normal, point);
    else if (patch.high <= rounding && light.high <= least)
        add_plane(h, vec3_negate(normal), point);
}

/* Planes that hold an edge of one and a corner of the other. */
static void add_sides(hull *h) {
    const vec3 *corners = h->patch->corners;
    for (int i = 0; i < PATCH_CORNERS; i++) {
        vec3 edge = vec3_subtract(corners[(i + 1) % PATCH_CORNERS], corners[i]);
        for (int k = 0; k < h->light_count; k++)
            try_plane(h, corners[i], edge, h->far ? h->light[k] : vec3_subtract(h->light[k], corners[i]));
    }
    for (int k = 0; k < h->light_count; k++) {
        vec3 a = h->light[k], b = h->light[(k + 1) % h->light_count];
        for (int i = 0; i < PATCH_CORNERS; i++)
            if (h->far)
                try_plane(h, corners[i], a, b);
            else
                try_plane(h, a, vec3_subtract(b, a), vec3_subtract(corners[i], a));
    }
}

static double lower_bound(const hull *h, double patch, double light) {
    return !h->far ? double_min(patch, light) : light < 0 ? -INFINITY : patch;
}

static double upper_bound(const hull *h, double patch, double light) {
    return !h->far ? double_max(patch, light) : light > 0 ? INFINITY : patch;
}

/* With what may coincide with the light. */
static void find_bounds(hull *h) {
    h->lower = vec3_make(INFINITY, INFINITY, INFINITY);
    h->upper = vec3_negate(h->lower);
    for (int i = 0; i < PATCH_CORNERS; i++) {
        vec3 p = h->patch->corners[i];
        for (int k = 0; k < h->light_count; k++) {
            vec3 l = h->light[k];
            h->lower.x = double_min(h->lower.x, lower_bound(h, p.x, l.x));
            h->lower.y = double_min(h->lower.y, lower_bound(h, p.y, l.y));
            h->lower.z = double_min(h->lower.z, lower_bound(h, p.z, l.z));
            h->upper.x = double_max(h->upper.x, upper_bound(h, p.x, l.x));
            h->upper.y = double_max(h->upper.y, upper_bound(h, p.y, l.y));
            h->upper.z = double_max(h->upper.z, upper_bound(h, p.z, l.z));
        }
    }
    vec3 slack = vec3_make(2 * h->near, 2 * h->near, 2 * h->near);
    h->lower = vec3_subtract(h->lower, slack);
    h->upper = vec3_add(h->upper, slack);
}

static void surround_disk(hull *h, vec3 center, vec3 axis, double radius) {
    shaft_surround_disk(h->light, center, axis, radius);
    h->light_count = SHAFT_ROUND_CORNERS;
}

/* The light's own plane bounds the hull: false where the patch is not wholly before it. */
static bool add_front(hull *h, vec3 normal, vec3 center) {
    if (!(span_of_patch(h->patch, normal, center).low > 4 * h->near))
        return false;
    h->planes[h->plane_count++] = (plane){normal, center, true};
    return true;
}

static bool take_polygon(hull *h, const shape *light) {
    vec3 normal = light->polygon.normal, center = light->polygon.center;
    if (light->polygon.vertex_count > SHAFT_LIGHT_CORNERS)
        return false;
    h->light_count = (int)light->polygon.vertex_count;
    for (int i = 0; i < h->light_count; i++)
        h->light[i] = light->polygon.vertices[i];
    shaft_span uneven = span_of_light(h, normal, center);
    return uneven.high - uneven.low <= h->near && add_front(h, normal, center);
}

/* A prism around the sphere. */
static bool take_sphere(hull *h, const shape *light) {
    if (light->inward)
        return false;
    vec3 middle = vec3_scale(0.5, vec3_add(h->patch->corners[0], h->patch->corners[2]));
    vec3 center = light->sphere.center, axis = vec3_safe_normalize(vec3_subtract(middle, center));
    double radius = light->sphere.radius;
    if (!(span_of_patch(h->patch, axis, center).low > radius + 4 * h->near))
        return false;
    surround_disk(h, vec3_add_scaled(center, -radius, axis), axis, radius);
    for (int i = 0; i < SHAFT_ROUND_CORNERS; i++)
        h->light[SHAFT_ROUND_CORNERS + i] = vec3_add_scaled(h->light[i], 2 * radius, axis);
    h->light_count = 2 * SHAFT_ROUND_CORNERS;
    h->ball_center = center;
    h->ball_radius = radius;
    return true;
}

static bool take_source(hull *h) {
    double angle = h->patch->half_angle;
    if (!(angle < 0.4 * PI))
        return false;
    surround_disk(h, h->patch->axis, h->patch->axis, tan(angle));
    for (int i = 0; i < h->light_count; i++)
        h->light[i] = vec3_safe_normalize(h->light[i]);
    h->far = true;
    return true;
}

static bool take_light(hull *h) {
    if (h->patch->light < 0)
        return take_source(h);
    const shape *light = &h->geometry->trees[0].shapes[h->patch->light];
    switch (light->kind) {
    case SHAPE_POLYGON:
        return take_polygon(h, light);
    case SHAPE_SPHERE:
        return take_sphere(h, light);
    case SHAPE_RING:
        surround_disk(h, light->ring.center, light->ring.normal, light->ring.r1);
        return add_front(h, light->ring.normal, light->ring.center);
    case SHAPE_CONE:
        break;
    }
    return false;
}

/* What is below the patch's plane does not matter, if the light is above it. */
static void add_ground(hull *h) {
    vec3 normal = h->geometry->trees[0].shapes[h->patch->surface].polygon.normal, point = h->patch->corners[0];
    shaft_span light = span_of_light(h, normal, point);
    if (light.low >= 0)
        add_plane(h, normal, point);
    else if (light.high <= 0)
        add_plane(h, vec3_negate(normal), point);
}

/* False: nothing can be told. */
static bool make_hull(hull *h, const geometry *g, const geometry_patch *patch) {
    h->geometry = g;
    h->patch = patch;
    h->far = false;
    h->ball_radius = 0;
    h->plane_count = h->light_count = 0;
    h->size = patch->light < 0 ? 0 : g->trees[0].reach[patch->light];
    for (int i = 0; i < PATCH_CORNERS; i++)
        h->size = double_max(h->size, vec3_max_abs(patch->corners[i]));
    h->near = geometry_coincidence(g->largest_reach, h->size);
    if (!take_light(h))
        return false;
    add_ground(h);
    add_sides(h);
    find_bounds(h);
    return true;
}

static shaft_place find_box(const hull *h, const shaft_node *n) {
    if (shaft_box_is_beside(n, h->lower, h->upper))
        return SHAFT_OUTSIDE;
    shaft_place where = SHAFT_INSIDE;
    for (int i = 0; i < h->plane_count; i++) {
        const plane *p = &h->planes[i];
        shaft_box b = shaft_box_from(n, p->point);
        shaft_span over = shaft_box_span(&b, p->normal);
        if (over.high < (p->front ? -2 * h->near : 0))
            return SHAFT_OUTSIDE;
        if (over.low <= 0)
            where = SHAFT_ACROSS;
    }
    return where;
}

/* Patch and light are on the same side of a flat body's plane. */
static bool plane_is_beside(const hull *h, const shape_plane *body, double tolerance, bool rival) {
    shaft_span patch = span_of_patch(h->patch, body->normal, body->point),
               light = span_of_light(h, body->normal, body->point);
    double margin = h->far ? 0 : rival ? 2 * h->near : -tolerance;
    return (patch.low >= -tolerance && light.low >= margin) || (patch.high <= tolerance && light.high <= -margin);
}

/* How far a polygon's corners are from its plane. */
static double unevenness(const shape *polygon) {
    double uneven = 0;
    for (uint32_t i = 0; i < polygon->polygon.vertex_count; i++) {
        vec3 from_center = vec3_subtract(polygon->polygon.vertices[i], polygon->polygon.center);
        uneven = double_max(uneven, fabs(vec3_dot(polygon->polygon.normal, from_center)));
    }
    return uneven;
}

/* On the inner side of an edge stand the patch's rays to the light, if from all its corners all of that does. */
static bool edge_is_outside(const hull *h, vec3 a, vec3 b) {
    double margin = 4 * h->near;
    for (int i = 0; i < PATCH_CORNERS; i++) {
        vec3 corner = h->patch->corners[i];
        vec3 inward = vec3_cross(vec3_subtract(a, corner), vec3_subtract(b, corner));
        double length = vec3_length(inward);
        if (!(length > 0) || span_of_light(h, vec3_scale(1 / length, inward), corner).low <= (h->far ? 1e-9 : margin))
            return false;
    }
    return true;
}

/* The light is beyond the polygon from everywhere on the patch. A ray between two points of convex bodies crosses the
 * plane within the hull of where those between their corners do. */
static bool polygon_closes(const hull *h, const shape *body) {
    vec3 normal = body->polygon.normal, center = body->polygon.center;
    shaft_span patch = span_of_patch(h->patch, normal, center), light = span_of_light(h, normal, center);
    double margin = 4 * h->near, beyond = h->far ? 1e-9 : margin;
    bool front = patch.low > margin && light.high < -beyond, back = patch.high < -margin && light.low > beyond;
    if (!(front || back) || body->polygon.vertex_count > 4)
        return false;
    const vec3 *corners = body->polygon.vertices;
    for (uint32_t i = 0, before = body->polygon.vertex_count - 1; i < body->polygon.vertex_count; before = i++)
        if (!edge_is_outside(h, corners[front ? i : before], corners[front ? before : i]))
            return false;
    return true;
}

static geometry_visibility meet_shape(const hull *h, int surface) {
    const geometry_tree *scene = &h->geometry->trees[0];
    const shape *body = &scene->shapes[surface];
    if (surface == h->patch->surface || surface == h->patch->light)
        return GEOMETRY_CLEAR;
    double tolerance = shaft_tolerance(h->size, scene->reach[surface]), slack = tolerance;
    double uneven = body->kind == SHAPE_POLYGON ? unevenness(body) : 0;
    bool even = uneven <= tolerance, flat = even && shape_is_flat(body);
    const shape_plane own = flat ? shape_plane_of(body) : (shape_plane){.normal = {0, 0, 0}};
    if (!even)
        slack = -shaft_slack(h->geometry, uneven);
    /* Its front is hit in place of an earlier light's where they coincide. */
    bool rival = body->shines && surface > h->patch->light &&
                 !(flat && span_of_patch(h->patch, own.normal, own.point).high <= 0);
    if (flat && plane_is_beside(h, &own, tolerance, rival))
        return GEOMETRY_CLEAR;
    for (int i = 0; i < h->plane_count; i++) {
        const plane *p = &h->planes[i];
        if (shaft_reach_of(body, p->point, p->normal) <= (p->front && rival ? -2 * h->near : slack))
            return GEOMETRY_CLEAR;
    }
    bool closes = body->kind == SHAPE_POLYGON && even && !body->passes && polygon_closes(h, body);
    return closes ? GEOMETRY_BLOCKED : GEOMETRY_MIXED;
}

/* The first of a leaf's shapes that is in the way tells for all: where there are several, they are small. */
static geometry_visibility meet_leaf(const hull *h, const shaft_tree *tree, const shaft_node *leaf) {
    if (tree == &h->geometry->copied_sights)
        return GEOMETRY_MIXED;
    geometry_visibility found = GEOMETRY_CLEAR;
    for (uint32_t i = 0; i < leaf->count && found == GEOMETRY_CLEAR; i++)
        found = meet_shape(h, tree->order[leaf->first + i]);
    return found;
}

static geometry_visibility look_through(const hull *h, const shaft_tree *tree) {
    uint32_t stack[SHAFT_TREE_DEPTH + 1] = {0};
    int height = tree->nodes ? 1 : 0, budget = TESTS;
    bool mixed = false;
    while (height > 0) {
        const shaft_node *n = &tree->nodes[stack[--height]];
        if (--budget < 0)
            return GEOMETRY_MIXED;
        shaft_place where = find_box(h, n);
        if (where == SHAFT_OUTSIDE || (mixed && n->count > 1))
            continue;
        geometry_visibility found = GEOMETRY_CLEAR;
        if (n->count > 0) {
            found = meet_leaf(h, tree, n);
        } else if (where == SHAFT_INSIDE) {
            found = GEOMETRY_MIXED;
        } else {
            stack[height++] = n->first;
            stack[height++] = n->first + 1;
        }
        if (found == GEOMETRY_BLOCKED)
            return found;
        if (found == GEOMETRY_MIXED && !mixed) {
            mixed = true;
            budget = budget < TESTS_MIXED ? budget : TESTS_MIXED;
        }
    }
    return mixed ? GEOMETRY_MIXED : GEOMETRY_CLEAR;
}

/* A flat light does not shine on what is behind it. */
static bool is_behind_light(const geometry *g, const geometry_patch *patch) {
    const shape *light = patch->light < 0 ? NULL : &g->trees[0].shapes[patch->light];
    if (!light || !shape_is_flat(light))
        return false;
    const shape_plane front = shape_plane_of(light);
    return span_of_patch(patch, front.normal, front.point).high <= 0;
}

geometry_visibility geometry_sight_of_patch(const geometry *g, const geometry_patch *patch) {
    if (g->empty || (!g->sights.nodes && !g->copied_sights.nodes))
        return GEOMETRY_MIXED;
    if (is_behind_light(g, patch))
        return GEOMETRY_BLOCKED;
    hull h;
    if (!make_hull(&h, g, patch))
        return GEOMETRY_MIXED;
    geometry_visibility own = look_through(&h, &g->sights);
    return own == GEOMETRY_CLEAR ? look_through(&h, &g->copied_sights) : own;
}
