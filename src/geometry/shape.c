/* Shapes from primitives, with Radiance's checks. */
#include "geometry/shape.h"

#include "base/angle.h"
#include "geometry/tessellate.h"

/* Radiance's FTINY: a radius up to this is none. */
#define TINY_RADIUS 1e-6
/* Radiance's tolerance for vertices outside their plane. */
#define PLANE_TOLERANCE 1e-5
/* Area, in squares of a polygon's extent, that is nothing but rounding. */
#define NO_AREA 1e-14
/* Squares of areas must fit into a double. */
#define LARGEST_COORDINATE 1e9

_Static_assert(sizeof(vec3) == 3 * sizeof(double), "vertices are read where they stand among a polygon's reals");

static vec3 real3(const double *reals) {
    return vec3_make(reals[0], reals[1], reals[2]);
}

static graze_status check_reals(const rad_primitive *p, uint32_t count, const graze_report *report) {
    if (p->real_count != count)
        return rad_primitive_error(report, p, "%u real arguments where %u are needed", (unsigned)p->real_count,
                                   (unsigned)count);
    for (uint32_t i = 0; i < count; i++)
        if (!(fabs(p->reals[i]) <= LARGEST_COORDINATE))
            return rad_primitive_error(report, p, "argument %u is too large", (unsigned)i + 1);
    return GRAZE_OK;
}

/* Newell's normal, twice the area long, summed around the first vertex. */
static vec3 newell_normal(const vec3 *v, uint32_t count) {
    vec3 sum = {0, 0, 0};
    vec3 a = vec3_subtract(v[1], v[0]);
    for (uint32_t i = 2; i < count; i++) {
        vec3 b = vec3_subtract(v[i], v[0]);
        sum = vec3_add(sum, vec3_cross(a, b));
        a = b;
    }
    return sum;
}

static vec3 mean_vertex(const vec3 *v, uint32_t count) {
    vec3 sum = {0, 0, 0};
    for (uint32_t i = 1; i < count; i++)
        sum = vec3_add(sum, vec3_subtract(v[i], v[0]));
    return vec3_add_scaled(v[0], 1.0 / count, sum);
}

static double outline_extent(const vec3 *v, uint32_t count) {
    double extent = 0;
    for (uint32_t i = 1; i < count; i++)
        extent = double_max(extent, vec3_max_abs(vec3_subtract(v[i], v[0])));
    return extent;
}

/* Radiance's test: each vertex's height over the origin against the mean of those before it, absolutely for a plane
 * through the origin, else relatively. */
static bool is_planar(const shape *s) {
    const vec3 *v = s->polygon.vertices;
    double sum = vec3_dot(s->polygon.normal, v[0]);
    bool absolute = fabs(sum) <= PLANE_TOLERANCE;
    for (uint32_t i = 1; i < s->polygon.vertex_count; i++) {
        double mean = sum / i, height = vec3_dot(s->polygon.normal, v[i]);
        if (fabs(height - mean) > PLANE_TOLERANCE * (absolute ? 1 : fabs(mean)))
            return false;
        sum += height;
    }
    return true;
}

static double triangle_area(const shape *s, const uint32_t *corner) {
    const vec3 *v = s->polygon.vertices;
    return 0.5 * vec3_length(
                     vec3_cross(vec3_subtract(v[corner[1]], v[corner[0]]), vec3_subtract(v[corner[2]], v[corner[0]])));
}

void shape_from_triangle(shape *s, const vec3 vertices[3]) {
    static const uint32_t corners[1][3] = {{0, 1, 2}};
    vec3 normal = newell_normal(vertices, 3);
    double extent = outline_extent(vertices, 3), length = vec3_length(normal);
    *s = (shape){.kind = SHAPE_POLYGON};
    s->polygon.vertices = vertices;
    s->polygon.vertex_count = 3;
    s->polygon.center = mean_vertex(vertices, 3);
    s->polygon.triangles = corners;
    if (!(length > NO_AREA * extent * extent))
        return;
    s->polygon.normal = vec3_scale(1 / length, normal);
    s->polygon.offset = vec3_dot(s->polygon.normal, s->polygon.center);
    s->polygon.area = 0.5 * length;
    s->polygon.triangle_count = 1;
}

