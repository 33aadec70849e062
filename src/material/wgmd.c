/* Compiling WGMDfunc, and preparing it at a hit. */
#include "material/wgmd.h"

#include <string.h>

#include "base/number.h"
#include "material/amounts.h"
#include "material/fresnel.h"

/* String arguments. */
enum {
    SPECULAR_MODIFIER,
    SPECULAR,
    THROUGH_MODIFIER = 4,
    THROUGH,
    THROUGH_DIFFUSE_MODIFIER = 8,
    VECTOR,
    FILE_NAME = 12
};

/* Roughnesses and reflectances below this are 0, as in Radiance. */
#define NOTHING 1e-6

/* The cosine that the Fresnel estimate is taken for at least. */
#define SMALLEST_COSINE 1e-3

static bool is_zero(const char *word) {
    double value;
    return text_to_real(word, &value) && value <= NOTHING;
}

static bool is_above_zero(const char *word) {
    double value;
    return text_to_real(word, &value) && value > NOTHING;
}

static bool may_be_smooth(const char *const *roughnesses) {
    return !is_above_zero(roughnesses[0]) || !is_above_zero(roughnesses[1]);
}

static graze_status read_colors(material_wgmd *w, const rad_primitive *p, const graze_report *report) {
    const double *a = p->reals;
    graze_status status = material_check_amounts(p, 9, report);
    if (status)
        return status;
    w->front = (rgb){a[0], a[1], a[2]};
    w->back = (rgb){a[3], a[4], a[5]};
    w->beyond = (rgb){a[6], a[7], a[8]};
    if (rgb_max(rgb_add(w->front, w->beyond)) > 1 || rgb_max(rgb_add(w->back, w->beyond)) > 1)
        rad_primitive_warning(report, p, "unphysical: what is diffuse of it adds up to more light than it receives");
    w->has[WGMD_DIFFUSE] = true;
    w->has[WGMD_SPECULAR] = !is_zero(p->strings[SPECULAR]);
    w->has[WGMD_THROUGH] = !is_zero(p->strings[THROUGH]);
    w->has[WGMD_THROUGH_DIFFUSE] = !rgb_is_black(w->beyond);
    w->may_mirror = w->has[WGMD_SPECULAR] && may_be_smooth(&p->strings[SPECULAR + 1]);
    w->may_be_clear = w->has[WGMD_THROUGH] && may_be_smooth(&p->strings[THROUGH + 1]);
    return GRAZE_OK;
}

static graze_status read_modifiers(material_wgmd *w, material_modifiers *modifiers, const rad_primitive *p) {
    static const int names[WGMD_PARTS] = {[WGMD_SPECULAR] = SPECULAR_MODIFIER,
                                          [WGMD_THROUGH] = THROUGH_MODIFIER,
                                          [WGMD_THROUGH_DIFFUSE] = THROUGH_DIFFUSE_MODIFIER};
    graze_status status = GRAZE_OK;
    w->inherits[WGMD_DIFFUSE] = true;
    for (int part = WGMD_SPECULAR; part < WGMD_PARTS && !status; part++) {
        const char *name = p->strings[names[part]];
        w->inherits[part] = strcmp(name, "inherit") == 0;
        if (w->has[part] && !w->inherits[part])
            status = material_modifiers_find(&w->modifiers[part], modifiers, p, name);
    }
    return status;
}

/* Three expressions, from string argument `first` on. */
static graze_status compile(material_function *f, material_library *library, const material_owner *o, int first) {
    const uint64_t channels = CAL_CHANNEL_BITS(CAL_NXP, CAL_RDOTP);
    cal_expression expressions[3];
    for (int i = 0; i < 3; i++)
        expressions[i] = (cal_expression){.text = o->primitive->strings[first + i]};
    return material_function_compile(f, library, o, FILE_NAME, expressions, 3, channels);
}

