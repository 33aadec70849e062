/* From primitives to the materials of a scene: what each does, with all that modifies it. */
#include <stdlib.h>
#include <string.h>

#include "material/amounts.h"
#include "material/from_primitive.h"
#include "scene/builder.h"
#include "scene/emitter.h"
#include "scene/mist.h"
#include "scene/model_choice.h"

/* A failure that is told once, where the material is first used. */
#define MATERIAL_REFUSED (-2)

/* A mirror that reflects no more than this straight on, as glass and varnish do, is faint: of the lights in it, much
 * less comes than straight from the lights. */
#define FAINT 0.1

/* Whether reflections in a material may bring much light that no light sample finds. Of a flat `mirror`, lights are
 * sampled; others of that material are found among the surfaces. */
static bool is_mirror(const graze_scene *scene, const scene_material *material) {
    const vec3 normal = {0, 0, 1};
    graze_surface probe;
    switch (material->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        if (scene_material_shows_lights(material))
            return false;
        graze_surface_prepare(&probe, &material->reflector, normal, normal, NULL);
        return probe.specular_lobe == GRAZE_LOBE_MIRROR && (material->modifiers || rgb_max(probe.specular) > FAINT);
    case SCENE_WGMD:
        return material->wgmd->may_mirror;
    case SCENE_FUNCTION:
        return material->reflection->mirrors;
    case SCENE_MIXTURE:
        return scene_material_shows_lights(&scene->materials[material->fore]) ||
               scene_material_shows_lights(&scene->materials[material->back]);
    case SCENE_EMITTER:
    case SCENE_PRISM:
    case SCENE_NOTHING:
        break;
    }
    return false;
}

bool scene_material_is_pane(const graze_scene *scene, const scene_material *material) {
    material = scene_material_seen(scene, material);
    switch (material->kind) {
    case SCENE_REFLECTOR:
    case SCENE_ORIENTED:
        return !rgb_is_black(graze_material_straight_through(&material->reflector, 1));
    case SCENE_MIXTURE:
        return scene_material_is_pane(scene, &scene->materials[material->fore]) ||
               scene_material_is_pane(scene, &scene->materials[material->back]);
    case SCENE_FUNCTION:
        return material->reflection->passes;
    case SCENE_WGMD:
        return material->wgmd->may_be_clear;
    case SCENE_NOTHING:
        return true;
    case SCENE_EMITTER:
    case SCENE_PRISM:
        break;
    }
    return false;
}

graze_status scene_need_modifiers(scene_builder *b) {
    graze_scene *scene = b->scene;
    if (!scene->modifiers)
        scene->modifiers = material_modifiers_create(scene->primitives, scene->primitive_count, b->report);
    return scene->modifiers ? GRAZE_OK : report_out_of_memory(b->report);
}

/* The chain of a modifier; all that is needed for patterns is made when the first is met. */
static graze_status find_chain(scene_builder *b, int modifier, material_chain *chain) {
    graze_scene *scene = b->scene;
    const rad_primitive *p = &scene->primitives[modifier];
    *chain = (material_chain){.material = modifier};
    if (p->modifier == RAD_VOID && p->type < RAD_TEXFUNC)
        return GRAZE_OK;
    graze_status status = scene_need_modifiers(b);
    if (status)
        return status;
    status = material_chain_find(chain, scene->modifiers, modifier);
    if (!status && chain->material == RAD_VOID)
        rad_primitive_warning(b->report, p, "there is no material behind it: light passes what it modifies");
    return status;
}

/* Half of a mixture: of void, or of patterns with no material behind them, light gets straight through, uncoloured. */
static int mixed_material(scene_builder *b, int modifier) {
    graze_scene *scene = b->scene;
    material_chain chain = {.material = RAD_VOID};
    if (modifier == RAD_VOID)
        return scene_nothing(b);
    bool refused = material_chain_find(&chain, scene->modifiers, modifier) != GRAZE_OK;
    return refused || chain.material != RAD_VOID ? scene_material_of_modifier(b, modifier) : scene_nothing(b);
}

