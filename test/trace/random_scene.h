/* Random scenes, rays and settings from a number: the same everywhere, in any place, size and orientation. */
#ifndef TEST_TRACE_RANDOM_SCENE_H
#define TEST_TRACE_RANDOM_SCENE_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/vector.h"
#include "graze/brdf.h"
#include "graze/trace.h"
#include "support/dice.h"

/* Where a scene stands: what it is made of is turned, perhaps mirrored, scaled and moved. */
typedef struct placement {
    frame axes;
    bool mirrored;
    double scale;
    vec3 at;
} placement;

static const placement unplaced = {.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .scale = 1};

/* Which ways of finding light can answer, with a few hundred samples and an error they know of. */
typedef enum random_kind {
    RANDOM_EASY,        /* lights that reflections meet, lobes that light samples meet: all */
    RANDOM_SMALL_LIGHT, /* lights too small for reflections to meet */
    RANDOM_SHARP_GLOSS, /* lobes too narrow for light samples to meet */
    RANDOM_KINDS
} random_kind;

enum { RANDOM_RAYS = 2, RANDOM_MATERIALS = 4, RANDOM_TEXT = 1 << 17 };

typedef struct random_scene {
    random_kind kind;
    graze_trace_settings settings;
    graze_brdf_model model;
    graze_ray rays[RANDOM_RAYS];
    placement placement;
    dice dice;
    bool open;      /* a floor and lights around, or a closed room */
    bool windows;   /* of that room, to a sky */
    bool clear;     /* light goes through some of its surfaces */
    bool functions; /* some of its materials are functions, or mixtures with void */
    int shape_count;
    vec3 targets[64]; /* places that rays aim at */
    int target_count;
    size_t length;
    char text[RANDOM_TEXT];
} random_scene;

static inline vec3 place_vector(const placement *p, vec3 v) {
    if (p->mirrored)
        v.x = -v.x;
    return frame_to_world(&p->axes, v);
}

static inline vec3 place_point(const placement *p, vec3 v) {
    return vec3_add_scaled(p->at, p->scale, place_vector(p, v));
}

__attribute__((format(printf, 2, 3))) static inline void print_scene(random_scene *s, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(s->text + s->length, RANDOM_TEXT - s->length, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= RANDOM_TEXT - s->length)
        abort();
    s->length += (size_t)length;
}

static inline void print_vector(random_scene *s, vec3 v) {
    print_scene(s, " %.17g %.17g %.17g", v.x, v.y, v.z);
}

static inline void print_point(random_scene *s, vec3 v) {
    print_vector(s, place_point(&s->placement, v));
}

static inline void print_length(random_scene *s, double length) {
    print_scene(s, " %.17g", s->placement.scale * length);
}

static inline void note_target(random_scene *s, vec3 at) {
    if (s->target_count < (int)(sizeof s->targets / sizeof *s->targets))
        s->targets[s->target_count++] = at;
}

/* A surface's first line, and how many numbers follow. */
static inline void begin_shape(random_scene *s, const char *material, const char *type, int numbers) {
    print_scene(s, "%s %s s%d 0 0 %d", material, type, s->shape_count++, numbers);
}

static inline void end_shape(random_scene *s) {
    print_scene(s, "\n");
}

static inline void print_polygon(random_scene *s, const char *material, int count, const vec3 *vertices) {
    begin_shape(s, material, "polygon", 3 * count);
    for (int i = 0; i < count; i++)
        print_point(s, vertices[s->placement.mirrored ? count - 1 - i : i]);
    end_shape(s);
}

/* In the plane of the frame's x and y; the front is the frame's z. */
static inline void add_polygon(random_scene *s, const char *material, vec3 at, const frame *f, int count,
                               double (*flat)[2]) {
    vec3 vertices[32];
    for (int i = 0; i < count; i++)
        vertices[i] = vec3_add(at, frame_to_world(f, vec3_make(flat[i][0], flat[i][1], 0)));
    print_polygon(s, material, count, vertices);
    note_target(s, vec3_scale(1.0 / 3, vec3_add(vec3_add(vertices[0], vertices[1]), vertices[2])));
}

