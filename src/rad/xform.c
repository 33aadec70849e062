/* xform, done here: options, arrays and the transform of a whole scene. */
#include "rad/xform.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "rad/command.h"
#include "rad/path.h"
#include "rad/words.h"
#include "rad/xform_job.h"

/* Of one command: a slip of the finger should not fill the memory. */
enum { INSTANCES_MOST = 10000000 };

static const char *what_is_wrong(const char *word) {
    static const char *const first[] = {"-m", "-n", "-c", "-e", "-I"};
    for (size_t i = 0; i < sizeof first / sizeof *first; ++i)
        if (!strcmp(word, first[i]))
            return "this belongs before the transform, with what it needs";
    return rad_transform_wants(word);
}

static graze_status command_line_error(const rad_job *j, const char *word) {
    return report_error(j->reader->report, j->where, "xform: command line error at '%s': %s",
                        rad_show(word, strlen(word)).text, what_is_wrong(word));
}

static graze_status too_many_instances(const rad_job *j) {
    return report_error(j->reader->report, j->where, "xform: more than %d instances", INSTANCES_MOST);
}

/* Reads the options before the transform; *used tells how many words they are. */
static graze_status read_options(const rad_job *j, const char *const *words, int count, rad_filter *filter,
                                 bool *expand, int *used) {
    arena *memory = j->reader->memory;
    int i = 1;
    for (; i < count && words[i][0] == '-'; ++i) {
        const char *option = words[i];
        if (!strcmp(option, "-m") && i + 1 < count) {
            ++i;
            if (!filter->modifier && !(filter->modifier = arena_copy_text(memory, words[i], strlen(words[i]))))
                return report_out_of_memory_at(j->reader->report, j->where);
        } else if (!strcmp(option, "-n") && i + 1 < count) {
            ++i;
            if (!filter->prefix)
                filter->prefix = words[i];
            else if (!(filter->prefix = rad_join_names(memory, filter->prefix, words[i])))
                return report_out_of_memory_at(j->reader->report, j->where);
        } else if (!strcmp(option, "-c")) {
            *expand = false;
        } else if (!strcmp(option, "-e")) {
            *expand = true;
        } else if (!strcmp(option, "-I")) {
            filter->invert = !filter->invert;
        } else {
            break;
        }
    }
    *used = i;
    return GRAZE_OK;
}

/* One run of the program, without -a and -f. */
static graze_status run_once(rad_job *j, const char *const *words, int count) {
    const graze_report *report = j->reader->report;
    if (++j->instances > INSTANCES_MOST)
        return too_many_instances(j);
    rad_filter filter = {0};
    bool expand = true, in_range;
    int used = 0;
    graze_status status = read_options(j, words, count, &filter, &expand, &used);
    if (status)
        return status;
    filter.words = words + used;
    filter.word_count = rad_transform_leading(&filter.transform, words + used, count - used, &in_range);
    used += filter.word_count;
    if (used < count && words[used][0] == '-')
        return command_line_error(j, words[used]);
    if (!in_range)
        return report_error(report, j->where, "xform: transform out of range");
    rad_filter_sink filtered = {j->reader, &filter, j->sink};
    if (used == count && j->input)
        return rad_job_filter_list(j, j->input, &filtered);
    if (used == count)
        report_warning(report, j->where, "xform: no file, and nothing on standard input");
    for (; used < count && !status; ++used)
        status = rad_job_filter_file(j, words[used], expand, &filtered);
    return status;
}

/* The arrays and argument files that a command comes from, innermost first. */
typedef struct nesting {
    const struct nesting *outer; /* or null */
    int depth;                   /* from 1 */
    const whole_file *text;      /* of an argument file; null of an array */
    int behind;                  /* how many words of the command follow those of the file's line */
} nesting;

static graze_status run(rad_job *j, const char *const *words, int count, const nesting *outer);

static int find_word(const char *const *words, int count, const char *wanted) {
    for (int i = 1; i < count; ++i)
        if (!strcmp(words[i], wanted))
            return i;
    return 0;
}

/* Puts the instance's number behind every prefix there is, or only the first, or inserts a prefix of its own. `words`
 * must have room for two more; `name` for the longest of them and the number. */
static void number_prefix(const char **words, int *count, bool every, const char *otherwise, int number, char *name,
                          size_t room) {
    const char *former = NULL;
    for (int i = 1; i + 1 < *count; ++i)
        if (!strcmp(words[i], "-n") && (every || !former))
            former = words[i + 1];
    if (!former) {
        memmove(words + 3, words + 1, (size_t)(*count - 1) * sizeof *words);
        *count += 2;
        words[1] = "-n";
        words[2] = name;
        snprintf(name, room, "%s%d", otherwise, number);
        return;
    }
    snprintf(name, room, "%s.%d", former, number);
    bool done = false;
    for (int i = 1; i + 1 < *count && !done; ++i)
        if (!strcmp(words[i], "-n")) {
            words[++i] = name;
            done = !every;
        }
}

enum { NUMBER_ROOM = 16 }; /* for a point, an int and a zero byte */

