/* Reading definitions. */
#include "cal/program_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/fingerprint.h"
#include "base/whole_file.h"
#include "cal/own_files.h"
#include "cal/scene_names.h"

cal_program *cal_program_create(void) {
    cal_program *program = malloc(sizeof *program);
    arena *memory = arena_create();
    if (!program || !memory) {
        free(program);
        arena_destroy(memory);
        return NULL;
    }
    *program = (cal_program){.memory = memory, .symbols = {.memory = memory}, .fingerprint = FINGERPRINT_OF_NOTHING};
    return program;
}

void cal_program_destroy(cal_program *program) {
    if (!program)
        return;
    arena_destroy(program->memory);
    free(program);
}

/* The same expression, but for last digits of numbers. */
static bool is_same(const cal_node *a, const cal_node *b) {
    if (a->kind != b->kind || a->symbol != b->symbol || a->index != b->index || a->count != b->count)
        return false;
    if (a->kind == CAL_NUMBER) {
        double most = 1e-12 * (b->number < 0 ? -b->number : b->number), apart = a->number - b->number;
        return apart <= most && -apart <= most;
    }
    for (a = a->first, b = b->first; a; a = a->next, b = b->next)
        if (!is_same(a, b))
            return false;
    return true;
}

static void warn_of_hiding(const cal_parser *p, const cal_statement *s, const cal_symbol *symbol,
                           const cal_definition *fresh) {
    const cal_definition *old = symbol->definition;
    place where = p->where;
    where.line = s->line;
    where.column = s->column;
    if (!old && symbol->library && fresh->is_function)
        report_warning(p->report, &where, "this '%s' hides the library's function", s->name);
    else if (old && (old->is_constant != fresh->is_constant || old->parameter_count != fresh->parameter_count ||
                     !is_same(old->body, fresh->body)))
        report_warning(p->report, &where, "'%s' is defined again, other than in line %d of %s%s", s->name, old->line,
                       old->file ? old->file : "the same text",
                       old->is_constant ? "; what was read before keeps that constant" : "");
}

static graze_status add_statement(cal_program *program, const cal_parser *p, const char *context,
                                  const cal_statement *s) {
    cal_definition *fresh = arena_allocate(program->memory, sizeof *fresh);
    bool *passed = arena_allocate(program->memory, (size_t)s->parameter_count * sizeof *passed);
    graze_status status;
    if (!fresh || !passed)
        return report_out_of_memory(p->report);
    memset(passed, 0, (size_t)s->parameter_count * sizeof *passed);
    *fresh = (cal_definition){.is_constant = s->is_constant,
                              .is_function = s->is_function,
                              .parameter_count = s->parameter_count,
                              .passed = passed,
                              .file = p->where.file,
                              .line = s->line,
                              .column = s->column};
    fresh->body = cal_resolve(program, p, context, s->is_function ? s : NULL, passed, s->body, &status);
    if (!fresh->body)
        return status;
    cal_symbol *symbol = cal_symbols_define(&program->symbols, context, s->name);
    if (!symbol)
        return report_out_of_memory(p->report);
    warn_of_hiding(p, s, symbol, fresh);
    symbol->definition = fresh;
    return GRAZE_OK;
}

/* A place that lasts as long as the program. */
static bool keep_place(cal_program *program, place *where) {
    const char *file = where->file;
    where->parent = NULL;
    where->file = file ? arena_copy_text(program->memory, file, strlen(file)) : NULL;
    return !file || where->file;
}

static graze_status add_statements(cal_program *program, const char *context, const char *text, size_t length,
                                   const place *where, const graze_report *report) {
    cal_parser p;
    cal_statement statement;
    bool found = true;
    graze_status status = GRAZE_OK;
    place kept = where ? *where : (place){0};
    if (!keep_place(program, &kept))
        return report_out_of_memory(report);
    kept.parent = where ? where->parent : NULL;
    program->fingerprint = fingerprint_add(program->fingerprint, context, strlen(context) + 1);
    program->fingerprint = fingerprint_add(program->fingerprint, text, length);
    cal_parse_begin(&p, text, length, program->memory, report);
    p.where = kept;
    while (!status && found) {
        status = cal_parse_statement(&p, &statement, &found);
        if (!status && found)
            status = add_statement(program, &p, context, &statement);
    }
    return status;
}

graze_status cal_program_add_text(cal_program *program, const char *file, const char *text, size_t length,
                                  const place *where, const graze_report *report) {
    const char *context = cal_context_of_file(program->memory, file);
    return context ? add_statements(program, context, text, length, where, report) : report_out_of_memory(report);
}

graze_status cal_program_add_scene_names(cal_program *program, const graze_report *report) {
    const place where = {.file = "Graze's rayinit.cal"};
    graze_status status = GRAZE_OK;
    for (const char *const *text = cal_scene_names; *text && !status; text++)
        status = add_statements(program, "", *text, strlen(*text), &where, report);
    return status;
}

static graze_status read_file(cal_program *program, const char *context, const char *name, const cal_finder *finder,
                              const place *where, const graze_report *report) {
    whole_file text;
    const char *path;
    if (!finder->find(finder->user, name, &path))
        return report_out_of_memory(report);
    const char *own = path ? NULL : cal_own_file(name);
    if (own)
        return add_statements(program, context, own, strlen(own), &(place){.file = name, .parent = where}, report);
    if (!path)
        return report_error(report, where, "there is no function file %s along RAYPATH", name);
    graze_status status = whole_file_read_path(&text, path, path, where, report);
    if (status)
        return status;
    const place inside = {.file = path, .parent = where};
    status = add_statements(program, context, text.bytes, text.length, &inside, report);
    free(text.bytes);
    return status;
}

graze_status cal_program_use_file(cal_program *program, const char *name, const cal_finder *finder, const place *where,
                                  const graze_report *report) {
    const char *context = cal_context_of_file(program->memory, name);
    if (!context)
        return report_out_of_memory(report);
    for (const cal_file *f = program->files; f; f = f->next)
        if (strcmp(f->context, context) == 0)
            return f->status;
    if (!*context)
        return GRAZE_OK;
    cal_file *file = arena_allocate(program->memory, sizeof *file);
    if (!file)
        return report_out_of_memory(report);
    file->context = context;
    file->next = program->files;
    program->files = file;
    return file->status = read_file(program, context, name, finder, where, report);
}

graze_status cal_program_add_file(cal_program *program, const char *name, const cal_finder *finder, const place *where,
                                  const graze_report *report) {
    return read_file(program, "", name, finder, where, report);
}

uint64_t cal_program_fingerprint(const cal_program *program) {
    return program->fingerprint;
}

int cal_program_parameter_count(cal_program *program, const char *file, const char *name) {
    const char *context = cal_context_of_file(program->memory, file);
    if (!context)
        return -1;
    const cal_symbol *symbol = cal_symbols_find(&program->symbols, context, name);
    if (symbol && symbol->definition)
        return symbol->definition->parameter_count;
    const cal_function *library = symbol ? symbol->library : cal_library_find(name);
    if (!library)
        return 0;
    switch (library->kind) {
    case CAL_NOISE:
    case CAL_IF:
        return 3;
    case CAL_REAL_2:
        return 2;
    default:
        return 1;
    }
}
