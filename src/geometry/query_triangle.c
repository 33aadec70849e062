/* Triangles that Embree comes upon: whether the ray meets them, in double precision.
 *
 * A triangle is met where the true line passes on the inner side of its three edges, after Woop, Benthin and Wald,
 * "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2(1), 2013: corners are laid into a
 * plane that the line is perpendicular to, each by itself, and then no sign is wrong. So no line slips through between
 * triangles that share their corners. */
#include <float.h>
#include <math.h>

#include "geometry/query.h"

typedef struct point2 {
    double x, y;
} point2;

/* Corner of a triangle as seen along the ray. */
static point2 project(const query *q, vec3 corner) {
    vec3 v = vec3_subtract(corner, q->origin), d = q->direction;
    double ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
    if (az >= ax && az >= ay)
        return (point2){v.x - d.x / d.z * v.z, v.y - d.y / d.z * v.z};
    if (ay >= ax)
        return (point2){v.z - d.z / d.y * v.y, v.x - d.x / d.y * v.y};
    return (point2){v.y - d.y / d.x * v.x, v.z - d.z / d.x * v.x};
}

/* The sign of a.x b.y - a.y b.x, never the wrong one: rounded products that differ are in the order of the exact ones.
 * Those that do not count as 0, which is inside of the triangles on both sides. */
static int edge_side(point2 a, point2 b) {
    double p = a.x * b.y, q = a.y * b.x;
    return (p > q) - (p < q);
}

/* A triangle's corners as seen along the ray, which passes the origin. */
typedef struct view2 {
    point2 a, b, c;
} view2;

/* A point of the group that Embree is in, in the scene. */
static vec3 in_scene(const query *q, vec3 point) {
    return q->visit->transform ? rad_transform_point(q->visit->transform, point) : point;
}

static vec3 normal_in_scene(const query *q, vec3 normal) {
    return q->visit->transform ? rad_transform_direction(q->visit->transform, normal) : normal;
}

static point2 project_corner(const query *q, const geometry_triangle *triangle, int corner) {
    return project(q, in_scene(q, geometry_corner(q->visit->tree, triangle, corner)));
}

static view2 project_triangle(const query *q, const geometry_triangle *triangle) {
    return (view2){project_corner(q, triangle, 0), project_corner(q, triangle, 1), project_corner(q, triangle, 2)};
}

static bool is_met(const view2 *v) {
    int ab = edge_side(v->a, v->b), bc = edge_side(v->b, v->c), ca = edge_side(v->c, v->a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

static bool line_meets_triangle(const query *q, const geometry_triangle *triangle) {
    view2 v = project_triangle(q, triangle);
    return is_met(&v);
}

static double distance2_to_edge(point2 a, point2 b) {
    double x = b.x - a.x, y = b.y - a.y, length2 = x * x + y * y;
    double along = length2 > 0 ? -(a.x * x + a.y * y) / length2 : 0;
    along = double_min(double_max(along, 0), 1);
    double dx = a.x + along * x, dy = a.y + along * y;
    return dx * dx + dy * dy;
}

/* How far off the ray passes a triangle that it does not meet. The plane of projection is oblique: what it shows is at
 * most sqrt(3) times too large. */
static double passing_distance(const view2 *v) {
    double ab = distance2_to_edge(v->a, v->b), bc = distance2_to_edge(v->b, v->c), ca = distance2_to_edge(v->c, v->a);
    return sqrt(double_min(ab, double_min(bc, ca)) / 3);
}

/* Whether the exact test can only confirm Embree's finding. */
static bool is_certain(const geometry_triangle *triangle, double slope, const struct RTCHit *hit) {
    double cosine = fabs(slope), margin = triangle->margin;
    return hit->u * cosine > margin && hit->v * cosine > margin && (1 - hit->u - hit->v) * cosine > margin;
}

/* Offers a triangle that the line meets. */
static bool offer_met(query *q, const geometry_triangle *triangle, vec3 normal, double slope) {
    vec3 center = in_scene(q, triangle->center);
    double distance = vec3_dot(normal, vec3_subtract(center, q->origin)) / slope;
    candidate *c = q->next;
    c->distance = distance;
    c->normal = normal;
    c->slope = slope;
    c->surface = q->visit->first + triangle->surface;
    c->shines = triangle->shines;
    c->triangle = triangle;
    if (q->visit->transform) {
        c->shines = query_shines(q, triangle->shines);
        c->triangle = NULL;
    }
    return query_in_reach(q, c) && query_offer(q);
}

/* How far from the true ray Embree may be wrong about a triangle at that distance. */
static double single_error(const query *q, const geometry_triangle *triangle, double distance) {
    return triangle->error * q->visit->unit + GEOMETRY_UNIT_ERROR * (distance - q->visit->start);
}

static void note_miss(query *q, const geometry_triangle *triangle, double distance, double slope) {
    double error = single_error(q, triangle, distance);
    miss m = {distance, error, error / fmax(fabs(slope), DBL_EPSILON)};
    if (distance + m.reach <= 0)
        return;
    for (int i = 0; i < q->miss_count; i++)
        if (fabs(distance - q->misses[i].distance) <= error && m.reach <= 1.1 * q->misses[i].reach)
            return;
    if (q->miss_count < QUERY_MISSES)
        q->misses[q->miss_count++] = m;
}

static bool is_excepted(const query *q, const geometry_triangle *triangle) {
    int64_t surface = q->visit->first + triangle->surface;
    return surface == q->from || surface == q->target;
}

static bool offer_triangle(query *q, const struct RTCRay *ray, const struct RTCHit *hit) {
    const geometry_triangle *triangle = &q->visit->tree->triangles[hit->primID];
    if (is_excepted(q, triangle))
        return false;
    vec3 normal = normal_in_scene(q, triangle->normal);
    double slope = vec3_dot(normal, q->direction);
    if (is_certain(triangle, slope, hit) || line_meets_triangle(q, triangle))
        return offer_met(q, triangle, normal, slope);
    note_miss(q, triangle, q->visit->start + ray->tfar * q->visit->unit, slope);
    return false;
}

void query_offer_neighbour(query *q, unsigned primitive) {
    const geometry_triangle *triangle = &q->visit->tree->triangles[primitive];
    if (is_excepted(q, triangle))
        return;
    vec3 normal = normal_in_scene(q, triangle->normal);
    double slope = vec3_dot(normal, q->direction);
    view2 v = project_triangle(q, triangle);
    if (is_met(&v))
        offer_met(q, triangle, normal, slope);
    else if (passing_distance(&v) <= 2 * single_error(q, triangle, q->around->distance))
        note_miss(q, triangle, q->around->distance, slope);
}

void query_offer_plate(query *q, const geometry_triangle *triangles, unsigned count, bool certain) {
    if (is_excepted(q, triangles))
        return;
    for (unsigned i = 0; i < count && !certain; i++)
        certain = line_meets_triangle(q, &triangles[i]);
    if (certain)
        (void)offer_met(q, triangles, triangles->normal, vec3_dot(triangles->normal, q->direction));
}

void geometry_filter_intersect(const struct RTCFilterFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->ray);
    if (offer_triangle(q, ray, embree_hit(args->hit)))
        ray->tfar = query_embree_limit(q, q->visit);
    else
        args->valid[0] = 0;
}

void geometry_filter_occluded(const struct RTCFilterFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (!offer_triangle(q, embree_ray(args->ray), embree_hit(args->hit)))
        args->valid[0] = 0;
}
