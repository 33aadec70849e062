/* Octrees and meshes by name; copies within copies. */
#include "rad/scene_file.h"

#include <stdlib.h>
#include <string.h>

#include "base/whole_file.h"
#include "rad/link.h"
#include "rad/mesh.h"
#include "rad/octree.h"
#include "rad/path.h"

static bool make_room(void **array, size_t *capacity, size_t count, size_t size) {
    if (count < *capacity)
        return true;
    size_t wanted = *capacity ? 2 * *capacity : 16;
    void *larger = realloc(*array, wanted * size);
    if (!larger)
        return false;
    *array = larger;
    *capacity = wanted;
    return true;
}

static bool add_part(rad_scene *scene, rad_part part) {
    void *parts = scene->parts;
    bool room = make_room(&parts, &scene->part_capacity, scene->part_count, sizeof part);
    scene->parts = parts;
    if (room)
        scene->parts[scene->part_count++] = part;
    return room;
}

static bool add_copy(rad_scene *scene, rad_copy copy) {
    void *copies = scene->copies;
    bool room = make_room(&copies, &scene->copy_capacity, scene->copy_count, sizeof copy);
    scene->copies = copies;
    if (room)
        scene->copies[scene->copy_count++] = copy;
    return room;
}

/* ---- One file ---- */

static graze_status read_octree(rad_linker *l, const whole_file *file, const place *where) {
    if (!rad_octree_is(file))
        return report_error(l->reader.report, where, "not an octree");
    const rad_context outermost = {NULL, where->parent, 0};
    return rad_octree_read(&l->reader, file, where, &outermost, &(rad_sink){rad_link, l});
}

static graze_status read_file(rad_linker *l, const rad_primitive *user, const char *path, rad_part *part) {
    rad_scene *scene = l->scene;
    struct {
        place file, user;
        rad_primitive_name name;
    } *places = arena_allocate(scene->memory, sizeof *places); /* what is read from the file points there */
    if (!places)
        return report_out_of_memory(l->reader.report);
    places->user = rad_primitive_place(user, &places->name);
    places->file = (place){.file = path, .parent = &places->user};
    const place *where = &places->file;
    whole_file file;
    graze_status status = whole_file_read_path(&file, path, path, &places->user, l->reader.report);
    if (status)
        return status;
    rad_name_table_free(&l->modifiers);
    *part = (rad_part){.path = path, .first = scene->count};
    l->first = scene->count;
    if (user->type == RAD_MESH)
        status = rad_mesh_read(&part->mesh, l, &file, where);
    else
        status = read_octree(l, &file, where);
    part->count = scene->count - part->first;
    free(file.bytes);
    return status;
}

/* The part that an instance or mesh names. */
static graze_status find_part(rad_linker *l, rad_name_table *files, const rad_primitive *user, int32_t *number) {
    const char *name = user->strings[0];
    const graze_report *report = l->reader.report;
    bool mesh = user->type == RAD_MESH, found;
    if (rad_name_table_find(files, name, number)) {
        if (mesh == (l->scene->parts[*number].mesh != NULL))
            return GRAZE_OK;
        return rad_primitive_error(report, user, mesh ? "\"%s\" is an octree" : "\"%s\" is a mesh", name);
    }
    const char *path = rad_path_find(l->scene->memory, NULL, name, &found);
    if (!path)
        return report_out_of_memory(report);
    if (!found)
        return rad_primitive_error(report, user, "cannot find %s file \"%s\"", mesh ? "mesh" : "octree", name);
    rad_part part;
    const rad_primitive copy = *user; /* for reading moves the primitives */
    graze_status status = read_file(l, &copy, path, &part);
    if (status)
        return status;
    *number = (int32_t)l->scene->part_count;
    return add_part(l->scene, part) && rad_name_table_set(files, name, *number) ? GRAZE_OK
                                                                                : report_out_of_memory(report);
}

static graze_status read_transform(rad_linker *l, const rad_primitive *user, rad_transform *transform) {
    bool in_range;
    int count = (int)user->string_count - 1;
    int used = rad_transform_leading(transform, user->strings + 1, count, &in_range);
    if (used < count)
        return rad_primitive_error(l->reader.report, user, "bad transform at \"%s\": %s",
                                   rad_show(user->strings[1 + used], strlen(user->strings[1 + used])).text,
                                   rad_transform_wants(user->strings[1 + used]));
    return in_range ? GRAZE_OK : rad_primitive_error(l->reader.report, user, "transform out of range");
}

