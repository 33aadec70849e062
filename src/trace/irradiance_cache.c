/* Cells of irradiance: from pilot paths' ends to averages, found by hashing. */
#include "trace/irradiance_cache.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/even_steps.h"
#include "base/parallel.h"
#include "base/report.h"
#include "scene/surface.h"
#include "trace/path.h"
#include "trace/sampler.h"

enum { CACHES = 2, CELL_PARTS = IRRADIANCE_PARTS / CACHES, PATHS_PER_PILOT = 16 };

/* A cell's edge is at most this part of the distance that a path comes from, at an error of 0.03 and more; of smaller
 * errors, a smaller one, so that what cells get wrong by being as large as they are stays small beside them: about a
 * thousandth of the value at the largest part, and half a hundredth where that bends most. */
#define LARGEST_PART  0.25
#define PART_OF_ERROR (LARGEST_PART / 0.03)

/* Fewer pilot paths make no cell. */
#define FEWEST_POINTS 4

/* Paths from their ends tell a cell's irradiance: so many that its own noise, which is averaged over all cells that a
 * pixel sees, is this many times the error asked for, of its value or of the floor, and within these bounds. */
#define NOISE_OF_ERROR 5.0
#define FEWEST_PATHS   16
#define MOST_PATHS     1024
/* A cell that more pilot paths have come to than this is seen by more of the picture, whose mean has its noise: that is
 * the less, as the root of their number is the more. Such a cell may have so many paths for each of them. */
#define OFTEN_SEEN     16.0
#define PATHS_OF_PILOT 4
/* Where they have found less than the floor there may be more than they have found: the less, the more of them. */
#define PATHS_BELIEVED 128

/* Of what is in no cell. */
#define NO_KEY UINT64_MAX
/* Coordinates in edges of cells beyond which these cannot be told apart. */
#define LARGEST_PLACE 0x1p50

/* Half of a cell's paths, a sequence of its own; the other half decides how many they are (trace/estimate.h says why).
 * Parts are runs of equal length in it. */
enum { HALVES = 2, HALF_PARTS = CELL_PARTS / HALVES };

/* Where in a cell, from its middle, in edges; the axis that a normal is nearest to does not count. */
typedef struct cell_place {
    double x, y;
} cell_place;

/* How irradiance changes over a cell, as a half has found. */
typedef struct cell_slope {
    cell_place middle; /* of the half's paths */
    rgb x, y;          /* per edge */
} cell_slope;

typedef struct cell {
    uint64_t key;
    size_t first, count; /* among the sorted records */
    bool whole;          /* all are in one place */
    rgb irradiance[CELL_PARTS];
    cell_slope slopes[HALVES];
} cell;

/* What a path has come to, by cell. */
typedef struct keyed_record {
    uint64_t key;
    size_t order;
    irradiance_record record;
} keyed_record;

typedef struct half_cache {
    vec3 offset; /* of the grid, in edges of cells */
    cell *cells;
    size_t cell_count;
    uint32_t *table; /* a cell's index + 1, or 0; by key */
    size_t table_mask;
} half_cache;

struct irradiance_cache {
    const graze_scene *scene;
    double part; /* of the distance, that a cell's edge is */
    half_cache halves[CACHES];
};

static uint64_t mixed(uint64_t a, uint64_t b) {
    uint64_t x = (a ^ b * 0x9fb21c651e98df25u) * 0xd6e8feb86659fd93u;
    return x ^ x >> 32;
}

static int main_axis(vec3 n) {
    double ax = fabs(n.x), ay = fabs(n.y), az = fabs(n.z);
    return ax > ay ? (ax > az ? 0 : 2) : (ay > az ? 1 : 2);
}

/* Normals in one of 24 bins. */
static uint64_t normal_bin(vec3 n) {
    uint64_t axis = (uint64_t)main_axis(n);
    uint64_t signs = (uint64_t)(n.x < -1e-9) | (uint64_t)(n.y < -1e-9) << 1 | (uint64_t)(n.z < -1e-9) << 2;
    return axis << 3 | signs;
}