/* Triangles, rectangles, stars, or squares with a square hole cut by a seam. */
static inline void add_flat_shape(random_scene *s, const char *material, vec3 at, vec3 normal, double size) {
    frame f = frame_around(normal);
    double flat[32][2], ratio = roll_between(&s->dice, 0.2, 1);
    int form = roll_below(&s->dice, 4), count = 0;
    if (form == 0) {
        count = 3;
    } else if (form == 1) {
        count = 5 + roll_below(&s->dice, 8);
    } else {
        static const double square[10][2] = {{-1, -1},   {1, -1},   {1, 1},   {-1, 1},   {-1, -1},
                                             {-.5, -.5}, {-.5, .5}, {.5, .5}, {.5, -.5}, {-.5, -.5}};
        count = form == 2 ? 4 : 10;
        for (int i = 0; i < count; i++) {
            flat[i][0] = size * square[i][0];
            flat[i][1] = size * square[i][1] * ratio;
        }
    }
    for (int i = 0; form < 2 && i < count; i++) {
        double angle = 2 * PI * (i + roll_between(&s->dice, 0.1, 0.9)) / count,
               radius = size * roll_between(&s->dice, 0.3, 1);
        flat[i][0] = radius * cos(angle);
        flat[i][1] = radius * sin(angle);
    }
    add_polygon(s, material, at, &f, count, flat);
}

static inline void add_ball(random_scene *s, const char *material, vec3 at, double radius, bool inward) {
    begin_shape(s, material, inward ? "bubble" : "sphere", 4);
    print_point(s, at);
    print_length(s, radius);
    end_shape(s);
    note_target(s, vec3_add_scaled(at, radius, roll_direction(&s->dice)));
}

static inline void add_ring(random_scene *s, const char *material, vec3 at, vec3 normal, double radius) {
    double hole = roll(&s->dice) < 0.5 ? 0 : radius * roll_between(&s->dice, 0.1, 0.8);
    begin_shape(s, material, "ring", 8);
    print_point(s, at);
    print_vector(s, place_vector(&s->placement, normal));
    print_length(s, hole);
    print_length(s, radius);
    end_shape(s);
    note_target(s, vec3_add_scaled(at, 0.9 * radius, vec3_perpendicular(normal)));
}

/* Cylinders, tubes, cones and cups. */
static inline void add_cone(random_scene *s, const char *material, vec3 at, double size, bool inward) {
    vec3 direction = roll_direction(&s->dice), axis = vec3_scale(size * roll_between(&s->dice, 0.3, 2), direction);
    double radius = size * roll_between(&s->dice, 0.1, 0.7),
           growth = roll_below(&s->dice, 2) ? roll_between(&s->dice, 0, 2) : 1;
    vec3 p0 = vec3_add_scaled(at, -0.5, axis), p1 = vec3_add_scaled(at, 0.5, axis);
    if (growth < 0.3)
        growth = 0;
    begin_shape(s, material,
                growth == 1 ? (inward ? "tube" : "cylinder")
                : inward    ? "cup"
                            : "cone",
                growth == 1 ? 7 : 8);
    print_point(s, p0);
    print_point(s, p1);
    print_length(s, radius);
    if (growth != 1)
        print_length(s, growth * radius);
    end_shape(s);
    note_target(s, vec3_add_scaled(at, radius * (1 + growth) / 2, vec3_perpendicular(direction)));
}

static inline void add_shape(random_scene *s, const char *material, vec3 at, double size) {
    bool inward = roll(&s->dice) < 0.3;
    switch (roll_below(&s->dice, 4)) {
    case 0:
        add_ball(s, material, at, size, inward);
        break;
    case 1:
        add_ring(s, material, at, roll_direction(&s->dice), size);
        break;
    case 2:
        add_cone(s, material, at, size, inward);
        break;
    default:
        add_flat_shape(s, material, at, roll_direction(&s->dice), size);
    }
}

static inline double roll_roughness(random_scene *s) {
    return s->kind == RANDOM_EASY          ? roll_size(&s->dice, 0.15, 1)
           : s->kind == RANDOM_SHARP_GLOSS ? roll_size(&s->dice, 1.1e-3, 0.3)
                                           : roll_size(&s->dice, 0.05, 1);
}

