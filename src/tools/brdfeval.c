/* brdfeval: directions in; reflectance, samples and albedo of a lobe out. */
#include <string.h>
#include <unistd.h>

#include "tools/brdfeval/evaluation.h"
#include "tools/brdfeval/grid.h"
#include "tools/brdfeval/records.h"
#include "tools/brdfeval/reflectance_options.h"
#include "tools/brdfeval/table.h"
#include "tools/common/record_header.h"
#include "tools/common/tool.h"

/* Entries of the option table behind those of the reflectance. */
#define EVAL_OPTION_COUNT 11

typedef struct eval_options {
    reflectance_options reflectance;
    const char *query, *formats;
    const char *letters, *grid; /* or null */
    bool angles, header, npy;
    int flush, threads;
} eval_options;

/* --- What is asked ----------------------------------------------------------------------------------------------- */

static graze_status find_query(const char *name, const query **found, const graze_report *report) {
    *found = evaluation_find_query(name);
    return *found
               ? GRAZE_OK
               : report_error(report, NULL, "-q: there is no query '%s'; queries: eval sample pair albedo mean", name);
}

/* -f takes the format of records in and of those out, or one letter for both. */
static graze_status read_formats(const char *formats, record_format *in, record_format *out,
                                 const graze_report *report) {
    size_t length = strlen(formats);
    if (length < 1 || length > 2 || strspn(formats, "afd") != length)
        return report_error(report, NULL, "-f%s: expected one or two letters of a f d", formats);
    *in = (record_format)formats[0];
    *out = (record_format)formats[length - 1];
    return GRAZE_OK;
}

/* Columns of a table need different names. */
static graze_status check_letters(const char *letters, const query *q, bool table, const graze_report *report) {
    size_t length = strlen(letters), known = strspn(letters, q->letters);
    if (known < length)
        return report_error(report, NULL, "-o: -q %s has no field '%c'; its fields: %s", q->name, letters[known],
                            q->letters);
    if (length < 1 || length > LETTERS_MAX)
        return report_error(report, NULL, "-o: expected 1 to %d letters", LETTERS_MAX);
    for (; table && *letters; letters++)
        if (strchr(letters + 1, *letters))
            return report_error(report, NULL, "-o: a table can have the field '%c' only once", *letters);
    return GRAZE_OK;
}

/* Nothing that was asked for is left out without a word. */
static graze_status check_together(const eval_options *o, const query *q, const graze_report *report) {
    if (q->kind == QUERY_MEAN && (o->grid || o->angles))
        return report_error(report, NULL, "-q mean has no directions: %s does not go with it",
                            o->grid ? "--grid" : "--angles");
    if (o->npy && !o->grid)
        return report_error(report, NULL, "--npy is a format of tables: it needs --grid");
    if (o->grid && o->angles)
        return report_error(report, NULL, "--grid has its angles in degrees: leave out --angles");
    if (o->grid && o->header)
        return report_error(report, NULL, "tables have a header of their own: -h does not go with --grid");
    if (o->grid && strspn(o->formats, "a") != strlen(o->formats))
        return report_error(report, NULL, "-f%s does not go with --grid: tables are CSV, or NPY with --npy",
                            o->formats);
    return GRAZE_OK;
}

/* A material that is diffuse alone has values, but no density of samples. */
static graze_status check_lobe(const evaluation *e, const graze_report *report) {
    for (int i = 0; i < e->field_count; i++)
        if (!e->reflectance.has_lobe && e->fields[i]->scaling == SCALING_PLAIN)
            return report_error(report, NULL, "the material reflects nothing specularly: it has no lobe for '%c'",
                                e->fields[i]->letter);
    return GRAZE_OK;
}

static graze_status read_question(evaluation *e, const eval_options *o, const graze_report *report) {
    const char *letters = o->letters;
    graze_status status = find_query(o->query, &e->query, report);
    if (status == GRAZE_OK && !letters)
        letters = e->query->usual;
    if (status == GRAZE_OK)
        status = check_letters(letters, e->query, o->grid != NULL, report);
    if (status == GRAZE_OK)
        status = check_together(o, e->query, report);
    if (status == GRAZE_OK)
        status = reflectance_options_read(&o->reflectance, !o->grid && e->query->kind != QUERY_MEAN, &e->reflectance,
                                          report);
    e->angles = o->angles;
    if (status != GRAZE_OK)
        return status;
    evaluation_set_fields(e, letters);
    return check_lobe(e, report);
}

/* --- Answers ----------------------------------------------------------------------------------------------------- */

