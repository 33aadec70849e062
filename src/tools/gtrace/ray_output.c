/* The letters of -o, one by one. */
#include "tools/gtrace/ray_output.h"

#include <string.h>

#include "base/number.h"
#include "image/rgbe.h"

typedef enum content {
    NUMBER,  /* one */
    PAIR,    /* two */
    POINT,   /* three: also directions */
    COLOR,   /* as many as -p has */
    NAME,    /* a word */
    LITERAL, /* a word that counts for nothing */
} content;

/* What a letter depends on. */
enum { NOTHING = 0, LIGHT = 1, MIRROR = 2, ERROR = 4, TREE = 8, SHADING = 16, CAST = 32 };

/* Every letter rtrace knows, and e. */
static const struct letter {
    char letter;
    content content;
    int needs;
} letters_known[] = {
    {'o', POINT, NOTHING},
    {'d', POINT, NOTHING},
    {'v', COLOR, LIGHT},
    {'e', COLOR, LIGHT | ERROR},
    {'V', COLOR, LIGHT | TREE},
    {'w', NUMBER, NOTHING},
    {'W', COLOR, SHADING | TREE},
    {'l', NUMBER, CAST | LIGHT | MIRROR},
    {'L', NUMBER, CAST},
    {'c', PAIR, CAST},
    {'p', POINT, CAST},
    {'n', POINT, CAST | SHADING},
    {'N', POINT, CAST},
    {'s', NAME, CAST},
    {'m', NAME, CAST},
    {'M', NAME, CAST},
    {'r', COLOR, LIGHT | MIRROR},
    {'R', NUMBER, SHADING | MIRROR},
    {'x', COLOR, LIGHT | MIRROR},
    {'X', NUMBER, CAST | SHADING},
    {'~', LITERAL, NOTHING},
};

static const struct letter *find_letter(char c) {
    for (size_t i = 0; i < sizeof letters_known / sizeof *letters_known; i++)
        if (letters_known[i].letter == c)
            return &letters_known[i];
    return NULL;
}

static int number_count(const ray_output *o, content what) {
    switch (what) {
    case PAIR:
        return 2;
    case POINT:
        return 3;
    case COLOR:
        return o->color.numbers;
    case LITERAL:
        return 0;
    default:
        return 1;
    }
}

static graze_status take_letter(ray_output *o, char c, const graze_report *report) {
    const struct letter *known = find_letter(c);
    if (!known)
        return report_error(report, NULL, "-o%s: unknown letter '%c'", o->letters, c);
    bool of_tree = o->tree;
    if (of_tree && known->needs & ERROR)
        return report_error(report, NULL, "-o%s: an answer has a standard error, its rays have none", o->letters);
    o->needs_value = o->needs_value || known->needs & LIGHT;
    o->needs_mirror = o->needs_mirror || known->needs & MIRROR;
    o->needs_error = o->needs_error || known->needs & ERROR;
    o->needs_hit = o->needs_hit || known->needs & CAST;
    o->casts_only = o->casts_only && !(known->needs & ~CAST);
    if (of_tree)
        return GRAZE_OK;
    o->answer_count++;
    o->numbers += number_count(o, known->content);
    if (known->needs & TREE)
        o->tree_only_value = c;
    return GRAZE_OK;
}

static graze_status check_four_bytes(const ray_output *o, const graze_report *report) {
    if (strlen(o->letters) != 1 || !strchr("vrx", o->letters[0]))
        return report_error(report, NULL, "-fc, four-byte colors, goes only with -ov, -or or -ox");
    if (o->color.numbers != 3)
        return report_error(report, NULL, "-fc, four-byte colors, does not go with a color of one number");
    return GRAZE_OK;
}

graze_status ray_output_parse(ray_output *o, const char *letters, char format, const output_color_option *color,
                              const graze_report *report) {
    *o = (ray_output){
        .letters = letters, .format = (ray_format)format, .color = output_color_prepare(color), .casts_only = true};
    if (!*letters)
        return report_error(report, NULL, "-o needs letters that say what to print");
    graze_status status = GRAZE_OK;
    for (const char *c = letters; *c && status == GRAZE_OK; c++) {
        if (*c != 't' && *c != 'T') {
            status = take_letter(o, *c, report);
        } else if (o->tree) {
            status = report_error(report, NULL, "-o%s: only one of t and T may be given, once", letters);
        } else {
            o->tree = c + 1;
            o->shadows = *c == 'T';
        }
    }
    if (status == GRAZE_OK && o->tree && o->answer_count == 0 && !*o->tree)
        status = report_error(report, NULL, "-o%s: no letters behind t or T", letters);
    if (o->tree && !*o->tree)
        o->tree = NULL; /* nothing is asked of its rays */
    if (o->tree) {
        /* Shares and contributions of rays are those of light. */
        o->casts_only = false;
        o->tree_only_value = 0;
        if (status == GRAZE_OK && o->needs_error)
            status = report_error(report, NULL, "-o%s: e, the standard error, does not go with t or T", letters);
    }
    return status == GRAZE_OK && format == RAY_COLOR ? check_four_bytes(o, report) : status;
}