/* Glass, trans of all kinds, mirrors, and what is none of these but new, too. What dielectrics do only luck finds. */
static inline void add_clear_material(random_scene *s, int number) {
    static const struct {
        const char *type;
        int reals;
        bool oriented;
    } types[] = {{"glass", 3, false}, {"trans", 7, false},  {"trans", 7, false},
                 {"trans2", 8, true}, {"mirror", 3, false}, {"ashik2", 8, true}};
    int type = roll_below(&s->dice, s->kind == RANDOM_SMALL_LIGHT ? 4 : 6);
    print_scene(s, "void %s m%d", types[type].type, number);
    if (types[type].oriented) {
        print_scene(s, " 4");
        print_vector(s, place_vector(&s->placement, roll_direction(&s->dice)));
        print_scene(s, " . 0 %d", types[type].reals);
    } else {
        print_scene(s, " 0 0 %d", types[type].reals);
    }
    for (int i = 0; i < 3; i++)
        print_scene(s, " %.17g", roll_between(&s->dice, 0.3, type == 5 ? 0.5 : 0.95));
    if (type == 5) {
        for (int i = 0; i < 3; i++)
            print_scene(s, " %.17g", roll_between(&s->dice, 0.1, 0.5));
        for (int i = 0; i < 2; i++) {
            double roughness = roll_roughness(s);
            print_scene(s, " %.17g", fmin(2 / (roughness * roughness), 1e6));
        }
    } else if (types[type].reals > 3) {
        print_scene(s, " %.17g %.17g", roll_between(&s->dice, 0, 0.2), type == 1 ? 0 : roll_roughness(s));
        if (type == 3)
            print_scene(s, " %.17g", roll_roughness(s));
        print_scene(s, " %.17g %.17g", roll(&s->dice), roll(&s->dice));
    }
    print_scene(s, "\n");
}

static inline void print_color(random_scene *s, double most) {
    for (int i = 0; i < 3; i++)
        print_scene(s, " %.17g", roll_between(&s->dice, 0, most));
}

/* Of directions, Ldx is the part along a vector in the surface, by where its last three reals point, and Ldz that along
 * the normal: wherever the scene stands. Small lights are only compared where no mirror or pane shows them to those
 * that do not sample them. */
static inline void add_function_material(random_scene *s, int number) {
    bool clear = s->kind != RANDOM_SMALL_LIGHT && roll(&s->dice) < 0.5;
    switch (roll_below(&s->dice, 4)) {
    case 0:
        print_scene(s, "void transfunc m%d 2 Ldx . 0 9", number);
        print_color(s, 0.85);
        print_color(s, 0.9);
        print_vector(s, place_vector(&s->placement, roll_direction(&s->dice)));
        break;
    case 1:
        print_scene(s, "void BRTDfunc m%d 10", number);
        print_color(s, clear ? 0.2 : 0);
        print_color(s, clear ? 0.4 : 0);
        print_scene(s, " Ldx Ldx Ldz . 0 12");
        print_color(s, 0.3);
        print_color(s, 0.3);
        print_color(s, 0.3);
        print_vector(s, place_vector(&s->placement, roll_direction(&s->dice)));
        break;
    case 2:
        print_scene(s, "void WGMDfunc m%d 13 void %.17g", number, roll_between(&s->dice, 0, 0.3));
        print_scene(s, " %.17g %.17g", roll_roughness(s), roll_roughness(s));
        print_scene(s, " void %.17g", roll_between(&s->dice, 0, 0.3));
        print_scene(s, " %.17g %.17g void", clear ? 0 : roll_roughness(s), roll_roughness(s));
        print_vector(s, place_vector(&s->placement, roll_direction(&s->dice)));
        print_scene(s, " . 0 9");
        print_color(s, 0.2);
        print_color(s, 0.2);
        print_color(s, 0.2);
        break;
    default:
        print_scene(s, "void mixfunc m%d 4 m%d void %.17g . 0 0", number, number - 1, roll(&s->dice));
        break;
    }
    print_scene(s, "\n");
}

