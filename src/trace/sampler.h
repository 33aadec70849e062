/* Owen-scrambled Sobol points for light paths.
 *
 * A path draws its random numbers in groups of one to four coordinates. Each group is a Sobol point of its own,
 * stratified in these coordinates together: any 2^k points with index a 2^k ... (a+1) 2^k - 1 form a digital net, in
 * the first two coordinates of each group a perfect one. Groups are made independent of each other by taking the points
 * in another order, that of a nested uniform permutation which keeps these blocks, and by scrambling each coordinate by
 * itself.
 *
 * Why groups and not one sequence of many dimensions: with the few hundred points that a pixel or ray gets, only
 * low-dimensional projections can be stratified, and those of one long Sobol sequence are worse than the ones here. */
#ifndef TRACE_SAMPLER_H
#define TRACE_SAMPLER_H

#include <stdint.h>

/* What a key is made from, where no more than one point is asked for. */
typedef struct sampler_origin {
    uint64_t seed, stream;
} sampler_origin;

/* A value: copy it to draw the same numbers again. */
typedef struct sampler {
    uint64_t key;
    uint32_t index;
    uint32_t group;
    const sampler_origin *origin; /* null, or the key is made when the first number is drawn */
} sampler;

/* Different arguments give independent scramblings: `stream` is the number of the ray or pixel. */
uint64_t sampler_key(uint64_t seed, uint64_t stream, uint32_t replicate);
/* At the beginning of the path that is point number `index` of the sequence that `key` chooses. */
sampler sampler_start(uint64_t key, uint32_t index);
/* The same for the first point of the first replicate, while the origin is kept: a path that draws nothing needs no
 * key. */
static inline sampler sampler_start_once(const sampler_origin *origin) {
    return (sampler){0, 0, 0, origin};
}

/* The path's next group of coordinates, each in [0,1), uniform to 53 bits. */
double sampler_1d(sampler *);
void sampler_2d(sampler *, double out[2]);
void sampler_3d(sampler *, double out[3]);
void sampler_4d(sampler *, double out[4]);

#endif
