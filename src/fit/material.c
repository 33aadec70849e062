/* Which of plastic2 and metal2 is like a fit. */
#include "fit/material.h"

#include <math.h>

#include "base/vector.h"

/* How much nearer metal2 must come, in parts of the specular colour: without colour both are as near, up to rounding
 * and the noise of the data. */
#define METAL_MARGIN .01

static double specular_of(const void *result, size_t channel) {
    return ((const fit_result *)result)->channels[channel].rs.value;
}

static double diffuse_of(const void *result, size_t channel) {
    return ((const fit_result *)result)->channels[channel].rd.value;
}

static double distance(rgb a, rgb b) {
    return sqrt((a.r - b.r) * (a.r - b.r) + (a.g - b.g) * (a.g - b.g) + (a.b - b.b) * (a.b - b.b));
}

static void take_roughness(fit_material *m, const fit_result *r) {
    double sum = 0, x = 0, y = 0;
    for (size_t k = 0; k < r->channel_count; k++) {
        double weight = r->channels[k].rs.value + 1e-12;
        sum += weight;
        x += weight * r->channels[k].alpha_x.value;
        y += weight * r->channels[k].alpha_y.value;
    }
    m->alpha_x = x / sum;
    m->alpha_y = y / sum;
}

fit_material fit_material_of(const fit_result *r, const fit_channel_name *channels) {
    fit_material m = {.kind = fit_colour_kind_of(channels, r->channel_count)};
    m.rs = fit_colour(m.kind, channels, r->channel_count, specular_of, r);
    m.rd = fit_colour(m.kind, channels, r->channel_count, diffuse_of, r);
    take_roughness(&m, r);
    rgb both = rgb_add(m.rs, m.rd);
    double grey = fmin(rgb_brightness(m.rs), 1), brightness = rgb_brightness(both);
    double share = brightness > 0 ? fmin(rgb_brightness(m.rs) / brightness, 1) : 0;
    double margin = METAL_MARGIN * distance(m.rs, rgb_gray(0));
    m.metal = distance(m.rs, rgb_scale(share, both)) + margin < distance(m.rs, rgb_gray(grey));
    m.spec = m.metal ? share : grey;
    m.colour = m.metal ? both : grey < 1 ? rgb_scale(1 / (1 - grey), m.rd) : rgb_gray(0);
    m.rs_as = m.metal ? rgb_scale(m.spec, m.colour) : rgb_gray(m.spec);
    m.rd_as = rgb_scale(1 - m.spec, m.colour);
    return m;
}
