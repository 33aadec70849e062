/* Answers by way of weight and density: their product, the lobe times the cosine, is in range where the lobe is not. */
#include "tools/brdfeval/overflow.h"

#include <float.h>

#include "base/angle.h"

double overflow_answer(const evaluation *e, const answer_field *field, int channel, vec3 l, vec3 v) {
    const reflectance *r = &e->reflectance;
    double diffuse = r->diffuse[channel] / PI, specular = r->specular[channel], answer;
    if (field->scaling == SCALING_WEIGHT) {
        answer = specular * (field->result == RESULT_WARD_WEIGHT ? graze_brdf_ward_weight(&r->lobe, l, v)
                                                                 : graze_brdf_pair_weight(&r->lobe, l, v));
    } else {
        double with_cosine =
            specular * graze_brdf_ward_weight(&r->lobe, l, v) * graze_brdf_ward_density(&r->lobe, l, v);
        answer = field->scaling == SCALING_COSINE ? with_cosine + diffuse * l.z : with_cosine / l.z + diffuse;
    }
    return answer < DBL_MAX ? answer : DBL_MAX;
}
