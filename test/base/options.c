/* Command lines: what is taken, what is refused, what is printed. */
#include "base/options.h"

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/captured_report.h"

/* A command line much like gtrace's and gpict's. */
typedef struct settings {
    bool back, irradiance, grid;
    int bounces, processes;
    double threshold, error, pixel;
    double ambient[3];
    const char *fields, *format, *output, *strategy;
    char view[64];
} settings;

static const settings initial = {.back = true,
                                 .bounces = 2,
                                 .threshold = .05,
                                 .error = .02,
                                 .pixel = 1,
                                 .ambient = {.1, .2, .3},
                                 .fields = "v",
                                 .format = "aa"};

/* -vX with as many words as the letter wants: -vt none, -vp three. */
static graze_status handle_view(void *target, const char *suffix, int count, const char *const *words, int *used,
                                const graze_report *report) {
    settings *s = target;
    *used = suffix[0] == 'p' ? 3 : 0;
    if (!suffix[0] || *used > count)
        return report_error(report, NULL, "bad view '%s'", suffix);
    snprintf(s->view, sizeof s->view, "%s", suffix);
    for (int i = 0; i < *used; i++) {
        strcat(s->view, " ");
        strcat(s->view, words[i]);
    }
    return GRAZE_OK;
}

static void print_view(void *target, FILE *out) {
    fprintf(out, "-v%s\n", ((settings *)target)->view);
}

static graze_status handle_pair(void *target, const char *suffix, int count, const char *const *words, int *used,
                                const graze_report *report) {
    settings *s = target;
    if (*suffix || count < 2)
        return report_error(report, NULL, "bad pair");
    snprintf(s->view, sizeof s->view, "%s+%s", words[0], words[1]);
    *used = 2;
    return GRAZE_OK;
}

typedef struct fixture {
    settings s;
    option options[24];
    option_table table;
    options_arguments *arguments;
    captured c;
    options_outcome outcome;
    int count;
    const char *const *operands;
} fixture;

static void add(fixture *f, option o) {
    f->options[f->table.count++] = o;
}

static void begin(fixture *f) {
    memset(f, 0, sizeof *f);
    f->s = initial;
    captured_begin(&f->c);
    f->table = (option_table){"gtest", "[options] scene...", "Tests options.", f->options, 0};
    settings *s = &f->s;
    add(f, (option){.kind = OPTION_HEADING, .help = "Rays"});
    add(f, (option){.name = "-bv", .kind = OPTION_FLAG, .target = &s->back, .help = "back face visibility"});
    add(f, (option){.name = "-i", .kind = OPTION_FLAG, .target = &s->irradiance, .help = "irradiance"});
    add(f, (option){.name = "-ab",
                    .kind = OPTION_INTEGER,
                    .target = &s->bounces,
                    .arguments = "N",
                    .help = "bounces",
                    .low = 0,
                    .high = 10});
    add(f, (option){.name = "-n", .kind = OPTION_INTEGER, .target = &s->processes});
    add(f,
        (option){.name = "-dt", .kind = OPTION_REAL, .target = &s->threshold, .arguments = "F", .help = "threshold"});
    add(f,
        (option){
            .name = "-av", .kind = OPTION_REAL3, .target = s->ambient, .arguments = "r g b", .help = "ambient value"});
    add(f, (option){.kind = OPTION_HEADING, .help = "Output"});
    add(f, (option){.name = "-o", .kind = OPTION_SUFFIX, .target = &s->fields, .arguments = "SPEC", .help = "fields"});
    add(f, (option){.name = "-f", .kind = OPTION_SUFFIX, .target = &s->format, .arguments = "[io]", .help = "formats"});
    add(f,
        (option){.name = "-fo", .kind = OPTION_TEXT, .target = &s->output, .arguments = "FILE", .help = "output file"});
    add(f, (option){.name = "-v",
                    .kind = OPTION_CUSTOM,
                    .target = s,
                    .help = "view",
                    .handle = handle_view,
                    .print = print_view});
    add(f, (option){
               .name = "-pa", .kind = OPTION_REAL, .target = &s->pixel, .low = 0, .high = INFINITY, .help = "aspect"});
    add(f, (option){.name = "--error",
                    .kind = OPTION_REAL,
                    .target = &s->error,
                    .low = 0,
                    .high = 1,
                    .arguments = "E",
                    .help = "target error"});
    add(f, (option){.name = "--strategy",
                    .kind = OPTION_TEXT,
                    .target = &s->strategy,
                    .arguments = "light|brdf|mis",
                    .help = "strategy"});
    add(f, (option){.name = "--grid", .kind = OPTION_FLAG, .target = &s->grid, .help = "grid"});
    add(f, (option){.name = "--pair", .kind = OPTION_CUSTOM, .target = s, .handle = handle_pair});
}

