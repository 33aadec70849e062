/* Gauss-Kronrod quadrature, halving intervals where it is not good enough. */
#include "brdf/quadrature.h"

#include <math.h>

enum { HALF_RULE = 15, DEEPEST = 40 };

/* Kronrod's 31 points on [-1,1], Gauss's 15 among them. Of each pair and the middle: the place and both weights. */
static const double nodes[HALF_RULE] = {
    0.9980022986933970602, 0.9879925180204854284, 0.9677390756791391342, 0.9372733924007059043, 0.8972645323440819008,
    0.8482065834104272162, 0.7904185014424659329, 0.7244177313601700474, 0.6509967412974169705, 0.5709721726085388475,
    0.4850818636402396806, 0.3941513470775633698, 0.2991800071531688121, 0.2011940939974345223, 0.1011420669187174990};
static const double kronrod_weights[] = {
    0.0053774798729233489, 0.0150079473293161225, 0.0254608473267153201, 0.0353463607913758462,
    0.0445897513247648766, 0.0534815246909280872, 0.0620095678006706402, 0.0698541213187282587,
    0.0768496807577203788, 0.0830805028231330210, 0.0885644430562117706, 0.0931265981708253212,
    0.0966427269836236785, 0.0991735987217919593, 0.1007698455238755950, 0.1013300070147915490};
static const double gauss_weights[] = {0, 0.0307532419961172683, 0, 0.0703660474881081247, 0, 0.1071592204671719350,
                                       0, 0.1395706779261543144, 0, 0.1662692058169939335, 0, 0.1861610000155622110,
                                       0, 0.1984314853271115764, 0, 0.2025782419255612728};

/* How far the two rules may differ, relative to the whole integral. Kronrod's, of twice the order, is by far better,
 * but where a layer next to an end is not resolved at all, and then not much. */
static const double tolerance = 3e-11;

/* An interval, x = low + length u; with roots at ends, x = low + length u^2 (3 - 2u): that is flat at both ends, so
 * that roots become smooth. */
typedef struct piece {
    brdf_integrand *function;
    const void *context;
    double low, length;
    brdf_ends ends;
} piece;

typedef struct estimate {
    double integral, difference;
} estimate;

static double transformed(const piece *p, double u) {
    if (p->ends == BRDF_ENDS_SMOOTH)
        return p->function(p->context, p->low + p->length * u);
    return 6 * u * (1 - u) * p->function(p->context, p->low + p->length * (u * u * (3 - 2 * u)));
}

static estimate apply_rule(const piece *p, double from, double to) {
    double middle = (from + to) / 2, half = (to - from) / 2, value = transformed(p, middle);
    double kronrod = kronrod_weights[HALF_RULE] * value, gauss = gauss_weights[HALF_RULE] * value;
    for (int i = 0; i < HALF_RULE; ++i) {
        value = transformed(p, middle - half * nodes[i]) + transformed(p, middle + half * nodes[i]);
        kronrod += kronrod_weights[i] * value;
        gauss += gauss_weights[i] * value;
    }
    double scale = half * p->length;
    return (estimate){scale * kronrod, scale * fabs(kronrod - gauss)};
}

static double refine(const piece *p, double from, double to, estimate whole, double largest, int depth) {
    if (!(whole.difference > largest) || depth == DEEPEST)
        return whole.integral;
    double middle = (from + to) / 2;
    estimate left = apply_rule(p, from, middle), right = apply_rule(p, middle, to);
    return refine(p, from, middle, left, largest, depth + 1) + refine(p, middle, to, right, largest, depth + 1);
}

void brdf_points_add(brdf_points *points, double x) {
    int i = points->count++;
    for (; i > 0 && points->at[i - 1] > x; --i)
        points->at[i] = points->at[i - 1];
    points->at[i] = x;
}

double brdf_integrate(brdf_integrand *function, const void *context, double low, double high, const brdf_points *points,
                      brdf_ends ends) {
    piece pieces[BRDF_MOST_POINTS + 1];
    estimate first[BRDF_MOST_POINTS + 1];
    int count = 0;
    double whole = 0, sum = 0;
    for (int i = 0; i <= points->count; ++i) {
        double end = i < points->count ? fmin(points->at[i], high) : high;
        if (!(end > low))
            continue;
        pieces[count] = (piece){function, context, low, end - low, ends};
        first[count] = apply_rule(&pieces[count], 0, 1);
        whole += first[count++].integral;
        low = end;
    }
    for (int i = 0; i < count; ++i)
        sum += refine(&pieces[i], 0, 1, first[i], tolerance * whole, 0);
    return sum;
}