static size_t longest(const char *const *words, int count) {
    size_t most = 0;
    for (int i = 0; i < count; ++i) {
        size_t length = strlen(words[i]);
        most = length > most ? length : most;
    }
    return most;
}

/* The count of an array, INSTANCES_MOST + 1 where it is more than that; 0 where there is none. */
static int array_count(const char *word) {
    double n;
    if (word[strspn(word, "+0123456789")] || !text_to_real(word, &n))
        return 0;
    return n > INSTANCES_MOST ? INSTANCES_MOST + 1 : (int)n;
}

/* How many instances the arrays of a command make, INSTANCES_MOST + 1 where they are more than that: told before the
 * first of them is made. */
static long all_instances(const char *const *words, int count) {
    int64_t all = 1;
    for (int i = 1; i + 1 < count; ++i) {
        int n = strcmp(words[i], "-a") ? 0 : array_count(words[i + 1]);
        if (n > 0)
            all *= n;
        if (all > INSTANCES_MOST)
            return INSTANCES_MOST + 1;
    }
    return (long)all;
}

/* `-a n transforms`: the command with `-i 0`, `-i 1` ... `-i n-1` in its place. */
static graze_status run_array(rad_job *j, const char *const *words, int count, int at, const nesting *here) {
    int n = at + 1 < count ? array_count(words[at + 1]) : 0;
    if (n == 0)
        return report_error(j->reader->report, j->where, "xform: missing count for -a option");
    if (j->instances + all_instances(words, count) > INSTANCES_MOST)
        return too_many_instances(j);
    const char **instance = malloc(((size_t)count + 2) * sizeof *instance);
    size_t room = longest(words, count) + NUMBER_ROOM;
    char *name = malloc(room);
    graze_status status = GRAZE_OK;
    if (!instance || !name)
        status = report_out_of_memory_at(j->reader->report, j->where);
    for (int i = 0; instance && name && i < n && !status; ++i) {
        char digits[NUMBER_ROOM];
        snprintf(digits, sizeof digits, "%d", i);
        memcpy(instance, words, (size_t)count * sizeof *instance);
        instance[at] = "-i";
        instance[at + 1] = digits;
        int instance_count = count;
        number_prefix(instance, &instance_count, true, "a", i, name, room);
        status = run(j, instance, instance_count, here);
    }
    free(instance);
    free(name);
    return status;
}

/* Splits one line of an argument file into words in `memory`, behind words[*count]. */
static graze_status split_line(const rad_job *j, arena *memory, const char *line, size_t length, const char **words,
                               int *count) {
    if (*line == '!') {
        ++line;
        --length;
    }
    if (!strncmp(line, "xform ", 6)) {
        line += 6;
        length -= 6;
    }
    rad_words reading;
    rad_words_begin(&reading, line, length);
    rad_word word;
    rad_word_status outcome;
    graze_status status = GRAZE_OK;
    while (!status && (outcome = rad_words_next(&reading, &word)) != RAD_WORD_NONE) {
        if (outcome == RAD_WORD && word.length == 1 && *word.text == '\\')
            continue; /* before a line's end: the line goes on */
        const char *kept = outcome == RAD_WORD ? arena_copy_text(memory, word.text, word.length) : NULL;
        if (kept)
            words[(*count)++] = kept;
        else if (outcome == RAD_WORD || outcome == RAD_WORD_NO_MEMORY)
            status = report_out_of_memory_at(j->reader->report, j->where);
        else
            status = report_error(j->reader->report, j->where, "xform: bad line in argument file: %s",
                                  rad_show(line, length).text);
    }
    rad_words_end(&reading);
    return status;
}

/* `-f file`: the command with one line of the file in its place. What it needs is in `memory`. */
static graze_status run_line(rad_job *j, arena *memory, const char *const *words, int count, int at,
                             const rad_word *line, int number, const nesting *here) {
    size_t most = (size_t)count + line->length / 2 + 4;
    const char **instance = arena_allocate(memory, most * sizeof *instance);
    char *text = arena_copy_text(memory, line->text, line->length);
    size_t room = longest(words, count) + line->length + NUMBER_ROOM;
    char *name = arena_allocate(memory, room);
    if (!instance || !text || !name)
        return report_out_of_memory_at(j->reader->report, j->where);
    int instance_count = at;
    memcpy(instance, words, (size_t)at * sizeof *instance);
    graze_status status = split_line(j, memory, text, line->length, instance, &instance_count);
    if (status)
        return status;
    memcpy(instance + instance_count, words + at + 2, (size_t)here->behind * sizeof *instance);
    instance_count += here->behind;
    number_prefix(instance, &instance_count, false, "i", number, name, room);
    return run(j, instance, instance_count, here);
}

