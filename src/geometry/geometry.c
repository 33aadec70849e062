/* Building what rays are cast in: of each group its tree, copied ones first. */
#include "geometry/geometry.h"

#include <limits.h>
#include <stdlib.h>

#include "geometry/embree_scene.h"
#include "geometry/few.h"

/* Numbers the surfaces of copies; false where there are more than numbers. */
static bool number_surfaces(const geometry *g, geometry_tree *tree) {
    int64_t next = (int64_t)tree->shape_count;
    for (size_t i = 0; i < tree->placement_count; i++) {
        tree->firsts[i] = next;
        next += g->trees[tree->placements[i].group].surface_count;
        if (next > INT64_MAX / 2)
            return false;
    }
    tree->surface_count = next;
    return true;
}

static bool allocate_surfaces(geometry_tree *tree) {
    tree->triangles = aligned_alloc(64, (tree->triangle_count + 1) * sizeof *tree->triangles);
    tree->curved = malloc((tree->curved_count + 1) * sizeof *tree->curved);
    return tree->triangles && tree->curved;
}

static graze_status build_surveyed(geometry *g, geometry_survey *s, int threads, const graze_report *report) {
    geometry_tree *tree = s->tree;
    if (!geometry_survey_make(g, s, threads) || !allocate_surfaces(tree))
        return report_out_of_memory(report);
    if (tree->triangle_count > UINT_MAX / 3)
        return report_error(report, NULL, "too many triangles");
    if (tree->triangle_count + tree->curved_count + tree->placed_count == 0)
        return GRAZE_OK;
    if (g->tree_count == 1 && geometry_few_suffice(tree))
        return geometry_few_make(tree, report);
    return geometry_scene_build(g, s, threads, report);
}

static graze_status build_tree(geometry *g, geometry_tree *tree, const geometry_group *group, int threads,
                               const graze_report *report) {
    tree->shapes = group->shapes;
    tree->shape_count = group->shape_count;
    tree->placements = group->placements;
    tree->placement_count = group->placement_count;
    tree->triangles_id = tree->placed_id = RTC_INVALID_GEOMETRY_ID;
    tree->firsts = malloc((tree->placement_count + 1) * sizeof *tree->firsts);
    if (!tree->firsts)
        return report_out_of_memory(report);
    if (group->shape_count > INT_MAX || group->placement_count > INT_MAX || !number_surfaces(g, tree))
        return report_error(report, NULL, "too many surfaces");
    geometry_survey s = {.tree = tree};
    graze_status status = build_surveyed(g, &s, threads, report);
    free(s.blocks);
    return status;
}

graze_status geometry_build(geometry **made, const geometry_group *groups, size_t count, int threads,
                            const graze_report *report) {
    *made = NULL;
    geometry *g = calloc(1, sizeof *g);
    geometry_tree *trees = calloc(count, sizeof *trees);
    if (!g || !trees) {
        free(g);
        free(trees);
        return report_out_of_memory(report);
    }
    g->trees = trees;
    g->tree_count = count;
    g->threads = threads;
    for (size_t i = 0; i < count; i++) {
        trees[i].shape_count = groups[i].shape_count;
        trees[i].placement_count = groups[i].placement_count;
    }
    graze_status status = GRAZE_OK;
    /* What is copied is built before what holds the copies. */
    for (size_t i = count; i-- > 0 && !status;)
        status = build_tree(g, &trees[i], &groups[i], threads, report);
    if (status) {
        geometry_destroy(g);
        return status;
    }
    g->empty = !trees[0].scene && !trees[0].few;
    if (!g->empty)
        g->largest_reach = geometry_box_reach((geometry_box){trees[0].lower, trees[0].upper});
    *made = g;
    return GRAZE_OK;
}

static void free_tree(geometry_tree *tree) {
    if (tree->scene)
        rtcReleaseScene(tree->scene);
    free(tree->few);
    free(tree->triangles);
    free(tree->reach);
    free(tree->curved);
    free(tree->placed);
    free(tree->firsts);
}

void geometry_destroy(geometry *g) {
    if (!g)
        return;
    for (size_t i = 0; i < g->tree_count; i++)
        free_tree(&g->trees[i]);
    if (g->device)
        rtcReleaseDevice(g->device);
    shaft_tree_free(&g->sights);
    shaft_tree_free(&g->copied_sights);
    free(g->copied_boxes);
    free(g->trees);
    free(g);
}
