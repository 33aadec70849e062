/* Evaluating the modifiers of a material at a hit. */
#include "trace/appearance.h"

#include "scene/surface.h"
#include "trace/appearance_kinds.h"
#include "trace/vertex.h"

vec3 appearance_lean(const path_hit *hit, const encounter *of, const material_effect *e, vertex *v) {
    vec3 normal = encounter_lean(hit, of, e);
    v->leans = !vec3_is_same(normal, v->normal);
    return normal;
}

/* Perturbations below this bend nothing, as in Radiance. */
#define NO_PERTURBATION 1e-6

vec3 appearance_straight_on(const path *p, const path_hit *hit, vec3 perturbation, bool rough) {
    bool bends = p->ambient_depth == 0 && (rough || !lobe_scatters(p->last.lobe));
    if (!bends || !(vec3_dot(perturbation, perturbation) > NO_PERTURBATION * NO_PERTURBATION))
        return hit->direction;
    vec3 bent = vec3_safe_normalize(vec3_subtract(hit->direction, perturbation));
    vec3 below = hit->behind ? hit->normal : vec3_negate(hit->normal);
    return vec3_dot(bent, below) > 0 ? bent : hit->direction;
}

/* How refraction goes on where the normal leans so far that it would not get through: by the surface's own normal, with
 * what the leaning one had been bent by. */
static vec3 refract_plainly(const graze_surface *s, double ratio, vec3 normal) {
    double along = vec3_dot(vec3_add_scaled(s->transmitted, ratio, s->view), s->n);
    vec3 straight = vec3_scale(-ratio, s->view);
    return vec3_safe_normalize(vec3_add_scaled(straight, -fabs(along), normal));
}

/* Where the viewer looks on beyond a surface whose normal leans. */
static void bend(const path *p, const path_hit *hit, const graze_material *m, vec3 perturbation, vertex *v) {
    graze_surface *s = &v->shading;
    switch (m->kind) {
    case GRAZE_GLASS:
        s->transmitted = appearance_straight_on(p, hit, vec3_scale(2 * (m->refraction - 1), perturbation), false);
        break;
    case GRAZE_TRANS:
        s->transmitted =
            appearance_straight_on(p, hit, perturbation, s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY);
        break;
    case GRAZE_DIELECTRIC:
        if (vec3_dot(s->transmitted, v->normal) >= 0)
            s->transmitted = refract_plainly(s, hit->behind ? m->refraction : 1 / m->refraction, v->normal);
        break;
    default:
        break;
    }
}

static rgb transmissivity(rgb color, rgb pattern) {
    rgb c = encounter_colored(color, pattern);
    return (rgb){fmin(c.r, 1), fmin(c.g, 1), fmin(c.b, 1)};
}

