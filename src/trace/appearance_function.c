/* Materials that scatter lights by functions, at a hit. */
#include "trace/appearance_kinds.h"
#include "trace/vertex.h"

static material_reflection_point point_of(const path_hit *hit, const encounter *of, const material_reflection *r,
                                          rgb pattern, vec3 normal) {
    material_reflection_point at = {of->ray, encounter_as_written(of, normal), rgb_multiply(r->color, pattern)};
    if (hit->behind && !r->keeps_normal)
        at.ray.normal = vec3_negate(at.ray.normal);
    return at;
}

static void prepare_beyond(const path *p, const material_reflection_side *below, rgb through, vec3 straight_on,
                           vertex *v) {
    graze_surface *s = &v->shading;
    s->transmits = 1;
    s->transmitted_diffuse = below->diffuse;
    s->transmitted_specular = through;
    s->transmitted_lobe = rgb_is_black(through) ? GRAZE_LOBE_NONE : GRAZE_LOBE_TRANSMITTED;
    s->transmitted = straight_on;
    s->transmitted_u = s->lobe.alpha_x;
    s->transmitted_v = s->lobe.alpha_y;
    v->transmitted_ambient = below->ambient;
    v->transmitted_gloss_is_ambient = false;
    vertex_set_passage(p, v);
}

void appearance_prepare_function(const path *p, const path_hit *hit, const encounter *of, const material_reflection *r,
                                 const material_effect *e, vertex *v) {
    const rgb pattern = encounter_colored(rgb_gray(1), e->color);
    material_reflection_side above, below;
    material_reflection_sides(r, pattern, hit->behind, &above, &below);
    const graze_material diffuse = {.kind = GRAZE_PLASTIC, .color = above.diffuse};
    const vec3 normal = appearance_lean(hit, of, e, v);
    graze_surface_prepare(&v->shading, &diffuse, normal, vec3_negate(hit->direction), NULL);
    v->ambient = above.ambient;
    v->gloss_is_ambient = false;
    v->function = r->by_function ? r : NULL;
    v->function_scene = of->moved ? p->context->scene : NULL;
    v->function_point = point_of(hit, of, r, pattern, normal);
    v->function_color = above.function;
    v->transmitted_function = below.function;
    v->shading.specular = material_reflection_mirrored(r, &v->function_point);
    if (!rgb_is_black(v->shading.specular))
        v->shading.specular_lobe = GRAZE_LOBE_MIRROR;
    const rgb through = material_reflection_through(r, &v->function_point);
    if (rgb_is_black(through) && rgb_is_black(below.ambient) && rgb_is_black(below.function))
        return;
    prepare_beyond(p, &below, through, appearance_straight_on(p, hit, encounter_perturbation(hit, of, e), false), v);
}

rgb appearance_through_function(const path_hit *hit, const encounter *of, const material_reflection *r,
                                const material_effect *e) {
    const rgb pattern = encounter_colored(rgb_gray(1), e->color);
    const material_reflection_point at = point_of(hit, of, r, pattern, encounter_lean(hit, of, e));
    return material_reflection_through(r, &at);
}
