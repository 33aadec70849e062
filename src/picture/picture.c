/* Rendering: pixels are estimates, computed on all threads; what they share is an irradiance cache, and light on
 * surfaces. */
#include "picture/picture.h"

#include <stdlib.h>

#include "base/parallel.h"
#include "picture/camera.h"
#include "picture/state.h"
#include "trace/estimate.h"
#include "trace/path.h"

/* The sparse grid that the picture's mean is estimated from has at most this many pixels a side, each with this many
 * samples. */
#define PILOT_SIDE    64
#define PILOT_SAMPLES 4
/* Pictures of fewer pixels, and of smaller errors, need no irradiance cache. */
#define CACHE_PIXELS 2048
#define CACHE_ERROR  0.005

/* Of one pixel, for the mean: one that does not know its own value must not stand for all. */
#define LARGEST_ERROR 16.0
#define ERROR_UNITS   4294967296.0

/* Beside the replicates that estimates draw from. */
#define CORNER_NUMBERS 2

/* A pixel as estimate_sample sees it. */
typedef struct pixel {
    const rendering *picture;
    int column, row;
    uint64_t number; /* of its random numbers */
    path_memory *memory;
    bool cast; /* where all samples are of one ray: it has been */
    path_hit first;
    const shared_pixel *shared; /* null: nothing is known */
} pixel;

static bool is_stopped(const rendering *p) {
    return atomic_load_explicit(&p->stopped, memory_order_relaxed);
}

/* Whether the rays of a pixel differ. */
static bool is_spread(const picture_settings *s) {
    return s->jitter > 0 || s->aperture > 0 || s->shutter > 0;
}

/* Draws from the sampler only what the camera needs. False where the samples are all of one ray. */
static bool sample_camera(const picture_settings *s, sampler *points, camera_sample *sample) {
    *sample = camera_center;
    if (s->jitter > 0) {
        double random[2];
        sampler_2d(points, random);
        sample->x += s->jitter * (random[0] - 0.5);
        sample->y += s->jitter * (random[1] - 0.5);
    }
    if (s->aperture > 0)
        sampler_2d(points, sample->lens);
    if (s->shutter > 0)
        sample->time = sampler_1d(points) - 0.5;
    return is_spread(s);
}

static path_context context_of(const pixel *p) {
    return (path_context){
        .scene = p->picture->scene, .settings = &p->picture->trace, .memory = p->memory, .cache = p->picture->cache};
}

/* What a camera's ray hits first. False: there is no such ray. */
static bool cast_at(pixel *p, const path_context *context, const camera_sample *at) {
    graze_ray ray;
    if (!camera_ray(&p->picture->settings, p->column, p->row, at, &ray))
        return false;
    p->first = path_cast(context, ray.origin, ray.direction, ray.limit > 0 ? ray.limit : GEOMETRY_FAR, -1);
    return true;
}

/* One sample of what is seen there, where p->first is. */
static void sample_at(const pixel *p, path_context context, const camera_sample *at, sampler *points,
                      path_sample *sample) {
    path_indirect known;
    if (p->shared && shared_light_at(p->picture->shared, p->shared, &p->first, at->x - camera_center.x,
                                     at->y - camera_center.y, &known))
        context.indirect = &known;
    path_radiance(&context, &p->first, points, sample);
}

static void sample_pixel(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    pixel *p = user;
    path_context context = context_of(p);
    camera_sample at = camera_center;
    *luck = ESTIMATE_EXACT;
    if (!p->cast) {
        bool spread = sample_camera(&p->picture->settings, points, &at);
        if (spread)
            *luck = ESTIMATE_PLACE;
        if (!cast_at(p, &context, &at)) {
            *sample = (path_sample){.noisy = false};
            return;
        }
        p->cast = !spread;
    }
    sample_at(p, context, &at, points, sample);
    if (sample->noisy)
        *luck = sample->searching ? ESTIMATE_SEARCH : ESTIMATE_NOISY;
}

