/* Views: options, files, and rays. */
#include "rad/view.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/angle.h"
#include "base/number.h"

static const double tiny = 1e-6;          /* Radiance's slack on limits */
static const double largest = 1e100;      /* of any parameter: products of them stay in a double's range */
static const double smallest_sine = 1e-9; /* between the up vector and the direction, for their plane to be known */

rad_view rad_view_default(void) {
    return (rad_view){.type = 'v', .direction = {0, 1, 0}, .up = {0, 0, 1}, .horizontal = 45, .vertical = 45};
}

/* ---- Options ---- */

static int aim_at_number(double *targets[3], double *number) {
    targets[0] = targets[1] = targets[2] = number;
    return 1;
}

static int aim_at_vector(double *targets[3], vec3 *vector) {
    targets[0] = &vector->x;
    targets[1] = &vector->y;
    targets[2] = &vector->z;
    return 3;
}

/* Where the option's numbers go, and how many they are; 0 where it is none of those with numbers. */
static int option_numbers(rad_view *v, const char *option, double *targets[3]) {
    if (option[0] != '-' || option[1] != 'v' || !option[2] || option[3])
        return 0;
    switch (option[2]) {
    case 'p':
        return aim_at_vector(targets, &v->point);
    case 'd':
        return aim_at_vector(targets, &v->direction);
    case 'u':
        return aim_at_vector(targets, &v->up);
    case 'h':
        return aim_at_number(targets, &v->horizontal);
    case 'v':
        return aim_at_number(targets, &v->vertical);
    case 'o':
        return aim_at_number(targets, &v->fore);
    case 'a':
        return aim_at_number(targets, &v->aft);
    case 's':
        return aim_at_number(targets, &v->shift);
    case 'l':
        return aim_at_number(targets, &v->lift);
    default:
        return 0;
    }
}

graze_status rad_view_option(rad_view *view, int count, const char *const *words, int *used, const place *where,
                             const graze_report *report) {
    *used = 0;
    if (count <= 0)
        return GRAZE_OK;
    const char *option = words[0];
    if (!strncmp(option, "-vt", 3)) {
        if (!option[3] || option[4])
            return report_error(report, where, "option '%.64s': the view's type must be one letter, as in -vtv",
                                option);
        view->type = option[3];
        *used = 1;
        return GRAZE_OK;
    }
    double *targets[3], values[3];
    int needed = option_numbers(view, option, targets);
    if (needed == 0)
        return GRAZE_OK;
    for (int i = 0; i < needed; ++i) {
        if (i + 1 >= count)
            return report_error(report, where, "option '%s': %d number%s missing", option, needed - i,
                                needed - i > 1 ? "s" : "");
        if (!text_to_real(words[i + 1], &values[i]))
            return report_error(report, where, "option '%s': '%.64s' is not a number", option, words[i + 1]);
    }
    for (int i = 0; i < needed; ++i)
        *targets[i] = values[i];
    *used = 1 + needed;
    return GRAZE_OK;
}

/* ---- View files ---- */

static const char blanks[] = " \t\n\r\v\f";

static const char keyword[] = "VIEW=";

/* Whether the line begins with `VIEW=` or the name of a program that takes a view. */
static bool is_view_line(const char *line) {
    static const char *const names[] = {keyword, "rpict", "rvu", "rpiece", "rxpiece", "pinterp", "rview", "gpict"};
    const char *end = line + strcspn(line, blanks);
    const char *name = line;
    for (const char *p = line; p < end; ++p)
        if (*p == '/')
            name = p + 1;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (!strncmp(name, names[i], strlen(names[i])))
            return true;
    return false;
}

/* An option in its longest form: the words of a line, which are not terminated there. */
enum { WORDS_MOST = 4 };
typedef struct option_words {
    char text[WORDS_MOST * 64];
    const char *words[WORDS_MOST];
    const char *ends[WORDS_MOST]; /* in the line */
    int count;
} option_words;

