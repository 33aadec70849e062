/* From the words of one primitive to what it is, as it is written. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "rad/source.h"

static bool word_is(const rad_word *word, const char *text) {
    return strlen(text) == word->length && !memcmp(word->text, text, word->length);
}

#define SHOW(word) rad_show((word)->text, (word)->length).text

rad_primitive_name rad_describe(const rad_raw *raw) {
    rad_primitive_name name = {""};
    const char *type = raw->type == RAD_ALIAS ? "alias" : rad_type_name((rad_type)raw->type);
    if (raw->id)
        snprintf(name.text, sizeof name.text, "%s %s", type, rad_show(raw->id, strlen(raw->id)).text);
    return name;
}

/* Reads a word that must be there. Whatever is wrong, the rest of the input cannot be understood. */
static graze_status need_word(rad_source *s, rad_word *word, const rad_raw *raw, const char *what) {
    rad_word_status outcome = rad_words_next(&s->words, word);
    if (outcome == RAD_WORD)
        return GRAZE_OK;
    const graze_report *report = s->reader->report;
    rad_primitive_name name = rad_describe(raw);
    place here = rad_source_place(s, word->line, word->column), start = *raw->where;
    here.subject = start.subject = *name.text ? name.text : NULL;
    switch (outcome) {
    case RAD_WORD_OPEN:
        return report_error(report, &here, "quote without end");
    case RAD_WORD_ZERO:
        return report_error(report, &here, "not a scene description: it has bytes of value zero");
    case RAD_WORD_NO_MEMORY:
        return report_out_of_memory(report);
    default:
        return report_error(report, &start, "the text ends before %s %s", raw->id ? "its" : "the primitive's", what);
    }
}

static graze_status keep_text(rad_reader *reader, const rad_word *word, const char **text) {
    *text = arena_copy_text(reader->memory, word->text, word->length);
    return *text ? GRAZE_OK : report_out_of_memory(reader->report);
}

static graze_status read_modifier(rad_source *s, rad_raw *raw) {
    rad_reader *reader = s->reader;
    rad_word word;
    graze_status status = need_word(s, &word, raw, "modifier");
    if (status)
        return status;
    if (!reader->last_modifier || !word_is(&word, reader->last_modifier))
        if (keep_text(reader, &word, &reader->last_modifier))
            return GRAZE_SYSTEM_ERROR;
    raw->modifier = reader->last_modifier;
    return GRAZE_OK;
}

static bool is_modifier(const rad_raw *raw) {
    return raw->type >= RAD_TYPE_COUNT || !rad_type_is_surface((rad_type)raw->type);
}

/* Names are printed between tabs, a record a line. */
static bool has_control_character(const rad_word *word) {
    for (size_t i = 0; i < word->length; i++)
        if ((unsigned char)word->text[i] < ' ' || word->text[i] == 127)
            return true;
    return false;
}

static graze_status read_id(rad_source *s, rad_raw *raw) {
    rad_reader *reader = s->reader;
    rad_word word;
    graze_status status = need_word(s, &word, raw, "name");
    if (status)
        return status;
    place here = rad_source_place(s, word.line, word.column);
    if (has_control_character(&word)) {
        status =
            rad_reader_complain(reader, &here, "illegal tab or other control character in name \"%s\"", SHOW(&word));
        raw->broken = true;
    } else if (is_modifier(raw) && (word_is(&word, "void") || word_is(&word, "inherit"))) {
        status = rad_reader_complain(reader, &here, "\"%s\" cannot be the name of a modifier", SHOW(&word));
        raw->broken = true;
    }
    return status ? status : keep_text(reader, &word, &raw->id);
}

/* The complaint names the primitive, so its name is read first. */
static graze_status read_unknown_type(rad_source *s, rad_raw *raw, const rad_word *word) {
    rad_reader *reader = s->reader;
    place here = rad_source_place(s, word->line, word->column);
    rad_shown type = rad_show(word->text, word->length);
    raw->type = RAD_UNKNOWN;
    raw->broken = true;
    graze_status status = read_id(s, raw);
    graze_status complaint = rad_complain_of_type(reader, &here, type.text, raw->id);
    return status ? status : complaint;
}

