/* A picture: its files, its rendering, its end. */
#include "tools/gpict/shot.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "picture/checkpoint.h"
#include "scene/fingerprint.h"
#include "tools/gpict/files.h"
#include "tools/gpict/watch.h"

struct shot {
    arena *memory;
    const gpict_options *options;
    int number;
    picture_files files;
    picture_settings settings;
    checkpoint *begun;               /* null: nothing to go on with */
    char command[TOOL_COMMAND_SIZE]; /* that the picture was begun with */
    char view[512];
};

/* ---- Before ---- */

/* Two views, both prepared, that look the same way. */
static bool same_view(const rad_view *a, const rad_view *b) {
    return a->type == b->type && vec3_is_same(a->point, b->point) && vec3_is_same(a->axis, b->axis) &&
           vec3_is_same(a->right, b->right) && vec3_is_same(a->above, b->above) && a->shift == b->shift &&
           a->lift == b->lift && a->fore == b->fore && a->aft == b->aft && a->horizontal == b->horizontal &&
           a->vertical == b->vertical;
}

static bool is_default_view(const gpict_options *o) {
    rad_view plain = rad_view_default(), given = o->view;
    return rad_view_prepare(&plain, NULL, NULL) == GRAZE_OK && rad_view_prepare(&given, NULL, NULL) == GRAZE_OK &&
           same_view(&plain, &given);
}

static bool is_default_size(const gpict_options *o) {
    gpict_options plain = gpict_options_default();
    return o->width == plain.width && o->height == plain.height && o->pixel_aspect == plain.pixel_aspect;
}

/* View and size are the checkpoint's. If others were asked for, that is a mistake. */
static graze_status take_over(shot *f, const graze_report *report) {
    const gpict_options *o = f->options;
    const place where = {.file = f->files.recover};
    rad_view wanted = f->settings.view;
    checkpoint_settings(f->begun, &f->settings);
    const picture_settings *begun = &f->settings;
    if ((f->number > 0 || !is_default_view(o)) && !same_view(&wanted, &begun->view))
        return report_error(report, &where, "this picture was begun with another view");
    int width = o->width, height = o->height;
    double aspect = o->pixel_aspect;
    rad_view_fit(&begun->view, &aspect, &width, &height);
    if (is_default_size(o) || (width == begun->width && height == begun->height))
        return GRAZE_OK;
    return report_error(report, &where, "this picture was begun as %d x %d pixels and cannot go on as %d x %d",
                        begun->width, begun->height, width, height);
}

static graze_status recover(shot *f, const graze_report *report) {
    graze_status status = checkpoint_read(&f->begun, f->files.recover, report);
    if (status == GRAZE_OK)
        status = take_over(f, report);
    if (status == GRAZE_OK)
        snprintf(f->command, sizeof f->command, "%s", checkpoint_command(f->begun));
    return status;
}

static graze_status prepare(shot *f, const job *j) {
    const gpict_options *o = f->options;
    picture_settings *s = &f->settings;
    graze_status status = files_check(&f->files, j->report);
    s->width = o->width;
    s->height = o->height;
    s->pixel_aspect = o->pixel_aspect;
    s->jitter = o->jitter;
    s->aperture = o->aperture;
    s->spacing = o->spacing;
    s->content = files_content(&f->files);
    s->without_cache = o->render.ambient_accuracy == 0;
    s->threads = o->render.threads;
    if (status == GRAZE_OK)
        status = rad_view_prepare(&s->view, NULL, j->report);
    if (status == GRAZE_OK)
        rad_view_fit(&s->view, &s->pixel_aspect, &s->width, &s->height);
    options_command_line(f->command, sizeof f->command, j->arguments->argc, j->arguments->argv);
    if (status == GRAZE_OK && f->files.recover)
        status = recover(f, j->report);
    return status != GRAZE_OK ? status : files_check_size(&f->files, s->width, s->height, j->report);
}

graze_status shot_prepare(shot **out, const job *j, int number, const rad_view *view, const rad_view *previous) {
    const gpict_options *o = j->options;
    shot *f = *out = calloc(1, sizeof *f);
    if (f)
        f->memory = arena_create();
    if (!f || !f->memory) {
        shot_destroy(f);
        *out = NULL;
        return report_out_of_memory(j->report);
    }
    f->options = o;
    f->number = number;
    f->settings.view = *view;
    if (previous && o->shutter > 0) {
        f->settings.previous = *previous;
        f->settings.shutter = o->shutter;
    }
    graze_status status = files_find(&f->files, f->memory, o, number, j->report);
    /* What has its picture and no checkpoint any more is finished. */
    bool may_be_there = number > 0 || o->recover_output;
    bool there = status == GRAZE_OK && may_be_there && files_are_there(&f->files) &&
                 !(f->files.recover && checkpoint_is(f->files.recover));
    if (there)
        report_warning(j->report, &(place){.file = f->files.pictures[0]}, "this picture is there already");
    else if (status == GRAZE_OK)
        status = prepare(f, j);
    if (there || status != GRAZE_OK) {
        shot_destroy(f);
        *out = NULL;
    }
    return status;
}

void shot_destroy(shot *f) {
    if (!f)
        return;
    checkpoint_destroy(f->begun);
    arena_destroy(f->memory);
    free(f);
}