static void end(fixture *f) {
    options_arguments_destroy(f->arguments);
}

/* Expands and parses the words; the last argument is null. */
static graze_status run(fixture *f, ...) {
    char *words[32] = {"gtest"};
    int count = 1;
    va_list list;
    va_start(list, f);
    for (char *word; (word = va_arg(list, char *));)
        words[count++] = word;
    va_end(list);
    options_arguments_destroy(f->arguments);
    graze_status status = options_expand(&f->arguments, count, words, &f->c.report);
    return status ? status : options_parse(&f->table, f->arguments, &f->count, &f->operands, &f->outcome, &f->c.report);
}

#define RUN(f, ...) run(f, __VA_ARGS__, (char *)NULL)

static void expect_error(fixture *f, graze_status status, const char *text) {
    assert_int_equal(status, GRAZE_INPUT_ERROR);
    assert_string_equal(f->c.text, text);
}

/* Standard output goes to a file between the two calls; the second gives what was written. */
static int saved_output;
static void capture_output(void) {
    fflush(stdout);
    saved_output = dup(STDOUT_FILENO);
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_true(dup2(fileno(file), STDOUT_FILENO) >= 0);
    fclose(file);
}

static void captured_output(char *text, size_t size) {
    fflush(stdout);
    lseek(STDOUT_FILENO, 0, SEEK_SET);
    ssize_t length = read(STDOUT_FILENO, text, size - 1);
    dup2(saved_output, STDOUT_FILENO);
    close(saved_output);
    assert_true(length >= 0);
    text[length] = 0;
}

static void write_file(const char *name, const char *text) {
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void test_kinds(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, "-ab", "5", "-dt", ".25", "-av", "1", "-2e-1", "+.3", "-ovn", "-fad", "-fo", "x.hdr",
                         "-vtv", "-vp", "1", "2", "3", "--error", "1e-2", "a.rad", "-ab"),
                     GRAZE_OK);
    assert_int_equal(f.outcome, OPTIONS_RUN);
    assert_int_equal(f.s.bounces, 5);
    assert_true(f.s.threshold == .25 && f.s.error == .01);
    assert_true(f.s.ambient[0] == 1 && f.s.ambient[1] == -.2 && f.s.ambient[2] == .3);
    assert_string_equal(f.s.fields, "vn");
    assert_string_equal(f.s.format, "ad");
    assert_string_equal(f.s.output, "x.hdr");
    assert_string_equal(f.s.view, "p 1 2 3");
    assert_int_equal(f.count, 2);
    assert_string_equal(f.operands[0], "a.rad");
    assert_string_equal(f.operands[1], "-ab");
    end(&f);
}

static void test_flags(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, "-bv"), GRAZE_OK);
    assert_false(f.s.back);
    assert_int_equal(RUN(&f, "-bv"), GRAZE_OK);
    assert_true(f.s.back);
    for (const char *on = "+1yYtT"; *on; on++) {
        char word[] = {'-', 'b', 'v', *on, 0};
        f.s.back = false;
        assert_int_equal(RUN(&f, word), GRAZE_OK);
        assert_true(f.s.back);
        assert_int_equal(RUN(&f, word), GRAZE_OK);
        assert_true(f.s.back);
    }
    for (const char *off = "-0nNfF"; *off; off++) {
        char word[] = {'-', 'b', 'v', *off, 0};
        f.s.back = true;
        assert_int_equal(RUN(&f, word), GRAZE_OK);
        assert_false(f.s.back);
    }
    expect_error(&f, RUN(&f, "-bvx"), "unknown option '-bvx' (gtest --help lists all)");
    expect_error(&f, RUN(&f, "-i++"), "unknown option '-i++' (gtest --help lists all)");
    end(&f);
}

