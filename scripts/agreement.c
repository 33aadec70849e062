/* How well pictures of the same scene agree: reads EXR files that gpict wrote, each with its standard error, and
 * compares all others with the last, which is the most trusted.
 *
 *     agreement light.exr brdf.exr mis.exr
 *
 * Prints a line a comparison; exits with 1 if two pictures differ by more than their errors explain. */
#include <math.h>
#include <stdio.h>

#include "base/options.h"
#include "image/image.h"

/* Pictures are compared in blocks of this many pixels a side, since a single pixel's standard error is itself
 * uncertain, most of all where few samples find anything. */
#define BLOCK 16
/* Means further apart than this many standard errors disagree; so do blocks whose differences scatter more widely than
 * this many of theirs. */
#define MEAN_LIMIT    4.0
#define SCATTER_LIMIT 1.5

/* Differences fainter than this part of the picture's mean do not count: sampled reflections may find nothing at all
 * where light is faint and rare, and then claim no error. */
#define FAINT 1e-3

typedef struct sums {
    double difference, variance, total;
} sums;

typedef struct comparison {
    double difference, error; /* of the pictures' means, relative */
    double scatter;           /* root mean square of the blocks' differences, in standard errors */
} comparison;

static int is_whole(const image *picture) {
    return image_channel(picture, "G") && image_channel(picture, "standard_error.G");
}

static sums sum_block(const image *a, const image *b, int left, int top) {
    const float *va = image_channel(a, "G"), *ea = image_channel(a, "standard_error.G");
    const float *vb = image_channel(b, "G"), *eb = image_channel(b, "standard_error.G");
    sums s = {0, 0, 0};
    for (int y = top; y < top + BLOCK && y < a->height; y++)
        for (int x = left; x < left + BLOCK && x < a->width; x++) {
            size_t i = (size_t)y * (size_t)a->width + (size_t)x;
            s.difference += (double)va[i] - vb[i];
            s.variance += (double)ea[i] * ea[i] + (double)eb[i] * eb[i];
            s.total += vb[i];
        }
    return s;
}

static double mean_of(const image *picture) {
    const float *value = image_channel(picture, "G");
    size_t count = (size_t)picture->width * (size_t)picture->height;
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += value[i];
    return sum / (double)count;
}

static comparison compare(const image *a, const image *b) {
    sums all = {0, 0, 0};
    double scatter = 0, faint = FAINT * mean_of(b) * BLOCK * BLOCK;
    int blocks = 0;
    for (int top = 0; top < a->height; top += BLOCK)
        for (int left = 0; left < a->width; left += BLOCK, blocks++) {
            sums s = sum_block(a, b, left, top);
            all.difference += s.difference;
            all.variance += s.variance;
            all.total += s.total;
            scatter += s.difference * s.difference / (s.variance + faint * faint);
        }
    return (comparison){all.difference / all.total, sqrt(all.variance) / all.total, sqrt(scatter / blocks)};
}

static int agree(const char *name, const char *trusted, const image *a, const image *b) {
    if (!is_whole(a) || !is_whole(b) || a->width != b->width || a->height != b->height) {
        fprintf(stderr, "agreement: %s and %s: not pictures of one size with their standard errors\n", name, trusted);
        return 0;
    }
    comparison c = compare(a, b);
    int good = fabs(c.difference) <= MEAN_LIMIT * c.error && c.scatter <= SCATTER_LIMIT;
    printf("%s and %s: means differ by %+.3f%% +- %.3f%%, blocks of pixels by %.2f standard errors: %s\n", name,
           trusted, 100 * c.difference, 100 * c.error, c.scatter, good ? "they agree" : "THEY DISAGREE");
    return good;
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("agreement");
    image *trusted = NULL;
    if (argc < 3) {
        fprintf(stderr, "usage: agreement PICTURE.exr... TRUSTED.exr\n");
        return 1;
    }
    int good = image_read(&trusted, argv[argc - 1], &report) == GRAZE_OK;
    for (int i = 1; good && i < argc - 1; i++) {
        image *picture = NULL;
        good = image_read(&picture, argv[i], &report) == GRAZE_OK && agree(argv[i], argv[argc - 1], picture, trusted);
        image_destroy(picture);
    }
    image_destroy(trusted);
    return good ? 0 : 1;
}
