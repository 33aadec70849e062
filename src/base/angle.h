/* Angles. */
#ifndef BASE_ANGLE_H
#define BASE_ANGLE_H

#define PI     3.14159265358979323846
#define INV_PI (1 / PI)

static inline double angle_radians(double degrees) {
    return degrees * (PI / 180);
}

static inline double angle_degrees(double radians) {
    return radians / (PI / 180);
}

#endif
