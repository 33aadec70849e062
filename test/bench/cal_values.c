/* Evaluates expressions of the function language over records of doubles, as rcalc -id -od does.
 *
 *   cal_values [-s] [-v] [-t THREADS] [-f FILE.cal] [-e DEFINITIONS] [-a REAL]... [-c CHANNELS] EXPRESSION... <records
 *
 * A record is CHANNELS (1) doubles. -s defines what scenes have; the expressions are read in the context of the file.
 * -v prints the seconds that the evaluation took to standard error.
 * What cannot be answered ends the program with a message; faults give 0. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/parallel.h"
#include "base/whole_file.h"
#include "cal/compile.h"

enum { MOST = 64 };

typedef struct work {
    const cal_code *code;
    const double *records;
    double *values;
    size_t count, channels, outputs, pieces;
    const char *failure;
} work;

static void complain(void *user, graze_severity severity, const char *text) {
    (void)user;
    fprintf(stderr, "%s: %s\n", severity == GRAZE_ERROR ? "error" : "warning", text);
}

static const graze_report to_stderr = {complain, NULL};

static bool find_here(void *user, const char *name, const char **path) {
    (void)user;
    *path = access(name, R_OK) == 0 ? name : NULL;
    return true;
}

/* A piece of the records, by one thread. */
static void evaluate_piece(void *user, size_t index, int worker) {
    work *w = user;
    size_t begin = w->count * index / w->pieces, end = w->count * (index + 1) / w->pieces;
    void *memory = malloc(cal_memory_size(w->code));
    (void)worker;
    if (!memory)
        w->failure = "out of memory";
    for (size_t i = begin; i < end && memory; i++)
        if (cal_evaluate(w->code, w->records + i * w->channels, w->values + i * w->outputs, memory) == CAL_FAILED)
            w->failure = cal_failure(w->code, memory);
    free(memory);
}

typedef struct options {
    bool scene, prints_time;
    int threads, channels, real_count;
    double reals[MOST];
    const char *file, *definitions;
} options;

static graze_status read_definitions(cal_program *program, const options *o) {
    static const char pi[] = "PI : 3.14159265358979323846;";
    const cal_finder here = {find_here, NULL};
    const place command_line = {.file = "-e"};
    graze_status status = o->scene ? cal_program_add_scene_names(program, &to_stderr)
                                   : cal_program_add_text(program, NULL, pi, strlen(pi), NULL, &to_stderr);
    if (!status && o->file)
        status = cal_program_use_file(program, o->file, &here, NULL, &to_stderr);
    if (!status && o->definitions)
        status = cal_program_add_text(program, NULL, o->definitions, strlen(o->definitions), &command_line, &to_stderr);
    return status;
}

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int evaluate(const cal_code *code, const options *o, size_t outputs) {
    whole_file input = {.bytes = NULL};
    if (whole_file_read(&input, STDIN_FILENO, "standard input", NULL, &to_stderr))
        return 2;
    work w = {.code = code, .records = (const double *)input.bytes, .channels = (size_t)o->channels};
    w.outputs = outputs;
    w.pieces = (size_t)o->threads;
    w.count = input.length / sizeof(double) / w.channels;
    w.values = malloc((w.count * outputs + 1) * sizeof *w.values);
    if (!w.values)
        return 2;
    double begin = seconds();
    parallel_for(o->threads, w.pieces, evaluate_piece, &w);
    if (o->prints_time)
        fprintf(stderr, "%.9f\n", seconds() - begin);
    if (w.failure)
        fprintf(stderr, "%s\n", w.failure);
    else
        fwrite(w.values, sizeof *w.values, w.count * outputs, stdout);
    free(w.values);
    free(input.bytes);
    return w.failure ? 1 : ferror(stdout) || fflush(stdout) ? 2 : 0;
}

static bool read_options(options *o, int argc, char **argv) {
    for (int c; (c = getopt(argc, argv, "svt:f:e:a:c:")) != -1;) {
        switch (c) {
        case 's':
            o->scene = true;
            break;
        case 'v':
            o->prints_time = true;
            break;
        case 't':
            o->threads = atoi(optarg);
            break;
        case 'f':
            o->file = optarg;
            break;
        case 'e':
            o->definitions = optarg;
            break;
        case 'a':
            if (o->real_count == MOST)
                return false;
            o->reals[o->real_count++] = strtod(optarg, NULL);
            break;
        case 'c':
            o->channels = atoi(optarg);
            break;
        default:
            return false;
        }
    }
    return o->threads > 0 && o->channels > 0 && o->channels <= CAL_CHANNELS_MOST && argc > optind &&
           argc - optind <= MOST;
}

int main(int argc, char **argv) {
    options o = {.threads = 1, .channels = 1};
    cal_expression expressions[MOST] = {{.text = NULL}};
    cal_code *code = NULL;
    cal_program *program = cal_program_create();
    if (!program || !read_options(&o, argc, argv)) {
        cal_program_destroy(program);
        return 2;
    }
    size_t count = (size_t)(argc - optind);
    for (size_t i = 0; i < count; i++)
        expressions[i].text = argv[(size_t)optind + i];
    const cal_request request = {.file = o.file,
                                 .expressions = expressions,
                                 .expression_count = count,
                                 .reals = o.reals,
                                 .real_count = (size_t)o.real_count,
                                 .channels = CAL_CHANNEL_BITS(1, o.channels)};
    int result = read_definitions(program, &o) || cal_compile(&code, program, &request, &to_stderr) ? 1 : 0;
    if (!result)
        result = evaluate(code, &o, count);
    cal_code_destroy(code);
    cal_program_destroy(program);
    return result;
}
