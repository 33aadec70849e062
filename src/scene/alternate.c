/* Materials that are seen as others: illum, and mirror where it says so. */
#include <string.h>

#include "scene/builder.h"

/* The latest modifier of that name before the primitive, or RAD_VOID. */
static int find_before(const graze_scene *scene, const rad_primitive *p, const char *name) {
    for (const rad_primitive *q = p; q-- > scene->primitives;)
        if (!rad_type_is_surface(q->type) && !strcmp(q->id, name))
            return (int)(q - scene->primitives);
    return RAD_VOID;
}

/* The material that is not there. */
static int nothing(graze_scene *scene) {
    if (scene->nothing >= 0)
        return scene->nothing;
    scene->nothing = (int)scene->material_count++;
    scene->materials[scene->nothing] = (scene_material){
        .kind = SCENE_REFLECTOR,
        .primitive = RAD_VOID,
        .reflector = {.kind = GRAZE_TRANS, .color = {1, 1, 1}, .transmission = 1, .transmitted_specularity = 1},
        .alternate = -1,
    };
    scene->has_panes = true;
    return scene->nothing;
}

graze_status scene_read_alternate(scene_builder *b, const rad_primitive *p, int *alternate) {
    const char *name = p->string_count > 0 ? p->strings[0] : "void";
    if (!strcmp(name, "void")) {
        *alternate = nothing(b->scene);
        return GRAZE_OK;
    }
    int modifier = find_before(b->scene, p, name);
    if (modifier == RAD_VOID)
        return rad_primitive_error(b->report, p, "there is no modifier '%.64s' before it", name);
    *alternate = scene_material_of_modifier(b, modifier);
    if (*alternate < 0)
        return b->status;
    const scene_material *seen = scene_material_seen(b->scene, &b->scene->materials[*alternate]);
    return scene_material_emits(seen) ? rad_primitive_error(b->report, p, "it is seen as %s, which shines", name)
                                      : GRAZE_OK;
}
