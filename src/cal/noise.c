/* Gradient noise (K. Perlin, "Improving noise", 2002) with its published permutation, differences of it, and noise by
 * midpoint displacement. */
#include "cal/noise.h"

#include <math.h>
#include <stdint.h>

/* Steps of the differences, and size of the smallest cube of the fractal. */
#define STEP 0.0005
/* Beyond this whole numbers times the cubes of the fractal do not fit. */
#define REACH 1e15

static const uint8_t permutation[256] = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

/* Towards the edges of a cube; four of the twelve come twice. */
static const int8_t gradients[16][3] = {{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                                        {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1},
                                        {1, 1, 0},  {0, -1, 1},  {-1, 1, 0}, {0, -1, -1}};

static unsigned permute(unsigned i) {
    return permutation[i & 255];
}

static double ease(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

static double between(double t, double a, double b) {
    return a + t * (b - a);
}

/* The cell of a lattice of period 256 that x is in, and where in it. */
static unsigned cell_of(double x, double *rest) {
    double lower = floor(x);
    *rest = x - lower;
    return (unsigned)(lower - 256 * floor(lower / 256));
}

static double gradient_noise(double x, double y, double z) {
    double dx, dy, dz, corners[8];
    unsigned i = cell_of(x, &dx), j = cell_of(y, &dy), k = cell_of(z, &dz);
    for (unsigned c = 0; c < 8; c++) {
        unsigned a = c & 1, b = c >> 1 & 1, d = c >> 2;
        const int8_t *g = gradients[permute(permute(permute(i + a) + j + b) + k + d) & 15];
        corners[c] = g[0] * (dx - a) + g[1] * (dy - b) + g[2] * (dz - d);
    }
    double u = ease(dx), v = ease(dy), w = ease(dz);
    return between(w, between(v, between(u, corners[0], corners[1]), between(u, corners[2], corners[3])),
                   between(v, between(u, corners[4], corners[5]), between(u, corners[6], corners[7])));
}

/* A number within [-1, 1] that belongs to a point of whole numbers. */
static double displacement(const int64_t p[3]) {
    uint64_t s = 17 * (uint64_t)p[0] + 23 * (uint64_t)p[1] + 29 * (uint64_t)p[2];
    s ^= s << 13;
    return 1 - (double)((s * (s * s * 15731 + 789221) + 1376312589) & 0x7fffffff) / 1073741824;
}

/* Mean of the corners of a cube that lie where `branch` does on each axis not in `across`. */
static double mean_of_corners(const double values[8], unsigned branch, unsigned across) {
    static const double share[8] = {1, .5, .5, .25, .5, .25, .25, .125};
    double sum = 0;
    for (unsigned j = 0; j < 8; j++)
        if (!((j ^ branch) & ~across & 7))
            sum += values[j];
    return share[across] * sum;
}

/* A cube of side 2000 around the point is halved until nothing is left of it. Corners of the part that the point is in
 * are means of the larger cube's, displaced in proportion to the part's side. Halves of odd sides lose a unit. */
static double fractal_noise(const double point[3]) {
    int64_t side = 2000, at[3], begin[3], p[3];
    double values[8];
    for (int i = 0; i < 3; i++) {
        double x = fmin(fmax(point[i], -REACH), REACH);
        at[i] = (int64_t)((double)side * x);
        begin[i] = side * (int64_t)floor(x);
    }
    for (unsigned j = 0; j < 8; j++) {
        for (int i = 0; i < 3; i++)
            p[i] = begin[i] + (j >> i & 1 ? side : 0);
        values[j] = displacement(p);
    }
    while (side >>= 1) {
        unsigned branch = 0;
        double part[8];
        for (int i = 0; i < 3; i++)
            branch |= (unsigned)(at[i] > begin[i] + side) << i;
        part[branch] = values[branch];
        for (unsigned across = 1; across < 8; across++) {
            for (int i = 0; i < 3; i++)
                p[i] = begin[i] + (across >> i & 1 ? side : branch >> i & 1 ? 2 * side : 0);
            part[branch ^ across] = mean_of_corners(values, branch, across) + (double)side * STEP * displacement(p);
        }
        for (int i = 0; i < 3; i++)
            begin[i] += branch >> i & 1 ? side : 0;
        for (int j = 0; j < 8; j++)
            values[j] = part[j];
    }
    return mean_of_corners(values, 0, 7);
}

static double value_at(const cal_noise_memory *m, cal_noise_kind kind) {
    const double *p = m->point;
    if (kind == CAL_NOISE_VALUE)
        return gradient_noise(p[0], p[1], p[2]);
    double before = gradient_noise(p[0] - (kind == CAL_NOISE_X ? STEP : 0), p[1] - (kind == CAL_NOISE_Y ? STEP : 0),
                                   p[2] - (kind == CAL_NOISE_Z ? STEP : 0));
    return (m->values[CAL_NOISE_VALUE] - before) / STEP;
}

static double remembered(cal_noise_memory *m, cal_noise_kind kind) {
    if (!(m->known >> kind & 1)) {
        m->values[kind] = value_at(m, kind);
        m->known |= 1u << kind;
    }
    return m->values[kind];
}

double cal_noise(cal_noise_kind kind, const double point[3], cal_noise_memory *m) {
    if (!isfinite(point[0]) || !isfinite(point[1]) || !isfinite(point[2]))
        return (double)NAN;
    if (kind == CAL_NOISE_FRACTAL)
        return fractal_noise(point);
    if (!m->known || m->point[0] != point[0] || m->point[1] != point[1] || m->point[2] != point[2]) {
        for (int i = 0; i < 3; i++)
            m->point[i] = point[i];
        m->known = 0;
        remembered(m, CAL_NOISE_VALUE);
    }
    return remembered(m, kind);
}
