/* Surfaces that antimatter has cut away, and the faces that it closes what it cuts with.
 *
 * Whether a point is inside of a body is told by how often the ray that comes there has entered it more than left it,
 * which is found by following it back: what is open on the far side, such as a floor, is then a body, too, as in
 * Radiance. */
#include "scene/cuts.h"

#include <stdlib.h>
#include <string.h>

#include "scene/bounds.h"
#include "scene/surface.h"

/* As many materials of antimatter may a scene have: a bit for each. */
enum { MOST = 64 };

struct scene_cuts {
    int count;             /* of antimatters */
    int materials[MOST];   /* of each its material */
    uint64_t *cut_by;      /* by modifier: the antimatters that cut its surfaces */
    shape *bounds;         /* the scene's own surfaces of theirs, those of each behind one another */
    scene_bounds of[MOST]; /* the bounds of each: those of two may coincide */
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

/* What is looked for among surfaces: those of a modifier, or of a material (the other is RAD_VOID). */
typedef struct wanted {
    int modifier, material;
} wanted;

static bool is_wanted(const graze_scene *scene, const scene_surface *s, wanted w) {
    return s->primitive >= 0 && ((w.modifier != RAD_VOID && scene->primitives[s->primitive].modifier == w.modifier) ||
                                 (w.material != RAD_VOID && s->material == w.material));
}

/* Light may pass what is wanted. False: some of it shines. */
static bool let_pass(const graze_scene *scene, const scene_surface *surfaces, shape *shapes, size_t count, wanted w) {
    bool dark = true;
    for (size_t i = 0; i < count; i++) {
        if (!is_wanted(scene, &surfaces[i], w))
            continue;
        dark = dark && surfaces[i].light < 0;
        shapes[i].passes = true;
    }
    return dark;
}

/* The same of copies by their own modifiers: then light may pass all that is in them. */
static bool let_pass_copies(const graze_scene *scene, const scene_part *part, wanted w) {
    bool dark = true;
    for (size_t i = 0; i < part->copy_count; i++) {
        geometry_placement *copy = &part->placements[i];
        if (!copy->replaces || !is_wanted(scene, &part->replacing[i], w))
            continue;
        dark = dark && part->replacing[i].light < 0;
        copy->passes = true;
    }
    return dark;
}

static bool let_all_pass(graze_scene *scene, wanted w) {
    bool dark = let_pass(scene, scene->surfaces, scene->shapes, scene->surface_count, w);
    for (size_t i = 0; i < scene->part_count; i++) {
        scene_part *part = &scene->parts[i];
        if (i > 0)
            dark = let_pass(scene, part->surfaces, part->shapes, part->surface_count, w) && dark;
        dark = let_pass_copies(scene, part, w) && dark;
    }
    return dark;
}

/* Notes what one antimatter cuts. */
static graze_status note_cut(graze_scene *scene, int antimatter, const graze_report *report) {
    scene_cuts *cuts = scene->cuts;
    const rad_primitive *p = &scene->primitives[scene->materials[cuts->materials[antimatter]].primitive];
    for (uint32_t i = 0; i < p->string_count; i++) {
        int modifier = listed(scene, p, p->strings[i], report);
        if (modifier == RAD_VOID)
            continue;
        if (scene->primitives[modifier].type == RAD_MIST || scene->primitives[modifier].type == RAD_ANTIMATTER)
            return rad_primitive_error(report, p, "it names %.64s, which is mist or antimatter: that is not supported",
                                       p->strings[i]);
        if (!let_all_pass(scene, (wanted){modifier, RAD_VOID}))
            return rad_primitive_error(report, p, "it cuts %s, which shines: that is not supported", p->strings[i]);
        cuts->cut_by[modifier] |= bit(antimatter);
    }
    return GRAZE_OK;
}

/* The antimatters that cut a surface. */
static uint64_t cuts_of(const graze_scene *scene, const scene_surface *s) {
    const int modifier = scene->primitives[s->primitive].modifier;
    return modifier == RAD_VOID ? 0 : scene->cuts->cut_by[modifier];
}

/* Lights are not sampled in what is left of mirrors and panes. */
static void leave_mirrors_out(graze_scene *scene) {
    size_t kept = 0;
    for (size_t i = 0; i < scene->mirror_surface_count; i++) {
        int mirror = scene->mirror_surfaces[i];
        if (cuts_of(scene, &scene->surfaces[mirror]))
            scene->surfaces[mirror].mirrors = false;
        else
            scene->mirror_surfaces[kept++] = mirror;
    }
    scene->mirror_surface_count = kept;
}

/* Builds the bounds of one antimatter; gives how many of them are the scene's own. */
static graze_status build_bounds(graze_scene *scene, int antimatter, shape *bounds, size_t *count, int threads,
                                 const graze_report *report) {
    scene_cuts *cuts = scene->cuts;
    const int material = cuts->materials[antimatter];
    *count = 0;
    for (size_t k = 0; k < scene->surface_count; k++)
        if (scene->surfaces[k].material == material)
            bounds[(*count)++] = scene->shapes[k];
    (void)let_all_pass(scene, (wanted){RAD_VOID, material});
    return scene_bounds_build(&cuts->of[antimatter], scene, material, bounds, *count, threads, report);
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
    if (count == 0 && !scene->mist_in_copies)
        return GRAZE_OK;
    scene_cuts *cuts = scene->cuts = calloc(1, sizeof *cuts);
    if (!cuts)
        return report_out_of_memory(report);
    cuts->count = count;
    memcpy(cuts->materials, materials, sizeof materials[0] * (size_t)count);
    cuts->cut_by = calloc(scene->primitive_count + 1, sizeof *cuts->cut_by);
    cuts->bounds = calloc(scene->surface_count + 1, sizeof *cuts->bounds);
    if (!cuts->cut_by || !cuts->bounds)
        return report_out_of_memory(report);
    scene->has_panes = true;
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
        scene_bounds_destroy(&cuts->of[i]);
    free(cuts->cut_by);
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
    const graze_scene *scene; /* whose surfaces count that it cuts; null: all do */
} crossings;

static uint64_t cuts_of_surface(const graze_scene *scene, int64_t surface) {
    if (!scene)
        return 0;
    const scene_surface s = scene_surface_at(scene, surface);
    return cuts_of(scene, &s);
}

/* Counts from the ray's origin back, up to what is known already, and keeps that for points further on. What is not
 * counted is kept, too: of many antimatters in one another each would come to all before it again. */
static scene_cuts_crossing count_back(const geometry *g, geometry_ray ray, const crossings *counted,
                                      scene_cuts_crossing *known) {
    scene_cuts_crossing found = {.antimatter = counted->antimatter, .surface = -1};
    geometry_hit hit;
    while (next_hit(g, &ray, &hit)) {
        const bool entered = vec3_dot(hit.normal, ray.direction) > 0;
        const bool is_known = is_same_crossing(known, counted->antimatter, &hit, entered);
        const uint64_t cut_by = is_known ? 0 : cuts_of_surface(counted->scene, hit.surface);
        const bool counts = !counted->scene || (cut_by & bit(counted->antimatter));
        const int most = found.balance + (is_known ? known->most : counts && entered);
        if (found.surface < 0) {
            found.surface = hit.surface;
            found.point = hit.point;
            found.entered = entered;
        }
        if (most > found.most) {
            found.most = most;
            found.others = is_known ? known->others : cut_by & ~bit(counted->antimatter);
        }
        if (is_known)
            found.balance += known->balance;
        else if (counts)
            found.balance += entered ? 1 : -1;
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
        if ((asked & bit(i)) && count_back(cuts->of[i].geometry, back, &(crossings){.antimatter = i},
                                           &walk->antimatters[i % SCENE_CUTS_REMEMBERED])
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
    const scene_cuts_crossing found = count_back(scene->geometry, back, &(crossings){antimatter, scene},
                                                 &walk->bodies[antimatter % SCENE_CUTS_REMEMBERED]);
    return found.balance > 0 && !is_inside(cuts, walk, found.others, point, direction);
}

/* Which antimatter is of this material; there is one. */
static int antimatter_of(const scene_cuts *cuts, int material) {
    int i = 0;
    while (cuts->materials[i] != material)
        i++;
    return i;
}

scene_presence scene_cuts_at(const graze_scene *scene, scene_cuts_walk *walk, int64_t surface, vec3 point,
                             vec3 direction) {
    const scene_cuts *cuts = scene->cuts;
    const scene_surface s = scene_surface_at(scene, surface);
    const scene_material *m = &scene->materials[s.material];
    const vec3 back = vec3_negate(direction);
    if (m->mist >= 0)
        return SCENE_CUT_AWAY;
    begin(walk);
    if (!m->cuts)
        return is_inside(cuts, walk, cuts_of(scene, &s), point, back) ? SCENE_CUT_AWAY : SCENE_THERE;
    bool face = m->alternate >= 0 && is_face(scene, walk, antimatter_of(cuts, s.material), surface, point, back);
    return face ? SCENE_CUT_FACE : SCENE_CUT_AWAY;
}
