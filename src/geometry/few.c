/* Plates and balls of a scene of few surfaces. */
#include "geometry/few.h"

#include <stdlib.h>

#include "geometry/survey.h"

/* A parallelogram's last corner is this close to where it belongs, in sides. */
#define PARALLELOGRAM 1e-9

/* A plate's corner, and its sides from there. */
typedef struct sides {
    vec3 corner, first, second;
    double gap; /* how far a parallelogram's last corner is from where it belongs */
} sides;

static bool is_parallelogram(const shape *s, sides *found) {
    if (s->polygon.vertex_count != 4 || s->polygon.triangle_count != 2)
        return false;
    const vec3 *p = s->polygon.vertices;
    vec3 first = vec3_subtract(p[1], p[0]), second = vec3_subtract(p[3], p[0]);
    double gap = vec3_length(vec3_subtract(vec3_subtract(p[2], p[1]), second));
    *found = (sides){p[0], first, second, gap};
    return gap <= PARALLELOGRAM * double_min(vec3_length(first), vec3_length(second));
}

static int plates_of(const shape *s) {
    sides found;
    return is_parallelogram(s, &found) ? 1 : (int)s->polygon.triangle_count;
}

bool geometry_few_suffice(const geometry_tree *tree) {
    if (tree->placement_count > 0 || tree->shape_count > 2 * GEOMETRY_FEW || tree->triangle_count > 2 * GEOMETRY_FEW)
        return false;
    int plates = 0, balls = 0;
    for (size_t i = 0; i < tree->shape_count; i++)
        if (tree->shapes[i].kind == SHAPE_POLYGON)
            plates += plates_of(&tree->shapes[i]);
        else
            balls++;
    return plates <= GEOMETRY_FEW && balls <= GEOMETRY_FEW;
}

static void put(few_vec3 *of, int number, vec3 v) {
    of->x[number] = v.x;
    of->y[number] = v.y;
    of->z[number] = v.z;
}

static void add_plate(few_plates *p, int number, const shape *s, const sides *at, bool cut) {
    vec3 normal = s->polygon.normal;
    double area = vec3_dot(vec3_cross(at->first, at->second), normal);
    vec3 u = vec3_scale(1 / area, vec3_cross(at->second, normal));
    vec3 v = vec3_scale(1 / area, vec3_cross(normal, at->first));
    put(&p->normal, number, normal);
    put(&p->u, number, u);
    put(&p->v, number, v);
    p->offset[number] = s->polygon.offset;
    p->u0[number] = -vec3_dot(u, at->corner);
    p->v0[number] = -vec3_dot(v, at->corner);
    p->cut[number] = cut;
    p->blur[number] = vec3_length(u) + vec3_length(v);
    double height = vec3_dot(normal, vec3_subtract(at->corner, s->polygon.center));
    p->uneven[number] = fabs(height) + fabs(vec3_dot(normal, at->first)) + fabs(vec3_dot(normal, at->second)) + at->gap;
}

/* The plates of a polygon, by its first triangle; `number` is the first one's, the result the next one's. */
static int add_polygon(const geometry_tree *tree, int number, unsigned triangle) {
    const shape *s = &tree->shapes[tree->triangles[triangle].surface];
    few_plates *p = &tree->few->plates;
    sides at;
    bool whole = is_parallelogram(s, &at);
    const unsigned plates = whole ? 1 : s->polygon.triangle_count;
    for (unsigned i = 0; i < plates; i++, number++) {
        const geometry_triangle *t = &tree->triangles[triangle + i];
        vec3 corner = geometry_corner(tree, t, 0);
        if (!whole)
            at = (sides){corner, vec3_subtract(geometry_corner(tree, t, 1), corner),
                         vec3_subtract(geometry_corner(tree, t, 2), corner), 0};
        p->first[number] = triangle + i;
        p->count[number] = whole ? s->polygon.triangle_count : 1;
        add_plate(p, number, s, &at, !whole);
    }
    return number;
}

/* A ball around a curved surface, larger by more than the roundings of where that is met. */
static void add_ball(const geometry_tree *tree, int number) {
    const int surface = tree->curved[number];
    few_balls *b = &tree->few->balls;
    vec3 lower, upper;
    shape_bounds(&tree->shapes[surface], &lower, &upper);
    vec3 half = vec3_scale(0.5, vec3_subtract(upper, lower));
    bool round = tree->shapes[surface].kind == SHAPE_SPHERE;
    double radius = round ? tree->shapes[surface].sphere.radius : vec3_length(half);
    put(&b->center, number, vec3_add(lower, half));
    b->radius[number] = radius + 1e-9 * (radius + tree->reach[surface]);
}

static geometry_look_function *look_best(void) {
#ifdef FEW_X86_64
    if (__builtin_cpu_supports("avx2"))
        return few_look_avx2;
#endif
    return few_look_baseline;
}

graze_status geometry_few_make(geometry_tree *tree, const graze_report *report) {
    geometry_few *few = tree->few = malloc(sizeof *few);
    if (!few)
        return report_out_of_memory(report);
    *few = (geometry_few){.look = look_best()};
    unsigned triangle = 0;
    int plates = 0, balls = 0;
    for (size_t i = 0; i < tree->shape_count; i++) {
        const shape *s = &tree->shapes[i];
        if (s->kind == SHAPE_POLYGON) {
            geometry_collect_polygon(tree, (int)i, &tree->triangles[triangle]);
            if (s->polygon.triangle_count > 0)
                plates = add_polygon(tree, plates, triangle);
            triangle += s->polygon.triangle_count;
        } else {
            tree->curved[balls] = (int)i;
            add_ball(tree, balls++);
        }
    }
    for (int i = balls; i < GEOMETRY_FEW; i++)
        few->balls.radius[i] = NAN;
    few->plate_count = plates;
    few->ball_count = balls;
    return GRAZE_OK;
}
