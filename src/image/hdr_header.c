/* The text at the beginning of a Radiance picture. */
#include "image/hdr.h"

#include <stdlib.h>
#include <string.h>

#include "base/number.h"

/* Far beyond any header met; what is longer is no picture. */
enum { LONGEST_HEADER = 1 << 20 };
/* A side longer than this is a damaged or hostile file. */
enum { LONGEST_SIDE = 1 << 20 };

typedef struct header_line {
    char *text;
    size_t capacity;
    int number;
} header_line;

static graze_status header_error(const image_source *source, const header_line *line, const char *text) {
    return report_error(source->report, &(place){.file = source->name, .line = line->number}, "%s", text);
}

static graze_status append(image_source *source, header_line *line, size_t length, int byte) {
    if (length + 1 >= line->capacity) {
        size_t capacity = 2 * line->capacity + 256;
        char *text = realloc(line->text, capacity);
        if (!text)
            return report_out_of_memory(source->report);
        line->text = text;
        line->capacity = capacity;
    }
    line->text[length] = (char)byte;
    line->text[length + 1] = 0;
    return GRAZE_OK;
}

/* Reads a line; its end, with or without carriage return, is taken away. */
static graze_status read_line(image_source *source, header_line *line) {
    size_t length = 0;
    line->number++;
    for (;;) {
        int byte = image_source_byte(source);
        if (byte == EOF)
            return ferror(source->in)
                       ? report_system_error(source->report, &(place){.file = source->name}, "cannot read")
                       : header_error(source, line, "the file ends within the picture's header");
        if (source->offset > LONGEST_HEADER)
            return header_error(source, line, "the picture's header does not end");
        if (byte == 0)
            return header_error(source, line, "a zero byte within the picture's header");
        graze_status status = append(source, line, length, byte == '\n' ? 0 : byte);
        if (status != GRAZE_OK)
            return status;
        if (byte == '\n')
            break;
        length++;
    }
    if (length > 0 && line->text[length - 1] == '\r')
        line->text[length - 1] = 0;
    return GRAZE_OK;
}

/* What follows `NAME=`, or null where the line does not begin so. */
static const char *value_of(const char *line, const char *name) {
    size_t length = strlen(name);
    if (strncmp(line, name, length) != 0 || line[length] != '=')
        return NULL;
    return line + length + 1 + strspn(line + length + 1, " \t");
}

/* Exactly `count` numbers. */
static bool read_reals(const char *text, int count, double *values) {
    for (int i = 0; i < count; i++) {
        text += strspn(text, " \t");
        size_t length = strcspn(text, " \t");
        char word[64];
        if (length >= sizeof word)
            return false;
        memcpy(word, text, length);
        word[length] = 0;
        if (!text_to_real(word, &values[i]))
            return false;
        text += length;
    }
    return text[strspn(text, " \t")] == 0;
}

/* Multiplies one or three positive factors into what earlier lines gave. */
static graze_status take_factors(const char *text, int count, double *products, const char *name,
                                 const image_source *source, const header_line *line) {
    place where = {.file = source->name, .line = line->number};
    double factors[3];
    bool good = read_reals(text, count, factors);
    for (int i = 0; i < count && good; i++)
        good = factors[i] > 0;
    if (!good)
        return report_error(source->report, &where, "%s must be %s", name,
                            count == 1 ? "one positive number" : "three positive numbers");
    for (int i = 0; i < count; i++) {
        products[i] *= factors[i];
        if (!(products[i] > 1e-37 && products[i] < 1e37))
            return report_error(source->report, &where, "the product of the picture's %s is not within 1e-37 and 1e37",
                                name);
    }
    return GRAZE_OK;
}

/* *target becomes `text`, behind what it was and a blank where `join` is set. */
static bool keep_text(char **target, const char *text, bool join) {
    size_t before = join && *target ? strlen(*target) + 1 : 0;
    size_t size = strlen(text) + 1;
    char *kept = malloc(before + size);
    if (!kept)
        return false;
    if (before > 0) {
        memcpy(kept, *target, before - 1);
        kept[before - 1] = ' ';
    }
    memcpy(kept + before, text, size);
    free(*target);
    *target = kept;
    return true;
}