/* The command for each line of an argument file, which messages call `name`. */
static graze_status run_lines(rad_job *j, const char *const *words, int count, int at, const char *name,
                              const nesting *here) {
    const graze_report *report = j->reader->report;
    const place *where = j->where;
    graze_status status = GRAZE_OK;
    rad_words lines;
    rad_words_begin(&lines, here->text->bytes, here->text->length);
    int number = 0;
    while (!status && lines.next < lines.end) {
        rad_word line;
        rad_word_status outcome = rad_words_command(&lines, &line);
        if (outcome != RAD_WORD) {
            status = outcome == RAD_WORD_ZERO ? report_error(report, j->where, "xform: %s is no argument file", name)
                                              : report_out_of_memory_at(report, j->where);
        } else if (line.length > 0 && line.text[0] != '#') {
            arena *memory = arena_create();
            j->where = &(place){.file = name, .line = line.line, .column = line.column, .parent = where};
            status = memory ? run_line(j, memory, words, count, at, &line, number++, here)
                            : report_out_of_memory_at(report, j->where);
            arena_destroy(memory);
            j->where = where;
        }
    }
    if (!status && number == 0)
        status = report_error(report, j->where, "xform: empty argument file \"%s\"", name);
    rad_words_end(&lines);
    return status;
}

/* Whether the `-f` that has `behind` words behind it stands in a line of a file with this same text: its copies would
 * double with each level, and there would be no last one. By the text, for a file has many names. */
static bool is_being_read(const nesting *n, const whole_file *text, int behind) {
    for (; n; n = n->outer)
        if (n->text && behind >= n->behind && n->text->length == text->length &&
            !memcmp(n->text->bytes, text->bytes, text->length))
            return true;
    return false;
}

static graze_status run_text(rad_job *j, const char *const *words, int count, int at, const char *name,
                             const nesting *here) {
    if (is_being_read(here->outer, here->text, here->behind))
        return report_error(j->reader->report, j->where, "xform: argument file %s names itself", name);
    return run_lines(j, words, count, at, name, here);
}

static graze_status run_file(rad_job *j, const char *const *words, int count, int at, nesting here) {
    const graze_report *report = j->reader->report;
    static const whole_file nothing = {"", 0};
    here.behind = count - at - 2;
    if (at + 1 < count && !strcmp(words[at + 1], "-")) {
        here.text = j->options ? j->options : &nothing;
        return run_text(j, words, count, at, "standard input", &here);
    }
    if (at + 1 >= count || words[at + 1][0] == '-')
        return report_error(report, j->where, "xform: missing file for -f option");
    const char *path = rad_path_resolve(j->reader->memory, j->context->directory, words[at + 1]);
    if (!path)
        return report_out_of_memory_at(report, j->where);
    whole_file text;
    graze_status status = whole_file_read_path(&text, path, path, j->where, report);
    if (status)
        return status;
    here.text = &text;
    status = run_text(j, words, count, at, path, &here);
    free(text.bytes);
    return status;
}

static graze_status run(rad_job *j, const char *const *words, int count, const nesting *outer) {
    enum { DEPTH_MOST = 64 };
    int file = find_word(words, count, "-f"), array = find_word(words, count, "-a");
    if (!file && !array)
        return run_once(j, words, count);
    nesting here = {.outer = outer, .depth = outer ? outer->depth + 1 : 1};
    if (here.depth > DEPTH_MOST)
        return report_error(j->reader->report, j->where,
                            "xform: arrays and argument files are nested more than %d deep", DEPTH_MOST);
    return file ? run_file(j, words, count, file, here) : run_array(j, words, count, array, &here);
}

static graze_status run_stage(rad_job j, const rad_stage *stage) {
    j.once = !find_word(stage->words, stage->count, "-f") && !find_word(stage->words, stage->count, "-a");
    graze_status status = run(&j, stage->words, stage->count, NULL);
    for (int i = 0; i < RAD_KEPT_FILES; ++i)
        rad_list_free(&j.files[i].primitives);
    return status;
}

graze_status rad_xform_run(rad_reader *reader, const rad_pipeline *pipeline, const rad_context *context,
                           const place *command, const rad_sink *sink) {
    rad_list passed[2] = {{0}, {0}}; /* from one stage to the next, in turn */
    rad_list *input = NULL;
    whole_file options = {NULL, 0};
    graze_status status = GRAZE_OK;
    if (pipeline->front && pipeline->front_is_options) {
        status = rad_command_output(&options, pipeline->front, context->directory, context->parent, reader->report);
    } else if (pipeline->front) {
        input = &passed[1];
        rad_list_sink kept = {reader, input};
        status = rad_reader_shell(reader, pipeline->front, context, &(rad_sink){rad_list_append, &kept});
    }
    for (int i = 0; i < pipeline->stage_count && !status; ++i) {
        rad_list *output = &passed[i % 2];
        rad_list_sink kept = {reader, output};
        bool last = i == pipeline->stage_count - 1;
        output->count = 0;
        const rad_job j = {.reader = reader,
                           .context = context,
                           .where = context->parent,
                           .command = command,
                           .sink = last ? sink : &(rad_sink){rad_list_append, &kept},
                           .input = input,
                           .options = i == 0 && options.bytes ? &options : NULL};
        status = run_stage(j, &pipeline->stages[i]);
        input = output;
    }
    rad_list_free(&passed[0]);
    rad_list_free(&passed[1]);
    free(options.bytes);
    return status;
}
