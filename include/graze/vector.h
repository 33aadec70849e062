/* Vectors and colours, as every other Graze header uses them. */
#ifndef GRAZE_VECTOR_H
#define GRAZE_VECTOR_H

#ifdef __cplusplus
extern "C" {
#endif

/* A point, a displacement or a direction. Which of them, and in which frame, the function that takes it says. */
typedef struct graze_vec3 {
    double x, y, z;
} graze_vec3;

/* A colour-valued quantity in Radiance's red, green and blue: radiance in W/sr/m^2, irradiance in W/m^2, or a
 * reflectance without unit. */
typedef struct graze_rgb {
    double r, g, b;
} graze_rgb;

#ifdef __cplusplus
}
#endif

#endif
