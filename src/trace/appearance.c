/* Evaluating the modifiers of a material at a hit. */
#include "trace/appearance.h"

#include "scene/surface.h"
#include "trace/vertex.h"

static material_ray ray_of(const path_hit *hit, double length) {
    return (material_ray){.point = hit->point,
                          .direction = hit->direction,
                          .normal = hit->normal,
                          .distance = length + hit->distance,
                          .last_distance = hit->distance};
}

/* What a hit's appearance is found by. */
typedef struct encounter {
    material_ray ray;
    bool moved;              /* the material is written for another place: */
    rad_transform transform; /* from there to the scene */
    material_effect effect;  /* of the surface itself: a mesh's normal */
} encounter;

/* The ray there. */
static void move(encounter *e) {
    const rad_transform *t = &e->transform;
    e->ray.point = rad_transform_point_back(t, e->ray.point);
    e->ray.direction = rad_transform_direction_back(t, e->ray.direction);
    e->ray.normal = rad_transform_direction_back(t, e->ray.normal);
    e->ray.distance /= t->scale;
    e->ray.last_distance /= t->scale;
    e->effect.perturbation = rad_transform_direction_back(t, e->effect.perturbation);
}

static encounter meet(const graze_scene *scene, const path_hit *hit, double length) {
    encounter e = {.ray = ray_of(hit, length), .effect = {.color = {1, 1, 1}}};
    if (hit->surface < (int64_t)scene->surface_count)
        return e;
    scene_mesh_point mesh = scene_mesh_point_at(scene, hit->surface, hit->point);
    if (mesh.has_normal)
        e.effect.perturbation = vec3_subtract(mesh.normal, hit->normal);
    e.ray.u = mesh.uv[0];
    e.ray.v = mesh.uv[1];
    e.moved = scene_material_is_moved(scene, hit->surface, &e.transform);
    if (e.moved)
        move(&e);
    return e;
}

/* A unit vector of the scene, as the material's functions know it. */
static vec3 as_written(const encounter *e, vec3 direction) {
    return e->moved ? rad_transform_direction_back(&e->transform, direction) : direction;
}

material_ray appearance_ray(const graze_scene *scene, const path_hit *hit, double length) {
    return meet(scene, hit, length).ray;
}

static material_effect add_effect(const material_modifier *modifiers, const material_ray *ray, material_effect before) {
    material_effect e = material_modify(modifiers, ray);
    return (material_effect){rgb_multiply(before.color, e.color), vec3_add(before.perturbation, e.perturbation)};
}

/* Perturbations are for the surface's own normal. */
static vec3 lean(const path_hit *hit, const encounter *of, const material_effect *e) {
    vec3 normal = hit->behind ? vec3_negate(hit->normal) : hit->normal;
    vec3 perturbation = hit->behind ? vec3_negate(e->perturbation) : e->perturbation;
    if (of->moved)
        perturbation = rad_transform_direction(&of->transform, perturbation);
    return material_perturbed_normal(normal, perturbation, hit->direction);
}

/* Negative colours reflect nothing; what overflows would. */
static rgb colored(rgb color, rgb pattern) {
    rgb c = rgb_multiply(color, pattern);
    return (rgb){fmin(fmax(c.r, 0), SCENE_LARGEST_RADIANCE), fmin(fmax(c.g, 0), SCENE_LARGEST_RADIANCE),
                 fmin(fmax(c.b, 0), SCENE_LARGEST_RADIANCE)};
}

static void lean_vertex(const path_hit *hit, const encounter *of, const material_effect *e, vertex *v, vec3 *normal) {
    *normal = lean(hit, of, e);
    v->leans = normal->x != v->normal.x || normal->y != v->normal.y || normal->z != v->normal.z;
}

/* The function's part is for lights, the diffuse part for these, too; all else is reflected by the whole colour. */
static void prepare_function(const path *p, const path_hit *hit, const encounter *of, const material_reflection *r,
                             const material_effect *e, vertex *v) {
    rgb color = colored(r->color, e->color);
    const graze_material diffuse = {.kind = GRAZE_PLASTIC, .color = rgb_scale(1 - r->specularity, color)};
    vec3 normal;
    lean_vertex(hit, of, e, v, &normal);
    graze_surface_prepare(&v->shading, &diffuse, normal, vec3_negate(hit->direction), NULL);
    v->ambient = color;
    v->gloss_is_ambient = false;
    v->function = r;
    v->function_scene = of->moved ? p->context->scene : NULL;
    v->function_point = (material_reflection_point){of->ray, as_written(of, normal), color};
    v->function_point.ray.normal = as_written(of, v->normal);
    v->function_color = rgb_scale(r->specularity, r->metal ? color : rgb_gray(1));
}

/* Of panes, what they transmit is multiplied by the pattern; of dielectrics, what a unit of length does. */
static graze_material patterned(const graze_material *m, rgb pattern) {
    graze_material patterned = *m;
    if (m->kind == GRAZE_DIELECTRIC) {
        rgb inside = colored(m->inside, pattern);
        patterned.inside = (rgb){fmin(inside.r, 1), fmin(inside.g, 1), fmin(inside.b, 1)};
    } else if (m->kind != GRAZE_GLASS) {
        patterned.color = colored(m->color, pattern);
    }
    return patterned;
}

