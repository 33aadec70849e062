/* Checkpoints, in. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/fingerprint.h"
#include "base/whole_file.h"
#include "picture/checkpoint.h"
#include "picture/checkpoint_format.h"
#include "picture/state.h"

struct checkpoint {
    char *file;
    whole_file bytes;
    checkpoint_head head;
    const char *question, *command;
    const char *channels; /* their names, one behind the other */
    const unsigned char *states;
    const char *floats; /* not aligned */
    size_t finished;
    rad_view view;
};

static graze_status refuse(const checkpoint *c, const char *why, const graze_report *report) {
    return report_error(report, &(place){.file = c->file}, "%s", why);
}

static const char damaged[] = "this checkpoint is damaged";

/* The next part of the file; null where the file ends before. */
static const char *take(size_t *left, const char **at, uint64_t size) {
    if (size > *left)
        return NULL;
    const char *part = *at;
    *at += size;
    *left -= size;
    return part;
}

static const char *take_text(size_t *left, const char **at, uint64_t size) {
    const char *text = take(left, at, size);
    return text && size > 0 && text[size - 1] == 0 ? text : NULL;
}

static bool take_names(checkpoint *c, size_t *left, const char **at) {
    c->channels = *at;
    for (uint64_t i = 0; i < c->head.channel_count; i++) {
        const char *end = memchr(*at, 0, *left);
        if (!end)
            return false;
        (void)take(left, at, (size_t)(end - *at) + 1);
    }
    return true;
}

static bool take_pixels(checkpoint *c, size_t *left, const char **at) {
    if (c->head.width < 1 || c->head.height < 1 || c->head.width > *left || c->head.height > *left / c->head.width)
        return false;
    size_t count = c->head.width * c->head.height;
    c->states = (const unsigned char *)take(left, at, count);
    for (size_t i = 0; i < count; i++) {
        if (c->states[i] > FILM_UNCONVERGED)
            return false;
        c->finished += c->states[i] != FILM_MISSING;
    }
    c->floats = *at;
    return *left % sizeof(float) == 0 &&
           (c->finished == 0 ? *left == 0
                             : *left / sizeof(float) % c->finished == 0 &&
                                   *left / sizeof(float) / c->finished == c->head.channel_count + 1);
}

/* False for a view that could not have been prepared. */
static bool set_view(checkpoint *c) {
    double *numbers[CHECKPOINT_VIEW_NUMBERS];
    c->view.type = (char)c->head.view_type;
    checkpoint_view_numbers(&c->view, numbers);
    for (int i = 0; i < CHECKPOINT_VIEW_NUMBERS; i++)
        *numbers[i] = c->head.view[i];
    rad_view again = c->view;
    return rad_view_prepare(&again, NULL, NULL) == GRAZE_OK;
}

/* Finds the parts of the file. Null, or what is wrong. */
static const char *parse(checkpoint *c) {
    const char *at = c->bytes.bytes;
    size_t left = c->bytes.length;
    if (left < sizeof CHECKPOINT_MAGIC || memcmp(at, CHECKPOINT_MAGIC, sizeof CHECKPOINT_MAGIC) != 0)
        return "this is no checkpoint";
    if (left < sizeof c->head + sizeof(uint64_t))
        return damaged;
    memcpy(&c->head, at, sizeof c->head);
    if (c->head.version != CHECKPOINT_VERSION || c->head.mark != CHECKPOINT_MARK)
        return "this checkpoint is of another version of Graze or another kind of machine";
    uint64_t fingerprint;
    left -= sizeof fingerprint;
    memcpy(&fingerprint, at + left, sizeof fingerprint);
    if (fingerprint != fingerprint_add(FINGERPRINT_OF_NOTHING, at, left))
        return damaged;
    (void)take(&left, &at, sizeof c->head);
    c->question = take_text(&left, &at, c->head.question_size);
    c->command = c->question ? take_text(&left, &at, c->head.command_size) : NULL;
    if (!c->command || !take_names(c, &left, &at) || !take_pixels(c, &left, &at))
        return damaged;
    return set_view(c) ? NULL : damaged;
}

bool checkpoint_is(const char *file) {
    char magic[sizeof CHECKPOINT_MAGIC];
    FILE *in = fopen(file, "rb");
    if (!in)
        return false;
    bool is = fread(magic, sizeof magic, 1, in) == 1 && memcmp(magic, CHECKPOINT_MAGIC, sizeof magic) == 0;
    fclose(in);
    return is;
}

