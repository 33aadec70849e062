/* Loading GLU. */
#include "geometry/glu.h"

#include <dlfcn.h>
#include <pthread.h>
#include <string.h>

/* The one exception to "no global state". What a dynamic linker has loaded is the process's own, not a scene's: a table
 * for each scene would hold the same addresses over again, and closing the library with one would pull it from under
 * the others. Nothing can come of sharing it: load() writes the table once, pthread_once() lets no thread see it before
 * that is done, and afterwards it is only read. */
static geometry_glu functions;
static pthread_once_t once = PTHREAD_ONCE_INIT;

static void note_trouble(void) {
    const char *text = dlerror();
    strncpy(functions.trouble, text ? text : "unknown error", sizeof functions.trouble - 1);
}

static void load(void) {
    void *library = dlopen("libGLU.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        note_trouble();
        return;
    }
    /* POSIX has dlsym's result stored through a void pointer. */
    const struct {
        const char *name;
        void *function;
    } symbols[] = {
        {"gluNewTess", &functions.new_tess},
        {"gluDeleteTess", &functions.delete_tess},
        {"gluTessCallback", &functions.callback},
        {"gluTessProperty", &functions.property},
        {"gluTessNormal", &functions.normal},
        {"gluTessBeginPolygon", &functions.begin_polygon},
        {"gluTessBeginContour", &functions.begin_contour},
        {"gluTessVertex", &functions.vertex},
        {"gluTessEndContour", &functions.end_contour},
        {"gluTessEndPolygon", &functions.end_polygon},
        {"gluErrorString", &functions.error_string},
    };
    for (size_t i = 0; i < sizeof symbols / sizeof *symbols; i++) {
        void *symbol = dlsym(library, symbols[i].name);
        if (!symbol) {
            note_trouble();
            return;
        }
        memcpy(symbols[i].function, &symbol, sizeof symbol);
    }
}

const geometry_glu *geometry_glu_open(void) {
    pthread_once(&once, load);
    return &functions;
}
