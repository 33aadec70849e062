/* A density on an interval, tabulated: what rings and cones draw one coordinate with. The integrand is known anywhere,
 * its integral is not; so it is replaced by a piecewise parabola, of which integral and inverse are exact. A draw's
 * density is thus known exactly, and near the integrand's own. */
#ifndef GEOMETRY_SOLID_ANGLE_TABLE_H
#define GEOMETRY_SOLID_ANGLE_TABLE_H

#define SOLID_ANGLE_CELLS 12
#define SOLID_ANGLE_NODES (2 * SOLID_ANGLE_CELLS + 1)

typedef struct solid_angle_table {
    double start, end;
    double weight[SOLID_ANGLE_NODES];    /* the integrand, >= 0, at equal steps: to be set by the caller */
    double below[SOLID_ANGLE_CELLS + 1]; /* integral over the cells below */
} solid_angle_table;

/* The place of a node. */
double solid_angle_table_node(const solid_angle_table *, int node);
/* To be called once the weights are set. Positive weights give a density that is positive between them. */
void solid_angle_table_complete(solid_angle_table *);
/* The integral of the parabolas. */
double solid_angle_table_integral(const solid_angle_table *);
/* Where the integral has reached `target`, and the parabola there. */
double solid_angle_table_find(const solid_angle_table *, double target, double *weight);
double solid_angle_table_weight(const solid_angle_table *, double x);

#endif
