/* Prisms at a hit: surfaces that let all through that they do not stop, in one direction. */
#include "trace/appearance_kinds.h"
#include "trace/vertex.h"

void appearance_prepare_prism(const path *p, const path_hit *hit, const encounter *of, const material_prism *prism,
                              vertex *v) {
    static const graze_material clear = {.kind = GRAZE_TRANS, .transmission = 1, .transmitted_specularity = 1};
    material_way ways[2];
    material_prism_ways(prism, &of->ray, ways);
    double sum = ways[0].coefficient + ways[1].coefficient;
    bool both = ways[0].coefficient > 0 && ways[1].coefficient > 0;
    const material_way *way = &ways[ways[0].coefficient > 0 ? 0 : 1];
    if (both) {
        v->drawn = true;
        way = &ways[appearance_draw(p, ways[0].coefficient / sum) ? 0 : 1];
    }
    graze_surface *s = &v->shading;
    graze_surface_prepare(s, &clear, v->normal, vec3_negate(hit->direction), NULL);
    s->transmitted_specular = rgb_gray(sum);
    s->transmitted_lobe = sum > 0 ? GRAZE_LOBE_TRANSMITTED : GRAZE_LOBE_NONE;
    if (sum > 0)
        s->transmitted = of->moved ? rad_transform_direction(&of->transform, way->direction) : way->direction;
    vertex_find_ambient(p, v, &clear);
    v->refracts = true;
}
