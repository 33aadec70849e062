/* Shapes: arguments, areas, bounds, tessellation. */
#include "geometry/make.h"

static void assert_near(double a, double b, double tolerance) {
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static void assert_vector(vec3 a, double x, double y, double z) {
    assert_near(a.x, x, 1e-15);
    assert_near(a.y, y, 1e-15);
    assert_near(a.z, z, 1e-15);
}

/* Status, existence, warnings and inwardness of a primitive. */
typedef struct checked {
    rad_type type;
    uint32_t count;
    double reals[15];
    graze_status status;
    bool degenerate;
    int warnings;
    shape_kind kind;
    bool inward;
} checked;

static const checked argument_cases[] = {
    {RAD_SPHERE, 4, {0, 0, 0, 1}, GRAZE_OK, false, 0, SHAPE_SPHERE, false},
    {RAD_BUBBLE, 4, {0, 0, 0, 1}, GRAZE_OK, false, 0, SHAPE_SPHERE, true},
    {RAD_SPHERE, 4, {0, 0, 0, -1}, GRAZE_OK, false, 1, SHAPE_SPHERE, true},
    {RAD_BUBBLE, 4, {0, 0, 0, -1}, GRAZE_OK, false, 1, SHAPE_SPHERE, false},
    {RAD_SPHERE, 4, {0, 0, 0, 0}, GRAZE_OK, true, 1, SHAPE_SPHERE, false},
    {RAD_SPHERE, 4, {0, 0, 0, 1e-6}, GRAZE_OK, true, 1, SHAPE_SPHERE, false},
    {RAD_SPHERE, 4, {0, 0, 0, 1.1e-6}, GRAZE_OK, false, 0, SHAPE_SPHERE, false},
    {RAD_SPHERE, 3, {0, 0, 0}, .status = GRAZE_INPUT_ERROR},
    {RAD_SPHERE, 5, {0, 0, 0, 1, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_SPHERE, 4, {0, NAN, 0, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_SPHERE, 4, {0, 1e71, 0, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_CYLINDER, 7, {0, 0, 0, 0, 0, 1, 1}, GRAZE_OK, false, 0, SHAPE_CONE, false},
    {RAD_TUBE, 7, {0, 0, 0, 0, 0, 1, 1}, GRAZE_OK, false, 0, SHAPE_CONE, true},
    {RAD_CYLINDER, 7, {0, 0, 0, 0, 0, 1, -1}, GRAZE_OK, false, 1, SHAPE_CONE, true},
    {RAD_TUBE, 7, {0, 0, 0, 0, 0, 1, -1}, GRAZE_OK, false, 1, SHAPE_CONE, false},
    {RAD_CYLINDER, 7, {0, 0, 0, 0, 0, 1, 1e-7}, GRAZE_OK, true, 1, SHAPE_CONE, false},
    {RAD_CYLINDER, 7, {1, 2, 3, 1, 2, 3, 1}, GRAZE_OK, true, 1, SHAPE_CONE, false},
    {RAD_CYLINDER, 8, {0, 0, 0, 0, 0, 1, 1, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_CONE, 7, {0, 0, 0, 0, 0, 1, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_CONE, 8, {0, 0, 0, 0, 0, 1, 1, 0}, GRAZE_OK, false, 0, SHAPE_CONE, false},
    {RAD_CUP, 8, {0, 0, 0, 0, 0, 1, 0, 2}, GRAZE_OK, false, 0, SHAPE_CONE, true},
    {RAD_CONE, 8, {0, 0, 0, 0, 0, 1, -1, -2}, GRAZE_OK, false, 1, SHAPE_CONE, true},
    {RAD_CUP, 8, {0, 0, 0, 0, 0, 1, -1, 0}, GRAZE_OK, false, 1, SHAPE_CONE, false},
    {RAD_CONE, 8, {0, 0, 0, 0, 0, 1, -1, 2}, GRAZE_OK, true, 1, SHAPE_CONE, false},
    {RAD_CONE, 8, {0, 0, 0, 0, 0, 1, 0, 0}, GRAZE_OK, true, 1, SHAPE_CONE, false},
    {RAD_CONE, 8, {0, 0, 0, 0, 0, 0, 1, 2}, GRAZE_OK, true, 1, SHAPE_CONE, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 2, 1, 2}, GRAZE_OK, false, 0, SHAPE_RING, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 2, 2, 1}, GRAZE_OK, false, 0, SHAPE_RING, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 2, 0, 1}, GRAZE_OK, false, 0, SHAPE_RING, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 2, 1, 1}, GRAZE_OK, true, 1, SHAPE_RING, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 2, -1, 0}, GRAZE_OK, true, 1, SHAPE_RING, false},
    {RAD_RING, 8, {0, 0, 0, 0, 0, 0, 0, 1}, GRAZE_OK, true, 1, SHAPE_RING, false},
    {RAD_POLYGON, 9, {0, 0, 0, 1, 0, 0, 0, 1, 0}, GRAZE_OK, false, 0, SHAPE_POLYGON, false},
    {RAD_POLYGON, 8, {0, 0, 0, 1, 0, 0, 0, 1}, .status = GRAZE_INPUT_ERROR},
    {RAD_POLYGON, 6, {0, 0, 0, 1, 0, 0}, .status = GRAZE_INPUT_ERROR},
    {RAD_POLYGON, 9, {0, 0, 0, 1, 0, 0, 2, 0, 0}, GRAZE_OK, true, 1, SHAPE_POLYGON, false},
    {RAD_POLYGON, 9, {0, 0, 0, 0.1, 0.1, 0.1, 0.7, 0.7, 0.7}, GRAZE_OK, true, 1, SHAPE_POLYGON, false},
    {RAD_POLYGON, 9, {1, 1, 1, 1, 1, 1, 1, 1, 1}, GRAZE_OK, true, 1, SHAPE_POLYGON, false},
    {RAD_POLYGON, 12, {0, 0, 0, 1, 0, 0, 1, 1, 0.1, 0, 1, 0}, GRAZE_OK, false, 1, SHAPE_POLYGON, false},
    {RAD_POLYGON, 12, {0, 0, 0, 1, 0, 0, 1, 1, 1e-6, 0, 1, 0}, GRAZE_OK, false, 0, SHAPE_POLYGON, false},
    {RAD_POLYGON, 12, {0, 0, 100, 1, 0, 100, 1, 1, 100.0003, 0, 1, 100}, GRAZE_OK, false, 0, SHAPE_POLYGON, false},
    {RAD_POLYGON, 12, {0, 0, 1, 1, 0, 1, 1, 1, 1.0003, 0, 1, 1}, GRAZE_OK, false, 1, SHAPE_POLYGON, false},
    {RAD_SOURCE, 4, {0, 0, 1, 1}, .status = GRAZE_INPUT_ERROR},
};

static void arguments_are_checked(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof argument_cases / sizeof *argument_cases; i++) {
        const checked *c = &argument_cases[i];
        shape s;
        bool degenerate;
        messages m;
        graze_status status = try_shape(&s, &degenerate, &m, c->type, c->count, c->reals);
        if (status != c->status || m.errors != (status != GRAZE_OK))
            fail_msg("case %zu: status %d, %d errors", i, status, m.errors);
        if (status != GRAZE_OK)
            continue;
        if (degenerate != c->degenerate || m.warnings != c->warnings || s.kind != c->kind || s.inward != c->inward)
            fail_msg("case %zu: degenerate %d, %d warnings, kind %d, inward %d (%s)", i, degenerate, m.warnings, s.kind,
                     s.inward, m.last);
    }
}

