/* Reading the description of a grid. */
#include "tools/brdfeval/grid.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "base/report.h"
#include "base/text.h"
#include "tools/brdfeval/validate.h"

/* More points would not be counted exactly in a double. */
#define COUNT_MAX 9007199254740992.0

/* Inputs as SPEC and as tables name them, for two directions; a query with one has no light. */
static const struct {
    const char *brief, *column;
} inputs[] = {
    {"tl", "theta_l"}, {"pl", "phi_l"}, {"tv", "theta_v"}, {"pv", "phi_v"}, {"s", "s"}, {"t", "t"}, {"u", "u"},
};
enum { LIGHT_INPUTS = 2, ANGLE_INPUTS = 4 };

/* One assignment, from `word` to `end`; what is left of it begins at `next`. */
typedef struct reading {
    const char *spec, *word, *end, *next;
    int first_input; /* of the query, in inputs */
    grid *grid;
    const graze_report *report;
} reading;

double grid_axis_value(const grid_axis *a, uint64_t index) {
    double i = (double)index, last = (double)(a->count - 1);
    bool is_last = index > 0 && index + 1 == a->count;
    switch (a->kind) {
    case AXIS_MIDPOINTS:
        return (i + .5) / (double)a->count;
    case AXIS_STEPS:
        return is_last && a->meets ? a->to : (a->from + i * a->step) / a->scale;
    case AXIS_ENDS:
        break;
    }
    if (index == 0)
        return a->from;
    /* Symmetric, as a grid from -x to x should be. */
    return is_last ? a->to : (a->from * (last - i) + a->to * i) / last;
}

static graze_status complain(const reading *r, const char *text) {
    return report_error(r->report, NULL, "--grid: '%.*s' at character %d: %s", (int)(r->end - r->word), r->word,
                        (int)(r->word - r->spec) + 1, text);
}

static graze_status complain_of_form(const reading *r) {
    return complain(r, r->first_input + r->grid->input_count > ANGLE_INPUTS
                           ? "expected NAME=VALUE, NAME=FROM:TO:STEP, NAME=FROM:TO/COUNT, or NAME=/COUNT for s t u"
                           : "expected NAME=VALUE, NAME=FROM:TO:STEP or NAME=FROM:TO/COUNT");
}

static graze_status complain_of_name(const reading *r) {
    char text[128];
    int length = snprintf(text, sizeof text, "there is no such input; inputs:");
    for (int i = 0; i < r->grid->input_count; i++)
        length += snprintf(text + length, sizeof text - (size_t)length, " %s", inputs[r->first_input + i].brief);
    return complain(r, text);
}

static bool read_number(reading *r, double *value) {
    const char *next = number_scan(r->next, r->end, value);
    r->next = next ? next : r->next;
    return next && isfinite(*value);
}

static bool read_character(reading *r, char c) {
    bool found = r->next < r->end && *r->next == c;
    r->next += found;
    return found;
}

static graze_status read_name(reading *r, grid_axis *axis) {
    const char *sign = memchr(r->word, '=', (size_t)(r->end - r->word));
    if (!sign)
        return complain_of_form(r);
    const grid *g = r->grid;
    for (axis->input = 0; axis->input < g->input_count; axis->input++) {
        const char *brief = inputs[r->first_input + axis->input].brief;
        if (strlen(brief) == (size_t)(sign - r->word) && memcmp(brief, r->word, strlen(brief)) == 0)
            break;
    }
    if (axis->input == g->input_count)
        return complain_of_name(r);
    for (int i = 0; i < g->axis_count; i++)
        if (g->axes[i].input == axis->input)
            return complain(r, "this input has values already");
    r->next = sign + 1;
    return GRAZE_OK;
}

static bool is_random_number(const reading *r, const grid_axis *axis) {
    return r->first_input + axis->input >= ANGLE_INPUTS;
}

static graze_status read_count(reading *r, grid_axis *axis) {
    double count;
    if (!read_number(r, &count) || r->next != r->end || !(count >= 1 && count <= COUNT_MAX) || count != floor(count))
        return complain(r, "COUNT has to be a whole number, at least 1");
    axis->count = (uint64_t)count;
    return GRAZE_OK;
}

static graze_status read_ends(reading *r, grid_axis *axis) {
    axis->kind = AXIS_ENDS;
    graze_status status = read_count(r, axis);
    if (status == GRAZE_OK && axis->count == 1 && axis->from != axis->to)
        status = complain(r, "a single value cannot be at both ends");
    return status;
}