/* A power of 2. */
static double cell_edge(const irradiance_cache *cache, double distance) {
    int exponent;
    (void)frexp(cache->part * distance, &exponent);
    return ldexp(0.5, exponent);
}

/* The cell about a point: of a polygon that is large enough to fill it, or of all else that faces the same way, since
 * a mesh's triangles and a curved surface's parts are each too small to be met often. What is not lit alike for being
 * on other things mostly is out of sight of each other, which makes no cell. */
static uint64_t key_of(const irradiance_cache *cache, const half_cache *half, const irradiance_record *record) {
    double edge = cell_edge(cache, record->distance);
    vec3 at = vec3_add_scaled(half->offset, 1 / edge, record->point);
    if (!(vec3_max_abs(at) < LARGEST_PLACE))
        return NO_KEY;
    bool flat;
    double area = scene_surface_area(cache->scene, record->surface, &flat);
    bool large = flat && area >= edge * edge / 4;
    uint64_t key = mixed((uint64_t)(int64_t)ilogb(edge), large ? (uint64_t)record->surface + 1 : 0);
    key = mixed(key, (uint64_t)(int64_t)floor(at.x));
    key = mixed(key, (uint64_t)(int64_t)floor(at.y));
    key = mixed(key, (uint64_t)(int64_t)floor(at.z));
    return mixed(key, normal_bin(record->normal));
}

static cell_place place_of(const irradiance_cache *cache, const half_cache *half, const irradiance_record *record) {
    vec3 at = vec3_add_scaled(half->offset, 1 / cell_edge(cache, record->distance), record->point);
    double x = at.x - floor(at.x) - 0.5, y = at.y - floor(at.y) - 0.5, z = at.z - floor(at.z) - 0.5;
    int axis = main_axis(record->normal);
    return (cell_place){axis == 0 ? y : x, axis == 2 ? y : z};
}

static const cell *cell_of(const half_cache *half, uint64_t key) {
    for (size_t i = key & half->table_mask; half->table[i] != 0; i = (i + 1) & half->table_mask)
        if (half->cells[half->table[i] - 1].key == key)
            return &half->cells[half->table[i] - 1];
    return NULL;
}

static double limited(double change, double mean) {
    double limit = fmax(mean, 0);
    return fmax(fmin(change, limit), -limit);
}

/* A part's irradiance at a place. What is more than twice its mean, or less than nothing, no slope tells. */
static rgb irradiance_at(const cell *c, int part, cell_place at) {
    const cell_slope *s = &c->slopes[part / HALF_PARTS];
    rgb mean = c->irradiance[part];
    rgb change = rgb_add_scaled(rgb_scale(at.x - s->middle.x, s->x), at.y - s->middle.y, s->y);
    return rgb_add(mean, (rgb){limited(change.r, mean.r), limited(change.g, mean.g), limited(change.b, mean.b)});
}

bool irradiance_cache_find(const irradiance_cache *cache, const irradiance_record *record,
                           rgb found[IRRADIANCE_PARTS]) {
    for (int i = 0; i < CACHES; i++) {
        const cell *c = cell_of(&cache->halves[i], key_of(cache, &cache->halves[i], record));
        if (!c)
            return false;
        cell_place at = place_of(cache, &cache->halves[i], record);
        for (int k = 0; k < CELL_PARTS; k++)
            found[i * CELL_PARTS + k] = irradiance_at(c, k, at);
    }
    return true;
}

/* Pilot paths. */
typedef struct pilot {
    path_context context;
    irradiance_cache *cache;
    int half;
    irradiance_pilot *first;
    void *user;
    keyed_record *records;
} pilot;

