/* Whether a surface leaves a shaft of rays free, or closes it. */

#include "geometry/geometry_internal.h"
#include "geometry/shaft_internal.h"

/* A polygon of more corners is taken apart into its triangles, of which no more than these are tested. */
#define FACE_CORNERS   8
#define MOST_TRIANGLES 32

/* The test of a surface costs about as much as those of so many boxes. */
#define TEST_WORTH 3

/* A plane polygon, relative to the point. */
typedef struct face {
    vec3 corners[FACE_CORNERS];
    int count;
    vec3 normal;
    double height; /* of the point over its plane */
    double slack;  /* of its corners, where they are not in one plane */
    bool rival;
} face;

/* Whether the front of a later light is hit in place of this one where they coincide (geometry.h). */
static bool is_rival(const shaft *s, const shape *body, int surface) {
    return body->shines && s->sight->light >= 0 && surface > s->sight->light;
}

/* So far a surface must keep off the light. */
static double end_margin(const shaft *s, bool rival) {
    return rival ? 2 * s->near : -s->tolerance;
}

static bool corners_are_below(const face *f, vec3 normal, double height) {
    for (int i = 0; i < f->count; i++)
        if (vec3_dot(normal, f->corners[i]) > height)
            return false;
    return true;
}

/* The point and the light are on the same side of its plane. */
static bool plane_is_beside(const shaft *s, const face *f) {
    shaft_span light = shaft_light_span(s, f->normal);
    double margin = end_margin(s, f->rival);
    return (f->height >= -s->tolerance && light.low + f->height >= margin) ||
           (f->height <= s->tolerance && light.high + f->height <= -margin);
}

/* A plane through the point and an edge has the polygon on one side, the light on the other. */
static bool edge_separates(const shaft *s, const face *f) {
    for (int i = 0, before = f->count - 1; i < f->count; before = i++) {
        vec3 a = f->corners[before], b = f->corners[i], normal = vec3_cross(a, b);
        double length2 = vec3_dot(normal, normal);
        if (!(length2 > 1e-18 * vec3_dot(a, a) * vec3_dot(b, b)))
            continue;
        double slack = s->tolerance * sqrt(length2);
        double low = INFINITY, high = -INFINITY;
        for (int k = 0; k < f->count; k++) {
            double part = vec3_dot(normal, f->corners[k]);
            low = double_min(low, part);
            high = double_max(high, part);
        }
        if (low < -slack && high > slack)
            continue;
        shaft_span light = shaft_light_span(s, normal);
        if ((low >= -slack && light.high <= slack) || (high <= slack && light.low >= -slack))
            return true;
    }
    return false;
}

static bool face_is_beside(const shaft *s, const face *f) {
    if (corners_are_below(f, s->sight->normal, s->tolerance - f->slack) || plane_is_beside(s, f) ||
        corners_are_below(f, s->base, -end_margin(s, f->rival) - f->slack - s->base_height))
        return true;
    for (int i = 0; i < s->side_count; i++)
        if (corners_are_below(f, s->sides[i], s->tolerance))
            return true;
    return edge_separates(s, f);
}

/* The reach of the light's visible surface, which of a sphere is nearer than its disk. */
static shaft_span surface_span(const shaft *s, vec3 unit) {
    if (s->ball_radius == 0)
        return shaft_light_span(s, unit);
    double middle = vec3_dot(unit, s->ball_center);
    return (shaft_span){middle - s->ball_radius, middle + s->ball_radius};
}

/* The light is beyond the plane, and on the inner side of all edges: within a cone over points from which no edge is
 * seen from outside, which are points of the polygon if its outline turns once. The rays to a convex light are among
 * those to the hull of its corners. */
static bool face_closes(const shaft *s, const face *f) {
    double margin = 4 * s->near;
    shaft_span light = surface_span(s, f->normal);
    bool front = f->height > margin && light.high + f->height < -margin;
    bool back = f->height < -margin && light.low + f->height > margin;
    if (!front && !back)
        return false;
    for (int i = 0, before = f->count - 1; i < f->count; before = i++) {
        vec3 a = f->corners[front ? i : before], b = f->corners[front ? before : i], inward = vec3_cross(a, b);
        double length = vec3_length(inward);
        if (!(length > 0) || shaft_light_span(s, inward).low <= margin * length)
            return false;
    }
    return true;
}

double shaft_slack(const geometry *g, double uneven) {
    return 256 * GEOMETRY_FLOAT_ERROR / g->trees[0].scale + 2 * uneven;
}

static void find_slack(const shaft *s, const geometry *g, face *f) {
    double uneven = 0;
    for (int i = 0; i < f->count; i++)
        uneven = double_max(uneven, fabs(vec3_dot(f->normal, f->corners[i]) + f->height));
    f->slack = uneven <= s->tolerance ? 0 : shaft_slack(g, uneven);
}

