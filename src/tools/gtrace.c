/* gtrace: rays in, radiance with its standard error out, in rtrace's manners. */
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/vector.h"
#include "tools/common/record_filter.h"
#include "tools/common/record_header.h"
#include "tools/common/render_options.h"
#include "tools/common/tool.h"
#include "tools/gtrace/answer.h"
#include "tools/gtrace/features.h"

#define RAY_FIELDS 6
#define CHUNK_RAYS 2048
/* Entries of the option table that are gtrace's own. */
#define GTRACE_OPTION_COUNT 13

typedef struct gtrace_options {
    render_options render;
    bool sensor, header, limit_distance;
    int columns, rows; /* -x, -y */
    const char *formats, *letters;
    modifier_list tree_modifiers;
} gtrace_options;

typedef struct job {
    const gtrace_options *options;
    answering answering;
    record_format input;
    atomic_ullong unconverged;
} job;

/* -f with letters behind it takes formats; alone, a file of definitions. */
static graze_status take_formats(void *target, const char *suffix, int count, const char *const *words, int *used,
                                 const graze_report *report) {
    gtrace_options *o = target;
    if (!*suffix)
        return definition_list_take_file(&o->render.definitions, suffix, count, words, used, report);
    o->formats = suffix;
    return GRAZE_OK;
}

static graze_status refuse_features(void *target, const char *suffix, int count, const char *const *words, int *used,
                                    const graze_report *report) {
    (void)target, (void)suffix, (void)count, (void)words, (void)used;
    return report_error(report, NULL, "option '-features' must come first");
}

static void print_formats(void *target, FILE *out) {
    fprintf(out, "-f%s", ((const gtrace_options *)target)->formats);
}

static size_t answer_rays(void *user, const record_numbers *rays, int worker, record_buffer *out, char *message) {
    job *j = user;
    (void)worker;
    (void)message;
    for (size_t i = 0; i < rays->count; i++) {
        const double *record = rays->doubles + i * RAY_FIELDS;
        graze_ray ray = {.origin = {record[0], record[1], record[2]}, .direction = {record[3], record[4], record[5]}};
        if (j->options->limit_distance)
            ray.limit = vec3_safe_length(ray.direction);
        ray.direction = vec3_safe_normalize(ray.direction);
        if (!answer_ray(&j->answering, &ray, rays->first + i, out))
            atomic_fetch_add(&j->unconverged, 1);
    }
    return rays->count;
}

static graze_status write_header(const job *j, const tool_arguments *arguments, const graze_report *report) {
    const gtrace_options *o = j->options;
    const ray_output *output = &j->answering.output;
    const record_header header = {.numbers = output->tree ? 0 : output->numbers,
                                  .format = (char)output->format,
                                  .xyz = output->color.space == OUTPUT_XYZ,
                                  .primaries = output->color.primaries};
    record_buffer out = {0};
    if (o->header)
        record_header_append(&out, arguments, &header);
    if (o->columns > 0 && o->rows > 0) {
        char line[64];
        snprintf(line, sizeof line, "-Y %d +X %d\n", o->rows, o->columns);
        record_append_text(&out, line);
    }
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}

/* -f takes the format of rays and that of answers, or one letter for both. */
static graze_status read_formats(const char *formats, record_format *in, char *out, const graze_report *report) {
    size_t length = strlen(formats);
    if (length < 1 || length > 2 || !strchr("afd", formats[0]) || !strchr("afdc", formats[length - 1]))
        return report_error(report, NULL, "-f%s: expected one of a f d for rays, then one of a f d c for answers",
                            formats);
    *in = (record_format)formats[0];
    *out = formats[length - 1];
    return GRAZE_OK;
}

/* Settings as the options say; a tree's paths are counted, not judged by their error. */
static graze_status prepare_settings(job *j, const graze_report *report) {
    render_options render = j->options->render;
    answering *a = &j->answering;
    a->tree_modifiers = &j->options->tree_modifiers;
    a->tree_paths = render.samples > 0 ? (uint32_t)render.samples : 1;
    if (a->output.tree)
        render.samples = 0;
    return render_options_settings(&render, j->options->sensor, &a->settings, report);
}

/* Letters that the settings asked for leave nothing to say. */
static graze_status check_letters(const job *j, const graze_report *report) {
    const ray_output *output = &j->answering.output;
    bool irradiance = j->answering.settings.quantity != GRAZE_RADIANCE;
    if (j->answering.settings.samples == 1 && strchr(output->letters, 'e'))
        return report_error(report, NULL, "-o%s: one sample has no standard error: --samples must be 2 or more",
                            output->letters);
    if (irradiance && output->casts_only)
        return report_error(report, NULL, "-i and -I need an output that depends on light, such as -ov, not -o%s",
                            output->letters);
    if (output->tree_only_value)
        report_warning(report, NULL, "-o%s: without t or T, V is the value and W is 1", output->letters);
    if (irradiance && output->needs_mirror && strpbrk(output->letters, "rRxX"))
        report_warning(report, NULL, "-o%s: there are no mirrors in the irradiance of -i and -I", output->letters);
    return GRAZE_OK;
}

