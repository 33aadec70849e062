/* Header lines of records. */
#include "tools/common/record_header.h"

#include <stdio.h>

static const char *format_name(char format) {
    switch (format) {
    case 'f':
        return "float";
    case 'd':
        return "double";
    case 'c':
        return "32-bit_rle_rgbe";
    default:
        return "ascii";
    }
}

void record_header_append(record_buffer *out, const tool_arguments *arguments, int numbers, char format) {
    char line[TOOL_COMMAND_SIZE];
    options_command_line(line, sizeof line, arguments->argc, arguments->argv);
    record_append_text(out, "#?RADIANCE\n");
    record_append_text(out, line);
    snprintf(line, sizeof line, "\nSOFTWARE= " TOOL_SOFTWARE "\nNCOMP=%d\n", numbers);
    record_append_text(out, line);
    if (format == 'f' || format == 'd') {
        snprintf(line, sizeof line, "BigEndian=%d\n", record_is_big_endian());
        record_append_text(out, line);
    }
    snprintf(line, sizeof line, "FORMAT=%s\n\n", format_name(format));
    record_append_text(out, line);
}
