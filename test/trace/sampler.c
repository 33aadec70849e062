/* The scrambled Sobol points, against a slow form of the same definition and against what scrambling promises. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "trace/sampler.h"

static void draw(sampler *s, int count, double *out) {
    if (count == 1)
        *out = sampler_1d(s);
    else
        (count == 2 ? sampler_2d : count == 3 ? sampler_3d : sampler_4d)(s, out);
}

/* Point `index` of the group that `skipped` calls precede. */
static void point(uint64_t key, uint32_t index, int skipped, int count, double *out) {
    sampler s = sampler_start(key, index);
    while (skipped-- > 0)
        sampler_1d(&s);
    draw(&s, count, out);
}

/* chi-square as a normal deviate: E. Wilson and M. Hilferty, 1931. */
static double deviate(double chi_square, double freedom) {
    double spread = 2 / (9 * freedom);
    return (cbrt(chi_square / freedom) - (1 - spread)) / sqrt(spread);
}

/* ---- The definition again, digit by digit ---- */

static uint64_t multiply(uint64_t a, uint64_t b) {
    uint64_t product = 0;
    for (int i = 0; i < 64; i++)
        if (b >> i & 1)
            product += a << i;
    return product;
}

static uint64_t slow_mix(uint64_t x, bool half) {
    x ^= x >> 29;
    x = multiply(x, 0x6153f9f674da092f);
    x ^= x >> 31;
    if (half)
        return x;
    x = multiply(x, 0x1f33ad87aea89763);
    return x ^ x >> 30;
}

static const uint64_t group_step = 0xd10ee2bccc991e8b, dimension_step = 0xd5f4941f77b26861,
                      subtree_step = 0x24ec7d6bcd043551, multiplier = 0x8f491e3a6f1045bb;

static uint64_t slow_key(uint64_t seed, uint64_t stream, uint32_t replicate) {
    uint64_t streams = slow_mix(stream + dimension_step, false);
    uint64_t key = slow_mix(slow_mix(seed + group_step, false) ^ streams, false);
    return slow_mix(key + multiply((uint64_t)replicate + 1, subtree_step), false);
}

/* Walks the tree of `levels` levels: each digit, from digits[0], is turned by the coin of the node it is at. */
static void turn_digits(int *digits, int levels, uint64_t coins, bool prefix_reversed) {
    int before[6];
    for (int level = 0; level < levels; level++) {
        unsigned prefix = 0;
        for (int i = 0; i < level; i++)
            prefix |= (unsigned)before[i] << (prefix_reversed ? i : level - 1 - i);
        before[level] = digits[level];
        digits[level] ^= (int)(coins >> ((1u << level) + prefix) & 1);
    }
}

static uint32_t slow_shuffle(uint32_t index, uint64_t coins) {
    int digits[12]; /* from the highest of the twelve low ones */
    for (int i = 0; i < 12; i++)
        digits[i] = index >> (11 - i) & 1;
    uint64_t high = index >> 12, middle = index >> 6 & 63;
    uint64_t middle_coins = high > 0 ? slow_mix(coins + multiply(high, dimension_step), false) : coins;
    uint64_t low_coins = slow_mix(middle_coins + multiply(middle + 1, subtree_step), true);
    turn_digits(digits, 6, middle_coins, false);
    turn_digits(digits + 6, 6, low_coins, false);
    uint32_t shuffled = index & ~0xfffu;
    for (int i = 0; i < 12; i++)
        shuffled |= (uint32_t)digits[i] << (11 - i);
    return shuffled;
}

/* Digit `row` of the direction number of digit `column` of the index, by Sobol's recurrence. */
static int direction_digit(int dimension, int row, int column) {
    static const uint32_t first[4][3] = {{1}, {1}, {1, 3}, {1, 3, 1}};
    static const int degrees[4] = {0, 1, 2, 3};
    static const unsigned inner[4] = {0, 0, 1, 1}; /* coefficients between the first and the last */
    uint64_t m[32];
    int degree = degrees[dimension];
    for (int k = 0; k <= column; k++) {
        if (degree == 0 || k < degree) {
            m[k] = first[dimension][degree == 0 ? 0 : k];
            continue;
        }
        m[k] = m[k - degree] ^ m[k - degree] << degree;
        for (int i = 1; i < degree; i++)
            if (inner[dimension] >> (degree - 1 - i) & 1)
                m[k] ^= m[k - i] << i;
    }
    return row > column ? 0 : (int)(m[column] >> (column - row) & 1);
}

