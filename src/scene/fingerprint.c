/* A fingerprint of the primitives. */
#include "scene/fingerprint.h"

#include <string.h>

#include "base/fingerprint.h"

static uint64_t add_number(uint64_t f, int64_t number) {
    return fingerprint_add(f, &number, sizeof number);
}

/* With the zero byte, which keeps words apart. */
static uint64_t add_word(uint64_t f, const char *word) {
    return fingerprint_add(f, word, strlen(word) + 1);
}

static uint64_t add_primitive(uint64_t f, const rad_primitive *p) {
    f = add_number(f, p->type);
    f = add_number(f, p->modifier);
    f = add_word(f, p->id);
    f = add_number(f, p->string_count);
    for (uint32_t i = 0; i < p->string_count; i++)
        f = add_word(f, p->strings[i]);
    f = add_number(f, p->real_count);
    return fingerprint_add(f, p->reals, p->real_count * sizeof *p->reals);
}

static uint64_t add_mesh(uint64_t f, const rad_mesh *mesh) {
    size_t points = mesh->point_count;
    f = add_number(f, mesh->point_count);
    f = add_number(f, mesh->triangle_count);
    f = fingerprint_add(f, mesh->points, points * sizeof *mesh->points);
    f = fingerprint_add(f, mesh->triangles, mesh->triangle_count * sizeof *mesh->triangles);
    if (mesh->normals)
        f = fingerprint_add(f, mesh->normals, points * sizeof *mesh->normals);
    if (mesh->uv) {
        f = fingerprint_add(f, mesh->uv, points * sizeof *mesh->uv);
        f = fingerprint_add(f, mesh->has_uv, points);
    }
    return f;
}

/* Which part is behind an instance's name shows in the parts' order. */
static uint64_t add_part(uint64_t f, const rad_part *part) {
    f = add_number(f, (int64_t)part->count);
    return part->mesh ? add_mesh(f, part->mesh) : f;
}

uint64_t scene_fingerprint(const graze_scene *scene) {
    size_t count, part_count;
    const rad_primitive *primitives = rad_scene_primitives(scene->description, &count);
    const rad_part *parts = rad_scene_parts(scene->description, &part_count);
    uint64_t f = FINGERPRINT_OF_NOTHING;
    for (size_t i = 0; i < count; i++)
        f = add_primitive(f, &primitives[i]);
    for (size_t i = 0; i < part_count; i++)
        f = add_part(f, &parts[i]);
    return scene->modifiers
               ? add_number(f, (int64_t)material_library_fingerprint(material_modifiers_library(scene->modifiers)))
               : f;
}
