/* From bytes to primitives that are not linked yet. */
#include "rad/binary_scene.h"

#include <stdlib.h>
#include <string.h>

/* The first byte of a primitive is its type's number; 255 ends them. */
enum { TYPES_MOST = 255, END = 255 };

typedef struct binary_scene {
    rad_reader *reader;
    rad_bytes *bytes;
    const rad_sink *sink;
    int object_size;
    int types[TYPES_MOST]; /* as in rad_raw */
    const char *type_names[TYPES_MOST];
    int type_count;
    /* The primitives so far: a modifier is given by its number, and is linked by its name, as in text. */
    const char **names;
    size_t count, capacity;
} binary_scene;

static void read_types(binary_scene *s) {
    for (;;) {
        const char *name = rad_bytes_text(s->bytes);
        if (s->bytes->status || !*name)
            return;
        if (s->type_count == TYPES_MOST) {
            rad_bytes_fail(s->bytes, "more than %d types of primitives", TYPES_MOST);
            return;
        }
        rad_type type;
        s->types[s->type_count] = !strcmp(name, "alias")                     ? (int)RAD_ALIAS
                                  : rad_type_find(name, strlen(name), &type) ? (int)type
                                                                             : (int)RAD_UNKNOWN;
        s->type_names[s->type_count++] = name;
    }
}

static graze_status keep_text(const binary_scene *s, const char *text, const char **kept) {
    *kept = arena_copy_text(s->reader->memory, text, strlen(text));
    return *kept ? GRAZE_OK : report_out_of_memory(s->reader->report);
}

static graze_status keep_name(binary_scene *s, const char *name) {
    if (s->count == s->capacity) {
        size_t capacity = s->capacity ? 2 * s->capacity : 256;
        const char **larger = realloc(s->names, capacity * sizeof *larger);
        if (!larger)
            return report_out_of_memory(s->reader->report);
        s->names = larger;
        s->capacity = capacity;
    }
    s->names[s->count++] = name;
    return GRAZE_OK;
}

static graze_status read_strings(binary_scene *s, rad_raw *raw) {
    rad_bytes *bytes = s->bytes;
    uint64_t count = rad_bytes_count(bytes, 2);
    if (bytes->status || count == 0)
        return bytes->status;
    const char **strings = arena_allocate(s->reader->memory, count * sizeof *strings);
    if (!strings)
        return report_out_of_memory(s->reader->report);
    raw->strings = strings;
    for (; raw->string_count < count; raw->string_count++) {
        const char *text = rad_bytes_text(bytes);
        if (bytes->status || keep_text(s, text, &strings[raw->string_count]))
            return bytes->status ? bytes->status : GRAZE_SYSTEM_ERROR;
    }
    return GRAZE_OK;
}

static graze_status read_reals(binary_scene *s, rad_raw *raw) {
    uint64_t count = rad_bytes_count(s->bytes, 2);
    if (s->bytes->status)
        return s->bytes->status;
    raw->reals = arena_allocate(s->reader->memory, count * sizeof *raw->reals);
    if (!raw->reals)
        return report_out_of_memory(s->reader->report);
    raw->real_count = (uint32_t)count;
    for (uint64_t i = 0; i < count; i++)
        raw->reals[i] = rad_bytes_real(s->bytes);
    return s->bytes->status;
}

/* An alias without a string argument stands for its modifier, and inherits that one's; with one, for what that names.
 */
static graze_status finish_alias(binary_scene *s, rad_raw *raw) {
    if (raw->string_count > 0)
        return GRAZE_OK;
    const char **target = arena_allocate(s->reader->memory, sizeof *target);
    if (!target)
        return report_out_of_memory(s->reader->report);
    *target = raw->modifier;
    raw->strings = target;
    raw->string_count = 1;
    raw->modifier = "inherit";
    return GRAZE_OK;
}

static graze_status read_head(binary_scene *s, unsigned type, rad_raw *raw) {
    rad_bytes *bytes = s->bytes;
    if (type >= (unsigned)s->type_count)
        rad_bytes_fail(bytes, "damaged: a primitive of unknown type %u", type);
    int64_t modifier = rad_bytes_integer(bytes, s->object_size);
    if (!bytes->status && (modifier < -1 || modifier >= (int64_t)s->count))
        rad_bytes_fail(bytes, "damaged: a primitive whose modifier is number %lld of %zu before it",
                       (long long)modifier, s->count);
    const char *name = rad_bytes_text(bytes);
    if (bytes->status)
        return bytes->status;
    raw->type = s->types[type];
    raw->modifier = modifier < 0 || !s->names ? "void" : s->names[modifier];
    return keep_text(s, name, &raw->id);
}

static graze_status read_primitive(binary_scene *s, unsigned type) {
    rad_raw raw = {.where = s->bytes->where};
    graze_status status = read_head(s, type, &raw);
    if (!status)
        status = keep_name(s, raw.id);
    if (!status)
        status = read_strings(s, &raw);
    if (!status)
        status = read_reals(s, &raw);
    if (status)
        return status;
    if (raw.type == RAD_UNKNOWN) {
        raw.broken = true;
        status = rad_complain_of_type(s->reader, raw.where, s->type_names[type], raw.id);
    } else if (raw.type == RAD_ALIAS) {
        status = finish_alias(s, &raw);
    }
    if (!status)
        status = rad_reader_check(s->reader, &raw);
    return status ? status : s->sink->take(s->sink->user, &raw);
}

graze_status rad_binary_scene_read(rad_reader *reader, rad_bytes *bytes, int object_size, const rad_sink *sink) {
    binary_scene s = {.reader = reader, .bytes = bytes, .sink = sink, .object_size = object_size};
    read_types(&s);
    graze_status status = bytes->status;
    while (!status) {
        unsigned type = (unsigned)rad_bytes_count(bytes, 1);
        status = bytes->status;
        if (status || type == END)
            break;
        status = read_primitive(&s, type);
    }
    free(s.names);
    return status;
}