/* digits[0] is the most significant. */
static void sobol_digits(uint32_t index, int dimension, int digits[64]) {
    memset(digits, 0, 64 * sizeof *digits);
    for (int column = 0; column < 32 && index >> column; column++)
        for (int row = 0; row <= column; row++)
            digits[row] ^= (int)(index >> column & 1) & direction_digit(dimension, row, column);
}

static void slow_scramble(int digits[64], uint64_t coins) {
    uint64_t first = 0, rest = 0;
    for (int i = 0; i < 6; i++)
        first |= (uint64_t)digits[i] << i;
    for (int i = 6; i < 64; i++)
        rest |= (uint64_t)digits[i] << (i - 6);
    uint64_t random = slow_mix(coins + multiply(first + 1, subtree_step), true), turned = 0, factor = 0;
    for (int i = 0; i < 58; i++) {
        int before = i < 1 ? 0 : rest >> (i - 1) & 1, two_before = i < 2 ? 0 : rest >> (i - 2) & 1;
        uint64_t coin = random >> i;
        if (before)
            coin ^= random >> (i + 16) % 64;
        if (two_before)
            coin ^= random >> (i + 32) % 64;
        if (before && two_before)
            coin ^= random >> (i + 48) % 64;
        turned |= ((rest >> i ^ coin) & 1) << i;
    }
    for (int i = 0; i < 61; i++)
        factor |= (random >> (i + 8) % 64 & 1) << (i + 3);
    rest = multiply(turned ^ multiply(turned, factor), multiplier);
    turn_digits(digits, 6, coins, true);
    for (int i = 6; i < 64; i++)
        digits[i] = (int)(rest >> (i - 6) & 1);
}

static uint64_t group_key(uint64_t key, int group) {
    return slow_mix(key + multiply((uint64_t)group + 1, group_step), false);
}

static double slow_coordinate(uint64_t key, uint32_t index, int group, int dimension) {
    uint64_t in_group = group_key(key, group);
    int digits[64];
    sobol_digits(slow_shuffle(index, in_group), dimension, digits);
    slow_scramble(digits, slow_mix(in_group + multiply((uint64_t)dimension + 1, dimension_step), false));
    double x = 0;
    for (int i = 0; i < 53; i++)
        x += digits[i] * ldexp(0.5, -i);
    return x;
}

static void points_are_what_the_definition_says(void **state) {
    (void)state;
    static const uint32_t indices[] = {0, 1, 2, 3, 17, 63, 64, 255, 4095, 4096, 70000, 0x7fffffff, 0xffffffff};
    for (uint32_t i = 0; i < 6; i++) {
        uint64_t key = sampler_key(i * 0x123456789, i % 3, i / 2);
        assert_true(key == slow_key(i * 0x123456789, i % 3, i / 2));
        for (size_t k = 0; k < sizeof indices / sizeof *indices; k++) {
            sampler s = sampler_start(key, indices[k]);
            for (int group = 0; group < 8; group++) {
                double out[4];
                int count = group % 4 + 1;
                draw(&s, count, out);
                for (int d = 0; d < count; d++)
                    assert_true(out[d] == slow_coordinate(key, indices[k], group, d));
            }
        }
    }
}

/* ---- Nets ---- */

/* Whether 2^k points from a multiple of 2^k put 2^t into each of the 2^(k-t) boxes of all shapes. */
static void check_net(uint64_t key, uint32_t block, int k, int group, int dimensions, int t) {
    static double points[1 << 12][4];
    for (uint32_t i = 0; i < 1u << k; i++)
        point(key, (block << k) + i, group, dimensions, points[i]);
    int shape[4] = {0}, total = k - t;
    static int counts[1 << 12];
    for (int code = 0; code < 13 * 13 * 13; code++) {
        int used = 0;
        for (int d = 0, rest = code; d < dimensions - 1; d++, rest /= 13)
            used += shape[d] = rest % 13;
        if (used > total)
            continue;
        shape[dimensions - 1] = total - used;
        memset(counts, 0, sizeof counts);
        for (int i = 0; i < 1 << k; i++) {
            unsigned box = 0;
            for (int d = 0; d < dimensions; d++)
                box = box << shape[d] | (unsigned)ldexp(points[i][d], shape[d]);
            counts[box]++;
        }
        for (int box = 0; box < 1 << total; box++)
            assert_int_equal(counts[box], 1 << t);
        if (dimensions == 1)
            break;
    }
}