static void test_long_options(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, "--error=.5", "--strategy=a=b", "--grid", "--grid", "--pair=x", "y", "scene"), GRAZE_OK);
    assert_true(f.s.error == .5 && f.s.grid);
    assert_string_equal(f.s.strategy, "a=b");
    assert_string_equal(f.s.view, "x+y");
    assert_int_equal(f.count, 1);
    assert_int_equal(RUN(&f, "--grid-"), GRAZE_OK);
    assert_false(f.s.grid);
    assert_int_equal(RUN(&f, "--grid=1"), GRAZE_OK);
    assert_true(f.s.grid);
    assert_int_equal(RUN(&f, "--strategy="), GRAZE_OK);
    assert_string_equal(f.s.strategy, "");
    expect_error(&f, RUN(&f, "--grid=maybe"), "option '--grid': 'maybe' is neither 1 (on) nor 0 (off)");
    expect_error(&f, RUN(&f, "--err=1"), "unknown option '--err=1' (gtest --help lists all)");
    expect_error(&f, RUN(&f, "--errors", "1"), "unknown option '--errors' (gtest --help lists all)");
    expect_error(&f, RUN(&f, "-ab=1"), "unknown option '-ab=1' (gtest --help lists all)");
    end(&f);
}

static void test_longest_name_wins(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, "-fo", "file", "-foo"), GRAZE_OK);
    assert_string_equal(f.s.output, "file");
    assert_string_equal(f.s.format, "oo");
    assert_int_equal(RUN(&f, "-o", "operand"), GRAZE_OK);
    assert_string_equal(f.s.fields, "");
    assert_int_equal(f.count, 1);
    /* -v is a prefix of -version, and that is asked for. */
    capture_output();
    graze_status status = RUN(&f, "-version");
    char text[256];
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    assert_int_equal(f.outcome, OPTIONS_DONE);
    assert_string_equal(text, "gtest (Graze) " GRAZE_VERSION "\n");
    end(&f);
}

static void test_operands(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    assert_int_equal(run(&f, (char *)NULL), GRAZE_OK);
    assert_int_equal(f.count, 0);
    assert_int_equal(RUN(&f, "-i", "-", "-i"), GRAZE_OK);
    assert_int_equal(f.count, 2);
    assert_string_equal(f.operands[0], "-");
    assert_int_equal(RUN(&f, "--", "-i", "@none", "$NONE"), GRAZE_OK);
    assert_int_equal(f.count, 3);
    assert_string_equal(f.operands[0], "-i");
    assert_string_equal(f.operands[1], "@none");
    assert_int_equal(RUN(&f, "", "x"), GRAZE_OK);
    assert_int_equal(f.count, 2);
    end(&f);
}

static void test_errors(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    expect_error(&f, RUN(&f, "-q"), "unknown option '-q' (gtest --help lists all)");
    expect_error(&f, RUN(&f, "-ab"), "option '-ab' lacks an argument: -ab N");
    expect_error(&f, RUN(&f, "-av", "1", "2"), "option '-av' lacks an argument: -av r g b");
    expect_error(&f, RUN(&f, "-fo"), "option '-fo' lacks an argument: -fo FILE");
    expect_error(&f, RUN(&f, "-ab", "2.5"), "option '-ab': '2.5' is not an integer");
    expect_error(&f, RUN(&f, "-ab", "11"), "option '-ab': 11 is not in 0 .. 10");
    expect_error(&f, RUN(&f, "-ab", "-1"), "option '-ab': -1 is not in 0 .. 10");
    expect_error(&f, RUN(&f, "-dt", "nan"), "option '-dt': 'nan' is not a number");
    expect_error(&f, RUN(&f, "-dt", "0x1"), "option '-dt': '0x1' is not a number");
    expect_error(&f, RUN(&f, "-dt", "1e999"), "option '-dt': '1e999' is not a number");
    expect_error(&f, RUN(&f, "-pa", "-.5"), "option '-pa': -.5 is less than 0");
    expect_error(&f, RUN(&f, "--error=2"), "option '--error': 2 is not in 0 .. 1");
    expect_error(&f, RUN(&f, "-av", "9", "9", "x"), "option '-av': 'x' is not a number");
    expect_error(&f, RUN(&f, "-vp", "1"), "bad view 'p'");
    assert_int_equal(f.s.bounces, initial.bounces);
    assert_true(f.s.ambient[0] == initial.ambient[0]);
    assert_true(f.s.threshold == initial.threshold);
    end(&f);
}

