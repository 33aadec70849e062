/* Extents and numbers of a group's surfaces and copies. */
#include "geometry/survey.h"

#include <stdlib.h>

#include "base/parallel.h"

/* Copies that hold something; their groups are known already. */
static geometry_box join_copies(const geometry *g, geometry_tree *tree, geometry_box all) {
    for (size_t i = 0; i < tree->placement_count; i++) {
        const geometry_placement *placement = &tree->placements[i];
        geometry_box copy;
        if (!g->trees[placement->group].scene)
            continue;
        tree->placed[tree->placed_count++] = (uint32_t)i;
        geometry_copy_bounds(g, placement, &copy.lower, &copy.upper);
        all = geometry_box_join(all, copy);
    }
    return all;
}

static void survey_block(void *user, size_t index, int worker) {
    (void)worker;
    const geometry_survey *s = user;
    geometry_tree *tree = s->tree;
    geometry_block found = {.bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}};
    for (size_t i = index * GEOMETRY_BLOCK_SIZE; i < geometry_block_end(s, index); i++) {
        geometry_box one;
        shape_bounds(&tree->shapes[i], &one.lower, &one.upper);
        tree->reach[i] = geometry_box_reach(one);
        found.bounds = geometry_box_join(found.bounds, one);
        if (tree->shapes[i].kind == SHAPE_POLYGON)
            found.triangles += tree->shapes[i].polygon.triangle_count;
        else
            found.curved++;
    }
    s->blocks[index] = found;
}

static void find_extent(const geometry *g, geometry_tree *tree, geometry_box all) {
    all = join_copies(g, tree, all);
    tree->lower = all.lower;
    tree->upper = all.upper;
    vec3 half = vec3_scale(0.5, vec3_subtract(all.upper, all.lower));
    tree->center = vec3_add(all.lower, half);
    int exponent;
    frexp(vec3_max_abs(half), &exponent);
    tree->scale = ldexp(1, -exponent - 1);
    /* At most sqrt(3) times the half-width that the scale brings below 1/2; a little more takes in roundings. */
    tree->radius =
        (1 + 1e-9) * vec3_length(vec3_scale(tree->scale, half)) / tree->scale + 1e-15 * vec3_max_abs(tree->center);
}

bool geometry_survey_make(const geometry *g, geometry_survey *s, int threads) {
    geometry_tree *tree = s->tree;
    tree->reach = malloc((tree->shape_count + 1) * sizeof *tree->reach);
    tree->placed = malloc((tree->placement_count + 1) * sizeof *tree->placed);
    s->count = (tree->shape_count + GEOMETRY_BLOCK_SIZE - 1) / GEOMETRY_BLOCK_SIZE;
    s->blocks = malloc((s->count + 1) * sizeof *s->blocks);
    if (!tree->reach || !tree->placed || !s->blocks)
        return false;
    parallel_for(threads, s->count, survey_block, s);
    geometry_box all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t i = 0; i < s->count; i++) {
        geometry_block *b = &s->blocks[i];
        all = geometry_box_join(all, b->bounds);
        b->first_triangle = tree->triangle_count;
        b->first_curved = tree->curved_count;
        tree->triangle_count += b->triangles;
        tree->curved_count += b->curved;
    }
    find_extent(g, tree, all);
    return true;
}

void geometry_collect_polygon(const geometry_tree *tree, int surface, geometry_triangle *triangle) {
    const shape *s = &tree->shapes[surface];
    for (uint32_t k = 0; k < s->polygon.triangle_count; k++, triangle++) {
        *triangle = (geometry_triangle){.normal = s->polygon.normal,
                                        .center = s->polygon.center,
                                        .surface = surface,
                                        .index = k,
                                        .shines = s->shines};
    }
}
