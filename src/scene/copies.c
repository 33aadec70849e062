/* What instances and meshes are copies of: surfaces that are there once. */
#include <stdlib.h>

#include "scene/ambient_choice.h"
#include "scene/shapes.h"

/* A light that only is seen: in copies and mixtures there are no others, as in Radiance. Made once for each material;
 * its number, or -1 where it is black. */
static int seen_light(scene_builder *b, int material, const shape *s, const rad_primitive *surface, bool mixed) {
    graze_scene *scene = b->scene;
    scene_material *m = &scene->materials[material];
    if (m->seen_light >= 0 || rgb_is_black(m->light.radiance))
        return m->seen_light;
    if (!m->light.glow || m->light.glow_radius > 0)
        rad_primitive_warning(b->report, surface,
                              "shines, but lights nothing%s: what is in %s is seen only, as in Radiance",
                              m->light.glow ? " within its radius" : "", mixed ? "a mixture" : "an octree or a mesh");
    m->seen_light = (int)(scene->light_count + scene->seen_light_count++);
    scene_light *light = &scene->lights[m->seen_light];
    *light = m->light;
    light->only_seen = true;
    light->shape = s;
    light->surface = -1;
    light->primitive = (int)(surface - scene->primitives);
    return m->seen_light;
}

void scene_add_mixed_lights(scene_builder *b) {
    graze_scene *scene = b->scene;
    for (size_t i = 0; b->mixed_lights && i < scene->surface_count; i++) {
        scene_surface *surface = &scene->surfaces[i];
        const scene_material *m = &scene->materials[surface->material];
        if (m->kind == SCENE_MIXTURE && m->shining >= 0)
            surface->light = seen_light(b, m->shining, &scene->shapes[i], &scene->primitives[surface->primitive], true);
    }
}

/* `user` is told of in messages. */
static scene_surface make_surface(scene_builder *b, int primitive, int material, const shape *s,
                                  const rad_primitive *user) {
    graze_scene *scene = b->scene;
    const int shining = scene_material_shining(scene, material);
    scene->has_mirrors = scene->has_mirrors || scene_material_shows_lights(&scene->materials[material]);
    scene->mist_in_copies = scene->mist_in_copies || scene->materials[material].mist >= 0;
    return (scene_surface){
        .primitive = primitive,
        .material = material,
        .light = shining >= 0 ? seen_light(b, shining, s, user, false) : -1,
        .no_ambient = scene_leaves_ambient_out(b->settings, scene_modifier_name(scene, primitive)),
    };
}

static void add_surface(scene_builder *b, scene_part *part, const scene_shapes *made, size_t number) {
    shape *s = &part->shapes[part->surface_count];
    int primitive = made->primitives[number], material = scene_shapes_take(b, made, number, s);
    if (material >= 0)
        part->surfaces[part->surface_count++] = make_surface(b, primitive, material, s, &made->all[primitive]);
}

static bool allocate_surfaces(scene_part *part, size_t count) {
    part->shapes = calloc(count + 1, sizeof *part->shapes);
    part->surfaces = calloc(count + 1, sizeof *part->surfaces);
    return part->shapes && part->surfaces;
}

static void add_octree(scene_builder *b, scene_part *part, const rad_part *from) {
    const rad_primitive *primitives = b->scene->primitives;
    const size_t end = from->first + from->count;
    size_t count = 0, next = 0;
    for (size_t i = from->first; i < end; i++)
        count += scene_has_shape(&primitives[i]);
    if (!allocate_surfaces(part, count)) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    scene_shapes made;
    graze_status status = scene_shapes_make(&made, b, from->first, end, part->shapes);
    if (status)
        scene_fail(b, status);
    for (size_t i = from->first; i < end && !status; i++) {
        if (scene_has_shape(&primitives[i]))
            add_surface(b, part, &made, next++);
        else if (primitives[i].type == RAD_SOURCE)
            rad_primitive_warning(b->report, &primitives[i], "a source in an instance does nothing");
    }
    scene_shapes_free(&made);
}

/* The surface of a triangle. Those without a material of their own get the mesh's modifier. */
static void add_triangle(scene_builder *b, scene_part *part, vec3 *vertices, size_t index) {
    const rad_mesh *mesh = part->mesh;
    int primitive = mesh->triangles[index].primitive;
    shape *s = &part->shapes[index];
    for (int i = 0; i < 3; i++)
        vertices[i] = mesh->points[mesh->triangles[index].points[i]];
    shape_from_triangle(s, vertices);
    part->surfaces[index] = (scene_surface){.primitive = -1, .material = -1, .light = -1};
    if (primitive < 0 || !part->own_materials)
        return;
    const rad_primitive *p = &b->scene->primitives[primitive];
    int material = scene_material_of_surface(b, p);
    if (material < 0)
        return;
    s->shines = scene_material_emits(&b->scene->materials[material]);
    s->passes = scene_material_is_pane(b->scene, &b->scene->materials[material]);
    part->surfaces[index] = make_surface(b, primitive, material, s, p);
}

