/* Fuzz target: data files. Whatever they say is read or refused, and what is read has finite values everywhere. */
#include <math.h>

#include "fuzz/target.h"
#include "rad/data_file.h"

static void count_message(void *user, graze_severity severity, const char *text) {
    MUST(*text);
    *(int *)user += severity == GRAZE_ERROR;
}

static void look_up(const rad_data *data) {
    static const double places[] = {0, -1, 1.5, 1e9, -1e30};
    double point[RAD_DATA_DIMENSIONS], value;
    for (int i = 0; i < 5; i++) {
        for (int d = 0; d < data->dimensions; d++)
            point[d] = places[(i + d) % 5];
        rad_data_values(data, &data->values, 1, point, &value);
        /* Grids may be as narrow, and values as large, as doubles and floats are. */
        MUST(!isnan(value) || fabs(data->axes[0].length) < 1e-250);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int errors = 0;
    const graze_report report = {count_message, &errors};
    arena *memory = arena_create();
    rad_data read;
    MUST(memory);
    graze_status status = rad_data_parse(&read, memory, (const char *)data, size, "fuzz.dat", NULL, &report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST((errors > 0) == (status != GRAZE_OK));
    if (!status)
        look_up(&read);
    arena_destroy(memory);
    return 0;
}
