/* Numbers from pictures. */
#include "image/values.h"

#include <math.h>
#include <stdlib.h>

#include "base/number.h"
#include "image/color.h"

static bool create(image_values *values, const image *picture) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    *values = (image_values){picture->width, picture->height, malloc(count * sizeof(float)), 0};
    return values->values;
}

static size_t count_of(const image_values *values) {
    return (size_t)values->width * (size_t)values->height;
}

bool image_values_of(image_values *values, const image *picture, double multiplier) {
    if (!create(values, picture))
        return false;
    for (size_t i = 0; i < count_of(values); i++)
        values->values[i] = number_to_float(multiplier * image_brightness(picture->channels, i));
    return true;
}

bool image_relative_difference(image_values *values, const image *a, const image *b) {
    if (!create(values, a))
        return false;
    for (size_t i = 0; i < count_of(values); i++) {
        double reference = image_brightness(b->channels, i);
        bool known = reference > 0;
        values->values[i] = known ? number_to_float(image_brightness(a->channels, i) / reference - 1) : NAN;
        values->missing += !known;
    }
    return true;
}

void image_values_free(image_values *values) {
    free(values->values);
    values->values = NULL;
}

double image_values_largest(const image_values *values) {
    double largest = 0;
    for (size_t i = 0; i < count_of(values); i++)
        largest = fmax(largest, values->values[i]);
    return largest;
}

static int compare(const void *a, const void *b) {
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

bool image_values_usual_size(const image_values *values, double *size) {
    size_t count = 0;
    float *sizes = malloc(count_of(values) * sizeof(float));
    if (!sizes)
        return false;
    for (size_t i = 0; i < count_of(values); i++)
        if (!isnan(values->values[i]))
            sizes[count++] = fabsf(values->values[i]);
    qsort(sizes, count, sizeof(float), compare);
    *size = count > 0 ? sizes[(count - 1) * 99 / 100] : 0;
    free(sizes);
    return true;
}
