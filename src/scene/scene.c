/* Loading a scene: from a flat list of primitives to surfaces, materials and lights ready to trace. */
#include "scene/scene.h"

#include <stdlib.h>

#include "base/angle.h"
#include "geometry/shaft.h"
#include "scene/ambient_choice.h"
#include "scene/balls.h"
#include "scene/builder.h"
#include "scene/cuts.h"
#include "scene/emitter.h"
#include "scene/light_pattern.h"
#include "scene/mirrors.h"
#include "scene/mist.h"
#include "scene/model_choice.h"
#include "scene/shapes.h"
#include "scene/sight_cells.h"
#include "scene/windows.h"

const char *scene_name(const graze_scene *scene, int primitive) {
    return scene->primitives[primitive].id;
}

const char *scene_modifier_name(const graze_scene *scene, int primitive) {
    int modifier = scene->primitives[primitive].modifier;
    return modifier == RAD_VOID ? "void" : scene->primitives[modifier].id;
}

/* The material of a surface: behind patterns and textures. A mixture of materials ends a chain, too. */
static int material_behind(const graze_scene *scene, int primitive) {
    int modifier = scene->primitives[primitive].modifier;
    while (modifier != RAD_VOID && scene->primitives[modifier].type >= RAD_TEXFUNC &&
           scene->primitives[modifier].modifier != RAD_VOID)
        modifier = scene->primitives[modifier].modifier;
    return modifier;
}

const char *scene_material_name(const graze_scene *scene, int primitive) {
    int modifier = material_behind(scene, primitive);
    return modifier == RAD_VOID ? "void" : scene->primitives[modifier].original_id;
}

void scene_fail(scene_builder *b, graze_status status) {
    if (status > b->status)
        b->status = status;
}

int scene_builder_threads(const scene_builder *b) {
    return b->settings->threads > 1 ? b->settings->threads : 1;
}

static void add_light(scene_builder *b, scene_light light) {
    if (!rgb_is_black(light.radiance))
        b->scene->lights[b->scene->light_count++] = light;
}

/* Surfaces of mist are not met: they tell where it is. */
static void add_bound(scene_builder *b, mist_material *mist, const shape *bound) {
    shape *grown = realloc(mist->own, (mist->own_count + 1) * sizeof *grown);
    if (!grown) {
        scene_fail(b, report_out_of_memory(b->report));
        return;
    }
    mist->own = grown;
    mist->own[mist->own_count++] = *bound;
}

static void add_shape(scene_builder *b, const scene_shapes *made, size_t number) {
    graze_scene *scene = b->scene;
    size_t index = scene->surface_count;
    int primitive = made->primitives[number];
    int material = scene_shapes_take(b, made, number, &scene->shapes[index]);
    if (material < 0)
        return;
    if (scene->materials[material].mist >= 0) {
        add_bound(b, &scene->mist->of[scene->materials[material].mist], &scene->shapes[index]);
        return;
    }
    scene->surfaces[index] = (scene_surface){
        .primitive = primitive,
        .material = material,
        .light = -1,
        .no_ambient = scene_leaves_ambient_out(b->settings, scene_modifier_name(scene, primitive)),
    };
    scene->surface_count++;
    scene_mirrors_note(b, (int)index);
    if (!scene_material_emits(&scene->materials[material]))
        return;
    if (!shape_prepare_light(&scene->shapes[index], scene->memory))
        scene_fail(b, report_out_of_memory(b->report));
    scene_light light = scene->materials[material].light;
    light.shape = &scene->shapes[index];
    light.surface = (int)index;
    light.primitive = primitive;
    if (!rgb_is_black(light.radiance))
        scene->surfaces[index].light = (int)scene->light_count;
    add_light(b, light);
}

static void add_source(scene_builder *b, int primitive) {
    const rad_primitive *p = &b->scene->primitives[primitive];
    int material = scene_material_of_surface(b, p);
    if (material < 0)
        return;
    if (!scene_material_emits(&b->scene->materials[material])) {
        const bool mixed = scene_material_shining(b->scene, material) >= 0;
        rad_primitive_warning(b->report, p, "a source whose material %s does nothing%s",
                              mixed ? "is a mixture" : "does not shine", mixed ? ", as in Radiance" : "");
        return;
    }
    const double *a = p->reals;
    if (!(a[3] > 0) || !(vec3_max_abs(vec3_make(a[0], a[1], a[2])) > 0)) {
        scene_fail(b, rad_primitive_error(b->report, p, "its direction must not be null, nor its angle 0 or less"));
        return;
    }
    const double angle = emitter_full_angle(a[3], p, b->report);
    if (angle == 0)
        return;
    scene_light light = b->scene->materials[material].light;
    light.surface = -1;
    light.primitive = primitive;
    light.center = vec3_safe_normalize(vec3_make(a[0], a[1], a[2]));
    light.half_angle = angle_radians(angle / 2);
    if (light.spot) {
        rad_primitive_warning(b->report, p, "a source is infinitely far away: the spotlight's cone is ignored");
        light.spot = false;
    }
    add_light(b, light);
}