/* The copies in a part; goes on after an error, to tell of others. */
static graze_status read_copies(rad_linker *l, rad_name_table *files, size_t number) {
    rad_scene *scene = l->scene;
    rad_part part = scene->parts[number];
    graze_status worst = GRAZE_OK;
    scene->parts[number].first_copy = scene->copy_count;
    for (size_t i = part.first; i < part.first + part.count; i++) {
        const rad_primitive *p = &scene->primitives[i];
        if (p->type != RAD_MESH && p->type != RAD_INSTANCE)
            continue;
        rad_copy copy = {.primitive = (int32_t)i};
        graze_status status = read_transform(l, p, &copy.transform);
        if (!status)
            status = find_part(l, files, p, &copy.part);
        if (!status && !add_copy(scene, copy))
            status = report_out_of_memory(l->reader.report);
        worst = status > worst ? status : worst;
        if (worst == GRAZE_SYSTEM_ERROR || l->reader.status)
            break;
    }
    scene->parts[number].copies = scene->copy_count - scene->parts[number].first_copy;
    return worst;
}

/* ---- Parts in order ---- */

enum { UNKNOWN, OPEN, DONE };

typedef struct sorting {
    rad_linker *linker;
    unsigned char *state;
    int32_t *order; /* filled from its end: a part goes before those that it has copies of */
    size_t left;
} sorting;

static graze_status visit(sorting *s, int32_t number, int depth) {
    const rad_scene *scene = s->linker->scene;
    const rad_part *part = &scene->parts[number];
    graze_status status = GRAZE_OK;
    s->state[number] = OPEN;
    for (size_t i = part->first_copy; i < part->first_copy + part->copies && !status; i++) {
        const rad_copy *copy = &scene->copies[i];
        const rad_primitive *user = &scene->primitives[copy->primitive];
        if (s->state[copy->part] == OPEN)
            status =
                rad_primitive_error(s->linker->reader.report, user, "\"%s\" holds copies of itself", user->strings[0]);
        else if (depth == RAD_DEPTH)
            status = rad_primitive_error(s->linker->reader.report, user, "nested more than %d deep", RAD_DEPTH);
        else if (s->state[copy->part] == UNKNOWN)
            status = visit(s, copy->part, depth + 1);
    }
    s->state[number] = DONE;
    s->order[--s->left] = number;
    return status;
}

/* How deep copies may be nested within each part; found by the order, in which users come first. */
static graze_status check_depth(const rad_linker *l, unsigned char *depth) {
    const rad_scene *scene = l->scene;
    memset(depth, 0, scene->part_count);
    for (size_t i = 0; i < scene->part_count; i++)
        for (size_t k = 0; k < scene->parts[i].copies; k++) {
            const rad_copy *copy = &scene->copies[scene->parts[i].first_copy + k];
            if (depth[i] == RAD_DEPTH)
                return rad_primitive_error(l->reader.report, &scene->primitives[copy->primitive],
                                           "nested more than %d deep", RAD_DEPTH);
            if (depth[copy->part] < depth[i] + 1)
                depth[copy->part] = (unsigned char)(depth[i] + 1);
        }
    return GRAZE_OK;
}

static graze_status sort_parts(rad_linker *l) {
    rad_scene *scene = l->scene;
    size_t count = scene->part_count;
    unsigned char *state = calloc(count, 1);
    int32_t *order = malloc(2 * count * sizeof *order), *place_of = order ? order + count : NULL;
    rad_part *sorted = malloc(count * sizeof *sorted);
    graze_status status = GRAZE_OK;
    if (!state || !order || !sorted) {
        status = report_out_of_memory(l->reader.report);
    } else {
        sorting s = {l, state, order, count};
        status = visit(&s, 0, 0);
    }
    if (!status) {
        for (size_t i = 0; i < count; i++) {
            sorted[i] = scene->parts[order[i]];
            place_of[order[i]] = (int32_t)i;
        }
        for (size_t i = 0; i < scene->copy_count; i++)
            scene->copies[i].part = place_of[scene->copies[i].part];
        memcpy(scene->parts, sorted, count * sizeof *sorted);
        status = check_depth(l, state);
    }
    free(state);
    free(order);
    free(sorted);
    return status;
}

static graze_status read_parts(rad_linker *l) {
    rad_scene *scene = l->scene;
    rad_name_table files = {0};
    graze_status status = GRAZE_OK;
    if (!add_part(scene, (rad_part){.count = scene->count}))
        status = report_out_of_memory(l->reader.report);
    for (size_t i = 0; i < scene->part_count && !status && !l->reader.status; i++)
        status = read_copies(l, &files, i);
    rad_name_table_free(&files);
    if (l->reader.status)
        status = l->reader.status;
    return status || scene->part_count <= 1 ? status : sort_parts(l);
}

graze_status rad_scene_read_parts(rad_scene *scene, const graze_report *report) {
    rad_linker l = {.scene = scene};
    rad_reader_begin(&l.reader, scene->memory, report);
    graze_status status = read_parts(&l);
    rad_reader_end(&l.reader);
    rad_name_table_free(&l.modifiers);
    return status;
}
