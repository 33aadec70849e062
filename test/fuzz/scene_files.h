/* Files and commands in memory, for targets that read scenes: nothing is opened, nothing is run. */
#ifndef FUZZ_SCENE_FILES_H
#define FUZZ_SCENE_FILES_H

#include <string.h>

#include "base/whole_file.h"
#include "fuzz/target.h"
#include "rad/scene_file.h"

/* The input is the file of this name; function and data files, all others, and all commands give a short text. */
static struct {
    const char *name;
    const uint8_t *data;
    size_t size;
} input_file;

static const char function_file[] = "f(a,b,c) = if(a, sqrt(b), A1 / c); g = Dx * Py; h(x) = h(x - 1); o(x) = x;\n";
static const char data_file[] = "2\n0 1 2\n-1 1 3\n1 0 .5 2 -1 7\n";
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
    if (strcmp(path, input_file.name) == 0)
        return give(file, input_file.data, input_file.size);
    const char *dot = strrchr(path, '.'), *text = other_file;
    if (dot && strcmp(dot, ".cal") == 0)
        text = function_file;
    else if (dot && strcmp(dot, ".dat") == 0)
        text = data_file;
    return give(file, text, strlen(text));
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

static void set_input(const char *name, const void *data, size_t size) {
    input_file.name = name;
    input_file.data = data;
    input_file.size = size;
}

/* There is a scene, or an error of the input that was reported. */
static inline void check_outcome(graze_status status, const void *scene, int errors) {
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST((status == GRAZE_OK) == (scene != NULL) && (status == GRAZE_OK) == (errors == 0));
}

/* Large arrays take long and prove nothing. */
static inline bool has_large_array(const uint8_t *data, size_t size) {
    int arrays = 0, digits = 0;
    for (size_t i = 0; i < size; i++) {
        arrays += i > 0 && data[i - 1] == '-' && (data[i] == 'a' || data[i] == 'f');
        digits = data[i] >= '0' && data[i] <= '9' ? digits + 1 : 0;
        if (arrays > 3 || (arrays > 0 && digits > 1))
            return true;
    }
    return false;
}

static inline void check_primitive(const rad_primitive *primitives, size_t index) {
    const rad_primitive *p = &primitives[index];
    MUST(p->type < RAD_TYPE_COUNT && p->modifier >= RAD_VOID && (int64_t)p->modifier < (int64_t)index);
    MUST(p->modifier == RAD_VOID || !rad_type_is_surface(primitives[p->modifier].type));
    MUST(p->id && p->original_id && p->where && p->where->file);
    for (uint32_t i = 0; i < p->string_count; i++)
        MUST(p->strings[i]);
    for (uint32_t i = 0; i < p->real_count; i++)
        MUST(p->reals[i] - p->reals[i] == 0);
}

static inline void check_primitives(const rad_scene *scene) {
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(scene, &count);
    for (size_t i = 0; i < count; i++)
        check_primitive(primitives, i);
}

#endif
