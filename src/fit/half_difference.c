/* Half vector and difference angles become two directions. */
#include "fit/half_difference.h"

#include <math.h>

#include "base/vector.h"

static vec3 turn(vec3 v, double theta, double phi) {
    vec3 w = {cos(theta) * v.x + sin(theta) * v.z, v.y, cos(theta) * v.z - sin(theta) * v.x};
    return (vec3){cos(phi) * w.x - sin(phi) * w.y, sin(phi) * w.x + cos(phi) * w.y, w.z};
}

void fit_from_half_difference(const double half[2], const double difference[2], vec3 *one, vec3 *other) {
    double t = difference[0], p = difference[1];
    vec3 d = {sin(t) * cos(p), sin(t) * sin(p), cos(t)};
    *one = turn(d, half[0], half[1]);
    *other = turn((vec3){-d.x, -d.y, d.z}, half[0], half[1]);
}
