/* Rooms of lamps and things that stand in odd places, at any size; and shadow rays in them. */
#ifndef TEST_GEOMETRY_ROOMS_H
#define TEST_GEOMETRY_ROOMS_H

#include "geometry/make.h"

#include "geometry/geometry.h"
#include "geometry/oracle.h"
#include "geometry/shaft.h"
#include "geometry/solid_angle.h"

#define SHAPES 1500

/* A scene that grows. */
typedef struct world {
    shape shapes[SHAPES];
    int count, lights[SHAPES], light_count;
    vec3 corner; /* of the room */
    double scale;
    geometry *geometry;
} world;

/* A point of the room, which is 4 x 3 x 2.5 units. */
static inline vec3 at(const world *w, double x, double y, double z) {
    return vec3_add_scaled(w->corner, w->scale, vec3_make(x, y, z));
}

static inline int add(world *w, shape s) {
    assert_true(w->count < SHAPES);
    w->shapes[w->count] = s;
    return w->count++;
}

static inline void add_lamp(world *w, shape s) {
    s.shines = true;
    w->lights[w->light_count++] = add(w, s);
}

static inline shape quadrangle(const world *w, double c[4][3]) {
    vec3 v[4];
    for (int i = 0; i < 4; i++)
        v[i] = at(w, c[i][0], c[i][1], c[i][2]);
    return make_polygon(4, v);
}

/* An upright box's face: 0, 1: across x, 2, 3: across y, 4, 5: across z; seen from within or from outside. */
static inline shape face(const world *w, const double low[3], const double high[3], int side, bool inwards) {
    int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    double c[4][3];
    bool turned = (side % 2 == 0) != inwards;
    for (int i = 0; i < 4; i++) {
        int k = turned ? 3 - i : i;
        c[i][axis] = side % 2 ? high[axis] : low[axis];
        c[i][u] = k == 1 || k == 2 ? high[u] : low[u];
        c[i][v] = k >= 2 ? high[v] : low[v];
    }
    return quadrangle(w, c);
}

static inline void add_room(world *w) {
    for (int side = 0; side < 6; side++)
        add(w, face(w, (double[]){0, 0, 0}, (double[]){4, 3, 2.5}, side, true));
}

/* A lamp that faces down. */
static inline shape panel(const world *w, double x, double y, double z, double size) {
    return quadrangle(w, (double[4][3]){{x, y, z}, {x, y + size, z}, {x + size, y + size, z}, {x + size, y, z}});
}

static inline void add_lamps(world *w, dice *d) {
    add_lamp(w, panel(w, 0.5, 0.5, 2.5, 0.5));                       /* in the ceiling's plane, */
    add_lamp(w, panel(w, 1, 0.5, 2.5, 0.25));                        /* beside it, */
    add_lamp(w, panel(w, 0.6, 0.6, 2.5, 0.2));                       /* and within it */
    add_lamp(w, panel(w, 3.5, 2.5, 2.5, 0.5));                       /* into the room's corner */
    add_lamp(w, panel(w, 3, roll_between(d, 0, 2), 2.4999999, 0.3)); /* almost in the ceiling */
    add_lamp(w, panel(w, 2, 1, roll_between(d, 2, 2.4), 0.4));
    add_lamp(w, make_sphere(at(w, 1.5, 2.25, 2.25), 0.25 * w->scale)); /* touches the ceiling */
    add_lamp(w, make_sphere(at(w, roll_between(d, 1, 3), 1, roll_between(d, 0.5, 2)),
                            roll_between(d, 0.01, 0.2) * w->scale));
    add_lamp(w, make_ring(at(w, 2.5, 2, 2.5), vec3_make(0, 0, -1), 0.1 * w->scale, 0.3 * w->scale));
    add_lamp(w, make_ring(at(w, 0, 1.5, 1.5), roll_direction(d), 0, 0.2 * w->scale));
    vec3 middle = at(w, roll_between(d, 1, 3), roll_between(d, 1, 2), roll_between(d, 1, 2));
    frame f = frame_around(roll_direction(d));
    vec3 bent[6];
    /* An L, tilted. */
    const double l[6][2] = {{0, 0}, {0.3, 0}, {0.3, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0, 0.4}};
    for (int i = 0; i < 6; i++)
        bent[i] = vec3_add_scaled(vec3_add_scaled(middle, w->scale * l[i][0], f.x), w->scale * l[i][1], f.y);
    add_lamp(w, make_polygon(6, bent));
    /* All sides of a box. */
    for (int side = 0; side < 6; side++)
        add_lamp(w, face(w, (double[]){3.5, 0.5, 1}, (double[]){3.6, 0.6, 1.25}, side, false));
}

