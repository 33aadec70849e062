/* Compiled meshes: materials as in frozen octrees, then patches of up to 256 points and the triangles between them. */
#include "rad/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "rad/binary_scene.h"
#include "rad/bytes.h"

enum { LOWEST_MAGIC = 8 + 311, PATCH_POINTS = 256, HAS_POINT = 1, HAS_NORMAL = 2, HAS_UV = 4 };

/* A file being read. Points are numbered by patch: what patch p has begins at starts[p]. */
typedef struct mesh_file {
    rad_bytes bytes;
    rad_linker *linker;
    vec3 origin;
    double edge;
    double uv_low[2], uv_high[2];
    rad_mesh *mesh;
    uint32_t *starts;
    uint32_t patch, patch_count;
    size_t point_capacity, triangle_capacity;
    int32_t first_material, material_count;
} mesh_file;

static graze_status fail(mesh_file *f, const char *what) {
    rad_bytes_fail(&f->bytes, "damaged: %s", what);
    return f->bytes.status;
}

static graze_status out_of_memory(const mesh_file *f) {
    return report_out_of_memory(f->linker->reader.report);
}

static double read_decimal(mesh_file *f) {
    double value = 0;
    const char *text = rad_bytes_text(&f->bytes);
    if (!f->bytes.status && !text_to_real(text, &value))
        fail(f, "its cube is not given in numbers");
    return value;
}

static void read_bounds(mesh_file *f) {
    f->origin.x = read_decimal(f);
    f->origin.y = read_decimal(f);
    f->origin.z = read_decimal(f);
    f->edge = read_decimal(f);
    if (!f->bytes.status && !(f->edge > 0))
        fail(f, "its cube has no size");
    for (int i = 0; i < 2; i++) {
        f->uv_low[i] = rad_bytes_real(&f->bytes);
        f->uv_high[i] = rad_bytes_real(&f->bytes);
    }
}

static graze_status read_materials(mesh_file *f, int object_size) {
    rad_linker *l = f->linker;
    size_t first = l->scene->count;
    graze_status status = rad_binary_scene_read(&l->reader, &f->bytes, object_size, &(rad_sink){rad_link, l});
    if (status)
        return status;
    size_t count = l->scene->count - first;
    for (size_t i = 0; i < count && !status; i++) {
        rad_primitive material = l->scene->primitives[first + i];
        if (material.type < RAD_TYPE_COUNT && rad_type_is_surface(material.type))
            return rad_primitive_error(l->reader.report, &material, "a surface among the materials of a mesh");
        status = rad_linker_append(l, &(rad_primitive){.type = RAD_POLYGON,
                                                       .modifier = (int32_t)(first + i),
                                                       .id = "M-Tri",
                                                       .original_id = "M-Tri",
                                                       .where = material.where});
    }
    f->first_material = (int32_t)first;
    f->material_count = (int32_t)count;
    return status;
}

/* Makes room for one more in an array that grows with what has been read. */
static void *make_room(void *array, size_t *capacity, size_t count, size_t size) {
    if (count < *capacity)
        return array;
    size_t wanted = *capacity ? 2 * *capacity : 512;
    void *larger = realloc(array, wanted * size);
    if (larger)
        *capacity = wanted;
    return larger;
}

static bool make_point_room(mesh_file *f, uint32_t count) {
    rad_mesh *m = f->mesh;
    size_t capacity = f->point_capacity;
    if (m->point_count + count <= capacity)
        return true;
    capacity = 2 * (capacity + PATCH_POINTS);
    vec3 *points = realloc(m->points, capacity * sizeof *points);
    if (points)
        m->points = points;
    vec3 *normals = points ? realloc(m->normals, capacity * sizeof *normals) : NULL;
    m->normals = normals ? normals : m->normals;
    double(*uv)[2] = normals ? realloc(m->uv, capacity * sizeof *uv) : NULL;
    m->uv = uv ? uv : m->uv;
    unsigned char *has_uv = uv ? realloc(m->has_uv, capacity) : NULL;
    m->has_uv = has_uv ? has_uv : m->has_uv;
    f->point_capacity = has_uv ? capacity : f->point_capacity;
    return has_uv != NULL;
}

/* A direction in 32 bits: signs, two of its coordinates' sizes in 13 bits each, of which the largest is neither, and
 * which those are. */
static vec3 decode_direction(uint32_t code) {
    const double unit = (8192 - 0.5) * sqrt(2);
    double a = (code >> 5 & 0x1fff) / unit, b = (code >> 18 & 0x1fff) / unit;
    double c = sqrt(fmax(0, 1 - a * a - b * b));
    bool first_is_x = code & 8, second_is_z = code & 16;
    vec3 v = first_is_x ? (second_is_z ? vec3_make(a, c, b) : vec3_make(a, b, c))
                        : (second_is_z ? vec3_make(c, a, b) : vec3_make(b, a, c));
    v = vec3_make(code & 1 ? -v.x : v.x, code & 2 ? -v.y : v.y, code & 4 ? -v.z : v.z);
    return vec3_normalize(v);
}

