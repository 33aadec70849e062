/* The table of gpict's options. */
#define _POSIX_C_SOURCE 200809L
#include "tools/gpict/options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

gpict_options gpict_options_default(void) {
    return (gpict_options){
        .render = render_options_default(0.05),
        .view = rad_view_default(),
        .width = 512,
        .height = 512,
        .spacing = 4,
        .pixel_aspect = 1,
        .jitter = 1,
        .tolerance = 0.05,
        .contours = "",
        .contours_per_decade = 4,
        .depth = "",
        .recover = "",
        .checkpoint = "",
        .preview = "",
        .checkpoint_interval = 60,
        .progress = true,
    };
}

static graze_status take_view_type(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    (void)count, (void)words;
    char word[16];
    snprintf(word, sizeof word, "-vt%s", suffix);
    const char *option_words[] = {word};
    int type_words;
    *used = 0;
    return rad_view_option(target, 1, option_words, &type_words, NULL, report);
}

static graze_status take_view_file(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    if (*suffix || count < 1)
        return report_error(report, NULL, "option '-vf' needs the name of a view file or picture");
    *used = 1;
    return rad_view_read(target, words[0], report);
}

static void print_view_type(void *target, FILE *out) {
    fprintf(out, "-vt%c", ((const rad_view *)target)->type);
}

static graze_status add_output(outputs *o, const char *file, const graze_report *report) {
    if (o->count == OUTPUT_LIMIT)
        return report_error(report, NULL, "-o may be given %d times at most", OUTPUT_LIMIT);
    o->files[o->count++] = file;
    return GRAZE_OK;
}

static graze_status take_output(void *target, const char *suffix, int count, const char *const *words, int *used,
                                const graze_report *report) {
    if (*suffix || count < 1)
        return report_error(report, NULL, "option '-o' needs the name of a file");
    *used = 1;
    return add_output(&((gpict_options *)target)->pictures, words[0], report);
}

/* A picture that -ro names is printed there. */
static void print_outputs(void *target, FILE *out) {
    const gpict_options *o = target;
    const char *before = "";
    for (int i = 0; i < o->pictures.count; i++) {
        if (o->recover_output && o->pictures.files[i] == o->recover)
            continue;
        fprintf(out, "%s-o ", before);
        options_print_word(out, o->pictures.files[i]);
        before = " ";
    }
}

static void print_recover(void *target, FILE *out) {
    const gpict_options *o = target;
    if (!*o->recover)
        return;
    fputs(o->recover_output ? "-ro " : "-r ", out);
    options_print_word(out, o->recover);
}

static graze_status take_recover(void *target, const char *suffix, int count, const char *const *words, int *used,
                                 const graze_report *report) {
    gpict_options *o = target;
    if (*suffix)
        return report_error(report, NULL, "unknown option '-r%s'", suffix);
    if (count < 1)
        return report_error(report, NULL, "options '-r' and '-ro' need the name of a picture that was begun");
    *used = 1;
    o->recover = words[0];
    o->recover_output = false;
    return GRAZE_OK;
}

static graze_status take_recover_output(void *target, const char *suffix, int count, const char *const *words,
                                        int *used, const graze_report *report) {
    gpict_options *o = target;
    graze_status status = take_recover(o, suffix, count, words, used, report);
    if (status != GRAZE_OK)
        return status;
    o->recover_output = true;
    return add_output(&o->pictures, words[0], report);
}

