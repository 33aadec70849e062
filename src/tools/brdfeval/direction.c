/* Angles in degrees become vectors. */
#include "tools/brdfeval/direction.h"

#include <math.h>

#include "base/angle.h"

direction_angle direction_angle_of(double degrees) {
    int quarters;
    double rest = angle_radians(remquo(degrees, 90, &quarters)), s = sin(rest), c = cos(rest);
    const double sines[] = {s, c, -s, -c};
    return (direction_angle){degrees, sines[quarters & 3], sines[(quarters + 1) & 3]};
}

vec3 direction_from_angles(direction_angle theta, direction_angle phi) {
    return vec3_make(theta.sine * phi.cosine, theta.sine * phi.sine, theta.cosine);
}
