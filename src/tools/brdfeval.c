/* brdfeval: directions in; reflectance, samples and albedo of a lobe out. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/angle.h"
#include "base/number.h"
#include "base/vector.h"
#include "graze/brdf.h"
#include "tools/common/record_filter.h"
#include "tools/common/record_header.h"
#include "tools/common/tool.h"

/* The most records that go through the pipeline together, and the most letters of -o. */
enum { CHUNK_RECORDS = 256, LETTERS_MAX = 64 };
typedef struct eval_options {
    const char *model, *query, *letters, *formats;
    double alpha_x, alpha_y, specular, diffuse;
    bool angles, header;
    int flush, threads;
} eval_options;

typedef struct job job;

/* What a record holds, and what is answered. */
typedef struct query {
    const char *name;
    int directions, random_numbers;
    int numbers; /* of the answer; 0: as many as -o has letters */
    void (*answer)(const job *, const vec3 *directions, const double *random_numbers, double *numbers);
} query;

struct job {
    const eval_options *options;
    const query *query;
    graze_brdf brdf;
    record_format in, out;
    int fields, numbers; /* of a record in, of one out */
};

/* --- Answers ----------------------------------------------------------------------------------------------------- */

/* A lobe's weights and values are those of specular reflectance 1; below the surface everything is 0. */
static double eval_letter(const job *j, char letter, vec3 l, vec3 v) {
    const eval_options *o = j->options;
    switch (letter) {
    case 'p':
        return graze_brdf_ward_density(&j->brdf, l, v);
    case 'P':
        return graze_brdf_pair_density(&j->brdf, l, v);
    case 'w':
        return o->specular * graze_brdf_ward_weight(&j->brdf, l, v);
    case 'W':
        return o->specular * graze_brdf_pair_weight(&j->brdf, l, v);
    default:
        break;
    }
    if (!(l.z > 0 && v.z > 0))
        return 0;
    double value = o->diffuse / PI + o->specular * graze_brdf_value(&j->brdf, l, v);
    return letter == 'c' ? value * l.z : value;
}

static void answer_eval(const job *j, const vec3 *directions, const double *random_numbers, double *numbers) {
    (void)random_numbers;
    for (const char *letter = j->options->letters; *letter; letter++)
        *numbers++ = eval_letter(j, *letter, directions[0], directions[1]);
}

static void answer_with_sample(const job *j, graze_brdf_sample sample, double *numbers) {
    const double answer[] = {sample.l.x, sample.l.y, sample.l.z, sample.density, j->options->specular * sample.weight};
    memcpy(numbers, answer, sizeof answer);
}

static void answer_sample(const job *j, const vec3 *directions, const double *random_numbers, double *numbers) {
    graze_brdf_sample sample = graze_brdf_sample_ward(&j->brdf, directions[0], random_numbers[0], random_numbers[1]);
    answer_with_sample(j, sample, numbers);
}

static void answer_pair(const job *j, const vec3 *directions, const double *random_numbers, double *numbers) {
    graze_brdf_sample sample =
        graze_brdf_sample_pair(&j->brdf, directions[0], random_numbers[0], random_numbers[1], random_numbers[2]);
    answer_with_sample(j, sample, numbers);
}

static void answer_albedo(const job *j, const vec3 *directions, const double *random_numbers, double *numbers) {
    (void)random_numbers;
    const eval_options *o = j->options;
    numbers[0] = directions[0].z > 0 ? o->diffuse + o->specular * graze_brdf_albedo(&j->brdf, directions[0]) : 0;
}

static const query queries[] = {
    {"eval", 2, 0, 0, answer_eval},
    {"sample", 1, 2, 5, answer_sample},
    {"pair", 1, 3, 5, answer_pair},
    {"albedo", 1, 0, 1, answer_albedo},
};

/* --- Records ----------------------------------------------------------------------------------------------------- */

/* Exact at multiples of 90 degrees. */
static void sine_and_cosine(double degrees, double *sine, double *cosine) {
    int quarters;
    double rest = angle_radians(remquo(degrees, 90, &quarters)), s = sin(rest), c = cos(rest);
    const double sines[] = {s, c, -s, -c};
    *sine = sines[quarters & 3];
    *cosine = sines[(quarters + 1) & 3];
}

static vec3 direction_from_angles(double theta, double phi) {
    double sine, cosine, sine_phi, cosine_phi;
    sine_and_cosine(theta, &sine, &cosine);
    sine_and_cosine(phi, &sine_phi, &cosine_phi);
    return vec3_make(sine * cosine_phi, sine * sine_phi, cosine);
}

/* Lengths that rounding explains are left alone, so that exchanged directions give the same bits. */
static vec3 direction_from_components(const double *c) {
    const double tolerance = 1e-6;
    vec3 direction = {c[0], c[1], c[2]};
    return fabs(vec3_safe_length(direction) - 1) <= tolerance ? direction : vec3_safe_normalize(direction);
}

