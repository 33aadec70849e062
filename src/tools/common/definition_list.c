/* Definitions, in the order of the command line. */
#include "tools/common/definition_list.h"

#include <stdlib.h>
#include <string.h>

#include "rad/reader.h"

static graze_status add(definition_list *list, graze_definitions added, const graze_report *report) {
    if (list->count == list->capacity) {
        size_t capacity = list->capacity ? 2 * list->capacity : 8;
        graze_definitions *grown = realloc(list->definitions, capacity * sizeof *grown);
        if (!grown)
            return report_out_of_memory(report);
        list->definitions = grown;
        list->capacity = capacity;
    }
    list->definitions[list->count++] = added;
    return GRAZE_OK;
}

/* Messages call it as it stands on the command line. */
static graze_status add_expression(definition_list *list, const char *text, const graze_report *report) {
    const rad_shown shown = rad_show(text, strlen(text));
    const size_t size = sizeof shown + sizeof "-e ";
    if (!list->memory)
        list->memory = arena_create();
    char *name = list->memory ? arena_allocate(list->memory, size) : NULL;
    if (!name)
        return report_out_of_memory(report);
    snprintf(name, size, "-e %s", shown.text);
    return add(list, (graze_definitions){.text = text, .file = name}, report);
}

static graze_status expect_word(char letter, const char *suffix, int count, const char *const *words, const char *what,
                                const graze_report *report) {
    if (*suffix)
        return report_error(report, NULL, "unknown option '-%c%s'", letter, suffix);
    if (count < 1)
        return report_error(report, NULL, "option '-%c' lacks an argument: %s", letter, what);
    return words[0][0] ? GRAZE_OK
                       : report_error(report, NULL, "option '-%c' has an empty argument instead of %s", letter, what);
}

graze_status definition_list_take_expression(void *target, const char *suffix, int count, const char *const *words,
                                             int *used, const graze_report *report) {
    definition_list *list = target;
    graze_status status = expect_word('e', suffix, count, words, "a definition or the name of a file", report);
    *used = 1;
    if (status != GRAZE_OK)
        return status;
    if (strpbrk(words[0], "=:"))
        return add_expression(list, words[0], report);
    list->error_file = words[0];
    return GRAZE_OK;
}

graze_status definition_list_take_file(void *target, const char *suffix, int count, const char *const *words, int *used,
                                       const graze_report *report) {
    graze_status status = expect_word('f', suffix, count, words, "the name of a file", report);
    *used = 1;
    return status == GRAZE_OK ? add(target, (graze_definitions){.file = words[0]}, report) : status;
}

void definition_list_print(void *target, FILE *out) {
    const definition_list *list = target;
    const char *before = "";
    if (list->error_file) {
        fputs("-e ", out);
        options_print_word(out, list->error_file);
        before = " ";
    }
    for (size_t i = 0; i < list->count; i++) {
        const graze_definitions *d = &list->definitions[i];
        fprintf(out, "%s%s ", before, d->text ? "-e" : "-f");
        options_print_word(out, d->text ? d->text : d->file);
        before = " ";
    }
}

void definition_list_free(definition_list *list) {
    free(list->definitions);
    arena_destroy(list->memory);
}
