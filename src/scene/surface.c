/* Finding out what surfaces of copies are. */
#include "scene/surface.h"

#include "rad/transform.h"

/* The light that this surface is alone, or what all copies are seen as. */
static int copied_light(const graze_scene *scene, int64_t number, int seen) {
    size_t end = scene->light_count, low = scene->first_copied, high = end;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (scene->lights[middle].surface < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < end && scene->lights[low].surface == number ? (int)low : seen;
}

static scene_surface copied_surface(const graze_scene *scene, int64_t number) {
    int part = 0, copy;
    while ((copy = geometry_descend(scene->geometry, part, &number)) >= 0) {
        const scene_part *p = &scene->parts[part];
        if (p->placements[copy].replaces)
            return p->replacing[copy];
        part = p->placements[copy].group;
    }
    return scene->parts[part].surfaces[number];
}

scene_surface scene_copied_surface(const graze_scene *scene, int64_t number) {
    scene_surface surface = copied_surface(scene, number);
    if (surface.light >= 0 && scene->first_copied < scene->light_count)
        surface.light = copied_light(scene, number, surface.light);
    return surface;
}

bool scene_material_is_moved(const graze_scene *scene, int64_t number, rad_transform *transform) {
    int part = 0, copy;
    bool moved = false;
    if (number < (int64_t)scene->surface_count)
        return false;
    while ((copy = geometry_descend(scene->geometry, part, &number)) >= 0) {
        const geometry_placement *placement = &scene->parts[part].placements[copy];
        if (placement->replaces)
            return moved;
        *transform = moved ? rad_transform_then(&placement->transform, transform) : placement->transform;
        moved = true;
        part = placement->group;
    }
    return moved;
}

/* Barycentric coordinates by areas, which need no more than that the triangle has one. */
static void find_shares(const vec3 *v, vec3 point, double shares[3]) {
    vec3 normal = vec3_cross(vec3_subtract(v[1], v[0]), vec3_subtract(v[2], v[0]));
    double area = vec3_dot(normal, normal);
    for (int i = 0; i < 3; i++) {
        vec3 a = vec3_subtract(v[(i + 1) % 3], point), b = vec3_subtract(v[(i + 2) % 3], point);
        shares[i] = fmin(fmax(vec3_dot(vec3_cross(a, b), normal) / area, 0), 1);
    }
}

static void interpolate_normal(const rad_mesh *mesh, const uint32_t *corners, const double *shares,
                               const rad_transform *t, scene_mesh_point *out) {
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        vec3 normal = mesh->normals[corners[i]];
        if (vec3_max_abs(normal) == 0)
            return;
        sum = vec3_add_scaled(sum, shares[i], normal);
    }
    out->normal = vec3_safe_normalize(rad_transform_vector(t, sum));
    out->has_normal = vec3_max_abs(out->normal) > 0;
}

static void interpolate_uv(const rad_mesh *mesh, const uint32_t *corners, const double *shares, scene_mesh_point *out) {
    double u = 0, v = 0;
    for (int i = 0; i < 3; i++) {
        if (!mesh->has_uv[corners[i]])
            return;
        u += shares[i] * mesh->uv[corners[i]][0];
        v += shares[i] * mesh->uv[corners[i]][1];
    }
    out->uv[0] = u;
    out->uv[1] = v;
    out->has_uv = true;
}

scene_mesh_point scene_mesh_point_at(const graze_scene *scene, int64_t number, vec3 point) {
    scene_mesh_point out = {0};
    if (number < (int64_t)scene->surface_count)
        return out;
    geometry_origin found = geometry_find(scene->geometry, number);
    const scene_part *part = &scene->parts[found.group];
    const rad_mesh *mesh = part->mesh;
    if (!mesh || (!mesh->normals && !mesh->uv))
        return out;
    const uint32_t *corners = mesh->triangles[found.shape - part->shapes].points;
    double shares[3];
    find_shares(found.shape->polygon.vertices, rad_transform_point_back(&found.transform, point), shares);
    if (mesh->normals)
        interpolate_normal(mesh, corners, shares, &found.transform, &out);
    if (mesh->uv)
        interpolate_uv(mesh, corners, shares, &out);
    return out;
}

double scene_surface_area(const graze_scene *scene, int64_t number, bool *flat) {
    geometry_origin found = geometry_find(scene->geometry, number);
    double scale = found.copied ? found.transform.scale : 1;
    *flat = found.shape->kind == SHAPE_POLYGON;
    return shape_area(found.shape) * scale * scale;
}