static void copy_words(option_words *w, const char *line) {
    char *out = w->text;
    while (*line && w->count < WORDS_MOST) {
        size_t length = strcspn(line, blanks);
        if (length >= 64)
            return;
        memcpy(out, line, length);
        out[length] = 0;
        w->words[w->count] = out;
        out += length + 1;
        line += length;
        w->ends[w->count++] = line;
        line += strspn(line, blanks);
    }
}

/* What a view line may hold besides good view options. */
typedef enum tolerance { ANYTHING, OTHER_WORDS, NOTHING } tolerance;

/* Applies the view options of the line; gives their number. */
static graze_status read_view_options(rad_view *view, const char *line, tolerance tolerated, int *found,
                                      const place *where, const graze_report *report) {
    const char *p = line;
    *found = 0;
    if (!strncmp(p, keyword, strlen(keyword)))
        p += strlen(keyword);
    else
        p += strcspn(p, blanks);
    for (p += strspn(p, blanks); *p; p += strspn(p, blanks)) {
        option_words w = {.count = 0};
        place here = where ? *where : (place){0};
        here.column = (int)(p - line) + 1;
        copy_words(&w, p);
        int used = 0;
        graze_status status = GRAZE_OK;
        if (*p == '-')
            status = rad_view_option(view, w.count, w.words, &used, &here, tolerated > ANYTHING ? report : NULL);
        if (status != GRAZE_OK && tolerated > ANYTHING)
            return status;
        if (used == 0 && tolerated == NOTHING)
            return report_error(report, &here, "'%.*s' is no view option", (int)strcspn(p, blanks), p);
        p = used > 0 ? w.ends[used - 1] : p + strcspn(p, blanks);
        *found += used > 0;
    }
    return *found == 0 && tolerated == NOTHING ? report_error(report, where, "VIEW= without a view option") : GRAZE_OK;
}

graze_status rad_view_take_line(rad_view *view, const char *line, bool *found, const place *where,
                                const graze_report *report) {
    *found = false;
    if (!is_view_line(line))
        return GRAZE_OK;
    rad_view taken = *view;
    int options;
    tolerance tolerated = strncmp(line, keyword, strlen(keyword)) == 0 ? NOTHING : OTHER_WORDS;
    graze_status status = read_view_options(&taken, line, tolerated, &options, where, report);
    if (status != GRAZE_OK)
        return status;
    *found = options > 0;
    *view = taken;
    return GRAZE_OK;
}

/* The same for a line of a header, which may hold anything. */
static bool read_header_line(rad_view *view, const char *line) {
    int options = 0;
    if (is_view_line(line))
        (void)read_view_options(view, line, ANYTHING, &options, NULL, NULL);
    return options > 0;
}

/* A header's next line, without its end; false at the header's or the file's end. */
static bool next_line(FILE *file, char **line, size_t *capacity) {
    ssize_t length = getline(line, capacity, file);
    if (length <= 0)
        return false;
    if ((*line)[length - 1] == '\n')
        (*line)[--length] = 0;
    if (length > 0 && (*line)[length - 1] == '\r')
        (*line)[--length] = 0;
    return length > 0;
}

graze_status rad_view_read(rad_view *view, const char *file, const graze_report *report) {
    bool is_standard_input = !strcmp(file, "-");
    FILE *in = is_standard_input ? stdin : fopen(file, "r");
    if (!in)
        return report_file_error(report, NULL, "cannot open view file %s", file);
    char *line = NULL;
    size_t capacity = 0;
    bool found = false;
    while (next_line(in, &line, &capacity))
        found = read_header_line(view, line) || found;
    graze_status status = GRAZE_OK;
    if (ferror(in))
        status = report_file_error(report, NULL, "cannot read view file %s", file);
    else if (!found)
        status = report_error(report, NULL, "no view in %s", file);
    free(line);
    if (!is_standard_input)
        fclose(in);
    return status;
}

