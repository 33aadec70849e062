/* How bright lights with patterns are on the average. */
#include "scene/light_pattern.h"

#include "base/angle.h"
#include "base/even_steps.h"
#include "geometry/solid_angle.h"
#include "scene/light.h"
#include "scene/source_table.h"

/* From so many points about a shape, in so many directions each. */
enum { POINTS = 32, DIRECTIONS = 8 };

/* A light that looked black where it was looked at must still be chosen now and then. */
#define LEAST_PART 1e-3

/* Points of a sphere, evenly. */
static vec3 point_about(int i) {
    double z = 1 - 2 * (i + 0.5) / POINTS, angle = 2 * PI * even_step(i + 0.5, GOLDEN_SECTION), r = sqrt(1 - z * z);
    return vec3_make(r * cos(angle), r * sin(angle), z);
}

/* The mean over what points at some distance see of the light. */
static rgb mean_of_shape(const scene_light *light) {
    vec3 lower, upper;
    shape_bounds(light->shape, &lower, &upper);
    vec3 middle = vec3_scale(0.5, vec3_add(lower, upper));
    double distance = 3 * vec3_length(vec3_subtract(upper, lower));
    rgb sum = {0, 0, 0};
    int count = 0;
    for (int i = 0; i < POINTS * DIRECTIONS; i++) {
        vec3 point = vec3_add_scaled(middle, distance, point_about(i / DIRECTIONS));
        double u = even_step(i + 0.5, EVEN_STEP_X), v = even_step(i + 0.5, EVEN_STEP_Y);
        solid_angle_sample s = solid_angle_draw(light->shape, point, u, v);
        if (s.density == 0)
            continue;
        vec3 hit = vec3_add_scaled(point, s.distance, s.direction), normal = shape_normal(light->shape, hit);
        rgb radiance = light_radiance(light, s.direction, normal);
        sum = rgb_add(sum, light_patterned(light, radiance, hit, s.direction, normal, s.distance, 0));
        count++;
    }
    return rgb_scale(count > 0 ? 1.0 / count : 0, sum);
}

static rgb at_least(rgb mean, rgb radiance) {
    return (rgb){fmax(mean.r, LEAST_PART * radiance.r), fmax(mean.g, LEAST_PART * radiance.g),
                 fmax(mean.b, LEAST_PART * radiance.b)};
}

/* All copies are taken for as bright as the first. */
static rgb typical_of_copies(graze_scene *scene, const scene_light *light) {
    scene_light *all = &scene->lights[light->seen_as];
    if (rgb_is_black(all->typical))
        all->typical = at_least(mean_of_shape(light), light->radiance);
    return all->typical;
}

graze_status light_patterns_prepare(graze_scene *scene, int threads, const graze_report *report) {
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < scene->light_count && !status; i++) {
        scene_light *light = &scene->lights[i];
        light->typical = light->radiance;
        if (!light->modifiers)
            continue;
        if (light->only_seen) {
            light->typical = typical_of_copies(scene, light);
            continue;
        }
        rgb mean = {0, 0, 0};
        source_table *table = NULL;
        if (light->shape)
            mean = mean_of_shape(light);
        else
            status = source_table_make(&table, &mean, light, scene->memory, threads, report);
        light->table = table;
        light->typical = at_least(mean, light->radiance);
    }
    return status;
}
