/* Indirect light on what pixels show, which neighbours share.
 *
 * On a wall it hardly changes from pixel to pixel, and all of them would find it by rays of their own. So it is found
 * beforehand at some points, records, each by very many rays; and pixels lay a surface through the records about them
 * that are on the same thing and in sight. How these scatter about it tells how wrong it may be: that is part of the
 * pixel's error. Where it is too much - by edges, contact shadows, small things - the pixel is sampled as ever. */
#ifndef PICTURE_SHARED_LIGHT_H
#define PICTURE_SHARED_LIGHT_H

#include <stdatomic.h>

#include "picture/local_fit.h"
#include "picture/picture.h"
#include "trace/path.h"

typedef struct shared_light shared_light;

/* Makes the records, for paths that use this cache. It is null where there is no cache, where pixels show more than one
 * thing at a time through a lens or while they are exposed, and where some lights are found by reflection alone. All
 * that is handed over must outlive it. Soon over once `stopped` is set, and then of no use. */
graze_status shared_light_build(shared_light **, const graze_scene *, const graze_trace_settings *,
                                const picture_settings *, const irradiance_cache *, const atomic_bool *stopped,
                                const graze_report *);
void shared_light_destroy(shared_light *); /* null is let pass */

/* What is known of a pixel. */
typedef struct shared_pixel {
    irradiance_record place; /* that its centre shows */
    local_fit fit;           /* of irradiance; slopes are per pixel */
    rgb told[IRRADIANCE_PARTS];
} shared_pixel;

/* False: nothing. */
bool shared_light_find(const shared_light *, int column, int row, shared_pixel *);

/* What is known at a hit in the pixel, so far from its centre. False: nothing. */
bool shared_light_at(const shared_light *, const shared_pixel *, const path_hit *, double x, double y, path_indirect *);

#endif