static void follow_pilot(void *user, size_t index, int worker) {
    (void)worker;
    pilot *p = user;
    path_hit first = p->first(p->user, index);
    for (size_t i = 0; i < PATHS_PER_PILOT; i++) {
        keyed_record *r = &p->records[index * PATHS_PER_PILOT + i];
        path_context context = p->context;
        context.record = &r->record;
        r->order = index * PATHS_PER_PILOT + i;
        r->record.surface = -1;
        uint64_t key = sampler_key(p->context.settings->seed, index, 0x1000000u + (uint32_t)p->half);
        sampler points = sampler_start(key, (uint32_t)i);
        path_sample unused;
        path_radiance(&context, &first, &points, &unused);
        r->key = r->record.surface < 0 ? NO_KEY : key_of(p->cache, &p->cache->halves[p->half], &r->record);
    }
}

static int compare_records(const void *a, const void *b) {
    const keyed_record *p = a, *q = b;
    return p->key != q->key ? (p->key < q->key ? -1 : 1) : p->order < q->order ? -1 : p->order > q->order;
}

static void find_cells(half_cache *half, const keyed_record *records, size_t count) {
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i; end < count && records[end].key == records[i].key; end++)
            ;
        if (records[i].key == NO_KEY || end - i < FEWEST_POINTS)
            continue;
        half->cells[half->cell_count++] = (cell){.key = records[i].key, .first = i, .count = end - i};
    }
}

/* Filling cells. */
typedef struct filling {
    path_context context;
    const irradiance_cache *cache;
    half_cache *half;
    const keyed_record *records;
    uint32_t number;
} filling;

/* Points are lifted by this part of a cell's edge to see each other. */
#define LIFT 0.0625

/* Whether nothing stands between the points that paths have come to: a wall that divides a cell keeps light from one
 * side that the other has. */
static bool is_in_one_place(const filling *f, const cell *c) {
    const irradiance_record *first = &f->records[c->first].record;
    double lift = LIFT * cell_edge(f->cache, first->distance);
    vec3 from = vec3_add_scaled(first->point, lift, first->normal);
    for (size_t i = 1; i < c->count; i++) {
        const irradiance_record *other = &f->records[c->first + i].record;
        vec3 way = vec3_subtract(vec3_add_scaled(other->point, lift, other->normal), from);
        geometry_ray ray = {.origin = from, .direction = vec3_safe_normalize(way), .far = vec3_length(way), .from = -1};
        if (ray.far > 0 && geometry_occluded(f->context.scene->geometry, &ray, -1))
            return false;
    }
    return true;
}

/* Sums over paths from places in a cell. */
typedef struct place_sums {
    double x, y, xx, xy, yy;
    rgb x_value, y_value;
    double x_brightness, y_brightness;
} place_sums;

typedef struct half_cell {
    uint64_t key;
    size_t taken;
    rgb sum[HALF_PARTS];
    double brightness, squares; /* sums of all */
    place_sums places;
} half_cell;

/* Ends in the golden section's order: however many, they are evenly spread over all of a cell's. */
static const irradiance_record *record_at(const filling *f, const cell *c, size_t number) {
    size_t index = (size_t)(even_step((double)number, GOLDEN_SECTION) * (double)c->count);
    return &f->records[c->first + (index < c->count ? index : 0)].record;
}

static void add_place(place_sums *s, cell_place at, rgb value, double brightness) {
    s->x += at.x;
    s->y += at.y;
    s->xx += at.x * at.x;
    s->xy += at.x * at.y;
    s->yy += at.y * at.y;
    s->x_value = rgb_add_scaled(s->x_value, at.x, value);
    s->y_value = rgb_add_scaled(s->y_value, at.y, value);
    s->x_brightness += at.x * brightness;
    s->y_brightness += at.y * brightness;
}

static void take_path(const filling *f, const irradiance_record *from, path_memory *memory, half_cell *h, int part) {
    path_context context = f->context;
    context.memory = memory;
    sampler points = sampler_start(h->key, (uint32_t)h->taken++);
    path_sample sample;
    path_irradiance_at(&context, from, &points, &sample);
    rgb value = sample.radiance;
    for (int k = 0; k < sample.control_count; k++)
        value = rgb_add(value, sample.controls[k].difference);
    double brightness = rgb_brightness(value);
    h->sum[part] = rgb_add(h->sum[part], value);
    h->brightness += brightness;
    h->squares += brightness * brightness;
    add_place(&h->places, place_of(f->cache, f->half, from), value, brightness);
}

