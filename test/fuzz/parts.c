/* Fuzz target: compiled meshes, and octrees of instances. The first byte says which; the rest is the file. */
#include "base/vector.h"
#include "fuzz/scene_files.h"

static void check_mesh(const rad_mesh *m, size_t primitives) {
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        for (int k = 0; k < 3; k++)
            MUST(m->triangles[i].points[k] < m->point_count);
        MUST(m->triangles[i].primitive >= -1 && m->triangles[i].primitive < (int64_t)primitives);
    }
    for (uint32_t i = 0; i < m->point_count; i++) {
        MUST(vec3_max_abs(m->points[i]) < INFINITY);
        double length = m->normals ? vec3_length(m->normals[i]) : 1;
        MUST(length == 0 || fabs(length - 1) < 1e-12);
        MUST(!m->uv || !m->has_uv[i] || fabs(m->uv[i][0]) + fabs(m->uv[i][1]) < INFINITY);
    }
}

static void check_parts(const rad_scene *scene) {
    size_t part_count, count;
    const rad_part *parts = rad_scene_parts(scene, &part_count);
    const rad_copy *copies = rad_scene_copies(scene);
    (void)rad_scene_primitives(scene, &count);
    for (size_t i = 0; i < part_count; i++) {
        MUST(parts[i].first + parts[i].count <= count);
        for (size_t k = parts[i].first_copy; k < parts[i].first_copy + parts[i].copies; k++)
            MUST(copies[k].part > (int64_t)i && (size_t)copies[k].part < part_count);
        if (parts[i].mesh)
            check_mesh(parts[i].mesh, count);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const users[] = {"void mesh it 1 input.bin 0 0\n", "void instance it 1 input.bin 0 0\n"};
    int errors = 0;
    const graze_report report = {count_error, &errors};
    if (size < 1 || (data[0] % 2 && has_large_array(data + 1, size - 1)))
        return 0;
    const char *text = users[data[0] % 2], *name = "user.rad";
    set_input(name, text, strlen(text));
    rad_scene *scene;
    MUST(rad_scene_read(&scene, &name, 1, &report) == GRAZE_OK);
    set_input("input.bin", data + 1, size - 1);
    graze_status status = rad_scene_read_parts(scene, &report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST((status == GRAZE_OK) == (errors == 0));
    if (status == GRAZE_OK) {
        check_primitives(scene);
        check_parts(scene);
    }
    rad_scene_destroy(scene);
    return 0;
}
