/* Inputs: files, standard input, commands; their primitives are not linked yet. */
#include "rad/reader.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/whole_file.h"
#include "rad/command.h"
#include "rad/octree.h"
#include "rad/pieces.h"
#include "rad/source.h"
#include "rad/xform.h"

enum { DEPTH_MOST = 64, ERRORS_MOST = 20 };

void rad_reader_begin(rad_reader *reader, arena *memory, const graze_report *report) {
    *reader = (rad_reader){.memory = memory, .report = report, .threads = 1, .last_type = RAD_POLYGON};
}

void rad_reader_end(rad_reader *reader) {
    free(reader->reals);
    free(reader->strings);
}

graze_status rad_reader_complain(rad_reader *reader, const place *where, const char *format, ...) {
    char text[512];
    va_list arguments;
    /* What is wrong with the same primitive once more, when it was to be the last that is told. */
    if (reader->error_count >= ERRORS_MOST)
        return reader->status;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    graze_status status = report_error(reader->report, where, "%s", text);
    if (!reader->status)
        reader->status = status;
    return ++reader->error_count < ERRORS_MOST ? GRAZE_OK : reader->status;
}

rad_shown rad_show(const char *text, size_t length) {
    rad_shown shown;
    static const char more[] = "...";
    size_t most = sizeof shown.text - sizeof more;
    size_t kept = length < most ? length : most;
    for (size_t i = 0; i < kept; ++i)
        shown.text[i] = text[i] == '\n' ? ' ' : (unsigned char)text[i] < ' ' || text[i] == 127 ? '?' : text[i];
    memcpy(shown.text + kept, kept < length ? more : "", kept < length ? sizeof more : 1);
    return shown;
}

graze_status rad_complain_of_type(rad_reader *reader, const place *where, const char *type, const char *id) {
    rad_shown shown = rad_show(type, strlen(type));
    char subject[2 * sizeof(rad_shown)];
    place here = *where;
    if (id) {
        snprintf(subject, sizeof subject, "%s %s", shown.text, rad_show(id, strlen(id)).text);
        here.subject = subject;
    }
    return rad_reader_complain(reader, &here, "unknown type \"%s\"", shown.text);
}

place *rad_keep_place(rad_reader *reader, place where) {
    place *kept = arena_allocate(reader->memory, sizeof *kept);
    if (kept)
        *kept = where;
    return kept;
}

static graze_status read_primitive(rad_source *s, int line, int column) {
    rad_raw raw;
    place *where;
    graze_status status = rad_source_primitive(s, line, column, &raw, &where);
    return status ? status : s->sink->take(s->sink->user, &raw);
}

static graze_status read_command(rad_source *s, int line, int column) {
    rad_reader *reader = s->reader;
    ++s->words.next;
    rad_word word;
    rad_word_status outcome = rad_words_command(&s->words, &word);
    place here = rad_source_place(s, line, column);
    if (outcome == RAD_WORD_ZERO)
        return report_error(reader->report, &here, "not a scene description: it has bytes of value zero");
    const char *command = outcome == RAD_WORD ? arena_copy_text(reader->memory, word.text, word.length) : NULL;
    const place *where = rad_keep_place(reader, here);
    if (!command || !where)
        return report_out_of_memory(reader->report);
    s->any = true;
    rad_context inner = {s->context->directory, where, s->context->depth + 1};
    return rad_reader_command(reader, command, &inner, s->sink);
}

graze_status rad_source_read(rad_source *s, const char *until) {
    for (;;) {
        int line, column;
        char first = rad_words_peek(&s->words, &line, &column);
        if (s->words.next >= until)
            return GRAZE_OK;
        graze_status status = GRAZE_OK;
        if (first == '#')
            rad_words_skip_line(&s->words);
        else if (first == '!')
            status = read_command(s, line, column);
        else
            status = read_primitive(s, line, column);
        if (status)
            return status;
    }
}

static bool is_within_itself(const place *where) {
    for (const place *p = where->parent; p; p = p->parent)
        if (!strcmp(p->file, where->file))
            return true;
    return false;
}