static void blocks_of_points_are_nets(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        uint64_t key = sampler_key(5, i, 0);
        uint32_t block = (uint32_t[]){0, 1, 6, 1001}[i];
        for (int k = 0; k <= 12; k++) {
            check_net(key, block, k, (int)i, 1, 0);
            if (k <= 10)
                check_net(key, block, k, (int)i, 2, 0);
        }
        for (int k = 1; k <= 8; k++)
            check_net(key, block, k, (int)i, 3, 1);
        for (int k = 3; k <= 8; k++)
            check_net(key, block, k, (int)i, 4, 3);
    }
}

/* Each of the four coordinates for itself is stratified perfectly. */
static void every_coordinate_is_stratified(void **state) {
    (void)state;
    enum { POINTS = 1024 };
    for (int d = 0; d < 4; d++) {
        bool taken[POINTS] = {false};
        for (uint32_t i = 0; i < POINTS; i++) {
            double out[4];
            point(77, i, 2, 4, out);
            int cell = (int)(out[d] * POINTS);
            assert_false(taken[cell]);
            taken[cell] = true;
        }
    }
}

/* ---- Scrambling ---- */

enum { LEVELS = 9, NODES = (1 << LEVELS) - 1 };

/* The coins of the first coordinate of a group: how each digit of the shuffled van der Corput point was turned, by
 * node. Fails unless that depends on the digits before it only. The node of level l and prefix p is number 2^l - 1 + p.
 */
static void read_coins(uint64_t key, int coins[NODES]) {
    uint64_t in_group = group_key(key, 0);
    for (int i = 0; i < NODES; i++)
        coins[i] = -1;
    for (uint32_t i = 0; i < 1u << LEVELS; i++) {
        double out;
        point(key, i, 0, 1, &out);
        uint32_t turned = (uint32_t)(out * (1 << LEVELS)), shuffled = slow_shuffle(i, in_group);
        for (int level = 0; level < LEVELS; level++) {
            uint32_t prefix = shuffled & ((1u << level) - 1);
            int coin = (int)((shuffled >> level & 1) ^ (turned >> (LEVELS - 1 - level) & 1));
            int *known = &coins[(1 << level) - 1 + prefix];
            assert_true(*known == -1 || *known == coin);
            *known = coin;
        }
    }
}

/* Fair, and any two of them independent, over many keys; and the seven of a subtree of three levels jointly. */
static void coins_are_fair_and_independent(void **state) {
    (void)state;
    enum { KEYS = 4000, CHOSEN = 120 };
    static int coins[NODES], sums[NODES], pairs[CHOSEN][CHOSEN], joint[3][128];
    memset(sums, 0, sizeof sums);
    memset(pairs, 0, sizeof pairs);
    memset(joint, 0, sizeof joint);
    /* All of the six upper levels, and the tops of subtrees below. */
    int chosen[CHOSEN];
    for (int i = 0; i < CHOSEN; i++)
        chosen[i] = i < 63 ? i : 63 + 7 * (i - 63);
    static const int roots[3] = {0, 63 + 5, 63 + 40};
    for (uint32_t k = 0; k < KEYS; k++) {
        read_coins(sampler_key(1, k, 0), coins);
        for (int i = 0; i < NODES; i++)
            sums[i] += coins[i];
        for (int i = 0; i < CHOSEN; i++)
            for (int j = 0; j < i; j++)
                pairs[i][j] += coins[chosen[i]] ^ coins[chosen[j]];
        for (int r = 0; r < 3; r++) {
            int pattern = 0, level = r == 0 ? 0 : 6, prefix = roots[r] - ((1 << level) - 1);
            for (int depth = 0; depth < 3; depth++)
                for (int below = 0; below < 1 << depth; below++)
                    pattern = pattern << 1 | coins[(1 << (level + depth)) - 1 + prefix + (below << level)];
            joint[r][pattern]++;
        }
    }
    double chi_square = 0;
    for (int i = 0; i < NODES; i++)
        chi_square += (sums[i] - KEYS / 2) * (double)(sums[i] - KEYS / 2) / (KEYS / 4);
    assert_true(fabs(deviate(chi_square, NODES)) < 4);
    chi_square = 0;
    for (int i = 0; i < CHOSEN; i++)
        for (int j = 0; j < i; j++)
            chi_square += (pairs[i][j] - KEYS / 2) * (double)(pairs[i][j] - KEYS / 2) / (KEYS / 4);
    assert_true(fabs(deviate(chi_square, CHOSEN * (CHOSEN - 1) / 2)) < 4);
    for (int r = 0; r < 3; r++) {
        chi_square = 0;
        for (int i = 0; i < 128; i++)
            chi_square += (joint[r][i] - KEYS / 128.0) * (joint[r][i] - KEYS / 128.0) / (KEYS / 128.0);
        assert_true(fabs(deviate(chi_square, 127)) < 4);
    }
}

