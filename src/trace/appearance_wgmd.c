/* WGMDfunc at a hit. */
#include "trace/appearance_kinds.h"
#include "trace/vertex.h"

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

/* The point, each part with what modifies it. */
static material_wgmd_point look_at(const path_hit *hit, const encounter *of, const scene_material *m,
                                   material_effect before, const material_effect *own,
                                   material_effect effects[WGMD_PARTS]) {
    const material_wgmd *w = m->wgmd;
    material_wgmd_point at = {.ray = of->ray, .model = m->model};
    for (int part = 0; part < WGMD_PARTS; part++) {
        if (!w->has[part])
            continue;
        effects[part] = w->inherits[part] ? *own : encounter_add_effect(w->modifiers[part], &of->ray, before);
        at.normals[part] = encounter_as_written(of, encounter_lean(hit, of, &effects[part]));
        at.colors[part] = encounter_colored(rgb_gray(1), effects[part].color);
    }
    return at;
}

/* How far the through part's normal is from the surface's own, which bends what goes on beyond it. */
static vec3 look_through(const path *p, const path_hit *hit, const encounter *of, const material_effect *e,
                         bool rough) {
    vec3 own = hit->behind ? vec3_negate(hit->normal) : hit->normal;
    return appearance_straight_on(p, hit, vec3_subtract(encounter_lean(hit, of, e), own), rough);
}

/* Joins the parts whose normal is that of one of them. */
static graze_surface join(const graze_surface parts[WGMD_PARTS], const bool there[WGMD_PARTS],
                          const vec3 normals[WGMD_PARTS], int like) {
    graze_surface s = parts[like];
    for (int part = 0; part < WGMD_PARTS; part++)
        if (part != like && there[part] && vec3_is_same(normals[part], normals[like]))
            material_wgmd_join(&s, &parts[part]);
    return s;
}

/* The parts that stand for their normals, each the first of its own. */
static int find_normals(const bool there[WGMD_PARTS], const vec3 normals[WGMD_PARTS], int firsts[WGMD_PARTS]) {
    int count = 0;
    for (int part = 0; part < WGMD_PARTS; part++) {
        bool is_new = there[part];
        for (int i = 0; i < count; i++)
            is_new = is_new && !vec3_is_same(normals[part], normals[firsts[i]]);
        if (is_new)
            firsts[count++] = part;
    }
    return count;
}

static void multiply(graze_surface *s, double by) {
    s->diffuse = rgb_scale(by, s->diffuse);
    s->specular = rgb_scale(by, s->specular);
    s->transmitted_diffuse = rgb_scale(by, s->transmitted_diffuse);
    s->transmitted_specular = rgb_scale(by, s->transmitted_specular);
}

void appearance_prepare_wgmd(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                             material_effect before, const material_effect *own, vertex *v) {
    const material_wgmd *w = m->wgmd;
    material_effect effects[WGMD_PARTS];
    const material_wgmd_point at = look_at(hit, of, m, before, own, effects);
    graze_surface parts[WGMD_PARTS];
    int firsts[WGMD_PARTS];
    material_wgmd_prepare(w, &at, parts);
    int count = find_normals(w->has, at.normals, firsts);
    int drawn = count > 1 ? appearance_draw_of(p, count) : 0;
    const double reflected = w->has[WGMD_SPECULAR] ? rgb_brightness(parts[WGMD_SPECULAR].specular) : 0;
    const double transmitted = w->has[WGMD_THROUGH] ? rgb_brightness(parts[WGMD_THROUGH].transmitted_specular) : 0;
    v->shading = join(parts, w->has, at.normals, firsts[drawn]);
    if (count > 1) {
        v->drawn = true;
        multiply(&v->shading, count);
    }
    bring_to_scene(of, &v->shading);
    if (w->has[WGMD_THROUGH])
        v->shading.transmitted = look_through(p, hit, of, &effects[WGMD_THROUGH],
                                              v->shading.transmitted_lobe == GRAZE_LOBE_TRANSMITTED_GLOSSY);
    else
        v->shading.transmitted = hit->direction;
    v->function = NULL;
    v->leans = !vec3_is_same(v->shading.n, v->normal);
    vertex_set_ambient(p, v, reflected, transmitted);
}

rgb appearance_through_wgmd(const path_hit *hit, const encounter *of, const scene_material *m, material_effect before,
                            const material_effect *own) {
    material_effect effects[WGMD_PARTS];
    const material_wgmd_point at = look_at(hit, of, m, before, own, effects);
    return material_wgmd_through(m->wgmd, &at);
}