/* ---- From parameters to rays ---- */

/* All of a view's numbers, in the order in which it is printed. */
enum { NUMBERS = 15 };

static void list_numbers(const rad_view *v, double numbers[NUMBERS]) {
    const double list[NUMBERS] = {v->point.x,     v->point.y, v->point.z, v->direction.x, v->direction.y,
                                  v->direction.z, v->up.x,    v->up.y,    v->up.z,        v->horizontal,
                                  v->vertical,    v->fore,    v->aft,     v->shift,       v->lift};
    memcpy(numbers, list, sizeof list);
}

static bool is_in_range(const rad_view *v) {
    double numbers[NUMBERS];
    list_numbers(v, numbers);
    for (int i = 0; i < NUMBERS; ++i)
        if (!(fabs(numbers[i]) <= largest))
            return false;
    return true;
}

/* The picture's extents at distance 1 from the eye (of parallel views, in the scene; of angular ones, in radians).
 * Null, or what is wrong. */
static const char *picture_size(const rad_view *v, double *right, double *above) {
    static const char bad_horizontal[] = "illegal horizontal view size", bad_vertical[] = "illegal vertical view size";
    double half_right = angle_radians(v->horizontal / 2), half_above = angle_radians(v->vertical / 2);
    double most_right, most_above;
    switch (v->type) {
    case 'l':
        most_right = most_above = largest;
        *right = v->horizontal;
        *above = v->vertical;
        break;
    case 'v':
        most_right = most_above = 180 - 2 * tiny;
        *right = 2 * tan(half_right);
        *above = 2 * tan(half_above);
        break;
    case 'c':
        most_right = 360 + tiny;
        most_above = 180 - 2 * tiny;
        *right = 2 * half_right;
        *above = 2 * tan(half_above);
        break;
    case 'a':
        most_right = most_above = 360 + tiny;
        *right = 2 * half_right;
        *above = 2 * half_above;
        break;
    case 'h':
        most_right = most_above = 180 + tiny;
        *right = 2 * sin(half_right);
        *above = 2 * sin(half_above);
        break;
    case 's':
        most_right = most_above = 360 - 2 * tiny;
        *right = 2 * tan(half_right / 2);
        *above = 2 * tan(half_above / 2);
        break;
    default:
        return "unknown view type";
    }
    if (v->horizontal <= tiny || v->horizontal > most_right)
        return bad_horizontal;
    return v->vertical <= tiny || v->vertical > most_above ? bad_vertical : NULL;
}

static const char *prepare(rad_view *v) {
    if (!is_in_range(v))
        return "view parameter out of range";
    if (v->fore < -tiny || v->aft < -tiny || (v->aft > tiny && v->aft <= v->fore))
        return "illegal fore/aft clipping plane";
    if (vec3_max_abs(v->direction) == 0)
        return "zero view direction";
    v->axis = vec3_safe_normalize(v->direction);
    if (vec3_max_abs(v->up) == 0)
        return "zero view up vector";
    v->up = vec3_safe_normalize(v->up);
    vec3 right = vec3_cross(v->axis, v->up);
    if (vec3_length(right) < smallest_sine)
        return "view up parallel to view direction";
    right = vec3_normalize(right);
    double right_size, above_size;
    const char *trouble = picture_size(v, &right_size, &above_size);
    if (trouble)
        return trouble;
    bool by_angle = v->type == 'a' || v->type == 's';
    v->above = vec3_scale(by_angle ? 1 : above_size, vec3_cross(right, v->axis));
    v->right = vec3_scale(by_angle || v->type == 'c' ? 1 : right_size, right);
    v->right_squared = right_size * right_size;
    v->above_squared = above_size * above_size;
    return NULL;
}

graze_status rad_view_prepare(rad_view *view, const place *where, const graze_report *report) {
    const char *trouble = prepare(view);
    return trouble ? report_error(report, where, "%s", trouble) : GRAZE_OK;
}