static int direction_fields(const job *j) {
    return j->options->angles ? 2 : 3;
}

static bool check_record(const void *user, const double *record, char *trouble, size_t trouble_size) {
    const job *j = user;
    for (int i = 0; i < j->query->directions && !j->options->angles; i++)
        if (vec3_max_abs(vec3_make(record[3 * i], record[3 * i + 1], record[3 * i + 2])) == 0) {
            const char *which = i == 0 && j->query->directions == 2 ? "light" : "viewer";
            snprintf(trouble, trouble_size, "the direction to the %s is zero", which);
            return false;
        }
    const double *random_numbers = record + direction_fields(j) * j->query->directions;
    for (int i = 0; i < j->query->random_numbers; i++)
        if (!(random_numbers[i] >= 0 && random_numbers[i] < 1)) {
            char text[NUMBER_TEXT_SIZE];
            number_print_exact(text, random_numbers[i]);
            snprintf(trouble, trouble_size, "%c is %s, but has to be at least 0 and less than 1", "stu"[i], text);
            return false;
        }
    return true;
}

static void answer_record(void *user, const double *record, uint64_t number, record_buffer *output) {
    (void)number;
    const job *j = user;
    vec3 directions[2];
    double numbers[LETTERS_MAX];
    for (int i = 0; i < j->query->directions; i++, record += direction_fields(j))
        directions[i] =
            j->options->angles ? direction_from_angles(record[0], record[1]) : direction_from_components(record);
    j->query->answer(j, directions, record, numbers);
    record_append_reals(output, j->out, 17, numbers, (size_t)j->numbers);
    if (j->out == RECORD_ASCII)
        record_append_text(output, "\n");
}

static graze_status write_header(const job *j, const tool_arguments *arguments, const graze_report *report) {
    record_buffer out = {0};
    record_header_append(&out, arguments, j->numbers, (char)j->out);
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}

static graze_status answer_records(job *j, const tool_arguments *arguments, const graze_report *report) {
    const eval_options *o = j->options;
    record_filter filter = {
        .fields = j->fields, .threads = o->threads, .user = j, .check = check_record, .answer = answer_record};
    filter.chunk_records = o->flush > 0 && o->flush < CHUNK_RECORDS ? o->flush : CHUNK_RECORDS;
    uint64_t count;
    graze_status status = record_reader_open(&filter.reader, STDIN_FILENO, "standard input", j->in, j->fields, report);
    if (status == GRAZE_OK && o->header)
        status = write_header(j, arguments, report);
    if (status == GRAZE_OK)
        status = record_filter_run(&filter, &count, report);
    record_reader_close(filter.reader);
    return status;
}

/* --- Options ----------------------------------------------------------------------------------------------------- */

static const char *const model_names[] = {
    [GRAZE_BRDF_GMD] = "gmd",
    [GRAZE_BRDF_WARD] = "ward",
    [GRAZE_BRDF_WARD_DUER] = "ward-duer",
    [GRAZE_BRDF_WARD_NEUMANN] = "ward-neumann",
};

static graze_status find_model(const char *name, graze_brdf_model *model, const graze_report *report) {
    for (int i = GRAZE_BRDF_GMD; i <= GRAZE_BRDF_WARD_NEUMANN; i++)
        if (strcmp(name, model_names[i]) == 0) {
            *model = (graze_brdf_model)i;
            return GRAZE_OK;
        }
    return report_error(report, NULL, "-m: there is no model '%s'; models: gmd ward ward-duer ward-neumann", name);
}

static graze_status find_query(const char *name, const query **found, const graze_report *report) {
    for (size_t i = 0; i < sizeof queries / sizeof *queries; i++)
        if (strcmp(name, queries[i].name) == 0) {
            *found = &queries[i];
            return GRAZE_OK;
        }
    return report_error(report, NULL, "-q: there is no query '%s'; queries: eval sample pair albedo", name);
}

/* -f takes the format of records in and of those out, or one letter for both. */
static graze_status read_formats(job *j, const graze_report *report) {
    const char *formats = j->options->formats;
    size_t length = strlen(formats);
    if (length < 1 || length > 2 || strspn(formats, "afd") != length)
        return report_error(report, NULL, "-f%s: expected one or two letters of a f d", formats);
    j->in = (record_format)formats[0];
    j->out = (record_format)formats[length - 1];
    return GRAZE_OK;
}