static void take_until(const filling *f, const cell *c, path_memory *memory, half_cell halves[HALVES], int half,
                       size_t goal) {
    half_cell *h = &halves[half];
    size_t first = h->taken, run = (goal - first) / HALF_PARTS;
    for (size_t i = first; i < goal; i++)
        take_path(f, record_at(f, c, i * HALVES + (size_t)half), memory, h, (int)((i - first) / run));
}

/* Whether so many paths of a half are enough, as the other finds. */
static bool is_enough(const filling *f, const cell *c, const half_cell *judge, size_t taken) {
    const graze_trace_settings *s = f->context.settings;
    double count = (double)judge->taken, mean = judge->brightness / count, floor = PI * s->floor;
    double variance = fmax(judge->squares - mean * judge->brightness, 0) / (count - 1);
    double seen = fmin(sqrt(OFTEN_SEEN / (double)c->count), 1), all = (double)taken * HALVES;
    double allowed = NOISE_OF_ERROR * s->error * seen * fmax(mean, floor);
    if (all < PATHS_BELIEVED && all * mean < FEWEST_PATHS * floor)
        return false;
    return variance <= allowed * allowed * all;
}

/* Added to the places' variance, which is 1/12 where they fill the cell: no slope is read off a spot or a line. */
#define PLACE_VARIANCE 0.005

/* Lays a plane through a half's paths by least squares, and takes as much of its slope as their scatter lets believe
 * (as James and Stein shrink means). A mean alone would bring light from a cell's bright side to its dark one, and
 * what is dark would be too bright by it. */
static cell_slope find_slope(const half_cell *h) {
    const place_sums *s = &h->places;
    double n = (double)h->taken, x = s->x / n, y = s->y / n;
    rgb value = {0, 0, 0};
    for (int k = 0; k < HALF_PARTS; k++)
        value = rgb_add(value, h->sum[k]);
    double xx = s->xx / n - x * x + PLACE_VARIANCE, yy = s->yy / n - y * y + PLACE_VARIANCE, xy = s->xy / n - x * y;
    double bx = (s->x_brightness - x * h->brightness) / n, by = (s->y_brightness - y * h->brightness) / n;
    double determinant = xx * yy - xy * xy;
    double told = n * (yy * bx * bx - 2 * xy * bx * by + xx * by * by) / determinant;
    double rest = fmax(h->squares - h->brightness * h->brightness / n - told, 0) / (n - 3);
    double believed = told > 2 * rest ? (1 - 2 * rest / told) / determinant : 0;
    rgb vx = rgb_scale(believed / n, rgb_add_scaled(s->x_value, -x, value));
    rgb vy = rgb_scale(believed / n, rgb_add_scaled(s->y_value, -y, value));
    return (cell_slope){.middle = {x, y},
                        .x = rgb_add_scaled(rgb_scale(yy, vx), -xy, vy),
                        .y = rgb_add_scaled(rgb_scale(xx, vy), -xy, vx)};
}

