/* Names, checks and writing of a picture's files. */
#include "tools/gpict/files.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "image/formats.h"
#include "image/output.h"
#include "picture/checkpoint.h"
#include "tools/gpict/depth_file.h"
#include "tools/gpict/names.h"

/* A text's whole number, or -1. */
static int frame_number(const char *text) {
    int number;
    return text_to_integer(text, &number) && number > 0 ? number : -1;
}

/* The checkpoint of a picture; or the file itself, if it is one. */
static const char *checkpoint_of(arena *memory, const char *file) {
    const char *beside = name_of_checkpoint(memory, file);
    return beside && access(beside, F_OK) != 0 && checkpoint_is(file) ? file : beside;
}

/* What -r means for this frame. In a sequence it may be the number of the frame that goes on, or a name with %d: then
 * each frame goes on that has been begun. */
static bool find_recover(picture_files *f, arena *memory, const gpict_options *o, int number) {
    int wanted = number > 0 ? frame_number(o->recover) : -1;
    if (!*o->recover || (wanted > 0 && wanted != number))
        return true;
    const char *file = wanted > 0 && f->count > 0 ? f->pictures[0] : name_of_frame(memory, o->recover, number);
    f->begun = file;
    f->recover = file ? checkpoint_of(memory, file) : NULL;
    if (!f->recover)
        return false;
    if (number > 0 && wanted < 0 && access(f->recover, F_OK) != 0)
        f->recover = NULL;
    return true;
}

static bool is_same(const char *a, const char *b) {
    return a && b && strcmp(a, b) == 0;
}

/* Whether something else is to be written there. */
static bool is_taken(const picture_files *f, const char *file) {
    for (int i = 0; i < f->count; i++)
        if (is_same(file, f->pictures[i]))
            return true;
    return is_same(file, f->contours) || is_same(file, f->depth) || is_same(file, f->checkpoint);
}

static bool find_beside(picture_files *f, arena *memory, const gpict_options *o, int number) {
    const char *first = f->count > 0 && !image_output_is_special(f->pictures[0]) ? f->pictures[0] : NULL;
    f->checkpoint = *o->checkpoint ? name_of_frame(memory, o->checkpoint, number)
                    : f->recover   ? f->recover
                    : first        ? name_of_checkpoint(memory, first)
                                   : NULL;
    f->preview = *o->preview ? name_of_frame(memory, o->preview, number)
                 : first     ? name_of_preview(memory, first)
                             : NULL;
    bool good = (f->checkpoint || !(*o->checkpoint || first)) && (f->preview || !(*o->preview || first));
    /* A preview that nobody may ever ask for makes no mistake of a name. */
    if (!f->preview_wanted && is_taken(f, f->preview))
        f->preview = NULL;
    return good;
}

graze_status files_find(picture_files *f, arena *memory, const gpict_options *o, int number,
                        const graze_report *report) {
    *f = (picture_files){.count = o->pictures.count, .preview_wanted = *o->preview || o->preview_interval > 0};
    bool good = true;
    for (int i = 0; i < f->count; i++) {
        f->pictures[i] = name_of_frame(memory, o->pictures.files[i], number);
        good = good && f->pictures[i];
    }
    if (*o->contours)
        good = (f->contours = name_of_frame(memory, o->contours, number)) && good;
    if (*o->depth)
        good = (f->depth = name_of_frame(memory, o->depth, number)) && good;
    good = good && find_recover(f, memory, o, number) && find_beside(f, memory, o, number);
    return good ? GRAZE_OK : report_out_of_memory(report);
}

/* The user named a picture, so the message does not begin with a name that they never wrote. */
static graze_status check_recover(const picture_files *f, const graze_report *report) {
    if (!f->recover || access(f->recover, F_OK) == 0 || errno != ENOENT)
        return GRAZE_OK;
    const place where = {.file = f->begun};
    if (access(f->begun, F_OK) != 0)
        return report_error(report, &where, "nothing to go on with: neither it nor its checkpoint, %s, is there",
                            f->recover);
    return report_error(report, &where,
                        "nothing to go on with: it has no checkpoint beside it, %s, and is none itself, or one whose "
                        "beginning is damaged; a picture without a checkpoint is finished",
                        f->recover);
}

/* A checkpoint replaces nothing but a checkpoint. */
static graze_status check_checkpoint(const char *file, const graze_report *report) {
    if (access(file, F_OK) == 0 && !checkpoint_is(file))
        return report_error(report, &(place){.file = file}, "is there, and is no checkpoint");
    return image_output_check(file, report);
}