static void test_defaults(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    capture_output();
    graze_status status = RUN(&f, "-ab", "3", "-bv-", "-vtv", "-fo", "my file", "-defaults", "-ab", "garbage");
    char text[4096];
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    assert_int_equal(f.outcome, OPTIONS_DONE);
    assert_string_equal(text, "-bv-\t\t\t\t# back face visibility\n"
                              "-i-\t\t\t\t# irradiance\n"
                              "-ab 3\t\t\t\t# bounces\n"
                              "-n 0\n"
                              "-dt 0.05\t\t\t# threshold\n"
                              "-av 0.1 0.2 0.3\t\t\t# ambient value\n"
                              "-ov\t\t\t\t# fields\n"
                              "-faa\t\t\t\t# formats\n"
                              "-fo 'my file'\t\t\t# output file\n"
                              "-vtv\t\t\t\t# view\n"
                              "-pa 1\t\t\t\t# aspect\n"
                              "--error 0.02\t\t\t# target error\n"
                              "--grid-\t\t\t\t# grid\n");
    end(&f);
}

/* What -defaults prints is an options file that restores every value. */
static void test_defaults_are_readable(void **state) {
    (void)state;
    char name[] = "/tmp/graze-options-XXXXXX";
    close(mkstemp(name));
    fixture f, g;
    begin(&f);
    begin(&g);
    capture_output();
    graze_status status = RUN(&f, "-ab", "7", "-bv-", "-i", "-dt", "0.1234567890123456", "-av", "1e-30", "-0", "3e10",
                              "-oe~V", "-fo", "it's a \"#\" \\ file", "-vtl", "--strategy", "#", "--grid", "-help");
    char text[4096];
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    write_file(name, text);
    char word[64];
    snprintf(word, sizeof word, "@%s", name);
    assert_int_equal(RUN(&g, word), GRAZE_OK);
    unlink(name);
    assert_int_equal(g.count, 0);
    assert_int_equal(g.s.bounces, 7);
    assert_true(!g.s.back && g.s.irradiance && g.s.grid && g.s.threshold == 0.1234567890123456);
    assert_memory_equal(g.s.ambient, f.s.ambient, sizeof f.s.ambient);
    assert_string_equal(g.s.fields, "e~V");
    assert_string_equal(g.s.output, "it's a \"#\" \\ file");
    assert_string_equal(g.s.strategy, "#");
    assert_string_equal(g.s.view, "tl");
    end(&f);
    end(&g);
}

static graze_status handle_letter(void *target, const char *suffix, int count, const char *const *words, int *used,
                                  const graze_report *report) {
    assert_int_equal(*used, 0);
    if (!suffix[0] || suffix[1])
        return report_error(report, NULL, "bad letter '%s'", suffix);
    *(char *)target = suffix[0];
    *used = suffix[0] == 'w';
    if (*used > count)
        return report_error(report, NULL, "no word");
    if (*used)
        assert_string_equal(words[0], "word");
    return GRAZE_OK;
}

static void print_letter(void *target, FILE *out) {
    if (*(char *)target)
        fprintf(out, "-c%c", *(char *)target);
}

/* Its letters stand at its name, and words behind it are let alone unless it takes them. */
static void test_handled_suffix(void **state) {
    (void)state;
    fixture f;
    char letter = 0, text[4096];
    begin(&f);
    add(&f, (option){.name = "-c",
                     .kind = OPTION_SUFFIX,
                     .target = &letter,
                     .arguments = "X",
                     .help = "letter",
                     .handle = handle_letter,
                     .print = print_letter});
    assert_int_equal(RUN(&f, "-cw", "word", "a.rad"), GRAZE_OK);
    assert_int_equal(f.count, 1);
    assert_int_equal(RUN(&f, "-cw"), GRAZE_INPUT_ERROR);
    assert_int_equal(RUN(&f, "-cl", "a.rad"), GRAZE_OK);
    assert_int_equal(letter, 'l');
    assert_int_equal(f.count, 1);
    assert_int_equal(RUN(&f, "-c", "l"), GRAZE_INPUT_ERROR);
    assert_int_equal(RUN(&f, "-cll"), GRAZE_INPUT_ERROR);
    capture_output();
    graze_status status = RUN(&f, "-help");
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    assert_non_null(strstr(text, "\n-cl\t\t\t\t# letter\n"));
    capture_output();
    status = RUN(&f, "--help");
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    assert_non_null(strstr(text, "\n  -cX                   letter [-cl]\n"));
    end(&f);
}

