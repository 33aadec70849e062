/* What modifiers do at a hit. */
#include "material/modifier.h"

/* Shares and perturbations below this do nothing, as in Radiance. */
#define NOTHING 1e-6

static void look_up(const material_modifier *m, const double *where, double *found) {
    if (m->picture) {
        const double row_first[2] = {where[1], where[0]};
        rad_data_values(&m->picture->grid, m->picture->planes, 3, row_first, found);
        return;
    }
    for (int i = 0; i < m->data_count; i++)
        if (i > 0 && m->data[i] == m->data[0])
            found[i] = found[0];
        else
            rad_data_values(m->data[i], &m->data[i]->values, 1, where, &found[i]);
}

/* The values of the modifier's functions; false where there are none. */
static bool compute(const material_modifier *m, const material_ray *ray, double *values) {
    double channels[CAL_CHANNELS_MOST];
    if (m->data_count == 0) {
        material_channels(channels, &m->owner, &m->values, NULL, ray);
        return material_function_values(&m->values, &m->owner, channels, values);
    }
    double where[RAD_DATA_DIMENSIONS];
    material_channels(channels, &m->owner, &m->places, &m->values, ray);
    if (!material_function_values(&m->places, &m->owner, channels, where))
        return false;
    look_up(m, where, channels + MATERIAL_OWN_CHANNEL - 1);
    return material_function_values(&m->values, &m->owner, channels, values);
}

bool material_mixture_share(const material_modifier *m, const material_ray *ray, double *share) {
    if (!compute(m, ray, share))
        return false;
    *share = *share < NOTHING ? 0 : *share > 1 - NOTHING ? 1 : *share;
    return true;
}

static void mix(const material_modifier *m, const material_ray *ray, material_effect *effect) {
    double share;
    if (!compute(m, ray, &share))
        return;
    share = fmax(fmin(share, 1), 0);
    material_effect none = {.color = {1, 1, 1}}, fore = none, back = none;
    if (share > NOTHING)
        fore = material_modify(m->fore_modifiers, ray);
    if (share < 1 - NOTHING)
        back = material_modify(m->back_modifiers, ray);
    rgb color = rgb_add_scaled(rgb_scale(share, fore.color), 1 - share, back.color);
    effect->color = rgb_multiply(effect->color, color);
    effect->perturbation = vec3_add_scaled(effect->perturbation, share, fore.perturbation);
    effect->perturbation = vec3_add_scaled(effect->perturbation, 1 - share, back.perturbation);
}

static void apply(const material_modifier *m, const material_ray *ray, material_effect *effect) {
    double v[3];
    switch (m->kind) {
    case MATERIAL_PATTERN:
        if (!compute(m, ray, v))
            return;
        effect->color = m->values.count == 1 ? rgb_scale(v[0], effect->color)
                                             : rgb_multiply((rgb){v[0], v[1], v[2]}, effect->color);
        return;
    case MATERIAL_TEXTURE:
        if (compute(m, ray, v))
            effect->perturbation =
                vec3_add(effect->perturbation, material_to_world(&m->owner, vec3_make(v[0], v[1], v[2])));
        return;
    case MATERIAL_MIXTURE:
        mix(m, ray, effect);
        return;
    case MATERIAL_ITSELF:
    case MATERIAL_MATERIALS:
        return;
    }
}

material_effect material_modify(const material_modifier *first, const material_ray *ray) {
    material_effect effect = {.color = {1, 1, 1}};
    for (const material_modifier *m = first; m; m = m->next)
        apply(m, ray, &effect);
    return effect;
}

static size_t count_of(const rad_data *data) {
    size_t count = data ? 1 : 0;
    for (int d = 0; data && d < data->dimensions; d++)
        count *= data->axes[d].count;
    return count;
}

static size_t larger(size_t a, size_t b) {
    return a > b ? a : b;
}

size_t material_modifiers_pixels(const material_modifier *first) {
    size_t most = 0;
    for (const material_modifier *m = first; m; m = m->next) {
        most = larger(most, count_of(m->picture ? &m->picture->grid : m->data[0]));
        if (m->kind == MATERIAL_MIXTURE)
            most = larger(most, larger(material_modifiers_pixels(m->fore_modifiers),
                                       material_modifiers_pixels(m->back_modifiers)));
    }
    return most;
}

bool material_modifiers_lean(const material_modifier *first) {
    for (const material_modifier *m = first; m; m = m->next)
        if (m->kind == MATERIAL_TEXTURE ||
            (m->kind == MATERIAL_MIXTURE &&
             (material_modifiers_lean(m->fore_modifiers) || material_modifiers_lean(m->back_modifiers))))
            return true;
    return false;
}

vec3 material_perturbed_normal(vec3 normal, vec3 perturbation, vec3 direction) {
    if (!(vec3_dot(perturbation, perturbation) > NOTHING * NOTHING))
        return normal;
    vec3 sum = vec3_add(normal, perturbation);
    if (!(vec3_max_abs(sum) > 0 && vec3_max_abs(sum) < 1e300))
        return normal;
    vec3 leaned = vec3_safe_normalize(sum);
    double cosine = -vec3_dot(leaned, direction);
    return cosine > 0 ? leaned : vec3_normalize(vec3_add_scaled(leaned, 2 * cosine, direction));
}
