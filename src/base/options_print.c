/* What --help, --version and -defaults print. */
#include <stdlib.h>
#include <string.h>

#include "base/options_internal.h"

/* Where the texts behind the options begin: -defaults (Radiance's tab stops), --help. */
enum { COMMENT_COLUMN = 32, HELP_COLUMN = 24 };

static graze_status finish_output(const graze_report *report) {
    if (fflush(stdout) != 0 || ferror(stdout))
        return report_system_error(report, NULL, "cannot write to standard output");
    return GRAZE_OK;
}

static void print_reals(FILE *out, const double *values, int count) {
    for (int i = 0; i < count; i++) {
        char text[NUMBER_TEXT_SIZE];
        number_print_exact(text, values[i]);
        fprintf(out, "%s%s", i ? " " : "", text);
    }
}

static const char *text_of(const option *o) {
    return *(const char *const *)o->target;
}

/* The option with its value as it would be given; nothing where it has no value. */
static void print_option(FILE *out, const option *o) {
    if (o->handle) {
        if (o->print)
            o->print(o->target, out);
        return;
    }
    switch (o->kind) {
    case OPTION_FLAG:
        fprintf(out, "%s%c", o->name, *(const bool *)o->target ? '+' : '-');
        break;
    case OPTION_INTEGER:
        fprintf(out, "%s %d", o->name, *(const int *)o->target);
        break;
    case OPTION_REAL:
    case OPTION_REAL3:
        fprintf(out, "%s ", o->name);
        print_reals(out, o->target, o->kind == OPTION_REAL ? 1 : 3);
        break;
    case OPTION_TEXT:
        if (text_of(o)) {
            fprintf(out, "%s ", o->name);
            options_print_word(out, text_of(o));
        }
        break;
    case OPTION_SUFFIX:
        if (text_of(o)) {
            fputs(o->name, out);
            if (*text_of(o))
                options_print_word(out, text_of(o));
        }
        break;
    case OPTION_CUSTOM:
    case OPTION_HEADING:
        break;
    }
}

/* Without blanks at its end. */
char *options_value(const option *o) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        return NULL;
    print_option(out, o);
    if (fclose(out) != 0) {
        free(text);
        return NULL;
    }
    while (length > 0 && strchr(" \t\n", text[length - 1]))
        text[--length] = 0;
    return text;
}

static void print_default(const char *text, const char *help) {
    fputs(text, stdout);
    if (help) {
        int column = (int)strlen(text);
        do {
            putchar('\t');
            column = (column / 8 + 1) * 8;
        } while (column < COMMENT_COLUMN);
        printf("# %s", help);
    }
    putchar('\n');
}

graze_status options_print_defaults(const option_table *table, const graze_report *report) {
    for (int i = 0; i < table->count; i++) {
        char *text = options_value(&table->options[i]);
        if (!text)
            return report_out_of_memory(report);
        if (*text)
            print_default(text, table->options[i].help);
        free(text);
    }
    return finish_output(report);
}

/* What stands in brackets behind the help: the value alone. */
static const char *value_text(const option *o, const char *text) {
    if (o->kind == OPTION_FLAG)
        return *(const bool *)o->target ? "on" : "off";
    if (o->handle)
        return text;
    text += strlen(text) > strlen(o->name) ? strlen(o->name) : strlen(text);
    return text + (*text == ' ');
}

static void print_help_line(const char *name, const char *arguments, const char *help, const char *value) {
    int width = printf("  %s%s%s", name, arguments && *arguments ? " " : "", arguments ? arguments : "");
    if (width > HELP_COLUMN - 2) {
        putchar('\n');
        width = 0;
    }
    printf("%*s%s", HELP_COLUMN - width, "", help);
    if (*value)
        printf(" [%s]", value);
    putchar('\n');
}

/* A suffix's letters stand at the name: "-f[io]", not "-f [io]". */
static void print_help_option(const option *o, const char *value) {
    if (o->kind == OPTION_SUFFIX && o->arguments) {
        char name[128];
        snprintf(name, sizeof name, "%s%s", o->name, o->arguments);
        print_help_line(name, NULL, o->help, value);
    } else {
        print_help_line(o->name, o->arguments, o->help, value);
    }
}

graze_status options_print_help(const option_table *table, const graze_report *report) {
    printf("Usage: %s %s\n%s\n", table->program, table->synopsis, table->summary);
    if (table->count > 0 && table->options[0].kind != OPTION_HEADING)
        printf("\nOptions [and their values]:\n");
    for (int i = 0; i < table->count; i++) {
        const option *o = &table->options[i];
        if (!o->help)
            continue;
        if (o->kind == OPTION_HEADING) {
            printf("\n%s:\n", o->help);
            continue;
        }
        char *text = options_value(o);
        if (!text)
            return report_out_of_memory(report);
        print_help_option(o, value_text(o, text));
        free(text);
    }
    printf("\nFor all programs:\n");
    print_help_line("-defaults", NULL, "print all options with their values, as they could be given, and stop", "");
    print_help_line("--help", NULL, "print this and stop", "");
    print_help_line("--version", NULL, "print the version and stop", "");
    print_help_line("@FILE", NULL, "read options from a file", "");
    print_help_line("$NAME", NULL, "take options from an environment variable (quote it from the shell)", "");
    return finish_output(report);
}

graze_status options_print_version(const option_table *table, const graze_report *report) {
    printf("%s (Graze) %s\n", table->program, GRAZE_VERSION);
    return finish_output(report);
}
