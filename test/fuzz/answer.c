/* Fuzz target: rays through scenes. Whatever a scene holds, it is refused, or its answers are numbers of light. */
#include <math.h>

#include "fuzz/scene_files.h"
#include "graze/scene.h"
#include "graze/trace.h"

static void check_light(rgb light) {
    MUST(isfinite(light.r) && isfinite(light.g) && isfinite(light.b));
    MUST(light.r >= 0 && light.g >= 0 && light.b >= 0);
}

static void look_around(const graze_scene *scene) {
    static const vec3 directions[] = {{0, 0, -1}, {0.6, 0, -0.8}, {-1, 0.01, -0.1}, {0.1, 1, 0.3}, {0, 0, 1}};
    graze_trace_settings settings = graze_trace_defaults();
    settings.ambient_bounces = 1;
    settings.samples = 2;
    settings.back_faces_visible = true;
    for (int i = 0; i < 5; i++) {
        const graze_ray ray = {.origin = {0.1, 0.2, 1.5}, .direction = directions[i]};
        graze_answer answer;
        graze_hit hit;
        graze_trace(scene, &settings, &ray, (uint64_t)i, &answer, &hit);
        check_light(answer.value);
        check_light(answer.standard_error);
        MUST(hit.distance >= 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int errors = 0;
    const graze_report report = {count_error, &errors};
    const char *name = "input.rad";
    if (has_large_array(data, size))
        return 0;
    set_input(name, data, size);
    graze_scene *scene;
    graze_status status = graze_scene_load(&scene, &name, 1, NULL, &report);
    check_outcome(status, scene, errors);
    if (scene)
        look_around(scene);
    graze_scene_destroy(scene);
    return 0;
}