static void fill_cell(void *user, size_t index, int worker) {
    (void)worker;
    filling *f = user;
    cell *c = &f->half->cells[index];
    c->whole = is_in_one_place(f, c);
    if (!c->whole)
        return;
    path_memory memory;
    path_memory_begin(&memory, false);
    half_cell halves[HALVES] = {{.taken = 0}, {.taken = 0}};
    for (int i = 0; i < HALVES; i++)
        halves[i].key = sampler_key(f->context.settings->seed, c->key, 0x2000000u + f->number * HALVES + (uint32_t)i);
    bool enough[HALVES] = {false, false};
    size_t most = PATHS_OF_PILOT * c->count > MOST_PATHS ? PATHS_OF_PILOT * c->count : MOST_PATHS;
    for (size_t goal = FEWEST_PATHS / HALVES; goal <= most / HALVES && !(enough[0] && enough[1]); goal *= 2) {
        for (int i = 0; i < HALVES; i++)
            if (!enough[i])
                take_until(f, c, &memory, halves, i, goal);
        for (int i = 0; i < HALVES; i++)
            enough[i] = enough[i] || is_enough(f, c, &halves[1 - i], halves[i].taken);
    }
    for (int k = 0; k < CELL_PARTS; k++) {
        const half_cell *h = &halves[k / HALF_PARTS];
        c->irradiance[k] = rgb_scale((double)HALF_PARTS / (double)h->taken, h->sum[k % HALF_PARTS]);
    }
    for (int i = 0; i < HALVES; i++)
        c->slopes[i] = find_slope(&halves[i]);
}

static bool make_table(half_cache *half) {
    size_t size = 16;
    while (size < 2 * half->cell_count)
        size *= 2;
    half->table = calloc(size, sizeof *half->table);
    half->table_mask = size - 1;
    if (!half->table)
        return false;
    for (size_t c = 0; c < half->cell_count; c++) {
        if (!half->cells[c].whole)
            continue;
        size_t i = half->cells[c].key & half->table_mask;
        while (half->table[i] != 0)
            i = (i + 1) & half->table_mask;
        half->table[i] = (uint32_t)c + 1;
    }
    return true;
}

static bool build_half(pilot *p, size_t count, int threads) {
    half_cache *half = &p->cache->halves[p->half];
    size_t records = count * PATHS_PER_PILOT;
    p->records = malloc(records * sizeof *p->records);
    half->cells = malloc(records / FEWEST_POINTS * sizeof *half->cells + sizeof *half->cells);
    bool ok = p->records && half->cells;
    if (ok) {
        sampler numbers = sampler_start(sampler_key(p->context.settings->seed, 0, 0x3000000u + (uint32_t)p->half), 0);
        double random[3];
        sampler_3d(&numbers, random);
        half->offset = (vec3){random[0], random[1], random[2]};
        parallel_for(threads, count, follow_pilot, p);
        qsort(p->records, records, sizeof *p->records, compare_records);
        find_cells(half, p->records, records);
        filling f = {p->context, p->cache, half, p->records, (uint32_t)p->half};
        parallel_for(threads, half->cell_count, fill_cell, &f);
        ok = make_table(half);
    }
    free(p->records);
    return ok;
}

/* Light that only luck finds would be in few cells, and too much of it; a limited number of reflections would be
 * another where paths end early. */
static bool is_of_use(const path_context *context) {
    const graze_trace_settings *s = context->settings;
    return s->ambient_bounces > 1 && context_samples_lights(s) && !context->scene->has_mirrors &&
           s->reflection_limit == 0;
}

graze_status irradiance_cache_build(irradiance_cache **out, const path_context *context, irradiance_pilot *first,
                                    void *user, size_t count, int threads, const graze_report *report) {
    *out = NULL;
    if (!is_of_use(context))
        return GRAZE_OK;
    irradiance_cache *cache = calloc(1, sizeof *cache);
    if (!cache)
        return report_out_of_memory(report);
    cache->scene = context->scene;
    cache->part = fmin(LARGEST_PART, PART_OF_ERROR * context->settings->error);
    for (int i = 0; i < CACHES; i++) {
        pilot p = {.context = {.scene = context->scene, .settings = context->settings},
                   .cache = cache,
                   .half = i,
                   .first = first,
                   .user = user};
        if (!build_half(&p, count, threads)) {
            irradiance_cache_destroy(cache);
            return report_out_of_memory(report);
        }
    }
    *out = cache;
    return GRAZE_OK;
}

void irradiance_cache_destroy(irradiance_cache *cache) {
    for (int i = 0; cache && i < CACHES; i++) {
        free(cache->halves[i].cells);
        free(cache->halves[i].table);
    }
    free(cache);
}