static bool is_glow_source(const graze_scene *scene, int primitive) {
    int material = material_behind(scene, primitive);
    return material != RAD_VOID && scene->primitives[material].type == RAD_GLOW;
}

static bool sources_overlap(const scene_light *a, const scene_light *b) {
    double between = vec3_length(vec3_subtract(a->center, b->center)), angle = a->half_angle + b->half_angle;
    return angle >= PI || between <= 2 * sin(angle / 2);
}

/* What is asked of sources again and again. */
static void survey_sources(graze_scene *scene) {
    for (size_t i = scene->first_source; i < scene->light_count; i++) {
        scene_light *light = &scene->lights[i];
        scene->has_sky = scene->has_sky || scene_light_is_sky(light);
        light->alone = true;
        for (size_t k = scene->first_source; k < i && light->alone; k++)
            light->alone = !sources_overlap(light, &scene->lights[k]);
        scene->suns_overlap = scene->suns_overlap || !(light->alone || light->glow);
    }
}

/* The surfaces in the description's order; then the sources, `light` before `glow`, as a ray prefers them. */
static void add_surfaces(scene_builder *b) {
    graze_scene *scene = b->scene;
    scene_shapes made;
    graze_status status = scene_shapes_make(&made, b, 0, b->own, scene->shapes);
    if (status)
        scene_fail(b, status);
    for (size_t i = 0; i < made.count && !status; i++)
        add_shape(b, &made, i);
    scene_shapes_free(&made);
    scene->first_source = scene->light_count;
    for (int glow = 0; glow <= 1 && rad_scene_count(scene->description, RAD_SOURCE) > 0; glow++)
        for (size_t i = 0; i < b->own; i++)
            if (scene->primitives[i].type == RAD_SOURCE && is_glow_source(scene, (int)i) == glow)
                add_source(b, (int)i);
    scene->first_copied = scene->light_count;
    survey_sources(scene);
}

/* Whether there is a light that may be known without sampling where it is seen wholly. */
static bool needs_sights(const graze_scene *scene) {
    for (size_t i = 0; i < scene->light_count; i++) {
        const scene_light *light = &scene->lights[i];
        if (!light->spot && !light->only_seen &&
            (light->shape ? light->shape->kind != SHAPE_CONE : light->half_angle < PI / 2))
            return true;
    }
    return false;
}

/* Arrays as large as they can become: surfaces and materials are primitives, lights are surfaces, or materials where
 * they are only seen. */
static graze_status allocate(scene_builder *b) {
    graze_scene *scene = b->scene;
    size_t surfaces = b->own_surfaces, modifiers = scene->primitive_count - surfaces;
    scene->memory = arena_create();
    scene->shapes = calloc(surfaces + 1, sizeof *scene->shapes);
    scene->surfaces = calloc(surfaces + 1, sizeof *scene->surfaces);
    scene->materials = calloc(modifiers + 1, sizeof *scene->materials); /* one may be void */
    scene->lights = calloc(scene->primitive_count + 1, sizeof *scene->lights);
    b->material_of = malloc((scene->primitive_count + 1) * sizeof *b->material_of);
    if (!scene->memory || !scene->shapes || !scene->surfaces || !scene->materials || !scene->lights || !b->material_of)
        return report_out_of_memory(b->report);
    for (size_t i = 0; i < scene->primitive_count; i++)
        b->material_of[i] = -1;
    return GRAZE_OK;
}

static bool has_copies(const graze_scene *scene) {
    return rad_scene_count(scene->description, RAD_MESH) + rad_scene_count(scene->description, RAD_INSTANCE) > 0;
}

static graze_status read_description(scene_builder *b, const char *const *names, size_t count) {
    graze_scene *scene = b->scene;
    graze_status status = rad_scene_read_by(scene_builder_threads(b), &scene->description, names, count, b->report);
    if (status)
        return status;
    (void)rad_scene_primitives(scene->description, &b->own);
    for (int type = 0; type < RAD_TYPE_COUNT; type++)
        if (rad_type_is_surface((rad_type)type))
            b->own_surfaces += rad_scene_count(scene->description, (rad_type)type);
    return has_copies(scene) ? rad_scene_read_parts(scene->description, b->report) : GRAZE_OK;
}

static graze_status add_definitions(scene_builder *b) {
    const graze_scene_settings *s = b->settings;
    graze_status status = s->definition_count > 0 ? scene_need_modifiers(b) : GRAZE_OK;
    for (size_t i = 0; i < s->definition_count && status == GRAZE_OK; i++)
        status = material_library_define(material_modifiers_library(b->scene->modifiers), s->definitions[i].text,
                                         s->definitions[i].file);
    return status;
}

