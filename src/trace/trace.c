/* The public way in: settings, casting, and one ray's answer. */
#include "graze/trace.h"

#include "base/report.h"
#include "trace/describe.h"
#include "trace/estimate.h"
#include "trace/path.h"

graze_trace_settings graze_trace_defaults(void) {
    return (graze_trace_settings){
        .back_faces_visible = 1,
        .lights_visible = 1,
        .reflection_limit = 0,
        .minimum_weight = 1e-4,
        .error = 0.02,
        .sample_limit = 1u << 16,
    };
}

/* Nobody follows a path further; and -N must exist. */
#define REFLECTIONS 1000000

graze_status graze_trace_check(const graze_trace_settings *s, const graze_report *report) {
    rgb av = s->ambient_value, me = s->mist_extinction, ma = s->mist_albedo;
    if (s->quantity < GRAZE_RADIANCE || s->quantity > GRAZE_IRRADIANCE)
        return report_error(report, NULL, "unknown quantity %d", (int)s->quantity);
    if (s->part < GRAZE_WHOLE || s->part > GRAZE_UNMIRRORED)
        return report_error(report, NULL, "unknown part %d", (int)s->part);
    if (s->strategy < GRAZE_STRATEGY_MIS || s->strategy > GRAZE_STRATEGY_UNWEIGHTED)
        return report_error(report, NULL, "unknown strategy %d", (int)s->strategy);
    if (s->reflection_limit < -REFLECTIONS || s->reflection_limit > REFLECTIONS)
        return report_error(report, NULL, "the limit of reflections must be in %d .. %d", -REFLECTIONS, REFLECTIONS);
    if (s->ambient_bounces < 0)
        return report_error(report, NULL, "ambient bounces must not be negative");
    if (!(av.r >= 0 && av.g >= 0 && av.b >= 0 && rgb_max(av) <= SCENE_LARGEST_RADIANCE))
        return report_error(report, NULL, "the ambient value must be in 0 .. 1e100");
    if (!(me.r >= 0 && me.g >= 0 && me.b >= 0 && rgb_max(me) <= SCENE_LARGEST_RADIANCE))
        return report_error(report, NULL, "the extinction of mist must be in 0 .. 1e100");
    if (!(ma.r >= 0 && ma.g >= 0 && ma.b >= 0 && rgb_max(ma) <= 1))
        return report_error(report, NULL, "the albedo of mist must be in 0 .. 1");
    if (!(s->mist_eccentricity > -1 && s->mist_eccentricity < 1))
        return report_error(report, NULL, "the eccentricity of mist must be between -1 and 1");
    if (!(s->minimum_weight >= 0 && s->minimum_weight <= 1))
        return report_error(report, NULL, "the minimum weight must be in 0 .. 1");
    if (!(s->specular_threshold >= 0 && s->specular_threshold <= 1))
        return report_error(report, NULL, "the specular threshold must be in 0 .. 1");
    if (!(s->error > 0 && isfinite(s->error)))
        return report_error(report, NULL, "the error must be positive");
    if (!(s->floor >= 0 && isfinite(s->floor)))
        return report_error(report, NULL, "the floor must be finite and not negative");
    if (s->sample_limit < 2)
        return report_error(report, NULL, "the limit must leave at least 2 samples");
    return GRAZE_OK;
}

void graze_cast(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray, graze_hit *hit) {
    vec3 direction;
    double limit;
    *hit = describe_nothing(ray->origin);
    if (settings->quantity == GRAZE_IRRADIANCE || !describe_ray(ray, &direction, &limit))
        return;
    path_context context = {.scene = scene, .settings = settings};
    path_hit found = path_cast(&context, ray->origin, direction, limit, -1);
    *hit = describe_hit(scene, &found, settings->quantity);
}

/* A ray as estimate_sample sees it. */
typedef struct request {
    path_context context;
    const path_hit *first; /* null: a sensor's, which is at `origin` and looks in the direction */
    vec3 origin, direction;
} request;

static void sample_ray(void *user, sampler *points, path_sample *sample, estimate_luck *luck) {
    const request *r = user;
    if (r->first)
        path_radiance(&r->context, r->first, points, sample);
    else
        path_irradiance(&r->context, r->origin, r->direction, points, sample);
    *luck = sample->searching ? ESTIMATE_SEARCH : sample->noisy ? ESTIMATE_NOISY : ESTIMATE_EXACT;
}

void graze_trace(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray, uint64_t stream,
                 graze_answer *answer, graze_hit *hit) {
    path_memory known;
    path_memory_begin(&known, true);
    request r = {.context = {.scene = scene, .settings = settings, .memory = &known}};
    path_hit first;
    double limit;
    *answer = (graze_answer){.converged = 1};
    if (hit)
        *hit = describe_nothing(ray->origin);
    /* No mirror is before a sensor. */
    bool sensor = settings->quantity == GRAZE_IRRADIANCE;
    if (!describe_ray(ray, &r.direction, &limit) || (sensor && settings->part == GRAZE_MIRRORED))
        return;
    if (sensor) {
        r.origin = ray->origin;
    } else {
        path_cast_into(&first, &r.context, ray->origin, r.direction, limit, -1);
        r.first = &first;
        if (hit)
            *hit = describe_hit(scene, &first, settings->quantity);
    }
    estimate(settings, stream, sample_ray, &r, answer);
}
