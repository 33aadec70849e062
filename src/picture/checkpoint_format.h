/* What checkpoints are made of, in their order. All numbers are as the machine has them.
 *
 *   checkpoint_head; question and command, each with its zero byte; the names of the channels, likewise;
 *   a byte for each pixel: its film_state;
 *   for each channel, then for the errors reached: the floats of the finished pixels, one after the other;
 *   the fingerprint of all bytes before, 64 bits. */
#ifndef PICTURE_CHECKPOINT_FORMAT_H
#define PICTURE_CHECKPOINT_FORMAT_H

#include <stdint.h>

#include "rad/view.h"

#define CHECKPOINT_MAGIC   "#?GRAZE_CHECKPOINT\n"
#define CHECKPOINT_VERSION 1
/* Tells machines with other numbers. */
#define CHECKPOINT_MARK 1.2345678901234567e-89

enum { CHECKPOINT_VIEW_NUMBERS = 26 };

/* No padding: 32 bytes, then doubles, then 64-bit numbers. */
typedef struct checkpoint_head {
    char magic[24];
    uint32_t version, view_type;
    double mark;
    double view[CHECKPOINT_VIEW_NUMBERS];
    double pixel_aspect;
    double floor;
    uint64_t floor_known;
    uint64_t width, height;
    uint64_t question_size, command_size, channel_count;
} checkpoint_head;

/* A view's numbers, those that rad_view_prepare has computed among them: doing that again might give other bits. */
static inline void checkpoint_view_numbers(rad_view *v, double *numbers[CHECKPOINT_VIEW_NUMBERS]) {
    vec3 *const vectors[] = {&v->point, &v->direction, &v->up, &v->axis, &v->right, &v->above};
    double *const scalars[] = {&v->horizontal, &v->vertical, &v->shift,         &v->lift,
                               &v->fore,       &v->aft,      &v->right_squared, &v->above_squared};
    int count = 0;
    for (int i = 0; i < 6; i++) {
        numbers[count++] = &vectors[i]->x;
        numbers[count++] = &vectors[i]->y;
        numbers[count++] = &vectors[i]->z;
    }
    for (int i = 0; i < 8; i++)
        numbers[count++] = scalars[i];
}

#endif