static inline void add_material(random_scene *s, int number) {
    if (number > 0 && s->functions && roll(&s->dice) < 0.7) {
        add_function_material(s, number);
        return;
    }
    if (number > 0 && s->clear && roll(&s->dice) < 0.5) {
        add_clear_material(s, number);
        return;
    }
    static const char *const types[] = {"plastic", "metal", "plastic2", "metal2"};
    int type = roll_below(&s->dice, 4);
    bool mirror = type < 2 && s->kind != RANDOM_SMALL_LIGHT && roll(&s->dice) < 0.15;
    double specularity = type % 2 ? roll_between(&s->dice, 0.1, 0.9) : roll_between(&s->dice, 0, 0.2);
    double u = mirror ? 0 : roll_roughness(s), v = type < 2 ? u : roll_roughness(s);
    print_scene(s, "void %s m%d", types[type], number);
    if (type < 2) {
        print_scene(s, " 0 0 5");
    } else {
        print_scene(s, " 4");
        print_vector(s, place_vector(&s->placement, roll_direction(&s->dice)));
        print_scene(s, " . 0 6");
    }
    for (int i = 0; i < 3; i++)
        print_scene(s, " %.17g", roll_between(&s->dice, 0, 0.85));
    print_scene(s, " %.17g %.17g", specularity, u);
    if (type >= 2)
        print_scene(s, " %.17g", v);
    print_scene(s, "\n");
}

static inline const char *roll_material(random_scene *s) {
    static const char *const names[RANDOM_MATERIALS] = {"m0", "m1", "m2", "m3"};
    return names[roll_below(&s->dice, RANDOM_MATERIALS)];
}

/* The material of a lamp; of a spotlight, that shines along `aim`. */
static inline void add_emitter(random_scene *s, int number, vec3 aim, bool flat) {
    double form = roll(&s->dice);
    double radiance[3];
    for (int i = 0; i < 3; i++)
        radiance[i] = roll_size(&s->dice, 3, 30);
    const char *type = form < 0.6 ? "light" : form < 0.85 || !flat ? "glow" : "spotlight";
    print_scene(s, "void %s l%d 0 0 %d %.17g %.17g %.17g", type, number,
                type[0] == 'l'   ? 3
                : type[0] == 'g' ? 4
                                 : 7,
                radiance[0], radiance[1], radiance[2]);
    if (type[0] == 'g') {
        double reach = roll(&s->dice);
        print_length(s, reach < 0.5 ? 0 : reach < 0.9 ? roll_between(&s->dice, 1, 8) : -1);
    } else if (type[0] == 's') {
        double focus = s->placement.scale * roll_between(&s->dice, 0.3, 3);
        print_scene(s, " %.17g", roll_between(&s->dice, 40, 170));
        print_vector(s, vec3_scale(focus, place_vector(&s->placement, aim)));
    }
    print_scene(s, "\n");
}

/* Lamps of all shapes that shine into the room, and sources where it is open. */
static inline void add_lamp(random_scene *s, int number, vec3 lower, vec3 upper, bool open) {
    char name[16];
    snprintf(name, sizeof name, "l%d", number);
    bool small = s->kind == RANDOM_SMALL_LIGHT;
    double size = small ? roll_size(&s->dice, 1e-3, 0.1) : roll_between(&s->dice, 0.4, 1.2);
    vec3 at = roll_in_box(&s->dice, lower, upper);
    vec3 inwards = vec3_normalize(vec3_subtract(vec3_scale(0.5, vec3_add(lower, upper)), at));
    vec3 normal = vec3_normalize(vec3_add_scaled(inwards, 0.7, roll_direction(&s->dice)));
    int form = roll_below(&s->dice, open ? 6 : 5);
    bool flat = form == 1 || form >= 3;
    add_emitter(s, number, normal, flat && form < 5);
    if (form == 0) {
        add_ball(s, name, at, size / 2, roll(&s->dice) < 0.1);
    } else if (form == 1) {
        add_ring(s, name, at, normal, size);
    } else if (form == 2) {
        add_cone(s, name, at, size, roll(&s->dice) < 0.2);
    } else if (form < 5) {
        add_flat_shape(s, name, at, normal, size);
    } else {
        vec3 up = vec3_normalize(vec3_add(vec3_make(0, 0, 1.2), roll_direction(&s->dice)));
        print_scene(s, "%s source s%d 0 0 4", name, s->shape_count++);
        print_vector(s, place_vector(&s->placement, up));
        print_scene(s, " %.17g\n", small ? roll_size(&s->dice, 0.1, 5) : roll_between(&s->dice, 20, 60));
    }
}

static inline vec3 box_corner(vec3 lower, vec3 upper, int corner) {
    return vec3_make(corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y, corner & 4 ? upper.z : lower.z);
}

