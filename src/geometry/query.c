/* Rays: candidates from Embree, decisions in double precision. */
#include <float.h>
#include <math.h>

#include "geometry/crossing.h"
#include "geometry/geometry_internal.h"

/* Embree finds candidates in single precision; which of them the ray meets, and where, is decided here in double
 * precision alone. A triangle is met where the true line passes on the inner side of its three edges, after Woop,
 * Benthin and Wald, "Watertight Ray/Triangle Intersection", Journal of Computer Graphics Techniques 2(1), 2013: corners
 * are laid into a plane that the line is perpendicular to, each by itself, and then no sign is wrong. So no line slips
 * through between triangles that share their corners. What single precision may mistake is then only which candidates
 * there are, near edges; see trace(). */

/* Places on a ray where Embree has been wrong about a triangle; more of them are very unlikely. */
#define MISSES 16

/* By so many errors of single precision Embree's rays are longer at both ends. */
#define ENDS 64

/* A surface goes through a point where it is no farther from it than this times the coordinates of both: the roundings
 * of a point computed on it, and of the distance. */
#define ON_SURFACE (16 * DBL_EPSILON)
/* Surfaces that are meant to coincide differ by what writing them down has cost, in proportion to their coordinates:
 * with 12 digits, as Radiance's xform does, by DESCRIBED (half a digit in each of three coordinates of two surfaces,
 * and twice that where the larger goes beyond the smaller); in single precision by SINGLE, but that counts only up to
 * Radiance's own tolerance, its FTINY. */
#define DESCRIBED 0x1p-34
#define SINGLE    0x1p-22
#define FTINY     1e-6
/* The sine of the angle up to which they may be turned against each other: where they are as close as double precision
 * tells, small ones that are far from the origin may be, by more. */
#define PARALLEL         1e-6
#define PARALLEL_TOUCHES 1e-4
/* An origin that is given from outside is as good as its first digits. */
#define GIVEN_ORIGIN 1e-6

typedef struct candidate {
    double distance;
    vec3 normal;
    double slope; /* cosine between ray and normal */
    int surface;
    bool shines;
    const geometry_triangle *triangle; /* null where the surface is curved */
} candidate;

/* About where Embree took a triangle to be met that is not. */
typedef struct miss {
    double distance;
    double error; /* how far from it the ray really passes */
    double reach; /* how far along the ray that may lead: the more oblique, the farther */
} miss;

typedef struct query {
    embree_context context; /* first, since Embree hands on its address */
    const geometry *geometry;
    vec3 origin, direction;
    double size;    /* the origin's largest coordinate */
    double at_once; /* crossings up to here are at the origin */
    double far;     /* crossings beyond are none; where `any` is asked, but for what coincides with the target */
    int from, target;
    bool any; /* whether something blocks the ray is all that is asked */
    bool found_any;
    double start; /* distance along the ray of Embree's origin: where it enters the scene, a little before */
    double end;   /* and where it leaves the scene or comes to its own end, a little behind */
    candidate nearest, nearest_front, nearest_shining;
    float limit; /* Embree's distance beyond which nothing matters */
    miss misses[MISSES];
    int miss_count;
    const miss *around; /* the one that is being looked after */
} query;

/* The bound of single precision's errors, as a length of the scene. */
static double float_error(const query *q) {
    return GEOMETRY_FLOAT_ERROR / q->geometry->scale;
}

/* How far apart surfaces of such coordinates may be found that are meant to coincide. */
static double coincidence(const query *q, double coordinates) {
    return fmax(DESCRIBED * coordinates, fmin(SINGLE * coordinates, FTINY)) + ON_SURFACE * q->size;
}

/* The larger of two surfaces' coordinates. */
static double reach_of(const query *q, int a, int b) {
    return fmax(q->geometry->reach[a], q->geometry->reach[b]);
}

/* Whether surfaces that are so far apart, with these coordinates and normals, are meant to coincide. */
static bool coincide(const query *q, double apart, double coordinates, vec3 normal, vec3 other) {
    if (apart > coincidence(q, coordinates))
        return false;
    bool touches = apart <= DESCRIBED * coordinates + ON_SURFACE * q->size;
    return vec3_length(vec3_cross(normal, other)) <= (touches ? PARALLEL_TOUCHES : PARALLEL);
}

static bool candidates_coincide(const query *q, const candidate *a, const candidate *b) {
    if (a->surface < 0 || b->surface < 0)
        return false;
    double apart = fabs((a->distance - b->distance) * a->slope);
    return coincide(q, apart, reach_of(q, a->surface, b->surface), a->normal, b->normal);
}

