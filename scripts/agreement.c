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

/* Means further apart than this many standard errors disagree; so do pixels whose differences scatter more widely than
 * this many of theirs (sixteen replicates a pixel: 1.07 is expected). */
#define MEAN_LIMIT    4.0
#define SCATTER_LIMIT 1.5

typedef struct comparison {
    double difference, error; /* of the pictures' means, relative */
    double scatter;           /* root mean square of the pixels' differences, in standard errors */
} comparison;

static int is_whole(const image *picture) {
    return image_channel(picture, "G") && image_channel(picture, "standard_error.G");
}

static comparison compare(const image *a, const image *b) {
    const float *va = image_channel(a, "G"), *ea = image_channel(a, "standard_error.G");
    const float *vb = image_channel(b, "G"), *eb = image_channel(b, "standard_error.G");
    size_t count = (size_t)a->width * (size_t)a->height, noisy = 0;
    double difference = 0, variance = 0, total = 0, scatter = 0;
    for (size_t i = 0; i < count; i++) {
        double d = (double)va[i] - vb[i], v = (double)ea[i] * ea[i] + (double)eb[i] * eb[i];
        difference += d;
        variance += v;
        total += vb[i];
        if (v > 0) {
            scatter += d * d / v;
            noisy++;
        }
    }
    return (comparison){difference / total, sqrt(variance) / total, noisy ? sqrt(scatter / (double)noisy) : 0};
}

static int agree(const char *name, const char *trusted, const image *a, const image *b) {
    if (!is_whole(a) || !is_whole(b) || a->width != b->width || a->height != b->height) {
        fprintf(stderr, "agreement: %s and %s: not pictures of one size with their standard errors\n", name, trusted);
        return 0;
    }
    comparison c = compare(a, b);
    int good = fabs(c.difference) <= MEAN_LIMIT * c.error && c.scatter <= SCATTER_LIMIT;
    printf("%s and %s: means differ by %+.3f%% +- %.3f%%, pixels by %.2f of their standard errors: %s\n", name, trusted,
           100 * c.difference, 100 * c.error, c.scatter, good ? "they agree" : "THEY DISAGREE");
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
