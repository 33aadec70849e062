/* Compiling a primitive's functions, and evaluating them for a ray. */
#include "material/function.h"

#include <stdlib.h>
#include <string.h>

#include "material/from_primitive.h"

static graze_status read_transform(material_owner *o, uint32_t rest) {
    const rad_primitive *p = o->primitive;
    const uint32_t first = material_find_transform(p, rest, o->report);
    if (first == p->string_count)
        return GRAZE_OK;
    o->moved = true;
    rad_primitive_name name = {""};
    const place where = rad_primitive_place(p, &name);
    graze_status status =
        rad_transform_parse(&o->forward, p->strings + first, (int)(p->string_count - first), &where, o->report);
    if (!status)
        o->backward = rad_transform_inverse(&o->forward);
    return status;
}

graze_status material_owner_begin(material_owner *o, material_library *library, const rad_primitive *p, uint32_t file,
                                  uint32_t rest) {
    *o = (material_owner){.primitive = p,
                          .report = material_library_report(library),
                          .told = arena_allocate(material_library_memory(library), sizeof *o->told),
                          .forward = rad_transform_identity(),
                          .backward = rad_transform_identity()};
    if (!o->told)
        return report_out_of_memory(o->report);
    atomic_flag_clear(o->told);
    if (p->string_count < rest)
        return rad_primitive_error(o->report, p, "needs at least %u string arguments, not %u", (unsigned)rest,
                                   (unsigned)p->string_count);
    graze_status status = material_library_use_file(library, p->strings[file], p);
    return status ? status : read_transform(o, rest);
}

/* This much memory on the stack is enough for nearly all functions; what calls itself very deeply gets more. */
enum { SCRATCH = 4096 };

static cal_outcome evaluate(const cal_code *code, const double *channels, double *values, const char **failure) {
    double scratch[SCRATCH];
    bool cramped;
    cal_outcome outcome = cal_evaluate_within(code, channels, values, scratch, sizeof scratch, &cramped);
    *failure = outcome == CAL_FAILED && !cramped ? cal_failure(code, scratch) : NULL;
    if (!cramped)
        return outcome;
    void *memory = malloc(cal_memory_size(code));
    *failure = "out of memory";
    if (!memory)
        return CAL_FAILED;
    outcome = cal_evaluate(code, channels, values, memory);
    *failure = outcome == CAL_FAILED ? cal_failure(code, memory) : NULL;
    free(memory);
    return outcome;
}

/* What has no value for any ray, and names that are not defined, are found before the first one. */
static graze_status try(const material_function *f, const material_owner *o) {
    static const material_ray ray = {.point = {0.31, 0.42, 0.53},
                                     .direction = {0.48, 0.6, -0.64},
                                     .normal = {0, 0, 1},
                                     .distance = 1.5,
                                     .last_distance = 1.5};
    double channels[CAL_CHANNELS_MOST], values[MATERIAL_VALUES_MOST];
    const char *failure;
    for (int i = 0; i < CAL_CHANNELS_MOST; i++)
        channels[i] = 0.5;
    material_channels(channels, o, f, NULL, &ray);
    if (evaluate(f->code, channels, values, &failure) == CAL_FAILED)
        return rad_primitive_error(o->report, o->primitive, "%s", failure);
    const char *undefined = cal_code_undefined(f->code);
    return undefined ? rad_primitive_error(o->report, o->primitive, "%s", undefined) : GRAZE_OK;
}

graze_status material_function_compile(material_function *f, material_library *library, const material_owner *o,
                                       uint32_t file, const cal_expression *expressions, size_t count,
                                       uint64_t channels) {
    const rad_primitive *p = o->primitive;
    rad_primitive_name name = {""};
    const place where = rad_primitive_place(p, &name);
    const cal_request request = {.file = p->strings[file],
                                 .expressions = expressions,
                                 .expression_count = count,
                                 .reals = p->reals,
                                 .real_count = p->real_count,
                                 .channels = CAL_CHANNEL_BITS(1, CAL_RAY_CHANNELS) | channels,
                                 .where = &where};
    f->count = (int)count;
    graze_status status = material_library_compile(library, &request, &f->code);
    return status ? status : try(f, o);
}

static void set_vector(double *channels, int first, vec3 v) {
    channels[first - 1] = v.x;
    channels[first] = v.y;
    channels[first + 1] = v.z;
}

static vec3 row(const rad_transform *t, int index, double scale) {
    return vec3_scale(scale, vec3_make(t->m[index][0], t->m[index][1], t->m[index][2]));
}

void material_own_direction(double *channels, int first, const material_owner *o, vec3 direction) {
    set_vector(channels, first, o->moved ? rad_transform_direction_back(&o->forward, direction) : direction);
}

/* The transform's own channels, S, T, I, J, K. */
static void set_transform(double *channels, const rad_transform *t) {
    channels[CAL_S - 1] = t->scale;
    set_vector(channels, CAL_TX, row(t, 3, 1));
    set_vector(channels, CAL_IX, row(t, 0, 1 / t->scale));
    set_vector(channels, CAL_JX, row(t, 1, 1 / t->scale));
    set_vector(channels, CAL_KX, row(t, 2, 1 / t->scale));
}

void material_channels(double channels[CAL_CHANNELS_MOST], const material_owner *o, const material_function *first,
                       const material_function *second, const material_ray *ray) {
    const rad_transform *t = &o->backward;
    uint64_t wanted = (first ? cal_code_channels(first->code) : 0) | (second ? cal_code_channels(second->code) : 0);
    if (wanted & CAL_CHANNEL_BITS(CAL_DX, CAL_DZ))
        material_own_direction(channels, CAL_DX, o, ray->direction);
    if (wanted & CAL_CHANNEL_BITS(CAL_NX, CAL_NZ))
        material_own_direction(channels, CAL_NX, o, ray->normal);
    if (wanted & CAL_CHANNEL_BITS(CAL_PX, CAL_PZ))
        set_vector(channels, CAL_PX, o->moved ? rad_transform_point_back(&o->forward, ray->point) : ray->point);
    channels[CAL_T - 1] = ray->distance * t->scale;
    channels[CAL_TS - 1] = ray->last_distance * t->scale;
    channels[CAL_LU - 1] = ray->u;
    channels[CAL_LV - 1] = ray->v;
    channels[CAL_RDOT - 1] = fmax(fmin(-vec3_dot(ray->direction, ray->normal), 1), -1);
    if (wanted & CAL_CHANNEL_BITS(CAL_S, CAL_KZ))
        set_transform(channels, t);
}

bool material_function_values(const material_function *f, const material_owner *o, const double *channels,
                              double *values) {
    const char *failure;
    cal_outcome outcome = evaluate(f->code, channels, values, &failure);
    if (outcome == CAL_FINE)
        return true;
    if (!atomic_flag_test_and_set(o->told))
        rad_primitive_warning(o->report, o->primitive, "compute error: %s; it is left out where this happens",
                              failure ? failure : "a division by 0, or a function outside of its domain");
    return false;
}

vec3 material_to_world(const material_owner *o, vec3 v) {
    return o->moved ? rad_transform_direction(&o->forward, v) : v;
}
