/* Filling tables, in order, on several threads, with a few rows in memory at a time. */
#include "tools/brdfeval/table.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "tools/brdfeval/block.h"
#include "tools/brdfeval/direction.h"
#include "tools/brdfeval/table_text.h"

/* A worker's memory. */
typedef struct workspace {
    block_double block;
    double inputs[INPUTS_MAX][BLOCK_RECORDS];
    double numbers[BLOCK_RECORDS * NUMBERS_MAX];
} workspace;

typedef struct chunk {
    uint64_t first;
    size_t count;
    record_buffer output;
} chunk;

typedef struct run {
    const table_job *job;
    workspace *workspaces;
    size_t chunk_rows;
    uint64_t begun, written;
    progress *progress;
    const graze_report *report;
} run;

/* --- Points ------------------------------------------------------------------------------------------------------ */

/* Steps on to the next point: the last axis first. */
static void step(const grid *g, uint64_t index[INPUTS_MAX], double point[INPUTS_MAX]) {
    for (int i = g->axis_count - 1; i >= 0; i--) {
        const grid_axis *axis = &g->axes[i];
        index[i] = index[i] + 1 < axis->count ? index[i] + 1 : 0;
        point[axis->input] = grid_axis_value(axis, index[i]);
        if (index[i] > 0)
            break;
    }
}

static void fill_inputs(workspace *w, const grid *g, uint64_t first) {
    uint64_t index[INPUTS_MAX];
    double point[INPUTS_MAX] = {0};
    for (int i = g->axis_count - 1; i >= 0; i--) {
        index[i] = first % g->axes[i].count;
        first /= g->axes[i].count;
        point[g->axes[i].input] = grid_axis_value(&g->axes[i], index[i]);
    }
    for (size_t row = 0; row < w->block.count; row++) {
        for (int i = 0; i < g->input_count; i++)
            w->inputs[i][row] = point[i];
        step(g, index, point);
    }
}

/* Neighbours share most angles. */
static void fill_directions(workspace *w, int which) {
    const double *theta = w->inputs[2 * which], *phi = w->inputs[2 * which + 1];
    direction_angle t = direction_angle_of(theta[0]), p = direction_angle_of(phi[0]);
    for (size_t row = 0; row < w->block.count; row++) {
        if (theta[row] != t.degrees)
            t = direction_angle_of(theta[row]);
        if (phi[row] != p.degrees)
            p = direction_angle_of(phi[row]);
        block_double_set_direction(&w->block, which, row, direction_from_angles(t, p));
    }
}

static void fill_block(workspace *w, const query *q) {
    for (int i = 0; i < q->directions; i++)
        fill_directions(w, i);
    for (int i = 0; i < q->random_numbers; i++)
        memcpy(w->block.input[3 * q->directions + i], w->inputs[2 * q->directions + i],
               w->block.count * sizeof(double));
}

/* --- Rows -------------------------------------------------------------------------------------------------------- */

/* An input's text, with a comma behind it. */
typedef struct input_text {
    double value;
    size_t length;
    char text[NUMBER_TEXT_SIZE + 1];
} input_text;

static void append_input(record_buffer *out, input_text *t, double value) {
    if (t->length == 0 || t->value != value) {
        t->value = value;
        t->length = number_print_exact(t->text, value);
        t->text[t->length++] = ',';
    }
    record_append_bytes(out, t->text, t->length);
}

static void append_csv(record_buffer *out, const workspace *w, const grid *g, int numbers) {
    input_text texts[INPUTS_MAX] = {0};
    for (size_t row = 0; row < w->block.count; row++) {
        for (int i = 0; i < g->input_count; i++)
            append_input(out, &texts[i], w->inputs[i][row]);
        for (int i = 0; i < numbers; i++) {
            char text[NUMBER_TEXT_SIZE + 1];
            size_t length = number_print(text, 17, w->numbers[row * (size_t)numbers + (size_t)i]);
            text[length] = i + 1 < numbers ? ',' : '\n';
            record_append_bytes(out, text, length + 1);
        }
    }
}