/* Where FROM and STEP are decimals, values are the doubles nearest to decimals, too: .3, not 3 x .1 =
 * .30000000000000004. */
static void scale_decimals(grid_axis *axis) {
    for (int64_t power = 1; power <= 1000000000000; power *= 10) {
        double scale = (double)power;
        double from = round(axis->from * scale), step = round(axis->step * scale);
        double last = from + step * (double)(axis->count - 1);
        if (from / scale != axis->from || step / scale != axis->step || !(fabs(from) + fabs(last) < COUNT_MAX))
            continue;
        axis->from = from;
        axis->step = step;
        axis->scale = scale;
        return;
    }
}

/* An end that the steps meet but for rounding errors belongs to the values, as it is given. */
static graze_status read_steps(reading *r, grid_axis *axis) {
    if (!read_number(r, &axis->step) || r->next != r->end)
        return complain_of_form(r);
    double steps = (axis->to - axis->from) / axis->step, whole = round(steps);
    if (!(steps >= 0))
        return complain(r, "these steps do not lead from FROM to TO");
    if (!(steps < COUNT_MAX))
        return complain(r, "too many steps");
    double rounding = 1e-15 * ((fabs(axis->from) + fabs(axis->to)) / fabs(axis->step) + steps);
    axis->meets = fabs(steps - whole) <= rounding;
    axis->count = (uint64_t)(axis->meets ? whole : floor(steps)) + 1;
    scale_decimals(axis);
    return GRAZE_OK;
}

static graze_status read_values(reading *r, grid_axis *axis) {
    axis->kind = AXIS_STEPS;
    axis->count = 1;
    axis->scale = 1;
    if (is_random_number(r, axis) && read_character(r, '/')) {
        axis->kind = AXIS_MIDPOINTS;
        return read_count(r, axis);
    }
    if (!read_number(r, &axis->from))
        return complain_of_form(r);
    if (r->next == r->end)
        return GRAZE_OK;
    if (!read_character(r, ':') || !read_number(r, &axis->to))
        return complain_of_form(r);
    if (read_character(r, '/'))
        return read_ends(r, axis);
    return read_character(r, ':') ? read_steps(r, axis) : complain_of_form(r);
}

static graze_status check_range(const reading *r, const grid_axis *axis) {
    double first = grid_axis_value(axis, 0), last = grid_axis_value(axis, axis->count - 1);
    if (is_random_number(r, axis)) {
        if (!(fmin(first, last) >= 0 && fmax(first, last) < 1))
            return complain(r, "random numbers have to be at least 0 and less than 1");
    } else if (!(fabs(first) <= VALIDATE_ANGLE_MAX && fabs(last) <= VALIDATE_ANGLE_MAX)) {
        return complain(r, "angles have to be between -360 and 360 degrees");
    }
    return GRAZE_OK;
}

/* A table's bytes, eight a number, have to be countable. */
static graze_status count_points(reading *r, const grid_axis *axis) {
    if (r->grid->points > INT64_MAX / (sizeof(double) * (INPUTS_MAX + NUMBERS_MAX)) / axis->count)
        return complain(r, "too many points");
    r->grid->points *= axis->count;
    return GRAZE_OK;
}

static graze_status read_assignment(reading *r) {
    grid_axis *axis = &r->grid->axes[r->grid->axis_count];
    *axis = (grid_axis){0};
    graze_status status = read_name(r, axis);
    if (status == GRAZE_OK)
        status = read_values(r, axis);
    if (status == GRAZE_OK)
        status = check_range(r, axis);
    if (status == GRAZE_OK)
        status = count_points(r, axis);
    r->grid->axis_count++;
    return status;
}

static bool separates(char c) {
    return c == ',' || text_is_blank(c);
}

graze_status grid_parse(grid *g, const char *spec, const query *q, const graze_report *report) {
    reading r = {.spec = spec, .end = spec, .next = spec, .grid = g, .report = report};
    *g = (grid){.input_count = 2 * q->directions + q->random_numbers, .points = 1};
    r.first_input = q->directions == 2 ? 0 : LIGHT_INPUTS;
    for (int i = 0; i < g->input_count; i++)
        g->names[i] = inputs[r.first_input + i].column;
    for (;;) {
        r.word = r.end;
        while (separates(*r.word))
            r.word++;
        for (r.end = r.word; *r.end && !separates(*r.end); r.end++)
            ;
        if (r.word == r.end)
            break;
        graze_status status = read_assignment(&r);
        if (status != GRAZE_OK)
            return status;
    }
    return g->axis_count ? GRAZE_OK : report_error(report, NULL, "--grid: '%s' names no values", spec);
}
