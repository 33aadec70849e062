/* The order in which pixels are computed: first a coarse grid, then what lies between, each spread over the picture. */
#ifndef PICTURE_ORDER_H
#define PICTURE_ORDER_H

#include <stddef.h>

/* Pieces of work are small rectangles of the picture: all pixels there that one pass comes to. */
typedef struct order {
    int width, height, spacing;
    int across, down, passes;
    size_t stride; /* from a tile to the one that comes next */
} order;

/* Pixels `spacing` apart come first, brought down to a power of two in 1 .. 16. */
order order_create(int width, int height, int spacing);
size_t order_count(const order *); /* of pieces */

/* Pixels left, left + step, ... below right, in rows top, top + step_down, ... below bottom. */
typedef struct order_piece {
    int left, right, step, top, bottom, step_down;
} order_piece;

order_piece order_piece_at(const order *, size_t index);

#endif