static void append_npy(record_buffer *out, const workspace *w, const grid *g, int numbers) {
    for (size_t row = 0; row < w->block.count; row++) {
        double point[INPUTS_MAX];
        for (int i = 0; i < g->input_count; i++)
            point[i] = w->inputs[i][row];
        record_append_bytes(out, point, (size_t)g->input_count * sizeof *point);
        record_append_bytes(out, &w->numbers[row * (size_t)numbers], (size_t)numbers * sizeof *w->numbers);
    }
}

static void append_rows(const table_job *j, workspace *w, uint64_t first, size_t count, record_buffer *out) {
    const evaluation *e = j->evaluation;
    w->block.count = count;
    fill_inputs(w, j->grid, first);
    fill_block(w, e->query);
    block_double_answer(&w->block, e, w->numbers);
    if (j->format == TABLE_CSV)
        append_csv(out, w, j->grid, e->numbers);
    else
        append_npy(out, w, j->grid, e->numbers);
}

/* --- The pipeline ------------------------------------------------------------------------------------------------ */

static graze_status begin_chunk(void *user, void *memory, bool *more) {
    run *r = user;
    chunk *c = memory;
    uint64_t left = r->job->grid->points - r->begun;
    c->first = r->begun;
    c->count = left < r->chunk_rows ? (size_t)left : r->chunk_rows;
    r->begun += c->count;
    *more = c->count > 0;
    return GRAZE_OK;
}

static void fill_chunk(void *user, void *memory, int worker) {
    const run *r = user;
    chunk *c = memory;
    for (size_t done = 0, count; done < c->count; done += count) {
        count = c->count - done < BLOCK_RECORDS ? c->count - done : BLOCK_RECORDS;
        append_rows(r->job, &r->workspaces[worker], c->first + done, count, &c->output);
    }
}

static graze_status write_chunk(void *user, void *memory) {
    run *r = user;
    chunk *c = memory;
    r->written += c->count;
    progress_update(r->progress, (double)r->written / (double)r->job->grid->points, NULL);
    return record_buffer_write(&c->output, STDOUT_FILENO, "standard output", r->report);
}

static graze_status write_header(const table_job *j, const graze_report *report) {
    record_buffer out = {0};
    if (j->format == TABLE_CSV)
        table_append_csv_header(&out, j->evaluation, j->grid);
    else
        table_append_npy_header(&out, j->evaluation, j->grid);
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}

static graze_status write_rows(run *r, chunk *chunks, int chunk_count) {
    graze_status status = write_header(r->job, r->report);
    /* A progress line would mix with a table on the same terminal. */
    r->progress = progress_start("tabulating", !isatty(STDOUT_FILENO));
    const pipeline p = {r->job->threads, chunks, sizeof *chunks, chunk_count, r, begin_chunk, fill_chunk, write_chunk};
    if (status == GRAZE_OK)
        status = pipeline_run(&p, r->report);
    progress_finish(r->progress);
    return status;
}

graze_status table_write(const table_job *j, const graze_report *report) {
    int chunk_count = pipeline_chunk_count(j->threads);
    chunk *chunks = calloc((size_t)chunk_count, sizeof *chunks);
    run r = {.job = j, .chunk_rows = (size_t)evaluation_chunk_records(j->evaluation, j->flush), .report = report};
    r.workspaces = aligned_alloc(_Alignof(workspace), (size_t)j->threads * sizeof *r.workspaces);
    graze_status status = chunks && r.workspaces ? write_rows(&r, chunks, chunk_count) : report_out_of_memory(report);
    for (int i = 0; i < chunk_count && chunks; i++)
        record_buffer_free(&chunks[i].output);
    free(r.workspaces);
    free(chunks);
    return status;
}