static graze_status make_polygon(shape *s, bool *degenerate, const rad_primitive *p, arena *memory,
                                 const graze_report *report) {
    if (p->real_count < 9 || p->real_count % 3)
        return rad_primitive_error(report, p,
                                   "%u real arguments where three for each of three or more vertices are needed",
                                   (unsigned)p->real_count);
    graze_status status = check_reals(p, p->real_count, report);
    if (status)
        return status;
    uint32_t count = p->real_count / 3;
    const vec3 *vertices = (const vec3 *)p->reals;
    if (count > 3 && vec3_length(vec3_subtract(vertices[count - 1], vertices[0])) <= TINY_RADIUS)
        count--;

    if (count == 3) {
        shape_from_triangle(s, vertices);
        *degenerate = !s->polygon.triangle_count;
        if (*degenerate)
            rad_primitive_warning(report, p, "zero area; the surface is left out");
        return GRAZE_OK;
    }
    s->kind = SHAPE_POLYGON;
    s->polygon.vertices = vertices;
    s->polygon.vertex_count = count;
    vec3 normal = newell_normal(vertices, count);
    double extent = outline_extent(vertices, count);
    *degenerate = !(vec3_length(normal) > NO_AREA * extent * extent);
    if (!*degenerate) {
        s->polygon.normal = vec3_normalize(normal);
        s->polygon.center = mean_vertex(vertices, count);
        s->polygon.offset = vec3_dot(s->polygon.normal, s->polygon.center);
        if (!is_planar(s))
            rad_primitive_warning(report, p, "non-planar vertex");
        status = shape_tessellate(s, memory, p, report);
        if (status)
            return status;
        for (uint32_t i = 0; i < s->polygon.triangle_count; i++)
            s->polygon.area += triangle_area(s, s->polygon.triangles[i]);
        *degenerate = !s->polygon.triangle_count;
    }
    if (*degenerate)
        rad_primitive_warning(report, p, "zero area; the surface is left out");
    return GRAZE_OK;
}

static graze_status make_sphere(shape *s, bool *degenerate, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_reals(p, 4, report);
    if (status)
        return status;
    double radius = p->reals[3];
    *degenerate = fabs(radius) <= TINY_RADIUS;
    if (*degenerate)
        rad_primitive_warning(report, p, "zero radius; the surface is left out");
    else if (radius < 0)
        rad_primitive_warning(report, p, "negative radius turns the surface inside out");
    s->kind = SHAPE_SPHERE;
    s->inward = (p->type == RAD_BUBBLE) != (radius < 0);
    s->sphere.center = real3(p->reals);
    s->sphere.radius = fabs(radius);
    return GRAZE_OK;
}

static int radius_sign(double radius) {
    return (radius > TINY_RADIUS) - (radius < -TINY_RADIUS);
}

static graze_status make_cone(shape *s, bool *degenerate, const rad_primitive *p, const graze_report *report) {
    bool cylinder = p->type == RAD_CYLINDER || p->type == RAD_TUBE;
    graze_status status = check_reals(p, cylinder ? 7 : 8, report);
    if (status)
        return status;
    double r0 = p->reals[6], r1 = p->reals[cylinder ? 6 : 7];
    int sign0 = radius_sign(r0), sign1 = radius_sign(r1);
    s->kind = SHAPE_CONE;
    s->inward = p->type == RAD_CUP || p->type == RAD_TUBE;
    if (sign0 + sign1 == 0) {
        rad_primitive_warning(report, p, "illegal radii; the surface is left out");
        *degenerate = true;
        return GRAZE_OK;
    }
    if (sign0 < 0 || sign1 < 0) {
        rad_primitive_warning(report, p, "negative radius turns the surface inside out");
        s->inward = !s->inward;
    }
    r0 *= sign0;
    r1 *= sign1;
    s->cone.p0 = real3(p->reals);
    s->cone.p1 = real3(p->reals + 3);
    s->cone.r0 = r0;
    s->cone.r1 = fabs(r1 - r0) <= TINY_RADIUS ? r0 : r1;
    vec3 axis = vec3_subtract(s->cone.p1, s->cone.p0);
    s->cone.length = vec3_safe_length(axis);
    s->cone.axis = vec3_safe_normalize(axis);
    *degenerate = !(s->cone.length > 0);
    if (*degenerate)
        rad_primitive_warning(report, p, "unknown orientation; the surface is left out");
    return GRAZE_OK;
}