static void test_help(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    capture_output();
    graze_status status = RUN(&f, "-vtv", "--help");
    char text[8192];
    captured_output(text, sizeof text);
    assert_int_equal(status, GRAZE_OK);
    assert_int_equal(f.outcome, OPTIONS_DONE);
    const char *expected = "Usage: gtest [options] scene...\n"
                           "Tests options.\n"
                           "\n"
                           "Rays:\n"
                           "  -bv                   back face visibility [on]\n"
                           "  -i                    irradiance [off]\n"
                           "  -ab N                 bounces [2]\n"
                           "  -dt F                 threshold [0.05]\n"
                           "  -av r g b             ambient value [0.1 0.2 0.3]\n"
                           "\n"
                           "Output:\n"
                           "  -oSPEC                fields [v]\n"
                           "  -f[io]                formats [aa]\n"
                           "  -fo FILE              output file\n"
                           "  -v                    view [-vtv]\n"
                           "  -pa                   aspect [1]\n"
                           "  --error E             target error [0.02]\n"
                           "  --strategy light|brdf|mis\n"
                           "                        strategy\n"
                           "  --grid                grid [off]\n"
                           "\n"
                           "For all programs:\n";
    text[strlen(expected)] = 0;
    assert_string_equal(text, expected);
    end(&f);
}

/* In a process of its own, for standard output is lost by it. */
static void test_full_output(void **state) {
    (void)state;
    fixture f;
    begin(&f);
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        int full = open("/dev/full", O_WRONLY);
        if (full < 0 || dup2(full, STDOUT_FILENO) < 0)
            _exit(1);
        graze_status status = RUN(&f, "--help");
        _exit(status == GRAZE_SYSTEM_ERROR && strstr(f.c.text, "No space left") ? 0 : 2);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    end(&f);
}

static void test_files_and_variables(void **state) {
    (void)state;
    char inner[] = "/tmp/graze-options-XXXXXX", outer[] = "/tmp/graze-options-XXXXXX", text[256], word[64];
    close(mkstemp(inner));
    close(mkstemp(outer));
    snprintf(text, sizeof text,
             "# comment 'with a quote\n-ab 4\t\t# bounces\n\r\n  -fo 'a b'\"c \\\"d\\\" \\\\ \\x\"e\\ f -o#x @%s "
             "$GRAZE_TEST '@x' \\$y",
             inner);
    write_file(outer, text);
    write_file(inner, "-dt\n.125\v");
    setenv("GRAZE_TEST", "scene.rad \"!cmd arg\"", 1);
    snprintf(word, sizeof word, "@%s", outer);
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, "-i", word, "last"), GRAZE_OK);
    unlink(inner);
    unlink(outer);
    assert_true(f.s.irradiance);
    assert_int_equal(f.s.bounces, 4);
    assert_string_equal(f.s.output, "a bc \"d\" \\ \\xe f");
    assert_string_equal(f.s.fields, "#x");
    assert_true(f.s.threshold == .125);
    assert_int_equal(f.count, 5);
    assert_string_equal(f.operands[0], "scene.rad");
    assert_string_equal(f.operands[1], "!cmd arg");
    assert_string_equal(f.operands[2], "@x");
    assert_string_equal(f.operands[3], "$y");
    assert_string_equal(f.operands[4], "last");
    setenv("GRAZE_TEST", "", 1);
    assert_int_equal(RUN(&f, "$GRAZE_TEST", "@", "$"), GRAZE_OK);
    assert_int_equal(f.count, 2);
    end(&f);
}

