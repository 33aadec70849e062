/* Linking primitives to their modifiers, and aliases to what they stand for. */
#include "rad/link.h"

#include <stdlib.h>
#include <string.h>

static const rad_primitive *find_surface(const rad_linker *l, const char *id) {
    const rad_scene *scene = l->scene;
    for (size_t i = scene->count; i-- > l->first;)
        if (rad_type_is_surface(scene->primitives[i].type) && !strcmp(scene->primitives[i].id, id))
            return &scene->primitives[i];
    return NULL;
}

static graze_status complain_of_name(rad_linker *l, const rad_raw *raw, const char *role, const char *name) {
    const rad_primitive *surface = find_surface(l, name);
    rad_shown shown = rad_show(name, strlen(name));
    rad_primitive_name user = rad_describe(raw);
    if (surface)
        return rad_reader_complain(&l->reader, raw->where, "%s: %s \"%s\" is a surface (a %s)", user.text, role,
                                   shown.text, rad_type_name(surface->type));
    return rad_reader_complain(&l->reader, raw->where, "%s: undefined %s \"%s\"", user.text, role, shown.text);
}

static graze_status link_modifier(rad_linker *l, const rad_raw *raw, rad_primitive *primitive) {
    primitive->modifier = RAD_VOID;
    if (raw->type != RAD_ALIAS && !strcmp(raw->modifier, "inherit"))
        return rad_reader_complain(&l->reader, raw->where, "%s: only an alias can have the modifier \"inherit\"",
                                   rad_describe(raw).text);
    if (!strcmp(raw->modifier, "void") || !strcmp(raw->modifier, "inherit") ||
        rad_name_table_find(&l->modifiers, raw->modifier, &primitive->modifier))
        return GRAZE_OK;
    return complain_of_name(l, raw, "modifier", raw->modifier);
}

/* An alias becomes what it stands for, under its own name and, unless it inherits, with its own modifier. */
static graze_status link_alias(rad_linker *l, const rad_raw *raw, rad_primitive *primitive) {
    int32_t target;
    if (!rad_name_table_find(&l->modifiers, raw->strings[0], &target)) {
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

graze_status rad_linker_append(rad_linker *l, const rad_primitive *primitive) {
    rad_scene *scene = l->scene;
    if (scene->count == INT32_MAX)
        return report_error(l->reader.report, primitive->where, "more than %d primitives", INT32_MAX - 1);
    if (scene->count == scene->capacity) {
        size_t capacity = scene->capacity ? 2 * scene->capacity : 256;
        rad_primitive *primitives = realloc(scene->primitives, capacity * sizeof *primitives);
        if (!primitives)
            return report_out_of_memory_at(l->reader.report, primitive->where);
        scene->primitives = primitives;
        scene->capacity = capacity;
    }
    scene->primitives[scene->count++] = *primitive;
    scene->counts[primitive->type]++;
    return GRAZE_OK;
}

graze_status rad_link(void *user, rad_raw *raw) {
    rad_linker *l = user;
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
        status = rad_linker_append(l, &primitive);
    if (!status && !rad_type_is_surface(primitive.type) &&
        !rad_name_table_set(&l->modifiers, primitive.id, (int32_t)l->scene->count - 1))
        status = report_out_of_memory_at(l->reader.report, raw->where);
    return status;
}