static graze_status make_ring(shape *s, bool *degenerate, const rad_primitive *p, const graze_report *report) {
    graze_status status = check_reals(p, 8, report);
    if (status)
        return status;
    double r0 = p->reals[6], r1 = p->reals[7];
    int sign0 = radius_sign(r0), sign1 = radius_sign(r1);
    r0 *= sign0;
    r1 *= sign1;
    s->kind = SHAPE_RING;
    s->ring.center = real3(p->reals);
    s->ring.normal = vec3_safe_normalize(real3(p->reals + 3));
    s->ring.r0 = fmin(r0, r1);
    s->ring.r1 = fmax(r0, r1);
    if (sign0 < 0 || sign1 < 0 || s->ring.r1 - s->ring.r0 <= TINY_RADIUS) {
        rad_primitive_warning(report, p, "illegal radii; the surface is left out");
        *degenerate = true;
    } else if (!(vec3_max_abs(s->ring.normal) > 0)) {
        rad_primitive_warning(report, p, "unknown orientation; the surface is left out");
        *degenerate = true;
    }
    return GRAZE_OK;
}

graze_status shape_from_primitive(shape *s, bool *degenerate, const rad_primitive *p, arena *memory,
                                  const graze_report *report) {
    *s = (shape){0};
    *degenerate = false;
    switch (p->type) {
    case RAD_POLYGON:
        return make_polygon(s, degenerate, p, memory, report);
    case RAD_SPHERE:
    case RAD_BUBBLE:
        return make_sphere(s, degenerate, p, report);
    case RAD_CONE:
    case RAD_CUP:
    case RAD_CYLINDER:
    case RAD_TUBE:
        return make_cone(s, degenerate, p, report);
    case RAD_RING:
        return make_ring(s, degenerate, p, report);
    default:
        return rad_primitive_error(report, p, "not a surface with a shape of its own");
    }
}

/* fmin and fmax would be calls, which counts where there are millions of shapes. */
static void include_number(double x, double *lower, double *upper) {
    *lower = x < *lower ? x : *lower;
    *upper = x > *upper ? x : *upper;
}

static void include_point(vec3 point, vec3 *lower, vec3 *upper) {
    include_number(point.x, &lower->x, &upper->x);
    include_number(point.y, &lower->y, &upper->y);
    include_number(point.z, &lower->z, &upper->z);
}

static void include_disk(vec3 center, vec3 normal, double radius, vec3 *lower, vec3 *upper) {
    vec3 reach = {radius * sqrt(double_max(1 - normal.x * normal.x, 0)),
                  radius * sqrt(double_max(1 - normal.y * normal.y, 0)),
                  radius * sqrt(double_max(1 - normal.z * normal.z, 0))};
    include_point(vec3_subtract(center, reach), lower, upper);
    include_point(vec3_add(center, reach), lower, upper);
}

void shape_bounds(const shape *s, vec3 *lower, vec3 *upper) {
    *lower = vec3_make(INFINITY, INFINITY, INFINITY);
    *upper = vec3_negate(*lower);
    switch (s->kind) {
    case SHAPE_POLYGON:
        for (uint32_t i = 0; i < s->polygon.vertex_count; i++)
            include_point(s->polygon.vertices[i], lower, upper);
        break;
    case SHAPE_SPHERE: {
        vec3 reach = {s->sphere.radius, s->sphere.radius, s->sphere.radius};
        *lower = vec3_subtract(s->sphere.center, reach);
        *upper = vec3_add(s->sphere.center, reach);
        break;
    }
    case SHAPE_CONE:
        include_disk(s->cone.p0, s->cone.axis, s->cone.r0, lower, upper);
        include_disk(s->cone.p1, s->cone.axis, s->cone.r1, lower, upper);
        break;
    case SHAPE_RING:
        include_disk(s->ring.center, s->ring.normal, s->ring.r1, lower, upper);
        break;
    }
}

/* A point beside a cone: its height over p0 along the axis, and what leads to it from the axis. */
static double cone_height(const shape *s, vec3 point, vec3 *radial) {
    vec3 w = vec3_subtract(point, s->cone.p0);
    double height = vec3_dot(w, s->cone.axis);
    *radial = vec3_add_scaled(w, -height, s->cone.axis);
    return height;
}

static vec3 cone_normal(const shape *s, vec3 point) {
    vec3 radial;
    cone_height(s, point, &radial);
    double growth = (s->cone.r1 - s->cone.r0) / s->cone.length;
    /* A point on the axis can only be the apex, where the axis is as good as any normal. */
    return vec3_normalize(vec3_add_scaled(vec3_safe_normalize(radial), -growth, s->cone.axis));
}

vec3 shape_normal(const shape *s, vec3 point) {
    vec3 normal = {0, 0, 0};
    switch (s->kind) {
    case SHAPE_POLYGON:
        return s->polygon.normal;
    case SHAPE_RING:
        return s->ring.normal;
    case SHAPE_SPHERE:
        normal = vec3_safe_normalize(vec3_subtract(point, s->sphere.center));
        break;
    case SHAPE_CONE:
        normal = cone_normal(s, point);
        break;
    }
    return s->inward ? vec3_negate(normal) : normal;
}

