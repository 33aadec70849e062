/* Opening the module that knows OpenImageIO, where a picture needs it. */
#define _GNU_SOURCE /* dladdr1 */
#include "image/module.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The shared library that this code is part of; false within an executable. */
static bool own_library(char *path) {
    Dl_info info;
    struct link_map *map = NULL;
    if (!dladdr1((const void *)(size_t)&image_module_open, &info, (void **)&map, RTLD_DL_LINKMAP) || !map)
        return false;
    /* The dynamic linker gives the executable no name. */
    return map->l_name[0] && realpath(map->l_name, path);
}

static bool own_executable(char *path) {
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX - 1);
    if (length < 0)
        return false;
    path[length] = 0;
    return true;
}

/* The module's name in `path`, of PATH_MAX bytes. */
static bool locate(char *path) {
    const char *relative = "graze/oiio.so";
    if (!own_library(path)) {
        relative = "../lib/graze/oiio.so";
        if (!own_executable(path))
            return false;
    }
    char *slash = strrchr(path, '/');
    if (!slash || (size_t)(slash + 1 - path) + strlen(relative) >= PATH_MAX)
        return false;
    memcpy(slash + 1, relative, strlen(relative) + 1);
    return true;
}

graze_status image_module_open(const image_oiio **module, const char *file, const graze_report *report) {
    place where = {.file = file};
    char path[PATH_MAX];
    if (!locate(path))
        return report_system_error(report, &where, "cannot tell where Graze's own files lie");
    /* Never closed: OpenImageIO keeps threads. Opened again it is the same one. */
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    image_oiio_entry *entry = NULL;
    if (handle)
        *(void **)&entry = dlsym(handle, IMAGE_OIIO_SYMBOL);
    if (!entry) {
        report_error(report, &where,
                     "formats other than .hdr, .pic and .exr need Graze's module for OpenImageIO, which "
                     "cannot be opened: %s",
                     dlerror());
        return GRAZE_SYSTEM_ERROR;
    }
    *module = entry();
    return GRAZE_OK;
}
