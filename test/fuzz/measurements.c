/* Fuzz target: files of measured reflectance. Whatever they hold is read or refused; and what is read is fit to use.
 *
 * The first two bytes are the options, the rest is the file:
 *   0: the format, told or not, and unit and quantity    1: names of columns and channels, light and mirror
 * A MERL table of the full size is too large for this; its head is not. */
#include <math.h>
#include <string.h>

#include "fit/measurements.h"
#include "fuzz/target.h"

typedef struct counts {
    int errors, warnings;
} counts;

static void count_message(void *user, graze_severity severity, const char *text) {
    counts *c = user;
    MUST(*text);
    if (severity == GRAZE_ERROR)
        c->errors++;
    else
        c->warnings++;
}

static fit_read_options options_of(const uint8_t *bytes) {
    static const char *const columns[] = {NULL, "theta_i,theta_o,f", "lx;ly;lz;vx;vy;vz;R;G;B", "a b theta_i"};
    static const char *const channels[] = {NULL, "R", "f,500", "value1"};
    return (fit_read_options){
        .conventions = {.format = (fit_format)(bytes[0] % 6),
                        .unit = (fit_unit)(bytes[0] / 6 % 3),
                        .quantity = (fit_quantity)(bytes[0] / 18 % 4),
                        .light = (fit_light)(bytes[1] / 16 % 3),
                        .mirror = (fit_mirror)(bytes[1] / 48 % 3)},
        .columns = columns[bytes[1] % 4],
        .channels = channels[bytes[1] / 4 % 4],
    };
}

static int is_direction(graze_vec3 v) {
    return fabs(v.x * v.x + v.y * v.y + v.z * v.z - 1) < 1e-9 && v.z > FIT_COSINE_MIN;
}

static void check_source(const fit_source *s) {
    MUST(strcmp(s->file, "name") == 0);
    MUST(s->conventions.format && s->conventions.unit && s->conventions.quantity);
    MUST(s->conventions.light && s->conventions.mirror);
    MUST(s->pairs > 0);
}

static void check(const fit_measurements *m, size_t sources) {
    size_t pairs = 0;
    MUST(m->channel_count > 0 && m->source_count == sources);
    for (size_t i = 0; i < sources; i++) {
        check_source(&m->sources[i]);
        pairs += m->sources[i].pairs;
    }
    MUST(m->count == pairs);
    for (size_t i = 0; i < pairs; i++) {
        const fit_pair *p = &m->pairs[i];
        MUST(is_direction(p->l) && is_direction(p->v));
        MUST(p->weight >= 1 / FIT_NUMBER_MAX && p->weight <= FIT_NUMBER_MAX);
    }
    for (size_t i = 0; i < pairs * m->channel_count; i++)
        MUST(fabs(m->values[i]) <= FIT_NUMBER_MAX);
    for (size_t k = 0; k < m->channel_count; k++)
        MUST(m->channels[k].text && m->channels[k].wavelength >= 0);
}

/* The same once more is the same. */
static void check_second(const fit_measurements *m) {
    size_t half = m->count / 2;
    check(m, 2);
    MUST(memcmp(m->pairs, m->pairs + half, half * sizeof *m->pairs) == 0);
    MUST(memcmp(m->values, m->values + half * m->channel_count, half * m->channel_count * sizeof *m->values) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    counts messages = {0};
    const graze_report report = {count_message, &messages};
    fit_measurements m = {0};
    if (size < 2)
        return 0;
    const fit_read_options options = options_of(data);
    const char *bytes = (const char *)data + 2;
    graze_status status = fit_read_bytes(&m, "name", bytes, size - 2, &options, &report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST(messages.errors == (status != GRAZE_OK) && messages.warnings <= 1);
    if (status == GRAZE_OK) {
        check(&m, 1);
        MUST(fit_read_bytes(&m, "name", bytes, size - 2, &options, &report) == GRAZE_OK);
        check_second(&m);
    }
    fit_measurements_free(&m);
    return 0;
}
