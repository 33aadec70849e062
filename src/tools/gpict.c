/* gpict: a picture of a scene, in rpict's manners. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/formats.h"
#include "image/image.h"
#include "picture/picture.h"
#include "tools/common/picture_header.h"
#include "tools/common/render_options.h"
#include "tools/common/tool.h"

/* Entries of the option table that are gpict's own. */
#define GPICT_OPTION_COUNT 24
#define OUTPUT_LIMIT       8

/* Files to write besides or instead of standard output. */
typedef struct outputs {
    const char *files[OUTPUT_LIMIT];
    int count;
} outputs;

typedef struct gpict_options {
    render_options render;
    rad_view view;
    int width, height;
    double pixel_aspect, jitter, exposure, sample_spacing, sample_tolerance;
    bool progress;
    outputs pictures;
    const char *contours;
    int contours_per_decade;
} gpict_options;

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

static graze_status take_output(void *target, const char *suffix, int count, const char *const *words, int *used,
                                const graze_report *report) {
    outputs *o = target;
    if (*suffix || count < 1)
        return report_error(report, NULL, "option '-o' needs the name of a file");
    if (o->count == OUTPUT_LIMIT)
        return report_error(report, NULL, "-o may be given %d times at most", OUTPUT_LIMIT);
    *used = 1;
    o->files[o->count++] = words[0];
    return GRAZE_OK;
}

static graze_status check_outputs(const gpict_options *o, const graze_report *report) {
    for (int i = 0; i < o->pictures.count; i++) {
        const char *file = o->pictures.files[i];
        bool again = strcmp(file, o->contours) == 0;
        for (int j = 0; j < i; j++)
            again = again || strcmp(file, o->pictures.files[j]) == 0;
        if (again)
            return report_error(report, NULL, "%s is to be written twice", file);
        graze_status status = image_check_writable(file, report);
        if (status != GRAZE_OK)
            return status;
    }
    return *o->contours ? image_check_writable(o->contours, report) : GRAZE_OK;
}

/* Once the view has given the size. A picture with contours has its legend besides. */
static graze_status check_sizes(const gpict_options *o, const picture_settings *picture, const graze_report *report) {
    graze_status status = GRAZE_OK;
    for (int i = 0; i < o->pictures.count && status == GRAZE_OK; i++)
        status = image_check_size(o->pictures.files[i], picture->width, picture->height, report);
    if (status == GRAZE_OK && *o->contours)
        status = image_check_size(o->contours, picture->width, picture->height, report);
    return status;
}

static graze_status write_outputs(const gpict_options *o, const image *picture, const graze_report *report) {
    graze_status worst = GRAZE_OK;
    for (int i = 0; i < o->pictures.count; i++) {
        graze_status status = image_write(picture, o->pictures.files[i], report);
        worst = status > worst ? status : worst;
    }
    if (*o->contours) {
        graze_status status = image_write_contours(picture, o->contours, o->contours_per_decade, report);
        worst = status > worst ? status : worst;
    }
    if (o->pictures.count == 0 && !*o->contours)
        worst = image_write_hdr(picture, stdout, "standard output", report);
    return worst;
}

static bool needs_layers(const gpict_options *o) {
    for (int i = 0; i < o->pictures.count; i++)
        if (image_format_of(o->pictures.files[i]) == IMAGE_FORMAT_EXR)
            return true;
    return false;
}