graze_status checkpoint_read(checkpoint **out, const char *file, const graze_report *report) {
    checkpoint *c = calloc(1, sizeof *c);
    *out = NULL;
    if (!c || !(c->file = strdup(file))) {
        free(c);
        return report_out_of_memory(report);
    }
    graze_status status = whole_file_read_path(&c->bytes, file, file, NULL, report);
    const char *trouble = status == GRAZE_OK ? parse(c) : NULL;
    if (trouble)
        status = refuse(c, trouble, report);
    if (status == GRAZE_OK)
        *out = c;
    else
        checkpoint_destroy(c);
    return status;
}

void checkpoint_destroy(checkpoint *c) {
    if (!c)
        return;
    free(c->bytes.bytes);
    free(c->file);
    free(c);
}

void checkpoint_settings(const checkpoint *c, picture_settings *settings) {
    settings->view = c->view;
    settings->width = (int)c->head.width;
    settings->height = (int)c->head.height;
    settings->pixel_aspect = c->head.pixel_aspect;
}

const char *checkpoint_command(const checkpoint *c) {
    return c->command;
}

static bool tells_of_scene(const char *line) {
    static const char scene[] = "scene ";
    return strncmp(line, scene, sizeof scene - 1) == 0;
}

/* Of a line of the question that differs. Of a scene it only has a number, which says nothing to readers. */
static graze_status complain(const checkpoint *c, const char *then, int then_length, const char *now, int now_length,
                             const graze_report *report) {
    if (tells_of_scene(then) && tells_of_scene(now))
        return refuse(c, "this picture was begun with another scene: it, or a file that it names, has changed", report);
    return report_error(report, &(place){.file = c->file},
                        "this picture was begun with '%.*s' and cannot go on with '%.*s'", then_length, then,
                        now_length, now);
}

/* Compares line by line. */
static graze_status check_question(const checkpoint *c, const char *now, const graze_report *report) {
    const char *then = c->question;
    while (*then || *now) {
        size_t then_length = strcspn(then, "\n"), now_length = strcspn(now, "\n");
        if (then_length != now_length || memcmp(then, now, now_length) != 0)
            return complain(c, then, (int)then_length, now, (int)now_length, report);
        then += then_length + (then[then_length] == '\n');
        now += now_length + (now[now_length] == '\n');
    }
    return GRAZE_OK;
}

/* Which of the checkpoint's planes has this name, or -1. */
static int find_channel(const checkpoint *c, const char *name) {
    const char *candidate = c->channels;
    for (int i = 0; i < (int)c->head.channel_count; i++) {
        if (strcmp(candidate, name) == 0)
            return i;
        candidate += strlen(candidate) + 1;
    }
    return -1;
}

/* Spreads the floats of plane `index` over the finished pixels. */
static void fill_plane(const checkpoint *c, float *plane, size_t index, size_t count) {
    const char *from = c->floats + index * c->finished * sizeof *plane;
    for (size_t i = 0; i < count; i++)
        if (c->states[i] != FILM_MISSING) {
            memcpy(&plane[i], from, sizeof *plane);
            from += sizeof *plane;
        }
}

graze_status checkpoint_resume(const checkpoint *c, rendering *p, const char *question, const graze_report *report) {
    film *f = &p->film;
    size_t count = (size_t)f->image->width * (size_t)f->image->height;
    graze_status status = check_question(c, question, report);
    if (status != GRAZE_OK)
        return status;
    if (c->head.width != (uint64_t)f->image->width || c->head.height != (uint64_t)f->image->height)
        return refuse(c, "this picture was begun with another size", report);
    for (int i = 0; i < f->image->channel_count; i++) {
        int plane = find_channel(c, f->image->channel_names[i]);
        if (plane < 0)
            return refuse(c, "this picture was begun without the layers that are wanted now", report);
        fill_plane(c, f->image->channels[i], (size_t)plane, count);
    }
    fill_plane(c, f->reached, c->head.channel_count, count);
    if (c->head.floor_known) {
        p->trace.floor = c->head.floor;
        atomic_store(&p->floor_known, true);
    }
    for (size_t i = 0; i < count; i++)
        if (c->states[i] != FILM_MISSING) {
            atomic_store(&f->states[i], c->states[i]);
            picture_count(p, i);
        }
    return GRAZE_OK;
}
