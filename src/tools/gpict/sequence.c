/* Views from standard input. */
#include "tools/gpict/sequence.h"

#include <stdlib.h>
#include <string.h>

#include "tools/gpict/names.h"

static graze_status check_names(const gpict_options *o, const graze_report *report) {
    graze_status status = GRAZE_OK;
    for (int i = 0; i < o->pictures.count && status == GRAZE_OK; i++)
        status = name_check_frame(o->pictures.files[i], report);
    if (status == GRAZE_OK && *o->contours)
        status = name_check_frame(o->contours, report);
    if (status == GRAZE_OK && *o->depth)
        status = name_check_frame(o->depth, report);
    return status;
}

/* One frame; the view becomes the previous one. */
static graze_status render_view(job *j, int number, const rad_view *view, const rad_view *now, rad_view *previous) {
    shot *f = NULL;
    graze_status status = shot_prepare(&f, j, number, view, previous);
    if (f)
        status = shot_render(f, j);
    shot_destroy(f);
    *previous = *now;
    return status;
}

/* What a line that was wrong has changed of the view is taken back, for the next lines to be right. */
static graze_status take_view(const job *j, rad_view *view, rad_view *now, const char *line, bool *found,
                              const place *where) {
    const rad_view before = *view;
    graze_status status = rad_view_take_line(view, line, found, where, j->report);
    *now = *view;
    if (status == GRAZE_OK && *found)
        status = rad_view_prepare(now, where, j->report);
    if (status != GRAZE_OK)
        *view = before;
    return status;
}

static void cut_end(char *line) {
    line[strcspn(line, "\r\n")] = 0;
}

/* A line that is to be a view and is none has its frame's number all the same. */
static graze_status render_all(job *j, rad_view *view, rad_view *previous, char **line, size_t *size) {
    graze_status worst = GRAZE_OK;
    int number = j->options->first_frame;
    place where = {.file = "standard input"};
    while (!j->signal && worst < GRAZE_SYSTEM_ERROR && getline(line, size, stdin) > 0) {
        bool found;
        rad_view now;
        where.line++;
        cut_end(*line);
        graze_status status = take_view(j, view, &now, *line, &found, &where);
        if (status == GRAZE_OK && found)
            status = render_view(j, number, view, &now, previous);
        number += found || status != GRAZE_OK;
        worst = status > worst ? status : worst;
    }
    if (ferror(stdin))
        worst = report_system_error(j->report, NULL, "cannot read standard input");
    return worst;
}

graze_status sequence_render(job *j) {
    rad_view view = j->options->view, previous = view;
    char *line = NULL;
    size_t size = 0;
    graze_status status = check_names(j->options, j->report);
    if (status == GRAZE_OK)
        status = rad_view_prepare(&previous, NULL, j->report);
    if (status == GRAZE_OK)
        status = job_load(j);
    if (status == GRAZE_OK)
        status = render_all(j, &view, &previous, &line, &size);
    free(line);
    return status;
}