static void test_bad_files_and_variables(void **state) {
    (void)state;
    char name[] = "/tmp/graze-options-XXXXXX", text[128], word[64], expected[256];
    close(mkstemp(name));
    snprintf(word, sizeof word, "@%s", name);
    fixture f;
    begin(&f);
    unsetenv("GRAZE_NONE");
    expect_error(&f, RUN(&f, "$GRAZE_NONE"), "the environment has no variable '$GRAZE_NONE'");
    expect_error(&f, RUN(&f, "@/nowhere/opts"),
                 "cannot read the options in '@/nowhere/opts': No such file or directory");
    expect_error(&f, RUN(&f, "@/tmp"), "cannot read the options in '@/tmp': Is a directory");

    write_file(name, "-i\n\n -ab 1 $GRAZE_NONE");
    snprintf(expected, sizeof expected, "%s:3: the environment has no variable '$GRAZE_NONE'", name);
    expect_error(&f, RUN(&f, word), expected);
    write_file(name, "-i\n'abc\n");
    snprintf(expected, sizeof expected, "%s:2: the quote ' is never closed", name);
    expect_error(&f, RUN(&f, word), expected);
    write_file(name, "\"abc\\\"");
    snprintf(expected, sizeof expected, "%s:1: the quote \" is never closed", name);
    expect_error(&f, RUN(&f, word), expected);

    /* Twice itself: found before it has doubled out of memory. */
    snprintf(text, sizeof text, "@%s @%s", name, name);
    write_file(name, text);
    assert_int_equal(RUN(&f, word), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(f.c.text, "is one replacement too many: does it lead back to itself?"));
    /* The places on the way to it make no tapeworm. */
    assert_true(strlen(f.c.text) < 1000);
    setenv("GRAZE_TEST", "a $GRAZE_TEST", 1);
    assert_int_equal(RUN(&f, "$GRAZE_TEST"), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(f.c.text, "'$GRAZE_TEST' is one replacement too many"));
    /* 31 files of one word each, side by side, are nothing odd. */
    write_file(name, "-i");
    setenv("GRAZE_TEST", "", 1);
    for (int i = 0; i < 31; i++) {
        char *all = getenv("GRAZE_TEST"), longer[4096];
        snprintf(longer, sizeof longer, "%s %s", all, word);
        setenv("GRAZE_TEST", longer, 1);
    }
    assert_int_equal(RUN(&f, "$GRAZE_TEST"), GRAZE_OK);
    assert_true(f.s.irradiance);

    FILE *file = fopen(name, "wb");
    assert_int_equal(fwrite("-i\0", 1, 3, file), 3);
    fclose(file);
    assert_int_equal(RUN(&f, word), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(f.c.text, "zero bytes"));
    unlink(name);
    end(&f);
}

static void test_long_file(void **state) {
    (void)state;
    char name[] = "/tmp/graze-options-XXXXXX", word[64];
    close(mkstemp(name));
    FILE *file = fopen(name, "w");
    for (int i = 0; i < 20000; i++)
        fprintf(file, "scene%d.rad\n", i);
    fclose(file);
    snprintf(word, sizeof word, "@%s", name);
    fixture f;
    begin(&f);
    assert_int_equal(RUN(&f, word), GRAZE_OK);
    assert_int_equal(f.count, 20000);
    assert_string_equal(f.operands[19999], "scene19999.rad");
    unlink(name);
    end(&f);
}

static void test_command_line(void **state) {
    (void)state;
    char *words[] = {"gtrace", "-av",        ".1",  "@opts", "!gen a | cat", "it's",   "",
                     "$X",     "two\nlines", "~/a", "#x",    "a*",           "x=1:2%^"};
    char buffer[256];
    options_command_line(buffer, sizeof buffer, 13, words);
    assert_string_equal(buffer,
                        "gtrace -av .1 @opts '!gen a | cat' 'it'\\''s' '' '$X' 'two lines' '~/a' '#x' 'a*' x=1:2%^");
    options_command_line(buffer, 10, 13, words);
    assert_string_equal(buffer, "gtrace -a");
    options_command_line(buffer, 1, 13, words);
    assert_string_equal(buffer, "");
    buffer[0] = 'x';
    options_command_line(buffer, 0, 13, words);
    assert_int_equal(buffer[0], 'x');
}

