/* Polygons cut into triangles; concave ones and those with holes by GLU's tessellator. */
#include "geometry/tessellate.h"

#include <stdlib.h>
#include <string.h>

#include "geometry/glu.h"

/* Sine of the angle below which two edges count as one straight line, and area, in squares of the polygon's extent,
 * below which a triangle counts as none: some roundings of double precision. */
#define STRAIGHT 1e-12
#define NO_AREA  1e-14
/* Outlines of no more vertices do without memory of their own. */
#define FEW 32

typedef struct point2 {
    double x, y;
} point2;

/* A polygon in its own plane, around its first vertex. */
typedef struct outline {
    const shape *polygon;
    frame axes;
    double extent;   /* largest coordinate among the points */
    uint32_t count;  /* vertices that differ from the one before them */
    uint32_t *index; /* of the shape's vertices */
    point2 *points;  /* one for each index */
    uint32_t few_index[FEW];
    point2 few_points[FEW];
} outline;

/* Triangles and the vertices beyond the outline's, as they come. */
typedef struct mesh {
    const outline *outline;
    uint32_t (*triangles)[3];
    uint32_t triangle_count, triangle_capacity;
    vec3 *extra;
    uint32_t extra_count, extra_capacity;
    uint32_t corner[3]; /* of the triangle that GLU is giving */
    int corner_count;
    bool out_of_memory;
    GLenum error;
} mesh;

static inline double cross2(point2 a, point2 b) {
    return a.x * b.y - a.y * b.x;
}
static inline double dot2(point2 a, point2 b) {
    return a.x * b.x + a.y * b.y;
}
static inline point2 subtract2(point2 a, point2 b) {
    return (point2){a.x - b.x, a.y - b.y};
}

static point2 flatten(const outline *o, vec3 vertex) {
    vec3 v = vec3_subtract(vertex, o->polygon->polygon.vertices[0]);
    return (point2){vec3_dot(v, o->axes.x), vec3_dot(v, o->axes.y)};
}

static bool has_area(const outline *o, point2 a, point2 b, point2 c) {
    return cross2(subtract2(b, a), subtract2(c, a)) > NO_AREA * o->extent * o->extent;
}

static vec3 mesh_vertex(const mesh *m, uint32_t index) {
    const shape *s = m->outline->polygon;
    /* There are indices beyond the outline only where `extra` holds their points.
     * NOLINTNEXTLINE(clang-analyzer-core.NullDereference) */
    return index < s->polygon.vertex_count ? s->polygon.vertices[index] : m->extra[index - s->polygon.vertex_count];
}

/* Room for one more in an array that grows by doubling. */
static bool mesh_reserve(mesh *m, void **array, uint32_t count, uint32_t *capacity, size_t size) {
    if (count < *capacity)
        return true;
    if (*capacity > UINT32_MAX / 4) {
        m->out_of_memory = true;
        return false;
    }
    uint32_t grown_capacity = *capacity ? 2 * *capacity : 16;
    void *grown = realloc(*array, grown_capacity * size);
    if (!grown) {
        m->out_of_memory = true;
        return false;
    }
    *array = grown;
    *capacity = grown_capacity;
    return true;
}

static uint32_t mesh_add_vertex(mesh *m, vec3 vertex) {
    void *array = m->extra;
    bool room = mesh_reserve(m, &array, m->extra_count, &m->extra_capacity, sizeof *m->extra);
    m->extra = array;
    if (!room)
        return 0;
    m->extra[m->extra_count] = vertex;
    return m->outline->polygon->polygon.vertex_count + m->extra_count++;
}

