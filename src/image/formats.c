/* Picture formats by the suffix of a file. */
#include "image/formats.h"

#include <string.h>
#include <strings.h>

#include "image/module.h"
#include "image/output.h"

image_format image_format_of(const char *file) {
    const char *suffix = image_suffix(file);
    if (!strcasecmp(suffix, "hdr") || !strcasecmp(suffix, "pic"))
        return IMAGE_FORMAT_HDR;
    if (!strcasecmp(suffix, "exr"))
        return IMAGE_FORMAT_EXR;
    return !*suffix && image_output_is_special(file) ? IMAGE_FORMAT_HDR : IMAGE_FORMAT_OTHER;
}

static graze_status check_suffix(const char *file, const graze_report *report) {
    if (image_format_of(file) != IMAGE_FORMAT_OTHER)
        return GRAZE_OK;
    place where = {.file = file};
    const char *suffix = image_suffix(file);
    if (!*suffix)
        return report_error(report, &where,
                            "the file's name has no suffix that tells the format, such as .hdr, .exr or .png");
    const image_oiio *module;
    graze_status status = image_module_open(&module, file, report);
    if (status != GRAZE_OK || module->can_write(suffix))
        return status;
    char known[2048];
    module->list_writable(known, sizeof known);
    return report_error(report, &where,
                        "no format is known for .%s; known are .hdr, .pic, .exr and, with 8 bits a channel, %s", suffix,
                        known);
}

graze_status image_check_size(const char *file, int width, int height, const graze_report *report) {
    const image_oiio *module;
    if (image_format_of(file) != IMAGE_FORMAT_OTHER)
        return GRAZE_OK;
    graze_status status = image_module_open(&module, file, report);
    if (status != GRAZE_OK)
        return status;
    const char *suffix = image_suffix(file);
    int longest = module->longest_side(suffix);
    if (width <= longest && height <= longest)
        return GRAZE_OK;
    return report_error(report, &(place){.file = file},
                        "a picture of %d x %d pixels is too large for .%s, which has room for %d a side", width, height,
                        suffix, longest);
}

graze_status image_check_writable(const char *file, const graze_report *report) {
    graze_status status = check_suffix(file, report);
    return status == GRAZE_OK ? image_output_check(file, report) : status;
}
