/* Rays: candidates from Embree, decisions in double precision. */
#include <float.h>
#include <math.h>

#include "geometry/crossing.h"
#include "geometry/geometry_internal.h"
#include "geometry/placed.h"

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

/* The sine of the angle up to which they may be turned against each other: where they are as close as double precision
 * tells, small ones that are far from the origin may be, by more. */
#define PARALLEL         1e-6
#define PARALLEL_TOUCHES 1e-4
/* An origin that is given from outside is as good as its first digits. */
#define GIVEN_ORIGIN 1e-6

/* Where copies of groups are placed, Embree is sent through each group in that group's own units, along the ray as it
 * is there: single precision then costs no more than if the group were all of the scene. What Embree comes upon is
 * brought into the scene and decided there, as for all others: a surface is the same to every ray, and surfaces that
 * share corners in a group share them in the scene. */

typedef struct candidate {
    double distance;
    vec3 normal;
    double slope; /* cosine between ray and normal */
    int64_t surface;
    bool shines;
    const geometry_triangle *triangle; /* null where the surface is curved, or in a copy of a group */
} candidate;

/* About where Embree took a triangle to be met that is not. */
typedef struct miss {
    double distance;
    double error; /* how far from it the ray really passes */
    double reach; /* how far along the ray that may lead: the more oblique, the farther */
} miss;

/* The group that Embree is in, on its way along the ray. */
typedef struct visit {
    const geometry_tree *tree;
    const rad_transform *transform; /* into the scene; null: it is the scene itself */
    int64_t first;                  /* the number of its first surface */
    vec3 center;                    /* of all in it, in the scene */
    double radius;
    double unit;  /* the length of Embree's unit, in the scene: a power of two in the scene itself */
    double start; /* distance along the ray of Embree's origin: where it enters the group, a little before */
    double end;   /* and where it leaves the group or comes to its own end, a little behind */
} visit;

typedef struct query {
    embree_context context; /* first, since Embree hands on its address */
    const geometry *geometry;
    const visit *visit;
    vec3 origin, direction;
    double size;                 /* the origin's largest coordinate */
    double at_once;              /* crossings up to here are at the origin */
    double farthest_coincidence; /* how far apart any surfaces may be found that are meant to coincide */
    double far; /* crossings beyond are none; where `any` is asked, but for what coincides with the target */
    int64_t from, target;
    bool any; /* whether something blocks the ray is all that is asked */
    bool found_any;
    bool passes_panes; /* what light passes does not block, but */
    bool found_pane;   /* this is told */
    candidate nearest, nearest_front, nearest_shining;
    const miss *around; /* the miss that is being looked after */
    int miss_count;
    miss misses[MISSES]; /* that many of them have been set, and no more is ever read */
} query;

/* The bound of single precision's errors, as a length of the scene. */
static double float_error(const visit *v) {
    return GEOMETRY_FLOAT_ERROR * v->unit;
}

/* How far apart surfaces of such coordinates may be found that are meant to coincide. */
static double coincidence(const query *q, double coordinates) {
    return geometry_coincidence(coordinates, q->size);
}

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
    if (apart > coincidence(q, coordinates))
        return false;
    bool touches = apart <= GEOMETRY_DESCRIBED * coordinates + GEOMETRY_ON_SURFACE * q->size;
    return vec3_length(vec3_cross(normal, other)) <= (touches ? PARALLEL_TOUCHES : PARALLEL);
}

static bool candidates_coincide(const query *q, const candidate *a, const candidate *b) {
    if (a->surface < 0 || b->surface < 0)
        return false;
    double apart = fabs((a->distance - b->distance) * a->slope);
    if (apart > q->farthest_coincidence)
        return false;
    return coincide(q, apart, reach_of(q, a->surface, b->surface), a->normal, b->normal);
}

/* Embree's own distance in a group, beyond which nothing matters: behind what it takes for the distance of surfaces
 * that coincide with the nearest one. */
