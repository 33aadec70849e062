/* The shapes a scene is made of, with their double-precision parameters. */
#ifndef GEOMETRY_SHAPE_H
#define GEOMETRY_SHAPE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/vector.h"
#include "rad/scene_file.h"

typedef enum shape_kind {
    SHAPE_POLYGON, /* any simple polygon, holes by seams */
    SHAPE_SPHERE,
    SHAPE_CONE, /* the side of a truncated cone; a cylinder where both radii are equal */
    SHAPE_RING, /* a flat disk with an optional round hole */
} shape_kind;

/* A rectangle's sides: x cross y is the normal. */
typedef struct shape_rectangle {
    vec3 x, y; /* unit, along the sides from the first vertex */
    double length_x, length_y;
} shape_rectangle;

typedef struct shape {
    shape_kind kind;
    bool inward; /* bubble, cup, tube: the normal points inward */
    bool shines; /* of surfaces that coincide, one that shines is hit; to be set before geometry_build */
    bool passes; /* light may go straight through; to be set before geometry_build */
    union {
        struct {
            const vec3 *vertices;           /* the outline; more stand behind it where triangles need them */
            uint32_t vertex_count;          /* of the outline */
            const uint32_t (*triangles)[3]; /* indices of vertices; counter-clockwise around the normal */
            uint32_t triangle_count;
            vec3 normal;   /* unit, by the right-hand rule */
            vec3 center;   /* the outline's mean vertex, a point of the plane */
            double offset; /* dot(normal, center) */
            double area;
            const shape_rectangle *rectangle; /* null: not one, or not known to be, by shape_prepare_light */
        } polygon;
        struct {
            vec3 center;
            double radius;
        } sphere;
        struct {
            vec3 p0, p1;   /* ends of the axis */
            double r0, r1; /* radii there, one of them may be 0 */
            vec3 axis;     /* unit, from p0 to p1 */
            double length;
        } cone;
        struct {
            vec3 center, normal; /* unit */
            double r0, r1;       /* inner, outer radius */
        } ring;
    };
} shape;

/* Its front is on the side of the unit normal. */
typedef struct shape_plane {
    vec3 normal, point;
} shape_plane;

static inline bool shape_is_flat(const shape *s) {
    return s->kind == SHAPE_POLYGON || s->kind == SHAPE_RING;
}

/* The plane of a flat shape. */
static inline shape_plane shape_plane_of(const shape *s) {
    return s->kind == SHAPE_POLYGON ? (shape_plane){s->polygon.normal, s->polygon.center}
                                    : (shape_plane){s->ring.normal, s->ring.center};
}

/* Makes the shape of a surface primitive (not source, mesh or instance). Memory comes from the arena; vertices of
 * polygons stay where they are, among the primitive's reals. Checks arguments
 * as Radiance does: polygons without area, cones without axis, spheres of zero radius and cones or rings of illegal
 * radii are warned about and give *degenerate = true (the surface then does not exist); negative radii are warned about
 * and turn the normal; non-planar polygons are warned about. */
graze_status shape_from_primitive(shape *, bool *degenerate, const rad_primitive *, arena *, const graze_report *);

/* The triangle between three vertices, which it keeps; where these have no area, no ray meets it. */
void shape_from_triangle(shape *, const vec3 vertices[3]);

/* Finds out what drawing points of the shape asks every time. Memory comes from the arena; false: there is none. */
bool shape_prepare_light(shape *, arena *);
/* How many vertices a polygon has with those behind its outline. */
uint32_t shape_vertex_count(const shape *);
/* Turns a polygon's front to its other side, where its outline goes the other way round. Memory comes from the arena;
 * false: there is none. To be done before shape_prepare_light. */
bool shape_turn_polygon(shape *, arena *);
/* Whether the polygon is a rectangle, as far as its vertices' roundings tell. */
bool shape_is_rectangle(const shape *, shape_rectangle *);

/* Bounds: lower and upper corner, in double precision. */
void shape_bounds(const shape *, vec3 *lower, vec3 *upper);
/* The outward unit normal (inward where `inward`) at a point of the surface. */
vec3 shape_normal(const shape *, vec3 point);
/* The point of the surface (continued beyond its edges where it is flat) next to one that is already close to it. */
vec3 shape_pull(const shape *, vec3 point);
/* Surface area. */
double shape_area(const shape *);

#endif
