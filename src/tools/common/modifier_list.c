/* Lists of modifiers' names, from words and from files. */
#include "tools/common/modifier_list.h"

#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "base/whole_file.h"
#include "rad/path.h"

static graze_status add(modifier_list *list, const char *name, const graze_report *report) {
    if (list->count == list->capacity) {
        size_t capacity = list->capacity ? 2 * list->capacity : 16;
        const char **names = realloc(list->names, capacity * sizeof *names);
        if (!names)
            return report_out_of_memory(report);
        list->names = names;
        list->capacity = capacity;
    }
    list->names[list->count++] = name;
    return GRAZE_OK;
}

static graze_status add_words(modifier_list *list, const whole_file *file, const graze_report *report) {
    const char *end = file->bytes + file->length, *word = file->bytes;
    graze_status status = GRAZE_OK;
    while (status == GRAZE_OK) {
        while (word < end && text_is_blank(*word))
            word++;
        const char *behind = word;
        while (behind < end && !text_is_blank(*behind))
            behind++;
        if (word == end)
            break;
        const char *name = arena_copy_text(list->memory, word, (size_t)(behind - word));
        status = name ? add(list, name, report) : report_out_of_memory(report);
        word = behind;
    }
    return status;
}

static graze_status add_file(modifier_list *list, const char *name, const graze_report *report) {
    bool found = false;
    if (!list->memory)
        list->memory = arena_create();
    const char *path = list->memory ? rad_path_find(list->memory, NULL, name, &found) : NULL;
    if (!path)
        return report_out_of_memory(report);
    whole_file file = {0};
    size_t before = list->count;
    /* One that was not found is opened by its own name, for the system to say why it cannot be read. */
    graze_status status = whole_file_read_path(&file, found ? path : name, name, NULL, report);
    if (status == GRAZE_OK)
        status = add_words(list, &file, report);
    free(file.bytes);
    if (status == GRAZE_OK && list->count == before)
        report_warning(report, NULL, "%s: no modifier is named in it", name);
    return status;
}

static graze_status take(modifier_list *list, bool include, bool file, const char *suffix, int count,
                         const char *const *words, int *used, const graze_report *report) {
    char letter = include ? 'i' : 'e';
    if (file)
        letter = include ? 'I' : 'E';
    if (*suffix)
        return report_error(report, NULL, "unknown option '-%c%c%s'", list->letter, letter, suffix);
    if (count < 1)
        return report_error(report, NULL, "option '-%c%c' lacks an argument: the name of a %s", list->letter, letter,
                            file ? "file" : "modifier");
    if (list->given && list->include != include)
        return report_error(report, NULL,
                            "modifiers are either excluded (-%ce, -%cE) or included (-%ci, -%cI), not both",
                            list->letter, list->letter, list->letter, list->letter);
    list->given = true;
    list->include = include;
    *used = 1;
    return file ? add_file(list, words[0], report) : add(list, words[0], report);
}

graze_status modifier_list_exclude(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    return take(target, false, false, suffix, count, words, used, report);
}

graze_status modifier_list_include(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    return take(target, true, false, suffix, count, words, used, report);
}

graze_status modifier_list_exclude_file(void *target, const char *suffix, int count, const char *const *words,
                                        int *used, const graze_report *report) {
    return take(target, false, true, suffix, count, words, used, report);
}

graze_status modifier_list_include_file(void *target, const char *suffix, int count, const char *const *words,
                                        int *used, const graze_report *report) {
    return take(target, true, true, suffix, count, words, used, report);
}

void modifier_list_print(void *target, FILE *out) {
    const modifier_list *list = target;
    if (list->given && list->count == 0)
        fprintf(out, "-%c%c /dev/null", list->letter, list->include ? 'I' : 'E');
    for (size_t i = 0; i < list->count; i++) {
        fprintf(out, "%s-%c%c ", i ? " " : "", list->letter, list->include ? 'i' : 'e');
        options_print_word(out, list->names[i]);
    }
}

bool modifier_list_keeps(const modifier_list *list, const char *modifier) {
    bool listed = false;
    for (size_t i = 0; i < list->count && modifier && !listed; i++)
        listed = strcmp(list->names[i], modifier) == 0;
    return listed == list->include;
}

void modifier_list_free(modifier_list *list) {
    free(list->names);
    arena_destroy(list->memory);
}
