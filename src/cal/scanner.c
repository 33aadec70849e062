/* Blanks, nested comments, names and numbers. */
#include "cal/scanner.h"

#include "base/number.h"
#include "base/text.h"

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool cal_starts_name(char c) {
    return is_letter(c) || c == '`';
}

bool cal_is_name_character(char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '.' || c == '`';
}

static void step(cal_scanner *s) {
    if (*s->next++ == '\n') {
        s->line++;
        s->line_start = s->next;
    }
}

static void skip_comment(cal_scanner *s) {
    size_t depth = 0;
    const char *begin = s->next;
    int line = s->line, column = cal_scan_column(s);
    for (; s->next < s->end; step(s)) {
        depth += *s->next == '{';
        if (*s->next == '}' && --depth == 0) {
            s->next++;
            return;
        }
    }
    s->open_comment = begin;
    s->open_line = line;
    s->open_column = column;
}

static void skip_blanks(cal_scanner *s) {
    while (s->next < s->end) {
        if (*s->next == '{')
            skip_comment(s);
        else if (text_is_blank(*s->next))
            step(s);
        else
            return;
    }
}

void cal_scan_begin(cal_scanner *s, const char *text, size_t length) {
    *s = (cal_scanner){.next = text, .end = text + length, .line_start = text, .line = 1};
    skip_blanks(s);
}

void cal_scan_skip(cal_scanner *s) {
    if (s->next < s->end)
        step(s);
    skip_blanks(s);
}

const char *cal_scan_name(cal_scanner *s, size_t *length) {
    const char *name = s->next;
    while (s->next < s->end && cal_is_name_character(*s->next))
        s->next++;
    *length = (size_t)(s->next - name);
    if (*length > CAL_NAME_LENGTH)
        *length = CAL_NAME_LENGTH;
    skip_blanks(s);
    return name;
}

bool cal_scan_number(cal_scanner *s, double *value) {
    const char *end = is_digit(*s->next) || *s->next == '.' ? number_scan(s->next, s->end, value) : NULL;
    if (!end)
        return false;
    s->next = end;
    skip_blanks(s);
    return true;
}

bool cal_scan_integer(cal_scanner *s, int *value) {
    long n = 0;
    while (s->next < s->end && is_digit(*s->next) && n < 100000)
        n = 10 * n + (*s->next++ - '0');
    skip_blanks(s);
    *value = (int)n;
    return n < 100000;
}