/* Of panes, what they transmit is multiplied by the pattern; of dielectrics, what a unit of length does. */
static graze_material patterned(const graze_material *m, rgb pattern) {
    graze_material patterned = *m;
    if (m->kind == GRAZE_DIELECTRIC) {
        patterned.inside = transmissivity(m->inside, pattern);
        if (rgb_min(m->outside) < 1)
            patterned.outside = transmissivity(m->outside, pattern);
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
    vec3 normal = appearance_lean(hit, of, e, v);
    if (reflector.kind >= GRAZE_DIELECTRIC && hit->behind)
        normal = vec3_negate(normal);
    graze_surface_prepare(&v->shading, &reflector, normal, vec3_negate(hit->direction), NULL);
    if (reflector.kind == GRAZE_DIELECTRIC && (hit->behind || rgb_min(reflector.outside) < 1))
        v->before = graze_material_attenuation(&reflector, hit->behind, 1);
    if (reflector.kind == GRAZE_GLASS && v->shading.transmits)
        v->shading.transmitted_specular = encounter_colored(v->shading.transmitted_specular, e->color);
    if (v->leans && v->shading.transmits)
        bend(p, hit, &reflector, encounter_perturbation(hit, of, e), v);
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

static double draw_number(const path *p) {
    double random[2] = {0.5, 0.5};
    if (p->sampler)
        sampler_2d(p->sampler, random);
    return random[0];
}

bool appearance_draw(const path *p, double share) {
    return draw_number(p) < share;
}

int appearance_draw_of(const path *p, int count) {
    return (int)(draw_number(p) * count);
}

static const scene_material black = {.kind = SCENE_REFLECTOR, .reflector = {.kind = GRAZE_PLASTIC}};

static void prepare(const path *, const path_hit *, const encounter *, const scene_material *, material_effect,
                    vertex *);

/* Whether what the surface transmits goes straight on, if there is any. */
static bool leads_straight_on(const path_hit *hit, const vertex *v) {
    const graze_surface *s = &v->shading;
    return !s->transmits || s->transmitted_lobe == GRAZE_LOBE_NONE ||
           (s->transmitted_lobe == GRAZE_LOBE_TRANSMITTED && vec3_is_same(s->transmitted, hit->direction));
}

/* Leaves this share of a surface, and lets the rest of all light straight through. */
static void perforate(const path *p, const path_hit *hit, double share, vertex *v) {
    graze_surface *s = &v->shading;
    if (!s->transmits) {
        s->transmitted_diffuse = s->transmitted_specular = rgb_gray(0);
        s->transmitted_u = s->lobe.alpha_x;
        s->transmitted_v = s->lobe.alpha_y;
        v->transmitted_ambient = v->transmitted_function = rgb_gray(0);
        v->transmitted_gloss_is_ambient = false;
    }
    s->transmits = 1;
    s->transmitted_lobe = GRAZE_LOBE_TRANSMITTED;
    s->transmitted = hit->direction;
    s->diffuse = rgb_scale(share, s->diffuse);
    s->specular = rgb_scale(share, s->specular);
    s->transmitted_diffuse = rgb_scale(share, s->transmitted_diffuse);
    s->transmitted_specular = rgb_add(rgb_scale(share, s->transmitted_specular), rgb_gray(1 - share));
    v->ambient = rgb_scale(share, v->ambient);
    v->transmitted_ambient = rgb_scale(share, v->transmitted_ambient);
    if (v->function) {
        v->function_color = rgb_scale(share, v->function_color);
        v->transmitted_function = rgb_scale(share, v->transmitted_function);
    }
    vertex_set_passage(p, v);
    /* Light samples do not pass surfaces that are opaque but for hidden backs, and where functions fail. */
    v->refracts = !scene_surface_passes(p->context->scene, hit->surface);
}

/* Lets all light straight through. */
static void prepare_nothing(const path *p, const path_hit *hit, const encounter *of, const material_effect *e,
                            vertex *v) {
    prepare_reflector(p, hit, of, &black, e, v);
    perforate(p, hit, 0, v);
}

/* A material, of which there is this share, and void. */
static void prepare_with_nothing(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                                 material_effect e, double share, vertex *v) {
    if (share > 0)
        prepare(p, hit, of, m, e, v);
    if (share > 0 && !leads_straight_on(hit, v)) {
        v->drawn = true;
        if (appearance_draw(p, share))
            return;
        share = 0;
    }
    if (share == 0)
        prepare_nothing(p, hit, of, &e, v);
    else if (share < 1)
        perforate(p, hit, share, v);
}

/* Whether this part of a mixture is not there where the ray meets it: void, or a hidden back. */
static bool is_absent(const path_context *context, const path_hit *hit, const scene_material *m) {
    bool hidden = hit->behind && !context->settings->back_faces_visible && !scene_material_has_back(m);
    return m->kind == SCENE_NOTHING || hidden;
}

static void prepare_mixture(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                            material_effect e, vertex *v) {
    const scene_material *materials = p->context->scene->materials;
    double share;
    if (!material_mixture_share(m->share, &of->ray, &share)) {
        prepare_nothing(p, hit, of, &e, v);
        return;
    }
    bool first = is_absent(p->context, hit, &materials[m->back]);
    if (first || is_absent(p->context, hit, &materials[m->fore])) {
        prepare_with_nothing(p, hit, of, &materials[first ? m->fore : m->back], e, first ? share : 1 - share, v);
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
    const material_effect e = encounter_add_effect(m->modifiers, &of->ray, before);
    switch (m->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        prepare_reflector(p, hit, of, m, &e, v);
        break;
    case SCENE_FUNCTION:
        appearance_prepare_function(p, hit, of, m->reflection, &e, v);
        break;
    case SCENE_MIXTURE:
        prepare_mixture(p, hit, of, m, e, v);
        break;
    case SCENE_PRISM:
        appearance_prepare_prism(p, hit, of, m->prism, v);
        break;
    case SCENE_NOTHING:
        prepare_nothing(p, hit, of, &e, v);
        break;
    case SCENE_EMITTER:
        prepare_reflector(p, hit, of, &black, &e, v);
        break;
    case SCENE_WGMD:
        appearance_prepare_wgmd(p, hit, of, m, before, &e, v);
        break;
    }
}

void appearance_prepare(const path *p, const path_hit *hit, const scene_material *m, vertex *v) {
    const encounter of = encounter_meet(p->context->scene, hit, p->length);
    prepare(p, hit, &of, m, of.effect, v);
}

/* What perturbs the normal; in a mixture, each part by its share. */
static material_effect find_perturbation(const scene_material *materials, const scene_material *m,
                                         const material_ray *ray, material_effect before) {
    double share;
    material_effect e = encounter_add_effect(m->modifiers, ray, before);
    if (m->kind != SCENE_MIXTURE || !material_mixture_share(m->share, ray, &share))
        return e;
    material_effect fore = find_perturbation(materials, &materials[m->fore], ray, e);
    material_effect back = find_perturbation(materials, &materials[m->back], ray, e);
    e.perturbation = vec3_add_scaled(vec3_scale(share, fore.perturbation), 1 - share, back.perturbation);
    return e;
}

vec3 appearance_normal(const graze_scene *scene, const path_hit *hit, double length) {
    const scene_material *m = scene_material_at(scene, hit->surface);
    const encounter of = encounter_meet(scene, hit, length);
    const material_effect e = find_perturbation(scene->materials, m, &of.ray, of.effect);
    return encounter_lean(hit, &of, &e);
}

vec3 appearance_smooth_normal(const graze_scene *scene, const path_hit *hit) {
    const encounter of = encounter_meet(scene, hit, 0);
    return encounter_lean(hit, &of, &of.effect);
}

graze_material appearance_reflector(const graze_scene *scene, const scene_material *m, const path_hit *hit,
                                    double length) {
    const encounter of = encounter_meet(scene, hit, length);
    return patterned(&m->reflector, encounter_add_effect(m->modifiers, &of.ray, of.effect).color);
}

static rgb through_reflector(const scene_material *m, const path_hit *hit, const encounter *of,
                             const material_effect *e) {
    graze_material reflector = patterned(&m->reflector, e->color);
    vec3 normal = encounter_lean(hit, of, e);
    rgb through = graze_material_straight_through(&reflector, fabs(vec3_dot(normal, hit->direction)));
    return reflector.kind == GRAZE_GLASS ? encounter_colored(through, e->color) : through;
}

static rgb straight_through(const path_context *context, const scene_material *m, const path_hit *hit,
                            const encounter *of, material_effect before) {
    const scene_material *materials = context->scene->materials;
    double share;
    if (is_absent(context, hit, m))
        return rgb_gray(1);
    const material_effect e = encounter_add_effect(m->modifiers, &of->ray, before);
    switch (m->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        return through_reflector(m, hit, of, &e);
    case SCENE_MIXTURE:
        if (!material_mixture_share(m->share, &of->ray, &share))
            return rgb_gray(1);
        return blend(share, straight_through(context, &materials[m->fore], hit, of, e),
                     straight_through(context, &materials[m->back], hit, of, e));
    case SCENE_FUNCTION:
        return appearance_through_function(hit, of, m->reflection, &e);
    case SCENE_WGMD:
        return appearance_through_wgmd(hit, of, m, before, &e);
    case SCENE_EMITTER:
    case SCENE_PRISM:
    case SCENE_NOTHING:
        break;
    }
    return rgb_gray(0);
}

rgb appearance_straight_through(const path_context *context, const scene_material *m, const path_hit *hit,
                                double length) {
    const encounter of = encounter_meet(context->scene, hit, length);
    return straight_through(context, m, hit, &of, of.effect);
}

/* The colour of what shines, and how much of the surface does. */
static rgb shining(const scene_material *materials, const scene_material *m, const material_ray *ray,
                   material_effect before) {
    double share;
    const material_effect e = encounter_add_effect(m->modifiers, ray, before);
    if (scene_material_emits(m))
        return encounter_colored(rgb_gray(1), e.color);
    if (m->kind != SCENE_MIXTURE || !material_mixture_share(m->share, ray, &share))
        return rgb_gray(0);
    return blend(share, shining(materials, &materials[m->fore], ray, e),
                 shining(materials, &materials[m->back], ray, e));
}

rgb appearance_emission(const graze_scene *scene, const path_hit *hit, double length, rgb radiance) {
    const encounter of = encounter_meet(scene, hit, length);
    const scene_material *m = &scene->materials[scene_surface_at(scene, hit->surface).material];
    return rgb_multiply(radiance, shining(scene->materials, m, &of.ray, of.effect));
}