/* What a file of options gives back as it was. */
static void test_print_word(void **state) {
    (void)state;
    static const struct {
        const char *word, *printed;
    } cases[] = {
        {"a@b", "a@b"}, {"@a", "'@a'"},        {"@", "'@'"}, {"$a", "'$a'"}, {"", "''"}, {"two\nlines", "'two\nlines'"},
        {"#a", "'#a'"}, {"it's", "'it'\\''s'"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = NULL;
        size_t length;
        FILE *out = open_memstream(&text, &length);
        options_print_word(out, cases[i].word);
        fclose(out);
        assert_string_equal(text, cases[i].printed);
        setenv("GRAZE_TEST", text, 1);
        free(text);
        fixture f;
        begin(&f);
        assert_int_equal(RUN(&f, "$GRAZE_TEST"), GRAZE_OK);
        assert_int_equal(f.count, 1);
        assert_string_equal(f.operands[0], cases[i].word);
        end(&f);
    }
}

/* What a report to standard error writes there of an error with this text, behind "gtest: error: ". */
static void write_error(char *written, size_t size, const char *text) {
    FILE *file = tmpfile();
    int saved = dup(STDERR_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    graze_report report = options_standard_error_report("gtest");
    report_error(&report, NULL, "%s", text);
    report_warning(&report, &(place){.file = "a.rad", .line = 1}, "odd");
    dup2(saved, STDERR_FILENO);
    close(saved);
    rewind(file);
    written[fread(written, 1, size - 1, file)] = 0;
    fclose(file);
}

static void test_standard_error_report(void **state) {
    (void)state;
    static const struct {
        const char *text, *written;
    } cases[] = {
        {"bad", "bad"},
        {"T\xc3\xbcr \xe2\x80\x93 \xf0\x9d\x94\xbc", "T\xc3\xbcr \xe2\x80\x93 \xf0\x9d\x94\xbc"},
        {"\033[31m\a\b\r\n\t\177 \x1f", "\\x1B[31m\\x07\\x08\\x0D\\x0A\\x09\\x7F \\x1F"},
        {"\x9b\x31m \xc2\x9b\x31m \xc2\xa0", "\\x9B\x31m \\xC2\\x9B\x31m \xc2\xa0"},
        {"T\xfcr \xc3", "T\\xFCr \\xC3"},
        {"\xe2\x80 \xe0\x82\x9b \xf0\x80\x82\x9b \xf5\x80\x80\x80 \xc1\x9b",
         "\\xE2\\x80 \\xE0\\x82\\x9B \\xF0\\x80\\x82\\x9B \\xF5\\x80\\x80\\x80 \\xC1\\x9B"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char written[512], expected[512];
        write_error(written, sizeof written, cases[i].text);
        snprintf(expected, sizeof expected, "gtest: error: %s\ngtest: warning: a.rad:1: odd\n", cases[i].written);
        assert_string_equal(written, expected);
    }
}

/* Longer than what is written at once. */
static void test_long_standard_error_report(void **state) {
    (void)state;
    enum { LENGTH = 3000 };
    char text[LENGTH + 1] = "", written[4 * LENGTH + 64], expected[sizeof written] = "gtest: error: ";
    for (size_t i = 0; i < LENGTH; i++) {
        text[i] = i % 7 ? (char)('a' + i % 26) : '\033';
        strcat(expected, i % 7 ? (char[]){text[i], 0} : "\\x1B");
    }
    strcat(expected, "\ngtest: warning: a.rad:1: odd\n");
    write_error(written, sizeof written, text);
    assert_string_equal(written, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_flags),
        cmocka_unit_test(test_long_options),
        cmocka_unit_test(test_longest_name_wins),
        cmocka_unit_test(test_operands),
        cmocka_unit_test(test_errors),
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_defaults_are_readable),
        cmocka_unit_test(test_handled_suffix),
        cmocka_unit_test(test_help),
        cmocka_unit_test(test_full_output),
        cmocka_unit_test(test_files_and_variables),
        cmocka_unit_test(test_bad_files_and_variables),
        cmocka_unit_test(test_long_file),
        cmocka_unit_test(test_command_line),
        cmocka_unit_test(test_print_word),
        cmocka_unit_test(test_standard_error_report),
        cmocka_unit_test(test_long_standard_error_report),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