static inline void add_block(world *w, const double low[3], const double high[3]) {
    for (int side = 0; side < 6; side++)
        if (side != 4)
            add(w, face(w, low, high, side, false));
}

static inline void add_things(world *w, dice *d) {
    double x = roll_between(d, 0.5, 3), y = roll_between(d, 0.5, 2);
    add_block(w, (double[]){x, y, 0}, (double[]){x + 0.5, y + 0.4, roll_between(d, 0.3, 2.2)});
    add_block(w, (double[]){0, 0, 0}, (double[]){0.25, 0.25, 1});
    double r = roll_between(d, 0.1, 0.4);
    add(w, make_sphere(at(w, roll_between(d, 0.5, 3.5), roll_between(d, 0.5, 2.5), r), r * w->scale));
    x = roll_between(d, 0.5, 3.5), y = roll_between(d, 0.5, 2.5);
    add(w, make_cone(at(w, x, y, 0), at(w, x, y, 2.5), 0.1 * w->scale, roll(d) < 0.5 ? 0.1 * w->scale : 0));
    add(w, make_ring(at(w, x, y, 1), roll_direction(d), 0.15 * w->scale, 0.25 * w->scale));
    /* A sheet with two sides, that reaches from floor to ceiling. */
    x = roll_between(d, 1, 3);
    double low = roll_between(d, 0, 1), high = roll_between(d, 1.5, 3);
    double sheet[4][3] = {{x, low, 0}, {x, high, 0}, {x, high, 2.5}, {x, low, 2.5}}, back[4][3];
    for (int i = 0; i < 4; i++)
        memcpy(back[i], sheet[3 - i], sizeof back[i]);
    add(w, quadrangle(w, sheet));
    add(w, quadrangle(w, back));
    /* A mat on the floor, one almost on it, a tile beside the floor. */
    x = roll_between(d, 0.5, 3);
    add(w, quadrangle(w, (double[4][3]){{x, 1, 0}, {x + 0.5, 1, 0}, {x + 0.5, 1.5, 0}, {x, 1.5, 0}}));
    add(w, quadrangle(w, (double[4][3]){{x, 2, 1e-7}, {x + 0.5, 2, 1e-7}, {x + 0.5, 2.5, 1e-7}, {x, 2.5, 1e-7}}));
    add(w, quadrangle(w, (double[4][3]){{4, 0, 0}, {5, 0, 0}, {5, 3, 0}, {4, 3, 0}}));
}

static inline void add_tilted(world *w, dice *d) {
    for (int i = 0; i < 6; i++) {
        double x[OUTLINE_LIMIT], y[OUTLINE_LIMIT];
        uint32_t n = i % 2 ? 3 : roll_outline(d, x, y);
        vec3 middle = at(w, 4 * roll(d), 3 * roll(d), 2.5 * roll(d)), v[OUTLINE_LIMIT];
        frame f = frame_around(roll_direction(d));
        double size = w->scale * roll_between(d, 0.02, 0.3);
        for (uint32_t k = 0; k < n; k++)
            v[k] = n == 3 ? vec3_add(middle, roll_in_cube(d, size))
                          : vec3_add_scaled(vec3_add_scaled(middle, size * x[k], f.x), size * y[k], f.y);
        add(w, make_polygon(n, v));
    }
}

#define MOST_CELLS 24

/* A bumpy cloth of triangles. */
static inline void add_cloth(world *w, dice *d, int cells) {
    vec3 v[MOST_CELLS + 1][MOST_CELLS + 1];
    double x = roll_between(d, 0.5, 2.5), y = roll_between(d, 0.5, 1.5), size = 0.9 / cells;
    for (int i = 0; i <= cells; i++)
        for (int k = 0; k <= cells; k++)
            v[i][k] = at(w, x + size * i, y + size * k, roll_between(d, 0.3, 0.3 + 0.7 * size));
    for (int i = 0; i < cells; i++)
        for (int k = 0; k < cells; k++) {
            add(w, make_polygon(3, (vec3[]){v[i][k], v[i + 1][k], v[i + 1][k + 1]}));
            add(w, make_polygon(3, (vec3[]){v[i][k], v[i + 1][k + 1], v[i][k + 1]}));
        }
}

static inline void build(world *w) {
    messages m = {0};
    graze_report report = {messages_write, &m};
    const geometry_group scene = {.shapes = w->shapes, .shape_count = (size_t)w->count};
    if (geometry_build(&w->geometry, &scene, 1, 1, &report) != GRAZE_OK)
        fail_msg("%s", m.last);
    assert_int_equal(geometry_prepare_sights(w->geometry, &report), GRAZE_OK);
}