void gpict_options_table(gpict_options *o, option table[GPICT_TABLE_SIZE]) {
    const option options[GPICT_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "View", 0, 0, NULL, NULL},
        {"-vf", OPTION_CUSTOM, &o->view, "FILE", "the view of a view file or picture", 0, 0, take_view_file, NULL},
        {"-vt", OPTION_SUFFIX, &o->view, "T", "type, as in -vtv: v perspective, l parallel, c h a s", 0, 0,
         take_view_type, print_view_type},
        {"-vp", OPTION_REAL3, &o->view.point, "X Y Z", "view point", 0, 0, NULL, NULL},
        {"-vd", OPTION_REAL3, &o->view.direction, "X Y Z", "view direction", 0, 0, NULL, NULL},
        {"-vu", OPTION_REAL3, &o->view.up, "X Y Z", "up", 0, 0, NULL, NULL},
        {"-vh", OPTION_REAL, &o->view.horizontal, "V", "horizontal size, degrees or length", 0, 0, NULL, NULL},
        {"-vv", OPTION_REAL, &o->view.vertical, "V", "vertical size", 0, 0, NULL, NULL},
        {"-vs", OPTION_REAL, &o->view.shift, "V", "shift to the right, in pictures", 0, 0, NULL, NULL},
        {"-vl", OPTION_REAL, &o->view.lift, "V", "lift", 0, 0, NULL, NULL},
        {"-vo", OPTION_REAL, &o->view.fore, "V", "fore clipping distance", 0, 0, NULL, NULL},
        {"-va", OPTION_REAL, &o->view.aft, "V", "aft clipping distance; 0: none", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Picture", 0, 0, NULL, NULL},
        {"-x", OPTION_INTEGER, &o->width, "N", "largest width in pixels", 1, 1 << 20, NULL, NULL},
        {"-y", OPTION_INTEGER, &o->height, "N", "largest height in pixels", 1, 1 << 20, NULL, NULL},
        {"-pa", OPTION_REAL, &o->pixel_aspect, "R", "pixel height over width; 0: what -x and -y give", 0, 1000, NULL,
         NULL},
        {"-pj", OPTION_REAL, &o->jitter, "R", "part of a pixel that its samples spread over", 0, 1, NULL, NULL},
        {"-pd", OPTION_REAL, &o->aperture, "D", "lens diameter; in focus at the length of -vd", 0, 1e100, NULL, NULL},
        {"-pm", OPTION_REAL, &o->shutter, "R", "part of a frame's time that the shutter is open (-S)", 0, 2, NULL,
         NULL},
        {"-ps", OPTION_INTEGER, &o->spacing, "N", "pixels this far apart come first, 1 to 16; the picture is the same",
         0, 0, NULL, NULL},
        {"-pt", OPTION_REAL, &o->tolerance, "R", "without effect: pixels are not interpolated", 0, INFINITY, NULL,
         NULL},
        {"-S", OPTION_INTEGER, &o->first_frame, "N",
         "a picture for each view on standard input, from frame N on; 0: one picture", 0, 1000000000, NULL, NULL},
        {"-o", OPTION_CUSTOM, o, "FILE", "write FILE.hdr, .exr or .png ... instead of standard output", 0, 0,
         take_output, print_outputs},
        {"-z", OPTION_TEXT, &o->depth, "FILE", "write distances, as native floats", 0, 0, NULL, NULL},
        {"--exposure", OPTION_REAL, &o->exposure, "E", "factor for 8-bit pictures; 0: by the picture", 0, INFINITY,
         NULL, NULL},
        {"--contours", OPTION_TEXT, &o->contours, "FILE", "write a picture with lines of equal luminance", 0, 0, NULL,
         NULL},
        {"--contours-per-decade", OPTION_INTEGER, &o->contours_per_decade, "N",
         "lines for a factor of ten in luminance", 1, 20, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "On the way", 0, 0, NULL, NULL},
        {"-r", OPTION_CUSTOM, o, "FILE", "go on with a picture that was begun", 0, 0, take_recover, print_recover},
        {"-ro", OPTION_CUSTOM, o, "FILE", "the same, and -o FILE", 0, 0, take_recover_output, NULL},
        {"--checkpoint", OPTION_TEXT, &o->checkpoint, "FILE", "of what is done; else OUTPUT.checkpoint", 0, 0, NULL,
         NULL},
        {"--checkpoint-interval", OPTION_REAL, &o->checkpoint_interval, "S", "seconds between checkpoints; 0: none", 0,
         1e9, NULL, NULL},
        {"--preview", OPTION_TEXT, &o->preview, "FILE", "for the preview that SIGUSR1 asks for; else OUTPUT.preview.*",
         0, 0, NULL, NULL},
        {"--preview-interval", OPTION_REAL, &o->preview_interval, "S", "seconds between previews; 0: none", 0, 1e9,
         NULL, NULL},
        {"-t", OPTION_INTEGER, &o->report_interval, "S", "seconds between lines of progress; 0: none", 0, 1000000000,
         NULL, NULL},
        {"--progress", OPTION_FLAG, &o->progress, NULL, "progress bar on a terminal", 0, 0, NULL, NULL},
    };
    memcpy(table, options, sizeof options);
    render_options_table(&o->render, table + GPICT_OPTION_COUNT);
}

/* Options that change no pixel: where pictures go, what is told on the way, and the view and size, which a checkpoint
 * has itself. */
static bool is_beside(const char *name) {
    static const char *const names[] = {
        "-x",           "-y",
        "-pa",          "-ps",
        "-pt",          "-S",
        "-o",           "-z",
        "-r",           "-ro",
        "-t",           "-n",
        "-w",           "--exposure",
        "--contours",   "--contours-per-decade",
        "--checkpoint", "--checkpoint-interval",
        "--preview",    "--preview-interval",
        "--progress",
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0)
            return true;
    return strncmp(name, "-v", 2) == 0;
}

char *gpict_options_question(const gpict_options *given) {
    gpict_options o = *given;
    option table[GPICT_TABLE_SIZE];
    o.render = render_options_in_effect(&given->render);
    gpict_options_table(&o, table);
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    bool good = true;
    for (int i = 0; i < GPICT_TABLE_SIZE && good; i++) {
        if (is_beside(table[i].name))
            continue;
        char *value = options_value(&table[i]);
        good = value != NULL;
        if (good && *value)
            fprintf(out, "%s\n", value);
        free(value);
    }
    good = fclose(out) == 0 && good;
    if (good)
        return text;
    free(text);
    return NULL;
}
