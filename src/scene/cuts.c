/* Surfaces that antimatter has cut away, and the faces that it closes what it cuts with.
 *
 * Whether a point is inside of a body is told by how often the ray that comes there has entered it more than left it,
 * which is found by following it back: what is open on the far side, such as a floor, is then a body, too, as in
 * Radiance. */
#include "scene/cuts.h"

#include <stdlib.h>
#include <string.h>

/* As many materials of antimatter may a scene have: a bit for each. */
enum { MOST = 64 };

struct scene_cuts {
    int count;           /* of antimatters */
    int materials[MOST]; /* of each its material */
    uint64_t *cut_by;    /* by surface: the antimatters that cut it */
    int16_t *antimatter; /* by surface: which one it bounds, or -1 */
    shape *bounds;       /* their surfaces, those of each behind one another */
    geometry *of[MOST];  /* of the bounds of each: those of two may coincide */
};

static uint64_t bit(int antimatter) {
    return UINT64_C(1) << antimatter;
}

/* The modifier of that name, the latest before the primitive; it is warned of where there is none. */
static int listed(const graze_scene *scene, const rad_primitive *p, const char *name, const graze_report *report) {
    int modifier = rad_modifier_before(scene->primitives, p, name);
    if (modifier == RAD_VOID && strcmp(name, "void"))
        rad_primitive_warning(report, p, "there is no modifier '%.64s' before it, which it could cut", name);
    return modifier;
}

/* Notes what one antimatter cuts. */
static graze_status note_cut(graze_scene *scene, int antimatter, const graze_report *report) {
    scene_cuts *cuts = scene->cuts;
    const rad_primitive *p = &scene->primitives[scene->materials[cuts->materials[antimatter]].primitive];
    for (uint32_t i = 0; i < p->string_count; i++) {
        int modifier = listed(scene, p, p->strings[i], report);
        if (modifier != RAD_VOID &&
            (scene->primitives[modifier].type == RAD_MIST || scene->primitives[modifier].type == RAD_ANTIMATTER))
            return rad_primitive_error(report, p, "it names %.64s, which is mist or antimatter: that is not supported",
                                       p->strings[i]);
        for (size_t k = 0; k < scene->surface_count && modifier != RAD_VOID; k++) {
            if (scene->primitives[scene->surfaces[k].primitive].modifier != modifier)
                continue;
            if (scene->surfaces[k].light >= 0)
                return rad_primitive_error(report, p, "it cuts %s, which shines: that is not supported", p->strings[i]);
            cuts->cut_by[k] |= bit(antimatter);
            scene->shapes[k].passes = true;
        }
    }
    return GRAZE_OK;
}

/* Lights are not sampled in what is left of mirrors. */
static void leave_mirrors_out(graze_scene *scene) {
    size_t kept = 0;
    for (size_t i = 0; i < scene->mirror_count; i++) {
        int mirror = scene->mirrors[i];
        if (scene->cuts->cut_by[mirror])
            scene->surfaces[mirror].mirrors = false;
        else
            scene->mirrors[kept++] = mirror;
    }
    scene->mirror_count = kept;
}

/* Builds the bounds of one antimatter; gives how many there are. */
static graze_status build_bounds(graze_scene *scene, int antimatter, shape *bounds, size_t *count, int threads,
                                 const graze_report *report) {
    scene_cuts *cuts = scene->cuts;
    *count = 0;
    for (size_t k = 0; k < scene->surface_count; k++) {
        if (scene->surfaces[k].material != cuts->materials[antimatter])
            continue;
        scene->shapes[k].passes = true;
        cuts->antimatter[k] = (int16_t)antimatter;
        bounds[(*count)++] = scene->shapes[k];
    }
    const geometry_group group = {.shapes = bounds, .shape_count = *count};
    return geometry_build(&cuts->of[antimatter], &group, 1, threads, report);
}

graze_status scene_cuts_make(graze_scene *scene, int threads, const graze_report *report) {
    int count = 0, materials[MOST];
    for (size_t i = 0; i < scene->material_count; i++) {
        if (!scene->materials[i].cuts)
            continue;
        if (count == MOST)
            return rad_primitive_error(report, &scene->primitives[scene->materials[i].primitive],
                                       "a scene may have no more than %d materials of antimatter", MOST);
        materials[count++] = (int)i;
    }
    if (count == 0)
        return GRAZE_OK;
    scene_cuts *cuts = scene->cuts = calloc(1, sizeof *cuts);
    if (!cuts)
        return report_out_of_memory(report);
    cuts->count = count;
    memcpy(cuts->materials, materials, sizeof materials[0] * (size_t)count);
    cuts->cut_by = calloc(scene->surface_count + 1, sizeof *cuts->cut_by);
    cuts->antimatter = calloc(scene->surface_count + 1, sizeof *cuts->antimatter);
    cuts->bounds = calloc(scene->surface_count + 1, sizeof *cuts->bounds);
    if (!cuts->cut_by || !cuts->antimatter || !cuts->bounds)
        return report_out_of_memory(report);
    scene->has_panes = true;
    memset(cuts->antimatter, -1, scene->surface_count * sizeof *cuts->antimatter);
    graze_status status = GRAZE_OK;
    shape *bounds = cuts->bounds;
    size_t built;
    for (int i = 0; i < count && status == GRAZE_OK; i++, bounds += built) {
        status = build_bounds(scene, i, bounds, &built, threads, report);
        if (status == GRAZE_OK)
            status = note_cut(scene, i, report);
    }
    leave_mirrors_out(scene);
    return status;
}