static geometry_visibility meet_face(const shaft *s, const geometry *g, face *f) {
    find_slack(s, g, f);
    if (face_is_beside(s, f))
        return GEOMETRY_CLEAR;
    /* A polygon of five corners may turn twice. */
    return f->count <= 4 && f->slack == 0 && face_closes(s, f) ? GEOMETRY_BLOCKED : GEOMETRY_MIXED;
}

static geometry_visibility meet_triangles(const shaft *s, const geometry *g, const shape *polygon, face *f,
                                          int *budget) {
    geometry_visibility all = GEOMETRY_CLEAR;
    if (polygon->polygon.triangle_count > MOST_TRIANGLES)
        return GEOMETRY_MIXED;
    *budget -= TEST_WORTH * (int)polygon->polygon.triangle_count;
    f->count = 3;
    for (uint32_t k = 0; k < polygon->polygon.triangle_count; k++) {
        for (int i = 0; i < 3; i++)
            f->corners[i] = vec3_subtract(polygon->polygon.vertices[polygon->polygon.triangles[k][i]], s->sight->point);
        geometry_visibility one = meet_face(s, g, f);
        if (one == GEOMETRY_BLOCKED)
            return one;
        all = one == GEOMETRY_MIXED ? one : all;
    }
    return all;
}

static geometry_visibility meet_polygon(const shaft *s, const geometry *g, int surface, int *budget) {
    const shape *polygon = &g->trees[0].shapes[surface];
    face f = {.normal = polygon->polygon.normal};
    f.height = vec3_dot(f.normal, vec3_subtract(s->sight->point, polygon->polygon.center));
    f.rival = f.height > 0 && is_rival(s, polygon, surface);
    if (polygon->polygon.vertex_count <= FACE_CORNERS) {
        f.count = (int)polygon->polygon.vertex_count;
        for (int i = 0; i < f.count; i++)
            f.corners[i] = vec3_subtract(polygon->polygon.vertices[i], s->sight->point);
        geometry_visibility whole = meet_face(s, g, &f);
        if (whole != GEOMETRY_MIXED || f.count <= 4)
            return whole;
    } else if (plane_is_beside(s, &f)) {
        return GEOMETRY_CLEAR;
    }
    return meet_triangles(s, g, polygon, &f, budget);
}

double shaft_reach_of(const shape *body, vec3 point, vec3 along) {
    if (body->kind == SHAPE_POLYGON) {
        double reach = -INFINITY;
        for (uint32_t i = 0; i < body->polygon.vertex_count; i++)
            reach = double_max(reach, vec3_dot(along, vec3_subtract(body->polygon.vertices[i], point)));
        return reach;
    }
    if (body->kind == SHAPE_SPHERE)
        return vec3_dot(along, vec3_subtract(body->sphere.center, point)) + body->sphere.radius;
    if (body->kind == SHAPE_RING) {
        double part = vec3_dot(along, body->ring.normal);
        return vec3_dot(along, vec3_subtract(body->ring.center, point)) +
               body->ring.r1 * sqrt(double_max(0, 1 - part * part));
    }
    double part = vec3_dot(along, body->cone.axis), across = sqrt(double_max(0, 1 - part * part));
    return double_max(vec3_dot(along, vec3_subtract(body->cone.p0, point)) + body->cone.r0 * across,
                      vec3_dot(along, vec3_subtract(body->cone.p1, point)) + body->cone.r1 * across);
}

static bool body_is_beside(const shaft *s, const shape *body, int surface) {
    vec3 point = s->sight->point;
    if (shaft_reach_of(body, point, s->sight->normal) <= s->tolerance ||
        shaft_reach_of(body, point, s->base) + s->base_height <= -end_margin(s, is_rival(s, body, surface)))
        return true;
    for (int i = 0; i < s->side_count; i++)
        if (shaft_reach_of(body, point, s->sides[i]) <= s->tolerance)
            return true;
    return false;
}

/* The light lies in the ball, and the point: so do all rays between them. */
static bool ball_holds(const shaft *s, const shape *ball, int surface, double distance) {
    double room = ball->sphere.radius - (surface == s->sight->from ? -s->tolerance : 2 * s->near);
    if (distance > room || s->sight->light < 0)
        return false;
    double reach = ball->sphere.radius - end_margin(s, is_rival(s, ball, surface));
    for (int i = 0; i < s->corner_count; i++) {
        vec3 corner = vec3_subtract(s->corners[i], vec3_subtract(ball->sphere.center, s->sight->point));
        if (vec3_length(corner) > reach)
            return false;
    }
    return true;
}

/* Of the angle between the middles of ball and light, for its plane to be known to half of a double's digits and more.
 */
#define LEAST_SINE 1e-6

/* The plane through the point that touches the ball where it is nearest to the light. */
static bool tangent_separates(const shaft *s, vec3 unit, double sine) {
    vec3 light = s->round ? s->center : vec3_scale(0.5, vec3_add(s->corners[0], s->corners[s->corner_count / 2]));
    vec3 off_axis = vec3_add_scaled(light, -vec3_dot(light, unit), unit);
    /* Within the ball's own cone the light's middle is beside no such plane; close to its axis the direction away from
     * that would be one of roundings. */
    double away = vec3_length(off_axis);
    if (!(away > double_max(sine, LEAST_SINE) * vec3_length(light)))
        return false;
    vec3 across = vec3_scale(1 / away, off_axis);
    vec3 normal = vec3_add_scaled(vec3_scale(sqrt((1 - sine) * (1 + sine)), across), -sine, unit);
    return shaft_light_span(s, normal).low >= -s->tolerance;
}

