/* Rendering: pixels are independent estimates, computed in tiles on all threads. */
#include "picture/picture.h"

#include <stdatomic.h>
#include <stdlib.h>

#include "base/number.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "trace/estimate.h"
#include "trace/irradiance_cache.h"
#include "trace/path.h"

#define TILE 16
/* The sparse grid that the picture's mean is estimated from has at most this many pixels a side, each with this many
 * samples. */
#define PILOT_SIDE    64
#define PILOT_SAMPLES 16
/* Pictures of fewer pixels, and of smaller errors, need no irradiance cache. */
#define CACHE_PIXELS 2048
#define CACHE_ERROR  0.005

/* The planes of the image, by meaning. */
typedef struct planes {
    float *value[3], *error[3], *samples, *depth, *normal[3];
} planes;

typedef struct rendering {
    const picture_settings *picture;
    graze_trace_settings trace;
    const graze_scene *scene;
    image *image;
    planes planes;
    progress *progress;
    irradiance_cache *cache;
    int tiles_across, tiles_down;
    atomic_size_t tiles_done, unconverged;
} rendering;

static const char *const channel_names[] = {
    "R",         "G",       "B",        "standard_error.R", "standard_error.G", "standard_error.B",
    "samples.Y", "depth.Z", "normal.X", "normal.Y",         "normal.Z",
};

/* A pixel as estimate_sample sees it. */
typedef struct pixel {
    const rendering *rendering;
    int column, row;
} pixel;

/* The ray through a point of the pixel, (0.5, 0.5) its centre, x to the right, y up. */
static bool pixel_ray(const pixel *p, double x, double y, graze_ray *ray) {
    const picture_settings *s = p->rendering->picture;
    ray->limit = 0;
    return rad_view_ray(&s->view, (p->column + x) / s->width, (s->height - 1 - p->row + y) / s->height, &ray->origin,
                        &ray->direction, &ray->limit);
}

static path_sample sample_pixel(void *user, sampler *points, estimate_luck *luck) {
    const pixel *p = user;
    const rendering *r = p->rendering;
    double jitter = r->picture->jitter;
    double random[2] = {0.5, 0.5};
    *luck = ESTIMATE_EXACT;
    if (jitter > 0) {
        sampler_2d(points, random);
        *luck = ESTIMATE_PLACE;
    }
    graze_ray ray;
    if (!pixel_ray(p, 0.5 + jitter * (random[0] - 0.5), 0.5 + jitter * (random[1] - 0.5), &ray))
        return (path_sample){.noisy = false};
    path_context context = {r->scene, &r->trace, r->cache, NULL};
    path_hit first = path_cast(&context, ray.origin, ray.direction, ray.limit > 0 ? ray.limit : GEOMETRY_FAR, -1);
    path_sample sample = path_radiance(&context, &first, points);
    if (sample.noisy)
        *luck = sample.searching ? ESTIMATE_SEARCH : ESTIMATE_NOISY;
    return sample;
}

static graze_answer estimate_pixel(const pixel *p, const graze_trace_settings *settings) {
    uint64_t number = (uint64_t)p->row * (uint64_t)p->rendering->picture->width + (uint64_t)p->column;
    graze_answer answer;
    estimate(settings, number, sample_pixel, (void *)p, &answer);
    return answer;
}

/* Depth and normal on the ray through the pixel's centre. */
static void store_geometry(const pixel *p, size_t at) {
    const rendering *r = p->rendering;
    graze_ray ray;
    graze_hit hit;
    if (!pixel_ray(p, 0.5, 0.5, &ray))
        return;
    graze_cast(r->scene, &r->trace, &ray, &hit);
    r->planes.depth[at] = number_to_float(hit.distance);
    r->planes.normal[0][at] = number_to_float(hit.shading_normal.x);
    r->planes.normal[1][at] = number_to_float(hit.shading_normal.y);
    r->planes.normal[2][at] = number_to_float(hit.shading_normal.z);
}

static void store_rgb(float *const plane[3], size_t at, rgb value) {
    plane[0][at] = number_to_float(value.r);
    plane[1][at] = number_to_float(value.g);
    plane[2][at] = number_to_float(value.b);
}

static void render_pixel(rendering *r, int column, int row) {
    pixel p = {r, column, row};
    size_t at = (size_t)row * (size_t)r->picture->width + (size_t)column;
    graze_answer answer = estimate_pixel(&p, &r->trace);
    store_rgb(r->planes.value, at, answer.value);
    if (!answer.converged)
        atomic_fetch_add(&r->unconverged, 1);
    if (!r->picture->layers)
        return;
    store_rgb(r->planes.error, at, answer.standard_error);
    r->planes.samples[at] = number_to_float(answer.samples);
    store_geometry(&p, at);
}

static void render_tile(void *user, size_t index, int worker) {
    (void)worker;
    rendering *r = user;
    int left = (int)(index % (size_t)r->tiles_across) * TILE, top = (int)(index / (size_t)r->tiles_across) * TILE;
    for (int row = top; row < top + TILE && row < r->picture->height; row++)
        for (int column = left; column < left + TILE && column < r->picture->width; column++)
            render_pixel(r, column, row);
    size_t done = atomic_fetch_add(&r->tiles_done, 1) + 1;
    progress_update(r->progress, (double)done / ((double)r->tiles_across * r->tiles_down), NULL);
}

