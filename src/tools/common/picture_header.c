/* Header lines of pictures. */
#include "tools/common/picture_header.h"

void picture_header_set(picture_header *header, image *picture, const tool_arguments *arguments) {
    options_command_line(header->command, sizeof header->command, arguments->argc, arguments->argv);
    picture->command = header->command;
    picture->software = TOOL_SOFTWARE;
}
