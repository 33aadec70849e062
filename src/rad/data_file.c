/* Reading data files, and looking values up in them. */
#include "rad/data_file.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "base/number.h"
#include "base/text.h"
#include "base/whole_file.h"

/* So many values a file may promise: more would be larger than any memory. */
#define MOST_VALUES ((size_t)1 << 32)

typedef struct scanner {
    const char *next, *end, *line_start;
    place where; /* of the file, with the place of the word that is being read */
    const graze_report *report;
    arena *memory;
} scanner;

/* Comments go from # to the line's end. */
static void skip_blanks(scanner *s) {
    while (s->next < s->end) {
        if (*s->next == '#')
            while (s->next < s->end && *s->next != '\n')
                s->next++;
        else if (!text_is_blank(*s->next))
            break;
        else if (*s->next++ == '\n') {
            s->where.line++;
            s->line_start = s->next;
        }
    }
    s->where.column = (int)(s->next - s->line_start) + 1;
}

static graze_status read_number(scanner *s, const char *what, double *value) {
    skip_blanks(s);
    if (s->next == s->end)
        return report_error(s->report, &s->where, "the data file ends where %s should be", what);
    const char *end = number_scan(s->next, s->end, value);
    if (!end || (end < s->end && !text_is_blank(*end) && *end != '#'))
        return report_error(s->report, &s->where, "%s should be here, and be a number", what);
    if (!isfinite(*value))
        return report_error(s->report, &s->where, "%s is too large", what);
    s->next = end;
    return GRAZE_OK;
}

static graze_status read_count(scanner *s, const char *what, double least, double most, size_t *count) {
    double value;
    graze_status status = read_number(s, what, &value);
    if (status)
        return status;
    if (!(value >= least && value <= most) || value != floor(value))
        return report_error(s->report, &s->where, "%s must be a whole number from %.0f to %.0f", what, least, most);
    *count = (size_t)value;
    return GRAZE_OK;
}

static graze_status read_places(scanner *s, rad_data_axis *axis) {
    double *places = arena_allocate(s->memory, axis->count * sizeof *places);
    if (!places)
        return report_out_of_memory(s->report);
    for (size_t i = 0; i < axis->count; i++) {
        graze_status status = read_number(s, "a place of the grid", &places[i]);
        if (status)
            return status;
        bool rises = i > 0 && places[i] > places[i - 1];
        if (i > 0 && (places[i] == places[i - 1] || rises != (places[1] > places[0])))
            return report_error(s->report, &s->where,
                                "the places of a dimension must rise, or fall, from each to the next");
    }
    axis->places = places;
    axis->begin = places[0];
    axis->length = places[axis->count - 1] - places[0];
    return GRAZE_OK;
}

static graze_status read_axis(scanner *s, rad_data_axis *axis) {
    double end;
    graze_status status = read_number(s, "the begin of a dimension", &axis->begin);
    if (!status)
        status = read_number(s, "the end of a dimension", &end);
    if (!status)
        status = read_count(s, "the number of places of a dimension", 2, (double)MOST_VALUES, &axis->count);
    if (status)
        return status;
    axis->length = end - axis->begin;
    axis->places = NULL;
    /* Every place is at least one character and a blank. */
    if (axis->length == 0 && axis->count > (size_t)(s->end - s->next))
        return report_error(s->report, &s->where, "the data file has fewer places than that");
    return axis->length == 0 ? read_places(s, axis) : GRAZE_OK;
}

