/* One xform applied to one primitive. */
#include "rad/filter.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void put(double *reals, vec3 v) {
    reals[0] = v.x;
    reals[1] = v.y;
    reals[2] = v.z;
}

static void map_point(const rad_filter *f, double *reals) {
    put(reals, rad_transform_point(&f->transform, vec3_make(reals[0], reals[1], reals[2])));
}

static void map_vector(const rad_filter *f, double *reals) {
    put(reals, rad_transform_vector(&f->transform, vec3_make(reals[0], reals[1], reals[2])));
}

static void scale(double factor, double *reals, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
        reals[i] *= factor;
}

/* A mirror turns the order of vertices round, and so does an inversion. */
static void map_polygon(const rad_filter *f, double *reals, uint32_t count) {
    for (uint32_t i = 0; i < count; i += 3)
        map_point(f, reals + i);
    if (f->transform.mirrored == f->invert)
        return;
    for (uint32_t low = 0, high = count - 3; low < high; low += 3, high -= 3) {
        double vertex[3];
        memcpy(vertex, reals + low, sizeof vertex);
        memcpy(reals + low, reals + high, sizeof vertex);
        memcpy(reals + high, vertex, sizeof vertex);
    }
}

/* A transmittance t per unit length becomes t^(1/scale). */
static void map_absorption(const rad_filter *f, double *reals, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
        if (i % 4 != 3 && !(count == 5 && i == 4))
            reals[i] = pow(reals[i], 1 / f->transform.scale);
}

static void map_reals(const rad_filter *f, const rad_raw *raw) {
    double *r = raw->reals;
    double factor = f->transform.scale;
    switch (rad_type_look_up((rad_type)raw->type)->action) {
    case RAD_POINTS:
        map_polygon(f, r, raw->real_count);
        break;
    case RAD_BALL:
        map_point(f, r);
        r[3] *= factor;
        break;
    case RAD_SHAFT:
        map_point(f, r);
        map_point(f, r + 3);
        scale(factor, r + 6, raw->real_count - 6);
        break;
    case RAD_DISK:
        map_point(f, r);
        map_vector(f, r + 3);
        scale(f->invert ? -1 : 1, r + 3, 3);
        scale(factor, r + 6, 2);
        break;
    case RAD_DIRECTION:
        map_vector(f, r);
        break;
    case RAD_DISTANCE:
        r[3] *= factor;
        break;
    case RAD_AIM:
        map_vector(f, r + 4);
        break;
    case RAD_ABSORPTION:
        map_absorption(f, r, raw->real_count);
        break;
    case RAD_EXTINCTION:
        if (raw->real_count > 2)
            scale(1 / factor, r, 3);
        break;
    case RAD_TEXT:
        map_point(f, r);
        map_vector(f, r + 3);
        map_vector(f, r + 6);
        break;
    case RAD_UNCHANGED:
    case RAD_APPEND_WORDS:
        break;
    }
}

/* The words go last, for they are applied after those that are there already; `-i 1` ends a repetition among these. */
static graze_status append_words(const rad_filter *f, rad_reader *reader, rad_raw *raw) {
    if (f->word_count == 0)
        return GRAZE_OK;
    uint32_t separator = strcmp(f->words[0], "-i") ? 2 : 0;
    uint32_t total = raw->string_count + separator + (uint32_t)f->word_count;
    const char **strings = arena_allocate(reader->memory, total * sizeof *strings);
    if (!strings)
        return report_out_of_memory(reader->report);
    if (raw->string_count)
        memcpy(strings, raw->strings, raw->string_count * sizeof *strings);
    const char **next = strings + raw->string_count;
    if (separator) {
        *next++ = "-i";
        *next++ = "1";
    }
    for (int i = 0; i < f->word_count; ++i)
        if (!(next[i] = arena_copy_text(reader->memory, f->words[i], strlen(f->words[i]))))
            return report_out_of_memory(reader->report);
    raw->strings = strings;
    raw->string_count = total;
    return GRAZE_OK;
}

const char *rad_join_names(arena *memory, const char *prefix, const char *name) {
    size_t room = strlen(prefix) + strlen(name) + 2;
    char *joined = arena_allocate(memory, room);
    if (joined)
        snprintf(joined, room, "%s.%s", prefix, name);
    return joined;
}

/* A mist names the light sources it is bright with, each as a path of surface names with `>` between. */
static const char *prefix_path(arena *memory, const char *prefix, const char *path) {
    size_t names = 1, length = strlen(prefix);
    for (const char *p = path; *p; ++p)
        names += *p == '>';
    char *result = arena_allocate(memory, strlen(path) + names * (length + 1) + 1);
    if (!result)
        return NULL;
    char *out = result;
    bool at_name = true;
    for (const char *p = path; *p; ++p) {
        if (at_name) {
            for (size_t i = 0; i < length; ++i)
                *out++ = prefix[i];
            *out++ = '.';
        }
        *out++ = *p;
        at_name = *p == '>';
    }
    *out = 0;
    return result;
}

static graze_status prefix_sources(const rad_filter *f, rad_reader *reader, rad_raw *raw) {
    const char **strings = arena_allocate(reader->memory, raw->string_count * sizeof *strings);
    for (uint32_t i = 0; strings && i < raw->string_count; ++i)
        if (!(strings[i] = prefix_path(reader->memory, f->prefix, raw->strings[i])))
            strings = NULL;
    raw->strings = strings;
    return strings ? GRAZE_OK : report_out_of_memory(reader->report);
}

static graze_status change_surface(const rad_filter *f, rad_reader *reader, rad_raw *raw) {
    if (f->modifier)
        raw->modifier = f->modifier;
    if (f->invert)
        raw->type = (int)rad_type_look_up((rad_type)raw->type)->inverse;
    if (f->prefix && !(raw->id = rad_join_names(reader->memory, f->prefix, raw->id)))
        return report_out_of_memory(reader->report);
    return GRAZE_OK;
}

static graze_status check_range(rad_reader *reader, rad_raw *raw) {
    for (uint32_t i = 0; i < raw->real_count; ++i)
        if (!isfinite(raw->reals[i])) {
            raw->broken = true;
            return rad_reader_complain(reader, raw->where, "%s %s: real argument %u is out of range after xform",
                                       rad_type_name((rad_type)raw->type), rad_show(raw->id, strlen(raw->id)).text,
                                       (unsigned)(i + 1));
        }
    return GRAZE_OK;
}

graze_status rad_filter_apply(const rad_filter *f, rad_reader *reader, rad_raw *raw) {
    if (raw->type >= RAD_TYPE_COUNT)
        return GRAZE_OK;
    const rad_type_facts *facts = rad_type_look_up((rad_type)raw->type);
    graze_status status = facts->is_surface ? change_surface(f, reader, raw) : GRAZE_OK;
    if (status || raw->broken)
        return status;
    map_reals(f, raw);
    if (facts->action == RAD_APPEND_WORDS)
        status = append_words(f, reader, raw);
    else if (facts->action == RAD_EXTINCTION && f->prefix && raw->string_count)
        status = prefix_sources(f, reader, raw);
    return status ? status : check_range(reader, raw);
}