/* From primitives to surfaces, materials and lights. */
static graze_status add_all(scene_builder *b) {
    graze_scene *scene = b->scene;
    scene->primitives = rad_scene_primitives(scene->description, &scene->primitive_count);
    b->status = scene_check_models(b->settings, scene->primitives, scene->primitive_count, b->report);
    if (b->status == GRAZE_OK)
        b->status = allocate(b);
    if (b->status == GRAZE_OK)
        b->status = add_definitions(b);
    if (b->status != GRAZE_OK)
        return b->status;
    scene_check_ambient(b->settings, scene->primitives, scene->primitive_count, b->report);
    add_surfaces(b);
    scene_add_mixed_lights(b);
    if (has_copies(scene) && b->status != GRAZE_SYSTEM_ERROR)
        scene_add_copies(b);
    if (scene->seen_light_count > 0 && b->status == GRAZE_OK)
        scene_add_copied_lights(b);
    return b->status;
}

static graze_status build_geometry(scene_builder *b) {
    graze_scene *scene = b->scene;
    size_t count = scene->part_count ? scene->part_count : 1;
    geometry_group *groups = calloc(count, sizeof *groups);
    if (!groups)
        return report_out_of_memory(b->report);
    groups[0] = (geometry_group){.shapes = scene->shapes, .shape_count = scene->surface_count};
    for (size_t i = 0; i < scene->part_count; i++) {
        const scene_part *part = &scene->parts[i];
        groups[i] = (geometry_group){part->shapes, part->surface_count, part->placements, part->copy_count};
    }
    graze_status status = geometry_build(&scene->geometry, groups, count, scene_builder_threads(b), b->report);
    free(groups);
    if (status == GRAZE_OK)
        status = scene_windows_find(scene, b->report);
    if (status != GRAZE_OK || !needs_sights(scene))
        return status;
    status = geometry_prepare_sights(scene->geometry, b->report);
    return status != GRAZE_OK ? status : sight_cells_make(scene, b->report);
}

graze_status graze_scene_load(graze_scene **out, const char *const *descriptions, size_t count,
                              const graze_scene_settings *settings, const graze_report *report) {
    static const graze_scene_settings as_described = {0};
    *out = NULL;
    graze_scene *scene = calloc(1, sizeof *scene);
    if (!scene)
        return report_out_of_memory(report);
    scene_builder b = {.scene = scene,
                       .settings = settings ? settings : &as_described,
                       .report = report,
                       .nothing = -1,
                       .status = GRAZE_OK};
    b.status = read_description(&b, descriptions, count);
    if (b.status == GRAZE_OK)
        b.status = add_all(&b);
    if (b.status == GRAZE_OK)
        b.status = scene_cuts_make(scene, scene_builder_threads(&b), report);
    if (b.status == GRAZE_OK)
        b.status = scene_mist_make(scene, scene_builder_threads(&b), report);
    if (b.status == GRAZE_OK)
        b.status = light_patterns_prepare(scene, scene_builder_threads(&b), report);
    if (b.status == GRAZE_OK)
        b.status = light_tree_build(&scene->light_tree, scene->lights, scene->light_count, scene->memory, report);
    if (b.status == GRAZE_OK)
        b.status = scene_mirrors_make(scene, report);
    if (b.status == GRAZE_OK)
        b.status = scene_balls_find(scene, report);
    if (b.status == GRAZE_OK)
        b.status = build_geometry(&b);
    free(b.material_of);
    if (b.status != GRAZE_OK) {
        graze_scene_destroy(scene);
        return b.status;
    }
    *out = scene;
    return GRAZE_OK;
}

void graze_scene_destroy(graze_scene *scene) {
    if (!scene)
        return;
    geometry_destroy(scene->geometry);
    sight_cells_destroy(scene->sight_cells);
    scene_cuts_destroy(scene->cuts);
    scene_mist_destroy(scene->mist);
    material_modifiers_destroy(scene->modifiers);
    for (size_t i = 0; i < scene->part_count; i++) {
        scene_part *part = &scene->parts[i];
        if (i > 0) {
            free(part->shapes);
            free(part->surfaces);
        }
        free(part->placements);
        free(part->replacing);
    }
    free(scene->parts);
    free(scene->lights);
    free(scene->mirror_surfaces);
    free(scene->mirrors);
    free(scene->mirror_of);
    free(scene->mirrored_lights);
    free(scene->materials);
    free(scene->surfaces);
    free(scene->shapes);
    arena_destroy(scene->memory);
    rad_scene_destroy(scene->description);
    free(scene);
}