/* The order of the first eight points: all 2^7 nested permutations of them, equally often. */
static void orders_of_points_are_uniform(void **state) {
    (void)state;
    enum { KEYS = 20000 };
    int counts[128] = {0};
    for (uint32_t k = 0; k < KEYS; k++) {
        uint64_t in_group = group_key(sampler_key(2, k, 0), 3);
        int pattern = 0;
        for (uint32_t i = 0; i < 8; i++) {
            uint32_t turned = (slow_shuffle(i, in_group) ^ i) & 7;
            if (i == 0)
                pattern |= (int)(turned >> 2);
            if (i % 4 == 0)
                pattern |= (int)(turned >> 1 & 1) << (1 + i / 4);
            if (i % 2 == 0)
                pattern |= (int)(turned & 1) << (3 + i / 2);
        }
        counts[pattern]++;
    }
    double chi_square = 0, expected = KEYS / 128.0;
    for (int i = 0; i < 128; i++)
        chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
    assert_true(fabs(deviate(chi_square, 127)) < 4);
}

/* ---- Values ---- */

/* One point of many keys, in every coordinate: leading digits, digits beyond those of the net, and last digits. */
static void values_are_uniform_to_the_last_digit(void **state) {
    (void)state;
    enum { KEYS = 30000, BINS = 128 };
    static const int shifts[] = {0, 12, 25, 32, 39, 46};
    for (int d = 0; d < 4; d++) {
        int counts[6][BINS] = {{0}}, low = 0, high = 0;
        for (uint32_t k = 0; k < KEYS; k++) {
            double out[4];
            point(sampler_key(3, 0, k), k % 5, 1, 4, out);
            assert_true(out[d] >= 0 && out[d] < 1);
            uint64_t digits = (uint64_t)(out[d] * 0x1p53);
            for (int i = 0; i < 6; i++)
                counts[i][digits >> (46 - shifts[i]) & (BINS - 1)]++;
            low += out[d] < 0x1p-9;
            high += out[d] >= 1 - 0x1p-9;
        }
        for (int i = 0; i < 6; i++) {
            double chi_square = 0, expected = (double)KEYS / BINS;
            for (int bin = 0; bin < BINS; bin++)
                chi_square += (counts[i][bin] - expected) * (counts[i][bin] - expected) / expected;
            assert_true(fabs(deviate(chi_square, BINS - 1)) < 4);
        }
        double expected = KEYS * 0x1p-9;
        assert_true(fabs(low - expected) < 4 * sqrt(expected) && fabs(high - expected) < 4 * sqrt(expected));
    }
}

/* ---- Independence ---- */

typedef struct pairing {
    uint64_t key[2];
    int group[2], dimension[2];
} pairing;

/* The mean of (2a - 1)(2b - 1) over a sequence's points, 0 in expectation, over many sequences: its mean must be 0
 * within its error, and its scatter that of independent points, or twice that at most: neighbouring points lie in
 * opposite halves of both coordinates. */
