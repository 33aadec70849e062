/* Shapes for the tests of src/geometry. */
#ifndef TEST_GEOMETRY_MAKE_H
#define TEST_GEOMETRY_MAKE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/angle.h"
#include "geometry/shape.h"
#include "support/dice.h"

/* What shapes are made in: a fixture of the whole group of tests. */
static arena *memory;

static inline int set_up(void **state) {
    (void)state;
    memory = arena_create();
    return memory ? 0 : -1;
}

static inline int tear_down(void **state) {
    (void)state;
    arena_destroy(memory);
    return 0;
}

/* What was reported: how many messages, and the last one. */
typedef struct messages {
    int warnings, errors;
    char last[512];
} messages;

static inline void messages_write(void *user, graze_severity severity, const char *text) {
    messages *m = user;
    if (severity == GRAZE_WARNING)
        m->warnings++;
    else
        m->errors++;
    strncpy(m->last, text, sizeof m->last - 1);
}

static inline graze_status try_shape(shape *s, bool *degenerate, messages *m, rad_type type, uint32_t count,
                                     const double *reals) {
    static const place where = {.file = "test.rad", .line = 1, .column = 1};
    rad_primitive p = {
        .type = type, .modifier = RAD_VOID, .id = "it", .real_count = count, .reals = reals, .where = &where};
    *m = (messages){0};
    graze_report report = {messages_write, m};
    return shape_from_primitive(s, degenerate, &p, memory, &report);
}

/* A shape that must come out without a word. */
static inline shape make_shape(rad_type type, uint32_t count, const double *reals) {
    shape s;
    bool degenerate;
    messages m;
    assert_int_equal(try_shape(&s, &degenerate, &m, type, count, reals), GRAZE_OK);
    if (m.warnings)
        fail_msg("%s", m.last);
    assert_false(degenerate);
    return s;
}

static inline shape make_polygon(uint32_t count, const vec3 *vertices) {
    double *reals = arena_allocate(memory, 3 * (size_t)count * sizeof *reals);
    assert_non_null(reals);
    for (uint32_t i = 0; i < count; i++) {
        reals[3 * i] = vertices[i].x;
        reals[3 * i + 1] = vertices[i].y;
        reals[3 * i + 2] = vertices[i].z;
    }
    shape s = make_shape(RAD_POLYGON, 3 * count, reals);
    return s;
}

static inline shape make_sphere(vec3 center, double radius) {
    return make_shape(RAD_SPHERE, 4, (double[]){center.x, center.y, center.z, radius});
}

static inline shape make_cone(vec3 p0, vec3 p1, double r0, double r1) {
    return make_shape(RAD_CONE, 8, (double[]){p0.x, p0.y, p0.z, p1.x, p1.y, p1.z, r0, r1});
}

static inline shape make_ring(vec3 center, vec3 normal, double r0, double r1) {
    return make_shape(RAD_RING, 8, (double[]){center.x, center.y, center.z, normal.x, normal.y, normal.z, r0, r1});
}

#define OUTLINE_LIMIT 256

/* A random polygon within the unit circle, with holes that seams join to the outline: a star around the origin, and
 * smaller ones turning the other way round, each inward of a vertex. Returns the number of points. */
static inline uint32_t roll_outline(dice *d, double x[OUTLINE_LIMIT], double y[OUTLINE_LIMIT]) {
    int corners = 3 + (int)(roll(d) * 30), holes = corners < 8 ? 0 : (int)(roll(d) * 5);
    double lowest = roll(d) < 0.3 ? 0.999 : 0.7; /* nearly convex ones, too */
    uint32_t n = 0;
    for (int i = 0; i < corners; i++) {
        double angle = 2 * PI * i / corners, r = roll_between(d, lowest, 1);
        double corner_x = r * cos(angle), corner_y = r * sin(angle);
        x[n] = corner_x;
        y[n++] = corner_y;
        int wanted = holes && i % (corners / holes) == 0 && i / (corners / holes) < holes;
        if (!wanted || holes > 5)
            continue;
        int hole_corners = 3 + (int)(roll(d) * 6);
        double first_x = 0, first_y = 0;
        for (int k = 0; k < hole_corners; k++) {
            double hole_angle = angle - 2 * PI * k / hole_corners, hole_r = roll_between(d, 0.05, 0.1);
            x[n] = 0.4 * cos(angle) + hole_r * cos(hole_angle);
            y[n] = 0.4 * sin(angle) + hole_r * sin(hole_angle);
            if (k == 0) {
                first_x = x[n];
                first_y = y[n];
            }
            n++;
        }
        x[n] = first_x;
        y[n++] = first_y;
        x[n] = corner_x;
        y[n++] = corner_y;
    }
    return n;
}

#endif
