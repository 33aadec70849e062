/* What pictures.sh does with Graze's reader and writer of pictures.
 *
 *   pictures make FILE WIDTH HEIGHT   writes a random picture
 *   pictures copy FROM TO             reads and writes
 *   pictures floats FILE              prints R, G, B as the machine's floats, row by row from the top
 *   pictures near A B SHARE           fails where B differs from A by more than this share of the pixel's largest
 * component */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "image/image.h"

static void print_message(void *user, graze_severity severity, const char *text) {
    (void)user;
    (void)severity;
    fprintf(stderr, "%s\n", text);
}
static const graze_report report = {print_message, NULL};

static double random_unit(uint32_t *seed) {
    *seed = *seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return (*seed >> 8) * 0x1p-24;
}

/* Six decades, with stretches of one colour and of black. */
static int make(const char *file, int width, int height) {
    image *picture = image_create(width, height, 3, NULL);
    if (!picture)
        return 1;
    uint32_t seed = 1;
    for (int i = 0, left = 0; i < width * height; i++, left--) {
        static float color[3];
        if (left <= 0) {
            left = random_unit(&seed) < 0.5 ? 1 : (int)(200 * random_unit(&seed));
            double scale = random_unit(&seed) < 0.1 ? 0 : pow(10, 6 * random_unit(&seed) - 3);
            for (int c = 0; c < 3; c++)
                color[c] = (float)(scale * (0.2 + random_unit(&seed)));
        }
        for (int c = 0; c < 3; c++)
            picture->channels[c][i] = color[c];
    }
    picture->command = "gpict -vtv -vp 1 2 3 room.rad";
    picture->view = "-vtv -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 40 -vv 30";
    picture->software = "Graze";
    graze_status status = image_write(picture, file, &report);
    image_destroy(picture);
    return (int)status;
}

static int copy(const char *from, const char *to) {
    image *picture;
    if (image_read(&picture, from, &report) != GRAZE_OK)
        return 1;
    graze_status status = image_write(picture, to, &report);
    image_destroy(picture);
    return (int)status;
}

static int floats(const char *file) {
    image *picture;
    if (image_read(&picture, file, &report) != GRAZE_OK)
        return 1;
    for (int i = 0; i < picture->width * picture->height; i++)
        for (int c = 0; c < 3; c++)
            fwrite(&picture->channels[c][i], sizeof(float), 1, stdout);
    image_destroy(picture);
    return fflush(stdout) != 0;
}

static int compare(const image *a, const image *b, double share) {
    if (a->width != b->width || a->height != b->height) {
        fprintf(stderr, "%d x %d and %d x %d\n", a->width, a->height, b->width, b->height);
        return 1;
    }
    for (int i = 0; i < a->width * a->height; i++) {
        double largest = fmax((double)a->channels[0][i], fmax((double)a->channels[1][i], (double)a->channels[2][i]));
        for (int c = 0; c < 3; c++)
            if (!(fabs((double)b->channels[c][i] - (double)a->channels[c][i]) <= share * largest)) {
                fprintf(stderr, "x %d, y %d, channel %d: %g and %g of %g\n", i % a->width, i / a->width, c,
                        (double)a->channels[c][i], (double)b->channels[c][i], largest);
                return 1;
            }
    }
    return 0;
}

static int near(const char *a, const char *b, double share) {
    image *first, *second;
    if (image_read(&first, a, &report) != GRAZE_OK || image_read(&second, b, &report) != GRAZE_OK)
        return 1;
    int result = compare(first, second, share);
    image_destroy(first);
    image_destroy(second);
    return result;
}

int main(int argc, char **argv) {
    if (argc == 5 && !strcmp(argv[1], "make"))
        return make(argv[2], atoi(argv[3]), atoi(argv[4]));
    if (argc == 4 && !strcmp(argv[1], "copy"))
        return copy(argv[2], argv[3]);
    if (argc == 3 && !strcmp(argv[1], "floats"))
        return floats(argv[2]);
    if (argc == 5 && !strcmp(argv[1], "near"))
        return near(argv[2], argv[3], atof(argv[4]));
    return 2;
}