/* Both materials of a mixture. */
static graze_status read_mixture(scene_builder *b, scene_material *material, const material_modifier *mixture) {
    const rad_primitive *p = mixture->primitive;
    material->kind = SCENE_MIXTURE;
    material->share = mixture;
    material->fore = mixed_material(b, mixture->fore);
    material->back = mixed_material(b, mixture->back);
    if (material->fore < 0 || material->back < 0)
        return b->status;
    const scene_material *all = b->scene->materials;
    if (scene_material_is_volume(&all[material->fore]) || scene_material_is_volume(&all[material->back]))
        return rad_primitive_error(b->report, p, "a mixture with mist or antimatter is not supported");
    const scene_material *fore = scene_material_seen(b->scene, &all[material->fore]);
    const scene_material *back = scene_material_seen(b->scene, &all[material->back]);
    material->fore = (int)(fore - all);
    material->back = (int)(back - all);
    const int by_fore = scene_material_shining(b->scene, material->fore);
    const int by_back = scene_material_shining(b->scene, material->back);
    if (by_fore >= 0 && by_back >= 0)
        return rad_primitive_error(b->report, p, "a mixture of two materials that shine is not supported");
    material->shining = by_fore >= 0 ? by_fore : by_back;
    b->mixed_lights = b->mixed_lights || material->shining >= 0;
    material->bends = scene_material_bends(fore) || scene_material_bends(back);
    material->has_back = scene_material_has_back(fore) || scene_material_has_back(back);
    return GRAZE_OK;
}

static graze_status read_emitter(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = SCENE_EMITTER;
    material->seen_light = -1;
    graze_status status = emitter_to_light(&material->light, p, b->report);
    material->light.modifiers = material->modifiers;
    if (status || p->type != RAD_ILLUM)
        return status;
    b->scene->has_secondary = true;
    return scene_read_alternate(b, p, &material->alternate);
}

static graze_status read_function(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = SCENE_FUNCTION;
    graze_status status = scene_need_modifiers(b);
    if (status)
        return status;
    return material_reflection_compile(&material->reflection, material_modifiers_library(b->scene->modifiers), p);
}

static graze_status read_prism(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = SCENE_PRISM;
    graze_status status = scene_need_modifiers(b);
    return status ? status
                  : material_prism_compile(&material->prism, material_modifiers_library(b->scene->modifiers), p);
}

/* Light goes through, but where a body that is cut is closed by the first material listed. */
static graze_status read_antimatter(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = SCENE_NOTHING;
    material->cuts = true;
    material->modifiers = NULL;
    /* One that is not there is told of with all that it cuts. */
    if (rad_modifier_before(b->scene->primitives, p, p->strings[0]) == RAD_VOID)
        return GRAZE_OK;
    return scene_read_alternate(b, p, &material->alternate);
}

static graze_status read_mist(scene_builder *b, scene_material *material, const rad_primitive *p) {
    graze_scene *scene = b->scene;
    material->kind = SCENE_NOTHING;
    if (material->modifiers)
        return rad_primitive_error(b->report, p, "patterns on mist are not supported");
    if (!scene->mist)
        scene->mist = calloc(1, sizeof *scene->mist);
    if (!scene->mist)
        return report_out_of_memory(b->report);
    if (scene->mist->count == MIST_MOST)
        return rad_primitive_error(b->report, p, "a scene may have no more than %d materials of mist", MIST_MOST);
    graze_status status = scene_mist_read(&scene->mist->of[scene->mist->count], p, b->report);
    if (status == GRAZE_OK)
        material->mist = scene->mist->count++;
    return status;
}

static graze_status read_wgmd(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = SCENE_WGMD;
    material->model = scene_choose_model(b->settings, p);
    graze_status status = scene_need_modifiers(b);
    return status ? status : material_wgmd_compile(&material->wgmd, b->scene->modifiers, p);
}

