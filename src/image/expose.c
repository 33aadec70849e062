/* Exposure for the eye. */
#include "image/image.h"

#include <stdlib.h>

#include "image/color.h"

static const double middle_gray = 0.18;
#define EULER 2.718281828459045

/* Brightness is counted in classes of half a stop, 2^-200 .. 2^200. */
enum { CLASSES = 800, MIDDLE_CLASS = CLASSES / 2 };
/* Pixels that differ from the median by more than this, a factor of a million, have no say in the exposure: a few stray
 * photons in a shadow must not decide how a picture looks, nor must a glimpse of the sun. */
enum { COUNTED_CLASSES = 40 };

/* The class that holds the median of what is lit, or -1 where nothing is. */
static int median_class(const image *picture, size_t count) {
    size_t classes[CLASSES] = {0}, lit = 0, below = 0;
    for (size_t i = 0; i < count; i++) {
        double brightness = image_visible_brightness(picture->channels, i);
        if (brightness > 0) {
            classes[(int)floor(2 * log2(brightness)) + MIDDLE_CLASS]++;
            lit++;
        }
    }
    for (int c = 0; c < CLASSES && lit > 0; c++)
        if ((below += classes[c]) >= (lit + 1) / 2)
            return c;
    return -1;
}

/* What brings the log-average to middle gray; 1 for a picture that is black. */
static double exposure_of(const image *picture, size_t count) {
    int median = median_class(picture, count);
    if (median < 0)
        return 1;
    double sum = 0;
    size_t counted = 0;
    for (size_t i = 0; i < count; i++) {
        double brightness = image_visible_brightness(picture->channels, i);
        if (brightness > 0 && abs((int)floor(2 * log2(brightness)) + MIDDLE_CLASS - median) <= COUNTED_CLASSES) {
            sum += log(brightness);
            counted++;
        }
    }
    return middle_gray / exp(sum / (double)counted);
}

static double brightest_of(const image *picture, size_t count) {
    double brightest = 0;
    for (size_t i = 0; i < count; i++)
        brightest = fmax(brightest, image_visible_brightness(picture->channels, i));
    return brightest;
}

/* Straight up to one half; then by the logarithm, so that lamps and what they are mirrored in stay apart, to 1 at
 * `white`. Up to a white of e/2 the logarithm would be steeper than the straight part, which then simply goes on. */
static double roll_off(double value, double white) {
    if (value <= 0.5 || white <= 0.5 * EULER)
        return fmin(value, 1);
    return fmin(0.5 + 0.5 * log(2 * value) / log(2 * white), 1);
}

void image_expose(const image *picture, unsigned char *bytes) {
    size_t count = (size_t)picture->width * (size_t)picture->height;
    double chosen = picture->display_exposure;
    double exposure = chosen > 0 ? chosen : exposure_of(picture, count),
           white = exposure * brightest_of(picture, count);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            double value = roll_off(exposure * image_visible(picture->channels[c][i]), white);
            bytes[3 * i + (size_t)c] = (unsigned char)(255 * image_srgb_encode(value) + 0.5);
        }
}