/* What one sample finds in the pixel's corner. */
static rgb look_at_corner(const pixel *p, int corner, path_memory *memory) {
    pixel there = *p;
    there.memory = memory;
    double half = p->picture->settings.jitter / 2;
    camera_sample at = camera_center;
    at.x += corner & 1 ? half : -half;
    at.y += corner & 2 ? half : -half;
    path_context context = context_of(&there);
    if (!cast_at(&there, &context, &at))
        return rgb_gray(0);
    sampler points = sampler_start(sampler_key(p->picture->trace.seed, p->number, CORNER_NUMBERS), (uint32_t)corner);
    path_sample sample;
    sample_at(&there, context, &at, &points, &sample);
    for (int k = 0; k < sample.control_count; k++)
        sample.radiance = rgb_add(sample.radiance, sample.controls[k].difference);
    return sample.radiance;
}

/* What lies on one side of a straight edge and meets the pixel has one of its corners at least: where these look alike,
 * there is no such edge. Nobody has looked through all of a lens, or at all times, by that. */
static bool has_edge(void *user, uint32_t samples, double allowed) {
    const pixel *p = user;
    if (p->picture->settings.aperture > 0 || p->picture->settings.shutter > 0)
        return true;
    path_memory memory;
    path_memory_begin(&memory, false);
    rgb least = look_at_corner(p, 0, &memory), most = least;
    for (int corner = 1; corner < 4; corner++) {
        rgb found = look_at_corner(p, corner, &memory);
        least = (rgb){fmin(least.r, found.r), fmin(least.g, found.g), fmin(least.b, found.b)};
        most = (rgb){fmax(most.r, found.r), fmax(most.g, found.g), fmax(most.b, found.b)};
    }
    return rgb_max(rgb_add_scaled(most, -1, least)) > samples * allowed;
}

/* Random numbers of pictures, and of surveys. */
enum { PICTURE_NUMBERS, SURVEY_NUMBERS };

/* `parts` may be null. */
static graze_answer estimate_pixel(const pixel *p, const graze_trace_settings *settings, int numbers, uint32_t least,
                                   estimate_parts *parts) {
    uint64_t width = (uint64_t)p->picture->settings.width, height = (uint64_t)p->picture->settings.height;
    uint64_t number = ((uint64_t)numbers * height + (uint64_t)p->row) * width + (uint64_t)p->column;
    graze_answer answer;
    path_memory known;
    path_memory_begin(&known, !is_spread(&p->picture->settings));
    pixel remembering = {.picture = p->picture, .column = p->column, .row = p->row, .number = number, .memory = &known};
    shared_pixel shared;
    if (p->picture->shared && shared_light_find(p->picture->shared, p->column, p->row, &shared))
        remembering.shared = &shared;
    const estimate_extras extras = {least, has_edge, parts};
    estimate_with_extras(settings, number, &extras, sample_pixel, &remembering, &answer);
    return answer;
}

/* Depth and normal on the ray through the pixel's centre. */
static void look_at_geometry(const rendering *p, int column, int row, film_pixel *found) {
    graze_ray ray;
    graze_hit hit;
    if (p->settings.content == PICTURE_COLOR || !camera_ray(&p->settings, column, row, &camera_center, &ray))
        return;
    graze_cast(p->scene, &p->trace, &ray, &hit);
    found->depth = hit.distance;
    found->normal = hit.shading_normal;
}

/* What --error is about. */
static double relative_error(const graze_answer *answer, double floor) {
    double error = rgb_max(answer->standard_error), value = fmax(rgb_max(answer->value), floor);
    return error > 0 ? fmin(error / value, LARGEST_ERROR) : 0;
}

void picture_count(rendering *p, size_t at) {
    atomic_fetch_add(&p->error, (unsigned long long)((double)p->film.reached[at] * ERROR_UNITS));
    if (film_state_of(&p->film, at) == FILM_UNCONVERGED)
        atomic_fetch_add(&p->unconverged, 1);
    atomic_fetch_add(&p->finished, 1);
}