static graze_status write_header(const records_job *j, const tool_arguments *arguments, const graze_report *report) {
    record_buffer out = {0};
    const record_header header = {.numbers = j->evaluation->numbers, .format = (char)j->out};
    record_header_append(&out, arguments, &header);
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}

static graze_status answer_records(const eval_options *o, const tool_arguments *arguments, const graze_report *report) {
    evaluation e = {0};
    records_job j = {.evaluation = &e, .flush = o->flush, .threads = o->threads};
    graze_status status = read_formats(o->formats, &j.in, &j.out, report);
    if (status == GRAZE_OK)
        status = read_question(&e, o, report);
    if (status == GRAZE_OK && o->header)
        status = write_header(&j, arguments, report);
    if (status == GRAZE_OK)
        status = e.query->kind == QUERY_MEAN ? records_answer_once(&j, report) : records_answer(&j, report);
    return status;
}

static graze_status answer_grid(const eval_options *o, const graze_report *report) {
    evaluation e = {0};
    grid g;
    const table_job j = {.evaluation = &e,
                         .grid = &g,
                         .format = o->npy ? TABLE_NPY : TABLE_CSV,
                         .flush = o->flush,
                         .threads = o->threads};
    graze_status status = read_question(&e, o, report);
    if (status == GRAZE_OK)
        status = grid_parse(&g, o->grid, e.query, report);
    if (status == GRAZE_OK)
        status = table_write(&j, report);
    return status;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *report) {
    const eval_options *o = user;
    if (arguments->operand_count > 0)
        return report_error(report, NULL, "unexpected word '%s': records come from standard input",
                            arguments->operands[0]);
    return o->grid ? answer_grid(o, report) : answer_records(o, arguments, report);
}

/* --- Options ----------------------------------------------------------------------------------------------------- */

/* -o fcp, and -ofcp as other tools have it. */
static graze_status read_letters(void *target, const char *suffix, int count, const char *const *words, int *used,
                                 const graze_report *report) {
    eval_options *o = target;
    if (!*suffix && count < 1)
        return report_error(report, NULL, "-o: expected the letters of fields");
    o->letters = *suffix ? suffix : words[0];
    *used = *suffix ? 0 : 1;
    return GRAZE_OK;
}

static void print_letters(void *target, FILE *out) {
    const eval_options *o = target;
    const query *q = evaluation_find_query(o->query);
    if (!o->letters && !q)
        return;
    fputs("-o ", out);
    options_print_word(out, o->letters ? o->letters : q->usual);
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("brdfeval");
    eval_options o = {.query = "eval", .formats = "a", .threads = 1};
    option table[REFLECTANCE_OPTION_COUNT + EVAL_OPTION_COUNT];
    const option entries[EVAL_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "Questions and answers", 0, 0, NULL, NULL},
        {"-q", OPTION_TEXT, &o.query, "QUERY", "eval, sample, pair, albedo or mean", 0, 0, NULL, NULL},
        {"-o", OPTION_CUSTOM, &o, "SPEC", "fields: fcpwPW (eval), xyzpw or xyzPW (samples), aA (albedo), m (mean)", 0,
         0, read_letters, print_letters},
        {"--angles", OPTION_FLAG, &o.angles, NULL, "directions are theta and phi in degrees", 0, 0, NULL, NULL},
        {"--grid", OPTION_TEXT, &o.grid, "SPEC", "no records: a table, as in tl=60,pl=180,tv=-89:89:1", 0, 0, NULL,
         NULL},
        {"--npy", OPTION_FLAG, &o.npy, NULL, "the table in NumPy's format, not CSV", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Records", 0, 0, NULL, NULL},
        {"-f", OPTION_SUFFIX, &o.formats, "IO", "formats in and out: a f d", 0, 0, NULL, NULL},
        {"-h", OPTION_FLAG, &o.header, NULL, "header before the answers", 0, 0, NULL, NULL},
        {"-x", OPTION_INTEGER, &o.flush, "N", "write answers at least every N records", 0, 2147483647, NULL, NULL},
        {"-n", OPTION_INTEGER, &o.threads, "N", "threads", 1, 1024, NULL, NULL},
    };
    reflectance_options_begin(&o.reflectance, table);
    memcpy(table + REFLECTANCE_OPTION_COUNT, entries, sizeof entries);
    option_table options = {
        .program = "brdfeval",
        .synopsis = "[options] < records",
        .summary = "Evaluates, samples, integrates and tabulates Ward's reflectance model and its variants.",
        .options = table,
        .count = sizeof table / sizeof *table};
    return tool_main(&options, argc, argv, &report, run, &o);
}
