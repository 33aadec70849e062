/* Evaluating the modifiers of a material at a hit. */
#include "trace/appearance.h"

#include "trace/vertex.h"

static material_ray ray_of(const path_hit *hit, double length) {
    return (material_ray){.point = hit->point,
                          .direction = hit->direction,
                          .normal = hit->normal,
                          .distance = length + hit->distance,
                          .last_distance = hit->distance};
}

static material_effect add_effect(const scene_material *m, const material_ray *ray, material_effect before) {
    material_effect e = material_modify(m->modifiers, ray);
    return (material_effect){rgb_multiply(before.color, e.color), vec3_add(before.perturbation, e.perturbation)};
}

/* Perturbations are for the surface's own normal. */
static vec3 lean(const path_hit *hit, const material_effect *e) {
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal;
    vec3 perturbation = hit->behind ? vec3_negate(e->perturbation) : e->perturbation;
    return material_perturbed_normal(normal, perturbation, hit->direction);
}

/* Negative colours reflect nothing; what overflows would. */
static rgb colored(rgb color, rgb pattern) {
    rgb c = rgb_multiply(color, pattern);
    return (rgb){fmin(fmax(c.r, 0), SCENE_LARGEST_RADIANCE), fmin(fmax(c.g, 0), SCENE_LARGEST_RADIANCE),
                 fmin(fmax(c.b, 0), SCENE_LARGEST_RADIANCE)};
}

static void lean_vertex(const path_hit *hit, const material_effect *e, vertex *v, vec3 *normal) {
    *normal = lean(hit, e);
    v->leans = normal->x != v->normal.x || normal->y != v->normal.y || normal->z != v->normal.z;
}

/* The function's part is for lights, the diffuse part for these, too; all else is reflected by the whole colour. */
static void prepare_function(const path_hit *hit, const material_ray *ray, const material_reflection *r,
                             const material_effect *e, vertex *v) {
    rgb color = colored(r->color, e->color);
    const graze_material diffuse = {.kind = GRAZE_PLASTIC, .color = rgb_scale(1 - r->specularity, color)};
    vec3 normal;
    lean_vertex(hit, e, v, &normal);
    graze_surface_prepare(&v->shading, &diffuse, normal, vec3_negate(hit->direction), NULL);
    v->ambient = color;
    v->gloss_is_ambient = false;
    v->function = r;
    v->function_point = (material_reflection_point){*ray, normal, color};
    v->function_point.ray.normal = v->normal;
    v->function_color = rgb_scale(r->specularity, r->metal ? color : rgb_gray(1));
}

static void prepare_reflector(const path *p, const path_hit *hit, const material_ray *ray, const scene_material *m,
                              const material_effect *e, vertex *v) {
    graze_material reflector = m->reflector;
    reflector.color = colored(reflector.color, e->color);
    if (m->orientation) {
        material_ray own = *ray;
        own.normal = v->normal;
        reflector.orientation = material_orientation_at(m->orientation, &own);
    }
    vec3 normal;
    lean_vertex(hit, e, v, &normal);
    graze_surface_prepare(&v->shading, &reflector, normal, vec3_negate(hit->direction), NULL);
    vertex_find_ambient(p, v, &reflector);
}

static bool is_same(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool have_same_lobe(const vertex *a, const vertex *b) {
    const graze_surface *s = &a->shading, *t = &b->shading;
    return s->specular_lobe == t->specular_lobe && s->lobe.model == t->lobe.model &&
           s->lobe.alpha_x == t->lobe.alpha_x && s->lobe.alpha_y == t->lobe.alpha_y && is_same(s->x, t->x) &&
           a->gloss_is_ambient == b->gloss_is_ambient;
}

static rgb blend(double share, rgb a, rgb b) {
    return rgb_add_scaled(rgb_scale(share, a), 1 - share, b);
}

/* Makes *v both, where their normals are the same and there is not more than one specular lobe. */
static bool blend_vertices(vertex *v, double share, const vertex *fore, const vertex *back) {
    const graze_surface *a = &fore->shading, *b = &back->shading;
    bool one_lobe = a->specular_lobe == GRAZE_LOBE_NONE || b->specular_lobe == GRAZE_LOBE_NONE;
    if (fore->function || back->function || !is_same(a->n, b->n) || a->fresnel || b->fresnel ||
        (!one_lobe && !have_same_lobe(fore, back)))
        return false;
    *v = a->specular_lobe == GRAZE_LOBE_NONE ? *back : *fore;
    v->shading.diffuse = blend(share, a->diffuse, b->diffuse);
    v->shading.specular = blend(share, a->specular, b->specular);
    v->ambient = blend(share, fore->ambient, back->ambient);
    v->drawn = fore->drawn || back->drawn;
    return true;
}

static bool draw(const path *p, double share) {
    double random[2] = {0.5, 0.5};
    if (p->sampler)
        sampler_2d(p->sampler, random);
    return random[0] < share;
}

static void prepare(const path *p, const path_hit *hit, const material_ray *ray, const scene_material *m,
                    material_effect e, vertex *v) {
    const scene_material *materials = p->context->scene->materials;
    if (m->modifiers)
        e = add_effect(m, ray, e);
    if (m->reflection) {
        prepare_function(hit, ray, m->reflection, &e, v);
        return;
    }
    if (!m->mixture) {
        prepare_reflector(p, hit, ray, m, &e, v);
        return;
    }
    double share = material_mixture_share(m->mixture, ray);
    vertex fore = *v, back = fore;
    if (share > 0)
        prepare(p, hit, ray, &materials[m->fore], e, &fore);
    if (share < 1)
        prepare(p, hit, ray, &materials[m->back], e, &back);
    if (share == 0 || share == 1) {
        *v = share == 0 ? back : fore;
    } else if (!blend_vertices(v, share, &fore, &back)) {
        *v = draw(p, share) ? fore : back;
        v->drawn = true;
    }
}

void appearance_prepare(const path *p, const path_hit *hit, const scene_material *m, vertex *v) {
    const material_ray ray = ray_of(hit, p->length);
    prepare(p, hit, &ray, m, (material_effect){.color = {1, 1, 1}}, v);
}

vec3 appearance_normal(const graze_scene *scene, const path_hit *hit, double length) {
    const scene_material *m = &scene->materials[scene->surfaces[hit->surface].material];
    const material_ray ray = ray_of(hit, length);
    material_effect e = {.color = {1, 1, 1}};
    for (;;) {
        if (m->modifiers)
            e = add_effect(m, &ray, e);
        if (!m->mixture)
            return lean(hit, &e);
        m = &scene->materials[material_mixture_share(m->mixture, &ray) >= 0.5 ? m->fore : m->back];
    }
}
