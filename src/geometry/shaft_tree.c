/* Shapes sorted along a Morton curve, and the hierarchy that this order has by itself (Lauterbach et al., "Fast BVH
 * Construction on GPUs", Computer Graphics Forum 28(2), 2009). */
#include "geometry/shaft_tree.h"

#include <stdlib.h>

#include "base/parallel.h"
#include "geometry/shaft_split.h"

/* In scenes of more shapes than a few, leaves hold several small ones, and the curve's order must do for them. */
#define FEW       SHAFT_SPLIT_MOST
#define LEAF_SIZE 8
/* A shape is large if its area is that of a square with this part of the scene's width. Large ones have a hierarchy of
 * their own, lest small ones share boxes with them. */
#define LARGE (1.0 / 32)

/* From so many shapes on threads are worth their start; each is given so many at a time. */
#define MANY       20000
#define BLOCK_SIZE 2048

#define AXIS_BITS 10
#define CODE_BITS (3 * AXIS_BITS)
#define SMALL_BIT (UINT32_C(1) << CODE_BITS)

typedef struct item {
    uint32_t code;
    int shape;
} item;

/* Puts two zeros before each of ten bits. */
static uint32_t spread(uint32_t x) {
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

static uint32_t cell(double x, double lower, double upper) {
    const double last = (1 << AXIS_BITS) - 1;
    double at = (x - lower) / (upper - lower) * (1 << AXIS_BITS);
    return at > 0 ? (uint32_t)double_min(at, last) : 0;
}

/* A point somewhere in the middle, found without a look at corners. */
static vec3 middle_of(const shape *s) {
    switch (s->kind) {
    case SHAPE_POLYGON:
        return s->polygon.center;
    case SHAPE_SPHERE:
        return s->sphere.center;
    case SHAPE_CONE:
        return vec3_scale(0.5, vec3_add(s->cone.p0, s->cone.p1));
    case SHAPE_RING:
        return s->ring.center;
    }
    return vec3_make(0, 0, 0);
}

static item item_of(const shape *shapes, int index, vec3 lower, vec3 upper) {
    vec3 middle = middle_of(&shapes[index]);
    double large = LARGE * vec3_max_abs(vec3_subtract(upper, lower));
    uint32_t code = spread(cell(middle.x, lower.x, upper.x)) << 2 | spread(cell(middle.y, lower.y, upper.y)) << 1 |
                    spread(cell(middle.z, lower.z, upper.z));
    return (item){code | (shape_area(&shapes[index]) <= large * large ? SMALL_BIT : 0), index};
}

/* What leaves are made of. Shapes lie in memory in another order than here, and each in several places: it is looked up
 * while they are passed in their own order. */
typedef struct enclosure {
    vec3 lower, upper;
    bool reflects;
} enclosure;

static enclosure enclosure_of(const shape *s) {
    enclosure e = {.reflects = !s->shines};
    shape_bounds(s, &e.lower, &e.upper);
    return e;
}

#define DIGIT_BITS 11
#define DIGITS     (1 << DIGIT_BITS)

/* Sorts by one digit, keeping the order of equals. */
static void sort_digit(const item *from, item *to, size_t count, int shift) {
    uint32_t start[DIGITS] = {0}, sum = 0;
    for (size_t i = 0; i < count; i++)
        start[from[i].code >> shift & (DIGITS - 1)]++;
    for (int d = 0; d < DIGITS; d++) {
        uint32_t here = start[d];
        start[d] = sum;
        sum += here;
    }
    for (size_t i = 0; i < count; i++)
        to[start[from[i].code >> shift & (DIGITS - 1)]++] = from[i];
}

static int compare_items(const void *a, const void *b) {
    const item *x = a, *y = b;
    return x->code != y->code ? (x->code > y->code) - (x->code < y->code)
                              : (x->shape > y->shape) - (x->shape < y->shape);
}

/* The sorted items, in one of the two arrays. */
static item *sort_items(item *items, item *other, size_t count) {
    if (count <= DIGITS) {
        qsort(items, count, sizeof *items, compare_items);
        return items;
    }
    for (int shift = 0; shift <= CODE_BITS; shift += DIGIT_BITS) {
        sort_digit(items, other, count, shift);
        item *swap = items;
        items = other;
        other = swap;
    }
    return items;
}

typedef struct builder {
    shaft_tree *tree;
    const shape *shapes;
    const enclosure *enclosures; /* by shape */
    const item *items;
    size_t leaf_size;
    struct branches *branches; /* what is left for threads to build; null: nothing */
} builder;

/* A part of the tree that is built for itself: its root is a node of the whole that is there already. */
typedef struct branch {
    uint32_t index;
    size_t first, end;
    int depth;
    shaft_tree own;
} branch;

typedef struct branches {
    branch *items;
    size_t count, capacity;
} branches;

/* So many shapes are a branch, or fewer. */
#define BRANCH_SIZE 4096

static void include_box(shaft_node *node, vec3 lower, vec3 upper) {
    node->lower = vec3_min(node->lower, lower);
    node->upper = vec3_max(node->upper, upper);
}

static shaft_node leaf_of(const builder *b, size_t first, size_t end) {
    shaft_node leaf = {.lower = {INFINITY, INFINITY, INFINITY},
                       .upper = {-INFINITY, -INFINITY, -INFINITY},
                       .first = (uint32_t)first,
                       .count = (uint32_t)(end - first)};
    for (size_t i = first; i < end; i++) {
        const enclosure *e = &b->enclosures[b->tree->order[i]];
        include_box(&leaf, e->lower, e->upper);
        leaf.reflects = leaf.reflects || e->reflects;
    }
    return leaf;
}

/* Where the highest bit changes in which the codes differ; in the middle if they are all alike. */
static size_t split_place(const item *items, size_t first, size_t end) {
    uint32_t different = items[first].code ^ items[end - 1].code, bit = SMALL_BIT;
    if (different == 0)
        return first + (end - first) / 2;
    while (!(different & bit))
        bit >>= 1;
    size_t low = first, high = end - 1; /* without the bit, with it */
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (items[middle].code & bit)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static bool has_room(shaft_tree *tree) {
    if (tree->node_count + 2 <= tree->capacity)
        return true;
    uint32_t capacity = 2 * tree->capacity;
    shaft_node *nodes = realloc(tree->nodes, capacity * sizeof *nodes);
    if (!nodes)
        return false;
    tree->nodes = nodes;
    tree->capacity = capacity;
    return true;
}

static bool leave_branch(branches *left, uint32_t index, size_t first, size_t end, int depth) {
    if (left->count == left->capacity) {
        size_t capacity = left->capacity ? 2 * left->capacity : 256;
        branch *items = realloc(left->items, capacity * sizeof *items);
        if (!items)
            return false;
        left->items = items;
        left->capacity = capacity;
    }
    left->items[left->count++] = (branch){.index = index, .first = first, .end = end, .depth = depth};
    return true;
}

/* What an inner node is, of its children. */
static void join_children(shaft_tree *tree, uint32_t index, uint32_t child) {
    shaft_node node = tree->nodes[child];
    include_box(&node, tree->nodes[child + 1].lower, tree->nodes[child + 1].upper);
    node.reflects = node.reflects || tree->nodes[child + 1].reflects;
    node.first = child;
    node.count = 0;
    tree->nodes[index] = node;
}

/* Fills in a node, and all below it but branches that are left. */
static bool build_node(const builder *b, uint32_t index, size_t first, size_t end, int depth) {
    shaft_tree *tree = b->tree;
    bool small = b->items[first].code & SMALL_BIT; /* items come in the curve's order, large ones first */
    size_t most = small ? b->leaf_size : 1;
    if (end - first <= most || depth == SHAFT_TREE_DEPTH) {
        tree->nodes[index] = leaf_of(b, first, end);
        return true;
    }
    if (b->branches && end - first <= BRANCH_SIZE)
        return leave_branch(b->branches, index, first, end, depth);
    if (!has_room(tree))
        return false;
    uint32_t child = tree->node_count;
    tree->node_count += 2;
    size_t split = most == 1 && end - first <= FEW ? first + shaft_split(b->shapes, tree->order + first, end - first)
                                                   : split_place(b->items, first, end);
    if (!build_node(b, child, first, split, depth + 1) || !build_node(b, child + 1, split, end, depth + 1))
        return false;
    if (b->branches)
        tree->nodes[index] = (shaft_node){.first = child};
    else
        join_children(tree, index, child);
    return true;
}

static void build_branch(void *user, size_t index, int worker) {
    (void)worker;
    const builder *whole = user;
    branch *part = &whole->branches->items[index];
    builder b = *whole;
    b.tree = &part->own;
    b.branches = NULL;
    part->own = (shaft_tree){.capacity = 1024, .node_count = 1, .order = whole->tree->order};
    part->own.nodes = malloc(part->own.capacity * sizeof *part->own.nodes);
    if (part->own.nodes && !build_node(&b, 0, part->first, part->end, part->depth)) {
        free(part->own.nodes);
        part->own.nodes = NULL;
    }
}

/* Moves a branch's nodes behind the others; its children there are counted from its own first. */
static void graft(shaft_tree *tree, const branch *part) {
    uint32_t offset = tree->node_count - 1;
    for (uint32_t i = 0; i < part->own.node_count; i++) {
        shaft_node node = part->own.nodes[i];
        if (node.count == 0)
            node.first += offset;
        tree->nodes[i == 0 ? part->index : offset + i] = node;
    }
    tree->node_count += part->own.node_count - 1;
}

static bool graft_all(shaft_tree *tree, const branches *left) {
    size_t count = tree->node_count;
    uint32_t trunk = tree->node_count;
    for (size_t i = 0; i < left->count; i++) {
        if (!left->items[i].own.nodes)
            return false;
        count += left->items[i].own.node_count;
    }
    shaft_node *nodes = realloc(tree->nodes, count * sizeof *nodes);
    if (!nodes)
        return false;
    tree->nodes = nodes;
    tree->capacity = (uint32_t)count;
    for (size_t i = 0; i < left->count; i++)
        graft(tree, &left->items[i]);
    /* Children stand behind what they are children of. */
    for (uint32_t i = trunk; i-- > 0;)
        if (nodes[i].count == 0)
            join_children(tree, i, nodes[i].first);
    return true;
}

/* By several threads: first the trunk, then the branches, then what the trunk's nodes are of them. */
static bool build_by_branches(const builder *b, size_t count, int threads) {
    branches left = {0};
    builder trunk = *b;
    trunk.branches = &left;
    bool built = build_node(&trunk, 0, 0, count, 1);
    if (built) {
        parallel_for(threads, left.count, build_branch, &trunk);
        built = graft_all(b->tree, &left);
    }
    for (size_t i = 0; i < left.count; i++)
        free(left.items[i].own.nodes);
    free(left.items);
    return built;
}

static bool build_from(shaft_tree *tree, const shape *shapes, const enclosure *enclosures, const item *items,
                       size_t count, int threads) {
    builder b = {tree, shapes, enclosures, items, count > FEW ? LEAF_SIZE : 1, NULL};
    tree->capacity = (uint32_t)fmin(2.0 * (double)count, 2 * FEW) + 2;
    tree->node_count = 1;
    tree->nodes = malloc(tree->capacity * sizeof *tree->nodes);
    tree->order = malloc(count * sizeof *tree->order);
    if (!tree->nodes || !tree->order)
        return false;
    for (size_t i = 0; i < count; i++)
        tree->order[i] = items[i].shape;
    return threads > 1 && count >= MANY ? build_by_branches(&b, count, threads) : build_node(&b, 0, 0, count, 1);
}

/* What is found out of each shape, some neighbours at a time. */
typedef struct survey {
    const shape *shapes;
    size_t count;
    vec3 lower, upper;
    item *items;
    enclosure *enclosures;
} survey;

static void survey_block(void *user, size_t index, int worker) {
    (void)worker;
    const survey *s = user;
    size_t end = (index + 1) * BLOCK_SIZE < s->count ? (index + 1) * BLOCK_SIZE : s->count;
    for (size_t i = index * BLOCK_SIZE; i < end; i++) {
        s->items[i] = item_of(s->shapes, (int)i, s->lower, s->upper);
        s->enclosures[i] = enclosure_of(&s->shapes[i]);
    }
}

bool shaft_tree_build(shaft_tree *tree, const shape *shapes, size_t count, vec3 lower, vec3 upper, int threads) {
    *tree = (shaft_tree){0};
    item *items = malloc(2 * count * sizeof *items);
    enclosure *enclosures = malloc(count * sizeof *enclosures);
    bool built = false;
    if (items && enclosures) {
        survey s = {shapes, count, lower, upper, items, enclosures};
        parallel_for(count < MANY ? 1 : threads, (count + BLOCK_SIZE - 1) / BLOCK_SIZE, survey_block, &s);
        built = build_from(tree, shapes, enclosures, sort_items(items, items + count, count), count, threads);
    }
    free(items);
    free(enclosures);
    if (!built)
        shaft_tree_free(tree);
    return built;
}

void shaft_tree_free(shaft_tree *tree) {
    free(tree->nodes);
    free(tree->order);
    *tree = (shaft_tree){0};
}
