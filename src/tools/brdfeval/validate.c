/* What is wrong with numbers, in words; directions of other lengths than 1. */
#include "tools/brdfeval/validate.h"

#include <math.h>
#include <stdio.h>

#include "base/number.h"
#include "base/records.h"

bool validate_number(double value, int which, char *message) {
    if (isfinite(value))
        return true;
    record_describe_not_finite(message, (size_t)which);
    return false;
}

static const char *direction_name(const evaluation *e, int which) {
    return which == 0 && e->query->directions == 2 ? "light" : "viewer";
}

bool validate_direction(vec3 *direction, const evaluation *e, int which, char *message) {
    if (vec3_max_abs(*direction) == 0) {
        snprintf(message, RECORD_MESSAGE_SIZE, "the direction to the %s is zero", direction_name(e, which));
        return false;
    }
    /* Lengths that rounding explains are left alone, so that exchanged directions give the same bits. */
    if (!(fabs(vec3_safe_length(*direction) - 1) <= VALIDATE_LENGTH_TOLERANCE))
        *direction = vec3_safe_normalize(*direction);
    return true;
}

bool validate_angles(double theta, double phi, const evaluation *e, int which, char *message) {
    char text[NUMBER_TEXT_SIZE];
    bool theta_is_good = fabs(theta) <= VALIDATE_ANGLE_MAX;
    if (theta_is_good && fabs(phi) <= VALIDATE_ANGLE_MAX)
        return true;
    number_print_exact(text, theta_is_good ? phi : theta);
    snprintf(message, RECORD_MESSAGE_SIZE, "%s of the %s is %s, but has to be between -%d and %d degrees",
             theta_is_good ? "phi" : "theta", direction_name(e, which), text, VALIDATE_ANGLE_MAX, VALIDATE_ANGLE_MAX);
    return false;
}

bool validate_random_number(double value, int which, char *message) {
    char text[NUMBER_TEXT_SIZE];
    if (value >= 0 && value < 1)
        return true;
    number_print_exact(text, value);
    snprintf(message, RECORD_MESSAGE_SIZE, "%c is %s, but has to be at least 0 and less than 1", "stu"[which], text);
    return false;
}
