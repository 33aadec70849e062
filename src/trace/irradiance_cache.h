/* Irradiance about points that many paths come to by a diffuse reflection: averages over cells.
 *
 * A pixel's diffusely reflected light comes from all about it. Which of it arrives from where decides the pixel's
 * error; what exactly one bright wall gets from all others hardly does, and is the same question for all pixels that
 * see the wall. So it is answered once, by paths from points that a few pilot paths have come to, and paths that come
 * there end. A cell tells how it slopes, too. Cells are small as seen from where a path comes, and where few pilot
 * paths have been, there is none, and the path goes on.
 *
 * There are two caches in one, of independent pilot paths and cells, and each cell has been answered four times, from
 * other points by other paths. Paths take the mean of all these parts; how much what they add up to differs tells how
 * wrong it is.
 *
 * What dielectrics and prisms bend of small lights is found by luck alone, in few cells, and too much of it there: no
 * cell has any, and some of the paths that end in one look for that (wanted_light in trace/path_state.h). */
#ifndef TRACE_IRRADIANCE_CACHE_H
#define TRACE_IRRADIANCE_CACHE_H

#include "trace/context.h"
#include "trace/hit.h"

typedef struct irradiance_cache irradiance_cache;

/* So many answers that are independent but for what cells do to them. */
enum { IRRADIANCE_PARTS = 8 };

/* Where a pilot path has come to. */
typedef struct irradiance_record {
    vec3 point, normal; /* the normal on the side that the path came from */
    int64_t surface;    /* -1: nowhere */
    double distance;    /* that it came from */
} irradiance_record;

/* The first hit of pilot ray `index` of `count`. */
typedef path_hit irradiance_pilot(void *user, size_t index);

/* Builds the cache for paths that have been reflected diffusely once. The context's own cache is not used. The result
 * does not depend on the number of threads. It is null where a cache is of no use: less than two diffuse reflections,
 * lights that are not sampled or are seen in mirrors that are not faint, and a limited number of reflections. */
graze_status irradiance_cache_build(irradiance_cache **, const path_context *, irradiance_pilot *, void *user,
                                    size_t count, int threads, const graze_report *);
void irradiance_cache_destroy(irradiance_cache *);

/* Looks up the irradiance in both caches where a path has come to. False: it is in neither or only one of them. */
bool irradiance_cache_find(const irradiance_cache *, const irradiance_record *, rgb found[IRRADIANCE_PARTS]);

#endif