static void mesh_add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c) {
    point2 pa = flatten(m->outline, mesh_vertex(m, a));
    point2 pb = flatten(m->outline, mesh_vertex(m, b));
    point2 pc = flatten(m->outline, mesh_vertex(m, c));
    if (!has_area(m->outline, pa, pb, pc))
        return;
    void *array = m->triangles;
    bool room = mesh_reserve(m, &array, m->triangle_count, &m->triangle_capacity, sizeof *m->triangles);
    m->triangles = array;
    if (!room)
        return;
    uint32_t *triangle = m->triangles[m->triangle_count++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

/* Lays the vertices into the plane, leaving out repeated ones. */
static bool outline_make(outline *o, const shape *s) {
    uint32_t count = s->polygon.vertex_count;
    o->polygon = s;
    o->axes = frame_around(s->polygon.normal);
    o->extent = 0;
    o->count = 0;
    o->index = count > FEW ? malloc(count * sizeof *o->index) : o->few_index;
    o->points = count > FEW ? malloc(count * sizeof *o->points) : o->few_points;
    if (!o->index || !o->points)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        point2 p = flatten(o, s->polygon.vertices[i]);
        o->extent = double_max(o->extent, double_max(fabs(p.x), fabs(p.y)));
        if (o->count && p.x == o->points[o->count - 1].x && p.y == o->points[o->count - 1].y)
            continue;
        o->index[o->count] = i;
        o->points[o->count++] = p;
    }
    if (o->count > 1 && o->points[0].x == o->points[o->count - 1].x && o->points[0].y == o->points[o->count - 1].y)
        o->count--;
    return true;
}

static void outline_free(outline *o) {
    if (o->index != o->few_index)
        free(o->index);
    if (o->points != o->few_points)
        free(o->points);
}

/* Along the outline from a vertex to the next. */
static point2 outline_edge(const outline *o, uint32_t i) {
    return subtract2(o->points[i + 1 < o->count ? i + 1 : 0], o->points[i]);
}

/* Sine of the turn from one edge to the next; -1 where that turns back on itself. */
static double turn(point2 before, point2 after) {
    double sine = cross2(before, after) / sqrt(dot2(before, before) * dot2(after, after));
    return fabs(sine) <= STRAIGHT && dot2(before, after) < 0 ? -1 : sine;
}

static bool is_right(point2 edge) {
    return edge.x > 0 || (edge.x == 0 && edge.y > 0);
}

/* Convex: it never turns right, and goes round once, so that its edges point to the right in one stretch. */
static bool outline_is_convex(const outline *o) {
    int changes = 0;
    point2 last = outline_edge(o, o->count - 1);
    for (uint32_t i = 0; i < o->count; i++) {
        point2 edge = outline_edge(o, i);
        if (turn(last, edge) < -STRAIGHT)
            return false;
        changes += is_right(edge) != is_right(last);
        last = edge;
    }
    return changes == 2;
}

/* Finds a vertex between two corners, if there is one. */
static bool find_hub(const outline *o, uint32_t *hub) {
    const uint32_t n = o->count;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t before = (i + n - 1) % n, after = (i + 1) % n;
        point2 in = outline_edge(o, before), out = outline_edge(o, i);
        if (turn(out, outline_edge(o, after)) <= STRAIGHT || turn(outline_edge(o, (i + n - 2) % n), in) <= STRAIGHT)
            continue;
        *hub = i;
        return true;
    }
    return false;
}

/* A fan around a vertex between two corners: all its triangles have area. */
static bool keep_fan(const outline *o, uint32_t hub, shape *s, arena *memory) {
    const uint32_t n = o->count;
    uint32_t(*triangles)[3] = arena_allocate(memory, n * sizeof *triangles), count = 0;
    if (!triangles)
        return false;
    for (uint32_t k = 1, i = (hub + 1) % n; k + 1 < n; k++) {
        const uint32_t next = i + 1 < n ? i + 1 : 0;
        if (has_area(o, o->points[hub], o->points[i], o->points[next])) {
            triangles[count][0] = o->index[hub];
            triangles[count][1] = o->index[i];
            triangles[count++][2] = o->index[next];
        }
        i = next;
    }
    s->polygon.triangles = (const uint32_t(*)[3])triangles;
    s->polygon.triangle_count = count;
    return true;
}

/* Where no vertex will do, a fan around the middle. */
static void mesh_add_fan(mesh *m) {
    const outline *o = m->outline;
    uint32_t middle = mesh_add_vertex(m, o->polygon->polygon.center);
    for (uint32_t i = 0; i < o->count && !m->out_of_memory; i++)
        mesh_add_triangle(m, middle, o->index[i], o->index[(i + 1) % o->count]);
}

/* GLU carries a vertex as a pointer: its index and one, so that it is never null. */
static void *glu_carry(uint32_t index) {
    return (void *)((uintptr_t)index + 1);
}
static uint32_t glu_carried(const void *data) {
    return (uint32_t)((uintptr_t)data - 1);
}

static void GLAPIENTRY glu_on_vertex(void *data, void *user) {
    mesh *m = user;
    m->corner[m->corner_count++] = glu_carried(data);
    if (m->corner_count < 3)
        return;
    m->corner_count = 0;
    mesh_add_triangle(m, m->corner[0], m->corner[1], m->corner[2]);
}

/* Being asked about edges makes GLU give triangles only, no strips and fans. */
static void GLAPIENTRY glu_on_edge_flag(GLboolean flag, void *user) {
    (void)flag;
    (void)user;
}

static void GLAPIENTRY glu_on_error(GLenum error, void *user) {
    mesh *m = user;
    m->error = error;
}

/* Where the edges between the first two and the last two of four vertices cross; GLU's own answer, `rough`, is in
 * single precision. */
static point2 cross_edges(const mesh *m, void *const data[4], point2 rough) {
    point2 p[4];
    for (int i = 0; i < 4; i++) {
        if (!data[i])
            return rough;
        p[i] = flatten(m->outline, mesh_vertex(m, glu_carried(data[i])));
    }
    point2 first = subtract2(p[1], p[0]), second = subtract2(p[3], p[2]);
    double t = cross2(subtract2(p[2], p[0]), second) / cross2(first, second);
    point2 exact = {p[0].x + t * first.x, p[0].y + t * first.y};
    bool agrees = fabs(exact.x - rough.x) + fabs(exact.y - rough.y) <= 1e-5 * m->outline->extent;
    return agrees ? exact : rough;
}

