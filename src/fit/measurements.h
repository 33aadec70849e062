/* Measured reflectance: pairs of directions with a value a channel, and what was taken for granted in reading them. */
#ifndef FIT_MEASUREMENTS_H
#define FIT_MEASUREMENTS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/report.h"
#include "graze/vector.h"

typedef enum fit_format {
    FIT_FORMAT_ANY, /* told by the content */
    FIT_FORMAT_TABLE,
    FIT_FORMAT_CORNELL,
    FIT_FORMAT_ALTA,
    FIT_FORMAT_PAB,
    FIT_FORMAT_MERL,
} fit_format;

typedef enum fit_unit { FIT_UNIT_ANY, FIT_DEGREES, FIT_RADIANS, FIT_COMPONENTS } fit_unit;
typedef enum fit_quantity {
    FIT_QUANTITY_ANY,
    FIT_BRDF,              /* 1/sr */
    FIT_TIMES_COSINE_VIEW, /* value x cosine of the outgoing direction, before directions are exchanged */
    FIT_TIMES_COSINE_LIGHT,
} fit_quantity;
/* Which of a file's two directions, incident and outgoing in its own words, is l. */
typedef enum fit_light { FIT_LIGHT_ANY, FIT_LIGHT_INCIDENT, FIT_LIGHT_OUTGOING } fit_light;
/* Where the mirror direction is: azimuths of both directions seen from the surface, so that it lies at phi + 180
 * degrees, or counted so that it lies at the same phi. */
typedef enum fit_mirror { FIT_MIRROR_ANY, FIT_MIRROR_OPPOSITE, FIT_MIRROR_SAME } fit_mirror;

/* A convention's zeroth value, ANY, leaves it to the reader. */
typedef struct fit_conventions {
    fit_format format;
    fit_unit unit;
    fit_quantity quantity;
    fit_light light;
    fit_mirror mirror;
} fit_conventions;

/* How a convention is known. */
typedef enum fit_origin { FIT_ASSUMED, FIT_OF_FORMAT, FIT_OF_FILE, FIT_TOLD } fit_origin;

/* What one file's numbers were taken to mean, and what became of them. */
typedef struct fit_source {
    char *file;
    fit_conventions conventions; /* none is ANY */
    struct {
        fit_origin format, unit, quantity, light, mirror;
    } origins;
    size_t pairs;           /* kept */
    size_t below;           /* left out: a direction at or below the horizon, its cosine at most FIT_COSINE_MIN */
    size_t absent;          /* left out: the format's mark for "not measured" */
    bool azimuths_are_zero; /* the file has none */
} fit_source;

#define FIT_COSINE_MIN 1e-6
/* The largest value and weight; the smallest weight is its inverse. Products of two weights and two values, as normal
 * equations have them, can be added up. */
#define FIT_NUMBER_MAX 1e50

typedef struct fit_pair {
    graze_vec3 l, v;
    double weight; /* of its squared residual; positive */
} fit_pair;

typedef struct fit_channel_name {
    char *text;        /* as in the file: "R", "550" */
    double wavelength; /* in nm; 0: not a wavelength */
} fit_channel_name;

typedef struct fit_measurements {
    size_t count;
    fit_pair *pairs;
    double *values; /* count x channel_count, a pair's channels in a row: the BRDF in 1/sr, at most FIT_NUMBER_MAX in
                       size */
    size_t channel_count;
    fit_channel_name *channels;
    size_t source_count;
    fit_source *sources;
    size_t capacity; /* of pairs and values */
} fit_measurements;  /* begins as {0} */

typedef struct fit_read_options {
    fit_conventions conventions;
    const char *columns;  /* names of a table's columns, in place of its own; null: its own */
    const char *channels; /* names of the channels wanted, with commas between; null: all */
} fit_read_options;

/* Adds the measurements of a file ("-": standard input), whose channels must be those already there. After an error
 * the measurements can only be freed. */
graze_status fit_read(fit_measurements *, const char *file, const fit_read_options *, const graze_report *);
/* The same of a file's content, of that name. */
graze_status fit_read_bytes(fit_measurements *, const char *name, const char *bytes, size_t length,
                            const fit_read_options *, const graze_report *);
void fit_measurements_free(fit_measurements *);

/* Words for a convention's value and for how it is known. */
const char *fit_format_text(fit_format);
const char *fit_unit_text(fit_unit);
const char *fit_quantity_text(fit_quantity);
const char *fit_light_text(fit_light);
const char *fit_mirror_text(fit_mirror);
const char *fit_origin_text(fit_origin);

#endif
