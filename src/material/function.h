/* Functions of a primitive, compiled: what they need to know of a ray, and their values there. */
#ifndef MATERIAL_FUNCTION_H
#define MATERIAL_FUNCTION_H

#include <stdatomic.h>
#include <stdbool.h>

#include "base/vector.h"
#include "material/library.h"
#include "rad/transform.h"

/* A ray at its end, as function files know it. */
typedef struct material_ray {
    vec3 point, direction; /* unit, the way the ray goes */
    vec3 normal;           /* the surface's own; of a source against the direction */
    double distance;       /* all the way from the eye (T) */
    double last_distance;  /* of the ray alone (Ts) */
    double u, v;           /* texture coordinates of a mesh (Lu, Lv); else 0 */
} material_ray;

/* The primitive that functions belong to. */
typedef struct material_owner {
    const rad_primitive *primitive;
    const graze_report *report;
    atomic_flag *told;               /* of a compute error */
    bool moved;                      /* the primitive has a transform: */
    rad_transform forward, backward; /* from where its functions are defined to the world, and back */
} material_owner;

typedef struct material_function {
    cal_code *code;
    int count; /* of values */
} material_function;

/* The first channel beside those of the ray: for data, and directions. So many values at most has a function: prism2's.
 */
enum { MATERIAL_OWN_CHANNEL = CAL_SCENE_CHANNELS + 1, MATERIAL_VALUES_MOST = 8 };

/* Reads the function file, string `file` of the primitive, and the transform behind it. Strings before number `rest`
 * are spoken for; others before the transform are told to be ignored. */
graze_status material_owner_begin(material_owner *, material_library *, const rad_primitive *, uint32_t file,
                                  uint32_t rest);
/* Compiles expressions, MATERIAL_VALUES_MOST at most, in the context of that file. `channels` are those that have
 * values beside the ray's. Names that are not defined are errors, in all branches that could be taken. */
graze_status material_function_compile(material_function *, material_library *, const material_owner *, uint32_t file,
                                       const cal_expression *, size_t count, uint64_t channels);

/* Fills in the channels of the ray that the functions use (null is let pass); others are left alone. */
void material_channels(double channels[CAL_CHANNELS_MOST], const material_owner *, const material_function *first,
                       const material_function *second, const material_ray *);
/* Sets three channels, from `first` on, to a direction as the functions see it. */
void material_own_direction(double *channels, int first, const material_owner *, vec3 direction);
/* Computes the values. False: a compute error, of which the user is told once for each primitive. */
bool material_function_values(const material_function *, const material_owner *, const double *channels,
                              double *values);

/* A vector of the functions' space in the world, of the same length. */
vec3 material_to_world(const material_owner *, vec3);

#endif
