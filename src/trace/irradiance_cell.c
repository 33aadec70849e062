/* What arrives at a cell: paths from the points that pilot paths have come to in it. */
#include "trace/irradiance_cell.h"

#include <math.h>

#include "base/angle.h"
#include "base/even_steps.h"
#include "trace/path.h"
#include "trace/sampler.h"

/* Paths from where pilot paths end tell a cell's irradiance: so many that its own noise, which is averaged over all
 * cells that a pixel sees, is this many times the error asked for, of its value or of the floor, and within these
 * bounds. */
#define NOISE_OF_ERROR 5.0
#define FEWEST_PATHS   16
#define MOST_PATHS     1024
/* A cell that more pilot paths have come to than this is seen by more of the picture, whose mean has its noise: that is
 * the less, as the root of their number is the more. Such a cell may have so many paths for each of them. */
#define OFTEN_SEEN     16.0
#define PATHS_OF_PILOT 4
/* Where they have found less than the floor there may be more than they have found: the less, the more of them. */
#define PATHS_BELIEVED 128

/* Points are lifted by this part of a cell's edge to see each other. */
#define LIFT 0.0625

/* Whether nothing stands between the points that paths have come to: a wall that divides a cell keeps light from one
 * side that the other has. */
static bool is_in_one_place(const irradiance_filling *f, const irradiance_cell *c) {
    const irradiance_record *first = &f->records[c->first].record;
    double lift = LIFT * irradiance_cell_edge(f->part, first->distance);
    vec3 from = vec3_add_scaled(first->point, lift, first->normal);
    for (size_t i = 1; i < c->count; i++) {
        const irradiance_record *other = &f->records[c->first + i].record;
        vec3 way = vec3_subtract(vec3_add_scaled(other->point, lift, other->normal), from);
        geometry_ray ray = {.origin = from, .direction = vec3_safe_normalize(way), .far = vec3_length(way), .from = -1};
        if (ray.far > 0 && geometry_occluded(f->context->scene->geometry, &ray, -1))
            return false;
    }
    return true;
}

typedef struct half_cell {
    uint64_t key;
    size_t taken;
    rgb sum[IRRADIANCE_HALF_PARTS];
    irradiance_place_sums all;
} half_cell;

/* Ends in the golden section's order: however many, they are evenly spread over all of a cell's. */
static const irradiance_end *end_at(const irradiance_filling *f, const irradiance_cell *c, size_t number) {
    size_t index = (size_t)(even_step((double)number, GOLDEN_SECTION) * (double)c->count);
    return &f->records[c->first + (index < c->count ? index : 0)];
}

static void take_path(const irradiance_filling *f, const irradiance_end *from, path_memory *memory, half_cell *h,
                      int part) {
    path_context context = *f->context;
    context.memory = memory;
    sampler points = sampler_start(h->key, (uint32_t)h->taken++);
    path_sample sample;
    path_irradiance_at(&context, &from->record, &points, &sample);
    rgb value = sample.radiance;
    for (int k = 0; k < sample.control_count; k++)
        value = rgb_add(value, sample.controls[k].difference);
    h->sum[part] = rgb_add(h->sum[part], value);
    irradiance_add_place(&h->all, from->place, value);
}

static void take_until(const irradiance_filling *f, const irradiance_cell *c, path_memory *memory,
                       half_cell halves[IRRADIANCE_HALVES], int half, size_t goal) {
    half_cell *h = &halves[half];
    size_t first = h->taken, run = (goal - first) / IRRADIANCE_HALF_PARTS;
    for (size_t i = first; i < goal; i++)
        take_path(f, end_at(f, c, i * IRRADIANCE_HALVES + (size_t)half), memory, h, (int)((i - first) / run));
}

/* Whether so many paths of a half are enough, as the other finds. */
static bool is_enough(const irradiance_filling *f, const irradiance_cell *c, const half_cell *judge, size_t taken) {
    const graze_trace_settings *s = f->context->settings;
    double count = (double)judge->taken, mean = judge->all.brightness / count, floor = PI * s->floor;
    double variance = fmax(judge->all.squares - mean * judge->all.brightness, 0) / (count - 1);
    double seen = fmin(sqrt(OFTEN_SEEN / (double)c->count), 1), all = (double)taken * IRRADIANCE_HALVES;
    double allowed = NOISE_OF_ERROR * s->error * seen * fmax(mean, floor);
    if (all < PATHS_BELIEVED && all * mean < FEWEST_PATHS * floor)
        return false;
    return variance <= allowed * allowed * all;
}

void irradiance_cell_fill(const irradiance_filling *f, irradiance_cell *c) {
    c->whole = is_in_one_place(f, c);
    if (!c->whole)
        return;
    path_memory memory;
    path_memory_begin(&memory, false);
    half_cell halves[IRRADIANCE_HALVES] = {{.taken = 0}, {.taken = 0}};
    for (int i = 0; i < IRRADIANCE_HALVES; i++)
        halves[i].key =
            sampler_key(f->context->settings->seed, c->key, 0x2000000u + f->number * IRRADIANCE_HALVES + (uint32_t)i);
    bool enough[IRRADIANCE_HALVES] = {false, false};
    size_t most = PATHS_OF_PILOT * c->count > MOST_PATHS ? PATHS_OF_PILOT * c->count : MOST_PATHS;
    for (size_t goal = FEWEST_PATHS / IRRADIANCE_HALVES; goal <= most / IRRADIANCE_HALVES && !(enough[0] && enough[1]);
         goal *= 2) {
        for (int i = 0; i < IRRADIANCE_HALVES; i++)
            if (!enough[i])
                take_until(f, c, &memory, halves, i, goal);
        for (int i = 0; i < IRRADIANCE_HALVES; i++)
            enough[i] = enough[i] || is_enough(f, c, &halves[1 - i], halves[i].taken);
    }
    for (int k = 0; k < IRRADIANCE_CELL_PARTS; k++) {
        const half_cell *h = &halves[k / IRRADIANCE_HALF_PARTS];
        c->irradiance[k] =
            rgb_scale((double)IRRADIANCE_HALF_PARTS / (double)h->taken, h->sum[k % IRRADIANCE_HALF_PARTS]);
    }
    for (int i = 0; i < IRRADIANCE_HALVES; i++)
        c->slopes[i] = irradiance_find_slope(&halves[i].all, halves[i].taken);
}
