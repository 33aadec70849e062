/* Floats to a file. */
#include "tools/gpict/depth_file.h"

#include <stdio.h>

#include "image/output.h"

graze_status depth_file_write(const float *depths, size_t count, const char *file, const graze_report *report) {
    const place where = {.file = file};
    image_output output;
    graze_status status = image_output_begin(&output, file, true, report);
    if (status != GRAZE_OK)
        return status;
    FILE *out = fopen(output.path, "wb");
    if (!out)
        return image_output_finish(&output, report_file_error(report, &where, "cannot be opened for writing"));
    if (fwrite(depths, sizeof *depths, count, out) != count)
        status = report_system_error(report, &where, "cannot write the distances");
    if (fclose(out) != 0 && status == GRAZE_OK)
        status = report_system_error(report, &where, "cannot write the distances");
    return image_output_finish(&output, status);
}
