/* Values in the colours that -p asks for. */
#include "tools/common/output_color.h"

#include <string.h>

/* Radiance's white in scotopic lumens for each watt; photopic and melanopic ones are IMAGE_LUMINOUS_EFFICACY. */
#define SCOTOPIC_EFFICACY 412.0

/* Radiance's spectra of red, green and blue, seen by rods and by melanopsin: measured on rtrace -pS and -pM. */
static const double scotopic[3] = {0.0112917, 0.7089189, 0.2797894};
static const double melanopic[3] = {0.0018311, 0.6002898, 0.3978791};

static const struct name {
    output_space space;
    const char *suffix;
} names[] = {
    {OUTPUT_RGB, "RGB"},    {OUTPUT_PRIMARIES, "c"}, {OUTPUT_XYZ, "XYZ"}, {OUTPUT_PHOTOPIC, "Y"},
    {OUTPUT_SCOTOPIC, "S"}, {OUTPUT_MELANOPIC, "M"}, {OUTPUT_MEAN, "A"},
};
enum { NAME_COUNT = sizeof names / sizeof *names };

static image_primaries to_primaries(const double p[8]) {
    return (image_primaries){{p[0], p[1]}, {p[2], p[3]}, {p[4], p[5]}, {p[6], p[7]}};
}

static graze_status take_primaries(output_color_option *o, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    image_color_matrix unused;
    for (int i = 0; i < 8; i++)
        if (i >= count || !text_to_real(words[i], &o->primaries[i]))
            return report_error(report, NULL, "option '-pc' needs 8 numbers: x and y of red, green, blue and white");
    const image_primaries primaries = to_primaries(o->primaries);
    if (!image_color_to_primaries(&unused, &primaries))
        return report_error(report, NULL, "option '-pc': these primaries span no colors");
    *used = 8;
    return GRAZE_OK;
}

graze_status output_color_take(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    output_color_option *o = target;
    *used = 0;
    for (int i = 0; i < NAME_COUNT; i++)
        if (strcmp(suffix, names[i].suffix) == 0) {
            o->space = names[i].space;
            return o->space == OUTPUT_PRIMARIES ? take_primaries(o, count, words, used, report) : GRAZE_OK;
        }
    return report_error(report, NULL, "unknown option '-p%s'; colors are -pRGB -pXYZ -pY -pS -pM -pA and -pc", suffix);
}

void output_color_print(void *target, FILE *out) {
    const output_color_option *o = target;
    for (int i = 0; i < NAME_COUNT; i++)
        if (o->space == names[i].space)
            fprintf(out, "-p%s", names[i].suffix);
    for (int i = 0; i < 8 && o->space == OUTPUT_PRIMARIES; i++) {
        char number[NUMBER_TEXT_SIZE];
        number_print_exact(number, o->primaries[i]);
        fprintf(out, " %s", number);
    }
}

static void set_row(output_color *c, const double row[3]) {
    c->numbers = 1;
    memcpy(c->rows[0], row, sizeof c->rows[0]);
}

output_color output_color_prepare(const output_color_option *o) {
    static const double xyz[8] = {1, 0, 0, 1, 0, 0, 1 / 3., 1 / 3.}, mean[3] = {1 / 3., 1 / 3., 1 / 3.};
    image_color_matrix matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    output_color c = {.space = o->space, .numbers = 3, .efficacy = 1};
    if (o->space == OUTPUT_PRIMARIES) {
        const image_primaries primaries = to_primaries(o->primaries);
        image_color_to_primaries(&matrix, &primaries);
        c.primaries = o->primaries;
    } else if (o->space == OUTPUT_XYZ) {
        matrix = image_color_to_xyz();
        c.primaries = xyz;
        c.efficacy = IMAGE_LUMINOUS_EFFICACY;
    }
    memcpy(c.rows, matrix.m, sizeof c.rows);
    if (o->space == OUTPUT_PHOTOPIC)
        set_row(&c, image_color_to_xyz().m[1]);
    if (o->space == OUTPUT_SCOTOPIC)
        set_row(&c, scotopic);
    if (o->space == OUTPUT_MELANOPIC)
        set_row(&c, melanopic);
    if (o->space == OUTPUT_MEAN)
        set_row(&c, mean);
    if (o->space == OUTPUT_PHOTOPIC || o->space == OUTPUT_MELANOPIC)
        c.efficacy = IMAGE_LUMINOUS_EFFICACY;
    if (o->space == OUTPUT_SCOTOPIC)
        c.efficacy = SCOTOPIC_EFFICACY;
    return c;
}

static void multiply(const output_color *c, rgb value, double out[3]) {
    for (int i = 0; i < c->numbers; i++)
        out[i] = c->rows[i][0] * value.r + c->rows[i][1] * value.g + c->rows[i][2] * value.b;
}

/* Brings a color that the primaries do not reach towards the gray of its brightness until none of it is negative. */
static void desaturate(double color[3], double gray) {
    double least = fmin(color[0], fmin(color[1], color[2]));
    if (least >= 0)
        return;
    double kept = gray / (gray - least);
    for (int i = 0; i < 3; i++)
        color[i] = fmax(0, gray + kept * (color[i] - gray));
}

void output_color_coefficient(const output_color *c, rgb value, double out[3]) {
    if (c->space == OUTPUT_RGB) {
        out[0] = value.r, out[1] = value.g, out[2] = value.b;
        return;
    }
    multiply(c, value, out);
    if (c->space == OUTPUT_PRIMARIES)
        desaturate(out, rgb_brightness(value));
}

void output_color_value(const output_color *c, rgb value, double out[3]) {
    output_color_coefficient(c, value, out);
    for (int i = 0; i < c->numbers; i++)
        out[i] *= c->efficacy;
}

void output_color_error(const output_color *c, rgb error, double out[3]) {
    output_color sizes = *c;
    for (int i = 0; i < c->numbers; i++)
        for (int j = 0; j < 3; j++)
            sizes.rows[i][j] = fabs(c->rows[i][j]);
    multiply(&sizes, error, out);
    for (int i = 0; i < c->numbers; i++)
        out[i] *= c->efficacy;
}