/* Embree's own distance at which to stop looking when a surface is met at `t`, under a cosine of `slope`: behind what
 * it takes for the distance of surfaces that coincide with this one. */
static float embree_limit(const query *q, double t, double slope) {
    double limit = t + (float_error(q) + coincidence(q, q->geometry->largest_reach)) / fabs(slope);
    return (float)(((limit < q->end ? limit : q->end) - q->start) * q->geometry->scale);
}

static bool is_before(const candidate *a, const candidate *b) {
    return a->distance < b->distance || (a->distance == b->distance && a->surface > b->surface);
}

/* Of shining surfaces that coincide the last one is hit, whichever of them roundings make the nearest: so that
 * blocks() can tell. */
static bool outshines(const query *q, const candidate *a, const candidate *b) {
    return candidates_coincide(q, a, b) ? a->surface > b->surface : a->distance < b->distance;
}

/* Whether a crossing close to the end of a shadow ray coincides with the target there. */
static bool is_at_target(const query *q, const candidate *c) {
    double apart = fabs((q->far - c->distance) * c->slope);
    if (q->target < 0)
        return apart <= coincidence(q, q->geometry->reach[c->surface]);
    vec3 end = vec3_add_scaled(q->origin, q->far, q->direction);
    vec3 normal = shape_normal(&q->geometry->shapes[q->target], end);
    return coincide(q, apart, reach_of(q, c->surface, q->target), c->normal, normal);
}

/* Whether a crossing keeps the ray from its end. What coincides with the target does not, unless it is what
 * geometry_intersect would find there. */
static bool blocks(const query *q, const candidate *c) {
    const geometry *g = q->geometry;
    double ahead = q->far - c->distance;
    if (fabs(ahead * c->slope) > coincidence(q, g->largest_reach) || !is_at_target(q, c))
        return ahead >= 0;
    if (q->target < 0 || !c->shines || c->slope >= 0)
        return false;
    return !g->shapes[q->target].shines || c->surface > q->target;
}

/* Takes a crossing into account; true where that shortens the search. */
static bool offer(query *q, candidate c) {
    if (q->any) {
        q->found_any = q->found_any || blocks(q, &c);
        return q->found_any;
    }
    bool front = c.slope < 0;
    if (front && is_before(&c, &q->nearest_front))
        q->nearest_front = c;
    if (front && c.shines && outshines(q, &c, &q->nearest_shining))
        q->nearest_shining = c;
    if (!is_before(&c, &q->nearest))
        return false;
    q->nearest = c;
    q->limit = embree_limit(q, c.distance, c.slope);
    return true;
}

/* Whether a crossing is at the ray's origin: of a surface that the origin lies on, or one that coincides with the
 * surface that the ray leaves. Others that meet that one at an angle are hit however close they are. */
static bool is_at_origin(const query *q, const candidate *c) {
    const geometry *g = q->geometry;
    if (c->distance <= q->at_once)
        return true;
    double height = fabs(c->distance * c->slope);
    /* Twice as far as from the surface left, which itself may be the other one of two that coincide. */
    if (height > 2 * coincidence(q, g->largest_reach))
        return false;
    if (height <= ON_SURFACE * (q->size + g->reach[c->surface]))
        return true;
    if (q->from < 0)
        return false;
    vec3 left = shape_normal(&g->shapes[q->from], q->origin);
    return coincide(q, height / 2, reach_of(q, c->surface, q->from), c->normal, left);
}

static bool in_reach(const query *q, const candidate *c) {
    return c->distance > 0 && (c->distance <= q->far || q->any) && !is_at_origin(q, c);
}

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