static void render_pixel(rendering *p, int column, int row) {
    size_t at = (size_t)row * (size_t)p->settings.width + (size_t)column;
    if (film_state_of(&p->film, at) != FILM_MISSING)
        return;
    estimate_parts parts = {{0, 0, 0}, {0, 0, 0}};
    bool layers = p->settings.content == PICTURE_LAYERS;
    const pixel here = {.picture = p, .column = column, .row = row};
    uint32_t least = survey_least(&p->survey, column, row);
    film_pixel result = {.answer = estimate_pixel(&here, &p->trace, PICTURE_NUMBERS, least, layers ? &parts : NULL)};
    result.albedo = parts.albedo;
    result.indirect = parts.indirect;
    result.reached = relative_error(&result.answer, p->trace.floor);
    look_at_geometry(p, column, row, &result);
    film_finish(&p->film, at, &result);
    atomic_fetch_add(&p->paths, result.answer.samples);
    picture_count(p, at);
}

static void render_piece(void *user, size_t index, int worker) {
    (void)worker;
    rendering *p = user;
    order_piece piece = order_piece_at(&p->order, index);
    for (int row = piece.top; row < piece.bottom; row += piece.step_down)
        for (int column = piece.left; column < piece.right; column += piece.step) {
            if (is_stopped(p))
                return;
            render_pixel(p, column, row);
        }
}

/* Pilot pixels: the mean of the picture, before it is there. */
typedef struct pilot {
    const rendering *picture;
    graze_trace_settings trace;
    int columns, rows;
    rgb *values;
} pilot;

static pilot make_pilot(const rendering *whole) {
    const picture_settings *s = &whole->settings;
    pilot p = {.picture = whole, .trace = whole->trace};
    p.columns = s->width < PILOT_SIDE ? s->width : PILOT_SIDE;
    p.rows = s->height < PILOT_SIDE ? s->height : PILOT_SIDE;
    p.trace.samples = PILOT_SAMPLES;
    return p;
}

static pixel pilot_pixel(const pilot *p, size_t index) {
    const picture_settings *s = &p->picture->settings;
    int column = (int)(index % (size_t)p->columns), row = (int)(index / (size_t)p->columns);
    return (pixel){.picture = p->picture,
                   .column = (int)((column + 0.5) * s->width / p->columns),
                   .row = (int)((row + 0.5) * s->height / p->rows)};
}

static void sample_pilot(void *user, size_t index, int worker) {
    (void)worker;
    pilot *p = user;
    if (is_stopped(p->picture))
        return;
    pixel at = pilot_pixel(p, index);
    p->values[index] = estimate_pixel(&at, &p->trace, PICTURE_NUMBERS, 0, NULL).value;
}

static graze_status estimate_mean(const rendering *whole, double *mean, const graze_report *report) {
    pilot p = make_pilot(whole);
    size_t count = (size_t)p.columns * (size_t)p.rows;
    p.values = malloc(count * sizeof *p.values);
    if (!p.values)
        return report_out_of_memory(report);
    parallel_for(whole->settings.threads, count, sample_pilot, &p);
    rgb sum = {0, 0, 0};
    for (size_t i = 0; i < count; i++)
        sum = rgb_add(sum, p.values[i]);
    free(p.values);
    *mean = rgb_max(sum) / (double)count;
    return GRAZE_OK;
}

/* What the pilot paths of the irradiance cache meet first: the same pixels. */
static path_hit pilot_hit(void *user, size_t index) {
    const pilot *p = user;
    const path_context context = {.scene = p->picture->scene, .settings = &p->picture->trace};
    pixel at = pilot_pixel(p, index);
    graze_ray ray;
    if (is_stopped(p->picture) || !camera_ray(&p->picture->settings, at.column, at.row, &camera_center, &ray))
        return (path_hit){.surface = -1, .light = -1};
    return path_cast(&context, ray.origin, ray.direction, ray.limit > 0 ? ray.limit : GEOMETRY_FAR, -1);
}

/* The cache is for interreflections, in pictures large enough to make up for what it costs. */
static graze_status build_cache(rendering *whole, const graze_report *report) {
    const picture_settings *s = &whole->settings;
    const path_context context = {.scene = whole->scene, .settings = &whole->trace};
    if (s->without_cache || whole->trace.samples || (double)s->width * s->height < CACHE_PIXELS ||
        whole->trace.error < CACHE_ERROR)
        return GRAZE_OK;
    pilot p = make_pilot(whole);
    return irradiance_cache_build(&whole->cache, &context, pilot_hit, &p, (size_t)p.columns * (size_t)p.rows,
                                  s->threads, report);
}

