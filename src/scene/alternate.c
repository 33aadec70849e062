/* Materials that are seen as others: illum, and mirror where it says so. */
#include <string.h>

#include "scene/builder.h"

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
    const bool is_void = !strcmp(name, "void");
    int modifier = is_void ? RAD_VOID : rad_modifier_before(b->scene->primitives, p, name);
    if (modifier == RAD_VOID && !is_void)
        rad_primitive_warning(b->report, p, "there is no modifier '%.64s' before it: as in Radiance, that is void",
                              name);
    if (modifier == RAD_VOID) {
        *alternate = scene_nothing(b);
        return GRAZE_OK;
    }
    *alternate = scene_material_of_modifier(b, modifier);
    if (*alternate < 0)
        return b->status;
    const scene_material *seen = &b->scene->materials[*alternate];
    if (scene_material_is_volume(seen))
        return rad_primitive_error(b->report, p, "it names %.64s, which is mist or antimatter: that is not supported",
                                   name);
    seen = scene_material_seen(b->scene, seen);
    return scene_material_emits(seen) ? rad_primitive_error(b->report, p, "it is seen as %s, which shines", name)
                                      : GRAZE_OK;
}
