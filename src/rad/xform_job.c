/* Primitives of xform's files: read, kept for the next instance, and sent through the filter. */
#include "rad/xform_job.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "rad/path.h"

graze_status rad_list_append(void *user, rad_raw *raw) {
    rad_list_sink *s = user;
    rad_list *l = s->list;
    if (l->count == l->capacity) {
        size_t capacity = l->capacity ? 2 * l->capacity : 64;
        rad_raw *items = realloc(l->items, capacity * sizeof *items);
        if (!items)
            return report_out_of_memory_at(s->reader->report, raw->where);
        l->items = items;
        l->capacity = capacity;
    }
    l->items[l->count++] = *raw;
    return GRAZE_OK;
}

void rad_list_free(rad_list *l) {
    free(l->items);
    *l = (rad_list){0};
}

static graze_status take_through_filter(void *user, rad_raw *raw) {
    rad_filter_sink *s = user;
    graze_status status = rad_filter_apply(s->filter, s->reader, raw);
    return status ? status : s->sink->take(s->sink->user, raw);
}

graze_status rad_job_filter_list(const rad_job *j, const rad_list *l, rad_filter_sink *filtered) {
    graze_status status = GRAZE_OK;
    for (size_t i = 0; i < l->count && !status; ++i) {
        rad_raw raw = l->items[i];
        if (raw.real_count && !j->once) {
            double *reals = arena_allocate(j->reader->memory, raw.real_count * sizeof *reals);
            if (!reals)
                return report_out_of_memory_at(j->reader->report, j->where);
            memcpy(reals, raw.reals, raw.real_count * sizeof *reals);
            raw.reals = reals;
        }
        status = take_through_filter(filtered, &raw);
    }
    return status;
}

/* xform goes to the file for the commands in it, unless it leaves them as they are. */
static graze_status read_file(const rad_job *j, const char *name, bool expand, const rad_sink *sink) {
    arena *memory = j->reader->memory;
    const graze_report *report = j->reader->report;
    bool found;
    const char *path = rad_path_find(memory, j->context->directory, name, &found);
    if (!path)
        return report_out_of_memory_at(report, j->where);
    if (!found) {
        errno = ENOENT;
        return report_file_error(report, j->where, "xform: cannot find file \"%s\"", rad_show(name, strlen(name)).text);
    }
    if (!strncmp(path, "./", 2))
        path += 2;
    rad_context inner = *j->context;
    inner.parent = j->command;
    if (expand) {
        bool own;
        inner.directory = rad_path_directory(memory, path, &own);
        if (!inner.directory && !own)
            return report_out_of_memory_at(report, j->where);
    }
    return rad_reader_file(j->reader, path, &inner, sink);
}

static graze_status keep_file(rad_job *j, const char *name, bool expand, const rad_list **primitives) {
    for (int i = 0; i < j->file_count; ++i)
        if (j->files[i].expand == expand && !strcmp(j->files[i].name, name)) {
            *primitives = &j->files[i].primitives;
            return GRAZE_OK;
        }
    /* It may be the numbered name of an array's instance or a word of an argument file, which do not last. */
    const char *kept_name = arena_copy_text(j->reader->memory, name, strlen(name));
    if (!kept_name)
        return report_out_of_memory_at(j->reader->report, j->where);
    int room = j->next_file;
    j->next_file = (room + 1) % RAD_KEPT_FILES;
    if (j->file_count < RAD_KEPT_FILES)
        ++j->file_count;
    rad_list *l = &j->files[room].primitives;
    rad_list_free(l);
    j->files[room].name = kept_name;
    j->files[room].expand = expand;
    *primitives = l;
    rad_list_sink kept = {j->reader, l};
    return read_file(j, kept_name, expand, &(rad_sink){rad_list_append, &kept});
}

graze_status rad_job_filter_file(rad_job *j, const char *name, bool expand, rad_filter_sink *filtered) {
    if (j->once)
        return read_file(j, name, expand, &(rad_sink){take_through_filter, filtered});
    const rad_list *primitives = NULL;
    graze_status status = keep_file(j, name, expand, &primitives);
    return status ? status : rad_job_filter_list(j, primitives, filtered);
}
