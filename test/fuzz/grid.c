/* Fuzz target: what brdfeval's --grid describes. The first byte chooses the query, the rest is the description. */
#include <math.h>
#include <string.h>

#include "fuzz/target.h"
#include "tools/brdfeval/grid.h"

static void count_message(void *user, graze_severity severity, const char *text) {
    MUST(severity == GRAZE_ERROR && strlen(text) > 0);
    ++*(int *)user;
}

static int lies_between(double value, double a, double b) {
    double slack = 4e-16 * (fabs(a) + fabs(b));
    return value >= fmin(a, b) - slack && value <= fmax(a, b) + slack;
}

/* Values are FROM + i STEP, but for their own rounding: also those before a last one that is TO. */
static void check_steps(const grid_axis *axis, uint64_t each) {
    double from = axis->from / axis->scale, step = axis->step / axis->scale;
    for (uint64_t i = 0; i < axis->count; i += each) {
        double exact = from + (double)i * step, size = fabs(from) + fabs((double)i * step);
        bool last = i > 0 && i + 1 == axis->count;
        double value = grid_axis_value(axis, i);
        MUST(fabs(value - exact) <= (last && axis->meets ? 4e-15 : 4e-16) * size);
        MUST(!last || !axis->meets || value == axis->to);
    }
}

static void check_axis(const grid *g, const grid_axis *axis) {
    MUST(axis->input >= 0 && axis->input < g->input_count && axis->count >= 1);
    double first = grid_axis_value(axis, 0), last = grid_axis_value(axis, axis->count - 1), before = first;
    MUST(isfinite(first) && isfinite(last));
    uint64_t step = axis->count / 16 + 1;
    for (uint64_t i = 0; i < axis->count; i += step) {
        double value = grid_axis_value(axis, i);
        MUST(isfinite(value) && lies_between(value, first, last));
        MUST(lies_between(before, first, value));
        before = value;
    }
    const char *name = g->names[axis->input];
    if (strlen(name) == 1) /* a random number */
        MUST(first >= 0 && first < 1 && last >= 0 && last < 1);
    if (axis->kind == AXIS_STEPS)
        check_steps(axis, step);
    if (axis->kind == AXIS_ENDS)
        MUST(first == axis->from && (last == axis->to || axis->count == 1));
}

static void check_grid(const grid *g) {
    MUST(g->axis_count >= 1 && g->axis_count <= g->input_count && g->input_count <= INPUTS_MAX);
    uint64_t points = 1;
    for (int i = 0; i < g->axis_count; i++) {
        check_axis(g, &g->axes[i]);
        MUST(g->axes[i].count <= UINT64_MAX / points);
        points *= g->axes[i].count;
        for (int k = 0; k < i; k++)
            MUST(g->axes[k].input != g->axes[i].input);
    }
    MUST(points == g->points);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const queries[] = {"eval", "sample", "pair", "albedo"};
    if (size < 1)
        return 0;
    char *spec = malloc(size);
    if (!spec)
        return 0;
    memcpy(spec, data + 1, size - 1);
    spec[size - 1] = 0;
    int messages = 0;
    graze_report report = {count_message, &messages};
    grid g;
    graze_status status = grid_parse(&g, spec, evaluation_find_query(queries[data[0] % 4]), &report);
    MUST(status == GRAZE_OK || status == GRAZE_INPUT_ERROR);
    MUST(messages == (status == GRAZE_OK ? 0 : 1));
    if (status == GRAZE_OK)
        check_grid(&g);
    free(spec);
    return 0;
}