double rad_view_aspect(const rad_view *v) {
    return sqrt(v->above_squared / v->right_squared);
}

static vec3 combine(const rad_view *v, double along, double x, double y) {
    return vec3_add_scaled(vec3_add_scaled(vec3_scale(along, v->axis), x, v->right), y, v->above);
}

/* The direction to (x, y), measured from the picture's centre; its length tells how distances to clipping surfaces
 * stretch. False where there is none. */
static bool direction_at(const rad_view *v, double x, double y, vec3 *direction) {
    double z, square, angle, stretch;
    switch (v->type) {
    case 'l':
        *direction = v->axis;
        return true;
    case 'v':
        *direction = combine(v, 1, x, y);
        return true;
    case 'c':
        angle = angle_radians(x * v->horizontal);
        *direction = combine(v, cos(angle), sin(angle), y);
        return true;
    case 'h':
        square = x * x * v->right_squared + y * y * v->above_squared;
        z = 1 - square;
        *direction = combine(v, sqrt(fmax(z, 0)), x, y);
        return z >= 0;
    case 'a':
        x *= v->horizontal / 180;
        y *= v->vertical / 180;
        square = x * x + y * y;
        angle = PI * sqrt(square);
        stretch = angle > 0 ? PI * sin(angle) / angle : PI;
        *direction = combine(v, cos(angle), stretch * x, stretch * y);
        return square <= 1;
    default: /* 's' */
        x *= sqrt(v->right_squared);
        y *= sqrt(v->above_squared);
        square = x * x + y * y;
        z = (1 - square) / (1 + square);
        *direction = combine(v, z, 2 / (1 + square) * x, 2 / (1 + square) * y);
        return true;
    }
}

bool rad_view_ray(const rad_view *v, double x, double y, vec3 *origin, vec3 *direction, double *limit) {
    x += v->shift - 0.5;
    y += v->lift - 0.5;
    *origin = v->point;
    *limit = 0;
    if (!direction_at(v, x, y, direction))
        return false;
    if (v->type == 'l')
        *origin = vec3_add(*origin, combine(v, 0, x, y));
    *origin = vec3_add_scaled(*origin, v->fore, *direction);
    /* Clipping planes of perspective views and cylinders of panoramas are further away towards the picture's edge. */
    double length = v->type == 'v' || v->type == 'c' ? vec3_length(*direction) : 1;
    *direction = vec3_normalize(*direction);
    if (v->aft > tiny)
        *limit = (v->aft - v->fore) * length;
    return true;
}

/* ---- Pictures ---- */

void rad_view_print(const rad_view *v, char *buffer, size_t size) {
    double numbers[NUMBERS];
    char t[NUMBERS][NUMBER_TEXT_SIZE];
    list_numbers(v, numbers);
    for (int i = 0; i < NUMBERS; ++i)
        number_print(t[i], i < 6 ? 7 : 5, numbers[i]); /* point and direction have more digits */
    snprintf(buffer, size, " -vt%c -vp %s %s %s -vd %s %s %s -vu %s %s %s -vh %s -vv %s -vo %s -va %s -vs %s -vl %s",
             v->type, t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9], t[10], t[11], t[12], t[13], t[14]);
}

void rad_view_fit(const rad_view *view, double *pixel_aspect, int *width, int *height) {
    double aspect = rad_view_aspect(view);
    if (*width <= 0 || *height <= 0)
        return;
    if (*pixel_aspect <= tiny)
        *pixel_aspect = aspect * *width / *height;
    else if (aspect * *width > *pixel_aspect * *height)
        *width = (int)(*height / aspect * *pixel_aspect + 0.5);
    else
        *height = (int)(*width * aspect / *pixel_aspect + 0.5);
    *width = *width > 0 ? *width : 1;
    *height = *height > 0 ? *height : 1;
}
