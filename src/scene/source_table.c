/* Tabulating sources, and drawing from the table: first a row, then a cell in it. */
#include "scene/source_table.h"

#include <stdlib.h>

#include "base/angle.h"
#include "base/parallel.h"
#include "base/report.h"
#include "scene/light.h"

/* This part of all samples is drawn alike over the solid angle: what the table's samples missed is not lost. */
#define DRAWN_ALIKE 0.1

/* Cells begin at so many, twice as many across; each time they are halved both ways, until within a cell the radiance
 * differs from its mean by this part on the average. */
#define FEWEST_ROWS       32
#define MOST_ROWS         128 /* of functions */
#define MOST_PICTURE_ROWS 512
#define EVEN_ENOUGH       0.05

/* A cell is looked at in so many places, squared. */
#define LOOKS 2

struct source_table {
    frame axes;   /* z towards its centre */
    double reach; /* 1 - cosine of the half angle */
    size_t rows, columns;
    double *row_ends;  /* sums of probabilities up to a row's end */
    double *cell_ends; /* the same within the row, by row and column */
};

typedef struct filling {
    source_table *table;
    const scene_light *light;
    rgb *sums;      /* of the radiance, by row */
    double *spread; /* of the brightness in cells, by row */
} filling;

static vec3 direction_at(const source_table *t, double height, double turn) {
    double depth = height * t->reach, sine = sqrt(fmax(depth * (2 - depth), 0)), angle = 2 * PI * turn;
    return frame_to_world(&t->axes, vec3_make(sine * cos(angle), sine * sin(angle), 1 - depth));
}

static rgb radiance_towards(const scene_light *light, vec3 direction) {
    return light_patterned(light, light->radiance, vec3_make(0, 0, 0), direction, direction, GEOMETRY_FAR, 0);
}

/* Leaves brightness in cell_ends. */
static void fill_row(void *user, size_t row, int worker) {
    (void)worker;
    filling *f = user;
    source_table *t = f->table;
    f->sums[row] = rgb_gray(0);
    f->spread[row] = 0;
    for (size_t column = 0; column < t->columns; column++) {
        double looks[LOOKS * LOOKS], mean = 0;
        for (int k = 0; k < LOOKS * LOOKS; k++) {
            int down = k / LOOKS, across = k % LOOKS;
            double height = ((double)row + (down + 0.5) / LOOKS) / (double)t->rows;
            double turn = ((double)column + (across + 0.5) / LOOKS) / (double)t->columns;
            rgb radiance = radiance_towards(f->light, direction_at(t, height, turn));
            f->sums[row] = rgb_add(f->sums[row], radiance);
            looks[k] = rgb_brightness(radiance);
            mean += looks[k] / (LOOKS * LOOKS);
        }
        for (int k = 0; k < LOOKS * LOOKS; k++)
            f->spread[row] += fabs(looks[k] - mean);
        t->cell_ends[row * t->columns + column] = mean;
    }
}

/* Cells' brightness becomes probabilities, and sums of them. */
static void sum_up(source_table *t, double total) {
    double cells = (double)t->rows * (double)t->columns, before = 0;
    for (size_t row = 0; row < t->rows; row++) {
        double *cell = t->cell_ends + row * t->columns, sum = 0;
        for (size_t column = 0; column < t->columns; column++) {
            double share = total > 0 ? cell[column] / total : 1 / cells;
            sum += (1 - DRAWN_ALIKE) * share + DRAWN_ALIKE / cells;
            cell[column] = sum;
        }
        for (size_t column = 0; column < t->columns; column++)
            cell[column] /= sum;
        before += sum;
        t->row_ends[row] = before;
    }
    for (size_t row = 0; row < t->rows; row++)
        t->row_ends[row] /= before;
}

