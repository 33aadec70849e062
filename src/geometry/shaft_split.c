/* The surface area heuristic over all places along three axes. */
#include "geometry/shaft_split.h"

typedef struct bounds {
    vec3 lower, upper;
} bounds;

/* A shape with its box, and where along the axis it is. */
typedef struct entry {
    bounds box;
    double key;
    int shape;
} entry;

static bounds join(bounds a, bounds b) {
    return (bounds){vec3_min(a.lower, b.lower), vec3_max(a.upper, b.upper)};
}

static double half_area(bounds box) {
    vec3 size = vec3_subtract(box.upper, box.lower);
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

static double key_along(bounds box, int axis) {
    vec3 sum = vec3_add(box.lower, box.upper);
    return axis == 0 ? sum.x : axis == 1 ? sum.y : sum.z;
}

/* Few, and often in order already. */
static void sort_along(entry *entries, size_t count, int axis) {
    for (size_t i = 0; i < count; i++)
        entries[i].key = key_along(entries[i].box, axis);
    for (size_t i = 1; i < count; i++) {
        entry moved = entries[i];
        size_t k = i;
        for (; k > 0 && entries[k - 1].key > moved.key; k--)
            entries[k] = entries[k - 1];
        entries[k] = moved;
    }
}

/* The best place to split entries in this order. */
static size_t best_place(const entry *entries, size_t count, double *cost) {
    double above[SHAFT_SPLIT_MOST] = {0};
    bounds box = entries[count - 1].box;
    size_t best = 0;
    for (size_t i = count - 1; i > 0; i--) {
        box = join(box, entries[i].box);
        above[i] = half_area(box) * (double)(count - i);
    }
    box = entries[0].box;
    for (size_t i = 1; i < count; i++) {
        double here = above[i] + half_area(box) * (double)i;
        if (best == 0 || here < *cost) {
            *cost = here;
            best = i;
        }
        box = join(box, entries[i].box);
    }
    return best;
}

size_t shaft_split(const shape *shapes, int *order, size_t count) {
    entry entries[SHAFT_SPLIT_MOST];
    for (size_t i = 0; i < count; i++) {
        entries[i].shape = order[i];
        shape_bounds(&shapes[order[i]], &entries[i].box.lower, &entries[i].box.upper);
    }
    int best_axis = 0;
    double least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        double cost = INFINITY;
        sort_along(entries, count, axis);
        (void)best_place(entries, count, &cost);
        if (cost < least) {
            least = cost;
            best_axis = axis;
        }
    }
    sort_along(entries, count, best_axis);
    for (size_t i = 0; i < count; i++)
        order[i] = entries[i].shape;
    return best_place(entries, count, &least);
}
