/* Files that appear whole or not at all. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "image/output.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *image_suffix(const char *file) {
    const char *slash = strrchr(file, '/');
    const char *name = slash ? slash + 1 : file;
    const char *point = strrchr(name, '.');
    return point && point > name ? point + 1 : "";
}

bool image_output_is_special(const char *file) {
    struct stat status;
    /* A standard stream may lead to a regular file, but is none that could be replaced by another. */
    if (!strncmp(file, "/dev/std", 8) || !strncmp(file, "/dev/fd/", 8) || !strncmp(file, "/proc/", 6))
        return true;
    return stat(file, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

static graze_status file_error(const image_output *output, const char *text) {
    return report_file_error(output->report, &(place){.file = output->file}, "%s", text);
}

/* Makes a file that was not there before in the directory whose name has this length. */
static graze_status make_temporary(image_output *output, const char *directory, size_t length) {
    const char *suffix = image_suffix(output->file);
    size_t size = length + strlen(suffix) + 64;
    output->path = malloc(size);
    if (!output->path)
        return report_out_of_memory(output->report);
    int descriptor = -1;
    for (int attempt = 0; descriptor < 0 && attempt < INT_MAX; attempt++) {
        /* No number of the process: DPX keeps the name, and the same picture is to give the same bytes. */
        snprintf(output->path, size, "%.*s.graze-%d.%s", (int)length, directory, attempt, suffix);
        descriptor = open(output->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST)
            break;
    }
    if (descriptor >= 0 && close(descriptor) == 0)
        return GRAZE_OK;
    graze_status status = file_error(output, "cannot be created");
    free(output->path);
    output->path = NULL;
    return status;
}

/* The file behind symbolic links, which are to stay as they are. */
static char *resolve(const char *file) {
    char *resolved = realpath(file, NULL);
    return resolved ? resolved : strdup(file);
}

graze_status image_output_check(const char *file, const graze_report *report) {
    place where = {.file = file};
    struct stat status;
    if (image_output_is_special(file))
        return GRAZE_OK;
    if (stat(file, &status) == 0 && S_ISDIR(status.st_mode)) {
        errno = EISDIR;
        return report_file_error(report, &where, "cannot be created");
    }
    const char *slash = strrchr(file, '/');
    char *directory = slash ? strndup(file, (size_t)(slash - file) + 1) : strdup(".");
    if (!directory)
        return report_out_of_memory(report);
    bool good = access(directory, W_OK | X_OK) == 0;
    free(directory);
    if (!good)
        return report_file_error(report, &where, "cannot be created");
    /* Renaming would replace a file whoever may write it. A name too long shows only here, too. */
    return access(file, W_OK) == 0 || errno == ENOENT ? GRAZE_OK
                                                      : report_file_error(report, &where, "cannot be written");
}

static graze_status begin_special(image_output *output, bool direct) {
    if (direct) {
        output->path = strdup(output->file);
        return output->path ? GRAZE_OK : report_out_of_memory(output->report);
    }
    const char *variable = getenv("TMPDIR");
    char directory[PATH_MAX];
    snprintf(directory, sizeof directory, "%s/", variable && *variable ? variable : "/tmp");
    return make_temporary(output, directory, strlen(directory));
}

graze_status image_output_begin(image_output *output, const char *file, bool direct, const graze_report *report) {
    *output = (image_output){.file = file, .report = report};
    if (image_output_is_special(file))
        return begin_special(output, direct);
    output->final = resolve(file);
    if (!output->final)
        return report_out_of_memory(report);
    const char *slash = strrchr(output->final, '/');
    graze_status status = make_temporary(output, output->final, slash ? (size_t)(slash + 1 - output->final) : 0);
    if (status != GRAZE_OK) {
        free(output->final);
        output->final = NULL;
    }
    return status;
}

static bool copy_bytes(FILE *in, FILE *out) {
    char bytes[65536];
    size_t count;
    while ((count = fread(bytes, 1, sizeof bytes, in)) > 0)
        if (fwrite(bytes, 1, count, out) != count)
            return false;
    return !ferror(in);
}

static graze_status copy_to_special(const image_output *output) {
    FILE *in = fopen(output->path, "rb");
    FILE *out = in ? fopen(output->file, "wb") : NULL;
    graze_status status = GRAZE_OK;
    if (!out || !copy_bytes(in, out))
        status = file_error(output, "cannot be written");
    if (out && fclose(out) != 0 && status == GRAZE_OK)
        status = file_error(output, "cannot be written");
    if (in)
        fclose(in);
    return status;
}

graze_status image_output_finish(image_output *output, graze_status written) {
    bool is_temporary = output->path && strcmp(output->path, output->file) != 0;
    if (written == GRAZE_OK && is_temporary) {
        if (!output->final)
            written = copy_to_special(output);
        else if (rename(output->path, output->final) == 0)
            is_temporary = false;
        else
            written = file_error(output, "cannot be put in its place");
    }
    if (is_temporary)
        unlink(output->path);
    free(output->path);
    free(output->final);
    return written;
}
