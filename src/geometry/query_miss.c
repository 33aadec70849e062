/* Triangles that Embree may have overlooked. */
#include <math.h>

#include "geometry/query.h"

static void look_around(query *q);

static bool look_at_neighbour(struct RTCPointQueryFunctionArguments *args) {
    query *q = args->userPtr;
    const visit *outer = q->visit;
    if (args->geomID == outer->tree->triangles_id) {
        query_offer_neighbour(q, args->primID);
    } else if (args->geomID == outer->tree->placed_id) {
        rad_transform both;
        visit v = query_visit_copy(q, args->primID, &both);
        if (query_clip(q, &v)) {
            q->visit = &v;
            look_around(q);
            q->visit = outer;
        }
    }
    return false;
}

/* Tests all triangles about a miss, in the group that is visited. */
static void look_around(query *q) {
    const visit *v = q->visit;
    vec3 center = query_embree_place(q, q->around->distance);
    struct RTCPointQuery around = {.x = (float)center.x,
                                   .y = (float)center.y,
                                   .z = (float)center.z,
                                   .radius = (float)fmin(2 * q->around->reach / v->unit, 4)};
    struct RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(v->tree->scene, &around, &context, look_at_neighbour, q);
}

/* Where Embree took the ray through a triangle that it passes by, single precision has been too coarse to
 * tell two neighbours apart, and the right one may have been overlooked. Where nothing else is known to stop the ray
 * there or before, it is then looked for among all triangles about that place. One of those that is almost parallel to
 * the ray may lead to the right one farther away: that is another miss, of larger reach. All are tested against the
 * true ray. */
void query_look_after_misses(query *q) {
    for (int i = 0; i < q->miss_count && !q->found_any; i++) {
        q->around = &q->misses[i];
        if (!q->nearest || q->nearest->distance > q->around->distance + q->around->error)
            look_around(q);
    }
}