/* All that can be wrong before the scene is read. */
static graze_status prepare(job *j, const tool_arguments *arguments, const graze_report *report) {
    const gtrace_options *o = j->options;
    char format = 0;
    graze_status status = read_formats(o->formats, &j->input, &format, report);
    if (status == GRAZE_OK)
        status = ray_output_parse(&j->answering.output, o->letters, format, &o->render.color, report);
    if (status == GRAZE_OK)
        status = prepare_settings(j, report);
    if (status == GRAZE_OK)
        status = tool_check_scenes(arguments, true, report);
    return status == GRAZE_OK ? check_letters(j, report) : status;
}

static graze_status answer_input(job *j, const tool_arguments *arguments, const graze_report *report) {
    const gtrace_options *o = j->options;
    record_filter filter = {.fields = RAY_FIELDS,
                            .chunk_records = CHUNK_RAYS,
                            .uneven = true,
                            .threads = o->render.threads,
                            .user = j,
                            .answer = answer_rays};
    uint64_t count = 0;
    if (o->rows > 0)
        filter.wanted = (uint64_t)o->rows * (uint64_t)(o->columns > 1 ? o->columns : 1);
    graze_status status =
        record_reader_open(&filter.reader, STDIN_FILENO, "standard input", j->input, RAY_FIELDS, report);
    if (status == GRAZE_OK)
        status = write_header(j, arguments, report);
    if (status == GRAZE_OK)
        status = record_filter_run(&filter, &count, report);
    unsigned long long unconverged = atomic_load(&j->unconverged);
    if (unconverged)
        report_warning(report, NULL, "%llu of %llu answers reached --max-samples before --error", unconverged,
                       (unsigned long long)count);
    record_reader_close(filter.reader);
    return status;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *full_report) {
    job j = {.options = user};
    const graze_report quiet = tool_report(full_report, j.options->render.warnings), *report = &quiet;
    graze_scene *scene = NULL;
    graze_status status = render_options_begin(&j.options->render, arguments, report);
    if (status == GRAZE_OK)
        status = prepare(&j, arguments, report);
    const graze_scene_settings build = render_options_scene(&j.options->render);
    if (status == GRAZE_OK)
        status = graze_scene_load(&scene, arguments->operands, (size_t)arguments->operand_count, &build, report);
    j.answering.scene = scene;
    if (status == GRAZE_OK)
        status = answer_input(&j, arguments, report);
    graze_scene_destroy(scene);
    return status;
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("gtrace");
    if (argc > 1 && strcmp(argv[1], "-features") == 0)
        return (int)features_answer(argc - 2, argv + 2, &report);
    gtrace_options o = {.render = render_options_default(0.02),
                        .header = true,
                        .formats = "a",
                        .letters = "v",
                        .tree_modifiers = {.letter = 't'}};
    option table[GTRACE_OPTION_COUNT + RENDER_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "Rays and answers", 0, 0, NULL, NULL},
        {"-f", OPTION_SUFFIX, &o, "IO", "formats in and out: a f d, and c out (4-byte colors)", 0, 0, take_formats,
         print_formats},
        {"-o", OPTION_SUFFIX, &o.letters, "SPEC",
         "what to print: letters of v e o d l L p n N s m M w c r R x X V W ~ t T", 0, 0, NULL, NULL},
        {"-te", OPTION_CUSTOM, &o.tree_modifiers, "MODIFIER", "-ot: tell of no rays that meet a surface of it", 0, 0,
         modifier_list_exclude, modifier_list_print},
        {"-tE", OPTION_CUSTOM, &o.tree_modifiers, "FILE", "... of those in the file", 0, 0, modifier_list_exclude_file,
         NULL},
        {"-ti", OPTION_CUSTOM, &o.tree_modifiers, "MODIFIER", "-ot: tell only of rays that meet a surface of it", 0, 0,
         modifier_list_include, NULL},
        {"-tI", OPTION_CUSTOM, &o.tree_modifiers, "FILE", "... of those in the file", 0, 0, modifier_list_include_file,
         NULL},
        {"-h", OPTION_FLAG, &o.header, NULL, "header before the answers", 0, 0, NULL, NULL},
        {"-x", OPTION_INTEGER, &o.columns, "N", "answers in a row of the picture", 0, 2147483647, NULL, NULL},
        {"-y", OPTION_INTEGER, &o.rows, "N", "rows: stop after x times y rays", 0, 2147483647, NULL, NULL},
        {"-I", OPTION_FLAG, &o.sensor, NULL, "irradiance on sensors at the rays' origins, the directions their normals",
         0, 0, NULL, NULL},
        {"-ld", OPTION_FLAG, &o.limit_distance, NULL, "look no farther than the direction's length", 0, 0, NULL, NULL},
        {"-features", OPTION_CUSTOM, NULL, "[NAME[=PART,...]...]", "list or check features; as the first word only", 0,
         0, refuse_features, NULL},
    };
    render_options_table(&o.render, table + GTRACE_OPTION_COUNT);
    option_table options = {.program = "gtrace",
                            .synopsis = "[options] scene... < rays",
                            .summary = "Traces rays through Radiance scenes: radiance with its standard error.",
                            .options = table,
                            .count = GTRACE_OPTION_COUNT + RENDER_OPTION_COUNT};
    int status = tool_main(&options, argc, argv, &report, run, &o);
    modifier_list_free(&o.tree_modifiers);
    render_options_free(&o.render);
    return status;
}
