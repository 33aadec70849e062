/* Plain tables: columns with names, divided by commas, semicolons, tabs or blanks; comments begin with #. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "fit/table_columns.h"

/* How a table gives directions. */
typedef enum form { FORM_COMPONENTS, FORM_ANGLES, FORM_DIFFERENCE, FORM_PLANE } form;

typedef struct table {
    fit_reader *reader;
    size_t count; /* of columns */
    fit_word *names;
    fit_column *columns;
    fit_word *value_names;
    size_t value_count;
    bool *chosen; /* of the value columns */
    double *values;
    form form;
    bool has[FIT_VALUE];
} table;

static void table_free(table *t) {
    free(t->names);
    free(t->columns);
    free(t->value_names);
    free(t->chosen);
    free(t->values);
}

static bool line_is_empty(const fit_reader *r) {
    return fit_reader_count_words(r) == 0 || r->line.text[0] == '#';
}

/* The separator that a line of names or numbers shows. */
static char separator_of(const fit_word *line) {
    const char *const candidates = ",;\t";
    for (const char *c = candidates; *c; c++)
        if (memchr(line->text, *c, line->length))
            return *c;
    return ' ';
}

static graze_status split_names(table *t, fit_reader *r) {
    t->count = fit_reader_count_words(r);
    t->names = calloc(t->count + 1, sizeof *t->names);
    t->columns = calloc(t->count + 1, sizeof *t->columns);
    t->value_names = calloc(t->count + 1, sizeof *t->value_names);
    t->chosen = calloc(t->count + 1, sizeof *t->chosen);
    t->values = calloc(t->count + 1, sizeof *t->values);
    if (!t->names || !t->columns || !t->value_names || !t->chosen || !t->values)
        return report_out_of_memory(r->report);
    for (size_t i = 0; i < t->count && fit_reader_word(r, &t->names[i]); i++)
        continue;
    return GRAZE_OK;
}

static bool begins_with_number(const fit_reader *r) {
    fit_reader copy = *r;
    fit_word word;
    double number;
    return fit_reader_word(&copy, &word) && fit_word_number(&word, &number);
}

/* The names told take the place of the table's, whose line, if there is one, holds no number at its beginning. */
static graze_status take_told_names(table *t) {
    fit_reader *r = t->reader, names = *r;
    names.line = (fit_word){r->options->columns, strlen(r->options->columns), 1};
    names.at = names.line.text;
    names.separator = separator_of(&names.line);
    graze_status status = split_names(t, &names);
    while (status == GRAZE_OK && fit_reader_line(r)) {
        if (line_is_empty(r))
            continue;
        r->separator = separator_of(&r->line);
        if (begins_with_number(r)) {
            r->next = r->line.text;
            r->where.line--;
        }
        return GRAZE_OK;
    }
    return status;
}

/* The names stand in the first line that is no comment, or in the last comment before it. */
static graze_status take_names(table *t) {
    fit_reader *r = t->reader, comment = *r;
    while (fit_reader_line(r)) {
        if (r->line.length > 0 && r->line.text[0] == '#')
            comment = *r;
        if (line_is_empty(r))
            continue;
        r->separator = separator_of(&r->line);
        if (!begins_with_number(r))
            return split_names(t, r);
        if (comment.line.length == 0)
            break;
        comment.separator = separator_of(&comment.line);
        comment.line.text++;
        comment.line.length--;
        comment.at = comment.line.text;
        r->next = r->line.text;
        r->where.line--;
        return split_names(t, &comment);
    }
    if (line_is_empty(r))
        return report_error(r->report, &(place){.file = r->where.file}, "there is no table in it");
    return report_error(r->report, &(place){.file = r->where.file, .line = r->where.line},
                        "the columns have no names: give them with --columns");
}

/* Whether all columns from `first` to `last` are there. */
static bool has_all(const table *t, fit_column first, fit_column last) {
    for (fit_column c = first; c <= last; c++)
        if (!t->has[c])
            return false;
    return true;
}

static graze_status find_form(table *t) {
    if (has_all(t, FIT_X_IN, FIT_Z_OUT)) {
        t->form = FORM_COMPONENTS;
        return GRAZE_OK;
    }
    if (!t->has[FIT_THETA_IN] || !t->has[FIT_THETA_OUT])
        return report_error(t->reader->report, &(place){.file = t->reader->where.file},
                            "the columns do not tell two directions: expected theta_i and theta_o, with phi_i and "
                            "phi_o, or lx ly lz vx vy vz");
    bool any = t->has[FIT_PHI_IN] || t->has[FIT_PHI_OUT];
    t->form = t->has[FIT_PHI_DIFFERENCE] ? FORM_DIFFERENCE : any ? FORM_ANGLES : FORM_PLANE;
    return GRAZE_OK;
}

static graze_status find_columns(table *t, fit_light *light, fit_unit *unit) {
    for (size_t i = 0; i < t->count; i++) {
        fit_column column = fit_table_column(&t->names[i], light, unit);
        t->columns[i] = column;
        if (column == FIT_VALUE) {
            t->value_names[t->value_count++] = t->names[i];
            continue;
        }
        if (t->has[column])
            return report_error(t->reader->report, &(place){.file = t->reader->where.file},
                                "column '%.*s' tells what an earlier one does", (int)t->names[i].length,
                                t->names[i].text);
        t->has[column] = true;
    }
    return find_form(t);
}