static void prepare_reflector(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                              const material_effect *e, vertex *v) {
    graze_material reflector = patterned(&m->reflector, e->color);
    if (m->orientation) {
        material_ray own = of->ray;
        own.normal = as_written(of, v->normal);
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
        v->shading.transmitted_specular = colored(v->shading.transmitted_specular, e->color);
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

static bool draw(const path *p, double share) {
    double random[2] = {0.5, 0.5};
    if (p->sampler)
        sampler_2d(p->sampler, random);
    return random[0] < share;
}

/* From where its functions see it. */
static void bring_to_scene(const encounter *of, graze_surface *s) {
    if (!of->moved)
        return;
    s->n = rad_transform_direction(&of->transform, s->n);
    s->x = rad_transform_direction(&of->transform, s->x);
    s->y = vec3_cross(s->n, s->x);
    s->view = rad_transform_direction(&of->transform, s->view);
    s->local_view = vec3_make(vec3_dot(s->view, s->x), vec3_dot(s->view, s->y), vec3_dot(s->view, s->n));
}

/* One surface where both parts have the same normal, as they mostly do; else one of them is drawn, for both. */
static void prepare_wgmd(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                         material_effect before, vertex *v) {
    const material_wgmd *w = m->wgmd;
    material_effect own = m->modifiers ? add_effect(m->modifiers, &of->ray, before) : before;
    material_effect shine = w->specular_inherits ? own : add_effect(w->specular_modifiers, &of->ray, before);
    const material_wgmd_point at = {.ray = of->ray,
                                    .model = m->reflector.model,
                                    .diffuse_normal = as_written(of, lean(hit, of, &own)),
                                    .specular_normal = as_written(of, lean(hit, of, &shine)),
                                    .diffuse_color = colored(rgb_gray(1), own.color),
                                    .specular_color = colored(rgb_gray(1), shine.color)};
    graze_surface diffuse, specular;
    material_wgmd_prepare(w, &at, &diffuse, &specular);
    bring_to_scene(of, &diffuse);
    bring_to_scene(of, &specular);
    v->function = NULL;
    v->shading = specular;
    v->shading.diffuse = diffuse.diffuse;
    if (!vec3_is_same(at.diffuse_normal, at.specular_normal)) {
        v->drawn = true;
        v->shading = draw(p, 0.5) ? diffuse : specular;
        v->shading.diffuse = rgb_scale(2, v->shading.diffuse);
        v->shading.specular = rgb_scale(2, v->shading.specular);
    }
    v->leans = !vec3_is_same(v->shading.n, v->normal);
    const graze_material threshold = {.specularity = rgb_brightness(specular.specular)};
    vertex_find_ambient(p, v, &threshold);
}

/* What a mixture is where its share cannot be computed, as in Radiance. */
static const scene_material black = {.reflector = {.kind = GRAZE_PLASTIC}};

static void prepare(const path *p, const path_hit *hit, const encounter *of, const scene_material *m, material_effect e,
                    vertex *v) {
    const scene_material *materials = p->context->scene->materials;
    if (m->wgmd) {
        prepare_wgmd(p, hit, of, m, e, v);
        return;
    }
    if (m->modifiers)
        e = add_effect(m->modifiers, &of->ray, e);
    if (m->reflection) {
        prepare_function(p, hit, of, m->reflection, &e, v);
        return;
    }
    if (!m->mixture) {
        prepare_reflector(p, hit, of, m, &e, v);
        return;
    }
    double share;
    if (!material_mixture_share(m->mixture, &of->ray, &share)) {
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
        *v = draw(p, share) ? fore : back;
        v->drawn = true;
    }
}

void appearance_prepare(const path *p, const path_hit *hit, const scene_material *m, vertex *v) {
    const encounter of = meet(p->context->scene, hit, p->length);
    prepare(p, hit, &of, m, of.effect, v);
}

vec3 appearance_normal(const graze_scene *scene, const path_hit *hit, double length) {
    const scene_material *m = &scene->materials[scene_surface_at(scene, hit->surface).material];
    const encounter of = meet(scene, hit, length);
    material_effect e = of.effect;
    for (;;) {
        if (m->modifiers)
            e = add_effect(m->modifiers, &of.ray, e);
        double share;
        if (!m->mixture || !material_mixture_share(m->mixture, &of.ray, &share))
            return lean(hit, &of, &e);
        m = &scene->materials[share >= 0.5 ? m->fore : m->back];
    }
}

vec3 appearance_smooth_normal(const graze_scene *scene, const path_hit *hit) {
    const encounter of = meet(scene, hit, 0);
    return lean(hit, &of, &of.effect);
}

static rgb straight_through(const scene_material *materials, const scene_material *m, const path_hit *hit,
                            const encounter *of, material_effect e) {
    if (m->emits || m->reflection || m->wgmd)
        return rgb_gray(0);
    if (m->modifiers)
        e = add_effect(m->modifiers, &of->ray, e);
    if (m->mixture) {
        double share;
        if (!material_mixture_share(m->mixture, &of->ray, &share))
            return rgb_gray(0);
        rgb fore = straight_through(materials, &materials[m->fore], hit, of, e);
        return blend(share, fore, straight_through(materials, &materials[m->back], hit, of, e));
    }
    graze_material reflector = patterned(&m->reflector, e.color);
    vec3 normal = lean(hit, of, &e);
    rgb through = graze_material_straight_through(&reflector, fabs(vec3_dot(normal, hit->direction)));
    return reflector.kind == GRAZE_GLASS ? colored(through, e.color) : through;
}

rgb appearance_straight_through(const graze_scene *scene, const scene_material *m, const path_hit *hit, double length) {
    const encounter of = meet(scene, hit, length);
    return straight_through(scene->materials, m, hit, &of, of.effect);
}
