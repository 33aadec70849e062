/* Which surfaces' diffuse interreflection is computed, by the names of their modifiers. */
#include "scene/ambient_choice.h"

#include <string.h>

static bool is_modifier(const char *name, const rad_primitive *primitives, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!rad_type_is_surface(primitives[i].type) && strcmp(name, primitives[i].id) == 0)
            return true;
    return false;
}

void scene_check_ambient(const graze_scene_settings *settings, const rad_primitive *primitives, size_t count,
                         const graze_report *report) {
    for (size_t i = 0; i < settings->ambient_modifier_count; i++)
        if (!is_modifier(settings->ambient_modifiers[i], primitives, count))
            report_warning(report, NULL, "there is no modifier '%s' to %s diffuse interreflection",
                           settings->ambient_modifiers[i],
                           settings->ambient_modifiers_included ? "include in" : "exclude from");
}

bool scene_leaves_ambient_out(const graze_scene_settings *settings, const char *modifier) {
    bool listed = false;
    for (size_t i = 0; i < settings->ambient_modifier_count && !listed; i++)
        listed = strcmp(settings->ambient_modifiers[i], modifier) == 0;
    return listed != (settings->ambient_modifiers_included != 0);
}