/* The light lies beyond the ball and within the cone of rays that meet it. */
static bool ball_closes(const shaft *s, vec3 unit, double distance, double radius) {
    double margin = 4 * s->near, sine = (radius - margin) / distance;
    if (!(sine > 0) || distance - radius <= margin)
        return false;
    if (surface_span(s, unit).low <= distance * (1 - sine) * (1 + sine) + 2 * margin)
        return false;
    double cosine = sqrt((1 - sine) * (1 + sine));
    for (int i = 0; i < s->corner_count; i++)
        if (vec3_dot(unit, s->corners[i]) <= cosine * vec3_length(s->corners[i]))
            return false;
    return true;
}

/* How far the light is from a point at the least, and at the most; the former only as far as one plane tells. */
static shaft_span light_distances(const shaft *s, vec3 from) {
    vec3 middle = s->ball_radius > 0 ? s->ball_center
                  : s->round         ? s->center
                                     : vec3_scale(0.5, vec3_add(s->corners[0], s->corners[s->corner_count / 2]));
    vec3 away = vec3_subtract(middle, from), unit = vec3_safe_normalize(away);
    shaft_span distances = {surface_span(s, unit).low - vec3_dot(unit, from), 0};
    if (s->ball_radius > 0)
        distances.high = vec3_length(away) + s->ball_radius;
    for (int i = 0; i < s->corner_count && s->ball_radius == 0; i++)
        distances.high = double_max(distances.high, vec3_length(vec3_subtract(s->corners[i], from)));
    return distances;
}

/* The light is inside and the point is not, or the other way round: a ball has no gap. */
static bool ball_parts(const shaft *s, vec3 center, double distance, double radius) {
    double margin = 4 * s->near;
    bool outside = distance > radius + margin;
    if (!outside && !(distance < radius - margin))
        return false;
    shaft_span light = light_distances(s, center);
    return outside ? light.high < radius - margin : light.low > radius + margin;
}

static geometry_visibility meet_sphere(const shaft *s, const shape *ball, int surface) {
    vec3 center = vec3_subtract(ball->sphere.center, s->sight->point);
    double distance = vec3_length(center), radius = ball->sphere.radius;
    if (body_is_beside(s, ball, surface))
        return GEOMETRY_CLEAR;
    if (surface != s->sight->from && ball_parts(s, center, distance, radius))
        return GEOMETRY_BLOCKED;
    if (distance <= radius + s->tolerance || surface == s->sight->from)
        return ball_holds(s, ball, surface, distance) ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
    vec3 unit = vec3_scale(1 / distance, center);
    if (tangent_separates(s, unit, radius / distance))
        return GEOMETRY_CLEAR;
    return ball_closes(s, unit, distance, radius) ? GEOMETRY_BLOCKED : GEOMETRY_MIXED;
}

static geometry_visibility meet_ring(const shaft *s, const shape *ring, int surface) {
    face plane = {.normal = ring->ring.normal};
    plane.height = vec3_dot(plane.normal, vec3_subtract(s->sight->point, ring->ring.center));
    plane.rival = plane.height > 0 && is_rival(s, ring, surface);
    return plane_is_beside(s, &plane) || body_is_beside(s, ring, surface) ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
}

static geometry_visibility meet_shape(shaft *s, const geometry *g, int surface, int *budget) {
    const shape *body = &g->trees[0].shapes[surface];
    bool left = surface == s->sight->from;
    double light = s->sight->light < 0 ? 0 : g->trees[0].reach[s->sight->light];
    *budget -= TEST_WORTH;
    s->tolerance = shaft_tolerance(vec3_max_abs(s->sight->point), double_max(light, g->trees[0].reach[surface]));
    if (surface == s->sight->light || (left && shape_is_flat(body)))
        return GEOMETRY_CLEAR;
    switch (body->kind) {
    case SHAPE_POLYGON:
        return meet_polygon(s, g, surface, budget);
    case SHAPE_SPHERE:
        return meet_sphere(s, body, surface);
    case SHAPE_RING:
        return meet_ring(s, body, surface);
    case SHAPE_CONE:
        return body_is_beside(s, body, surface) ? GEOMETRY_CLEAR : GEOMETRY_MIXED;
    }
    return GEOMETRY_MIXED;
}

geometry_visibility shaft_meets_shape(shaft *s, const geometry *g, int surface, int *budget) {
    geometry_visibility found = meet_shape(s, g, surface, budget);
    return found == GEOMETRY_BLOCKED && g->trees[0].shapes[surface].passes ? GEOMETRY_MIXED : found;
}