static graze_answer survey_pixel(void *user, const graze_trace_settings *settings, int column, int row) {
    const rendering *whole = user;
    const pixel at = {.picture = whole, .column = column, .row = row};
    if (is_stopped(whole))
        return (graze_answer){.samples = 0};
    return estimate_pixel(&at, settings, SURVEY_NUMBERS, 0, NULL);
}

static void forget_shared(rendering *p) {
    shared_light_destroy(p->shared);
    irradiance_cache_destroy(p->cache);
    p->shared = NULL;
    p->cache = NULL;
}

/* What pixels share is made anew if making it was interrupted. */
static graze_status build_shared(rendering *p, const graze_report *report) {
    if (p->cache)
        return GRAZE_OK;
    graze_status status = build_cache(p, report);
    if (status == GRAZE_OK)
        status = shared_light_build(&p->shared, p->scene, &p->trace, &p->settings, p->cache, &p->stopped, report);
    if (status != GRAZE_OK || is_stopped(p))
        forget_shared(p);
    return status;
}

graze_status picture_begin(rendering **out, const graze_scene *scene, const graze_trace_settings *trace,
                           const picture_settings *settings, const graze_report *report) {
    rendering *p = *out = calloc(1, sizeof *p);
    if (!p)
        return report_out_of_memory(report);
    p->settings = *settings;
    p->trace = *trace;
    p->scene = scene;
    p->order = order_create(settings->width, settings->height, settings->spacing);
    atomic_init(&p->stopped, false);
    atomic_init(&p->floor_known, false);
    atomic_init(&p->finished, 0);
    atomic_init(&p->unconverged, 0);
    atomic_init(&p->paths, 0);
    atomic_init(&p->error, 0);
    if (!film_create(&p->film, settings->width, settings->height, settings->content)) {
        free(p);
        *out = NULL;
        (void)report_error(report, NULL, "out of memory: a picture of %d x %d pixels takes %.3g GB", settings->width,
                           settings->height, film_bytes(settings->width, settings->height, settings->content) / 1e9);
        return GRAZE_SYSTEM_ERROR;
    }
    p->film.image->pixel_aspect = settings->pixel_aspect;
    return GRAZE_OK;
}

void picture_destroy(rendering *p) {
    if (!p)
        return;
    forget_shared(p);
    survey_free(&p->survey);
    film_free(&p->film);
    free(p);
}

graze_status picture_render(rendering *p, const graze_report *report) {
    if (!atomic_load(&p->floor_known) && !p->trace.samples) {
        double mean = 0;
        graze_status status = estimate_mean(p, &mean, report);
        if (status != GRAZE_OK || is_stopped(p))
            return status;
        p->trace.floor = fmax(p->trace.floor, PICTURE_FLOOR * mean);
    }
    atomic_store(&p->floor_known, true);
    graze_status status = build_shared(p, report);
    if (status != GRAZE_OK || is_stopped(p))
        return status;
    if (!p->trace.samples && !p->survey.least) {
        const picture_settings *s = &p->settings;
        status = survey_make(&p->survey, s->width, s->height, &p->trace, s->threads, survey_pixel, p, report);
        if (status != GRAZE_OK)
            return status;
        if (is_stopped(p)) {
            survey_free(&p->survey);
            return GRAZE_OK;
        }
    }
    parallel_for(p->settings.threads, order_count(&p->order), render_piece, p);
    return GRAZE_OK;
}

void picture_stop(rendering *p) {
    atomic_store(&p->stopped, true);
}

picture_progress picture_look(const rendering *p) {
    picture_progress look = {
        .finished = atomic_load(&p->finished),
        .total = (size_t)p->settings.width * (size_t)p->settings.height,
        .unconverged = atomic_load(&p->unconverged),
        .paths = atomic_load(&p->paths),
    };
    if (look.finished > 0)
        look.error = (double)atomic_load(&p->error) / ERROR_UNITS / (double)look.finished;
    return look;
}

image *picture_image(rendering *p) {
    return p->film.image;
}
