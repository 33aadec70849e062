/* OpenImageIO behind a C interface: what lib/graze/oiio.so offers. Linking OpenImageIO costs every start of a program a
 * quarter of a second and 128 MiB, so only image/module.c opens it, when a format asks for it. */
#ifndef IMAGE_OIIO_H
#define IMAGE_OIIO_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What of a picture's header travels with it. Texts may be null; the view is only read, for 8-bit formats have no place
 * for it. */
typedef struct image_oiio_header {
    double pixel_aspect; /* height over width */
    const char *view, *command, *software;
} image_oiio_header;

typedef struct image_oiio_reader image_oiio_reader;

/* Functions return 1 for success. On failure they return 0 or null with a text in `message`; no C++ exception gets out.
 */
typedef struct image_oiio {
    int (*can_write)(const char *suffix);
    /* In pixels; INT_MAX where none is known. */
    int (*longest_side)(const char *suffix);
    /* The suffixes that can be written, with points and commas, cut to `size`. */
    void (*list_writable)(char *text, size_t size);
    /* 3 * width * height bytes of sRGB, in the format of the file's suffix. Messages call the file `name`. */
    int (*write)(const char *file, const char *name, int width, int height, const unsigned char *rgb,
                 const image_oiio_header *, char *message, size_t message_size);

    image_oiio_reader *(*open)(const char *file, int *width, int *height, int *channels, char *message,
                               size_t message_size);
    /* Lives as long as the reader. */
    const char *(*channel_name)(const image_oiio_reader *, int channel);
    /* Whether R, G and B are in sRGB's encoding. */
    int (*is_srgb)(const image_oiio_reader *);
    image_oiio_header (*header)(const image_oiio_reader *);
    /* All pixels, channel after channel within each; width * height * channels floats, owned by the reader. */
    const float *(*read)(image_oiio_reader *, char *message, size_t message_size);
    void (*close)(image_oiio_reader *);
} image_oiio;

/* The one symbol that the module gives out: a function of this type. */
#define IMAGE_OIIO_SYMBOL "graze_oiio"
typedef const image_oiio *image_oiio_entry(void);

#ifdef __cplusplus
}
#endif

#endif
