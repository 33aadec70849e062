/* A fit of the new model as Radiance's plastic2 or metal2. */
#ifndef FIT_MATERIAL_H
#define FIT_MATERIAL_H

#include "fit/colour.h"
#include "fit/reflectance.h"

/* plastic2: rs = spec in all colours, rd = colour (1 - spec); metal2: rs = colour spec, rd = colour (1 - spec). */
typedef struct fit_material {
    bool metal;
    graze_rgb colour;
    double spec, alpha_x, alpha_y;
    fit_colour_kind kind;   /* how the channels were taken as colours */
    graze_rgb rs, rd;       /* what was fitted, and ... */
    graze_rgb rs_as, rd_as; /* ... what the material has */
} fit_material;

/* plastic2, unless metal2's specular colour is nearer to the fitted one by more than 1% of that: what is grey is
 * plastic2. A roughness of each channel's own becomes the mean weighted by rs. */
fit_material fit_material_of(const fit_result *, const fit_channel_name *channels);

#endif
