/* Evaluating the modifiers of a material at a hit. */
#include "trace/appearance.h"

#include "scene/surface.h"
#include "trace/appearance_kinds.h"
#include "trace/vertex.h"

material_ray appearance_ray(const graze_scene *scene, const path_hit *hit, double length) {
    return encounter_meet(scene, hit, length).ray;
}

static void lean_vertex(const path_hit *hit, const encounter *of, const material_effect *e, vertex *v, vec3 *normal) {
    *normal = encounter_lean(hit, of, e);
    v->leans = normal->x != v->normal.x || normal->y != v->normal.y || normal->z != v->normal.z;
}

/* The function's part is for lights, the diffuse part for these, too; all else is reflected by the whole colour. */
static void prepare_function(const path *p, const path_hit *hit, const encounter *of, const material_reflection *r,
                             const material_effect *e, vertex *v) {
    rgb color = encounter_colored(r->color, e->color);
    const graze_material diffuse = {.kind = GRAZE_PLASTIC, .color = rgb_scale(1 - r->specularity, color)};
    vec3 normal;
    lean_vertex(hit, of, e, v, &normal);
    graze_surface_prepare(&v->shading, &diffuse, normal, vec3_negate(hit->direction), NULL);
    v->ambient = color;
    v->gloss_is_ambient = false;
    v->function = r;
    v->function_scene = of->moved ? p->context->scene : NULL;
    v->function_point = (material_reflection_point){of->ray, encounter_as_written(of, normal), color};
    v->function_point.ray.normal = encounter_as_written(of, v->normal);
    v->function_color = rgb_scale(r->specularity, r->metal ? color : rgb_gray(1));
}

/* Of panes, what they transmit is multiplied by the pattern; of dielectrics, what a unit of length does. */
static graze_material patterned(const graze_material *m, rgb pattern) {
    graze_material patterned = *m;
    if (m->kind == GRAZE_DIELECTRIC) {
        rgb inside = encounter_colored(m->inside, pattern);
        patterned.inside = (rgb){fmin(inside.r, 1), fmin(inside.g, 1), fmin(inside.b, 1)};
    } else if (m->kind != GRAZE_GLASS) {
        patterned.color = encounter_colored(m->color, pattern);
    }
    return patterned;
}

static void prepare_reflector(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                              const material_effect *e, vertex *v) {
    graze_material reflector = patterned(&m->reflector, e->color);
    if (m->kind == SCENE_ORIENTED) {
        material_ray own = of->ray;
        own.normal = encounter_as_written(of, v->normal);
        reflector.orientation = material_orientation_at(m->orientation, &own);
    }
    if (of->moved && reflector.has_orientation)
        reflector.orientation = rad_transform_vector(&of->transform, reflector.orientation);
    vec3 normal;
    lean_vertex(hit, of, e, v, &normal);
    if (reflector.kind >= GRAZE_DIELECTRIC && hit->behind)
        normal = vec3_negate(normal);
    graze_surface_prepare(&v->shading, &reflector, normal, vec3_negate(hit->direction), NULL);
    if (reflector.kind == GRAZE_GLASS && v->shading.transmits)
        v->shading.transmitted_specular = encounter_colored(v->shading.transmitted_specular, e->color);
    vertex_find_ambient(p, v, &reflector);
}

static bool have_same_lobe(const vertex *a, const vertex *b) {
    const graze_surface *s = &a->shading, *t = &b->shading;
    return s->specular_lobe == t->specular_lobe && s->lobe.model == t->lobe.model &&
           s->lobe.alpha_x == t->lobe.alpha_x && s->lobe.alpha_y == t->lobe.alpha_y && vec3_is_same(s->x, t->x) &&
           a->gloss_is_ambient == b->gloss_is_ambient;
}

static rgb blend(double share, rgb a, rgb b) {
    return rgb_add_scaled(rgb_scale(share, a), 1 - share, b);
}

/* Makes *v both, where their normals are the same and there is not more than one specular lobe. */
static bool blend_vertices(vertex *v, double share, const vertex *fore, const vertex *back) {
    const graze_surface *a = &fore->shading, *b = &back->shading;
    bool one_lobe = a->specular_lobe == GRAZE_LOBE_NONE || b->specular_lobe == GRAZE_LOBE_NONE;
    if (fore->function || back->function || !vec3_is_same(a->n, b->n) || a->fresnel || b->fresnel || a->transmits ||
        b->transmits || (!one_lobe && !have_same_lobe(fore, back)))
        return false;
    *v = a->specular_lobe == GRAZE_LOBE_NONE ? *back : *fore;
    v->shading.diffuse = blend(share, a->diffuse, b->diffuse);
    v->shading.specular = blend(share, a->specular, b->specular);
    v->ambient = blend(share, fore->ambient, back->ambient);
    v->drawn = fore->drawn || back->drawn;
    return true;
}