static bool line_meets_triangle(const query *q, const geometry_triangle *triangle) {
    point2 a = project(q, geometry_corner(q->geometry, triangle, 0));
    point2 b = project(q, geometry_corner(q->geometry, triangle, 1));
    point2 c = project(q, geometry_corner(q->geometry, triangle, 2));
    int ab = edge_side(a, b), bc = edge_side(b, c), ca = edge_side(c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/* Whether the exact test can only confirm Embree's finding. */
static bool is_certain(const geometry_triangle *triangle, double slope, const struct RTCHit *hit) {
    double cosine = fabs(slope), margin = triangle->margin;
    return hit->u * cosine > margin && hit->v * cosine > margin && (1 - hit->u - hit->v) * cosine > margin;
}

/* Offers a triangle that the line meets. */
static bool offer_met(query *q, const geometry_triangle *triangle, double slope) {
    double distance = vec3_dot(triangle->normal, vec3_subtract(triangle->center, q->origin)) / slope;
    candidate c = {distance, triangle->normal, slope, triangle->surface, triangle->shines, triangle};
    return in_reach(q, &c) && offer(q, c);
}

static void note_miss(query *q, const geometry_triangle *triangle, double distance, double slope) {
    double error = triangle->error / q->geometry->scale + GEOMETRY_UNIT_ERROR * (distance - q->start);
    miss m = {distance, error, error / fmax(fabs(slope), DBL_EPSILON)};
    if (distance + m.reach <= 0)
        return;
    for (int i = 0; i < q->miss_count; i++)
        if (fabs(distance - q->misses[i].distance) <= error && m.reach <= 1.1 * q->misses[i].reach)
            return;
    if (q->miss_count < MISSES)
        q->misses[q->miss_count++] = m;
}

static bool is_excepted(const query *q, const geometry_triangle *triangle) {
    return triangle->surface == q->from || triangle->surface == q->target;
}

static bool offer_triangle(query *q, const struct RTCRay *ray, const struct RTCHit *hit) {
    const geometry_triangle *triangle = &q->geometry->triangles[hit->primID];
    if (is_excepted(q, triangle))
        return false;
    double slope = vec3_dot(triangle->normal, q->direction);
    if (is_certain(triangle, slope, hit) || line_meets_triangle(q, triangle))
        return offer_met(q, triangle, slope);
    note_miss(q, triangle, q->start + ray->tfar / q->geometry->scale, slope);
    return false;
}

/* Offers a triangle near a miss. */
static bool offer_neighbour(struct RTCPointQueryFunctionArguments *args) {
    query *q = args->userPtr;
    /* Triangles are attached first. */
    if (args->geomID != 0 || !q->geometry->triangle_count)
        return false;
    const geometry_triangle *triangle = &q->geometry->triangles[args->primID];
    if (is_excepted(q, triangle))
        return false;
    double slope = vec3_dot(triangle->normal, q->direction);
    if (line_meets_triangle(q, triangle))
        offer_met(q, triangle, slope);
    else
        note_miss(q, triangle, q->around->distance, slope);
    return false;
}

static bool offer_curved(query *q, unsigned primitive) {
    int surface = q->geometry->curved[primitive];
    if (surface == q->target)
        return false;
    const shape *s = &q->geometry->shapes[surface];
    shape_crossings crossings = shape_cross(s, q->origin, q->direction, surface == q->from);
    for (int i = 0; i < crossings.count; i++) {
        double distance = crossings.distance[i];
        if (distance <= 0 || (distance > q->far && !q->any))
            continue;
        vec3 normal = shape_normal(s, vec3_add_scaled(q->origin, distance, q->direction));
        double slope = vec3_dot(normal, q->direction);
        candidate c = {distance, normal, slope, surface, s->shines, NULL};
        if (in_reach(q, &c))
            return offer(q, c);
    }
    return false;
}

void geometry_filter_intersect(const struct RTCFilterFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->ray);
    if (offer_triangle(q, ray, embree_hit(args->hit)))
        ray->tfar = q->limit;
    else
        args->valid[0] = 0;
}

void geometry_filter_occluded(const struct RTCFilterFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (!offer_triangle(q, embree_ray(args->ray), embree_hit(args->hit)))
        args->valid[0] = 0;
}

void geometry_intersect_curved(const struct RTCIntersectFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->rayhit);
    if (args->valid[0] && offer_curved(q, args->primID))
        ray->tfar = fminf(ray->tfar, q->limit);
}

void geometry_occluded_curved(const struct RTCOccludedFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (args->valid[0] && offer_curved(q, args->primID))
        embree_ray(args->ray)->tfar = -INFINITY;
}

/* The place at a distance along the ray, in Embree's units. */
static vec3 embree_place(const query *q, double distance) {
    const geometry *g = q->geometry;
    return vec3_scale(g->scale, vec3_add_scaled(vec3_subtract(q->origin, g->center), distance, q->direction));
}

