/* Where a source with patterns is bright: a table of its radiance over its solid angle, to sample it by. */
#ifndef SCENE_SOURCE_TABLE_H
#define SCENE_SOURCE_TABLE_H

#include "base/arena.h"
#include "scene/scene.h"

typedef struct source_table source_table;

/* Makes the table of a source, in the arena, in cells of equal solid angle; *mean is the mean of the radiance. The
 * finer, the more the radiance varies, and as fine as the pictures that it comes from; the same on any number of
 * threads. */
graze_status source_table_make(source_table **, rgb *mean, const scene_light *, arena *, int threads,
                               const graze_report *);

/* Draws a direction by two numbers in [0,1), near ones by near numbers; *density is per unit solid angle. No direction
 * of the source has less than a tenth of the density that all would have if they were drawn alike. */
vec3 source_table_draw(const source_table *, const double random[2], double *density);

/* The density of a direction of the source. */
double source_table_density(const source_table *, vec3 direction);

#endif