static void equal_radii_make_a_cylinder(void **state) {
    (void)state;
    shape s = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 2), 1, 1 + 5e-7);
    assert_true(s.cone.r0 == s.cone.r1);
    s = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 2), 1, 1 + 2e-6);
    assert_true(s.cone.r0 < s.cone.r1);
}

static void closing_vertex_is_dropped(void **state) {
    (void)state;
    vec3 v[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1e-7}};
    shape s = make_polygon(5, v);
    assert_int_equal(s.polygon.vertex_count, 4);
    assert_int_equal(s.polygon.triangle_count, 2);
    assert_vector(s.polygon.normal, 0, 0, 1);
}

static void normals_and_areas(void **state) {
    (void)state;
    shape cylinder = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 2), 1, 1);
    assert_vector(shape_normal(&cylinder, vec3_make(0.6, 0.8, 1)), 0.6, 0.8, 0);
    assert_near(shape_area(&cylinder), 4 * PI, 1e-14);
    cylinder.inward = true;
    assert_vector(shape_normal(&cylinder, vec3_make(0.6, 0.8, 1)), -0.6, -0.8, 0);
    shape cone = make_cone(vec3_make(0, 0, 0), vec3_make(0, 0, 1), 1, 0);
    assert_vector(shape_normal(&cone, vec3_make(0.5, 0, 0.5)), sqrt(0.5), 0, sqrt(0.5));
    assert_vector(shape_normal(&cone, vec3_make(0, 0, 1)), 0, 0, 1);
    assert_near(shape_area(&cone), PI * sqrt(2), 1e-14);
    shape cup = make_cone(vec3_make(0, 0, 1), vec3_make(0, 0, 0), 0, 1);
    assert_vector(shape_normal(&cup, vec3_make(0.5, 0, 0.5)), sqrt(0.5), 0, sqrt(0.5));
    shape sphere = make_sphere(vec3_make(1, 2, 3), 2);
    assert_vector(shape_normal(&sphere, vec3_make(1, 2, 5)), 0, 0, 1);
    assert_near(shape_area(&sphere), 16 * PI, 1e-13);
    shape ring = make_ring(vec3_make(0, 0, 0), vec3_make(0, -3, 0), 3, 1);
    assert_vector(shape_normal(&ring, vec3_make(2, 0, 0)), 0, -1, 0);
    assert_near(shape_area(&ring), 8 * PI, 1e-13);
}

