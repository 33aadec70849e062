/* What is traced for the letters asked for. */
#include "tools/gtrace/answer.h"

#include "base/vector.h"

/* A tree's rays are printed as they are told; the last is the ray asked for. */
typedef struct tree_printer {
    const answering *answering;
    record_buffer *out;
    graze_tree_ray root;
} tree_printer;

/* What is left of a value without a part of it, but for rounding errors. */
static rgb remainder_of(rgb value, rgb part) {
    rgb rest = rgb_add_scaled(value, -1, part);
    return (rgb){fmax(0, rest.r), fmax(0, rest.g), fmax(0, rest.b)};
}

static ray_values values_of_tree_ray(const graze_tree_ray *ray) {
    return (ray_values){
        .origin = ray->origin,
        .direction = ray->direction,
        .hit = &ray->hit,
        .seen_distance = ray->hit.distance,
        .value = ray->radiance,
        .coefficient = ray->coefficient,
        .contribution = ray->contribution,
        .mirrored = ray->mirrored,
        .unmirrored = remainder_of(ray->radiance, ray->mirrored),
        .mirrored_distance = ray->mirrored_distance,
        .weight = rgb_max(ray->coefficient),
    };
}

static void print_tree_ray(void *user, const graze_tree_ray *ray) {
    tree_printer *p = user;
    const ray_output *output = &p->answering->output;
    const ray_values values = values_of_tree_ray(ray);
    p->root = *ray;
    if ((output->shadows || !ray->shadow) && modifier_list_keeps(p->answering->tree_modifiers, ray->hit.modifier))
        ray_output_append_tree_ray(output, p->out, ray->depth, &values);
}

static void answer_tree(const answering *a, const graze_ray *ray, uint64_t number, record_buffer *out) {
    tree_printer printer = {.answering = a, .out = out};
    if (graze_trace_tree(a->scene, &a->settings, ray, number, a->tree_paths, print_tree_ray, &printer, NULL))
        out->failed = true; /* out of memory, which whoever writes the buffer reports */
    const ray_values values = values_of_tree_ray(&printer.root);
    ray_output_append(&a->output, out, &values);
}

/* What a mirror shows and the rest, traced one by one: their sum is the value. */
static bool trace_parts(const answering *a, const graze_ray *ray, uint64_t number, ray_values *v, graze_hit *hit) {
    graze_trace_settings settings = a->settings;
    graze_answer mirrored, rest;
    settings.part = GRAZE_MIRRORED;
    graze_trace(a->scene, &settings, ray, number, &mirrored, hit);
    settings.part = GRAZE_UNMIRRORED;
    graze_trace(a->scene, &settings, ray, number, &rest, NULL);
    v->mirrored = mirrored.value;
    v->unmirrored = rest.value;
    v->value = rgb_add(mirrored.value, rest.value);
    v->standard_error = (rgb){hypot(mirrored.standard_error.r, rest.standard_error.r),
                              hypot(mirrored.standard_error.g, rest.standard_error.g),
                              hypot(mirrored.standard_error.b, rest.standard_error.b)};
    return mirrored.converged && rest.converged;
}

static bool trace_value(const answering *a, const graze_ray *ray, uint64_t number, ray_values *v, graze_hit *hit) {
    graze_answer answer;
    graze_trace(a->scene, &a->settings, ray, number, &answer, hit);
    v->value = v->unmirrored = answer.value;
    v->standard_error = answer.standard_error;
    return answer.converged;
}

static bool trace(const answering *a, const graze_ray *ray, uint64_t number, ray_values *v, graze_hit *hit) {
    return a->output.needs_mirror ? trace_parts(a, ray, number, v, hit) : trace_value(a, ray, number, v, hit);
}

/* A surface that is hidden from behind is passed by light, and yet it is what the ray has met first, as in rtrace. */
static void find_hidden(const answering *a, const graze_ray *ray, graze_hit *hit) {
    graze_trace_settings settings = a->settings;
    graze_hit first;
    settings.back_faces_visible = 1;
    graze_cast(a->scene, &settings, ray, &first);
    if (first.distance >= hit->distance)
        return;
    first.shading_normal = first.normal;
    *hit = first;
}

/* What is mostly asked for: the value alone. */
static bool answer_with_value(const answering *a, const graze_ray *ray, uint64_t number, record_buffer *out) {
    graze_answer answer = {.converged = 1};
    if (vec3_max_abs(ray->direction) > 0)
        graze_trace(a->scene, &a->settings, ray, number, &answer, NULL);
    ray_output_append_value(&a->output, out, answer.value);
    return answer.converged;
}

bool answer_ray(const answering *a, const graze_ray *given, uint64_t number, record_buffer *out) {
    bool converged = true;
    graze_ray before = *given, *ray = &before;
    /* What lies where the ray ends is not met, as in rtrace, whatever its distance is rounded to. */
    before.limit *= 1 - 0x1p-50;
    if (ray_output_is_value(&a->output))
        return answer_with_value(a, ray, number, out);
    graze_hit hit = {.distance = GRAZE_FAR};
    ray_values v = {.hit = &hit, .coefficient = {1, 1, 1}, .mirrored_distance = GRAZE_FAR, .weight = 1};
    v.seen_distance = hit.distance;
    if (!(vec3_max_abs(ray->direction) > 0)) {
        ray_output_append(&a->output, out, &v);
        return true;
    }
    if (a->output.tree) {
        answer_tree(a, ray, number, out);
        return true;
    }
    v.origin = ray->origin;
    v.direction = ray->direction;
    if (a->output.needs_mirror)
        v.mirrored_distance = graze_mirrored_distance(a->scene, &a->settings, ray);
    if (!a->output.needs_value)
        graze_cast(a->scene, &a->settings, ray, &hit);
    else
        converged = trace(a, ray, number, &v, a->output.needs_hit ? &hit : NULL);
    v.seen_distance = hit.distance;
    if (!hit.surface && given->limit > 0)
        hit.point = vec3_add_scaled(given->origin, given->limit, given->direction);
    if (!a->settings.back_faces_visible && a->output.needs_hit && a->settings.quantity != GRAZE_IRRADIANCE)
        find_hidden(a, ray, &hit);
    v.contribution = v.value;
    ray_output_append(&a->output, out, &v);
    return converged;
}
