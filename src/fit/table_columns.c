/* Names of columns: lower case, without unit and punctuation, they are looked up. */
#include "fit/table_columns.h"

#include <string.h>

enum { NAME_SIZE = 24 };

static const struct {
    const char *name;
    fit_column column;
    bool of_light; /* the name says which direction the light's is */
} known[] = {
    {"thetai", FIT_THETA_IN, false},
    {"thetain", FIT_THETA_IN, false},
    {"thetal", FIT_THETA_IN, true},
    {"thetalight", FIT_THETA_IN, true},
    {"thetaincident", FIT_THETA_IN, true},
    {"phii", FIT_PHI_IN, false},
    {"phiin", FIT_PHI_IN, false},
    {"phil", FIT_PHI_IN, true},
    {"philight", FIT_PHI_IN, true},
    {"phiincident", FIT_PHI_IN, true},
    {"thetao", FIT_THETA_OUT, false},
    {"thetaout", FIT_THETA_OUT, false},
    {"thetar", FIT_THETA_OUT, false},
    {"thetas", FIT_THETA_OUT, false},
    {"thetav", FIT_THETA_OUT, true},
    {"thetaview", FIT_THETA_OUT, true},
    {"phio", FIT_PHI_OUT, false},
    {"phiout", FIT_PHI_OUT, false},
    {"phir", FIT_PHI_OUT, false},
    {"phis", FIT_PHI_OUT, false},
    {"phiv", FIT_PHI_OUT, true},
    {"phiview", FIT_PHI_OUT, true},
    {"dphi", FIT_PHI_DIFFERENCE, false},
    {"deltaphi", FIT_PHI_DIFFERENCE, false},
    {"phid", FIT_PHI_DIFFERENCE, false},
    {"lx", FIT_X_IN, true},
    {"ly", FIT_Y_IN, true},
    {"lz", FIT_Z_IN, true},
    {"ix", FIT_X_IN, false},
    {"iy", FIT_Y_IN, false},
    {"iz", FIT_Z_IN, false},
    {"wix", FIT_X_IN, false},
    {"wiy", FIT_Y_IN, false},
    {"wiz", FIT_Z_IN, false},
    {"vx", FIT_X_OUT, true},
    {"vy", FIT_Y_OUT, true},
    {"vz", FIT_Z_OUT, true},
    {"ox", FIT_X_OUT, false},
    {"oy", FIT_Y_OUT, false},
    {"oz", FIT_Z_OUT, false},
    {"wox", FIT_X_OUT, false},
    {"woy", FIT_Y_OUT, false},
    {"woz", FIT_Z_OUT, false},
    {"weight", FIT_WEIGHT, false},
    {"sigma", FIT_DEVIATION, false},
    {"stddev", FIT_DEVIATION, false},
    {"uncertainty", FIT_DEVIATION, false},
    {"error", FIT_DEVIATION, false},
};

/* Letters and digits alone, in lower case. */
static void simplify(char simple[NAME_SIZE], const fit_word *name) {
    size_t length = 0;
    for (size_t i = 0; i < name->length && length + 1 < NAME_SIZE; i++) {
        char c = name->text[i];
        if (c >= 'A' && c <= 'Z')
            c = (char)(c - 'A' + 'a');
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
            simple[length++] = c;
    }
    simple[length] = 0;
}

static bool take_off(char *simple, const char *ending) {
    size_t length = strlen(simple), tail = strlen(ending);
    if (length <= tail || strcmp(simple + length - tail, ending) != 0)
        return false;
    simple[length - tail] = 0;
    return true;
}

fit_column fit_table_column(const fit_word *name, fit_light *light, fit_unit *unit) {
    char simple[NAME_SIZE];
    fit_unit said = FIT_UNIT_ANY;
    simplify(simple, name);
    if (take_off(simple, "degrees") || take_off(simple, "deg"))
        said = FIT_DEGREES;
    else if (take_off(simple, "radians") || take_off(simple, "rad"))
        said = FIT_RADIANS;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcmp(simple, known[i].name) != 0)
            continue;
        if (known[i].of_light)
            *light = FIT_LIGHT_INCIDENT;
        if (said != FIT_UNIT_ANY)
            *unit = said;
        return known[i].column;
    }
    return FIT_VALUE;
}