/* Vertices that fall together are one; an outline that crosses itself gets a new one there. */
static void GLAPIENTRY glu_on_combine(GLdouble coordinates[3], void *data[4], GLfloat weight[4], void **made,
                                      void *user) {
    mesh *m = user;
    (void)weight;
    for (int i = 0; i < 4; i++) {
        if (!data[i])
            continue;
        point2 p = flatten(m->outline, mesh_vertex(m, glu_carried(data[i])));
        if (p.x == coordinates[0] && p.y == coordinates[1]) {
            *made = data[i];
            return;
        }
    }
    const frame *axes = &m->outline->axes;
    const shape *s = m->outline->polygon;
    point2 crossing = cross_edges(m, data, (point2){coordinates[0], coordinates[1]});
    vec3 vertex = vec3_add_scaled(s->polygon.vertices[0], crossing.x, axes->x);
    vertex = vec3_add_scaled(vertex, crossing.y, axes->y);
    *made = glu_carry(mesh_add_vertex(m, shape_pull(s, vertex)));
}

static graze_status mesh_add_by_glu(mesh *m, const rad_primitive *p, const graze_report *report) {
    const geometry_glu *g = geometry_glu_open();
    if (g->trouble[0]) {
        rad_primitive_error(report, p, "a concave polygon needs GLU's tessellator: %s", g->trouble);
        return GRAZE_SYSTEM_ERROR;
    }
    GLUtesselator *tesselator = g->new_tess();
    if (!tesselator)
        return report_out_of_memory(report);
    g->callback(tesselator, GLU_TESS_VERTEX_DATA, (_GLUfuncptr)glu_on_vertex);
    g->callback(tesselator, GLU_TESS_EDGE_FLAG_DATA, (_GLUfuncptr)glu_on_edge_flag);
    g->callback(tesselator, GLU_TESS_ERROR_DATA, (_GLUfuncptr)glu_on_error);
    g->callback(tesselator, GLU_TESS_COMBINE_DATA, (_GLUfuncptr)glu_on_combine);
    g->property(tesselator, GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    g->normal(tesselator, 0, 0, 1);
    g->begin_polygon(tesselator, m);
    g->begin_contour(tesselator);
    for (uint32_t i = 0; i < m->outline->count; i++) {
        GLdouble coordinates[3] = {m->outline->points[i].x, m->outline->points[i].y, 0};
        g->vertex(tesselator, coordinates, glu_carry(m->outline->index[i]));
    }
    g->end_contour(tesselator);
    g->end_polygon(tesselator);
    g->delete_tess(tesselator);
    if (m->error == GLU_OUT_OF_MEMORY)
        return report_out_of_memory(report);
    if (m->error)
        return rad_primitive_error(report, p, "it cannot be tessellated: %s", (const char *)g->error_string(m->error));
    return GRAZE_OK;
}

/* Moves the triangles, and the outline with the vertices behind it, to where the shape will live. */
static bool mesh_keep(const mesh *m, shape *s, arena *memory) {
    uint32_t(*triangles)[3] = arena_allocate(memory, (m->triangle_count + (size_t)1) * sizeof *triangles);
    if (!triangles)
        return false;
    if (m->triangle_count)
        memcpy(triangles, m->triangles, m->triangle_count * sizeof *triangles);
    if (m->extra_count) {
        size_t count = s->polygon.vertex_count;
        vec3 *vertices = arena_allocate(memory, (count + m->extra_count) * sizeof *vertices);
        if (!vertices)
            return false;
        memcpy(vertices, s->polygon.vertices, count * sizeof *vertices);
        memcpy(vertices + count, m->extra, m->extra_count * sizeof *vertices);
        s->polygon.vertices = vertices;
    }
    s->polygon.triangles = (const uint32_t(*)[3])triangles;
    s->polygon.triangle_count = m->triangle_count;
    return true;
}

/* The polygon is convex, or not: then by GLU. */
static graze_status keep_mesh(const outline *o, bool convex, shape *polygon, arena *memory, const rad_primitive *p,
                              const graze_report *report) {
    mesh m = {.outline = o};
    graze_status status = GRAZE_OK;
    if (convex)
        mesh_add_fan(&m);
    else if (o->count >= 3)
        status = mesh_add_by_glu(&m, p, report);
    if (status == GRAZE_OK && (m.out_of_memory || !mesh_keep(&m, polygon, memory)))
        status = report_out_of_memory(report);
    free(m.triangles);
    free(m.extra);
    return status;
}

graze_status shape_tessellate(shape *polygon, arena *memory, const rad_primitive *p, const graze_report *report) {
    outline o;
    uint32_t hub;
    graze_status status = GRAZE_OK;
    if (!outline_make(&o, polygon)) {
        status = report_out_of_memory(report);
    } else {
        bool convex = o.count >= 3 && outline_is_convex(&o);
        if (!convex || !find_hub(&o, &hub))
            status = keep_mesh(&o, convex, polygon, memory, p, report);
        else if (!keep_fan(&o, hub, polygon, memory))
            status = report_out_of_memory(report);
    }
    outline_free(&o);
    return status;
}