/* Gives the picture its header, writes it, and says what --max-samples cut short. */
static graze_status finish(const gpict_options *o, const picture_settings *settings, image *picture, size_t unconverged,
                           const tool_arguments *arguments, const graze_report *report) {
    char view[512];
    picture_header header;
    rad_view_print(&settings->view, view, sizeof view);
    picture->view = view;
    picture_header_set(&header, picture, arguments);
    picture->display_exposure = o->exposure;
    if (unconverged)
        report_warning(report, NULL, "%zu of %zu pixels reached --max-samples before --error", unconverged,
                       (size_t)settings->width * (size_t)settings->height);
    return write_outputs(o, picture, report);
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *full_report) {
    const gpict_options *o = user;
    const graze_report quiet = tool_report(full_report, o->render.warnings), *report = &quiet;
    picture_settings picture = {.view = o->view,
                                .width = o->width,
                                .height = o->height,
                                .pixel_aspect = o->pixel_aspect,
                                .jitter = o->jitter,
                                .layers = needs_layers(o),
                                .threads = o->render.threads,
                                .progress = o->progress};
    const graze_scene_settings build = render_options_scene(&o->render);
    graze_trace_settings settings;
    graze_scene *scene = NULL;
    image *result = NULL;
    size_t unconverged = 0;
    graze_status status = render_options_begin(&o->render, arguments, report);
    if (status == GRAZE_OK && o->render.color.space != OUTPUT_RGB)
        status = report_error(report, NULL, "pictures are in Radiance's red, green and blue: -pRGB");
    if (status == GRAZE_OK)
        status = render_options_settings(&o->render, false, &settings, report);
    if (status == GRAZE_OK)
        status = rad_view_prepare(&picture.view, report);
    if (status == GRAZE_OK)
        status = check_outputs(o, report);
    if (status == GRAZE_OK)
        status = tool_check_scenes(arguments, false, report);
    if (status == GRAZE_OK) {
        rad_view_fit(&picture.view, &picture.pixel_aspect, &picture.width, &picture.height);
        status = check_sizes(o, &picture, report);
    }
    if (status == GRAZE_OK)
        status = graze_scene_load(&scene, arguments->operands, (size_t)arguments->operand_count, &build, report);
    if (status == GRAZE_OK)
        status = picture_render(&result, scene, &settings, &picture, &unconverged, report);
    if (status == GRAZE_OK)
        status = finish(o, &picture, result, unconverged, arguments, report);
    image_destroy(result);
    graze_scene_destroy(scene);
    return status;
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("gpict");
    gpict_options o = {.render = render_options_default(0.05),
                       .view = rad_view_default(),
                       .width = 512,
                       .height = 512,
                       .pixel_aspect = 1,
                       .jitter = 1,
                       .progress = true,
                       .contours = "",
                       .sample_spacing = 4,
                       .sample_tolerance = .05,
                       .contours_per_decade = 4};
    option table[GPICT_OPTION_COUNT + RENDER_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "View", 0, 0, NULL, NULL},
        {"-vf", OPTION_CUSTOM, &o.view, "FILE", "the view of a view file or picture", 0, 0, take_view_file, NULL},
        {"-vt", OPTION_SUFFIX, &o.view, "T", "type, as in -vtv: v perspective, l parallel, c h a s", 0, 0,
         take_view_type, print_view_type},
        {"-vp", OPTION_REAL3, &o.view.point, "X Y Z", "view point", 0, 0, NULL, NULL},
        {"-vd", OPTION_REAL3, &o.view.direction, "X Y Z", "view direction", 0, 0, NULL, NULL},
        {"-vu", OPTION_REAL3, &o.view.up, "X Y Z", "up", 0, 0, NULL, NULL},
        {"-vh", OPTION_REAL, &o.view.horizontal, "V", "horizontal size, degrees or length", 0, 0, NULL, NULL},
        {"-vv", OPTION_REAL, &o.view.vertical, "V", "vertical size", 0, 0, NULL, NULL},
        {"-vs", OPTION_REAL, &o.view.shift, "V", "shift to the right, in pictures", 0, 0, NULL, NULL},
        {"-vl", OPTION_REAL, &o.view.lift, "V", "lift", 0, 0, NULL, NULL},
        {"-vo", OPTION_REAL, &o.view.fore, "V", "fore clipping distance", 0, 0, NULL, NULL},
        {"-va", OPTION_REAL, &o.view.aft, "V", "aft clipping distance; 0: none", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Picture", 0, 0, NULL, NULL},
        {"-x", OPTION_INTEGER, &o.width, "N", "largest width in pixels", 1, 1 << 20, NULL, NULL},
        {"-y", OPTION_INTEGER, &o.height, "N", "largest height in pixels", 1, 1 << 20, NULL, NULL},
        {"-pa", OPTION_REAL, &o.pixel_aspect, "R", "pixel height over width; 0: what -x and -y give", 0, 1000, NULL,
         NULL},
        {"-pj", OPTION_REAL, &o.jitter, "R", "part of a pixel that its samples spread over", 0, 1, NULL, NULL},
        {"-o", OPTION_CUSTOM, &o.pictures, "FILE", "write FILE.hdr, .exr or .png ... instead of standard output", 0, 0,
         take_output, NULL},
        {"--exposure", OPTION_REAL, &o.exposure, "E", "factor for 8-bit pictures; 0: by the picture", 0, INFINITY, NULL,
         NULL},
        {"--contours", OPTION_TEXT, &o.contours, "FILE", "write a picture with lines of equal luminance", 0, 0, NULL,
         NULL},
        {"--contours-per-decade", OPTION_INTEGER, &o.contours_per_decade, "N", "lines for a factor of ten in luminance",
         1, 20, NULL, NULL},
        {"-ps", OPTION_REAL, &o.sample_spacing, "N", "without effect: every pixel is sampled", 0, INFINITY, NULL, NULL},
        {"-pt", OPTION_REAL, &o.sample_tolerance, "R", "without effect: nothing is interpolated", 0, INFINITY, NULL,
         NULL},
        {"--progress", OPTION_FLAG, &o.progress, NULL, "progress bar on a terminal", 0, 0, NULL, NULL},
    };
    render_options_table(&o.render, table + GPICT_OPTION_COUNT);
    option_table options = {.program = "gpict",
                            .synopsis = "[options] scene...",
                            .summary = "Renders pictures of Radiance scenes to a stated error.",
                            .options = table,
                            .count = GPICT_OPTION_COUNT + RENDER_OPTION_COUNT};
    int status = tool_main(&options, argc, argv, &report, run, &o);
    render_options_free(&o.render);
    return status;
}