static graze_status read_type_and_id(rad_source *s, rad_raw *raw) {
    rad_reader *reader = s->reader;
    rad_word word;
    graze_status status = need_word(s, &word, raw, "type");
    if (status)
        return status;
    if (word_is(&word, "alias")) {
        raw->type = RAD_ALIAS;
    } else if (word_is(&word, rad_type_name(reader->last_type)) ||
               rad_type_find(word.text, word.length, &reader->last_type)) {
        raw->type = (int)reader->last_type;
    } else {
        return read_unknown_type(s, raw, &word);
    }
    return read_id(s, raw);
}

static graze_status read_count(rad_source *s, const rad_raw *raw, const char *what, uint32_t *count) {
    rad_word word;
    graze_status status = need_word(s, &word, raw, what);
    if (status)
        return status;
    place here = rad_source_place(s, word.line, word.column);
    char digits[32];
    if (word.length >= sizeof digits)
        return report_error(s->reader->report, &here, "%s: \"%s\" is too long for a %s", rad_describe(raw).text,
                            SHOW(&word), what);
    memcpy(digits, word.text, word.length);
    digits[word.length] = 0;
    int value = -1;
    if (!text_to_integer(digits, &value) || value < 0)
        return report_error(s->reader->report, &here, "%s: \"%s\" is not a %s", rad_describe(raw).text, SHOW(&word),
                            what);
    *count = (uint32_t)value;
    return *count <= s->arguments_most ? GRAZE_OK : GRAZE_INPUT_ERROR;
}

/* Grows with what has been read, not with what a count promises. */
static void *grow(rad_reader *reader, void *array, size_t *capacity, size_t size) {
    size_t wanted = *capacity ? 2 * *capacity : 64;
    void *larger = realloc(array, wanted * size);
    if (larger)
        *capacity = wanted;
    else
        report_out_of_memory(reader->report);
    return larger;
}

static graze_status read_strings(rad_source *s, rad_raw *raw, uint32_t count) {
    rad_reader *reader = s->reader;
    for (uint32_t i = 0; i < count; ++i) {
        rad_word word;
        graze_status status = need_word(s, &word, raw, "last string argument");
        if (status)
            return status;
        if (i == reader->string_capacity) {
            const char **larger = grow(reader, reader->strings, &reader->string_capacity, sizeof *larger);
            if (!larger)
                return GRAZE_SYSTEM_ERROR;
            reader->strings = larger;
        }
        if (keep_text(reader, &word, &reader->strings[i]))
            return GRAZE_SYSTEM_ERROR;
    }
    raw->string_count = count;
    if (count == 0)
        return GRAZE_OK;
    const char **kept = arena_allocate(reader->memory, count * sizeof *kept);
    if (!kept)
        return report_out_of_memory(reader->report);
    memcpy(kept, reader->strings, count * sizeof *kept);
    raw->strings = kept;
    return GRAZE_OK;
}

/* Of integers there must be none; a primitive that has some is passed over. */
static graze_status read_integers(rad_source *s, rad_raw *raw) {
    uint32_t count = 0;
    graze_status status = read_count(s, raw, "number of integer arguments", &count);
    if (status || count == 0)
        return status;
    raw->broken = true;
    status = rad_reader_complain(s->reader, raw->where, "%s: %u integer arguments where there must be none",
                                 rad_describe(raw).text, (unsigned)count);
    rad_word word;
    for (uint32_t i = 0; i < count && !status; ++i)
        status = need_word(s, &word, raw, "last integer argument");
    return status;
}

static graze_status read_bad_real(rad_source *s, rad_raw *raw) {
    rad_word word;
    graze_status status = need_word(s, &word, raw, "last real argument");
    if (status || raw->broken)
        return status;
    raw->broken = true;
    place here = rad_source_place(s, word.line, word.column);
    return rad_reader_complain(s->reader, &here, "%s: \"%s\" is not a number", rad_describe(raw).text, SHOW(&word));
}

static graze_status read_reals(rad_source *s, rad_raw *raw) {
    rad_reader *reader = s->reader;
    uint32_t count = 0;
    graze_status status = read_count(s, raw, "number of real arguments", &count);
    for (uint32_t i = 0; i < count && !status; ++i) {
        if (i == reader->real_capacity) {
            double *larger = grow(reader, reader->reals, &reader->real_capacity, sizeof *larger);
            if (!larger)
                return GRAZE_SYSTEM_ERROR;
            reader->reals = larger;
        }
        reader->reals[i] = 0;
        if (!rad_words_real(&s->words, &reader->reals[i]))
            status = read_bad_real(s, raw);
    }
    if (status)
        return status;
    raw->real_count = count;
    raw->reals = arena_allocate(reader->memory, count * sizeof *raw->reals);
    if (!raw->reals)
        return report_out_of_memory(reader->report);
    if (count)
        memcpy(raw->reals, reader->reals, count * sizeof *raw->reals);
    return GRAZE_OK;
}

