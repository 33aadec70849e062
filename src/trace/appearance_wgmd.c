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

void appearance_prepare_wgmd(const path *p, const path_hit *hit, const encounter *of, const scene_material *m,
                             material_effect before, vertex *v) {
    const material_wgmd *w = m->wgmd;
    material_effect own = encounter_add_effect(m->modifiers, &of->ray, before);
    material_effect shine = w->specular_inherits ? own : encounter_add_effect(w->specular_modifiers, &of->ray, before);
    const material_wgmd_point at = {.ray = of->ray,
                                    .model = m->model,
                                    .diffuse_normal = encounter_as_written(of, encounter_lean(hit, of, &own)),
                                    .specular_normal = encounter_as_written(of, encounter_lean(hit, of, &shine)),
                                    .diffuse_color = encounter_colored(rgb_gray(1), own.color),
                                    .specular_color = encounter_colored(rgb_gray(1), shine.color)};
    graze_surface diffuse, specular;
    material_wgmd_prepare(w, &at, &diffuse, &specular);
    bring_to_scene(of, &diffuse);
    bring_to_scene(of, &specular);
    v->function = NULL;
    v->shading = specular;
    v->shading.diffuse = diffuse.diffuse;
    if (!vec3_is_same(at.diffuse_normal, at.specular_normal)) {
        v->drawn = true;
        v->shading = appearance_draw(p, 0.5) ? diffuse : specular;
        v->shading.diffuse = rgb_scale(2, v->shading.diffuse);
        v->shading.specular = rgb_scale(2, v->shading.specular);
    }
    v->leans = !vec3_is_same(v->shading.n, v->normal);
    const graze_material threshold = {.specularity = rgb_brightness(specular.specular)};
    vertex_find_ambient(p, v, &threshold);
}
