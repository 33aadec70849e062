/* The diffuse term: value, sampling and density. */
#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "brdf/constants.h"
#include "brdf/parameters.h"
#include "graze/brdf.h"

static bool both_above(graze_vec3 l, graze_vec3 v) {
    return l.z > 0 && v.z > 0;
}

double graze_diffuse_value(graze_vec3 l, graze_vec3 v) {
    return both_above(l, v) ? 1 / brdf_pi : 0;
}

double graze_diffuse_density(graze_vec3 l, graze_vec3 v) {
    return both_above(l, v) ? fmin(l.z, DBL_MAX) * (1 / brdf_pi) : 0;
}

/* A point of the unit disk, evenly distributed, and the hemisphere above it. */
static graze_vec3 direction_of(double s, double t) {
    double quarter = rint(4 * t), angle = 2 * brdf_pi * (t - quarter / 4); /* exact but for the product */
    double radius = sqrt(s), x = radius * cos(angle), y = radius * sin(angle), z = sqrt(1 - s);
    switch ((int)quarter % 4) {
    case 0:
        return (graze_vec3){x, y, z};
    case 1:
        return (graze_vec3){-y, x, z};
    case 2:
        return (graze_vec3){-x, -y, z};
    default:
        return (graze_vec3){y, -x, z};
    }
}

graze_brdf_sample graze_diffuse_sample(graze_vec3 v, double s, double t) {
    if (!(v.z > 0))
        return (graze_brdf_sample){{0, 0, 0}, 0, 0};
    graze_vec3 l = direction_of(into_unit_interval(s), into_unit_interval(t));
    return (graze_brdf_sample){l, l.z * (1 / brdf_pi), 1};
}