graze_status material_wgmd_compile(const material_wgmd **result, material_modifiers *modifiers,
                                   const rad_primitive *p) {
    material_library *library = material_modifiers_library(modifiers);
    material_wgmd *made = arena_allocate(material_library_memory(library), sizeof *made);
    *result = made;
    if (!made)
        return report_out_of_memory(material_library_report(library));
    *made = (material_wgmd){.may_mirror = false};
    graze_status status = read_colors(made, p, material_library_report(library));
    if (!status)
        status = read_modifiers(made, modifiers, p);
    if (!status)
        status = material_owner_begin(&made->owner, library, p, FILE_NAME, FILE_NAME + 1);
    if (!status)
        status = compile(&made->orientation, library, &made->owner, VECTOR);
    if (!status)
        status = compile(&made->specular, library, &made->owner, SPECULAR);
    if (!status)
        status = compile(&made->through, library, &made->owner, THROUGH);
    return status;
}

static bool values_at(const material_wgmd *w, const material_function *f, const material_ray *ray, vec3 normal,
                      double values[3]) {
    double channels[CAL_CHANNELS_MOST];
    material_channels(channels, &w->owner, f, NULL, ray);
    material_own_direction(channels, CAL_NXP, &w->owner, normal);
    channels[CAL_RDOTP - 1] = -vec3_dot(ray->direction, normal);
    return material_function_values(f, &w->owner, channels, values);
}

/* A specular part as the functions have it here. */
typedef struct lobe {
    rgb color;
    double roughness_u, roughness_v; /* both are 0, or none */
} lobe;

static lobe lobe_at(const material_wgmd *w, const material_wgmd_point *at, material_wgmd_part part) {
    const material_function *f = part == WGMD_SPECULAR ? &w->specular : &w->through;
    double values[3];
    lobe none = {{0, 0, 0}, 0, 0};
    if (!w->has[part] || !values_at(w, f, &at->ray, at->normals[part], values) || !(values[0] > NOTHING))
        return none;
    bool rough = values[1] > NOTHING && values[2] > NOTHING;
    return (lobe){rgb_scale(values[0], at->colors[part]), rough ? values[1] : 0, rough ? values[2] : 0};
}

static graze_material mirror_or_gloss(const lobe *l, graze_brdf_model model, vec3 orientation) {
    graze_material m = {.kind = GRAZE_METAL,
                        .model = model,
                        .color = l->color,
                        .specularity = 1,
                        .roughness_u = l->roughness_u,
                        .roughness_v = l->roughness_v,
                        .has_orientation = 1,
                        .orientation = orientation};
    /* Too weak for Fresnel's estimate. */
    if (rgb_brightness(m.color) < MATERIAL_FRESNEL_THRESHOLD) {
        m.specularity = MATERIAL_FRESNEL_THRESHOLD / 2;
        m.color = rgb_scale(1 / m.specularity, m.color);
    }
    return m;
}

static void clear_other_side(graze_surface *s) {
    s->transmitted_diffuse = s->transmitted_specular = rgb_gray(0);
    s->transmitted_lobe = GRAZE_LOBE_NONE;
    s->transmitted_u = s->lobe.alpha_x;
    s->transmitted_v = s->lobe.alpha_y;
}

/* The specular part; it leaves this share of light to the others, which Fresnel's estimate takes more from. */
static double prepare_specular(graze_surface *s, const lobe *l, const material_wgmd_point *at, vec3 orientation) {
    graze_material m = mirror_or_gloss(l, at->model, orientation);
    graze_surface_prepare(s, &m, at->normals[WGMD_SPECULAR], vec3_negate(at->ray.direction), NULL);
    s->diffuse = rgb_gray(0);
    clear_other_side(s);
    return s->fresnel ? 1 - material_fresnel(double_max(s->local_view.z, SMALLEST_COSINE)) : 1;
}

/* A surface with no more than the frame of that part, of these roughnesses. */
static void prepare_black(graze_surface *s, const lobe *l, const material_wgmd_point *at, material_wgmd_part part,
                          vec3 orientation) {
    const graze_material m = {.kind = GRAZE_PLASTIC,
                              .model = at->model,
                              .roughness_u = l->roughness_u,
                              .roughness_v = l->roughness_v,
                              .has_orientation = 1,
                              .orientation = orientation};
    graze_surface_prepare(s, &m, at->normals[part], vec3_negate(at->ray.direction), NULL);
    clear_other_side(s);
}