/* Sends Embree along the ray. */
static void cast(query *q) {
    const geometry *g = q->geometry;
    vec3 o = embree_place(q, q->start);
    struct RTCRay ray = {.org_x = (float)o.x,
                         .org_y = (float)o.y,
                         .org_z = (float)o.z,
                         .dir_x = (float)q->direction.x,
                         .dir_y = (float)q->direction.y,
                         .dir_z = (float)q->direction.z,
                         .tfar = q->limit,
                         .mask = UINT32_MAX};
    if (q->any) {
        embree_occluded(g->scene, &q->context, &ray);
    } else {
        struct RTCRayHit ray_hit = {.ray = ray, .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        embree_intersect(g->scene, &q->context, &ray_hit);
    }
}

/* Tests all triangles about a miss. */
static void look_around(query *q) {
    const geometry *g = q->geometry;
    vec3 center = embree_place(q, q->around->distance);
    struct RTCPointQuery around = {.x = (float)center.x,
                                   .y = (float)center.y,
                                   .z = (float)center.z,
                                   .radius = (float)fmin(2 * q->around->reach * g->scale, 4)};
    struct RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(g->scene, &around, &context, offer_neighbour, q);
}

/* The part of the ray that lies in the scene's ball; false where there is none. */
static bool clip(query *q) {
    const geometry *g = q->geometry;
    vec3 to_center = vec3_subtract(g->center, q->origin);
    double middle = vec3_dot(to_center, q->direction);
    vec3 past = vec3_add_scaled(to_center, -middle, q->direction);
    double radius = g->radius + 1e-14 * (fabs(to_center.x) + fabs(to_center.y) + fabs(to_center.z));
    if (vec3_dot(past, past) > radius * radius || middle + radius < 0)
        return false;
    q->start = middle > radius ? middle - radius : 0;
    q->end = q->far < middle + radius ? q->far : middle + radius;
    /* Surfaces close to the ends must not get beyond them, oblique ones neither. */
    q->start -= ENDS * float_error(q);
    q->end += ENDS * float_error(q);
    q->limit = (float)((q->end - q->start) * g->scale);
    return q->start <= q->end;
}

/* Follows the ray. Where Embree took it through a triangle that it passes by, single precision has been too coarse to
 * tell two neighbours apart, and the right one may have been overlooked. Where nothing else is known to stop the ray
 * there or before, it is then looked for among all triangles about that place. One of those that is almost parallel to
 * the ray may lead to the right one farther away: that is another miss, of larger reach. All are tested against the
 * true ray. */
static void trace(query *q) {
    embree_context_init(&q->context);
    q->nearest = q->nearest_front = q->nearest_shining = (candidate){.distance = INFINITY, .surface = -1};
    cast(q);
    for (int i = 0; i < q->miss_count && !q->found_any; i++) {
        q->around = &q->misses[i];
        if (q->nearest.distance > q->around->distance + q->around->error)
            look_around(q);
    }
}

/* Embree takes no care of rays that are none; beyond 1e100 our own squares would overflow. */
static bool is_ray(const geometry_ray *ray) {
    double length2 = vec3_dot(ray->direction, ray->direction);
    return length2 > 0 && length2 < 2 && vec3_dot(ray->origin, ray->origin) < 1e50;
}

/* Of surfaces that coincide, such as the two sides of a sheet, the one counts that faces the ray; and of those that do,
 * such as a ceiling and a lamp in its plane, the one that shines. */
static candidate visible(const query *q) {
    if (candidates_coincide(q, &q->nearest, &q->nearest_shining))
        return q->nearest_shining;
    return candidates_coincide(q, &q->nearest, &q->nearest_front) ? q->nearest_front : q->nearest;
}

static query query_make(const geometry *g, const geometry_ray *ray) {
    double size = vec3_max_abs(ray->origin);
    return (query){.geometry = g,
                   .origin = ray->origin,
                   .direction = ray->direction,
                   .size = size,
                   .at_once = ray->from < 0 ? fmin(GIVEN_ORIGIN * size, FTINY) : 0,
                   .far = ray->far,
                   .from = ray->from,
                   .target = -1};
}

bool geometry_intersect(const geometry *g, const geometry_ray *ray, geometry_hit *hit) {
    hit->surface = -1;
    if (!g->scene || !is_ray(ray))
        return false;
    query q = query_make(g, ray);
    if (!clip(&q))
        return false;
    trace(&q);
    candidate found = visible(&q);
    if (found.surface < 0)
        return false;
    hit->surface = found.surface;
    hit->distance = found.distance;
    hit->point = vec3_add_scaled(ray->origin, found.distance, ray->direction);
    const geometry_triangle *triangle = found.triangle;
    if (triangle) {
        /* shape_pull() without another look into memory */
        double height = vec3_dot(triangle->normal, vec3_subtract(hit->point, triangle->center));
        hit->point = vec3_add_scaled(hit->point, -height, triangle->normal);
        hit->normal = triangle->normal;
    } else {
        hit->point = shape_pull(&g->shapes[found.surface], hit->point);
        hit->normal = shape_normal(&g->shapes[found.surface], hit->point);
    }
    return true;
}

bool geometry_occluded(const geometry *g, const geometry_ray *ray, int target) {
    if (!g->scene || !is_ray(ray))
        return false;
    query q = query_make(g, ray);
    q.target = target;
    q.any = true;
    if (!clip(&q))
        return false;
    trace(&q);
    return q.found_any;
}