static bool read_primaries(const char *text, image_hdr_header *header) {
    double v[8];
    if (!read_reals(text, 8, v))
        return false;
    header->primaries = (image_primaries){{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
    header->has_primaries = true;
    return true;
}

static bool read_format(const char *text, image_hdr_header *header) {
    header->xyz = !strncmp(text, "32-bit_rle_xyze", 15);
    return header->xyz || !strncmp(text, "32-bit_rle_rgbe", 15);
}

/* Whether the line is NAME=..., of whatever name, and no command. */
static bool is_variable(const char *line) {
    size_t length = strspn(line, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_");
    return length > 0 && line[length] == '=';
}

static graze_status take_line(image_hdr_header *header, const image_source *source, const header_line *line) {
    const char *value;
    bool memory = true;
    if ((value = value_of(line->text, "FORMAT"))) {
        if (!read_format(value, header))
            return header_error(source, line, "only 32-bit_rle_rgbe and 32-bit_rle_xyze pictures can be read");
    } else if ((value = value_of(line->text, "EXPOSURE"))) {
        return take_factors(value, 1, &header->exposure, "EXPOSURE", source, line);
    } else if ((value = value_of(line->text, "COLORCORR"))) {
        return take_factors(value, 3, header->correction, "COLORCORR", source, line);
    } else if ((value = value_of(line->text, "PIXASPECT"))) {
        return take_factors(value, 1, &header->pixel_aspect, "PIXASPECT", source, line);
    } else if ((value = value_of(line->text, "PRIMARIES"))) {
        if (!read_primaries(value, header))
            return header_error(source, line, "PRIMARIES must be eight numbers");
    } else if ((value = value_of(line->text, "VIEW"))) {
        memory = keep_text(&header->view, value, true);
    } else if ((value = value_of(line->text, "SOFTWARE"))) {
        memory = keep_text(&header->software, value, false);
    } else if (line->text[0] != '\t' && !is_variable(line->text)) {
        memory = keep_text(&header->command, line->text, false);
    }
    return memory ? GRAZE_OK : report_out_of_memory(source->report);
}

/* One half of the resolution line: "-Y 512". A length too large is one above LONGEST_SIDE. */
static bool read_axis(const char **text, char *axis, bool *negative, int *length) {
    *text += strspn(*text, " \t");
    if ((*text)[0] != '+' && (*text)[0] != '-')
        return false;
    *negative = (*text)[0] == '-';
    *axis = (*text)[1];
    if (*axis != 'X' && *axis != 'Y')
        return false;
    *text += 2;
    *text += strspn(*text, " \t");
    size_t digits = strspn(*text, "0123456789");
    if (digits < 1)
        return false;
    *length = 0;
    for (size_t i = 0; i < digits && *length <= LONGEST_SIDE; i++)
        *length = 10 * *length + ((*text)[i] - '0');
    *text += digits;
    return true;
}

static graze_status take_resolution(image_hdr_header *header, const image_source *source, const header_line *line) {
    const char *text = line->text;
    char axis[2];
    bool negative[2];
    int length[2];
    if (!read_axis(&text, &axis[0], &negative[0], &length[0]) ||
        !read_axis(&text, &axis[1], &negative[1], &length[1]) || axis[0] == axis[1] || text[strspn(text, " \t")] != 0)
        return header_error(source, line, "the picture's size must read as in `-Y 480 +X 640`");
    int x = axis[0] == 'X' ? 0 : 1;
    header->columns = x == 0;
    header->width = length[x];
    header->height = length[1 - x];
    header->right_to_left = negative[x];
    header->bottom_to_top = !negative[1 - x];
    if (header->width < 1 || header->height < 1)
        return header_error(source, line, "the picture is empty");
    if (header->width > LONGEST_SIDE || header->height > LONGEST_SIDE)
        return header_error(source, line, "the picture is too large: a side is longer than 1048576 pixels");
    return GRAZE_OK;
}

static graze_status read_lines(image_hdr_header *header, image_source *source, header_line *line) {
    graze_status status = read_line(source, line);
    if (status != GRAZE_OK)
        return status;
    if (strncmp(line->text, "#?", 2) != 0)
        return header_error(source, line, "no Radiance picture: it does not begin with #?RADIANCE");
    while ((status = read_line(source, line)) == GRAZE_OK && line->text[0] != 0)
        if ((status = take_line(header, source, line)) != GRAZE_OK)
            return status;
    if (status != GRAZE_OK || (status = read_line(source, line)) != GRAZE_OK)
        return status;
    return take_resolution(header, source, line);
}

graze_status image_hdr_read_header(image_hdr_header *header, image_source *source) {
    *header = (image_hdr_header){.exposure = 1, .correction = {1, 1, 1}, .pixel_aspect = 1};
    header_line line = {0};
    graze_status status = read_lines(header, source, &line);
    free(line.text);
    return status;
}

void image_hdr_header_free(image_hdr_header *header) {
    free(header->view);
    free(header->command);
    free(header->software);
}