graze_status files_check(const picture_files *f, const graze_report *report) {
    const char *files[OUTPUT_LIMIT + 5];
    int count = 0;
    graze_status status = check_recover(f, report);
    for (int i = 0; i < f->count; i++)
        files[count++] = f->pictures[i];
    if (f->contours)
        files[count++] = f->contours;
    for (int i = 0; i < count && status == GRAZE_OK; i++)
        status = image_check_writable(files[i], report);
    if (status == GRAZE_OK && f->depth) {
        files[count++] = f->depth;
        status = image_output_check(f->depth, report);
    }
    if (status == GRAZE_OK && f->checkpoint) {
        files[count++] = f->checkpoint;
        status = check_checkpoint(f->checkpoint, report);
    }
    if (f->preview_wanted && f->preview)
        files[count++] = f->preview;
    for (int i = 0; i < count && status == GRAZE_OK; i++)
        for (int j = 0; j < i && status == GRAZE_OK; j++)
            if (is_same(files[i], files[j]))
                status = report_error(report, NULL, "%s is to be written twice", files[i]);
    if (status == GRAZE_OK && f->preview_wanted)
        status = f->preview ? image_check_writable(f->preview, report)
                            : report_error(report, NULL, "--preview-interval needs --preview, or a picture in a file");
    return status;
}

graze_status files_check_size(const picture_files *f, int width, int height, const graze_report *report) {
    graze_status status = GRAZE_OK;
    for (int i = 0; i < f->count && status == GRAZE_OK; i++)
        status = image_check_size(f->pictures[i], width, height, report);
    /* A picture with contours has its legend besides. */
    if (status == GRAZE_OK && f->contours)
        status = image_check_size(f->contours, width, height, report);
    return status;
}

bool files_are_there(const picture_files *f) {
    for (int i = 0; i < f->count; i++)
        if (access(f->pictures[i], F_OK) != 0)
            return false;
    return f->count > 0;
}

picture_content files_content(const picture_files *f) {
    for (int i = 0; i < f->count; i++)
        if (image_format_of(f->pictures[i]) == IMAGE_FORMAT_EXR)
            return PICTURE_LAYERS;
    return f->depth ? PICTURE_DEPTH : PICTURE_COLOR;
}

static void note(graze_status *worst, graze_status status) {
    *worst = status > *worst ? status : *worst;
}

/* Radiance's format in the colours of -p, which others do not know: they have Radiance's own. */
static graze_status write_hdr(const image *picture, const char *file, const output_color_option *colors,
                              const graze_report *report) {
    const output_color color = output_color_prepare(colors);
    image *converted = image_create(picture->width, picture->height, 3, NULL);
    if (!converted)
        return report_out_of_memory(report);
    size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; i++) {
        double value[3];
        output_color_value(&color, (rgb){picture->channels[0][i], picture->channels[1][i], picture->channels[2][i]},
                           value);
        for (int c = 0; c < 3; c++)
            converted->channels[c][i] = number_to_float(value[c]);
    }
    converted->pixel_aspect = picture->pixel_aspect;
    converted->view = picture->view;
    converted->command = picture->command;
    converted->software = picture->software;
    converted->frame = picture->frame;
    converted->xyz = color.space == OUTPUT_XYZ;
    converted->primaries = color.primaries;
    graze_status status =
        file ? image_write(converted, file, report) : image_write_hdr(converted, stdout, "standard output", report);
    image_destroy(converted);
    return status;
}

graze_status files_write(const picture_files *f, const gpict_options *o, const image *picture,
                         const graze_report *report) {
    graze_status worst = GRAZE_OK;
    bool own = o->render.color.space != OUTPUT_RGB;
    for (int i = 0; i < f->count; i++) {
        const char *file = f->pictures[i];
        bool hdr = own && image_format_of(file) == IMAGE_FORMAT_HDR;
        note(&worst, hdr ? write_hdr(picture, file, &o->render.color, report) : image_write(picture, file, report));
    }
    if (f->contours)
        note(&worst, image_write_contours(picture, f->contours, o->contours_per_decade, report));
    if (f->depth)
        note(&worst, depth_file_write(image_channel(picture, "depth.Z"),
                                      (size_t)picture->width * (size_t)picture->height, f->depth, report));
    if (f->count == 0 && !f->contours)
        note(&worst, own ? write_hdr(picture, NULL, &o->render.color, report)
                         : image_write_hdr(picture, stdout, "standard output", report));
    return worst;
}
