/* Header lines of records. */
#include "tools/common/record_header.h"

#include <stdio.h>

static const char *format_name(const record_header *header) {
    switch (header->format) {
    case 'f':
        return "float";
    case 'd':
        return "double";
    case 'c':
        return header->xyz ? "32-bit_rle_xyze" : "32-bit_rle_rgbe";
    default:
        return "ascii";
    }
}

static void append_primaries(record_buffer *out, const double *primaries) {
    record_append_text(out, "PRIMARIES=");
    for (int i = 0; i < 8; i++) {
        char number[NUMBER_TEXT_SIZE];
        record_append_text(out, " ");
        number_print(number, 6, primaries[i]);
        record_append_text(out, number);
    }
    record_append_text(out, "\n");
}

void record_header_append(record_buffer *out, const tool_arguments *arguments, const record_header *header) {
    char line[TOOL_COMMAND_SIZE];
    options_command_line(line, sizeof line, arguments->argc, arguments->argv);
    record_append_text(out, "#?RADIANCE\n");
    record_append_text(out, line);
    record_append_text(out, "\nSOFTWARE= " TOOL_SOFTWARE "\n");
    if (header->numbers > 0) {
        snprintf(line, sizeof line, "NCOMP=%d\n", header->numbers);
        record_append_text(out, line);
    }
    if (header->primaries)
        append_primaries(out, header->primaries);
    if (header->format == 'f' || header->format == 'd') {
        snprintf(line, sizeof line, "BigEndian=%d\n", record_is_big_endian());
        record_append_text(out, line);
    }
    snprintf(line, sizeof line, "FORMAT=%s\n\n", format_name(header));
    record_append_text(out, line);
}