/* Cells of the cube, or of the range of texture coordinates, by their number. */
static double decode_place(uint64_t number, double low, double size) {
    return low + ((double)number + 0.5) * (size * 0x1p-32);
}

static graze_status read_points(mesh_file *f, unsigned flags, uint32_t count) {
    rad_mesh *m = f->mesh;
    rad_bytes *b = &f->bytes;
    uint32_t first = m->point_count;
    if (!make_point_room(f, count))
        return out_of_memory(f);
    for (uint32_t i = first; i < first + count; i++) {
        double x = decode_place(rad_bytes_count(b, 4), f->origin.x, f->edge);
        double y = decode_place(rad_bytes_count(b, 4), f->origin.y, f->edge);
        m->points[i] = vec3_make(x, y, decode_place(rad_bytes_count(b, 4), f->origin.z, f->edge));
        m->normals[i] = vec3_make(0, 0, 0);
        m->has_uv[i] = false;
    }
    for (uint32_t i = first; flags & HAS_NORMAL && i < first + count; i++) {
        uint32_t code = (uint32_t)rad_bytes_count(b, 4);
        if (code)
            m->normals[i] = decode_direction(code);
    }
    for (uint32_t i = first; flags & HAS_UV && i < first + count; i++) {
        uint64_t u = rad_bytes_count(b, 4), v = rad_bytes_count(b, 4);
        m->has_uv[i] = u != 0;
        m->uv[i][0] = decode_place(u, f->uv_low[0], f->uv_high[0] - f->uv_low[0]);
        m->uv[i][1] = decode_place(v, f->uv_low[1], f->uv_high[1] - f->uv_low[1]);
    }
    m->point_count += count;
    return b->status;
}

/* A triangle's points are numbered as in the file until all patches are known: patch and point, in one number. */
static graze_status add_triangle(mesh_file *f, uint64_t a, uint64_t b, uint64_t c) {
    rad_mesh *m = f->mesh;
    if (m->triangle_count == INT32_MAX)
        return fail(f, "too many triangles");
    struct rad_mesh_triangle *triangles =
        make_room(m->triangles, &f->triangle_capacity, m->triangle_count, sizeof *triangles);
    if (!triangles)
        return out_of_memory(f);
    m->triangles = triangles;
    triangles[m->triangle_count++] = (struct rad_mesh_triangle){{(uint32_t)a, (uint32_t)b, (uint32_t)c}, -1};
    return f->bytes.status;
}

static graze_status read_material(mesh_file *f, struct rad_mesh_triangle *triangle) {
    int64_t material = rad_bytes_integer(&f->bytes, 2);
    if (f->bytes.status)
        return f->bytes.status;
    if (material < -1 || material >= f->material_count)
        return fail(f, "a triangle's material is none of its materials");
    triangle->primitive = material < 0 ? -1 : f->first_material + f->material_count + (int32_t)material;
    return GRAZE_OK;
}

/* A number of triangles of one kind. */
static uint64_t read_number(mesh_file *f, uint64_t most) {
    uint64_t count = rad_bytes_count(&f->bytes, 2);
    if (!f->bytes.status && count > most)
        fail(f, "too many triangles in a patch");
    return f->bytes.status ? 0 : count;
}

static graze_status read_local_triangles(mesh_file *f) {
    rad_bytes *b = &f->bytes;
    uint64_t count = read_number(f, 2 * PATCH_POINTS), patch = (uint64_t)f->patch << 8;
    uint32_t first = f->mesh->triangle_count;
    graze_status status = b->status;
    for (uint64_t i = 0; i < count && !status; i++) {
        uint64_t p = rad_bytes_count(b, 1), q = rad_bytes_count(b, 1), r = rad_bytes_count(b, 1);
        status = add_triangle(f, patch | p, patch | q, patch | r);
    }
    if (status)
        return status;
    if (rad_bytes_count(b, 2) > 1) {
        for (uint64_t i = 0; i < count && !status; i++)
            status = read_material(f, &f->mesh->triangles[first + i]);
        return status;
    }
    struct rad_mesh_triangle all = {.primitive = -1};
    if (count == 0)
        rad_bytes_skip(b, 2);
    else
        status = read_material(f, &all);
    for (uint64_t i = 0; i < count && !status; i++)
        f->mesh->triangles[first + i].primitive = all.primitive;
    return status ? status : b->status;
}

/* Triangles of which one point, or two, are of other patches. */
static graze_status read_joining_triangles(mesh_file *f, int others) {
    rad_bytes *b = &f->bytes;
    uint64_t count = read_number(f, PATCH_POINTS), patch = (uint64_t)f->patch << 8;
    graze_status status = b->status;
    for (uint64_t i = 0; i < count && !status; i++) {
        uint64_t points[3];
        for (int k = 0; k < 3; k++)
            points[k] = k < others ? rad_bytes_count(b, 4) : patch | rad_bytes_count(b, 1);
        status = add_triangle(f, points[0], points[1], points[2]);
        if (!status)
            status = read_material(f, &f->mesh->triangles[f->mesh->triangle_count - 1]);
    }
    return status;
}

