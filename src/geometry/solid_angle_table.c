/* A density over an interval, tabulated, to be drawn from and evaluated exactly. */
#include "geometry/solid_angle_table.h"

#include <math.h>

/* A cell's parabola (1-s)^2 first + 2 s (1-s) control + s^2 last, s in [0,1]. */
typedef struct parabola {
    double first, control, last;
} parabola;

/* The control value is kept positive, and with it the parabola. */
static parabola cell_parabola(const solid_angle_table *t, int cell) {
    const double *w = t->weight + 2 * cell;
    double through_middle = 2 * w[1] - 0.5 * (w[0] + w[2]);
    return (parabola){w[0], fmax(through_middle, 0.25 * w[1]), w[2]};
}

static double value(parabola p, double s) {
    return (1 - s) * ((1 - s) * p.first + 2 * s * p.control) + s * s * p.last;
}

/* The integral over [0, s]. */
static double integral(parabola p, double s) {
    double linear = p.control - p.first, square = p.first - 2 * p.control + p.last;
    return s * (p.first + s * (linear + s * square / 3));
}

static double cell_width(const solid_angle_table *t) {
    return (t->end - t->start) / SOLID_ANGLE_CELLS;
}

double solid_angle_table_node(const solid_angle_table *t, int node) {
    return node == SOLID_ANGLE_NODES - 1 ? t->end : t->start + (t->end - t->start) * node / (SOLID_ANGLE_NODES - 1);
}

void solid_angle_table_complete(solid_angle_table *t) {
    double width = cell_width(t);
    t->below[0] = 0;
    for (int cell = 0; cell < SOLID_ANGLE_CELLS; cell++) {
        parabola p = cell_parabola(t, cell);
        t->below[cell + 1] = t->below[cell] + width * (p.first + p.control + p.last) / 3;
    }
}

double solid_angle_table_integral(const solid_angle_table *t) {
    return t->below[SOLID_ANGLE_CELLS];
}

/* Newton's method, kept inside a bracket that every step tightens. */
static double invert(parabola p, double target) {
    double lower = 0, upper = 1, s = target / integral(p, 1);
    for (int step = 0; step < 60; step++) {
        double error = integral(p, s) - target, slope = value(p, s);
        if (error > 0)
            upper = s;
        else
            lower = s;
        double next = s - error / slope;
        if (!(next > lower && next < upper))
            next = 0.5 * (lower + upper);
        if (fabs(next - s) <= 1e-15)
            return next;
        s = next;
    }
    return s;
}

double solid_angle_table_find(const solid_angle_table *t, double target, double *weight) {
    int cell = 0;
    while (cell < SOLID_ANGLE_CELLS - 1 && t->below[cell + 1] <= target)
        cell++;
    parabola p = cell_parabola(t, cell);
    double whole = t->below[cell + 1] - t->below[cell], rest = target - t->below[cell], s;
    if (!(rest > 0))
        s = 0;
    else if (!(rest < whole))
        s = 1;
    else
        s = invert(p, rest / cell_width(t));
    *weight = value(p, s);
    return t->start + (cell + s) * cell_width(t);
}

double solid_angle_table_weight(const solid_angle_table *t, double x) {
    double position = (x - t->start) / cell_width(t);
    int cell = position >= SOLID_ANGLE_CELLS ? SOLID_ANGLE_CELLS - 1 : position > 0 ? (int)position : 0;
    double s = position - cell;
    return value(cell_parabola(t, cell), s < 0 ? 0 : s > 1 ? 1 : s);
}