static void append_numbers(const ray_output *o, record_buffer *out, const double *values, int count) {
    record_format format = o->format == RAY_FLOAT    ? RECORD_FLOAT
                           : o->format == RAY_DOUBLE ? RECORD_DOUBLE
                                                     : RECORD_ASCII;
    record_append_reals(out, format, 0, values, (size_t)count);
}

static void append_number(const ray_output *o, record_buffer *out, double value) {
    append_numbers(o, out, &value, 1);
}

static void append_vec3(const ray_output *o, record_buffer *out, graze_vec3 v) {
    append_numbers(o, out, (const double[]){v.x, v.y, v.z}, 3);
}

static void append_color(const ray_output *o, record_buffer *out, graze_rgb c,
                         void (*convert)(const output_color *, rgb, double[3])) {
    double numbers[3];
    convert(&o->color, c, numbers);
    append_numbers(o, out, numbers, o->color.numbers);
}

static void append_name(record_buffer *out, const char *name) {
    record_append_text(out, name ? name : "*");
    record_append_text(out, "\t");
}

/* As far away as what contributes most seems to be. */
static double effective_distance(const ray_values *v) {
    double mirrored = rgb_brightness(v->mirrored);
    bool mirrors = mirrored > 0 && mirrored > 0.5 * rgb_brightness(v->value);
    return mirrors ? v->mirrored_distance : v->seen_distance;
}

static void append_letter(const ray_output *o, char letter, record_buffer *out, const ray_values *v) {
    switch (letter) {
    case 'o':
        append_vec3(o, out, v->origin);
        break;
    case 'd':
        append_vec3(o, out, v->direction);
        break;
    case 'v':
        append_color(o, out, v->value, output_color_value);
        break;
    case 'e':
        append_color(o, out, v->standard_error, output_color_error);
        break;
    case 'V':
        append_color(o, out, v->contribution, output_color_value);
        break;
    case 'W':
        append_color(o, out, v->coefficient, output_color_coefficient);
        break;
    case 'r':
        append_color(o, out, v->mirrored, output_color_value);
        break;
    case 'x':
        append_color(o, out, v->unmirrored, output_color_value);
        break;
    case 'w':
        append_number(o, out, v->weight);
        break;
    case 'l':
        append_number(o, out, effective_distance(v));
        break;
    case 'R':
        append_number(o, out, v->mirrored_distance);
        break;
    case 'X':
        append_number(o, out, v->seen_distance);
        break;
    case 'L':
        append_number(o, out, v->hit->distance);
        break;
    case 'c':
        append_numbers(o, out, v->hit->uv, 2);
        break;
    case 'p':
        append_vec3(o, out, v->hit->point);
        break;
    case 'n':
        append_vec3(o, out, v->hit->shading_normal);
        break;
    case 'N':
        append_vec3(o, out, v->hit->normal);
        break;
    case 's':
        append_name(out, v->hit->surface);
        break;
    case 'm':
        append_name(out, v->hit->modifier);
        break;
    case 'M':
        append_name(out, v->hit->material);
        break;
    default:
        record_append_text(out, "~\t");
        break;
    }
}

static void append_pixel(const ray_output *o, record_buffer *out, const ray_values *v) {
    double numbers[3];
    unsigned char rgbe[4];
    char letter = o->letters[0];
    output_color_value(&o->color, letter == 'r' ? v->mirrored : letter == 'x' ? v->unmirrored : v->value, numbers);
    image_rgbe_encode(
        (const float[]){number_to_float(numbers[0]), number_to_float(numbers[1]), number_to_float(numbers[2])}, rgbe);
    record_append_bytes(out, rgbe, sizeof rgbe);
}

void ray_output_append(const ray_output *o, record_buffer *out, const ray_values *v) {
    if (o->format == RAY_COLOR) {
        append_pixel(o, out, v);
        return;
    }
    for (size_t i = 0; i < o->answer_count; i++)
        append_letter(o, o->letters[i], out, v);
    if (o->format == RAY_ASCII && o->answer_count > 0)
        record_append_text(out, "\n");
}

void ray_output_append_value(const ray_output *o, record_buffer *out, graze_rgb value) {
    append_color(o, out, value, output_color_value);
    if (o->format == RAY_ASCII)
        record_append_text(out, "\n");
}

void ray_output_append_tree_ray(const ray_output *o, record_buffer *out, int depth, const ray_values *v) {
    for (int i = 0; i < depth; i++)
        record_append_text(out, "\t");
    for (const char *c = o->tree; *c; c++)
        append_letter(o, *c, out, v);
    if (o->format == RAY_ASCII)
        record_append_text(out, "\n");
}