static void set_through(graze_surface *s, const lobe *l, double left) {
    s->transmitted_specular = rgb_scale(left, l->color);
    s->transmits = !rgb_is_black(s->transmitted_specular);
    if (s->transmits)
        s->transmitted_lobe = l->roughness_u > 0 ? GRAZE_LOBE_TRANSMITTED_GLOSSY : GRAZE_LOBE_TRANSMITTED;
}

static vec3 orientation_at(const material_wgmd *w, const material_wgmd_point *at) {
    double u[3];
    if (!values_at(w, &w->orientation, &at->ray, at->normals[WGMD_DIFFUSE], u))
        return vec3_make(0, 0, 0);
    return material_to_world(&w->owner, vec3_make(u[0], u[1], u[2]));
}

void material_wgmd_prepare(const material_wgmd *w, const material_wgmd_point *at, graze_surface parts[WGMD_PARTS]) {
    const lobe smooth = {{0, 0, 0}, 0, 0};
    const vec3 orientation = orientation_at(w, at);
    bool behind = vec3_dot(at->ray.normal, at->ray.direction) > 0;
    double left = 1;
    int fresnel = 0;
    if (w->has[WGMD_SPECULAR]) {
        const lobe shine = lobe_at(w, at, WGMD_SPECULAR);
        left = prepare_specular(&parts[WGMD_SPECULAR], &shine, at, orientation);
        fresnel = parts[WGMD_SPECULAR].fresnel;
    }
    graze_surface *diffuse = &parts[WGMD_DIFFUSE], *beyond = &parts[WGMD_THROUGH_DIFFUSE];
    prepare_black(diffuse, &smooth, at, WGMD_DIFFUSE, orientation);
    diffuse->diffuse = rgb_scale(left, rgb_multiply(behind ? w->back : w->front, at->colors[WGMD_DIFFUSE]));
    diffuse->fresnel = fresnel;
    if (w->has[WGMD_THROUGH]) {
        const lobe through = lobe_at(w, at, WGMD_THROUGH);
        prepare_black(&parts[WGMD_THROUGH], &through, at, WGMD_THROUGH, orientation);
        set_through(&parts[WGMD_THROUGH], &through, left);
    }
    if (w->has[WGMD_THROUGH_DIFFUSE]) {
        prepare_black(beyond, &smooth, at, WGMD_THROUGH_DIFFUSE, orientation);
        beyond->transmitted_diffuse = rgb_scale(left, rgb_multiply(w->beyond, at->colors[WGMD_THROUGH_DIFFUSE]));
        beyond->transmits = 1;
        beyond->fresnel = fresnel;
    }
}

void material_wgmd_join(graze_surface *s, const graze_surface *part) {
    if (part->fresnel)
        s->fresnel = part->fresnel;
    s->diffuse = rgb_add(s->diffuse, part->diffuse);
    if (part->specular_lobe != GRAZE_LOBE_NONE) {
        s->specular = part->specular;
        s->specular_lobe = part->specular_lobe;
        s->lobe = part->lobe;
    }
    if (!part->transmits)
        return;
    s->transmits = 1;
    s->transmitted_diffuse = rgb_add(s->transmitted_diffuse, part->transmitted_diffuse);
    if (part->transmitted_lobe == GRAZE_LOBE_NONE)
        return;
    s->transmitted_specular = part->transmitted_specular;
    s->transmitted_lobe = part->transmitted_lobe;
    s->transmitted_u = part->transmitted_u;
    s->transmitted_v = part->transmitted_v;
}

rgb material_wgmd_through(const material_wgmd *w, const material_wgmd_point *at) {
    const lobe through = lobe_at(w, at, WGMD_THROUGH);
    if (rgb_is_black(through.color) || through.roughness_u > 0 || !w->has[WGMD_SPECULAR])
        return through.roughness_u > 0 ? rgb_gray(0) : through.color;
    const lobe shine = lobe_at(w, at, WGMD_SPECULAR);
    graze_surface s;
    return rgb_scale(prepare_specular(&s, &shine, at, vec3_make(0, 0, 0)), through.color);
}
