/* Ranges of arguments that are amounts. */
#include "material/amounts.h"

graze_status material_check_signs(const rad_primitive *p, uint32_t count, const graze_report *report) {
    for (uint32_t i = 0; i < count; i++)
        if (!(p->reals[i] >= 0))
            return rad_primitive_error(report, p, "real argument %u is negative", (unsigned)i + 1);
    return GRAZE_OK;
}

graze_status material_check_largest(const rad_primitive *p, uint32_t count, const graze_report *report) {
    for (uint32_t i = 0; i < count; i++)
        if (p->reals[i] > MATERIAL_LARGEST_AMOUNT)
            return rad_primitive_error(report, p, "real argument %u is above 1e10", (unsigned)i + 1);
    return GRAZE_OK;
}

graze_status material_check_amounts(const rad_primitive *p, uint32_t count, const graze_report *report) {
    graze_status status = material_check_signs(p, count, report);
    return status ? status : material_check_largest(p, count, report);
}