/* In random places, sizes from micrometres to kilometres. */
static inline void place_world(world *w, dice *d) {
    *w = (world){.scale = pow(10, roll_between(d, -4, 3))};
    if (roll(d) < 0.5)
        w->corner = roll_in_cube(d, 100 * w->scale);
}

/* A point of a surface, by a ray; or a sensor's. False: the ray leaves. */
static inline bool roll_receiver(const world *w, dice *d, geometry_sight *sight) {
    geometry_ray ray = {.origin = at(w, 4 * roll(d), 3 * roll(d), 2.5 * roll(d)),
                        .direction = roll_direction(d),
                        .far = GEOMETRY_FAR,
                        .from = -1};
    sight->point = ray.origin;
    sight->normal = ray.direction;
    sight->from = -1;
    if (roll(d) < 0.1)
        return true;
    geometry_hit hit;
    if (roll(d) < 0.1) /* to an edge or corner of the room */
        ray.direction = vec3_normalize(vec3_subtract(at(w, 4, roll(d) < 0.5 ? 3 : 3 * roll(d), 0), ray.origin));
    if (!geometry_intersect(w->geometry, &ray, &hit))
        return false;
    sight->point = hit.point;
    sight->normal = vec3_dot(hit.normal, ray.direction) > 0 ? vec3_negate(hit.normal) : hit.normal;
    sight->from = hit.surface;
    return true;
}

static inline void roll_light(const world *w, dice *d, geometry_sight *sight) {
    sight->light = w->lights[(int)(roll(d) * w->light_count)];
    if (roll(d) >= 0.1)
        return;
    sight->light = -1;
    sight->axis = roll_direction(d);
    sight->half_angle = roll(d) < 0.5 ? 0.005 : roll_between(d, 0, 1.5);
}

static inline void make_empty_room(world *w, dice *d) {
    place_world(w, d);
    add_room(w);
    add_lamps(w, d);
}

/* One of four kinds, in two of which hangs a cloth of so many cells across. */
static inline void make_furnished_room(world *w, dice *d, int kind, int cells) {
    make_empty_room(w, d);
    add_things(w, d);
    if (kind % 2)
        add_tilted(w, d);
    if (kind % 4 >= 2)
        add_cloth(w, d, cells);
}

/* How often the whole light is seen or hidden as far as rays tell, and how often that was known. */
typedef struct score {
    int seen, known_seen, hidden, known_hidden;
} score;

/* How many of some shadow rays are stopped, and how many there are. */
typedef struct tally {
    int stopped, rays;
} tally;

/* Places on the light: at its edges, too. */
static inline double roll_place(dice *d) {
    double kind = roll(d);
    return kind < 0.1 ? 1e-5 : kind > 0.9 ? 1 - 1e-5 : roll(d);
}

/* At an edge that the light shares with something, either may be hit. */
static inline bool is_at_edge(const world *w, const geometry_sight *sight, vec3 direction) {
    oracle_crossing crossings[2];
    if (sight->light < 0)
        return false;
    int count = oracle_crossings(&w->shapes[sight->light], exact(sight->point), exact(direction), crossings);
    return count == 0 || crossings[0].margin < 1e-8L * w->scale;
}

static inline tally ask_rays(const world *w, dice *d, const geometry_sight *sight, int count) {
    tally t = {0, 0};
    for (int i = 0; i < count; i++) {
        solid_angle_sample s = {.distance = GEOMETRY_FAR, .density = 1};
        double u = roll_place(d), v = roll_place(d);
        if (sight->light >= 0)
            s = solid_angle_draw(&w->shapes[sight->light], sight->point, u, v);
        else
            s.direction = solid_angle_draw_cone(sight->axis, sight->half_angle, u, v);
        if (s.density == 0 || vec3_dot(s.direction, sight->normal) <= 0 || is_at_edge(w, sight, s.direction))
            continue;
        geometry_ray ray = {sight->point, s.direction, s.distance, sight->from};
        t.rays++;
        t.stopped += geometry_occluded(w->geometry, &ray, sight->light);
    }
    return t;
}

static inline void keep_score(score *sum, tally t, geometry_visibility found) {
    sum->seen += t.stopped == 0;
    sum->known_seen += t.stopped == 0 && found == GEOMETRY_CLEAR;
    sum->hidden += t.stopped == t.rays;
    sum->known_hidden += t.stopped == t.rays && found == GEOMETRY_BLOCKED;
}

static inline void assert_useful(const score *sum, double seen, double hidden) {
    if (sum->known_seen < seen * sum->seen || sum->known_hidden < hidden * sum->hidden)
        fail_msg("known: %d of %d seen, %d of %d hidden", sum->known_seen, sum->seen, sum->known_hidden, sum->hidden);
}

#endif
