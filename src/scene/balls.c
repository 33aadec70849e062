/* Which balls throw lights back, and how much of which light shines on them. */
#include "scene/balls.h"

#include "base/report.h"
#include "scene/surface.h"

/* Balls of a rougher lobe than this show lights, if at all, on half of what is seen of them. */
#define ROUGHEST 0.5
/* What reflects less in its lobe is hardly brighter where it shows a light. */
#define FAINTEST 0.02

/* Prepares the surface as it is seen from straight above. */
static bool mirrors_lights(const graze_scene *scene, size_t surface, graze_surface *seen) {
    const shape *s = &scene->shapes[surface];
    const scene_material *m = scene_material_at(scene, (int64_t)surface);
    if (s->kind != SHAPE_SPHERE || s->inward || m->kind != SCENE_REFLECTOR || m->reflector.kind >= GRAZE_GLASS)
        return false;
    const vec3 up = {0, 0, 1};
    graze_surface_prepare(seen, &m->reflector, up, up, NULL);
    if (rgb_max(seen->specular) < FAINTEST)
        return false;
    if (seen->specular_lobe == GRAZE_LOBE_MIRROR)
        return true;
    return seen->specular_lobe == GRAZE_LOBE_GLOSSY && seen->lobe.model < GRAZE_BRDF_MODEL_COUNT &&
           seen->lobe.alpha_x * seen->lobe.alpha_y < ROUGHEST * ROUGHEST;
}

static scene_ball make_ball(const graze_scene *scene, size_t surface, const graze_surface *seen) {
    const graze_material *m = &scene_material_at(scene, (int64_t)surface)->reflector;
    bool rough = seen->specular_lobe == GRAZE_LOBE_GLOSSY, turned = rough && m->has_orientation;
    return (scene_ball){
        .center = scene->shapes[surface].sphere.center,
        .radius = scene->shapes[surface].sphere.radius,
        .surface = (int)surface,
        .thrown = rgb_brightness(seen->specular),
        .roughness_u = turned  ? m->roughness_u
                       : rough ? seen->lobe.alpha_x
                               : 0,
        .roughness_v = turned  ? m->roughness_v
                       : rough ? seen->lobe.alpha_y
                               : 0,
        .has_orientation = turned && m->roughness_u != m->roughness_v,
        .orientation = m->orientation,
    };
}

static bool add_lights(scene_balls *balls, const graze_scene *scene) {
    static const light_tree as_in_scene = {.per_unit = 1};
    for (size_t i = 0; i < scene->light_count; i++) {
        const scene_light *light = &scene->lights[i];
        if (scene->light_tree.group_of[i] < 0)
            continue;
        if (balls->light_count == SCENE_BALL_LIGHTS_MOST)
            return false;
        balls->lights[balls->light_count++] = (scene_ball_light){
            .summary = light_summarize(&as_in_scene, light),
            .source = !light->shape,
            .surface = light->surface,
        };
    }
    return balls->light_count > 0;
}

static vec3 from_light(const scene_ball_light *light, vec3 point) {
    return light->source ? vec3_negate(light->summary.middle) : vec3_subtract(point, light->summary.middle);
}

static double light_on(const scene_ball_light *light, vec3 point) {
    const light_summary *l = &light->summary;
    vec3 to_point = from_light(light, point);
    double square = vec3_dot(to_point, to_point), facing = 1;
    if (l->cosine >= 0)
        facing = fmax(vec3_dot(l->axis, vec3_safe_normalize(to_point)), 0);
    return fmax(rgb_brightness(l->radiance), rgb_brightness(l->ambient)) * facing * l->area / (square + l->core);
}

/* A light that is wider, for its distance, or about the ball, is seen on much of it, and no gleam. */
#define WIDEST 0.5

static bool makes_gleam(const scene_ball_light *light, const scene_ball *ball) {
    return light->summary.radius < WIDEST * vec3_length(from_light(light, ball->center));
}

/* False: none makes a gleam. */
static bool set_lights(scene_ball *ball, const scene_balls *balls) {
    double all = 0, gleaming = 0;
    for (int k = 0; k < balls->light_count; k++) {
        const scene_ball_light *light = &balls->lights[k];
        double shines = light_on(light, ball->center);
        ball->light[k] = makes_gleam(light, ball) ? shines : 0;
        all += shines;
        gleaming += ball->light[k];
    }
    for (int k = 0; k < balls->light_count; k++)
        ball->light[k] = double_share(ball->light[k], gleaming);
    ball->thrown *= double_share(gleaming, all);
    return ball->thrown > 0;
}

/* Leaves those balls that gleam. */
static void light_balls(scene_balls *balls) {
    int kept = 0;
    for (int i = 0; i < balls->count; i++) {
        scene_ball ball = balls->of[i];
        if (set_lights(&ball, balls))
            balls->of[kept++] = ball;
    }
    balls->count = kept;
}

graze_status scene_balls_find(graze_scene *scene, const graze_report *report) {
    scene_balls found = {.count = 0};
    graze_surface seen;
    for (size_t i = 0; i < scene->surface_count; i++) {
        if (!mirrors_lights(scene, i, &seen))
            continue;
        if (found.count == SCENE_BALLS_MOST)
            return GRAZE_OK;
        found.of[found.count++] = make_ball(scene, i, &seen);
    }
    if (found.count == 0 || !add_lights(&found, scene))
        return GRAZE_OK;
    light_balls(&found);
    if (found.count == 0)
        return GRAZE_OK;
    scene_balls *balls = arena_allocate(scene->memory, sizeof *balls);
    if (!balls)
        return report_out_of_memory(report);
    *balls = found;
    scene->balls = balls;
    return GRAZE_OK;
}
