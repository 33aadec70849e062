/* A picture to a file, in the format of the file's suffix. */
#include "image/image.h"

#include <stdbool.h>
#include <stdlib.h>

#include "image/exr.h"
#include "image/formats.h"
#include "image/module.h"
#include "image/output.h"

static graze_status write_hdr_file(const image *picture, const char *path, const char *file,
                                   const graze_report *report) {
    FILE *out = fopen(path, "wb");
    if (!out)
        return report_file_error(report, &(place){.file = file}, "cannot be opened for writing");
    graze_status status = image_write_hdr(picture, out, file, report);
    if (fclose(out) != 0 && status == GRAZE_OK)
        status = report_system_error(report, &(place){.file = file}, "cannot write the picture");
    return status;
}

static graze_status write_file(const image *picture, const char *file, const graze_report *report) {
    bool is_hdr = image_format_of(file) == IMAGE_FORMAT_HDR;
    image_output output;
    graze_status status = image_output_begin(&output, file, is_hdr, report);
    if (status != GRAZE_OK)
        return status;
    status = is_hdr ? write_hdr_file(picture, output.path, file, report)
                    : image_write_exr(picture, output.path, file, report);
    return image_output_finish(&output, status);
}

static graze_status write_exposed(const image *picture, const char *file, const graze_report *report) {
    unsigned char *bytes = malloc(3 * (size_t)picture->width * (size_t)picture->height);
    if (!bytes)
        return report_out_of_memory(report);
    image_expose(picture, bytes);
    graze_status status = image_write_bytes(picture, picture->width, picture->height, bytes, file, report);
    free(bytes);
    return status;
}

graze_status image_write(const image *picture, const char *file, const graze_report *report) {
    graze_status status = image_check_writable(file, report);
    if (status != GRAZE_OK)
        return status;
    return image_format_of(file) == IMAGE_FORMAT_OTHER ? write_exposed(picture, file, report)
                                                       : write_file(picture, file, report);
}

graze_status image_write_bytes(const image *picture, int width, int height, const unsigned char *bytes,
                               const char *file, const graze_report *report) {
    const image_oiio *module;
    image_output output;
    graze_status status = image_check_size(file, width, height, report);
    if (status == GRAZE_OK)
        status = image_module_open(&module, file, report);
    if (status == GRAZE_OK)
        status = image_output_begin(&output, file, false, report);
    if (status != GRAZE_OK)
        return status;
    image_oiio_header header = {picture->pixel_aspect, NULL, picture->command, picture->software};
    char message[1024];
    if (!module->write(output.path, file, width, height, bytes, &header, message, sizeof message)) {
        report_error(report, &(place){.file = file}, "cannot write the picture: %s", message);
        status = GRAZE_SYSTEM_ERROR;
    }
    return image_output_finish(&output, status);
}
