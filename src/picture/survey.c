/* A sparse grid of pixels, each with a few samples; neighbours are taken together. */
#include "picture/survey.h"

#include <math.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "base/vector.h"

/* The grid has at most so many pixels a side, each with so many samples. */
#define SIDE    64
#define SAMPLES 8

/* The number of samples that bring an error down by a factor f is so many times f^(2 EXPONENT): low-discrepancy points
 * need fewer than independent ones, whose exponent is 1. Of scenes/bench and some dark rooms, these two leave the least
 * error in a given time. */
#define SAFETY   2.0
#define EXPONENT 0.7

typedef struct survey_work {
    const graze_trace_settings *wanted;
    graze_trace_settings trace;
    picture_survey *survey;
    survey_ask *ask;
    void *user;
    graze_answer *answers;
} survey_work;

static int cell_middle(int cell, int cells, int pixels) {
    return (int)((cell + 0.5) * pixels / cells);
}

static void ask_pixel(void *user, size_t index, int worker) {
    (void)worker;
    survey_work *w = user;
    const picture_survey *s = w->survey;
    int column = (int)(index % (size_t)s->columns), row = (int)(index / (size_t)s->columns);
    w->answers[index] =
        w->ask(w->user, &w->trace, cell_middle(column, s->columns, s->width), cell_middle(row, s->rows, s->height));
}

/* What a pixel of the grid and its eight neighbours tell. */
static uint32_t needed_about(const survey_work *w, int column, int row) {
    const picture_survey *s = w->survey;
    double value = 0, squares = 0;
    int count = 0;
    for (int r = row > 0 ? row - 1 : 0; r <= row + 1 && r < s->rows; r++)
        for (int c = column > 0 ? column - 1 : 0; c <= column + 1 && c < s->columns; c++, count++) {
            const graze_answer *a = &w->answers[r * s->columns + c];
            double error = rgb_max(a->standard_error);
            value += rgb_max(a->value);
            squares += error * error;
        }
    if (squares == 0)
        return 0;
    double allowed = w->wanted->error * fmax(value / count, w->wanted->floor);
    double needed = SAFETY * SAMPLES * pow(squares / count / (allowed * allowed), EXPONENT);
    return (uint32_t)fmin(needed, w->wanted->sample_limit);
}

graze_status survey_make(picture_survey *s, int width, int height, const graze_trace_settings *wanted, int threads,
                         survey_ask *ask, void *user, const graze_report *report) {
    *s = (picture_survey){width, height, width < SIDE ? width : SIDE, height < SIDE ? height : SIDE, NULL};
    size_t count = (size_t)s->columns * (size_t)s->rows;
    survey_work work = {wanted, *wanted, s, ask, user, calloc(count, sizeof *work.answers)};
    work.trace.samples = SAMPLES;
    uint32_t *least = malloc(count * sizeof *least);
    if (!work.answers || !least) {
        free(work.answers);
        free(least);
        return report_out_of_memory(report);
    }
    parallel_for(threads, count, ask_pixel, &work);
    for (size_t i = 0; i < count; i++)
        least[i] = needed_about(&work, (int)(i % (size_t)s->columns), (int)(i / (size_t)s->columns));
    s->least = least;
    free(work.answers);
    return GRAZE_OK;
}

void survey_free(picture_survey *s) {
    free(s->least);
    s->least = NULL;
}

uint32_t survey_least(const picture_survey *s, int column, int row) {
    if (!s->least)
        return 0;
    int64_t c = (int64_t)column * s->columns / s->width, r = (int64_t)row * s->rows / s->height;
    return s->least[r * s->columns + c];
}