static void check_uncorrelated(pairing (*choose)(uint32_t)) {
    enum { SEQUENCES = 1500, POINTS = 64 };
    double sum = 0, squares = 0;
    for (uint32_t k = 0; k < SEQUENCES; k++) {
        pairing p = choose(k);
        double mean = 0;
        for (uint32_t i = 0; i < POINTS; i++) {
            double a[4], b[4];
            point(p.key[0], i, p.group[0], 4, a);
            point(p.key[1], i, p.group[1], 4, b);
            mean += (2 * a[p.dimension[0]] - 1) * (2 * b[p.dimension[1]] - 1) / POINTS;
        }
        sum += mean;
        squares += mean * mean;
    }
    double variance = squares / SEQUENCES, independent = 1.0 / 9 / POINTS;
    assert_true(fabs(sum / SEQUENCES) < 4 * sqrt(variance / SEQUENCES));
    assert_true(variance < 2.2 * independent);
}

static pairing groups(uint32_t k) {
    uint64_t key = sampler_key(4, k, 0);
    return (pairing){{key, key}, {(int)(k % 3), 3}, {(int)(k / 3 % 4), (int)(k / 12 % 4)}};
}

static pairing streams(uint32_t k) {
    return (pairing){{sampler_key(4, k, 0), sampler_key(4, k + 1, 0)}, {0, 0}, {(int)(k % 4), (int)(k / 4 % 4)}};
}

static pairing replicates(uint32_t k) {
    return (pairing){{sampler_key(4, k, 0), sampler_key(4, k, 1)}, {1, 1}, {(int)(k % 4), (int)(k % 4)}};
}

static pairing seeds(uint32_t k) {
    return (pairing){{sampler_key(k, 9, 0), sampler_key(k + 1, 9, 0)}, {0, 1}, {(int)(k % 4), (int)(k % 4)}};
}

static void keys_and_groups_are_uncorrelated(void **state) {
    (void)state;
    check_uncorrelated(groups);
    check_uncorrelated(streams);
    check_uncorrelated(replicates);
    check_uncorrelated(seeds);
}

static int compare(const void *a, const void *b) {
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void keys_differ(void **state) {
    (void)state;
    static uint64_t keys[16 * 64 * 16];
    size_t count = 0;
    for (uint32_t seed = 0; seed < 16; seed++)
        for (uint32_t stream = 0; stream < 64; stream++)
            for (uint32_t replicate = 0; replicate < 16; replicate++)
                keys[count++] = sampler_key(seed, stream, replicate);
    qsort(keys, count, sizeof *keys, compare);
    for (size_t i = 1; i < count; i++)
        assert_true(keys[i] != keys[i - 1]);
}

/* ---- What it is for ---- */

/* The root mean square error, over scramblings, of the mean of a smooth function in `count` coordinates whose integral
 * is 1. */
static double integration_error(int count, uint32_t points) {
    enum { SCRAMBLINGS = 48 };
    double squares = 0;
    for (uint32_t k = 0; k < SCRAMBLINGS; k++) {
        uint64_t key = sampler_key(6, k, 0);
        double sum = 0;
        for (uint32_t i = 0; i < points; i++) {
            double out[4], product = 1;
            point(key, i, 1, count, out);
            for (int d = 0; d < count; d++)
                product *= exp(out[d]) / (exp(1) - 1);
            sum += product;
        }
        squares += (sum / points - 1) * (sum / points - 1);
    }
    return sqrt(squares / SCRAMBLINGS);
}

/* Independent points err by sigma/sqrt(n); these by nearly n^-1.5. */
static void smooth_functions_converge_fast(void **state) {
    (void)state;
    double one = (exp(2) - 1) / 2 / ((exp(1) - 1) * (exp(1) - 1));
    for (int count = 1; count <= 4; count++) {
        double sigma = sqrt(pow(one, count) - 1), coarse = integration_error(count, 64);
        double fine = integration_error(count, 2048);
        static const double gains[4] = {1000, 300, 100, 30};
        assert_true(fine < sigma / sqrt(2048) / gains[count - 1]);
        assert_true(log2(coarse / fine) / 5 > (count < 3 ? 1.3 : 1.1));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_what_the_definition_says), cmocka_unit_test(blocks_of_points_are_nets),
        cmocka_unit_test(every_coordinate_is_stratified),      cmocka_unit_test(coins_are_fair_and_independent),
        cmocka_unit_test(orders_of_points_are_uniform),        cmocka_unit_test(values_are_uniform_to_the_last_digit),
        cmocka_unit_test(keys_and_groups_are_uncorrelated),    cmocka_unit_test(keys_differ),
        cmocka_unit_test(smooth_functions_converge_fast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