static void bounds_hold_the_surface(void **state) {
    (void)state;
    dice d = {7};
    for (int i = 0; i < 200; i++) {
        vec3 p0 = roll_in_cube(&d, 3), p1 = roll_in_cube(&d, 3);
        double r0 = roll(&d) + 0.01, r1 = i & 1 ? 0 : roll(&d);
        shape shapes[] = {make_cone(p0, p1, r0, r1), make_ring(p0, p1, 0, r0), make_sphere(p0, r0)};
        for (int k = 0; k < 3; k++) {
            vec3 lower, upper, reached_lower = {9, 9, 9}, reached_upper = {-9, -9, -9};
            shape_bounds(&shapes[k], &lower, &upper);
            frame f = frame_around(k == 0 ? shapes[0].cone.axis : shapes[1].ring.normal);
            for (int j = 0; j < 4000; j++) {
                double angle = 2 * PI * (j / 2) / 2000;
                vec3 out = vec3_add_scaled(vec3_scale(cos(angle), f.x), sin(angle), f.y);
                vec3 p = k == 0 && j % 2 ? vec3_add_scaled(p1, r1, out) : vec3_add_scaled(p0, r0, out);
                if (k == 2)
                    p = vec3_add_scaled(p0, r0, roll_direction(&d));
                reached_lower =
                    vec3_make(fmin(reached_lower.x, p.x), fmin(reached_lower.y, p.y), fmin(reached_lower.z, p.z));
                reached_upper =
                    vec3_make(fmax(reached_upper.x, p.x), fmax(reached_upper.y, p.y), fmax(reached_upper.z, p.z));
            }
            assert_near(reached_lower.x, lower.x, 1e-2);
            assert_near(reached_upper.z, upper.z, 1e-2);
            assert_true(reached_lower.x >= lower.x - 1e-14 && reached_lower.y >= lower.y - 1e-14);
            assert_true(reached_upper.y <= upper.y + 1e-14 && reached_upper.z <= upper.z + 1e-14);
        }
    }
}

/* Even-odd, by crossings of a ray to the right. */
static bool inside_outline(uint32_t n, const double *x, const double *y, double px, double py) {
    bool inside = false;
    for (uint32_t i = 0, j = n - 1; i < n; j = i++)
        if ((y[i] > py) != (y[j] > py) && px < (x[j] - x[i]) * (py - y[i]) / (y[j] - y[i]) + x[i])
            inside = !inside;
    return inside;
}