/* A mirror that is seen as something else. */
static graze_status read_mirror(scene_builder *b, scene_material *material, const rad_primitive *p) {
    graze_status status = scene_read_alternate(b, p, &material->alternate);
    if (status)
        return status;
    const scene_material *seen = scene_material_seen(b->scene, &b->scene->materials[material->alternate]);
    bool through = seen->kind == SCENE_REFLECTOR || seen->kind == SCENE_ORIENTED;
    through = through && (seen->reflector.kind == GRAZE_TRANS || seen->reflector.kind == GRAZE_GLASS ||
                          seen->reflector.kind == GRAZE_DIELECTRIC);
    material->keeps_front = !through;
    return GRAZE_OK;
}

static graze_status read_reflector(scene_builder *b, scene_material *material, const rad_primitive *p) {
    material->kind = material_orients_by_function(p) ? SCENE_ORIENTED : SCENE_REFLECTOR;
    graze_status status = material_from_primitive(&material->reflector, p, b->report);
    if (!status)
        status = material_check_largest(p, p->real_count, b->report);
    material->reflector.model = scene_choose_model(b->settings, p);
    if (!status && p->type == RAD_MIRROR && p->string_count > 0)
        return read_mirror(b, material, p);
    if (status || material->kind == SCENE_REFLECTOR)
        return status;
    status = scene_need_modifiers(b);
    if (status)
        return status;
    return material_orientation_compile(&material->orientation, material_modifiers_library(b->scene->modifiers), p);
}

static graze_status read_material(scene_builder *b, scene_material *material, const rad_primitive *p) {
    if (emitter_is(p->type))
        return read_emitter(b, material, p);
    if (material_reflects_by_function(p->type))
        return read_function(b, material, p);
    if (material_is_prism(p->type))
        return read_prism(b, material, p);
    if (p->type == RAD_MIST)
        return read_mist(b, material, p);
    if (p->type == RAD_ANTIMATTER)
        return read_antimatter(b, material, p);
    if (p->type == RAD_WGMDFUNC)
        return read_wgmd(b, material, p);
    return read_reflector(b, material, p);
}

static int add_material(scene_builder *b, int modifier) {
    graze_scene *scene = b->scene;
    material_chain chain;
    scene_material made = {.kind = SCENE_REFLECTOR, .alternate = -1, .mist = -1};
    graze_status status = find_chain(b, modifier, &chain);
    if (!status && chain.material == RAD_VOID)
        return scene_nothing(b);
    if (!status) {
        made.primitive = chain.material;
        made.modifiers = chain.modifiers;
        status = chain.mixture ? read_mixture(b, &made, chain.mixture)
                               : read_material(b, &made, &scene->primitives[chain.material]);
    }
    if (status != GRAZE_OK) {
        scene_fail(b, status);
        return MATERIAL_REFUSED;
    }
    scene->materials[scene->material_count] = made;
    scene->has_mirrors = scene->has_mirrors || is_mirror(scene, &made);
    scene->has_panes = scene->has_panes || scene_material_is_pane(scene, &made);
    scene->has_refraction = scene->has_refraction || scene_material_bends(&made);
    return (int)scene->material_count++;
}

int scene_material_of_modifier(scene_builder *b, int modifier) {
    if (b->material_of[modifier] == -1)
        b->material_of[modifier] = add_material(b, modifier);
    return b->material_of[modifier];
}

/* Surfaces without a material are there, and let light pass, as in Radiance. */
int scene_material_of_surface(scene_builder *b, const rad_primitive *surface) {
    int material;
    if (surface->modifier == RAD_VOID) {
        rad_primitive_warning(b->report, surface,
                              "this surface has no material, its modifier is void: light passes it");
        material = scene_nothing(b);
    } else {
        material = scene_material_of_modifier(b, surface->modifier);
    }
    b->scene->has_panes = b->scene->has_panes || (material >= 0 && material == b->nothing);
    return material;
}