/* A wall with an opening; of that, panes fill all or most. */
static inline void add_window(random_scene *s, const vec3 wall[4]) {
    vec3 u = vec3_subtract(wall[3], wall[0]), v = vec3_subtract(wall[1], wall[0]), around[10];
    double left = roll_between(&s->dice, 0.1, 0.4), right = roll_between(&s->dice, 0.6, 0.9),
           low = roll_between(&s->dice, 0.1, 0.4), high = roll_between(&s->dice, 0.6, 0.9);
    const double of_wall[10][2] = {{0, 0},      {0, 1},       {1, 1},        {1, 0},       {0, 0},
                                   {left, low}, {right, low}, {right, high}, {left, high}, {left, low}};
    for (int i = 0; i < 10; i++)
        around[i] = vec3_add_scaled(vec3_add_scaled(wall[0], of_wall[i][0], u), of_wall[i][1], v);
    print_polygon(s, roll_material(s), 10, around);
    print_scene(s, "void glass pane 0 0 3");
    for (int i = 0; i < 3; i++)
        print_scene(s, " %.17g", roll_between(&s->dice, 0.7, 0.95));
    print_scene(s, "\n");
    int panes = 1 + roll_below(&s->dice, 3), glazed = panes - (panes > 1 && roll(&s->dice) < 0.3);
    for (int i = 0; i < glazed; i++) {
        vec3 step = vec3_scale(1.0 / panes, vec3_subtract(around[6], around[5])),
             a = vec3_add_scaled(around[5], i, step), up = vec3_subtract(around[8], around[5]), b = vec3_add(a, step);
        print_polygon(s, "pane", 4, (vec3[]){a, b, vec3_add(b, up), vec3_add(a, up)});
    }
}

static inline void add_room(random_scene *s, vec3 lower, vec3 upper) {
    static const int faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (int face = 0; face < 6; face++) {
        vec3 corners[4];
        for (int i = 0; i < 4; i++)
            corners[i] = box_corner(lower, upper, faces[face][i]);
        if (s->windows && face == 3)
            add_window(s, corners);
        else
            print_polygon(s, roll_material(s), 4, corners);
    }
}

static inline void add_floor(random_scene *s, double half) {
    const vec3 corners[] = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
    print_polygon(s, roll_material(s), 4, corners);
}

static inline void add_sky(random_scene *s) {
    double radiance = roll(&s->dice);
    print_scene(s, "void glow sky_glow 0 0 4 %.17g %.17g %.17g 0\nsky_glow source sky 0 0 4", radiance, 0.5 * radiance,
                0.8 * radiance);
    print_vector(s, place_vector(&s->placement, vec3_make(0, 0, 1)));
    print_scene(s, " %d\n", roll(&s->dice) < 0.5 ? 180 : 360);
}

/* Of light or glow, some of them overlapping. */
static inline void add_skies(random_scene *s) {
    int skies = 1 + roll_below(&s->dice, 2);
    for (int i = 0; i < skies; i++) {
        bool glow = roll(&s->dice) < 0.7;
        double radiance = roll_between(&s->dice, 1, 10);
        vec3 towards = vec3_normalize(vec3_add(vec3_make(0, 1, 1), roll_direction(&s->dice)));
        print_scene(s, "void %s sky_glow%d 0 0 %d %.17g %.17g %.17g%s\nsky_glow%d source sky%d 0 0 4",
                    glow ? "glow" : "light", i, glow ? 4 : 3, radiance, 0.5 * radiance, 0.8 * radiance,
                    glow ? " 0" : "", i, i);
        print_vector(s, place_vector(&s->placement, towards));
        print_scene(s, " %.17g\n", roll(&s->dice) < 0.5 ? 180 : roll_between(&s->dice, 70, 360));
    }
}

/* Shapes in a box, some of them in a cluster a hundred to a thousand times smaller. */
static inline void add_shapes(random_scene *s, vec3 lower, vec3 upper) {
    vec3 cluster = roll_in_box(&s->dice, lower, upper);
    double nested = roll(&s->dice) < 0.3 ? roll_size(&s->dice, 1e-3, 1e-2) : 1;
    int count = 1 + roll_below(&s->dice, 8);
    for (int i = 0; i < count; i++) {
        bool small = nested < 1 && i < 4;
        vec3 at = small ? vec3_add_scaled(cluster, 2 * nested, roll_direction(&s->dice))
                        : roll_in_box(&s->dice, lower, upper);
        double size = small ? nested * roll_between(&s->dice, 0.3, 1) : roll_size(&s->dice, 0.05, 1.5);
        add_shape(s, roll_material(s), at, size);
    }
}

