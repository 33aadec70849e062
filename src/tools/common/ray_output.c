/* The letters of -o, one by one. */
#include "tools/common/ray_output.h"

#include <string.h>

#include "base/number.h"
#include "image/rgbe.h"

/* Every letter rtrace knows: whether light must be traced for it, and how many numbers it prints (0: a text). */
static const struct letter {
    char letter;
    bool value;
    int numbers;
} letters_known[] = {
    {'o', false, 3}, {'d', false, 3}, {'v', true, 3},  {'e', true, 3}, {'l', true, 1},
    {'L', false, 1}, {'c', false, 2}, {'p', false, 3}, {'n', true, 3}, {'N', false, 3},
    {'s', false, 0}, {'m', false, 0}, {'M', false, 0}, {'w', true, 1}, {'~', false, 0},
};
static const char letters_of_rtrace_only[] = "VWrRxXtT";

static const struct letter *find_letter(char c) {
    for (size_t i = 0; i < sizeof letters_known / sizeof *letters_known; i++)
        if (letters_known[i].letter == c)
            return &letters_known[i];
    return NULL;
}

graze_status ray_output_parse(ray_output *output, const char *letters, char format, const graze_report *report) {
    *output = (ray_output){.letters = letters, .format = (ray_format)format};
    if (!*letters)
        return report_error(report, NULL, "-o needs letters that say what to print");
    for (const char *c = letters; *c; c++) {
        const struct letter *known = find_letter(*c);
        if (!known && strchr(letters_of_rtrace_only, *c))
            return report_error(report, NULL, "-o%s: '%c' is not supported yet", letters, *c);
        if (!known)
            return report_error(report, NULL, "-o%s: unknown letter '%c'", letters, *c);
        output->numbers += known->numbers;
        output->needs_value = output->needs_value || known->value;
    }
    if (format == RAY_COLOR && strcmp(letters, "v") != 0)
        return report_error(report, NULL, "-fc, four-byte colors, goes only with -ov");
    return GRAZE_OK;
}

static void append_numbers(const ray_output *o, record_buffer *out, const double *values, int count) {
    record_format format = o->format == RAY_FLOAT    ? RECORD_FLOAT
                           : o->format == RAY_DOUBLE ? RECORD_DOUBLE
                                                     : RECORD_ASCII;
    record_append_reals(out, format, 0, values, (size_t)count);
}

static void append_vec3(const ray_output *o, record_buffer *out, graze_vec3 v) {
    append_numbers(o, out, (const double[]){v.x, v.y, v.z}, 3);
}

static void append_rgb(const ray_output *o, record_buffer *out, graze_rgb c) {
    append_numbers(o, out, (const double[]){c.r, c.g, c.b}, 3);
}

static void append_name(record_buffer *out, const char *name) {
    record_append_text(out, name ? name : "*");
    record_append_text(out, "\t");
}

static void append_letter(const ray_output *o, char letter, record_buffer *out, const graze_ray *ray,
                          const graze_hit *hit, const graze_answer *answer) {
    switch (letter) {
    case 'o':
        append_vec3(o, out, ray->origin);
        break;
    case 'd':
        append_vec3(o, out, ray->direction);
        break;
    case 'v':
        append_rgb(o, out, answer->value);
        break;
    case 'e':
        append_rgb(o, out, answer->standard_error);
        break;
    case 'l':
    case 'L':
        append_numbers(o, out, &hit->distance, 1);
        break;
    case 'c': /* only meshes have local coordinates */
        append_numbers(o, out, (const double[]){0, 0}, 2);
        break;
    case 'p':
        append_vec3(o, out, hit->point);
        break;
    case 'n':
        append_vec3(o, out, hit->shading_normal);
        break;
    case 'N':
        append_vec3(o, out, hit->normal);
        break;
    case 's':
        append_name(out, hit->surface);
        break;
    case 'm':
        append_name(out, hit->modifier);
        break;
    case 'M':
        append_name(out, hit->material);
        break;
    case 'w': /* of a primary ray */
        append_numbers(o, out, (const double[]){1}, 1);
        break;
    default:
        record_append_text(out, "~\t");
        break;
    }
}

void ray_output_append(const ray_output *o, record_buffer *out, const graze_ray *ray, const graze_hit *hit,
                       const graze_answer *answer) {
    if (o->format == RAY_COLOR) {
        unsigned char rgbe[4];
        image_rgbe_encode((const float[]){(float)answer->value.r, (float)answer->value.g, (float)answer->value.b},
                          rgbe);
        record_append_bytes(out, rgbe, sizeof rgbe);
        return;
    }
    for (const char *c = o->letters; *c; c++)
        append_letter(o, *c, out, ray, hit, answer);
    if (o->format == RAY_ASCII)
        record_append_text(out, "\n");
}
