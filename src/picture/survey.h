/* How many samples pixels will need, as some pixels tell that are looked at beforehand.
 *
 * A few samples of a pixel may all miss what makes it noisy, and would then be believed too early; those of its
 * neighbours seldom miss it, too. What a survey finds decides nothing but how many samples are taken at least, and is
 * drawn from numbers of its own, so that pixels are not led astray by it. */
#ifndef PICTURE_SURVEY_H
#define PICTURE_SURVEY_H

#include <stdint.h>

#include "base/report.h"
#include "graze/trace.h"

typedef struct picture_survey {
    int width, height; /* of the picture */
    int columns, rows; /* of the grid of pixels that are looked at */
    uint32_t *least;   /* so many samples, for each part of the picture about one of these pixels; null: no survey */
} picture_survey;

/* The estimate of a pixel by these settings. */
typedef graze_answer survey_ask(void *user, const graze_trace_settings *, int column, int row);

/* For pictures that are rendered to the settings' error. */
graze_status survey_make(picture_survey *, int width, int height, const graze_trace_settings *, int threads,
                         survey_ask *, void *user, const graze_report *);
void survey_free(picture_survey *);

/* For a pixel; 0 without a survey. */
uint32_t survey_least(const picture_survey *, int column, int row);

#endif