static graze_status read_text(rad_reader *reader, const whole_file *text, const char *name, const rad_context *context,
                              const rad_sink *sink) {
    rad_source s = {.reader = reader, .name = name, .context = context, .sink = sink, .arguments_most = UINT32_MAX};
    place here = rad_source_place(&s, 0, 0);
    if (context->depth > DEPTH_MOST)
        return report_error(reader->report, &here, "%sfiles and commands are nested more than %d deep",
                            is_within_itself(&here) ? "brings in itself: " : "", DEPTH_MOST);
    if (rad_octree_is(text)) {
        const place *where = rad_keep_place(reader, here);
        return where ? rad_octree_read(reader, text, where, context, sink) : report_out_of_memory(reader->report);
    }
    if (rad_octree_is_named(name))
        return report_error(reader->report, &here, "a damaged octree, or none: its header is not there");
    rad_words_begin(&s.words, text->bytes, text->length);
    graze_status status = rad_pieces_are_worth_it(&s) ? rad_pieces_read(&s) : GRAZE_OK;
    if (!status)
        status = rad_source_read(&s, s.words.end);
    rad_words_end(&s.words);
    /* Cut so short that what is left is a comment. */
    if (!status && !s.any && !strncmp(text->bytes, "#?", 2))
        return report_error(reader->report, &here, "a damaged octree: nothing is behind its first line");
    if (!status && !s.any)
        report_warning(reader->report, &here, "no primitives");
    return status;
}

/* Reads a text if it was `got`, and frees it. */
static graze_status read_got(rad_reader *reader, graze_status got, whole_file *text, const char *name,
                             const rad_context *context, const rad_sink *sink) {
    graze_status status = got ? got : read_text(reader, text, name, context, sink);
    free(text->bytes);
    return status;
}

graze_status rad_reader_file(rad_reader *reader, const char *path, const rad_context *context, const rad_sink *sink) {
    const char *name = arena_copy_text(reader->memory, path, strlen(path));
    if (!name)
        return report_out_of_memory(reader->report);
    whole_file text;
    graze_status got = whole_file_read_path(&text, path, path, context->parent, reader->report);
    return read_got(reader, got, &text, name, context, sink);
}

graze_status rad_reader_standard_input(rad_reader *reader, const rad_context *context, const rad_sink *sink) {
    static const char name[] = "standard input";
    whole_file text;
    graze_status got = whole_file_read(&text, STDIN_FILENO, name, context->parent, reader->report);
    /* What should have written it has most likely failed. */
    if (!got && text.length == 0)
        got =
            report_error(reader->report, &(place){.file = name, .parent = context->parent}, "there is no scene on it");
    return read_got(reader, got, &text, name, context, sink);
}

/* "!COMMAND" as places have it. */
static const char *name_command(rad_reader *reader, const char *command) {
    char name[sizeof(rad_shown) + 1];
    size_t length = strlen(command);
    while (length > 0 && command[length - 1] == ' ')
        length--;
    snprintf(name, sizeof name, "!%s", rad_show(command, length).text);
    return arena_copy_text(reader->memory, name, strlen(name));
}

graze_status rad_reader_shell(rad_reader *reader, const char *command, const rad_context *context,
                              const rad_sink *sink) {
    const char *name = name_command(reader, command);
    if (!name)
        return report_out_of_memory(reader->report);
    whole_file text;
    graze_status got = rad_command_output(&text, command, context->directory, context->parent, reader->report);
    return read_got(reader, got, &text, name, context, sink);
}

graze_status rad_reader_command(rad_reader *reader, const char *command, const rad_context *context,
                                const rad_sink *sink) {
    rad_pipeline pipeline;
    if (!rad_pipeline_split(&pipeline, command, reader->memory))
        return report_out_of_memory(reader->report);
    if (pipeline.stage_count == 0)
        return rad_reader_shell(reader, command, context, sink);
    const char *name = name_command(reader, command);
    const place *where = name ? rad_keep_place(reader, (place){.file = name, .parent = context->parent}) : NULL;
    return where ? rad_xform_run(reader, &pipeline, context, where, sink) : report_out_of_memory(reader->report);
}