static void settle_conventions(table *t, fit_light light, fit_unit unit) {
    fit_reader *r = t->reader;
    if (t->form == FORM_COMPONENTS)
        fit_reader_set_unit(r, FIT_COMPONENTS, FIT_OF_FILE);
    else
        fit_reader_set_unit(r, unit == FIT_UNIT_ANY ? FIT_DEGREES : unit,
                            unit == FIT_UNIT_ANY ? FIT_ASSUMED : FIT_OF_FILE);
    fit_reader_set_quantity(r, FIT_BRDF, FIT_ASSUMED);
    fit_reader_set_light(r, FIT_LIGHT_INCIDENT, light == FIT_LIGHT_ANY ? FIT_ASSUMED : FIT_OF_FILE);
    fit_reader_set_mirror(r, t->form == FORM_PLANE ? FIT_MIRROR_SAME : FIT_MIRROR_OPPOSITE, FIT_ASSUMED);
    r->source->azimuths_are_zero = t->form == FORM_PLANE;
}

static void directions(const table *t, const double *fields, vec3 *incident, vec3 *outgoing) {
    if (t->form == FORM_COMPONENTS) {
        *incident = vec3_make(fields[FIT_X_IN], fields[FIT_Y_IN], fields[FIT_Z_IN]);
        *outgoing = vec3_make(fields[FIT_X_OUT], fields[FIT_Y_OUT], fields[FIT_Z_OUT]);
        return;
    }
    double phi = fields[FIT_PHI_IN];
    double phi_out = t->form == FORM_DIFFERENCE ? phi + fields[FIT_PHI_DIFFERENCE] : fields[FIT_PHI_OUT];
    *incident = fit_reader_direction(t->reader, fields[FIT_THETA_IN], phi);
    *outgoing = fit_reader_direction(t->reader, fields[FIT_THETA_OUT], phi_out);
}

static graze_status weight_of(const table *t, const double *fields, double *weight) {
    double w = t->has[FIT_WEIGHT] ? fields[FIT_WEIGHT] : 1, sigma = fields[FIT_DEVIATION];
    if (t->has[FIT_DEVIATION])
        w /= sigma * sigma;
    *weight = w;
    if (w > 0 && isfinite(w) && (!t->has[FIT_DEVIATION] || sigma > 0))
        return GRAZE_OK;
    return report_error(t->reader->report, &t->reader->where, "weights and deviations must be positive");
}

static graze_status read_field(fit_reader *r, fit_column column, const char *name, double *value) {
    bool polar = column == FIT_THETA_IN || column == FIT_THETA_OUT;
    bool azimuth = column == FIT_PHI_IN || column == FIT_PHI_OUT || column == FIT_PHI_DIFFERENCE;
    if (r->source->conventions.unit != FIT_COMPONENTS && (polar || azimuth))
        return fit_reader_angle(r, name, polar ? FIT_POLAR : FIT_AZIMUTH, value);
    return fit_reader_number(r, name, value);
}

static graze_status read_row(table *t) {
    fit_reader *r = t->reader;
    double fields[FIT_VALUE] = {0};
    size_t value = 0, wanted = 0;
    for (size_t i = 0; i < t->count; i++) {
        char name[40];
        fit_word word;
        bool is_value = t->columns[i] == FIT_VALUE;
        /* What nobody wants need not be a number. */
        if (is_value && !t->chosen[value++]) {
            if (!fit_reader_word(r, &word))
                break;
            continue;
        }
        double *target = is_value ? &t->values[wanted++] : &fields[t->columns[i]];
        size_t length = t->names[i].length < sizeof name - 1 ? t->names[i].length : sizeof name - 1;
        memcpy(name, t->names[i].text, length);
        name[length] = 0;
        graze_status status = read_field(r, t->columns[i], name, target);
        if (status != GRAZE_OK)
            return status;
    }
    graze_status status = fit_reader_line_end(r);
    vec3 incident, outgoing;
    double weight = 1;
    if (status == GRAZE_OK)
        status = weight_of(t, fields, &weight);
    if (status != GRAZE_OK)
        return status;
    directions(t, fields, &incident, &outgoing);
    return fit_reader_add(r, incident, outgoing, weight, t->values);
}

graze_status fit_read_table(fit_reader *r) {
    table t = {.reader = r};
    fit_light light = FIT_LIGHT_ANY;
    fit_unit unit = FIT_UNIT_ANY;
    graze_status status = r->options->columns ? take_told_names(&t) : take_names(&t);
    if (status == GRAZE_OK)
        status = find_columns(&t, &light, &unit);
    if (status == GRAZE_OK) {
        settle_conventions(&t, light, unit);
        status = fit_reader_channels(r, t.value_names, t.value_count, t.chosen);
    }
    while (status == GRAZE_OK && fit_reader_line(r))
        if (!line_is_empty(r))
            status = read_row(&t);
    table_free(&t);
    return status;
}