/* Fills a table of so many rows; *uneven is how much radiance differs within cells. */
static graze_status fill(source_table *t, size_t rows, const scene_light *light, arena *memory, int threads, rgb *mean,
                         double *uneven, const graze_report *report) {
    t->rows = rows;
    t->columns = 2 * rows;
    t->row_ends = arena_allocate(memory, rows * sizeof *t->row_ends);
    t->cell_ends = arena_allocate(memory, rows * t->columns * sizeof *t->cell_ends);
    filling f = {
        .table = t, .light = light, .sums = malloc(rows * sizeof(rgb)), .spread = malloc(rows * sizeof(double))};
    if (!t->row_ends || !t->cell_ends || !f.sums || !f.spread) {
        free(f.sums);
        free(f.spread);
        return report_out_of_memory(report);
    }
    parallel_for(threads, rows, fill_row, &f);
    rgb sum = {0, 0, 0};
    double spread = 0;
    for (size_t row = 0; row < rows; row++) {
        sum = rgb_add(sum, f.sums[row]);
        spread += f.spread[row];
    }
    free(f.sums);
    free(f.spread);
    double looks = LOOKS * LOOKS, all = rgb_brightness(sum);
    *mean = rgb_scale(1 / (looks * (double)rows * (double)t->columns), sum);
    *uneven = all > 0 ? spread / all : 0;
    sum_up(t, all / looks);
    return GRAZE_OK;
}

graze_status source_table_make(source_table **result, rgb *mean, const scene_light *light, arena *memory, int threads,
                               const graze_report *report) {
    source_table *t = *result = arena_allocate(memory, sizeof *t);
    if (!t)
        return report_out_of_memory(report);
    double half_sine = sin(light->half_angle / 2), uneven = 0;
    size_t pixels = material_modifiers_pixels(light->modifiers), rows = FEWEST_ROWS, most = MOST_ROWS;
    t->axes = frame_around(light->center);
    t->reach = 2 * half_sine * half_sine;
    if (pixels > 0)
        most = MOST_PICTURE_ROWS;
    while (rows < most && 2 * rows * rows < pixels)
        rows *= 2;
    graze_status status = fill(t, rows, light, memory, threads, mean, &uneven, report);
    while (!status && uneven > EVEN_ENOUGH && (rows *= 2) <= most)
        status = fill(t, rows, light, memory, threads, mean, &uneven, report);
    return status;
}

/* The first of the sums that is above the number, which becomes its place between that and the one before. */
static size_t search(const double *ends, size_t count, double *random) {
    size_t low = 0, high = count - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (ends[middle] > *random)
            high = middle;
        else
            low = middle + 1;
    }
    double begin = low > 0 ? ends[low - 1] : 0;
    *random = fmin(fmax((*random - begin) / (ends[low] - begin), 0), 0x1.fffffffffffffp-1);
    return low;
}

static double density_of(const source_table *t, size_t row, size_t column) {
    const double *cells = t->cell_ends + row * t->columns;
    double of_row = t->row_ends[row] - (row > 0 ? t->row_ends[row - 1] : 0);
    double of_cell = cells[column] - (column > 0 ? cells[column - 1] : 0);
    return of_row * of_cell * (double)t->rows * (double)t->columns / (2 * PI * t->reach);
}

vec3 source_table_draw(const source_table *t, const double random[2], double *density) {
    double height = random[0], turn = random[1];
    size_t row = search(t->row_ends, t->rows, &height);
    size_t column = search(t->cell_ends + row * t->columns, t->columns, &turn);
    *density = density_of(t, row, column);
    return direction_at(t, ((double)row + height) / (double)t->rows, ((double)column + turn) / (double)t->columns);
}

static size_t index_of(double part, size_t count) {
    double index = floor(part * (double)count);
    return index > 0 ? index < (double)count ? (size_t)index : count - 1 : 0;
}

double source_table_density(const source_table *t, vec3 direction) {
    vec3 local = frame_to_local(&t->axes, direction), apart = vec3_subtract(direction, t->axes.z);
    double turn = atan2(local.y, local.x) / (2 * PI);
    return density_of(t, index_of(vec3_dot(apart, apart) / 2 / t->reach, t->rows),
                      index_of(turn < 0 ? turn + 1 : turn, t->columns));
}
