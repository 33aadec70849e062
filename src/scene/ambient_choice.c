/* Which surfaces' diffuse interreflection is computed, by the names of their modifiers. */
#include "scene/ambient_choice.h"

#include <string.h>

void scene_check_ambient(const graze_scene_settings *settings, const rad_primitive *primitives, size_t count,
                         const graze_report *report) {
    for (size_t i = 0; i < settings->ambient_modifier_count; i++)
        if (rad_modifier_before(primitives, primitives + count, settings->ambient_modifiers[i]) == RAD_VOID)
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