static graze_status check_letters(const job *j, const graze_report *report) {
    const char *letters = j->options->letters;
    size_t length = strlen(letters), known = strspn(letters, "fcpwPW");
    if (known < length)
        return report_error(report, NULL, "-o: there is no field '%c'; fields: f c p w P W", letters[known]);
    if (length < 1 || length > LETTERS_MAX)
        return report_error(report, NULL, "-o: expected 1 to %d letters", LETTERS_MAX);
    return GRAZE_OK;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *report) {
    const eval_options *o = user;
    job j = {.options = o, .brdf = {.alpha_x = o->alpha_x, .alpha_y = o->alpha_y}};
    if (arguments->operand_count > 0)
        return report_error(report, NULL, "unexpected word '%s': records come from standard input",
                            arguments->operands[0]);
    graze_status status = find_model(o->model, &j.brdf.model, report);
    if (status == GRAZE_OK)
        status = find_query(o->query, &j.query, report);
    if (status == GRAZE_OK)
        status = read_formats(&j, report);
    if (status == GRAZE_OK)
        status = check_letters(&j, report);
    if (status != GRAZE_OK)
        return status;
    j.fields = j.query->directions * direction_fields(&j) + j.query->random_numbers;
    j.numbers = j.query->numbers ? j.query->numbers : (int)strlen(o->letters);
    return answer_records(&j, arguments, report);
}

/* -a sets both roughnesses; -defaults shows them as -ax and -ay. */
static graze_status read_roughness(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    eval_options *o = target;
    double alpha;
    if (*suffix)
        return report_error(report, NULL, "unknown option '-a%s'", suffix);
    if (count < 1 || !text_to_real(words[0], &alpha) || alpha < GRAZE_ROUGHNESS_MIN || alpha > GRAZE_ROUGHNESS_MAX)
        return report_error(report, NULL, "-a: expected a roughness from 1e-6 to 10, got '%s'",
                            count < 1 ? "nothing" : words[0]);
    o->alpha_x = o->alpha_y = alpha;
    *used = 1;
    return GRAZE_OK;
}

/* -o fcp, and -ofcp as other tools have it. */
static graze_status read_letters(void *target, const char *suffix, int count, const char *const *words, int *used,
                                 const graze_report *report) {
    const char **letters = target;
    if (!*suffix && count < 1)
        return report_error(report, NULL, "-o: expected letters of f c p w P W");
    *letters = *suffix ? suffix : words[0];
    *used = *suffix ? 0 : 1;
    return GRAZE_OK;
}

static void print_letters(void *target, FILE *out) {
    fprintf(out, "-o %s", *(const char **)target);
}

int main(int argc, char **argv) {
    const double low = GRAZE_ROUGHNESS_MIN, high = GRAZE_ROUGHNESS_MAX;
    graze_report report = options_standard_error_report("brdfeval");
    eval_options o = {.model = model_names[GRAZE_BRDF_GMD],
                      .query = "eval",
                      .letters = "f",
                      .formats = "a",
                      .alpha_x = .1,
                      .alpha_y = .1,
                      .specular = 1,
                      .threads = 1};
    const option table[] = {
        {"", OPTION_HEADING, NULL, NULL, "Reflectance", 0, 0, NULL, NULL},
        {"-m", OPTION_TEXT, &o.model, "MODEL", "gmd, ward, ward-duer or ward-neumann", 0, 0, NULL, NULL},
        {"-a", OPTION_CUSTOM, &o, "A", "roughness along x and y", 0, 0, read_roughness, NULL},
        {"-ax", OPTION_REAL, &o.alpha_x, "A", "roughness along x", low, high, NULL, NULL},
        {"-ay", OPTION_REAL, &o.alpha_y, "A", "roughness along y", low, high, NULL, NULL},
        {"-rs", OPTION_REAL, &o.specular, "R", "specular reflectance", 0, 1, NULL, NULL},
        {"-rd", OPTION_REAL, &o.diffuse, "R", "diffuse reflectance", 0, 1, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Questions and answers", 0, 0, NULL, NULL},
        {"-q", OPTION_TEXT, &o.query, "QUERY", "eval, sample, pair or albedo", 0, 0, NULL, NULL},
        {"-o", OPTION_CUSTOM, &o.letters, "SPEC", "fields that eval prints: letters of f c p w P W", 0, 0, read_letters,
         print_letters},
        {"--angles", OPTION_FLAG, &o.angles, NULL, "directions are theta and phi in degrees", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Records", 0, 0, NULL, NULL},
        {"-f", OPTION_SUFFIX, &o.formats, "IO", "formats in and out: a f d", 0, 0, NULL, NULL},
        {"-h", OPTION_FLAG, &o.header, NULL, "header before the answers", 0, 0, NULL, NULL},
        {"-x", OPTION_INTEGER, &o.flush, "N", "write answers at least every N records", 0, 2147483647, NULL, NULL},
        {"-n", OPTION_INTEGER, &o.threads, "N", "threads", 1, 1024, NULL, NULL},
    };
    option_table options = {.program = "brdfeval",
                            .synopsis = "[options] < records",
                            .summary = "Evaluates, samples and integrates Ward's reflectance model and its variants.",
                            .options = table,
                            .count = sizeof table / sizeof *table};
    return tool_main(&options, argc, argv, &report, run, &o);
}
