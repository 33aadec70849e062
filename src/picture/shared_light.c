/* Records of indirect light on a grid of pixels, and surfaces through those about a pixel. */
#include "picture/shared_light.h"

#include <stdlib.h>

#include "base/parallel.h"
#include "base/report.h"
#include "picture/camera.h"

/* Records are so many pixels apart, or farther where there would be more of them than the number below. */
#define SPACING      4
#define MOST_RECORDS 65536.0
/* Pixels look so far for records, in units of their spacing. */
#define REACH 3
enum { MOST_ABOUT = (2 * REACH + 1) * (2 * REACH + 1) };

/* A record's rays: this over the error asked for, or somewhat less. */
#define RAYS_TIMES_ERROR 16.0

/* What faces the same way, and is in the same plane, by this part of the distance, is taken for the same thing. */
#define SAME_COSINE 0.98
#define SAME_PLANE  0.02
/* Points look at each other from this part of their distance above them. */
#define LIFT 0.0625

typedef struct record {
    bool valid;
    irradiance_record place;
    rgb irradiance;
    rgb told[IRRADIANCE_PARTS]; /* as in path_indirect */
} record;

struct shared_light {
    const graze_scene *scene;
    const graze_trace_settings *trace;
    const picture_settings *settings;
    const irradiance_cache *cache;
    const atomic_bool *stopped;
    int spacing, columns, rows;
    uint32_t rays;
    record *records;
};

/* What the pixel's centre shows. False: nothing that could share light. */
static bool look(const shared_light *s, int column, int row, irradiance_record *shown) {
    const path_context context = {.scene = s->scene, .settings = s->trace};
    graze_ray ray;
    if (!camera_ray(s->settings, column, row, &camera_center, &ray))
        return false;
    path_hit hit = path_cast(&context, ray.origin, ray.direction, ray.limit > 0 ? ray.limit : GEOMETRY_FAR, -1);
    return path_asks_indirect(&context, &hit, shown);
}

static void gather(const shared_light *s, uint64_t key, record *r) {
    path_memory memory;
    path_memory_begin(&memory, true);
    const path_context context = {.scene = s->scene, .settings = s->trace, .cache = s->cache, .memory = &memory};
    for (uint32_t i = 0; i < s->rays; i++) {
        sampler points = sampler_start(key, i);
        path_sample sample;
        path_indirect_at(&context, &r->place, &points, &sample);
        r->irradiance = rgb_add_scaled(r->irradiance, 1.0 / s->rays, sample.indirect);
        for (int k = 0; k < IRRADIANCE_PARTS && sample.cached; k++)
            r->told[k] = rgb_add_scaled(r->told[k], 1.0 / s->rays, sample.told[k]);
    }
}

static void make_record(void *user, size_t index, int worker) {
    (void)worker;
    shared_light *s = user;
    record *r = &s->records[index];
    int column = (int)(index % (size_t)s->columns) * s->spacing, row = (int)(index / (size_t)s->columns) * s->spacing;
    if (atomic_load_explicit(s->stopped, memory_order_relaxed))
        return;
    r->valid = look(s, column, row, &r->place);
    if (r->valid)
        gather(s, sampler_key(s->trace->seed, index, 0x4000000u), r);
}

/* Diffuse reflections that only ask for indirect light find no lights, so these must all be sampled. What comes
 * straight through panes or by one mirror is; by more mirrors it counts as indirect (trace/path.c). */
static bool is_of_use(const shared_light *s) {
    return s->cache && !s->scene->meets_glows && s->settings->aperture == 0 && s->settings->shutter == 0 &&
           context_samples_glows(s->trace);
}

static void lay_out(shared_light *s) {
    double width = s->settings->width, height = s->settings->height;
    s->spacing = (int)fmax(SPACING, ceil(sqrt(width * height / MOST_RECORDS)));
    s->columns = (s->settings->width - 1) / s->spacing + 1;
    s->rows = (s->settings->height - 1) / s->spacing + 1;
    /* Powers of 2 serve the sampler best. */
    s->rays = (uint32_t)exp2(fmax(floor(log2(RAYS_TIMES_ERROR / s->trace->error)), 4));
}