static float embree_limit(const query *q, const visit *v) {
    double limit = v->end;
    if (q->nearest.surface >= 0)
        limit = double_min(limit,
                           q->nearest.distance + (float_error(v) + q->farthest_coincidence) / fabs(q->nearest.slope));
    return (float)((limit - v->start) / v->unit);
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
        return apart <= coincidence(q, reach(q, c->surface));
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

static void block(query *q, const candidate *c) {
    if (q->passes_panes && geometry_passes(q->geometry, c->surface))
        q->found_pane = true;
    else
        q->found_any = true;
}

/* Takes a crossing into account; true where that shortens the search. */
static bool offer(query *q, candidate c) {
    if (q->any) {
        if (!q->found_any && blocks(q, &c))
            block(q, &c);
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
    return true;
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
    candidate c = {.distance = distance,
                   .normal = normal,
                   .slope = slope,
                   .surface = q->visit->first + triangle->surface,
                   .shines = triangle->shines,
                   .triangle = q->visit->transform ? NULL : triangle};
    return in_reach(q, &c) && offer(q, c);
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
    if (q->miss_count < MISSES)
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

/* Offers a triangle near a miss. One that the ray passes far off has nothing to do with it. */
static void offer_neighbour(query *q, unsigned primitive) {
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

static bool offer_curved(query *q, unsigned primitive) {
    const visit *v = q->visit;
    int64_t surface = v->first + v->tree->curved[primitive];
    if (surface == q->target)
        return false;
    const shape *s = &v->tree->shapes[v->tree->curved[primitive]];
    shape placed;
    if (v->transform) {
        placed = shape_placed(s, v->transform);
        s = &placed;
    }
    shape_crossings crossings = shape_cross(s, q->origin, q->direction, surface == q->from);
    for (int i = 0; i < crossings.count; i++) {
        double distance = crossings.distance[i];
        if (distance <= 0 || (distance > q->far && !q->any))
            continue;
        vec3 normal = shape_normal(s, vec3_add_scaled(q->origin, distance, q->direction));
        double slope = vec3_dot(normal, q->direction);
        candidate c = {.distance = distance, .normal = normal, .slope = slope, .surface = surface, .shines = s->shines};
        if (in_reach(q, &c))
            return offer(q, c);
    }
    return false;
}

void geometry_filter_intersect(const struct RTCFilterFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->ray);
    if (offer_triangle(q, ray, embree_hit(args->hit)))
        ray->tfar = embree_limit(q, q->visit);
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
        ray->tfar = fminf(ray->tfar, embree_limit(q, q->visit));
}

void geometry_occluded_curved(const struct RTCOccludedFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (args->valid[0] && offer_curved(q, args->primID))
        embree_ray(args->ray)->tfar = -INFINITY;
}

/* The place at a distance along the ray, in Embree's units of the group that is visited. */
static vec3 embree_place(const query *q, double distance) {
    const visit *v = q->visit;
    const geometry_tree *tree = v->tree;
    if (!v->transform) /* the difference first: it may be exact */
        return vec3_scale(tree->scale, vec3_add_scaled(vec3_subtract(q->origin, tree->center), distance, q->direction));
    vec3 point = rad_transform_point_back(v->transform, vec3_add_scaled(q->origin, distance, q->direction));
    return vec3_scale(tree->scale, vec3_subtract(point, tree->center));
}

/* Sends Embree along the ray, through the group that is visited. */
static void cast(query *q) {
    const visit *v = q->visit;
    vec3 o = embree_place(q, v->start), d = q->direction;
    if (v->transform)
        d = rad_transform_direction_back(v->transform, d);
    struct RTCRayHit ray = {.ray = {.org_x = (float)o.x,
                                    .org_y = (float)o.y,
                                    .org_z = (float)o.z,
                                    .dir_x = (float)d.x,
                                    .dir_y = (float)d.y,
                                    .dir_z = (float)d.z,
                                    .tfar = embree_limit(q, v),
                                    .mask = UINT32_MAX},
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
    if (q->any)
        embree_occluded(v->tree->scene, &q->context, &ray.ray);
    else
        embree_intersect(v->tree->scene, &q->context, &ray);
}

/* The part of the ray that lies in the ball about all that is visited; false where there is none. */
static bool clip(const query *q, visit *v) {
    vec3 to_center = vec3_subtract(v->center, q->origin);
    double middle = vec3_dot(to_center, q->direction);
    vec3 past = vec3_add_scaled(to_center, -middle, q->direction);
    double radius = v->radius + 1e-14 * (fabs(to_center.x) + fabs(to_center.y) + fabs(to_center.z));
    if (vec3_dot(past, past) > radius * radius || middle + radius < 0)
        return false;
    v->start = middle > radius ? middle - radius : 0;
    v->end = q->far < middle + radius ? q->far : middle + radius;
    /* Surfaces close to the ends must not get beyond them, oblique ones neither. */
    v->start -= ENDS * float_error(v);
    v->end += ENDS * float_error(v);
    return v->start <= v->end;
}

/* ---- Copies of groups ---- */

/* A visit to a copy that is placed in the group visited. Their transforms together go to *both if it is needed. */
static visit visit_of_copy(const query *q, unsigned primitive, rad_transform *both) {
    const visit *outer = q->visit;
    const geometry_tree *tree = outer->tree;
    size_t index = tree->placed[primitive];
    const geometry_placement *placement = &tree->placements[index];
    visit v = {.tree = &q->geometry->trees[placement->group],
               .transform = &placement->transform,
               .first = outer->first + tree->firsts[index]};
    if (outer->transform) {
        *both = rad_transform_then(&placement->transform, outer->transform);
        v.transform = both;
    }
    v.center = rad_transform_point(v.transform, v.tree->center);
    v.radius = v.tree->radius * v.transform->scale * (1 + 1e-9) + 1e-14 * vec3_max_abs(v.center);
    v.unit = v.transform->scale / v.tree->scale;
    return v;
}

/* Follows the ray through a copy. */
static void cast_through_copy(query *q, unsigned primitive) {
    const visit *outer = q->visit;
    rad_transform both;
    visit v = visit_of_copy(q, primitive, &both);
    if (!clip(q, &v))
        return;
    q->visit = &v;
    cast(q);
    q->visit = outer;
}

void geometry_intersect_copy(const struct RTCIntersectFunctionNArguments *args) {
    query *q = (query *)args->context;
    struct RTCRay *ray = embree_ray(args->rayhit);
    if (!args->valid[0])
        return;
    cast_through_copy(q, args->primID);
    ray->tfar = fminf(ray->tfar, embree_limit(q, q->visit));
}

void geometry_occluded_copy(const struct RTCOccludedFunctionNArguments *args) {
    query *q = (query *)args->context;
    if (!args->valid[0] || q->found_any)
        return;
    cast_through_copy(q, args->primID);
    if (q->found_any)
        embree_ray(args->ray)->tfar = -INFINITY;
}

/* ---- Misses ---- */

static void look_around(query *q);

static bool look_at_neighbour(struct RTCPointQueryFunctionArguments *args) {
    query *q = args->userPtr;
    const visit *outer = q->visit;
    if (args->geomID == outer->tree->triangles_id) {
        offer_neighbour(q, args->primID);
    } else if (args->geomID == outer->tree->placed_id) {
        rad_transform both;
        visit v = visit_of_copy(q, args->primID, &both);
        if (clip(q, &v)) {
            q->visit = &v;
            look_around(q);
            q->visit = outer;
        }
    }
    return false;
}

/* Tests all triangles about a miss, in the group that is visited. */
static void look_around(query *q) {
    const visit *v = q->visit;
    vec3 center = embree_place(q, q->around->distance);
    struct RTCPointQuery around = {.x = (float)center.x,
                                   .y = (float)center.y,
                                   .z = (float)center.z,
                                   .radius = (float)fmin(2 * q->around->reach / v->unit, 4)};
    struct RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(v->tree->scene, &around, &context, look_at_neighbour, q);
}

/* Follows the ray. Where Embree took it through a triangle that it passes by, single precision has been too coarse to
 * tell two neighbours apart, and the right one may have been overlooked. Where nothing else is known to stop the ray
 * there or before, it is then looked for among all triangles about that place. One of those that is almost parallel to
 * the ray may lead to the right one farther away: that is another miss, of larger reach. All are tested against the
 * true ray. */
static void trace(query *q) {
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
static const candidate *visible(const query *q) {
    const candidate *nearest = &q->nearest;
    if (candidates_coincide(q, nearest, &q->nearest_shining))
        return &q->nearest_shining;
    bool covered = nearest->slope >= 0 && candidates_coincide(q, nearest, &q->nearest_front);
    return covered ? &q->nearest_front : nearest;
}

static const candidate nothing = {.distance = INFINITY, .surface = -1};

/* All but `misses`, which a query seldom has: to clear them would take longer than many a query. */
static void prepare(query *q, const geometry *g, const geometry_ray *ray) {
    embree_context_init(&q->context);
    q->geometry = g;
    q->origin = ray->origin;
    q->direction = ray->direction;
    q->size = vec3_max_abs(ray->origin);
    q->at_once = ray->from < 0 ? double_min(GIVEN_ORIGIN * q->size, GEOMETRY_FTINY) : 0;
    q->farthest_coincidence = coincidence(q, g->largest_reach);
    q->far = ray->far;
    q->from = ray->from;
    q->target = -1;
    q->any = q->found_any = q->passes_panes = false;
    q->nearest = q->nearest_front = q->nearest_shining = nothing;
    q->around = NULL;
    q->miss_count = 0;
}

/* The scene itself, as all visits begin. */
static visit visit_of_scene(const geometry *g) {
    const geometry_tree *tree = &g->trees[0];
    return (visit){.tree = tree, .center = tree->center, .radius = tree->radius, .unit = 1 / tree->scale};
}

static void describe_hit(const geometry *g, const candidate *found, geometry_hit *hit) {
    const geometry_triangle *triangle = found->triangle;
    const geometry_tree *scene = &g->trees[0];
    if (triangle) {
        /* shape_pull() without another look into memory */
        double height = vec3_dot(triangle->normal, vec3_subtract(hit->point, triangle->center));
        hit->point = vec3_add_scaled(hit->point, -height, triangle->normal);
        hit->normal = triangle->normal;
        return;
    }
    const shape *s = &scene->shapes[found->surface];
    shape placed;
    if (found->surface >= (int64_t)scene->shape_count) {
        placed = geometry_placed_shape(g, found->surface);
        s = &placed;
    }
    hit->point = shape_pull(s, hit->point);
    hit->normal = shape_normal(s, hit->point);
}

bool geometry_intersect(const geometry *g, const geometry_ray *ray, geometry_hit *hit) {
    hit->surface = -1;
    if (!g->trees[0].scene || !is_ray(ray))
        return false;
    query q;
    prepare(&q, g, ray);
    visit scene = visit_of_scene(g);
    if (!clip(&q, &scene))
        return false;
    q.visit = &scene;
    trace(&q);
    const candidate *found = visible(&q);
    if (found->surface < 0)
        return false;
    hit->surface = found->surface;
    hit->distance = found->distance;
    hit->point = vec3_add_scaled(ray->origin, found->distance, ray->direction);
    describe_hit(g, found, hit);
    return true;
}

/* Whether the way is shut, by more than panes where these are let pass; `q` tells of them. */
static bool is_occluded(query *q, const geometry *g, const geometry_ray *ray, int64_t target, bool passes_panes) {
    if (!g->trees[0].scene || !is_ray(ray))
        return false;
    prepare(q, g, ray);
    q->target = target;
    q->any = true;
    q->passes_panes = passes_panes;
    visit scene = visit_of_scene(g);
    if (!clip(q, &scene))
        return false;
    q->visit = &scene;
    trace(q);
    return q->found_any;
}

bool geometry_occluded(const geometry *g, const geometry_ray *ray, int64_t target) {
    query q;
    return is_occluded(&q, g, ray, target, false);
}

bool geometry_occluded_but_for_panes(const geometry *g, const geometry_ray *ray, int64_t target, bool *panes) {
    query q;
    q.found_pane = false;
    bool occluded = is_occluded(&q, g, ray, target, true);
    *panes = q.found_pane && !occluded;
    return occluded;
}
