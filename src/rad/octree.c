/* Octrees: names of scene files, or the scene in binary. */
#include "rad/octree.h"

#include <string.h>

#include "rad/binary_scene.h"
#include "rad/bytes.h"
#include "rad/path.h"

enum { LOWEST_MAGIC = 4 * 8 + 251 };

bool rad_octree_is(const whole_file *file) {
    return rad_bytes_have_format(file, "Radiance_octree");
}

bool rad_octree_is_named(const char *name) {
    static const char suffix[] = ".oct";
    size_t length = strlen(name);
    return name[0] != '!' && length >= sizeof suffix && !strcmp(name + length - (sizeof suffix - 1), suffix);
}

/* Counts what passes. */
typedef struct counter {
    const rad_sink *sink;
    int64_t count;
} counter;

static graze_status take(void *user, rad_raw *raw) {
    counter *c = user;
    c->count++;
    return c->sink->take(c->sink->user, raw);
}

static graze_status read_named(rad_reader *reader, const char *name, const rad_context *context, const rad_sink *sink) {
    if (name[0] == '!')
        return rad_reader_command(reader, name + 1, context, sink);
    const char *path = rad_path_resolve(reader->memory, context->directory, name);
    return path ? rad_reader_file(reader, path, context, sink) : report_out_of_memory(reader->report);
}

graze_status rad_octree_read(rad_reader *reader, const whole_file *file, const place *where, const rad_context *context,
                             const rad_sink *sink) {
    rad_bytes bytes = rad_bytes_of(file, "octree", where, reader->report);
    int object_size = rad_bytes_begin(&bytes, LOWEST_MAGIC);
    for (int i = 0; i < 4; i++)
        (void)rad_bytes_text(&bytes); /* its cube */
    rad_context inner = {context->directory, where, context->depth + 1};
    counter found = {.sink = sink};
    const rad_sink counting = {take, &found};
    graze_status status = bytes.status;
    bool frozen = true;
    while (!status) {
        const char *name = rad_bytes_text(&bytes);
        status = bytes.status;
        if (status || !*name)
            break;
        frozen = false;
        status = read_named(reader, name, &inner, &counting);
    }
    int64_t promised = status ? 0 : rad_bytes_integer(&bytes, object_size);
    if (!status)
        rad_bytes_skip_tree(&bytes, object_size);
    if (!status)
        status = bytes.status;
    if (!status && frozen)
        status = rad_binary_scene_read(reader, &bytes, object_size, &counting);
    if (!status && found.count != promised && !reader->status)
        report_warning(reader->report, where,
                       frozen ? "octree: %lld primitives are promised, and %lld are there"
                              : "octree: of %lld primitives, but its files now hold %lld; they are taken as they are",
                       (long long)promised, (long long)found.count);
    return status;
}
