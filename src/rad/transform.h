/* Radiance's transforms: similarity maps written as `-t x y z -rx 30 -s 2 -mx -i 3 ...`. */
#ifndef RAD_TRANSFORM_H
#define RAD_TRANSFORM_H

#include <stdbool.h>

#include "base/report.h"
#include "base/vector.h"

/* p' = p m, row vectors: m[3] is the translation. `scale` > 0 is the length of a unit vector's image; mirrored maps
 * have a linear part of negative determinant. */
typedef struct rad_transform {
    double m[4][3];
    double scale;
    bool mirrored;
} rad_transform;

rad_transform rad_transform_identity(void);
rad_transform rad_transform_then(const rad_transform *first, const rad_transform *second);
rad_transform rad_transform_inverse(const rad_transform *);
vec3 rad_transform_point(const rad_transform *, vec3);
vec3 rad_transform_vector(const rad_transform *, vec3); /* no translation; scaled */

/* A unit vector turned, and mirrored: of the same length. */
static inline vec3 rad_transform_direction(const rad_transform *t, vec3 direction) {
    return vec3_scale(1 / t->scale, rad_transform_vector(t, direction));
}

/* What a vector comes from, but for a factor: of a similarity, the transposed matrix is the inverse but for that. */
static inline vec3 rad_transform_transposed(const rad_transform *t, vec3 v) {
    return vec3_make(v.x * t->m[0][0] + v.y * t->m[0][1] + v.z * t->m[0][2],
                     v.x * t->m[1][0] + v.y * t->m[1][1] + v.z * t->m[1][2],
                     v.x * t->m[2][0] + v.y * t->m[2][1] + v.z * t->m[2][2]);
}

/* The unit vector that becomes this one. */
static inline vec3 rad_transform_direction_back(const rad_transform *t, vec3 direction) {
    return vec3_scale(1 / t->scale, rad_transform_transposed(t, direction));
}

/* The point that becomes this one. */
static inline vec3 rad_transform_point_back(const rad_transform *t, vec3 point) {
    vec3 moved = vec3_subtract(point, vec3_make(t->m[3][0], t->m[3][1], t->m[3][2]));
    return vec3_scale(1 / (t->scale * t->scale), rad_transform_transposed(t, moved));
}

/* Reads the transform operations that `words` begin with and returns how many words they take: up to the first word
 * that is none, or whose arguments are missing or malformed, or a scale of zero. *in_range tells whether the map is one
 * that doubles can hold; where it is not, *transform is the identity. */
int rad_transform_leading(rad_transform *transform, const char *const *words, int count, bool *in_range);
/* What is to follow such a word, for messages where it does not; or that it is no operation. */
const char *rad_transform_wants(const char *word);
/* Reads words that must all be transform operations; anything else is an error naming the word. */
graze_status rad_transform_parse(rad_transform *, const char *const *words, int count, const place *where,
                                 const graze_report *);

#endif
