/* Palettes from tables in sRGB, and from formulas in linear light. */
#include "image/palette.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/angle.h"
#include "image/color.h"

struct image_palette {
    const char *name;
    /* Evenly spaced, or null for a formula. */
    const unsigned char (*stops)[3];
    int stop_count;
    /* What comes out is cut to 0 .. 1 and raised to `gamma`; that is linear light, in Radiance's manner. */
    void (*formula)(double at, double color[3]);
    double gamma;
};

/* Purple, blue, green, brown, red, yellow: as measured on what Radiance's default looks like. */
static const unsigned char radiance_stops[][3] = {
    {120, 3, 141},  {87, 1, 156},   {52, 1, 171},   {3, 8, 184},    {1, 39, 188},   {0, 74, 191},  {0, 107, 193},
    {1, 139, 191},  {3, 161, 181},  {5, 175, 163},  {9, 182, 124},  {24, 180, 91},  {45, 173, 65}, {68, 164, 64},
    {102, 149, 76}, {126, 133, 84}, {146, 115, 88}, {152, 103, 84}, {157, 91, 77},  {161, 75, 69}, {163, 61, 60},
    {166, 46, 50},  {169, 32, 41},  {174, 20, 32},  {192, 7, 23},   {210, 6, 14},   {224, 20, 7},  {237, 70, 2},
    {247, 112, 0},  {253, 146, 0},  {255, 189, 13}, {254, 224, 30}, {253, 251, 44},
};
static const unsigned char turbo_stops[][3] = {
    {45, 10, 56},   {54, 37, 115},  {62, 62, 163},  {66, 85, 200},  {69, 107, 228}, {68, 128, 246}, {64, 149, 254},
    {51, 169, 249}, {36, 188, 236}, {23, 205, 217}, {16, 221, 196}, {24, 232, 177}, {46, 242, 153}, {74, 249, 128},
    {108, 253, 99}, {138, 254, 75}, {165, 252, 57}, {185, 246, 49}, {204, 237, 48}, {222, 224, 51}, {236, 210, 55},
    {248, 193, 55}, {253, 175, 49}, {253, 153, 40}, {251, 128, 28}, {244, 102, 15}, {236, 82, 6},   {224, 62, 2},
    {210, 44, 1},   {195, 30, 0},   {174, 16, 0},   {149, 4, 0},    {123, 0, 0},
};
static const unsigned char viridis_stops[][3] = {
    {68, 1, 84},    {72, 40, 120},  {62, 73, 137},  {49, 104, 142}, {38, 130, 142},
    {31, 158, 137}, {53, 183, 121}, {110, 206, 88}, {181, 222, 43}, {253, 231, 37},
};
static const unsigned char gray_stops[][3] = {{0, 0, 0}, {255, 255, 255}};
/* Equal lightness in Oklab at equal distance from the middle, hues 258 and 45 degrees. */
static const unsigned char diverging_stops[][3] = {
    {1, 62, 139},    {1, 81, 178},    {33, 105, 204},  {63, 129, 224},  {96, 153, 239},  {130, 178, 247},
    {167, 201, 251}, {205, 223, 249}, {243, 243, 243}, {246, 214, 200}, {244, 183, 156}, {236, 152, 114},
    {223, 122, 73},  {205, 92, 30},   {176, 72, 3},    {143, 57, 0},    {111, 42, 1},
};

/* Blue, green, yellow, red, pink. */
static const unsigned char vivid_stops[][3] = {
    {80, 110, 255}, {0, 200, 255}, {0, 220, 90}, {255, 235, 0}, {255, 140, 0}, {255, 40, 40}, {255, 90, 220},
};

/* Blue to green, up to 3/8, to red. */
static void spectral(double at, double color[3]) {
    static const double green = 0.375;
    color[0] = (at - green) / (1 - green);
    color[1] = at < green ? at / green : (1 - at) / (1 - green);
    color[2] = 1 - at / green;
}

/* gnuplot's 7, 5, 15. */
static void traditional(double at, double color[3]) {
    color[0] = sqrt(at);
    color[1] = at * at * at;
    color[2] = sin(2 * PI * at);
}

static void hot(double at, double color[3]) {
    for (int c = 0; c < 3; c++)
        color[c] = 3 * at - c;
}

static void blue_red_yellow(double at, double color[3]) {
    color[0] = 2 * at;
    color[1] = 2 * at - 1;
    color[2] = 1 - 2 * at;
}

#define TABLE(stops) stops, sizeof(stops) / sizeof *(stops), NULL, 1
#define FORMULA      NULL, 0
static const image_palette palettes[] = {
    {"def", TABLE(radiance_stops)},         {"spec", FORMULA, spectral, 1},
    {"pm3d", FORMULA, traditional, 2.2},    {"hot", FORMULA, hot, 2.2},
    {"eco", FORMULA, blue_red_yellow, 2.2}, {"tbo", TABLE(turbo_stops)},
    {"viridis", TABLE(viridis_stops)},      {"gray", TABLE(gray_stops)},
    {"diverging", TABLE(diverging_stops)},  {"vivid", TABLE(vivid_stops)},
};
enum { PALETTE_COUNT = sizeof palettes / sizeof *palettes };

const image_palette *image_palette_find(const char *name) {
    for (int i = 0; i < PALETTE_COUNT; i++)
        if (!strcmp(palettes[i].name, name))
            return &palettes[i];
    return NULL;
}

const image_palette *image_palette_at(int i) {
    return i < PALETTE_COUNT ? &palettes[i] : NULL;
}

const char *image_palette_name(const image_palette *palette) {
    return palette->name;
}

void image_palette_list(char *text, size_t size) {
    size_t length = 0;
    for (int i = 0; i < PALETTE_COUNT && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", palettes[i].name);
}

static void color_of_table(const image_palette *palette, double at, unsigned char color[3]) {
    double position = at * (palette->stop_count - 1);
    int stop = position < palette->stop_count - 1 ? (int)position : palette->stop_count - 2;
    const unsigned char *below = palette->stops[stop], *above = palette->stops[stop + 1];
    for (int c = 0; c < 3; c++)
        color[c] = (unsigned char)(below[c] + (position - stop) * (above[c] - below[c]) + 0.5);
}

static void color_of_formula(const image_palette *palette, double at, unsigned char color[3]) {
    double values[3];
    palette->formula(at, values);
    for (int c = 0; c < 3; c++) {
        double linear = pow(fmin(fmax(values[c], 0), 1), palette->gamma);
        color[c] = (unsigned char)(255 * image_srgb_encode(linear) + 0.5);
    }
}

void image_palette_color(const image_palette *palette, double at, unsigned char color[3]) {
    at = at > 0 ? fmin(at, 1) : 0;
    if (palette->stops)
        color_of_table(palette, at, color);
    else
        color_of_formula(palette, at, color);
}
