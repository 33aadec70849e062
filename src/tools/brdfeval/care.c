/* What is wrong with a record, or what it takes to make it right. */
#include "tools/brdfeval/care.h"

#include <stdio.h>

#include "base/number.h"
#include "base/records.h"

bool care_direction(vec3 *direction, const evaluation *e, int which, char *trouble) {
    if (vec3_max_abs(*direction) == 0) {
        snprintf(trouble, RECORD_TROUBLE_SIZE, "the direction to the %s is zero",
                 which == 0 && e->query->directions == 2 ? "light" : "viewer");
        return false;
    }
    /* Lengths that rounding explains are left alone, so that exchanged directions give the same bits. */
    if (!(fabs(vec3_safe_length(*direction) - 1) <= CARE_LENGTH_TOLERANCE))
        *direction = vec3_safe_normalize(*direction);
    return true;
}

bool care_random_number(double value, int which, char *trouble) {
    char text[NUMBER_TEXT_SIZE];
    if (value >= 0 && value < 1)
        return true;
    number_print_exact(text, value);
    snprintf(trouble, RECORD_TROUBLE_SIZE, "%c is %s, but has to be at least 0 and less than 1", "stu"[which], text);
    return false;
}