/* Pilot pixels: the mean of the picture, before it is there. */
typedef struct pilot {
    const rendering *rendering;
    graze_trace_settings trace;
    int columns, rows;
    rgb *values;
} pilot;

static pilot make_pilot(const rendering *r) {
    const picture_settings *s = r->picture;
    pilot p = {.rendering = r, .trace = r->trace};
    p.columns = s->width < PILOT_SIDE ? s->width : PILOT_SIDE;
    p.rows = s->height < PILOT_SIDE ? s->height : PILOT_SIDE;
    p.trace.samples = PILOT_SAMPLES;
    return p;
}

static pixel pilot_pixel(const pilot *p, size_t index) {
    const picture_settings *s = p->rendering->picture;
    int column = (int)(index % (size_t)p->columns), row = (int)(index / (size_t)p->columns);
    return (pixel){p->rendering, (int)((column + 0.5) * s->width / p->columns),
                   (int)((row + 0.5) * s->height / p->rows)};
}

static void sample_pilot(void *user, size_t index, int worker) {
    (void)worker;
    pilot *p = user;
    pixel at = pilot_pixel(p, index);
    p->values[index] = estimate_pixel(&at, &p->trace).value;
}

static graze_status estimate_mean(const rendering *r, double *mean, const graze_report *report) {
    pilot p = make_pilot(r);
    size_t count = (size_t)p.columns * (size_t)p.rows;
    p.values = malloc(count * sizeof *p.values);
    if (!p.values)
        return report_out_of_memory(report);
    parallel_for(r->picture->threads, count, sample_pilot, &p);
    rgb sum = {0, 0, 0};
    for (size_t i = 0; i < count; i++)
        sum = rgb_add(sum, p.values[i]);
    free(p.values);
    *mean = rgb_max(sum) / (double)count;
    return GRAZE_OK;
}

/* What the pilot paths of the irradiance cache meet first: pixels of the same sparse grid. */
static path_hit pilot_hit(void *user, size_t index) {
    const pilot *p = user;
    const path_context context = {.scene = p->rendering->scene, .settings = &p->rendering->trace};
    pixel at = pilot_pixel(p, index);
    graze_ray ray;
    if (!pixel_ray(&at, 0.5, 0.5, &ray))
        return (path_hit){.surface = -1, .light = -1};
    return path_cast(&context, ray.origin, ray.direction, ray.limit > 0 ? ray.limit : GEOMETRY_FAR, -1);
}

/* The cache is for interreflections, in pictures large enough to make up for what it costs. */
static bool wants_irradiance_cache(const graze_trace_settings *s, const picture_settings *picture) {
    return !s->samples && (double)picture->width * picture->height >= CACHE_PIXELS && s->error >= CACHE_ERROR;
}

static void find_planes(rendering *r) {
    float **channel = r->image->channels;
    planes *p = &r->planes;
    for (int i = 0; i < 3; i++)
        p->value[i] = channel[i];
    if (!r->picture->layers)
        return;
    for (int i = 0; i < 3; i++) {
        p->error[i] = channel[3 + i];
        p->normal[i] = channel[8 + i];
    }
    p->samples = channel[6];
    p->depth = channel[7];
}

graze_status picture_render(image **out, const graze_scene *scene, const graze_trace_settings *trace,
                            const picture_settings *picture, size_t *unconverged, const graze_report *report) {
    rendering r = {.picture = picture, .trace = *trace, .scene = scene};
    *out = NULL;
    int channel_count = picture->layers ? (int)(sizeof channel_names / sizeof *channel_names) : 3;
    r.image = image_create(picture->width, picture->height, channel_count, channel_names);
    if (!r.image)
        return report_out_of_memory(report);
    r.image->pixel_aspect = picture->pixel_aspect;
    find_planes(&r);
    r.tiles_across = (picture->width + TILE - 1) / TILE;
    r.tiles_down = (picture->height + TILE - 1) / TILE;
    if (!trace->samples) {
        double mean = 0;
        graze_status status = estimate_mean(&r, &mean, report);
        if (status != GRAZE_OK) {
            image_destroy(r.image);
            return status;
        }
        r.trace.floor = fmax(r.trace.floor, PICTURE_FLOOR * mean);
    }
    if (wants_irradiance_cache(trace, picture)) {
        pilot p = make_pilot(&r);
        const path_context context = {.scene = scene, .settings = &r.trace};
        graze_status status = irradiance_cache_build(&r.cache, &context, pilot_hit, &p,
                                                     (size_t)p.columns * (size_t)p.rows, picture->threads, report);
        if (status != GRAZE_OK) {
            image_destroy(r.image);
            return status;
        }
    }
    r.progress = progress_start("rendering", picture->progress);
    parallel_for(picture->threads, (size_t)r.tiles_across * (size_t)r.tiles_down, render_tile, &r);
    progress_finish(r.progress);
    irradiance_cache_destroy(r.cache);
    *unconverged = atomic_load(&r.unconverged);
    *out = r.image;
    return GRAZE_OK;
}
