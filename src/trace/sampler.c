/* Scrambled Sobol points: direction numbers, scrambling, and groups of coordinates. */
#include "trace/sampler.h"

#include <stddef.h>

/* Binary digits are kept with the most significant one in the lowest bit, since carries and products run from low to
 * high bits, and scrambling lets each digit depend on the more significant ones. */

/* A bijection that turns every bit of its result with probability 1/2 when any one bit of x is turned (to 0.1% in the
 * root mean square; shifts and multipliers are the best of 400 random ones by that measure). */
static inline uint64_t mix(uint64_t x) {
    x = (x ^ x >> 29) * 0x6153f9f674da092fu;
    x = (x ^ x >> 31) * 0x1f33ad87aea89763u;
    return x ^ x >> 30;
}

/* Enough where x is such a result, plus a multiple of a constant. */
static inline uint64_t half_mix(uint64_t x) {
    x = (x ^ x >> 29) * 0x6153f9f674da092fu;
    return x ^ x >> 31;
}

/* Random odd numbers. Their multiples give mix distinct arguments. */
#define GROUP_STEP     0xd10ee2bccc991e8bu
#define DIMENSION_STEP 0xd5f4941f77b26861u
#define SUBTREE_STEP   0x24ec7d6bcd043551u
#define MULTIPLIER     0x8f491e3a6f1045bbu

uint64_t sampler_key(uint64_t seed, uint64_t stream, uint32_t replicate) {
    uint64_t key = mix(seed + GROUP_STEP);
    key = mix(key ^ mix(stream + DIMENSION_STEP));
    return mix(key + (replicate + UINT64_C(1)) * SUBTREE_STEP);
}

sampler sampler_start(uint64_t key, uint32_t index) {
    return (sampler){key, index, 0, NULL};
}

static inline uint64_t reverse_bits(uint64_t x) {
    x = (x >> 1 & 0x5555555555555555u) | (x & 0x5555555555555555u) << 1;
    x = (x >> 2 & 0x3333333333333333u) | (x & 0x3333333333333333u) << 2;
    x = (x >> 4 & 0x0f0f0f0f0f0f0f0fu) | (x & 0x0f0f0f0f0f0f0f0fu) << 4;
    return __builtin_bswap64(x);
}

/* Scrambling in its exact form walks down a binary tree: digit number k is turned or not by a fair coin that belongs to
 * the node which the k digits before it lead to. Six levels have 63 nodes, to which the bits 1 to 63 of `coins` belong.
 * This returns the coins for the six digits of `digits`. */
static inline uint64_t tree_coins(uint64_t coins, uint64_t digits) {
    return (coins >> 1 & 1) | (coins >> ((digits & 1) + 1) & 2) | (coins >> ((digits & 3) + 2) & 4) |
           (coins >> ((digits & 7) + 5) & 8) | (coins >> ((digits & 15) + 12) & 16) |
           (coins >> ((digits & 31) + 27) & 32);
}

/* The same with the most significant digit in bit 5. */
static inline uint64_t tree_coins_down(uint64_t coins, uint64_t digits) {
    return (coins << 4 & 32) | (coins << 2 >> (digits >> 5) & 16) | (coins >> ((digits >> 4) + 1) & 8) |
           (coins >> ((digits >> 3) + 6) & 4) | (coins >> ((digits >> 2) + 15) & 2) |
           (coins >> ((digits >> 1) + 32) & 1);
}

static inline uint64_t rotate(uint64_t x, int n) {
    return x >> n | x << (64 - n);
}

/* Owen scrambling (A. Owen, "Randomly permuted (t,m,s)-nets", 1995) of 64 digits, those from the 33rd on being 0
 * before. The first six levels have a coin of its own at every node. In each of the 64 subtrees below, a digit's coin
 * is drawn anew for each of the four values of the two digits before it, which makes nine levels that are exact; what
 * depends on the digits before those is made by products (after S. Laine and T. Karras, "Stratified sampling for
 * stochastic transparency", 2011). */
static inline uint64_t scramble(uint32_t digits, uint64_t coins) {
    uint64_t first = digits & 63, rest = digits >> 6, one_up = rest << 1, two_up = rest << 2;
    uint64_t random = half_mix(coins + (first + 1) * SUBTREE_STEP);
    rest ^= random ^ (one_up & rotate(random, 16)) ^ (two_up & (rotate(random, 32) ^ (one_up & rotate(random, 48))));
    rest ^= rest * (rotate(random, 8) << 3);
    rest *= MULTIPLIER;
    return rest << 6 | (first ^ tree_coins(coins, first));
}

