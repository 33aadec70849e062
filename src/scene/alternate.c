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

int scene_nothing(scene_builder *b) {
    graze_scene *scene = b->scene;
    if (b->nothing < 0) {
        b->nothing = (int)scene->material_count++;
        scene->materials[b->nothing] =
            (scene_material){.kind = SCENE_NOTHING, .primitive = RAD_VOID, .alternate = -1, .mist = -1};
    }
    return b->nothing;
}

graze_status scene_read_alternate(scene_builder *b, const rad_primitive *p, int *alternate) {
    const char *name = p->string_count > 0 ? p->strings[0] : "void";
    if (!strcmp(name, "void")) {
        *alternate = scene_nothing(b);
        return GRAZE_OK;
    }
    int modifier = find_before(b->scene, p, name);
    if (modifier == RAD_VOID)
        return rad_primitive_error(b->report, p, "there is no modifier '%.64s' before it", name);
    *alternate = scene_material_of_modifier(b, modifier);
    if (*alternate < 0)
        return b->status;
    const scene_material *seen = scene_material_seen(b->scene, &b->scene->materials[*alternate]);
    if (scene_material_is_region(&b->scene->materials[*alternate]))
        return rad_primitive_error(b->report, p, "it names '%.64s', mist or antimatter: that is not supported", name);
    return scene_material_emits(seen) ? rad_primitive_error(b->report, p, "it is seen as %s, which shines", name)
                                      : GRAZE_OK;
}