static double outline_distance(uint32_t n, const double *x, const double *y, double px, double py) {
    double least = INFINITY;
    for (uint32_t i = 0, j = n - 1; i < n; j = i++) {
        double dx = x[i] - x[j], dy = y[i] - y[j], length2 = dx * dx + dy * dy;
        double t = length2 > 0 ? ((px - x[j]) * dx + (py - y[j]) * dy) / length2 : 0;
        t = fmin(fmax(t, 0), 1);
        least = fmin(least, hypot(px - x[j] - t * dx, py - y[j] - t * dy));
    }
    return least;
}

/* In how many of the shape's triangles a point of its plane lies; all triangles must turn left around the normal. */
static int triangles_around(const shape *s, vec3 p) {
    int count = 0;
    for (uint32_t i = 0; i < s->polygon.triangle_count; i++) {
        int left = 0;
        for (int k = 0; k < 3; k++) {
            vec3 a = s->polygon.vertices[s->polygon.triangles[i][k]];
            vec3 b = s->polygon.vertices[s->polygon.triangles[i][(k + 1) % 3]];
            left += vec3_dot(s->polygon.normal, vec3_cross(vec3_subtract(b, a), vec3_subtract(p, a))) > 0;
        }
        count += left == 3;
    }
    return count;
}

static vec3 lay(const frame *f, vec3 origin, double scale, double x, double y) {
    return vec3_add_scaled(vec3_add_scaled(origin, scale * x, f->x), scale * y, f->y);
}

/* Checks a polygon's triangles against its outline in plane coordinates. */
static void check_triangles(dice *d, uint32_t n, const double *x, const double *y, double scale, double offset,
                            double area) {
    frame f = frame_around(roll_direction(d));
    vec3 origin = roll_in_cube(d, offset);
    vec3 v[OUTLINE_LIMIT];
    for (uint32_t i = 0; i < n; i++)
        v[i] = lay(&f, origin, scale, x[i], y[i]);
    shape s = make_polygon(n, v);
    double slack = 1e-14 * offset / scale + 1e-12;
    assert_near(s.polygon.area / (scale * scale), area, 10 * slack);
    assert_near(vec3_dot(s.polygon.normal, f.z), 1, slack);
    for (int i = 0; i < 200; i++) {
        double px = roll_between(d, -1, 1), py = roll_between(d, -1, 1);
        if (outline_distance(n, x, y, px, py) < 10 * slack)
            continue;
        int count = triangles_around(&s, lay(&f, origin, scale, px, py));
        /* A point on an edge between two triangles is in neither; random ones are not. */
        if (count != inside_outline(n, x, y, px, py))
            fail_msg("point (%.17g, %.17g) is in %d triangles", px, py, count);
    }
}

static double outline_area(uint32_t n, const double *x, const double *y) {
    double sum = 0;
    for (uint32_t i = 0, j = n - 1; i < n; j = i++)
        sum += x[j] * y[i] - x[i] * y[j];
    return sum / 2;
}

static void random_polygons_with_holes(void **state) {
    (void)state;
    dice d = {42};
    const double scales[] = {1e-3, 1, 1e3}, offsets[] = {1, 1e4};
    for (int i = 0; i < 600; i++) {
        double x[OUTLINE_LIMIT], y[OUTLINE_LIMIT];
        uint32_t n = roll_outline(&d, x, y);
        check_triangles(&d, n, x, y, scales[i % 3], offsets[i / 3 % 2] * scales[i % 3], outline_area(n, x, y));
    }
}

static void repeated_and_collinear_points(void **state) {
    (void)state;
    dice d = {43};
    for (int i = 0; i < 300; i++) {
        double x[OUTLINE_LIMIT], y[OUTLINE_LIMIT], more_x[OUTLINE_LIMIT], more_y[OUTLINE_LIMIT];
        uint32_t n = roll_outline(&d, x, y), more = 0;
        for (uint32_t k = 0; k < n && more < OUTLINE_LIMIT - 4; k++) {
            uint32_t next = (k + 1) % n;
            more_x[more] = x[k];
            more_y[more++] = y[k];
            if (roll(&d) < 0.3) {
                more_x[more] = x[k];
                more_y[more++] = y[k];
            }
            if (roll(&d) < 0.3) {
                more_x[more] = 0.5 * (x[k] + x[next]);
                more_y[more++] = 0.5 * (y[k] + y[next]);
            }
        }
        check_triangles(&d, more, more_x, more_y, 1, 1, outline_area(more, more_x, more_y));
    }
}

