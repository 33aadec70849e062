/* How far away is what a mirror shows. */
#include "trace/describe.h"
#include "trace/vertex.h"

double graze_mirrored_distance(const graze_scene *scene, const graze_trace_settings *settings, const graze_ray *ray) {
    const path_context context = {.scene = scene, .settings = settings};
    const path start = {.context = &context, .throughput = {1, 1, 1}};
    vec3 direction;
    double limit;
    vertex v;
    if (settings->quantity == GRAZE_IRRADIANCE || !describe_ray(ray, &direction, &limit))
        return GRAZE_FAR;
    path_hit first = path_cast(&context, ray->origin, direction, limit, -1);
    if (!vertex_at_hit(&start, &first, &v) || v.shading.specular_lobe != GRAZE_LOBE_MIRROR)
        return GRAZE_FAR;
    graze_surface_sample sample = graze_surface_sample_lobe(&v.shading, GRAZE_LOBE_MIRROR, 0, 0, 0);
    path_hit seen = path_cast(&context, v.point, sample.direction, GEOMETRY_FAR, v.surface);
    return seen.distance < GEOMETRY_FAR ? first.distance + seen.distance : GRAZE_FAR;
}
