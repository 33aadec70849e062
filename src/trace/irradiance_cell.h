/* One cell of the irradiance cache. */
#ifndef TRACE_IRRADIANCE_CELL_H
#define TRACE_IRRADIANCE_CELL_H

#include <math.h>
#include <stdint.h>

#include "trace/irradiance_cache.h"
#include "trace/irradiance_slope.h"

enum { IRRADIANCE_CACHES = 2, IRRADIANCE_CELL_PARTS = IRRADIANCE_PARTS / IRRADIANCE_CACHES };

/* Half of a cell's paths, a sequence of its own; the other half decides how many they are (trace/estimate_half.h says
 * why). Parts are runs of equal length in it. */
enum { IRRADIANCE_HALVES = 2, IRRADIANCE_HALF_PARTS = IRRADIANCE_CELL_PARTS / IRRADIANCE_HALVES };

typedef struct irradiance_cell {
    uint64_t key;
    size_t first, count; /* among the sorted records */
    bool whole;          /* all are in one place */
    rgb irradiance[IRRADIANCE_CELL_PARTS];
    irradiance_slope slopes[IRRADIANCE_HALVES];
} irradiance_cell;

/* What a path has come to, by cell. */
typedef struct irradiance_end {
    uint64_t key;
    size_t order;
    irradiance_record record;
    irradiance_place place; /* in its cell */
} irradiance_end;

/* What fills the cells of one cache. */
typedef struct irradiance_filling {
    const path_context *context;
    double part;                   /* of the distance that a path comes from, that a cell's edge is at most */
    const irradiance_end *records; /* sorted by cell */
    uint32_t number;               /* of the cache */
} irradiance_filling;

/* A power of 2. */
static inline double irradiance_cell_edge(double part, double distance) {
    int exponent;
    (void)frexp(part * distance, &exponent);
    return ldexp(0.5, exponent);
}

/* A part's irradiance at a place in a cell that is whole. */
static inline rgb irradiance_cell_at(const irradiance_cell *c, int part, irradiance_place at) {
    return irradiance_at(&c->slopes[part / IRRADIANCE_HALF_PARTS], c->irradiance[part], at);
}

/* Finds out whether the cell is whole, and if so its irradiance. */
void irradiance_cell_fill(const irradiance_filling *, irradiance_cell *);

#endif
