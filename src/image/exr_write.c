/* OpenEXR files, through OpenEXRCore. */
#include "image/exr.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <string.h>
#include <unistd.h>

#include <OpenEXR/openexr.h>

#include "image/color.h"

/* Where the bytes go, and what went wrong on the way. */
typedef struct exr_sink {
    int descriptor;
    int error; /* errno of a failing write */
    char message[256];
} exr_sink;

static int64_t write_bytes(exr_const_context_t context, void *user, const void *buffer, uint64_t size, uint64_t offset,
                           exr_stream_error_func_ptr_t fail) {
    (void)context;
    (void)fail; /* the writer's status and errno say it all */
    exr_sink *sink = user;
    for (uint64_t done = 0; done < size;) {
        ssize_t count = pwrite(sink->descriptor, (const char *)buffer + done, size - done, (off_t)(offset + done));
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0) {
            sink->error = count < 0 ? errno : ENOSPC;
            return -1;
        }
        done += (uint64_t)count;
    }
    return (int64_t)size;
}

static void keep_message(exr_const_context_t context, exr_result_t code, const char *message) {
    void *user = NULL;
    (void)code;
    if (exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || !user)
        return;
    exr_sink *sink = user;
    strncpy(sink->message, message, sizeof sink->message - 1);
}

static exr_result_t set_text(exr_context_t context, const char *name, const char *text) {
    return text && *text ? exr_attr_set_string(context, 0, name, text) : EXR_ERR_SUCCESS;
}

static exr_result_t set_attributes(exr_context_t context, const image *picture) {
    const image_primaries *p = &image_radiance_primaries;
    exr_attr_chromaticities_t chromaticities = {(float)p->red[0],   (float)p->red[1],  (float)p->green[0],
                                                (float)p->green[1], (float)p->blue[0], (float)p->blue[1],
                                                (float)p->white[0], (float)p->white[1]};
    exr_result_t result = exr_attr_set_chromaticities(context, 0, "chromaticities", &chromaticities);
    /* cd/m^2 of (1, 1, 1) */
    if (result == EXR_ERR_SUCCESS)
        result = exr_attr_set_float(context, 0, "whiteLuminance", (float)IMAGE_LUMINOUS_EFFICACY);
    /* What the values have been multiplied by, as behind Radiance's EXPOSURE=. */
    if (result == EXR_ERR_SUCCESS)
        result = exr_attr_set_float(context, 0, "exposure", 1);
    /* OpenEXR's ratio is width over height. */
    if (result == EXR_ERR_SUCCESS)
        result = exr_set_pixel_aspect_ratio(context, 0, (float)(1 / picture->pixel_aspect));
    /* `view` itself names the eye in pictures with several. */
    if (result == EXR_ERR_SUCCESS)
        result = set_text(context, "radianceView", picture->view);
    if (result == EXR_ERR_SUCCESS)
        result = set_text(context, "command", picture->command);
    if (result == EXR_ERR_SUCCESS)
        result = set_text(context, "software", picture->software);
    if (result == EXR_ERR_SUCCESS && picture->frame > 0)
        result = exr_attr_set_int(context, 0, "frame", picture->frame);
    return result;
}

static exr_result_t write_header(exr_context_t context, const image *picture) {
    int part;
    exr_result_t result = exr_set_longname_support(context, 1);
    if (result == EXR_ERR_SUCCESS)
        result = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, &part);
    if (result == EXR_ERR_SUCCESS)
        result =
            exr_initialize_required_attr_simple(context, part, picture->width, picture->height, EXR_COMPRESSION_ZIP);
    for (int c = 0; c < picture->channel_count && result == EXR_ERR_SUCCESS; c++)
        result = exr_add_channel(context, part, picture->channel_names[c], EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    if (result == EXR_ERR_SUCCESS)
        result = set_attributes(context, picture);
    return result == EXR_ERR_SUCCESS ? exr_write_header(context) : result;
}

/* Tells the encoder where the rows of each channel begin; it knows the channels in an order of its own. */
static exr_result_t point_to_rows(exr_encode_pipeline_t *encoder, const image *picture, int y) {
    for (int c = 0; c < encoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &encoder->channels[c];
        const float *plane = image_channel(picture, channel->channel_name);
        if (!plane)
            return EXR_ERR_INVALID_ARGUMENT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = sizeof(float);
        channel->user_line_stride = (int32_t)sizeof(float) * picture->width;
        channel->encode_from_ptr = (const uint8_t *)(plane + (size_t)y * (size_t)picture->width);
    }
    return EXR_ERR_SUCCESS;
}

static exr_result_t write_chunks(exr_context_t context, const image *picture) {
    int32_t rows;
    exr_result_t result = exr_get_scanlines_per_chunk(context, 0, &rows);
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool is_initialized = false;
    for (int y = 0; y < picture->height && result == EXR_ERR_SUCCESS; y += rows) {
        exr_chunk_info_t chunk;
        result = exr_write_scanline_chunk_info(context, 0, y, &chunk);
        if (result != EXR_ERR_SUCCESS)
            break;
        result = is_initialized ? exr_encoding_update(context, 0, &chunk, &encoder)
                                : exr_encoding_initialize(context, 0, &chunk, &encoder);
        if (result == EXR_ERR_SUCCESS)
            result = point_to_rows(&encoder, picture, y);
        if (result == EXR_ERR_SUCCESS && !is_initialized)
            result = exr_encoding_choose_default_routines(context, 0, &encoder);
        is_initialized = true;
        if (result == EXR_ERR_SUCCESS)
            result = exr_encoding_run(context, 0, &encoder);
    }
    if (is_initialized)
        exr_encoding_destroy(context, &encoder);
    return result;
}

static exr_result_t write_picture(const image *picture, const char *name, exr_sink *sink) {
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = keep_message;
    initializer.user_data = sink;
    initializer.write_fn = write_bytes;
    exr_context_t context = NULL;
    exr_result_t result = exr_start_write(&context, name, EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (result != EXR_ERR_SUCCESS)
        return result;
    result = write_header(context, picture);
    if (result == EXR_ERR_SUCCESS)
        result = write_chunks(context, picture);
    /* The offsets of the chunks are written last. */
    exr_result_t finished = exr_finish(&context);
    return result != EXR_ERR_SUCCESS ? result : finished;
}

graze_status image_write_exr(const image *picture, const char *path, const char *name, const graze_report *report) {
    place where = {.file = name};
    exr_sink sink = {.descriptor = open(path, O_WRONLY | O_TRUNC | O_CREAT | O_CLOEXEC, 0666)};
    if (sink.descriptor < 0)
        return report_file_error(report, &where, "cannot be opened for writing");
    exr_result_t result = write_picture(picture, name, &sink);
    if (close(sink.descriptor) != 0 && !sink.error)
        sink.error = errno;
    if (sink.error) {
        errno = sink.error;
        return report_system_error(report, &where, "cannot write the picture");
    }
    if (result == EXR_ERR_SUCCESS)
        return GRAZE_OK;
    if (result == EXR_ERR_OUT_OF_MEMORY)
        return report_out_of_memory(report);
    report_error(report, &where, "OpenEXR: %s", sink.message[0] ? sink.message : exr_get_default_error_message(result));
    return GRAZE_SYSTEM_ERROR;
}