static graze_status read_patch(mesh_file *f) {
    rad_bytes *b = &f->bytes;
    unsigned flags = (unsigned)rad_bytes_count(b, 1);
    uint64_t count = rad_bytes_count(b, 2);
    if (b->status)
        return b->status;
    if (!(flags & HAS_POINT) || flags & ~(unsigned)(HAS_POINT | HAS_NORMAL | HAS_UV))
        return fail(f, "a patch with unknown flags");
    if (count < 1 || count > PATCH_POINTS)
        return fail(f, "a patch with a wrong number of points");
    f->starts[f->patch] = f->mesh->point_count;
    graze_status status = read_points(f, flags, (uint32_t)count);
    if (!status)
        status = read_local_triangles(f);
    if (!status)
        status = read_joining_triangles(f, 1);
    return status ? status : read_joining_triangles(f, 2);
}

static graze_status read_patches(mesh_file *f) {
    uint64_t count = rad_bytes_count(&f->bytes, 4);
    if (f->bytes.status)
        return f->bytes.status;
    /* A patch has 23 bytes at least, and its number 22 bits. */
    if (count > (uint64_t)(f->bytes.end - f->bytes.next) / 23 || count > 1 << 22)
        return fail(f, "more patches than the file can hold");
    f->patch_count = (uint32_t)count;
    f->starts = malloc((count + 1) * sizeof *f->starts);
    if (!f->starts)
        return out_of_memory(f);
    graze_status status = GRAZE_OK;
    for (; f->patch < count && !status; f->patch++)
        status = read_patch(f);
    f->starts[status ? 0 : count] = f->mesh->point_count;
    return status;
}

/* From patch and point to the point. */
static graze_status number_points(mesh_file *f) {
    rad_mesh *m = f->mesh;
    for (uint32_t i = 0; i < m->triangle_count; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t patch = m->triangles[i].points[k] >> 8, point = m->triangles[i].points[k] & 255;
            if (patch >= f->patch_count || point >= f->starts[patch + 1] - f->starts[patch])
                return fail(f, "a triangle's corner is none of its points");
            m->triangles[i].points[k] = f->starts[patch] + point;
        }
    return GRAZE_OK;
}

static graze_status keep(const mesh_file *f, const void *array, size_t size, void *kept) {
    void *copy = arena_allocate(f->linker->scene->memory, size);
    if (!copy)
        return out_of_memory(f);
    if (size)
        memcpy(copy, array, size);
    memcpy(kept, &copy, sizeof copy);
    return GRAZE_OK;
}

/* Into the scene's own memory, without what no point has. */
static graze_status keep_mesh(const mesh_file *f, const rad_mesh **out) {
    const rad_mesh *m = f->mesh;
    size_t points = m->point_count;
    bool normals = false, uv = false;
    for (size_t i = 0; i < points; i++) {
        normals = normals || vec3_max_abs(m->normals[i]) > 0;
        uv = uv || m->has_uv[i];
    }
    rad_mesh kept = {.point_count = m->point_count, .triangle_count = m->triangle_count};
    if (keep(f, m->points, points * sizeof *m->points, &kept.points) ||
        keep(f, m->triangles, m->triangle_count * sizeof *m->triangles, &kept.triangles) ||
        (normals && keep(f, m->normals, points * sizeof *m->normals, &kept.normals)) ||
        (uv && keep(f, m->uv, points * sizeof *m->uv, &kept.uv)) || (uv && keep(f, m->has_uv, points, &kept.has_uv)))
        return GRAZE_SYSTEM_ERROR;
    return keep(f, &kept, sizeof kept, out);
}

graze_status rad_mesh_read(const rad_mesh **out, rad_linker *linker, const whole_file *file, const place *where) {
    rad_mesh mesh = {0};
    mesh_file f = {.linker = linker, .mesh = &mesh};
    f.bytes = rad_bytes_of(file, "mesh", where, linker->reader.report);
    graze_status status = GRAZE_OK;
    if (!rad_bytes_have_format(file, "Radiance_tmesh"))
        return report_error(linker->reader.report, where, "not a compiled mesh");
    int object_size = rad_bytes_begin(&f.bytes, LOWEST_MAGIC);
    read_bounds(&f);
    rad_bytes_skip_tree(&f.bytes, object_size);
    status = f.bytes.status;
    if (!status)
        status = read_materials(&f, object_size);
    if (!status)
        status = read_patches(&f);
    if (!status)
        status = number_points(&f);
    if (!status)
        status = keep_mesh(&f, out);
    free(f.starts);
    free(mesh.points);
    free(mesh.normals);
    free(mesh.uv);
    free(mesh.has_uv);
    free(mesh.triangles);
    return status;
}