static int strings_most(const rad_raw *raw, const rad_type_facts *facts) {
    if (facts->strings_least > 0 || raw->type == RAD_MIST)
        return RAD_ANY_COUNT;
    return raw->type == RAD_ILLUM || raw->type == RAD_MIRROR;
}

/* What Radiance passes over in silence. */
static void warn_of_unused(rad_reader *reader, const rad_raw *raw, const rad_type_facts *facts) {
    int most = strings_most(raw, facts);
    if (most != RAD_ANY_COUNT && raw->string_count > (uint32_t)most)
        report_warning(reader->report, raw->where, "%s: string argument %d, \"%s\", has no meaning",
                       rad_describe(raw).text, most + 1, rad_show(raw->strings[most], strlen(raw->strings[most])).text);
    if ((raw->type == RAD_MESH || raw->type == RAD_INSTANCE) && raw->real_count > 0)
        report_warning(reader->report, raw->where, "%s: real arguments have no meaning", rad_describe(raw).text);
}

static graze_status check_strings(rad_reader *reader, rad_raw *raw, const rad_type_facts *facts) {
    if (raw->string_count >= (uint32_t)facts->strings_least)
        return GRAZE_OK;
    raw->broken = true;
    return rad_reader_complain(reader, raw->where, "%s: %u string arguments, but it needs %d or more",
                               rad_describe(raw).text, (unsigned)raw->string_count, facts->strings_least);
}

static graze_status check_reals(rad_reader *reader, rad_raw *raw, const rad_type_facts *facts) {
    char wanted[48];
    bool too_few = raw->real_count < (uint32_t)facts->reals_least;
    bool too_many = facts->reals_most != RAD_ANY_COUNT && raw->real_count > (uint32_t)facts->reals_most;
    if (!too_few && !too_many && raw->real_count % (uint32_t)facts->reals_step == 0)
        return GRAZE_OK;
    raw->broken = true;
    if (facts->reals_step > 1)
        snprintf(wanted, sizeof wanted, "%d, %d, ...", facts->reals_least, facts->reals_least + facts->reals_step);
    else if (facts->reals_most == facts->reals_least)
        snprintf(wanted, sizeof wanted, "%d", facts->reals_least);
    else if (facts->reals_most == RAD_ANY_COUNT)
        snprintf(wanted, sizeof wanted, "%d or more", facts->reals_least);
    else
        snprintf(wanted, sizeof wanted, "%d to %d", facts->reals_least, facts->reals_most);
    return rad_reader_complain(reader, raw->where, "%s: %u real arguments, but it needs %s", rad_describe(raw).text,
                               (unsigned)raw->real_count, wanted);
}

graze_status rad_reader_check(rad_reader *reader, rad_raw *raw) {
    if (raw->broken || raw->type == RAD_ALIAS)
        return GRAZE_OK;
    const rad_type_facts *facts = rad_type_look_up((rad_type)raw->type);
    graze_status status = check_strings(reader, raw, facts);
    if (!status && !raw->broken)
        status = check_reals(reader, raw, facts);
    if (!status && !raw->broken)
        warn_of_unused(reader, raw, facts);
    return status;
}

static graze_status read_arguments(rad_source *s, rad_raw *raw) {
    if (raw->type == RAD_ALIAS)
        return read_strings(s, raw, 1);
    uint32_t count = 0;
    graze_status status = read_count(s, raw, "number of string arguments", &count);
    if (!status)
        status = read_strings(s, raw, count);
    if (!status)
        status = read_integers(s, raw);
    if (!status)
        status = read_reals(s, raw);
    return status ? status : rad_reader_check(s->reader, raw);
}

graze_status rad_source_primitive(rad_source *s, int line, int column, rad_raw *raw, place **where) {
    *where = rad_keep_place(s->reader, rad_source_place(s, line, column));
    if (!*where)
        return report_out_of_memory(s->reader->report);
    *raw = (rad_raw){.where = *where};
    s->any = true;
    graze_status status = read_modifier(s, raw);
    if (!status)
        status = read_type_and_id(s, raw);
    return status ? status : read_arguments(s, raw);
}
