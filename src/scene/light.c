/* Choosing and sampling lights. */
#include "scene/light.h"

#include "base/angle.h"
#include "geometry/solid_angle.h"

light_role light_role_at(const scene_light *light, double distance) {
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

/* 1 - cos of the angle between unit vectors is |a - b|^2 / 2: exact for the sun's small angles. */
static bool source_contains(const scene_light *light, vec3 direction) {
    vec3 difference = vec3_subtract(direction, light->center);
    double sine = sin(light->half_angle / 2);
    return vec3_dot(difference, difference) <= 4 * sine * sine;
}

int light_source_towards(const graze_scene *scene, vec3 direction) {
    for (size_t i = scene->first_source; i < scene->light_count; i++)
        if (source_contains(&scene->lights[i], direction))
            return (int)i;
    return -1;
}

static double source_importance(const scene_light *light, vec3 normal) {
    double cosine = vec3_dot(light->center, normal);
    /* More than half the sky reaches above every horizon. */
    if (light->half_angle >= PI / 2)
        return light->power * fmax((1 + cosine) / 2, 0.05);
    double slack = sin(light->half_angle);
    return cosine <= -slack ? 0 : light->power * (cosine + slack) / (1 + slack);
}

/* How far the point stands in front of a flat light's plane; a curved light has no plane: +infinity. */
static double height_over_plane(const shape *s, vec3 point) {
    switch (s->kind) {
    case SHAPE_POLYGON:
        return vec3_dot(s->polygon.normal, point) - s->polygon.offset;
    case SHAPE_RING:
        return vec3_dot(s->ring.normal, vec3_subtract(point, s->ring.center));
    default:
        return INFINITY;
    }
}

/* About the irradiance that the unshadowed light gives: power x cosines / distance^2, with both cosines at the best
 * point of the light's bounding sphere, so that it is 0 only where no part of the light can contribute. */
static double shape_importance(const scene_light *light, vec3 point, vec3 normal) {
    vec3 to_light = vec3_subtract(light->center, point);
    double height = vec3_dot(to_light, normal) + light->radius;
    double plane_height = height_over_plane(light->shape, point);
    if (height <= 0 || plane_height <= 0)
        return 0;
    double distance = fmax(vec3_length(to_light), light->radius);
    double cosine = fmin(1, height / distance);
    double light_cosine = fmin(1, (plane_height + 0.1 * light->radius) / distance);
    return light->power * cosine * light_cosine / (distance * distance);
}

static double importance(const scene_light *light, const light_receiver *receiver) {
    if (light->glow && (light->glow_radius < 0 || (!receiver->ambient && light->glow_radius == 0)))
        return 0;
    return light->shape                        ? shape_importance(light, receiver->point, receiver->normal)
           : light->glow && !receiver->ambient ? 0
                                               : source_importance(light, receiver->normal);
}

void light_receiver_prepare(const graze_scene *scene, light_receiver *receiver) {
    receiver->importance = 0;
    receiver->candidates = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        double share = importance(&scene->lights[i], receiver);
        receiver->importance += share;
        receiver->candidates += share > 0;
    }
}

/* The part of the choices that is made evenly among all candidates. */
#define EVEN_PART 0.25

static double probability_of(const light_receiver *receiver, double share) {
    if (share == 0 || receiver->every)
        return share > 0;
    return (1 - EVEN_PART) * share / receiver->importance + EVEN_PART / receiver->candidates;
}

double light_probability(const graze_scene *scene, const light_receiver *receiver, int light) {
    return probability_of(receiver, importance(&scene->lights[light], receiver));
}

int light_choose(const graze_scene *scene, const light_receiver *receiver, double random, double *probability) {
    double sum = 0;
    int chosen = -1;
    for (size_t i = 0; i < scene->light_count && (chosen < 0 || random >= sum); i++) {
        double share = importance(&scene->lights[i], receiver);
        if (share == 0)
            continue;
        chosen = (int)i;
        *probability = probability_of(receiver, share);
        sum += *probability;
    }
    return chosen;
}

static light_sample draw_shape(const scene_light *light, int index, vec3 point, const double random[2]) {
    light_sample sample = {.light = -1};
    solid_angle_sample drawn = solid_angle_draw(light->shape, point, random[0], random[1]);
    if (drawn.density == 0)
        return sample;
    vec3 hit = vec3_add_scaled(point, drawn.distance, drawn.direction);
    sample.light = index;
    sample.direction = drawn.direction;
    sample.distance = drawn.distance;
    sample.density = drawn.density;
    sample.radiance = light_radiance_at(light, drawn.direction, shape_normal(light->shape, hit), drawn.distance);
    return sample;
}

light_sample light_draw(const graze_scene *scene, const light_receiver *receiver, int index, const double random[2]) {
    const scene_light *light = &scene->lights[index];
    if (light->shape)
        return draw_shape(light, index, receiver->point, random);
    light_sample sample = {.light = -1, .distance = GEOMETRY_FAR, .radiance = light->radiance};
    sample.direction = solid_angle_draw_cone(light->center, light->half_angle, random[0], random[1]);
    sample.density = 1 / solid_angle_of_cone(light->half_angle);
    if (light_source_towards(scene, sample.direction) == index)
        sample.light = index;
    return sample;
}

double light_density(const graze_scene *scene, const light_receiver *receiver, int index, vec3 direction,
                     vec3 hit_point, vec3 hit_normal) {
    const scene_light *light = &scene->lights[index];
    double probability = light_probability(scene, receiver, index);
    if (probability == 0)
        return 0;
    if (light->shape)
        return probability * solid_angle_density(light->shape, receiver->point, direction, hit_point, hit_normal);
    return probability / solid_angle_of_cone(light->half_angle);
}
