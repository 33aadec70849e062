/* Passes over tiles. */
#include "picture/order.h"

#include "base/even_steps.h"

enum { TILE = 16 };

static int smaller(int a, int b) {
    return a < b ? a : b;
}

static size_t common_divisor(size_t a, size_t b) {
    while (b) {
        size_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* A step round all tiles, in the golden section: the first few tiles, however many, are well spread. */
static size_t golden_stride(size_t tiles) {
    size_t stride = (size_t)(GOLDEN_SECTION * (double)tiles);
    while (stride < 1 || common_divisor(stride, tiles) != 1)
        stride++;
    return stride;
}

order order_create(int width, int height, int spacing) {
    order o = {.width = width, .height = height, .spacing = 1, .passes = 1};
    while (2 * o.spacing <= smaller(spacing, TILE)) {
        o.spacing *= 2;
        o.passes += 2;
    }
    o.across = (width + TILE - 1) / TILE;
    o.down = (height + TILE - 1) / TILE;
    o.stride = golden_stride((size_t)o.across * (size_t)o.down);
    return o;
}

size_t order_count(const order *o) {
    return (size_t)o->across * (size_t)o->down * (size_t)o->passes;
}

order_piece order_piece_at(const order *o, size_t index) {
    size_t tiles = (size_t)o->across * (size_t)o->down, tile = index % tiles * o->stride % tiles;
    int pass = (int)(index / tiles);
    int left = (int)(tile % (size_t)o->across) * TILE, top = (int)(tile / (size_t)o->across) * TILE;
    order_piece p = {.right = smaller(left + TILE, o->width), .bottom = smaller(top + TILE, o->height)};
    /* After the coarsest grid, each two passes halve its steps: columns between in its rows, then the rows between. */
    int coarse = o->spacing >> (pass > 0 ? (pass - 1) / 2 : 0), half = coarse / 2;
    if (pass == 0)
        p.step = p.step_down = o->spacing;
    else if (pass % 2 == 1)
        p.step = p.step_down = coarse;
    else
        p.step = half, p.step_down = coarse;
    p.left = left + (pass % 2 == 1 ? half : 0);
    p.top = top + (pass > 0 && pass % 2 == 0 ? half : 0);
    return p;
}
