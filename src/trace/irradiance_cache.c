/* Cells of irradiance: made where pilot paths end, found by hashing. */
#include "trace/irradiance_cache.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "base/report.h"
#include "scene/surface.h"
#include "trace/irradiance_cell.h"
#include "trace/mist.h"
#include "trace/path.h"
#include "trace/sampler.h"

enum { PATHS_PER_PILOT = 16 };

/* A cell's edge is at most this part of the distance that a path comes from, at an error of 0.03 and more; of smaller
 * errors, a smaller one, so that what cells get wrong by being as large as they are stays small beside them: about a
 * thousandth of the value at the largest part, and half a hundredth where that bends most. */
#define LARGEST_PART  0.25
#define PART_OF_ERROR (LARGEST_PART / 0.03)

/* Fewer pilot paths make no cell. */
#define FEWEST_POINTS 4

/* Of what is in no cell. */
#define NO_KEY UINT64_MAX
/* Coordinates in edges of cells beyond which these cannot be told apart. */
#define LARGEST_PLACE 0x1p50

typedef struct half_cache {
    vec3 offset; /* of the grid, in edges of cells */
    irradiance_cell *cells;
    size_t cell_count;
    uint32_t *table; /* a cell's index + 1, or 0; by key */
    size_t table_mask;
} half_cache;

struct irradiance_cache {
    const graze_scene *scene;
    double part; /* of the distance, that a cell's edge is */
    half_cache halves[IRRADIANCE_CACHES];
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

/* The cell about a point: of a polygon that is large enough to fill it, or of all else that faces the same way, since
 * a mesh's triangles and a curved surface's parts are each too small to be met often. What is not lit alike for being
 * on other things mostly is out of sight of each other, which makes no cell. */
static uint64_t key_of(const irradiance_cache *cache, const half_cache *half, const irradiance_record *record) {
    double edge = irradiance_cell_edge(cache->part, record->distance);
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

static irradiance_place place_of(const irradiance_cache *cache, const half_cache *half,
                                 const irradiance_record *record) {
    double edge = irradiance_cell_edge(cache->part, record->distance);
    vec3 at = vec3_add_scaled(half->offset, 1 / edge, record->point);
    double x = at.x - floor(at.x) - 0.5, y = at.y - floor(at.y) - 0.5, z = at.z - floor(at.z) - 0.5;
    int axis = main_axis(record->normal);
    return (irradiance_place){axis == 0 ? y : x, axis == 2 ? y : z};
}

static const irradiance_cell *cell_of(const half_cache *half, uint64_t key) {
    for (size_t i = key & half->table_mask; half->table[i] != 0; i = (i + 1) & half->table_mask)
        if (half->cells[half->table[i] - 1].key == key)
            return &half->cells[half->table[i] - 1];
    return NULL;
}

bool irradiance_cache_find(const irradiance_cache *cache, const irradiance_record *record,
                           rgb found[IRRADIANCE_PARTS]) {
    for (int i = 0; i < IRRADIANCE_CACHES; i++) {
        const irradiance_cell *c = cell_of(&cache->halves[i], key_of(cache, &cache->halves[i], record));
        if (!c)
            return false;
        irradiance_place at = place_of(cache, &cache->halves[i], record);
        for (int k = 0; k < IRRADIANCE_CELL_PARTS; k++)
            found[i * IRRADIANCE_CELL_PARTS + k] = irradiance_cell_at(c, k, at);
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
    irradiance_end *records;
} pilot;

static void follow_pilot(void *user, size_t index, int worker) {
    (void)worker;
    pilot *p = user;
    path_hit first = p->first(p->user, index);
    for (size_t i = 0; i < PATHS_PER_PILOT; i++) {
        irradiance_end *r = &p->records[index * PATHS_PER_PILOT + i];
        path_context context = p->context;
        context.record = &r->record;
        r->order = index * PATHS_PER_PILOT + i;
        r->record.surface = -1;
        uint64_t key = sampler_key(p->context.settings->seed, index, 0x1000000u + (uint32_t)p->half);
        sampler points = sampler_start(key, (uint32_t)i);
        path_sample unused;
        path_radiance(&context, &first, &points, &unused);
        if (r->record.surface < 0) {
            r->key = NO_KEY;
            continue;
        }
        r->key = key_of(p->cache, &p->cache->halves[p->half], &r->record);
        r->place = place_of(p->cache, &p->cache->halves[p->half], &r->record);
    }
}

static int compare_records(const void *a, const void *b) {
    const irradiance_end *p = a, *q = b;
    return p->key != q->key ? (p->key < q->key ? -1 : 1) : p->order < q->order ? -1 : p->order > q->order;
}

static void find_cells(half_cache *half, const irradiance_end *records, size_t count) {
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i; end < count && records[end].key == records[i].key; end++)
            ;
        if (records[i].key == NO_KEY || end - i < FEWEST_POINTS)
            continue;
        half->cells[half->cell_count++] = (irradiance_cell){.key = records[i].key, .first = i, .count = end - i};
    }
}

/* The cells of a cache that are to be filled. */
typedef struct unfilled {
    irradiance_filling filling;
    irradiance_cell *cells;
} unfilled;

static void fill_cell(void *user, size_t index, int worker) {
    (void)worker;
    const unfilled *u = user;
    irradiance_cell_fill(&u->filling, &u->cells[index]);
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
        unfilled u = {{&p->context, p->cache->part, p->records, (uint32_t)p->half}, half->cells};
        parallel_for(threads, half->cell_count, fill_cell, &u);
        ok = make_table(half);
    }
    free(p->records);
    return ok;
}

/* Light that only luck finds would be in few cells, and too much of it; a limited number of reflections would be
 * another where paths end early. */
static bool is_of_use(const path_context *context) {
    const graze_trace_settings *s = context->settings;
    const bool looks_through_mist = context->scene->has_refraction && mist_is_there(context);
    return s->ambient_bounces > 1 && context_samples_lights(s) && !context->scene->has_mirrors && !looks_through_mist &&
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
    for (int i = 0; i < IRRADIANCE_CACHES; i++) {
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
    for (int i = 0; cache && i < IRRADIANCE_CACHES; i++) {
        free(cache->halves[i].cells);
        free(cache->halves[i].table);
    }
    free(cache);
}
