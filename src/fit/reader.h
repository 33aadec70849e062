/* What the readers of formats share: a file's text, its lines and words, and the measurements under way. */
#ifndef FIT_READER_H
#define FIT_READER_H

#include "fit/measurements.h"

/* A word of a line, not terminated. */
typedef struct fit_word {
    const char *text;
    size_t length;
    int column; /* from 1 */
} fit_word;

typedef enum fit_angle { FIT_POLAR, FIT_AZIMUTH } fit_angle;

typedef struct fit_reader {
    const char *bytes, *end; /* the whole file */
    const char *next;        /* the line behind the present one */
    fit_word line;           /* without its end */
    const char *at;          /* behind the last word of the line */
    char separator;          /* of words: ' ' stands for any number of blanks */
    place where;
    const fit_read_options *options;
    fit_measurements *measurements;
    fit_source *source;
    double largest_polar; /* of all angles read, as they stand in the file */
    const graze_report *report;
} fit_reader;

/* To the next line, or to the first. False: there is none. */
bool fit_reader_line(fit_reader *);
void fit_reader_rewind(fit_reader *);
/* The next word of the line; false: there is none. With a separator that is no blank, words may be empty, and quotes
 * around one are taken off. */
bool fit_reader_word(fit_reader *, fit_word *);
size_t fit_reader_count_words(const fit_reader *);
/* The next word as a finite number; `what` names it in the message. */
graze_status fit_reader_number(fit_reader *, const char *what, double *);
/* The next word as an angle in the source's unit, which a direction may have. */
graze_status fit_reader_angle(fit_reader *, const char *what, fit_angle, double *);
/* The next `count` words as finite numbers, of which `values` gets the chosen ones. */
graze_status fit_reader_values(fit_reader *, const bool *chosen, size_t count, double *values);
graze_status fit_reader_line_end(fit_reader *);
graze_status fit_reader_error(const fit_reader *, const fit_word *, const char *text);
bool fit_word_is(const fit_word *, const char *text);
bool fit_word_number(const fit_word *, double *);

/* Settles a convention: as told by the options, else as the format or the file has it. */
void fit_reader_set_unit(fit_reader *, fit_unit, fit_origin);
void fit_reader_set_quantity(fit_reader *, fit_quantity, fit_origin);
void fit_reader_set_light(fit_reader *, fit_light, fit_origin);
void fit_reader_set_mirror(fit_reader *, fit_mirror, fit_origin);

/* An angle in the source's unit, in radians. */
double fit_reader_radians(const fit_reader *, double angle);
/* The direction of two angles in the source's unit. */
graze_vec3 fit_reader_direction(fit_reader *, double polar, double azimuth);

/* The channels of the file, of which `chosen` (for `count` booleans) gets those wanted. Fails where the file's wanted
 * channels are not those of earlier files. */
graze_status fit_reader_channels(fit_reader *, const fit_word *names, size_t count, bool *chosen);
/* Adds a pair of directions of any length, incident and outgoing in the file's words, with the values of the wanted
 * channels; or counts it as left out. */
graze_status fit_reader_add(fit_reader *, graze_vec3 incident, graze_vec3 outgoing, double weight,
                            const double *values);

graze_status fit_read_table(fit_reader *);
graze_status fit_read_cornell(fit_reader *);
graze_status fit_read_alta(fit_reader *);
graze_status fit_read_pab(fit_reader *);
graze_status fit_read_merl(fit_reader *);
/* Whether the whole is a MERL table, by its size and first numbers. */
bool fit_is_merl(const char *bytes, size_t length);

#endif