bool appearance_draw(const path *p, double share) {
    double random[2] = {0.5, 0.5};
    if (p->sampler)
        sampler_2d(p->sampler, random);
    return random[0] < share;
}

/* What a mixture is where its share cannot be computed, as in Radiance. */
static const scene_material black = {.kind = SCENE_REFLECTOR, .reflector = {.kind = GRAZE_PLASTIC}};

static void prepare(const path *, const path_hit *, const encounter *, const scene_material *, material_effect,
                    vertex *);

static void prepare_mixture(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                            material_effect e, vertex *v) {
    const scene_material *materials = p->context->scene->materials;
    double share;
    if (!material_mixture_share(m->share, &of->ray, &share)) {
        prepare_reflector(p, hit, of, &black, &e, v);
        return;
    }
    vertex fore = *v, back = fore;
    if (share > 0)
        prepare(p, hit, of, &materials[m->fore], e, &fore);
    if (share < 1)
        prepare(p, hit, of, &materials[m->back], e, &back);
    if (share == 0 || share == 1) {
        *v = share == 0 ? back : fore;
    } else if (!blend_vertices(v, share, &fore, &back)) {
        *v = appearance_draw(p, share) ? fore : back;
        v->drawn = true;
    }
}

static void prepare(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                    material_effect before, vertex *v) {
    if (m->kind == SCENE_WGMD) {
        appearance_prepare_wgmd(p, hit, of, m, before, v);
        return;
    }
    const material_effect e = encounter_add_effect(m->modifiers, &of->ray, before);
    switch (m->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        prepare_reflector(p, hit, of, m, &e, v);
        break;
    case SCENE_FUNCTION:
        prepare_function(p, hit, of, m->reflection, &e, v);
        break;
    case SCENE_MIXTURE:
        prepare_mixture(p, hit, of, m, e, v);
        break;
    case SCENE_PRISM:
        appearance_prepare_prism(p, hit, of, m->prism, v);
        break;
    case SCENE_EMITTER:
    case SCENE_WGMD:
        break;
    }
}

void appearance_prepare(const path *p, const path_hit *hit, const scene_material *m, vertex *v) {
    const encounter of = encounter_meet(p->context->scene, hit, p->length);
    prepare(p, hit, &of, m, of.effect, v);
}

vec3 appearance_normal(const graze_scene *scene, const path_hit *hit, double length) {
    const scene_material *m = scene_material_at(scene, hit->surface);
    const encounter of = encounter_meet(scene, hit, length);
    material_effect e = of.effect;
    for (;;) {
        e = encounter_add_effect(m->modifiers, &of.ray, e);
        double share;
        if (m->kind != SCENE_MIXTURE || !material_mixture_share(m->share, &of.ray, &share))
            return encounter_lean(hit, &of, &e);
        m = &scene->materials[share >= 0.5 ? m->fore : m->back];
    }
}

static rgb through_reflector(const scene_material *m, const path_hit *hit, const encounter *of,
                             const material_effect *e) {
    graze_material reflector = patterned(&m->reflector, e->color);
    vec3 normal = encounter_lean(hit, of, e);
    rgb through = graze_material_straight_through(&reflector, fabs(vec3_dot(normal, hit->direction)));
    return reflector.kind == GRAZE_GLASS ? encounter_colored(through, e->color) : through;
}

static rgb straight_through(const scene_material *materials, const scene_material *m, const path_hit *hit,
                            const encounter *of, material_effect before) {
    double share;
    const material_effect e = encounter_add_effect(m->modifiers, &of->ray, before);
    switch (m->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        return through_reflector(m, hit, of, &e);
    case SCENE_MIXTURE:
        if (!material_mixture_share(m->share, &of->ray, &share))
            break;
        return blend(share, straight_through(materials, &materials[m->fore], hit, of, e),
                     straight_through(materials, &materials[m->back], hit, of, e));
    case SCENE_EMITTER:
    case SCENE_FUNCTION:
    case SCENE_WGMD:
    case SCENE_PRISM:
        break;
    }
    return rgb_gray(0);
}

rgb appearance_straight_through(const graze_scene *scene, const scene_material *m, const path_hit *hit, double length) {
    const encounter of = encounter_meet(scene, hit, length);
    return straight_through(scene->materials, m, hit, &of, of.effect);
}