static vec3 pull_to_plane(vec3 point, vec3 on_plane, vec3 normal) {
    return vec3_add_scaled(point, -vec3_dot(normal, vec3_subtract(point, on_plane)), normal);
}

static vec3 pull_to_cone(const shape *s, vec3 point) {
    vec3 radial;
    double height = fmin(fmax(cone_height(s, point, &radial), 0), s->cone.length);
    double radius = s->cone.r0 + (s->cone.r1 - s->cone.r0) * (height / s->cone.length);
    vec3 foot = vec3_add_scaled(s->cone.p0, height, s->cone.axis);
    return vec3_add_scaled(foot, radius, vec3_safe_normalize(radial));
}

vec3 shape_pull(const shape *s, vec3 point) {
    switch (s->kind) {
    case SHAPE_POLYGON:
        return pull_to_plane(point, s->polygon.center, s->polygon.normal);
    case SHAPE_RING:
        return pull_to_plane(point, s->ring.center, s->ring.normal);
    case SHAPE_SPHERE:
        return vec3_add_scaled(s->sphere.center, s->sphere.radius,
                               vec3_safe_normalize(vec3_subtract(point, s->sphere.center)));
    case SHAPE_CONE:
        return pull_to_cone(s, point);
    }
    return point;
}

double shape_area(const shape *s) {
    switch (s->kind) {
    case SHAPE_POLYGON:
        return s->polygon.area;
    case SHAPE_SPHERE:
        return 4 * PI * s->sphere.radius * s->sphere.radius;
    case SHAPE_CONE:
        return PI * (s->cone.r0 + s->cone.r1) * hypot(s->cone.length, s->cone.r1 - s->cone.r0);
    case SHAPE_RING:
        return PI * (s->ring.r1 - s->ring.r0) * (s->ring.r1 + s->ring.r0);
    }
    return 0;
}

bool shape_is_rectangle(const shape *s, shape_rectangle *r) {
    if (s->kind != SHAPE_POLYGON || s->polygon.vertex_count != 4)
        return false;
    const vec3 *p = s->polygon.vertices;
    vec3 x = vec3_subtract(p[1], p[0]), y = vec3_subtract(p[3], p[0]);
    double length_x = vec3_length(x), length_y = vec3_length(y);
    /* Far below what solid angles are promised to, and above what turning a rectangle's vertices loses. */
    const double tolerance = 1e-11;
    if (!(fabs(vec3_dot(x, y)) <= tolerance * length_x * length_y))
        return false;
    vec3 gap = vec3_subtract(vec3_subtract(p[2], p[1]), y);
    if (!(vec3_length(gap) <= tolerance * double_min(length_x, length_y)))
        return false;
    *r = (shape_rectangle){vec3_scale(1 / length_x, x), vec3_scale(1 / length_y, y), length_x, length_y};
    return true;
}

bool shape_prepare_light(shape *s, arena *memory) {
    shape_rectangle found;
    if (!shape_is_rectangle(s, &found))
        return true;
    shape_rectangle *kept = arena_allocate(memory, sizeof *kept);
    if (!kept)
        return false;
    *kept = found;
    s->polygon.rectangle = kept;
    return true;
}

uint32_t shape_vertex_count(const shape *s) {
    uint32_t count = s->polygon.vertex_count;
    for (uint32_t i = 0; i < s->polygon.triangle_count; i++)
        for (int k = 0; k < 3; k++)
            count = s->polygon.triangles[i][k] >= count ? s->polygon.triangles[i][k] + 1 : count;
    return count;
}

bool shape_turn_polygon(shape *s, arena *memory) {
    const uint32_t count = shape_vertex_count(s), outline = s->polygon.vertex_count;
    vec3 *vertices = arena_allocate(memory, count * sizeof *vertices);
    uint32_t(*triangles)[3] = arena_allocate(memory, (s->polygon.triangle_count + 1) * sizeof *triangles);
    if (!vertices || !triangles)
        return false;
    for (uint32_t i = 0; i < count; i++)
        vertices[i] = s->polygon.vertices[i < outline ? outline - 1 - i : i];
    for (uint32_t i = 0; i < s->polygon.triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t corner = s->polygon.triangles[i][2 - k];
            triangles[i][k] = corner < outline ? outline - 1 - corner : corner;
        }
    s->polygon.vertices = vertices;
    s->polygon.triangles = (const uint32_t(*)[3])triangles;
    s->polygon.normal = vec3_negate(s->polygon.normal);
    s->polygon.offset = -s->polygon.offset;
    return true;
}
