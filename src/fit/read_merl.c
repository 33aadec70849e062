/* MERL's binary tables of isotropic materials: three little-endian 32-bit sizes (90, 90, 180), then for each of red,
 * green, blue as many doubles; theta_h counts slowest, phi_d fastest. theta_h = (i/90)^2 90 degrees, theta_d and phi_d
 * (0 to 180 degrees) are even; values stand for the middle of their cells. Negative ones were not measured. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/angle.h"
#include "fit/half_difference.h"
#include "fit/reader.h"

enum { HALVES = 90, DIFFERENCES = 90, AZIMUTHS = 180, CELLS = HALVES * DIFFERENCES * AZIMUTHS, HEADER = 12 };

static const double scales[3] = {1 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};

static uint64_t little_endian(const char *bytes, int count) {
    uint64_t number = 0;
    for (int i = 0; i < count; i++)
        number |= (uint64_t)(unsigned char)bytes[i] << (8 * i);
    return number;
}

static double value_at(const char *bytes, int channel, int cell) {
    uint64_t bits = little_endian(bytes + HEADER + 8 * ((size_t)channel * CELLS + (size_t)cell), 8);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value * scales[channel];
}

bool fit_is_merl(const char *bytes, size_t length) {
    return length >= HEADER && little_endian(bytes, 4) == HALVES && little_endian(bytes + 4, 4) == DIFFERENCES &&
           little_endian(bytes + 8, 4) == AZIMUTHS;
}

static graze_status read_cell(fit_reader *r, const bool chosen[3], int half, int difference, int azimuth) {
    int cell = (half * DIFFERENCES + difference) * AZIMUTHS + azimuth;
    double values[3], position = (half + .5) / HALVES;
    graze_vec3 incident, outgoing;
    size_t wanted = 0;
    for (int channel = 0; channel < 3; channel++) {
        double value = value_at(r->bytes, channel, cell);
        if (!isfinite(value))
            return report_error(r->report, &(place){.file = r->where.file}, "cell %d %d %d holds no finite number",
                                half, difference, azimuth);
        if (value < 0) {
            r->source->absent++;
            return GRAZE_OK;
        }
        if (chosen[channel])
            values[wanted++] = value;
    }
    fit_from_half_difference(
        (const double[]){position * position * (PI / 2), 0},
        (const double[]){(difference + .5) / DIFFERENCES * (PI / 2), (azimuth + .5) / AZIMUTHS * PI}, &incident,
        &outgoing);
    return fit_reader_add(r, incident, outgoing, 1, values);
}

graze_status fit_read_merl(fit_reader *r) {
    static const fit_word names[] = {{"R", 1, 0}, {"G", 1, 0}, {"B", 1, 0}};
    size_t length = (size_t)(r->end - r->bytes), expected = HEADER + (size_t)8 * 3 * CELLS;
    bool chosen[3];
    const place where = {.file = r->where.file};
    if (!fit_is_merl(r->bytes, length))
        return report_error(r->report, &where, "is no MERL table: it does not begin with the sizes %d %d %d", HALVES,
                            DIFFERENCES, AZIMUTHS);
    if (length != expected)
        return report_error(r->report, &where, "has %zu bytes, but a MERL table has %zu", length, expected);
    fit_reader_set_unit(r, FIT_COMPONENTS, FIT_OF_FORMAT);
    fit_reader_set_quantity(r, FIT_BRDF, FIT_OF_FORMAT);
    fit_reader_set_light(r, FIT_LIGHT_INCIDENT, FIT_OF_FORMAT);
    fit_reader_set_mirror(r, FIT_MIRROR_OPPOSITE, FIT_OF_FORMAT);
    graze_status status = fit_reader_channels(r, names, 3, chosen);
    for (int h = 0; h < HALVES && status == GRAZE_OK; h++)
        for (int d = 0; d < DIFFERENCES && status == GRAZE_OK; d++)
            for (int p = 0; p < AZIMUTHS && status == GRAZE_OK; p++)
                status = read_cell(r, chosen, h, d, p);
    return status;
}
