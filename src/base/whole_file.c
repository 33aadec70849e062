/* Reading all of a file, a pipe or a terminal. */
#include "base/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

/* What can be told of the size beforehand, so that large files are read in one piece. */
static size_t expected_size(int descriptor) {
    struct stat facts;
    if (fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode) || facts.st_size < 0)
        return 0;
    return (size_t)facts.st_size;
}

/* What may never end: no file, pipe or terminal. */
static bool is_device(int descriptor) {
    struct stat facts;
    return fstat(descriptor, &facts) == 0 && (S_ISCHR(facts.st_mode) || S_ISBLK(facts.st_mode)) && !isatty(descriptor);
}

static graze_status grow(whole_file *text, size_t capacity, const graze_report *report) {
    char *bytes = realloc(text->bytes, capacity);
    if (!bytes)
        return report_out_of_memory(report);
    text->bytes = bytes;
    return GRAZE_OK;
}

static graze_status read_all(whole_file *text, int descriptor, const char *name, const place *where,
                             const graze_report *report) {
    size_t capacity = expected_size(descriptor) + 4096;
    graze_status status = grow(text, capacity, report);
    while (!status) {
        ssize_t got = read(descriptor, text->bytes + text->length, capacity - text->length - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return report_file_error(report, where, "cannot read %s", name);
        if (got > 0 && text->length == 0 && is_device(descriptor))
            return report_error(report, where, "cannot read %s: it is a device, which need not end", name);
        text->length += (size_t)got;
        text->bytes[text->length] = 0;
        if (got == 0)
            break;
        if (capacity - text->length < 2048) {
            capacity *= 2;
            status = grow(text, capacity, report);
        }
    }
    return status;
}

graze_status whole_file_read(whole_file *text, int descriptor, const char *name, const place *where,
                             const graze_report *report) {
    *text = (whole_file){0};
    graze_status status = read_all(text, descriptor, name, where, report);
    if (status) {
        free(text->bytes);
        *text = (whole_file){0};
    }
    return status;
}

graze_status whole_file_read_path(whole_file *text, const char *path, const char *name, const place *where,
                                  const graze_report *report) {
    *text = (whole_file){0};
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return report_file_error(report, where, "cannot open %s", name);
    graze_status status = whole_file_read(text, descriptor, name, where, report);
    close(descriptor);
    return status;
}