graze_status job_load(job *j) {
    if (j->scene)
        return GRAZE_OK;
    const graze_scene_settings build = render_options_scene(&j->options->render);
    return graze_scene_load(&j->scene, j->arguments->operands, (size_t)j->arguments->operand_count, &build, j->report);
}

/* ---- Rendering ---- */

/* All that the picture's bytes depend on, besides its view and size. */
static char *question_of(const shot *f, const job *j) {
    char *options = gpict_options_question(j->options), *question = NULL;
    size_t size = 0;
    FILE *out = options ? open_memstream(&question, &size) : NULL;
    if (out) {
        fprintf(out, "%s\n%sscene %016" PRIx64 "\n", TOOL_SOFTWARE, options, scene_fingerprint(j->scene));
        if (f->settings.shutter > 0) {
            char view[512];
            rad_view_print(&f->settings.previous, view, sizeof view);
            fprintf(out, "previous view%s\n", view);
        }
        if (fclose(out) != 0) {
            free(question);
            question = NULL;
        }
    }
    free(options);
    return question;
}

/* The header lines. */
static void label(shot *f, image *picture) {
    rad_view_print(&f->settings.view, f->view, sizeof f->view);
    picture->view = f->view;
    picture->command = f->command;
    picture->software = TOOL_SOFTWARE;
    picture->frame = f->number;
    picture->display_exposure = f->options->exposure;
}

/* What is needed to write a preview. */
typedef struct preview {
    shot *of;
    const rendering *picture;
} preview;

static graze_status write_preview(void *user, const graze_report *report) {
    const preview *p = user;
    image *shown;
    if (!p->of->files.preview)
        return report_error(report, NULL, "there is no file for a preview: --preview would name one");
    graze_status status = picture_preview(p->picture, &shown, report);
    if (status != GRAZE_OK)
        return status;
    label(p->of, shown);
    status = image_write(shown, p->of->files.preview, report);
    image_destroy(shown);
    return status;
}

/* Takes the picture and writes it; what cannot be written is kept in a checkpoint. */
static graze_status finish(shot *f, rendering *picture, const checkpoint_labels *labels, const graze_report *report) {
    picture_progress end = picture_look(picture);
    if (end.unconverged)
        report_warning(report, NULL, "%zu of %zu pixels reached --max-samples before --error", end.unconverged,
                       end.total);
    label(f, picture_image(picture));
    graze_status status = files_write(&f->files, f->options, picture_image(picture), report);
    const char *file = f->files.checkpoint;
    if (status == GRAZE_OK && file)
        checkpoint_remove(file);
    if (status == GRAZE_OK && f->files.recover)
        checkpoint_remove(f->files.recover);
    if (status != GRAZE_OK && file && checkpoint_write(picture, file, labels, report) == GRAZE_OK)
        report_warning(report, &(place){.file = file}, "the picture is kept here: -r goes on with it");
    return status;
}

/* A picture that a signal has stopped. */
static graze_status keep(const shot *f, const rendering *picture, const checkpoint_labels *labels,
                         const graze_report *report) {
    picture_progress now = picture_look(picture);
    graze_status status = checkpoint_write(picture, f->files.checkpoint, labels, report);
    if (status == GRAZE_OK)
        report_warning(report, NULL, "stopped at %.1f%%; -r %s goes on with the same options",
                       100 * (double)now.finished / (double)now.total, f->files.checkpoint);
    return status;
}

static graze_status render(shot *f, job *j, rendering *picture, const checkpoint_labels *labels) {
    const gpict_options *o = f->options;
    preview shown = {f, picture};
    const watch_settings settings = {
        .picture = picture,
        .checkpoint = f->files.checkpoint,
        .labels = *labels,
        .checkpoint_interval = o->checkpoint_interval,
        .preview_interval = o->preview_interval,
        .report_interval = o->report_interval,
        .bar = o->progress,
        .preview = write_preview,
        .user = &shown,
        .report = j->report,
    };
    watch *watcher;
    graze_status status = watch_start(&watcher, &settings);
    if (status != GRAZE_OK)
        return status;
    status = picture_render(picture, j->report);
    j->signal = watch_end(watcher);
    picture_progress now = picture_look(picture);
    if (status != GRAZE_OK)
        return status;
    return now.finished == now.total ? finish(f, picture, labels, j->report) : keep(f, picture, labels, j->report);
}

graze_status shot_render(shot *f, job *j) {
    rendering *picture = NULL;
    graze_status status = job_load(j);
    char *question = status == GRAZE_OK ? question_of(f, j) : NULL;
    if (status == GRAZE_OK && !question)
        status = report_out_of_memory(j->report);
    if (status == GRAZE_OK)
        status = picture_begin(&picture, j->scene, &j->trace, &f->settings, j->report);
    if (status == GRAZE_OK && f->begun)
        status = checkpoint_resume(f->begun, picture, question, j->report);
    checkpoint_destroy(f->begun);
    f->begun = NULL;
    if (status == GRAZE_OK)
        status = render(f, j, picture, &(checkpoint_labels){question, f->command});
    picture_destroy(picture);
    free(question);
    return status;
}
