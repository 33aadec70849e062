/* Frames around a direction. */
#include "base/vector.h"

/* Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017: the divisor is at least 1 and nothing
 * cancels, so all of it is good to a few units in the last place, for every z. */
frame frame_around(vec3 z) {
    double sign = copysign(1, z.z);
    double a = -1 / (sign + z.z);
    double b = z.x * z.y * a;
    return (frame){
        .x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x},
        .y = {b, sign + z.y * z.y * a, -z.y},
        .z = z,
    };
}
