/* What the tests of pictures under way share: a scene, its view, and a rendering of it. */
#ifndef TEST_PICTURE_SUPPORT_H
#define TEST_PICTURE_SUPPORT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "picture/picture.h"
#include "support/scene_text.h"

enum { WIDTH = 40, HEIGHT = 30, PIXELS = WIDTH * HEIGHT };

/* A glossy floor below a lamp. */
static const char room[] =
    "void metal2 m 4 1 0 0 . 0 6 .6 .6 .6 .8 .1 .2 m polygon floor 0 0 12 -9 -9 0 9 -9 0 9 9 0 -9 9 0\n"
    "void light l 0 0 3 9 9 9 l sphere lamp 0 0 4 0 3 1 .3\n";

/* From above the floor, on two threads, with all layers. */
static inline picture_settings room_settings(void) {
    picture_settings s = {.view = rad_view_default(),
                          .width = WIDTH,
                          .height = HEIGHT,
                          .pixel_aspect = 1,
                          .jitter = 1,
                          .spacing = 4,
                          .content = PICTURE_LAYERS,
                          .threads = 2};
    s.view.point = (vec3){0, -4, 1};
    s.view.direction = (vec3){0, 1, -0.2};
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    return s;
}

typedef struct sitting {
    graze_scene *scene;
    rendering *picture;
} sitting;

static inline sitting sitting_begin(const char *text, const graze_trace_settings *trace, const picture_settings *s) {
    sitting begun = {.scene = scene_from_text(text)};
    assert_non_null(begun.scene);
    assert_int_equal(picture_begin(&begun.picture, begun.scene, trace, s, NULL), GRAZE_OK);
    return begun;
}

static inline void sitting_end(sitting *s) {
    picture_destroy(s->picture);
    graze_scene_destroy(s->scene);
}

/* A rendering that is finished. */
static inline sitting sitting_of(const char *text, const graze_trace_settings *trace, const picture_settings *s) {
    sitting whole = sitting_begin(text, trace, s);
    assert_int_equal(picture_render(whole.picture, NULL), GRAZE_OK);
    picture_progress end = picture_look(whole.picture);
    assert_int_equal(end.finished, end.total);
    return whole;
}

static inline const float *plane(const sitting *s, const char *name) {
    const float *found = image_channel(picture_image(s->picture), name);
    assert_non_null(found);
    return found;
}

static inline void assert_same_pictures(const sitting *a, const sitting *b) {
    const image *first = picture_image(a->picture), *second = picture_image(b->picture);
    size_t size = sizeof(float) * (size_t)first->width * (size_t)first->height;
    assert_int_equal(first->channel_count, second->channel_count);
    for (int c = 0; c < first->channel_count; c++)
        assert_memory_equal(first->channels[c], second->channels[c], size);
}

#endif
