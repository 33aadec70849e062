/* A scene being built, as the files that build it see it. */
#ifndef SCENE_BUILDER_H
#define SCENE_BUILDER_H

#include "scene/scene.h"

/* Materials that the description's primitives have become, and errors met on the way: one pass reports all. */
typedef struct scene_builder {
    graze_scene *scene;
    const graze_scene_settings *settings;
    const graze_report *report;
    size_t own, own_surfaces; /* of the primitives, those that are the scene's and no copied part's */
    int *material_of;         /* by primitive: index into scene->materials, or -1 */
    int nothing;              /* index of the one that is SCENE_NOTHING, or -1 */
    bool mixed_lights;        /* some mixture shines */
    graze_status status;
} scene_builder;

/* Notes that something has gone wrong, which has been reported. */
void scene_fail(scene_builder *, graze_status);

/* That may build, at least 1. */
int scene_builder_threads(const scene_builder *);

/* Sees to it that there are modifiers, which patterns and functions are compiled with. */
graze_status scene_need_modifiers(scene_builder *);

/* The material of a surface, or a negative number where it has none that can be used (reported). */
int scene_material_of_surface(scene_builder *, const rad_primitive *surface);

/* Whether some light goes straight through some of it. */
bool scene_material_is_pane(const graze_scene *, const scene_material *);

/* Of a surface, whether lights are sampled in it if it is flat. */
static inline bool scene_material_shows_lights(const scene_material *m) {
    return m->kind == SCENE_REFLECTOR && m->reflector.kind == GRAZE_MIRROR && !material_modifiers_lean(m->modifiers);
}

/* The same of panes, which show them faintly. */
static inline bool scene_material_shows_lights_faintly(const scene_material *m) {
    return m->kind == SCENE_REFLECTOR && m->reflector.kind == GRAZE_GLASS && !material_modifiers_lean(m->modifiers);
}

/* The material of a modifier, or a negative number where it has none that can be used (reported). */
int scene_material_of_modifier(scene_builder *, int modifier);

/* The material that is SCENE_NOTHING. */
int scene_nothing(scene_builder *);

/* What a material says that it is seen as, by its one string argument: an index into materials. */
graze_status scene_read_alternate(scene_builder *, const rad_primitive *, int *alternate);

/* What shines among the scene's own surfaces by a mixture is given its lights. After all other lights of the scene. */
void scene_add_mixed_lights(scene_builder *);

/* Of what only is seen, samples what lights others, as far as it can be. After all lights and copies. */
void scene_add_copied_lights(scene_builder *);

/* Builds what the instances and meshes of all parts are copies of; graze_scene.parts are then filled in. */
void scene_add_copies(scene_builder *);

#endif
