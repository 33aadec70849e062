/* Reading options by their table. */
#include "base/options.h"

#include <math.h>
#include <string.h>

#include "base/options_internal.h"

/* The option being read and what it may still take. */
typedef struct reading {
    const option *option;
    const char *rest;         /* of its own word, behind the name */
    const char *const *words; /* behind it */
    int count;
    const graze_report *report;
} reading;

/* Long options have Graze's manners, short ones Radiance's. */
static bool is_long(const option *o) {
    return strncmp(o->name, "--", 2) == 0;
}

/* What stands behind a flag's name: true where it is a switch, and then its position in *on. */
static bool read_switch(const char *rest, bool *on) {
    if (!rest[0] || rest[1])
        return false;
    *on = strchr("+1yYtT", rest[0]) != NULL;
    return *on || strchr("-0nNfF", rest[0]);
}

static bool matches(const option *o, const char *word, const char **rest) {
    if (o->kind == OPTION_HEADING || strncmp(word, o->name, strlen(o->name)) != 0)
        return false;
    *rest = word + strlen(o->name);
    if (**rest == 0 || o->kind == OPTION_SUFFIX)
        return true;
    bool on;
    if (o->kind == OPTION_FLAG && read_switch(*rest, &on))
        return true;
    return is_long(o) ? **rest == '=' : o->kind == OPTION_CUSTOM;
}

static const option *find_option(const option_table *table, const char *word, const char **rest) {
    const option *best = NULL;
    size_t best_length = 0;
    for (int i = 0; i < table->count; i++) {
        const option *o = &table->options[i];
        const char *behind;
        if (matches(o, word, &behind) && (!best || strlen(o->name) > best_length)) {
            best = o;
            best_length = strlen(o->name);
            *rest = behind;
        }
    }
    return best;
}

static graze_status report_missing(const reading *r) {
    return report_error(r->report, NULL, "option '%s' lacks an argument: %s %s", r->option->name, r->option->name,
                        r->option->arguments ? r->option->arguments : "");
}

static bool in_range(const option *o, double value) {
    return (o->low == 0 && o->high == 0) || (value >= o->low && value <= o->high);
}

static graze_status report_range(const reading *r, const char *word) {
    const option *o = r->option;
    char low[NUMBER_TEXT_SIZE], high[NUMBER_TEXT_SIZE];
    if (isfinite(o->low))
        number_print_exact(low, o->low);
    if (isfinite(o->high))
        number_print_exact(high, o->high);
    if (!isfinite(o->high))
        return report_error(r->report, NULL, "option '%s': %s is less than %s", o->name, word, low);
    if (!isfinite(o->low))
        return report_error(r->report, NULL, "option '%s': %s is more than %s", o->name, word, high);
    return report_error(r->report, NULL, "option '%s': %s is not in %s .. %s", o->name, word, low, high);
}

static graze_status read_integer(const reading *r, int *used) {
    int value;
    if (r->count < 1)
        return report_missing(r);
    if (!text_to_integer(r->words[0], &value))
        return report_error(r->report, NULL, "option '%s': '%s' is not an integer", r->option->name, r->words[0]);
    if (!in_range(r->option, value))
        return report_range(r, r->words[0]);
    *(int *)r->option->target = value;
    *used = 1;
    return GRAZE_OK;
}

static graze_status read_reals(const reading *r, int count, int *used) {
    double values[3] = {0};
    for (int i = 0; i < count; i++) {
        if (i >= r->count)
            return report_missing(r);
        if (!text_to_real(r->words[i], &values[i]))
            return report_error(r->report, NULL, "option '%s': '%s' is not a number", r->option->name, r->words[i]);
        if (!in_range(r->option, values[i]))
            return report_range(r, r->words[i]);
    }
    memcpy(r->option->target, values, (size_t)count * sizeof *values);
    *used = count;
    return GRAZE_OK;
}

static graze_status read_text(const reading *r, int *used) {
    if (r->count < 1)
        return report_missing(r);
    *(const char **)r->option->target = r->words[0];
    *used = 1;
    return GRAZE_OK;
}

static graze_status read_flag(const reading *r) {
    bool *target = r->option->target;
    if (*r->rest == 0)
        *target = is_long(r->option) || !*target;
    else if (!read_switch(r->rest + (*r->rest == '='), target))
        return report_error(r->report, NULL, "option '%s': '%s' is neither 1 (on) nor 0 (off)", r->option->name,
                            r->rest + 1);
    return GRAZE_OK;
}

static graze_status read_option(const reading *r, int *used) {
    *used = 0;
    switch (r->option->kind) {
    case OPTION_FLAG:
        return read_flag(r);
    case OPTION_INTEGER:
        return read_integer(r, used);
    case OPTION_REAL:
        return read_reals(r, 1, used);
    case OPTION_REAL3:
        return read_reals(r, 3, used);
    case OPTION_TEXT:
        return read_text(r, used);
    case OPTION_SUFFIX:
        if (r->option->handle)
            return r->option->handle(r->option->target, r->rest, r->count, r->words, used, r->report);
        *(const char **)r->option->target = r->rest;
        return GRAZE_OK;
    case OPTION_CUSTOM:
        return r->option->handle(r->option->target, r->rest, r->count, r->words, used, r->report);
    case OPTION_HEADING:
        break;
    }
    return GRAZE_OK;
}

/* Answers the words that every program knows: sets *printed where `word` is one of them. */
static graze_status answer(const option_table *table, const char *word, bool *printed, const graze_report *report) {
    *printed = true;
    if (strcmp(word, "--help") == 0)
        return options_print_help(table, report);
    if (strcmp(word, "--version") == 0 || strcmp(word, "-version") == 0)
        return options_print_version(table, report);
    if (strcmp(word, "-defaults") == 0 || strcmp(word, "-help") == 0)
        return options_print_defaults(table, report);
    *printed = false;
    return GRAZE_OK;
}

/* Reads the option at word *i and steps behind all that it takes. */
static graze_status read_next(const option_table *table, options_arguments *a, int *i, const graze_report *report) {
    reading r = {.report = report};
    const char *word = a->words[*i];
    r.option = find_option(table, word, &r.rest);
    if (!r.option)
        return report_error(report, NULL, "unknown option '%s' (%s --help lists all)", word, table->program);
    if (r.option->kind != OPTION_FLAG && is_long(r.option) && *r.rest == '=') {
        a->words[*i] = r.rest + 1;
        r.rest = "";
    } else {
        ++*i;
    }
    r.words = a->words + *i;
    r.count = a->count - *i;
    int used;
    graze_status status = read_option(&r, &used);
    *i += status ? 0 : used;
    return status;
}

graze_status options_parse(const option_table *table, options_arguments *a, int *operand_count,
                           const char *const **operands, options_outcome *outcome, const graze_report *report) {
    int i = 0;
    *outcome = OPTIONS_RUN;
    while (i < a->count && a->words[i][0] == '-' && a->words[i][1]) {
        bool printed;
        graze_status status = answer(table, a->words[i], &printed, report);
        if (printed)
            *outcome = OPTIONS_DONE;
        if (printed || status)
            return status;
        if (strcmp(a->words[i], "--") == 0) {
            i++;
            break;
        }
        status = read_next(table, a, &i, report);
        if (status)
            return status;
    }
    *operand_count = a->count - i;
    *operands = i > 0 ? a->words + i : a->words; /* null if there are no words at all */
    return GRAZE_OK;
}