static graze_status read_values(scanner *s, rad_data *data) {
    size_t count = 1;
    for (int d = 0; d < data->dimensions; d++) {
        if (data->axes[d].count > MOST_VALUES / count)
            return report_error(s->report, &s->where, "the data file would have too many values");
        count *= data->axes[d].count;
    }
    if (count > (size_t)(s->end - s->next))
        return report_error(s->report, &s->where, "the data file has fewer values than its %zu places", count);
    float *values = arena_allocate(s->memory, count * sizeof *values);
    if (!values)
        return report_out_of_memory(s->report);
    for (size_t i = 0; i < count; i++) {
        double value;
        graze_status status = read_number(s, "a value", &value);
        if (status)
            return status;
        values[i] = number_to_float(value);
    }
    data->values = values;
    skip_blanks(s);
    if (s->next < s->end)
        report_warning(s->report, &s->where, "what is behind the data file's %zu values is not used", count);
    return GRAZE_OK;
}

graze_status rad_data_parse(rad_data *data, arena *memory, const char *text, size_t length, const char *name,
                            const place *where, const graze_report *report) {
    scanner s = {.next = text,
                 .end = text + length,
                 .line_start = text,
                 .where = {.file = name, .line = 1, .parent = where},
                 .report = report,
                 .memory = memory};
    size_t dimensions = 0;
    graze_status status = read_count(&s, "the number of dimensions", 1, RAD_DATA_DIMENSIONS, &dimensions);
    data->dimensions = (int)dimensions;
    for (int d = 0; d < data->dimensions && !status; d++)
        status = read_axis(&s, &data->axes[d]);
    return status ? status : read_values(&s, data);
}

graze_status rad_data_read(rad_data *data, arena *memory, const char *path, const char *name, const place *where,
                           const graze_report *report) {
    whole_file text;
    graze_status status = whole_file_read_path(&text, path, name, where, report);
    if (!status)
        status = rad_data_parse(data, memory, text.bytes, text.length, name, where, report);
    free(text.bytes);
    return status;
}

/* The step of the grid to interpolate in, and the coordinate in steps from the grid's begin. */
static size_t find_step(const rad_data_axis *axis, double coordinate, double *steps) {
    size_t last = axis->count - 2;
    if (!axis->places) {
        *steps = (coordinate - axis->begin) / axis->length * (double)(axis->count - 1);
        return *steps > 0 ? *steps < (double)last ? (size_t)*steps : last : 0;
    }
    size_t low = 0, high = last + 1; /* the step is in low .. high - 1 */
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        bool beyond = axis->length > 0 ? coordinate >= axis->places[middle] : coordinate < axis->places[middle];
        *(beyond ? &low : &high) = middle;
    }
    *steps = (double)low + (coordinate - axis->places[low]) / (axis->places[low + 1] - axis->places[low]);
    return low;
}

/* The shares of the values at both ends of a step. */
static void find_shares(double steps, double step, double share[2]) {
    if (steps > step + 2) {
        share[0] = 1 / (step - 1 - steps);
        share[1] = -2 * share[0];
    } else if (steps < step - 1) {
        share[1] = 1 / (steps - step);
        share[0] = -2 * share[1];
    } else {
        share[0] = step + 1 - steps;
        share[1] = steps - step;
    }
}

void rad_data_values(const rad_data *grid, const float *const *planes, int count, const double *point, double *values) {
    double shares[RAD_DATA_DIMENSIONS][2];
    size_t offsets[RAD_DATA_DIMENSIONS] = {0}, first = 0, stride = 1;
    for (int d = grid->dimensions; d-- > 0;) {
        double steps;
        size_t step = find_step(&grid->axes[d], point[d], &steps);
        find_shares(steps, (double)step, shares[d]);
        first += step * stride;
        offsets[d] = stride;
        stride *= grid->axes[d].count;
    }
    for (int i = 0; i < count; i++)
        values[i] = 0;
    for (unsigned corner = 0; corner < 1u << grid->dimensions; corner++) {
        double share = 1;
        size_t at = first;
        for (int d = 0; d < grid->dimensions; d++) {
            bool far_end = corner >> d & 1;
            share *= shares[d][far_end];
            at += far_end ? offsets[d] : 0;
        }
        for (int i = 0; i < count && share != 0; i++)
            values[i] += share * (double)planes[i][at];
    }
}