void scene_cuts_destroy(scene_cuts *cuts) {
    if (!cuts)
        return;
    for (int i = 0; i < cuts->count; i++)
        geometry_destroy(cuts->of[i]);
    free(cuts->cut_by);
    free(cuts->antimatter);
    free(cuts->bounds);
    free(cuts);
}

/* Steps to the next surface on the ray. */
static bool next_hit(const geometry *g, geometry_ray *ray, geometry_hit *hit) {
    if (!geometry_intersect(g, ray, hit))
        return false;
    ray->origin = hit->point;
    ray->from = hit->surface;
    return true;
}

/* Begins a walk: nothing is known of what is behind the ray's points. */
static void begin(scene_cuts_walk *walk) {
    if (walk->begun)
        return;
    for (int i = 0; i < SCENE_CUTS_REMEMBERED; i++)
        walk->antimatters[i].surface = walk->bodies[i].surface = -1;
    walk->begun = true;
}

/* Whether two points of a surface are one but for roundings; if not, following the ray farther back is never wrong. */
static bool is_same_crossing(const scene_cuts_crossing *known, int antimatter, const geometry_hit *hit, bool entered) {
    return known->surface == hit->surface && known->antimatter == antimatter && known->entered == entered &&
           vec3_max_abs(vec3_subtract(known->point, hit->point)) <= 1e-9 * vec3_max_abs(hit->point);
}

/* What one counts on the way back. */
typedef struct crossings {
    int antimatter;
    const uint64_t *cut_by; /* only those surfaces count that it cuts; null: all do */
    int64_t own;            /* so many have numbers in cut_by */
} crossings;

/* Counts from the ray's origin back, up to what is known already, and keeps that for points further on. */
static scene_cuts_crossing count_back(const geometry *g, geometry_ray ray, const crossings *counted,
                                      scene_cuts_crossing *known) {
    scene_cuts_crossing found = {.antimatter = counted->antimatter, .surface = -1};
    geometry_hit hit;
    while (next_hit(g, &ray, &hit)) {
        if (counted->cut_by &&
            (hit.surface >= counted->own || !(counted->cut_by[hit.surface] & bit(counted->antimatter))))
            continue;
        const bool entered = vec3_dot(hit.normal, ray.direction) > 0;
        const bool is_known = is_same_crossing(known, counted->antimatter, &hit, entered);
        const int most = found.balance + (is_known ? known->most : entered);
        if (found.surface < 0) {
            found.surface = hit.surface;
            found.point = hit.point;
            found.entered = entered;
        }
        if (most > found.most) {
            found.most = most;
            found.others = is_known          ? known->others
                           : counted->cut_by ? counted->cut_by[hit.surface] & ~bit(counted->antimatter)
                                             : 0;
        }
        found.balance += is_known ? known->balance : entered ? 1 : -1;
        if (is_known)
            break;
    }
    *known = found;
    return found;
}

/* Whether a point is inside of any of the antimatters asked for. */
static bool is_inside(const scene_cuts *cuts, scene_cuts_walk *walk, uint64_t asked, vec3 point, vec3 direction) {
    const geometry_ray back = {.origin = point, .direction = direction, .far = GEOMETRY_FAR, .from = -1};
    for (int i = 0; i < cuts->count; i++)
        if ((asked & bit(i)) &&
            count_back(cuts->of[i], back, &(crossings){.antimatter = i}, &walk->antimatters[i % SCENE_CUTS_REMEMBERED])
                    .balance > 0)
            return true;
    return false;
}

/* Whether a point of an antimatter's boundary is inside of a body that it cuts, and that no other one has cut out
 * there. */
static bool is_face(const graze_scene *scene, scene_cuts_walk *walk, int antimatter, int64_t surface, vec3 point,
                    vec3 direction) {
    const scene_cuts *cuts = scene->cuts;
    const geometry_ray back = {.origin = point, .direction = direction, .far = GEOMETRY_FAR, .from = surface};
    const crossings bodies = {antimatter, cuts->cut_by, (int64_t)scene->surface_count};
    const scene_cuts_crossing found =
        count_back(scene->geometry, back, &bodies, &walk->bodies[antimatter % SCENE_CUTS_REMEMBERED]);
    return found.balance > 0 && !is_inside(cuts, walk, found.others, point, direction);
}

scene_presence scene_cuts_at(const graze_scene *scene, scene_cuts_walk *walk, int64_t surface, vec3 point,
                             vec3 direction) {
    const scene_cuts *cuts = scene->cuts;
    if (surface >= (int64_t)scene->surface_count)
        return SCENE_THERE;
    begin(walk);
    int antimatter = cuts->antimatter[surface];
    const vec3 back = vec3_negate(direction);
    if (antimatter < 0)
        return is_inside(cuts, walk, cuts->cut_by[surface], point, back) ? SCENE_CUT_AWAY : SCENE_THERE;
    bool closes = scene->materials[cuts->materials[antimatter]].alternate >= 0;
    return closes && is_face(scene, walk, antimatter, surface, point, back) ? SCENE_CUT_FACE : SCENE_CUT_AWAY;
}