static void add_mesh(scene_builder *b, scene_part *part) {
    size_t count = part->mesh->triangle_count;
    vec3 *vertices = arena_allocate(b->scene->memory, 3 * count * sizeof *vertices);
    if (!vertices || !allocate_surfaces(part, count)) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    for (size_t i = 0; i < count && b->status != GRAZE_SYSTEM_ERROR; i++)
        add_triangle(b, part, vertices + 3 * i, i);
    part->surface_count = count;
}

static bool lacks_materials(const rad_mesh *mesh) {
    for (size_t i = 0; i < mesh->triangle_count; i++)
        if (mesh->triangles[i].primitive < 0)
            return true;
    return false;
}

/* An instance's or mesh's own modifier, for all that is in it. */
static void replace_materials(scene_builder *b, geometry_placement *copy, scene_surface *replacing, int primitive,
                              const shape *any, bool in_scene) {
    graze_scene *scene = b->scene;
    const rad_primitive *p = &scene->primitives[primitive];
    int material = scene_material_of_surface(b, p);
    copy->replaces = true;
    if (material < 0)
        return;
    const scene_material *m = &scene->materials[material];
    copy->shines = scene_material_emits(m);
    copy->passes = scene_material_is_pane(scene, m);
    if (in_scene && scene_material_emits(m) && !rgb_is_black(m->light.radiance) &&
        !(m->light.glow && m->light.glow_radius <= 0))
        scene_fail(b, rad_primitive_error(b->report, p, "%s cannot be lights: its modifier is one",
                                          p->type == RAD_MESH ? "meshes" : "instances"));
    else
        *replacing = make_surface(b, primitive, material, any, p);
}

static void add_copy(scene_builder *b, size_t number, scene_part *part, const rad_copy *from) {
    graze_scene *scene = b->scene;
    const rad_primitive *p = &scene->primitives[from->primitive];
    const rad_part *of = &rad_scene_parts(scene->description, &(size_t){0})[from->part];
    size_t index = part->copy_count++;
    geometry_placement *copy = &part->placements[index];
    *copy = (geometry_placement){.group = from->part, .transform = from->transform};
    scene_part *copied = &scene->parts[from->part];
    if (p->modifier != RAD_VOID)
        replace_materials(b, copy, &part->replacing[index], from->primitive, part->shapes, number == 0);
    else if (of->mesh && !copied->own_materials && lacks_materials(of->mesh))
        scene_fail(b, rad_primitive_error(
                          b->report, p, "its modifier is void, but \"%s\" has triangles without a material", of->path));
    else
        copied->own_materials = true;
}

static void add_copies_of_part(scene_builder *b, size_t number, const rad_part *from) {
    scene_part *part = &b->scene->parts[number];
    const rad_copy *copies = rad_scene_copies(b->scene->description);
    part->placements = calloc(from->copies + 1, sizeof *part->placements);
    part->replacing = calloc(from->copies + 1, sizeof *part->replacing);
    if (!part->placements || !part->replacing) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    for (size_t i = 0; i < from->copies; i++)
        add_copy(b, number, part, &copies[from->first_copy + i]);
}

/* Users before what they use, so that it is known of meshes whether their own materials are needed. */
void scene_add_copies(scene_builder *b) {
    graze_scene *scene = b->scene;
    const rad_part *from = rad_scene_parts(scene->description, &scene->part_count);
    scene->parts = calloc(scene->part_count, sizeof *scene->parts);
    if (!scene->parts) {
        scene->part_count = 0;
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    scene->parts[0].shapes = scene->shapes;
    scene->parts[0].surfaces = scene->surfaces;
    scene->parts[0].surface_count = scene->surface_count;
    for (size_t i = 0; i < scene->part_count && b->status != GRAZE_SYSTEM_ERROR; i++) {
        scene_part *part = &scene->parts[i];
        part->mesh = from[i].mesh;
        if (part->mesh)
            add_mesh(b, part);
        else if (i > 0)
            add_octree(b, part, &from[i]);
        if (b->status != GRAZE_SYSTEM_ERROR)
            add_copies_of_part(b, i, &from[i]);
    }
}
