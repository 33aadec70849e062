/* Looking up files along RAYPATH. */
#include "rad/path.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *join(arena *memory, const char *directory, size_t length, const char *name) {
    bool slash = length > 0 && directory[length - 1] != '/';
    size_t rest = strlen(name) + 1;
    char *path = arena_allocate(memory, length + slash + rest);
    if (!path)
        return NULL;
    memcpy(path, directory, length);
    if (slash)
        path[length] = '/';
    memcpy(path + length + slash, name, rest);
    return path;
}

const char *rad_path_resolve(arena *memory, const char *directory, const char *name) {
    if (!directory || name[0] == '/')
        return name;
    return join(memory, directory, strlen(directory), name);
}

const char *rad_path_find(arena *memory, const char *directory, const char *name, bool *found) {
    const char *search = getenv("RAYPATH");
    if (name[0] == '/' || name[0] == '.')
        search = "";
    else if (!search)
        search = ":/usr/local/lib/ray";
    for (;;) {
        size_t length = strcspn(search, ":");
        const char *candidate = join(memory, search, length, name);
        const char *path = candidate ? rad_path_resolve(memory, directory, candidate) : NULL;
        *found = path && access(path, R_OK) == 0;
        if (*found || !path || !search[length] || !search[length + 1])
            return path;
        search += length + 1;
    }
}

const char *rad_path_directory(arena *memory, const char *path, bool *own) {
    const char *slash = strrchr(path, '/');
    *own = !slash;
    return slash ? arena_copy_text(memory, path, slash == path ? 1 : (size_t)(slash - path)) : NULL;
}
