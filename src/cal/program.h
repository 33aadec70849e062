/* Definitions: all that function files say, with their names resolved and their constants computed.
 *
 * A program grows while a scene is read, by one thread at a time; what is compiled from it (compile.h) does not change
 * any more. Names are resolved in the order of the text, as Radiance does: what a name means where it is used is
 * settled there, though what is defined later may give that meaning its value.
 */
#ifndef CAL_PROGRAM_H
#define CAL_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/report.h"

typedef struct cal_program cal_program;

/* Numbers of the channels that the renderer fills: $1 is Dx. Those behind CAL_RAY_CHANNELS have no number in Radiance,
 * and a value only in some materials. */
enum {
    CAL_DX = 1,
    CAL_DY,
    CAL_DZ, /* direction of the ray */
    CAL_NX,
    CAL_NY,
    CAL_NZ, /* normal */
    CAL_PX,
    CAL_PY,
    CAL_PZ,   /* point hit */
    CAL_T,    /* distance from the eye */
    CAL_RDOT, /* cosine of ray and normal, -D.N */
    CAL_S,    /* scale of the transform */
    CAL_TX,
    CAL_TY,
    CAL_TZ, /* its origin, and unit vectors */
    CAL_IX,
    CAL_IY,
    CAL_IZ,
    CAL_JX,
    CAL_JY,
    CAL_JZ,
    CAL_KX,
    CAL_KY,
    CAL_KZ,
    CAL_TS, /* distance along this ray, shadow distance */
    CAL_LU,
    CAL_LV, /* coordinates of a mesh */
    CAL_RAY_CHANNELS = CAL_LV,
    CAL_NXP, /* materials with functions: perturbed normal, its Rdot, colour of the pattern */
    CAL_NYP,
    CAL_NZP,
    CAL_RDOTP,
    CAL_CRP,
    CAL_CGP,
    CAL_CBP,
    CAL_DXA, /* prisms: direction to the light */
    CAL_DYA,
    CAL_DZA,
    CAL_SCENE_CHANNELS = CAL_DZA,
    CAL_CHANNELS_MOST = 63
};

/* Where function files are found. `find` gives the path for a name as scenes write it, or null where there is none;
 * the path must last until the file has been read. It is false when out of memory. */
typedef struct cal_finder {
    bool (*find)(void *user, const char *name, const char **path);
    void *user;
} cal_finder;

/* Null when out of memory. The program knows the library's functions and nothing else. */
cal_program *cal_program_create(void);
void cal_program_destroy(cal_program *); /* null is let pass */

/* What Radiance's rayinit.cal defines, in our words, and names for the channels of scenes. */
graze_status cal_program_add_scene_names(cal_program *, const graze_report *);

/* Reads definitions into the context of `file`, a name as scenes write it (null or ".": the outermost). Messages call
 * the text by `where`, of which file and parents count. */
graze_status cal_program_add_text(cal_program *, const char *file, const char *text, size_t length, const place *where,
                                  const graze_report *);

/* The same with the text of the file of that name, unless it was read before; of those that skies and lamps need there
 * are definitions of ours (cal/own_files.h) where there is no such file. `where` names it; null and "." stand for
 * no file. */
graze_status cal_program_use_file(cal_program *, const char *name, const cal_finder *, const place *where,
                                  const graze_report *);

/* The same, but into the outermost context: what the file defines is seen by all others. */
graze_status cal_program_add_file(cal_program *, const char *name, const cal_finder *, const place *where,
                                  const graze_report *);

/* A number (base/fingerprint.h) of all the text that was read, and of the contexts that it was read into. */
uint64_t cal_program_fingerprint(const cal_program *);

/* How many parameters the function of that name has, in the context of `file`; 0 for a variable or an unknown name;
 * of those of the library that take any number, the least. -1 when out of memory. */
int cal_program_parameter_count(cal_program *, const char *file, const char *name);

#endif
