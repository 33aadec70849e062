/* Scenes written down in a test. Include after cmocka.h. */
#ifndef TEST_SUPPORT_SCENE_TEXT_H
#define TEST_SUPPORT_SCENE_TEXT_H

#include "graze/scene.h"
#include "support/written_file.h"

/* Loads a scene from its text, built by the settings; null if it does not load. Leaves what was reported in `messages`.
 */
static inline graze_scene *scene_from_text_with(const char *text, const graze_scene_settings *settings) {
    written_file file = written_file_make(text, strlen(text));
    const char *names[] = {file.name};
    graze_scene *scene = NULL;
    messages[0] = 0;
    graze_status status = graze_scene_load(&scene, names, 1, settings, &remembering);
    unlink(file.name);
    return status == GRAZE_OK ? scene : NULL;
}

static inline graze_scene *scene_from_text(const char *text) {
    return scene_from_text_with(text, NULL);
}

/* The same of one that must load: else the test fails, with what was reported. */
static inline graze_scene *load_scene(const char *text) {
    graze_scene *scene = scene_from_text(text);
    if (!scene)
        fail_msg("%s: %s", text, messages);
    return scene;
}

#endif
