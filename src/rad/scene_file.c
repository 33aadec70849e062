/* Linking primitives to their modifiers, and aliases to what they stand for. */
#include "rad/scene_file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "rad/reader.h"

/* The latest modifier of each name: open addressing with linear probes, at most half full. */
typedef struct modifier_table {
    struct slot {
        const char *name; /* null: free */
        int32_t index;
    } * slots;
    size_t capacity, count; /* capacity: a power of two */
} modifier_table;

struct rad_scene {
    arena *memory;
    rad_primitive *primitives;
    size_t count, capacity;
};

/* A scene being read. */
typedef struct linker {
    rad_reader reader;
    rad_scene *scene;
    modifier_table modifiers;
} linker;

/* ---- Modifiers by name ---- */

/* FNV-1a with a last mix, for the table looks at the low bits. */
static size_t hash(const char *name) {
    uint64_t h = 0xcbf29ce484222325u;
    for (; *name; ++name)
        h = (h ^ (unsigned char)*name) * 0x100000001b3u;
    return (size_t)(h ^ h >> 32);
}

/* Where the name stands, or would stand. */
static struct slot *find_slot(const modifier_table *table, const char *name) {
    size_t i = hash(name) & (table->capacity - 1);
    while (table->slots[i].name && strcmp(table->slots[i].name, name))
        i = (i + 1) & (table->capacity - 1);
    return &table->slots[i];
}

static bool grow_table(modifier_table *table) {
    modifier_table larger = {.capacity = table->capacity ? 2 * table->capacity : 256, .count = table->count};
    larger.slots = calloc(larger.capacity, sizeof *larger.slots);
    if (!larger.slots)
        return false;
    for (size_t i = 0; i < table->capacity; ++i)
        if (table->slots[i].name)
            *find_slot(&larger, table->slots[i].name) = table->slots[i];
    free(table->slots);
    *table = larger;
    return true;
}

static bool define(modifier_table *table, const char *name, int32_t index) {
    if (2 * (table->count + 1) > table->capacity && !grow_table(table))
        return false;
    struct slot *slot = find_slot(table, name);
    table->count += !slot->name;
    *slot = (struct slot){name, index};
    return true;
}

static bool look_up(const modifier_table *table, const char *name, int32_t *index) {
    const struct slot *slot = table->capacity ? find_slot(table, name) : NULL;
    if (!slot || !slot->name)
        return false;
    *index = slot->index;
    return true;
}

/* ---- From what is written to what is meant ---- */

static const rad_primitive *find_surface(const rad_scene *scene, const char *id) {
    for (size_t i = scene->count; i-- > 0;)
        if (rad_type_is_surface(scene->primitives[i].type) && !strcmp(scene->primitives[i].id, id))
            return &scene->primitives[i];
    return NULL;
}

static graze_status complain_of_name(linker *l, const rad_raw *raw, const char *role, const char *name) {
    const rad_primitive *surface = find_surface(l->scene, name);
    rad_shown shown = rad_show(name, strlen(name));
    if (surface)
        return rad_reader_complain(&l->reader, raw->where, "%s \"%s\" is a surface (a %s)", role, shown.text,
                                   rad_type_name(surface->type));
    return rad_reader_complain(&l->reader, raw->where, "undefined %s \"%s\"", role, shown.text);
}

static graze_status link_modifier(linker *l, const rad_raw *raw, rad_primitive *primitive) {
    primitive->modifier = RAD_VOID;
    if (raw->type != RAD_ALIAS && !strcmp(raw->modifier, "inherit"))
        return rad_reader_complain(&l->reader, raw->where, "only an alias can have the modifier \"inherit\"");
    if (!strcmp(raw->modifier, "void") || !strcmp(raw->modifier, "inherit") ||
        look_up(&l->modifiers, raw->modifier, &primitive->modifier))
        return GRAZE_OK;
    return complain_of_name(l, raw, "modifier", raw->modifier);
}

/* An alias becomes what it stands for, under its own name and, unless it inherits, with its own modifier. */
static graze_status link_alias(linker *l, const rad_raw *raw, rad_primitive *primitive) {
    int32_t target;
    if (!look_up(&l->modifiers, raw->strings[0], &target)) {
        primitive->type = RAD_TYPE_COUNT;
        return complain_of_name(l, raw, "alias target", raw->strings[0]);
    }
    rad_primitive alias = l->scene->primitives[target];
    alias.id = primitive->id;
    alias.where = primitive->where;
    if (strcmp(raw->modifier, "inherit"))
        alias.modifier = primitive->modifier;
    *primitive = alias;
    return GRAZE_OK;
}

static graze_status append(linker *l, const rad_primitive *primitive) {
    rad_scene *scene = l->scene;
    if (scene->count == INT32_MAX)
        return report_error(l->reader.report, primitive->where, "more than %d primitives", INT32_MAX - 1);
    if (scene->count == scene->capacity) {
        size_t capacity = scene->capacity ? 2 * scene->capacity : 256;
        rad_primitive *primitives = realloc(scene->primitives, capacity * sizeof *primitives);
        if (!primitives)
            return report_out_of_memory(l->reader.report);
        scene->primitives = primitives;
        scene->capacity = capacity;
    }
    scene->primitives[scene->count++] = *primitive;
    return GRAZE_OK;
}

static graze_status take(void *user, rad_raw *raw) {
    linker *l = user;
    rad_primitive primitive = {
        .type = raw->type < RAD_TYPE_COUNT ? (rad_type)raw->type : RAD_TYPE_COUNT,
        .id = raw->id,
        .original_id = raw->id,
        .string_count = raw->string_count,
        .real_count = raw->real_count,
        .strings = raw->strings,
        .reals = raw->reals,
        .where = raw->where,
    };
    graze_status status = link_modifier(l, raw, &primitive);
    if (!status && raw->type == RAD_ALIAS)
        status = link_alias(l, raw, &primitive);
    if (!status)
        status = append(l, &primitive);
    if (!status && !rad_type_is_surface(primitive.type) &&
        !define(&l->modifiers, primitive.id, (int32_t)l->scene->count - 1))
        status = report_out_of_memory(l->reader.report);
    return status;
}

/* ---- Whole scenes ---- */

static graze_status read_scene(linker *l, const char *name) {
    rad_sink sink = {take, l};
    rad_context outermost = {NULL, NULL, 0};
    if (!strcmp(name, "-"))
        return rad_reader_standard_input(&l->reader, &outermost, &sink);
    if (name[0] == '!')
        return rad_reader_command(&l->reader, name + 1, &outermost, &sink);
    return rad_reader_file(&l->reader, name, &outermost, &sink);
}

graze_status rad_scene_read(rad_scene **scene, const char *const *names, size_t count, const graze_report *report) {
    *scene = calloc(1, sizeof **scene);
    arena *memory = arena_create();
    if (!*scene || !memory) {
        free(*scene);
        *scene = NULL;
        arena_destroy(memory);
        return report_out_of_memory(report);
    }
    (*scene)->memory = memory;
    linker l = {.scene = *scene};
    rad_reader_begin(&l.reader, memory, report);
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < count && !status; ++i)
        status = read_scene(&l, names[i]);
    if (l.reader.status)
        status = l.reader.status;
    rad_reader_end(&l.reader);
    free(l.modifiers.slots);
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
    arena_destroy(scene->memory);
    free(scene);
}

const rad_primitive *rad_scene_primitives(const rad_scene *scene, size_t *count) {
    *count = scene->count;
    return scene->primitives;
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
