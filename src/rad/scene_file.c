/* Whole scenes, and messages about their primitives. */
#include "rad/scene_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "rad/link.h"

static graze_status read_scene(rad_linker *l, const char *name) {
    rad_sink sink = {rad_link, l};
    rad_context outermost = {NULL, NULL, 0};
    if (!strcmp(name, "-"))
        return rad_reader_standard_input(&l->reader, &outermost, &sink);
    if (name[0] == '!')
        return rad_reader_command(&l->reader, name + 1, &outermost, &sink);
    return rad_reader_file(&l->reader, name, &outermost, &sink);
}

graze_status rad_scene_read(rad_scene **scene, const char *const *names, size_t count, const graze_report *report) {
    return rad_scene_read_by(1, scene, names, count, report);
}

graze_status rad_scene_read_by(int threads, rad_scene **scene, const char *const *names, size_t count,
                               const graze_report *report) {
    *scene = calloc(1, sizeof **scene);
    arena *memory = arena_create();
    if (!*scene || !memory) {
        free(*scene);
        *scene = NULL;
        arena_destroy(memory);
        return report_out_of_memory(report);
    }
    (*scene)->memory = memory;
    rad_linker l = {.scene = *scene};
    rad_reader_begin(&l.reader, memory, report);
    l.reader.threads = threads;
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < count && !status; ++i)
        status = read_scene(&l, names[i]);
    if (l.reader.status)
        status = l.reader.status;
    rad_reader_end(&l.reader);
    rad_name_table_free(&l.modifiers);
    if (status) {
        rad_scene_destroy(*scene);
        *scene = NULL;
    }
    return status;
}

void rad_scene_destroy(rad_scene *scene) {
    if (!scene)
        return;
    free(scene->primitives);
    free(scene->parts);
    free(scene->copies);
    arena_destroy(scene->memory);
    free(scene);
}

const rad_primitive *rad_scene_primitives(const rad_scene *scene, size_t *count) {
    *count = scene->count;
    return scene->primitives;
}

size_t rad_scene_count(const rad_scene *scene, rad_type type) {
    return scene->counts[type];
}

const rad_part *rad_scene_parts(const rad_scene *scene, size_t *count) {
    *count = scene->part_count;
    return scene->parts;
}

const rad_copy *rad_scene_copies(const rad_scene *scene) {
    return scene->copies;
}

/* "TYPE ID: TEXT" */
typedef struct message {
    char text[640];
} message;

__attribute__((format(printf, 2, 0))) static message compose(const rad_primitive *primitive, const char *format,
                                                             va_list arguments) {
    message m;
    int begun = snprintf(m.text, sizeof m.text, "%s %s: ", rad_type_name(primitive->type),
                         rad_show(primitive->id, strlen(primitive->id)).text);
    vsnprintf(m.text + begun, sizeof m.text - (size_t)begun, format, arguments);
    return m;
}

int rad_modifier_before(const rad_primitive *first, const rad_primitive *end, const char *name) {
    for (const rad_primitive *p = end; p-- > first;)
        if (!rad_type_is_surface(p->type) && !strcmp(p->id, name))
            return (int)(p - first);
    return RAD_VOID;
}

place rad_primitive_place(const rad_primitive *primitive, rad_primitive_name *name) {
    snprintf(name->text, sizeof name->text, "%s %s", rad_type_name(primitive->type),
             rad_show(primitive->id, strlen(primitive->id)).text);
    place where = *primitive->where;
    where.subject = name->text;
    return where;
}

graze_status rad_primitive_error(const graze_report *report, const rad_primitive *primitive, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    message m = compose(primitive, format, arguments);
    va_end(arguments);
    return report_error(report, primitive->where, "%s", m.text);
}

void rad_primitive_warning(const graze_report *report, const rad_primitive *primitive, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    message m = compose(primitive, format, arguments);
    va_end(arguments);
    report_warning(report, primitive->where, "%s", m.text);
}