/* Squares whose sides are divided: no corner sees all other points without looking along a side. */
static void divided_squares(void **state) {
    (void)state;
    dice d = {44};
    for (int parts = 1; parts <= 5; parts++) {
        double x[OUTLINE_LIMIT], y[OUTLINE_LIMIT];
        const double corner[5][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}};
        uint32_t n = 0;
        for (int side = 0; side < 4; side++)
            for (int k = 0; k < parts; k++, n++) {
                x[n] = corner[side][0] + (corner[side + 1][0] - corner[side][0]) * k / parts;
                y[n] = corner[side][1] + (corner[side + 1][1] - corner[side][1]) * k / parts;
            }
        check_triangles(&d, n, x, y, 1, 1, 1);
    }
}

/* A pentagram's middle is surrounded twice, so it is outside; its edges cross where no vertex was given. */
static void crossing_outline(void **state) {
    (void)state;
    double x[5], y[5];
    for (int i = 0; i < 5; i++) {
        x[i] = cos(4 * PI * i / 5);
        y[i] = sin(4 * PI * i / 5);
    }
    double inner = cos(2 * PI / 5) / cos(PI / 5);
    double area = 5 * inner * sin(PI / 5) - 5 * inner * inner * sin(2 * PI / 5) / 2;
    dice d = {45};
    check_triangles(&d, 5, x, y, 1, 1, area);
}

/* Radiance's own example of a hole: the seam is two coincident edges. */
static void square_with_square_hole(void **state) {
    (void)state;
    vec3 v[] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
    shape s = make_polygon(10, v);
    assert_near(s.polygon.area, 12, 1e-14);
    assert_int_equal(triangles_around(&s, vec3_make(2, 2.1, 0)), 0);
    assert_int_equal(triangles_around(&s, vec3_make(0.5, 2.1, 0)), 1);
    assert_vector(s.polygon.normal, 0, 0, 1);
    assert_near(s.polygon.offset, 0, 0);
}

/* A star whose sides cross, so that vertices stand behind its outline: turned it is where it was. */
static void polygons_are_turned(void **state) {
    (void)state;
    vec3 v[5];
    for (int i = 0; i < 5; i++)
        v[i] = vec3_make(cos(0.8 * PI * i), sin(0.8 * PI * i), 2);
    const shape s = make_polygon(5, v);
    shape turned = s;
    assert_true(shape_vertex_count(&s) > 5);
    assert_true(shape_turn_polygon(&turned, memory));
    assert_vector(turned.polygon.normal, 0, 0, -1);
    assert_near(turned.polygon.offset, -2, 1e-15);
    assert_int_equal(shape_vertex_count(&turned), shape_vertex_count(&s));
    for (int i = 0; i < 5; i++)
        assert_memory_equal(&turned.polygon.vertices[4 - i], &v[i], sizeof *v);
    int inside = 0;
    dice d = {5};
    for (int i = 0; i < 1000; i++) {
        const vec3 point = vec3_make(2 * roll(&d) - 1, 2 * roll(&d) - 1, 2);
        const int around = triangles_around(&s, point);
        assert_int_equal(triangles_around(&turned, point), around);
        inside += around;
    }
    assert_true(inside > 100 && inside < 900);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_are_turned),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(equal_radii_make_a_cylinder),
        cmocka_unit_test(closing_vertex_is_dropped),
        cmocka_unit_test(normals_and_areas),
        cmocka_unit_test(bounds_hold_the_surface),
        cmocka_unit_test(random_polygons_with_holes),
        cmocka_unit_test(repeated_and_collinear_points),
        cmocka_unit_test(divided_squares),
        cmocka_unit_test(crossing_outline),
        cmocka_unit_test(square_with_square_hole),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
