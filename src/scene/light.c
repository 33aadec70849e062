/* Lights as points see them, and sampling them. */
#include "scene/light.h"

#include "geometry/solid_angle.h"
#include "scene/source_table.h"

light_role light_role_at(const scene_light *light, double distance) {
    if (light->only_seen)
        return light->glow && light->glow_radius >= 0 && distance > light->glow_radius ? LIGHT_AMBIENT : LIGHT_NONE;
    if (!light->glow)
        return LIGHT_DIRECT;
    if (light->glow_radius < 0)
        return LIGHT_NONE;
    return distance <= light->glow_radius && light->shape ? LIGHT_DIRECT : LIGHT_AMBIENT;
}

rgb light_radiance(const scene_light *light, vec3 direction, vec3 normal) {
    if (light->shape && vec3_dot(direction, normal) >= 0)
        return rgb_gray(0);
    if (light->spot && -vec3_dot(direction, light->spot_axis) < light->spot_cosine)
        return rgb_gray(0);
    return light->radiance;
}

rgb light_radiance_at(const scene_light *light, vec3 direction, vec3 normal, double distance) {
    rgb radiance = light_radiance(light, direction, normal);
    if (!light->spot)
        return radiance;
    double part = distance / (distance + light->spot_focus);
    return rgb_scale(part * part, radiance);
}

static rgb within_range(rgb a) {
    return (rgb){fmin(fmax(a.r, 0), SCENE_LARGEST_RADIANCE), fmin(fmax(a.g, 0), SCENE_LARGEST_RADIANCE),
                 fmin(fmax(a.b, 0), SCENE_LARGEST_RADIANCE)};
}

/* To where the transform leads from. */
static void move(material_ray *ray, const rad_transform *t) {
    ray->point = rad_transform_point_back(t, ray->point);
    ray->direction = rad_transform_direction_back(t, ray->direction);
    ray->normal = rad_transform_direction_back(t, ray->normal);
    ray->distance /= t->scale;
    ray->last_distance /= t->scale;
}

rgb light_pattern_radiance(const scene_light *light, rgb radiance, vec3 point, vec3 direction, vec3 normal,
                           double distance, double travelled) {
    if (rgb_is_black(radiance))
        return radiance;
    material_ray ray = {.point = point,
                        .direction = direction,
                        .normal = light->shape ? normal : vec3_negate(direction),
                        .distance = travelled + distance,
                        .last_distance = distance};
    if (light->frame)
        move(&ray, light->frame);
    return within_range(rgb_multiply(radiance, material_modify(light->modifiers, &ray).color));
}

/* 1 - cos of the angle between unit vectors is |a - b|^2 / 2: exact for the sun's small angles. */
static bool source_contains(const scene_light *light, vec3 direction) {
    vec3 difference = vec3_subtract(direction, light->center);
    double sine = sin(light->half_angle / 2);
    return vec3_dot(difference, difference) <= 4 * sine * sine;
}

int light_source_towards(const graze_scene *scene, vec3 direction) {
    for (size_t i = scene->first_source; i < scene->first_copied; i++)
        if (source_contains(&scene->lights[i], direction))
            return (int)i;
    return -1;
}

bool light_source_shines_from(const graze_scene *scene, int index, vec3 direction) {
    const scene_light *light = &scene->lights[index];
    if (light->glow && !light->alone)
        return light_source_towards(scene, direction) == index;
    return source_contains(light, direction);
}

static light_sample draw_shape(const scene_light *light, int index, vec3 point, double travelled,
                               const double random[2]) {
    light_sample sample = {.light = -1};
    solid_angle_sample drawn = solid_angle_draw(light->shape, point, random[0], random[1]);
    if (drawn.density == 0)
        return sample;
    vec3 hit = vec3_add_scaled(point, drawn.distance, drawn.direction);
    sample.light = index;
    sample.direction = drawn.direction;
    sample.distance = drawn.distance;
    sample.density = drawn.density;
    vec3 normal = shape_normal(light->shape, hit);
    sample.radiance = light_radiance_at(light, drawn.direction, normal, drawn.distance);
    sample.radiance = light_patterned(light, sample.radiance, hit, drawn.direction, normal, drawn.distance, travelled);
    return sample;
}

light_sample light_draw(const graze_scene *scene, vec3 point, double travelled, int index, const double random[2]) {
    const scene_light *light = &scene->lights[index];
    if (light->shape)
        return draw_shape(light, index, point, travelled, random);
    light_sample sample = {.light = -1, .distance = GEOMETRY_FAR, .radiance = light->radiance};
    if (light->table) {
        sample.direction = source_table_draw(light->table, random, &sample.density);
    } else {
        sample.direction = solid_angle_draw_cone(light->center, light->half_angle, random[0], random[1]);
        sample.density = 1 / solid_angle_of_cone(light->half_angle);
    }
    if (light->glow && !light->alone && light_source_towards(scene, sample.direction) != index)
        return sample;
    sample.light = index;
    sample.radiance =
        light_patterned(light, sample.radiance, point, sample.direction, sample.direction, GEOMETRY_FAR, travelled);
    return sample;
}

double light_density(const graze_scene *scene, vec3 point, int index, vec3 direction, vec3 hit_point, vec3 hit_normal) {
    const scene_light *light = &scene->lights[index];
    if (light->shape)
        return solid_angle_density(light->shape, point, direction, hit_point, hit_normal);
    return light->table ? source_table_density(light->table, direction) : 1 / solid_angle_of_cone(light->half_angle);
}