/* Towards something, from afar, from close by, or grazing the floor. */
static inline void roll_rays(random_scene *s, vec3 lower, vec3 upper) {
    for (int i = 0; i < RANDOM_RAYS; i++) {
        vec3 target = s->targets[roll_below(&s->dice, s->target_count)];
        vec3 origin = roll_in_box(&s->dice, lower, upper);
        double view = roll(&s->dice);
        if (view < 0.3) {
            target = roll_in_box(&s->dice, lower, upper);
            target.z = 0;
            origin.z =
                vec3_length(vec3_make(target.x - origin.x, target.y - origin.y, 0)) * roll_size(&s->dice, 1e-3, 0.1);
        } else if (view < 0.5) {
            double away = roll_size(&s->dice, 1e-3, 1);
            origin = vec3_add_scaled(target, away, roll_direction(&s->dice));
        }
        vec3 direction = place_vector(&s->placement, vec3_subtract(target, origin));
        s->rays[i] = (graze_ray){.origin = place_point(&s->placement, origin), .direction = direction};
    }
}

static inline void roll_settings(random_scene *s) {
    s->settings = graze_trace_defaults();
    s->settings.ambient_bounces = roll_below(&s->dice, 4);
    s->settings.quantity = roll(&s->dice) < 0.15 ? GRAZE_IRRADIANCE_HIT : GRAZE_RADIANCE;
    s->settings.back_faces_visible = roll(&s->dice) < 0.9;
    s->settings.specular_threshold = roll(&s->dice) < 0.9 ? 0 : 0.15;
    s->settings.lights_visible = roll(&s->dice) < 0.9;
    double limit = roll(&s->dice);
    s->settings.reflection_limit = limit < 0.8 ? 0 : limit < 0.9 ? 3 : -3;
    s->settings.minimum_weight = limit < 0.9 ? 1e-4 : 0.05;
    if (roll(&s->dice) < 0.2)
        s->settings.ambient_value = (graze_rgb){0.2, 0.3, 0.4};
    double model = roll(&s->dice);
    s->model = model < 0.8 ? GRAZE_BRDF_GMD : (graze_brdf_model)roll_below(&s->dice, GRAZE_BRDF_MODEL_COUNT);
}

/* The scene of that number, placed as told. */
static inline void random_scene_make(random_scene *s, uint64_t number, placement where) {
    *s = (random_scene){.placement = where, .dice = {(number + 1) * 0x9E3779B97F4A7C15u}};
    for (int i = 0; i < 4; i++)
        (void)roll(&s->dice);
    s->kind = (random_kind)(number % RANDOM_KINDS);
    roll_settings(s);
    s->clear = number % 7 < 2;
    s->functions = number % 7 == 3;
    for (int i = 0; i < RANDOM_MATERIALS; i++)
        add_material(s, i);
    bool open = s->open = roll(&s->dice) < 0.4;
    vec3 upper = roll_in_box(&s->dice, vec3_make(1.5, 1.5, 2), vec3_make(5, 5, 4));
    vec3 lower = {-upper.x, -upper.y, 0};
    s->windows = !open && s->kind != RANDOM_SMALL_LIGHT && number % 5 == 1;
    if (open)
        add_floor(s, 20);
    else
        add_room(s, lower, upper);
    if (open && s->kind != RANDOM_SMALL_LIGHT && roll(&s->dice) < 0.5)
        add_sky(s);
    if (s->windows)
        add_skies(s);
    add_shapes(s, lower, upper);
    int lamps = 1 + roll_below(&s->dice, 3) + (roll(&s->dice) < 0.1 ? 8 : 0);
    for (int i = 0; i < lamps; i++)
        add_lamp(s, i, lower, upper, open);
    roll_rays(s, lower, upper);
}

/* Anywhere, from a tenth of the size to a thousand times it. */
static inline placement random_placement(dice *d) {
    placement p = {.mirrored = roll(d) < 0.5, .scale = roll_size(d, 0.1, 1e3)};
    p.axes = frame_around(roll_direction(d));
    double away = p.scale * roll_size(d, 0.1, 1e4);
    p.at = vec3_scale(away, roll_direction(d));
    return p;
}

#endif
