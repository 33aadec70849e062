/* What the columns of a table hold, told by their names. */
#ifndef FIT_TABLE_COLUMNS_H
#define FIT_TABLE_COLUMNS_H

#include "fit/reader.h"

typedef enum fit_column {
    FIT_THETA_IN,
    FIT_PHI_IN,
    FIT_THETA_OUT,
    FIT_PHI_OUT,
    FIT_PHI_DIFFERENCE, /* outgoing less incident */
    FIT_X_IN,
    FIT_Y_IN,
    FIT_Z_IN,
    FIT_X_OUT,
    FIT_Y_OUT,
    FIT_Z_OUT,
    FIT_WEIGHT,
    FIT_DEVIATION,
    FIT_VALUE,
} fit_column;

/* What a column holds by its name: `theta_i`, `phi_v`, `lx`, `sigma`; any other name is a value's. `light` becomes
 * FIT_LIGHT_INCIDENT where the name speaks of light and viewer, `unit` the unit that is part of it. */
fit_column fit_table_column(const fit_word *name, fit_light *light, fit_unit *unit);

#endif