static inline double to_double(uint64_t digits) {
    return (double)(reverse_bits(digits) >> 11) * 0x1p-53;
}

/* A permutation of the index that keeps blocks of 2^k: in every block of 4096, and independently of all others, nested
 * uniform with a true coin at every node. The order of such blocks stays. */
static inline uint32_t shuffle(uint32_t index, uint64_t coins) {
    uint64_t low = index & 63, middle = index >> 6 & 63, high = index >> 12;
    uint64_t middle_coins = high > 0 ? mix(coins + high * DIMENSION_STEP) : coins;
    uint64_t low_coins = half_mix(middle_coins + (middle + 1) * SUBTREE_STEP);
    middle ^= tree_coins_down(middle_coins, middle);
    low ^= tree_coins_down(low_coins, low);
    return (uint32_t)(high << 12 | middle << 6 | low);
}

/* The second Sobol dimension, x + 1: digit r is the sum of the binomials (c choose r) over the digits c of the index.
 * Mod 2 that matrix is the Kronecker power of its first block of two. */
static inline uint32_t sobol_second(uint32_t x) {
    x ^= x >> 1 & 0x55555555u;
    x ^= x >> 2 & 0x33333333u;
    x ^= x >> 4 & 0x0f0f0f0fu;
    x ^= x >> 8 & 0x00ff00ffu;
    x ^= x >> 16;
    return x;
}

/* The third and fourth: the primitive polynomials x^2 + x + 1 and x^3 + x + 1 with the first direction numbers (1, 3)
 * and (1, 3, 1), the rest by Sobol's recurrence, which test/trace/sampler.c repeats. Of all 32 choices of these and of
 * x^3 + x^2 + 1, this one has the smallest quality parameters t, squared and summed over nets of 2 to 2^16 points in
 * all pairs and triples of the four dimensions and in all four. The fourth's numbers stand in the high halves. */
static const uint64_t sobol_columns[32] = {
    0x0000000100000001, 0x0000000300000003, 0x0000000400000006, 0x0000000a00000009, 0x0000001f00000017,
    0x0000002e0000003a, 0x0000004500000071, 0x000000c9000000a3, 0x0000011b00000116, 0x000002a400000339,
    0x0000079a00000677, 0x00000b67000009aa, 0x0000101e00001601, 0x0000302d00003903, 0x0000404100007706,
    0x0000a0c30000aa09, 0x0001f10400010117, 0x0002e28a0003033a, 0x000457df00060671, 0x000c9bae000909a3,
    0x0011a10500171616, 0x002a7289003a3939, 0x0079e7db00717777, 0x00b6dba400a3aaaa, 0x0100011a01170001,
    0x030002a7033a0003, 0x0400079e06710006, 0x0a000b6d09a30009, 0x1f00100116160017, 0x2e0030033939003a,
    0x4500400477770071, 0xc900a00aaaaa00a3,
};

static inline uint64_t sobol_third_and_fourth(uint32_t index) {
    uint64_t sum = 0;
    for (const uint64_t *column = sobol_columns; index > 0; index >>= 1)
        sum ^= *column++ & -(uint64_t)(index & 1);
    return sum;
}

static inline void draw(sampler *s, int count, double *out) {
    if (s->origin) {
        s->key = sampler_key(s->origin->seed, s->origin->stream, 0);
        s->origin = NULL;
    }
    uint64_t key = mix(s->key + (s->group + UINT64_C(1)) * GROUP_STEP);
    s->group++;
    /* Where a ray has one path, nothing is asked for but the first point: with the constant that is faster. */
    uint32_t index = s->index == 0 ? shuffle(0, key) : shuffle(s->index, key), digits[4] = {index, 0, 0, 0};
    if (count > 1)
        digits[1] = sobol_second(index);
    if (count > 2) {
        uint64_t both = sobol_third_and_fourth(index);
        digits[2] = (uint32_t)both;
        digits[3] = (uint32_t)(both >> 32);
    }
    for (int i = 0; i < count; i++)
        out[i] = to_double(scramble(digits[i], mix(key + (uint64_t)(i + 1) * DIMENSION_STEP)));
}

double sampler_1d(sampler *s) {
    double out[1];
    draw(s, 1, out);
    return out[0];
}

void sampler_2d(sampler *s, double out[2]) {
    draw(s, 2, out);
}

void sampler_3d(sampler *s, double out[3]) {
    draw(s, 3, out);
}

void sampler_4d(sampler *s, double out[4]) {
    draw(s, 4, out);
}
