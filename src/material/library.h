/* What the functions in a scene's materials share: definitions of the function language, data files, pictures. */
#ifndef MATERIAL_LIBRARY_H
#define MATERIAL_LIBRARY_H

#include "base/arena.h"
#include "cal/compile.h"
#include "rad/data_file.h"
#include "rad/scene_file.h"

typedef struct material_library material_library;

/* A picture as a texture is asked of it: the shorter side is 1 long, the origin at the lower left. Coordinates are y,
 * then x; `planes` are R, G, B as the file's pixels have them, whatever its exposure. */
typedef struct material_picture {
    rad_data grid;
    const float *planes[3];
} material_picture;

/* Reads nothing yet. The report is kept, for what is told while rays are traced. Null when out of memory. */
material_library *material_library_create(const graze_report *);
void material_library_destroy(material_library *); /* null is let pass */

const graze_report *material_library_report(const material_library *);
/* Lives as long as the library. */
arena *material_library_memory(material_library *);

/* Definitions that all function files see, before any of these is used: a text, which messages call by `file`, or where
 * it is null the function file of that name. */
graze_status material_library_define(material_library *, const char *text, const char *file);
/* The definitions of function files; with those that every scene has. The files are read when they are first asked for;
 * null and "." stand for none. */
graze_status material_library_use_file(material_library *, const char *file, const rad_primitive *);
cal_program *material_library_program(material_library *);
/* Compiles for a primitive; the code lives as long as the library. */
graze_status material_library_compile(material_library *, const cal_request *, cal_code **);

/* Data files and pictures, looked for along RAYPATH and read when they are first asked for. */
graze_status material_library_data(material_library *, const char *name, const rad_primitive *, const rad_data **);
graze_status material_library_picture(material_library *, const char *name, const rad_primitive *,
                                      const material_picture **);

/* A number (base/fingerprint.h) of all that was read: function files, and the values of data files and pictures. */
uint64_t material_library_fingerprint(const material_library *);

#endif
