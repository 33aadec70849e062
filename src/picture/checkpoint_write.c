/* Checkpoints, out. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/fingerprint.h"
#include "picture/checkpoint.h"
#include "picture/checkpoint_format.h"
#include "picture/state.h"

/* Bytes on their way to the file. */
typedef struct sink {
    FILE *out;
    uint64_t fingerprint;
} sink;

static void put(sink *s, const void *bytes, size_t size) {
    s->fingerprint = fingerprint_add(s->fingerprint, bytes, size);
    fwrite(bytes, 1, size, s->out); /* ferror() tells in the end */
}

static void put_head(sink *s, const rendering *p, const checkpoint_labels *labels) {
    rad_view view = p->settings.view;
    double *numbers[CHECKPOINT_VIEW_NUMBERS];
    checkpoint_head head = {
        .magic = CHECKPOINT_MAGIC,
        .version = CHECKPOINT_VERSION,
        .view_type = (unsigned char)view.type,
        .mark = CHECKPOINT_MARK,
        .pixel_aspect = p->settings.pixel_aspect,
        .width = (uint64_t)p->settings.width,
        .height = (uint64_t)p->settings.height,
        .question_size = strlen(labels->question) + 1,
        .command_size = strlen(labels->command) + 1,
        .channel_count = (uint64_t)p->film.image->channel_count,
    };
    checkpoint_view_numbers(&view, numbers);
    for (int i = 0; i < CHECKPOINT_VIEW_NUMBERS; i++)
        head.view[i] = *numbers[i];
    if (atomic_load(&p->floor_known)) {
        head.floor = p->trace.floor;
        head.floor_known = 1;
    }
    put(s, &head, sizeof head);
    put(s, labels->question, head.question_size);
    put(s, labels->command, head.command_size);
    for (int c = 0; c < p->film.image->channel_count; c++)
        put(s, p->film.image->channel_names[c], strlen(p->film.image->channel_names[c]) + 1);
}

/* The floats of a plane's finished pixels; `gathered` has room for a row. */
static void put_plane(sink *s, const float *plane, const unsigned char *states, const image *size, float *gathered) {
    for (int y = 0; y < size->height; y++) {
        size_t row = (size_t)y * (size_t)size->width, count = 0;
        for (size_t x = 0; x < (size_t)size->width; x++)
            if (states[row + x] != FILM_MISSING)
                gathered[count++] = plane[row + x];
        put(s, gathered, count * sizeof *gathered);
    }
}

static void put_pixels(sink *s, const film *f, unsigned char *states, float *gathered) {
    const image *picture = f->image;
    size_t count = (size_t)picture->width * (size_t)picture->height;
    /* What is finished from now on comes into the next checkpoint. */
    for (size_t i = 0; i < count; i++)
        states[i] = (unsigned char)film_state_of(f, i);
    put(s, states, count);
    for (int c = 0; c < picture->channel_count; c++)
        put_plane(s, picture->channels[c], states, picture, gathered);
    put_plane(s, f->reached, states, picture, gathered);
}

static graze_status write_all(const rendering *p, FILE *out, const char *file, const checkpoint_labels *labels,
                              const graze_report *report) {
    const image *size = p->film.image;
    unsigned char *states = malloc((size_t)size->width * (size_t)size->height);
    float *gathered = malloc((size_t)size->width * sizeof *gathered);
    graze_status status = GRAZE_OK;
    if (!states || !gathered) {
        status = report_out_of_memory(report);
    } else {
        sink s = {out, FINGERPRINT_OF_NOTHING};
        errno = 0;
        put_head(&s, p, labels);
        put_pixels(&s, &p->film, states, gathered);
        uint64_t fingerprint = s.fingerprint;
        put(&s, &fingerprint, sizeof fingerprint);
        if (fflush(out) != 0 || ferror(out) || fsync(fileno(out)) != 0)
            status = report_system_error(report, &(place){.file = file}, "cannot write the checkpoint");
    }
    free(states);
    free(gathered);
    return status;
}

static char *new_name(const char *file) {
    size_t size = strlen(file) + sizeof ".new";
    char *name = malloc(size);
    if (name)
        snprintf(name, size, "%s.new", file);
    return name;
}

static graze_status write_and_move(const rendering *p, const char *file, const char *path,
                                   const checkpoint_labels *labels, const graze_report *report) {
    FILE *out = fopen(path, "wb");
    if (!out)
        return report_file_error(report, &(place){.file = file}, "the checkpoint cannot be created");
    graze_status status = write_all(p, out, file, labels, report);
    if (fclose(out) != 0 && status == GRAZE_OK)
        status = report_system_error(report, &(place){.file = file}, "cannot write the checkpoint");
    if (status == GRAZE_OK && rename(path, file) != 0)
        status = report_file_error(report, &(place){.file = file}, "the checkpoint cannot be put in its place");
    if (status != GRAZE_OK)
        unlink(path);
    return status;
}

graze_status checkpoint_write(const rendering *p, const char *file, const checkpoint_labels *labels,
                              const graze_report *report) {
    char *path = new_name(file);
    if (!path)
        return report_out_of_memory(report);
    graze_status status = write_and_move(p, file, path, labels, report);
    free(path);
    return status;
}

void checkpoint_remove(const char *file) {
    char *path = new_name(file);
    if (path && checkpoint_is(path))
        unlink(path);
    free(path);
    if (checkpoint_is(file))
        unlink(file);
}
