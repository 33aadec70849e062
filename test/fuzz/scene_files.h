/* Files and commands in memory, for targets that read scenes: nothing is opened, nothing is run. */
#ifndef FUZZ_SCENE_FILES_H
#define FUZZ_SCENE_FILES_H

#include <string.h>

#include "base/whole_file.h"
#include "fuzz/target.h"
#include "rad/scene_file.h"

/* The input is the file of this name; all others, and all commands, give a short text. */
static struct {
    const char *name;
    const uint8_t *data;
    size_t size;
} input_file;

static const char other_file[] = "void plastic other 0 0 5 .5 .5 .5 0 0\nother sphere it 0 0 4 0 0 0 1\n";

graze_status __wrap_whole_file_read_path(whole_file *, const char *path, const char *name, const place *,
                                         const graze_report *);
graze_status __wrap_rad_command_output(whole_file *, const char *command, const char *directory, const place *,
                                       const graze_report *);
int __wrap_access(const char *path, int mode);

static graze_status give(whole_file *file, const void *bytes, size_t size) {
    *file = (whole_file){malloc(size + 1), size};
    MUST(file->bytes);
    if (size)
        memcpy(file->bytes, bytes, size);
    file->bytes[size] = 0;
    return GRAZE_OK;
}

graze_status __wrap_whole_file_read_path(whole_file *file, const char *path, const char *name, const place *where,
                                         const graze_report *report) {
    (void)name;
    (void)where;
    (void)report;
    bool input = strcmp(path, input_file.name) == 0;
    return input ? give(file, input_file.data, input_file.size) : give(file, other_file, sizeof other_file - 1);
}

graze_status __wrap_rad_command_output(whole_file *file, const char *command, const char *directory, const place *where,
                                       const graze_report *report) {
    (void)directory;
    (void)where;
    (void)report;
    MUST(*command || true);
    return give(file, other_file, sizeof other_file - 1);
}

int __wrap_access(const char *path, int mode) {
    (void)path;
    (void)mode;
    return 0;
}

static void count_error(void *user, graze_severity severity, const char *text) {
    MUST(*text);
    *(int *)user += severity == GRAZE_ERROR;
}

static void check_primitive(const rad_primitive *primitives, size_t index) {
    const rad_primitive *p = &primitives[index];
    MUST(p->type < RAD_TYPE_COUNT && p->modifier >= RAD_VOID && (int64_t)p->modifier < (int64_t)index);
    MUST(p->modifier == RAD_VOID || !rad_type_is_surface(primitives[p->modifier].type));
    MUST(p->id && p->original_id && p->where && p->where->file);
    for (uint32_t i = 0; i < p->string_count; i++)
        MUST(p->strings[i]);
    for (uint32_t i = 0; i < p->real_count; i++)
        MUST(p->reals[i] - p->reals[i] == 0);
}

static void check_primitives(const rad_scene *scene) {
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(scene, &count);
    for (size_t i = 0; i < count; i++)
        check_primitive(primitives, i);
}

#endif
