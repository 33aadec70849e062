/* Scenes written down in a test. */
#ifndef TEST_SUPPORT_SCENE_TEXT_H
#define TEST_SUPPORT_SCENE_TEXT_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "graze/scene.h"

/* The last messages that a scene's loading gave. */
static char scene_messages[4096];

static inline void scene_text_remember(void *user, graze_severity severity, const char *text) {
    (void)user;
    size_t length = strlen(scene_messages);
    snprintf(scene_messages + length, sizeof scene_messages - length, "%s: %s\n",
             severity == GRAZE_ERROR ? "error" : "warning", text);
}

/* Loads a scene from its text, built by the settings; null if it does not load. */
static inline graze_scene *scene_from_text_with(const char *text, const graze_scene_settings *settings) {
    char name[] = "/tmp/graze-scene-XXXXXX";
    int descriptor = mkstemp(name);
    if (descriptor < 0 || write(descriptor, text, strlen(text)) != (ssize_t)strlen(text))
        abort();
    close(descriptor);
    scene_messages[0] = 0;
    const char *names[] = {name};
    graze_report report = {scene_text_remember, NULL};
    graze_scene *scene = NULL;
    graze_status status = graze_scene_load(&scene, names, 1, settings, &report);
    unlink(name);
    return status == GRAZE_OK ? scene : NULL;
}

static inline graze_scene *scene_from_text(const char *text) {
    return scene_from_text_with(text, NULL);
}

#endif