graze_status shared_light_build(shared_light **out, const graze_scene *scene, const graze_trace_settings *trace,
                                const picture_settings *settings, const irradiance_cache *cache,
                                const atomic_bool *stopped, const graze_report *report) {
    shared_light begun = {.scene = scene, .trace = trace, .settings = settings, .cache = cache, .stopped = stopped};
    *out = NULL;
    if (!is_of_use(&begun))
        return GRAZE_OK;
    lay_out(&begun);
    size_t count = (size_t)begun.columns * (size_t)begun.rows;
    begun.records = calloc(count, sizeof *begun.records);
    shared_light *s = malloc(sizeof *s);
    if (!begun.records || !s) {
        free(begun.records);
        free(s);
        return report_out_of_memory(report);
    }
    *s = begun;
    parallel_for(settings->threads, count, make_record, s);
    *out = s;
    return GRAZE_OK;
}

void shared_light_destroy(shared_light *s) {
    if (s)
        free(s->records);
    free(s);
}

/* Whether both are on the same thing, as far as that matters, and nothing stands between them. */
static bool is_alike(const shared_light *s, const irradiance_record *a, const irradiance_record *b) {
    vec3 way = vec3_subtract(b->point, a->point);
    double length = vec3_length(way);
    if (vec3_dot(a->normal, b->normal) < SAME_COSINE || fabs(vec3_dot(way, a->normal)) > SAME_PLANE * length)
        return false;
    geometry_ray ray = {.origin = vec3_add_scaled(a->point, LIFT * length, a->normal),
                        .direction = vec3_safe_normalize(way),
                        .far = length,
                        .from = -1};
    return !(length > 0) || !geometry_occluded(s->scene->geometry, &ray, -1);
}

/* The records about a pixel, with weights that fall smoothly to 0 where the next ones would come in. */
typedef struct surroundings {
    int count;
    const record *records[MOST_ABOUT];
    local_fit_value values[MOST_ABOUT];
} surroundings;

static void look_about(const shared_light *s, int column, int row, const irradiance_record *shown,
                       surroundings *found) {
    double reach = REACH * s->spacing;
    int first = column / s->spacing - REACH, last = column / s->spacing + REACH;
    int bottom = row / s->spacing - REACH, top = row / s->spacing + REACH;
    found->count = 0;
    for (int j = bottom < 0 ? 0 : bottom; j <= top && j < s->rows; j++)
        for (int i = first < 0 ? 0 : first; i <= last && i < s->columns; i++) {
            const record *r = &s->records[j * s->columns + i];
            double x = (i * s->spacing - column) / reach, y = (j * s->spacing - row) / reach, rest = 1 - x * x - y * y;
            if (!r->valid || rest <= 0 || !is_alike(s, shown, &r->place))
                continue;
            found->records[found->count] = r;
            found->values[found->count++] = (local_fit_value){x, y, rest * rest, r->irradiance};
        }
}

bool shared_light_find(const shared_light *s, int column, int row, shared_pixel *found) {
    surroundings about;
    double shares[MOST_ABOUT];
    if (!look(s, column, row, &found->place))
        return false;
    look_about(s, column, row, &found->place, &about);
    if (!local_fit_find(about.values, about.count, &found->fit, shares))
        return false;
    double pixel = 1.0 / (REACH * s->spacing);
    found->fit.slope_x = rgb_scale(pixel, found->fit.slope_x);
    found->fit.slope_y = rgb_scale(pixel, found->fit.slope_y);
    for (int k = 0; k < IRRADIANCE_PARTS; k++) {
        found->told[k] = rgb_gray(0);
        for (int i = 0; i < about.count; i++)
            found->told[k] = rgb_add_scaled(found->told[k], shares[i], about.records[i]->told[k]);
    }
    return true;
}

bool shared_light_at(const shared_light *s, const shared_pixel *p, const path_hit *hit, double x, double y,
                     path_indirect *known) {
    irradiance_record at = {.point = hit->point, .normal = hit->behind ? vec3_negate(hit->normal) : hit->normal};
    if (hit->surface < 0 || !is_alike(s, &p->place, &at))
        return false;
    rgb value = rgb_add_scaled(rgb_add_scaled(p->fit.value, x, p->fit.slope_x), y, p->fit.slope_y);
    known->irradiance = (rgb){fmax(value.r, 0), fmax(value.g, 0), fmax(value.b, 0)};
    known->error = p->fit.error;
    for (int k = 0; k < IRRADIANCE_PARTS; k++)
        known->told[k] = p->told[k];
    return true;
}
