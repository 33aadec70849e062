/* Ward's sampling and the paired sampling of directions. */
#include <float.h>
#include <math.h>

#include "graze/brdf.h"

/* A slope (px, py) drawn from the Gaussian, and the candidates of it and of its negative: those have q and -q. */
typedef struct drawn_slope {
    double x, y;
    double gaussian; /* E there */
    double tan2;     /* tau^2 */
    double u;        /* 1 - tau^2 */
    double q;        /* vx px + vy py */
} drawn_slope;

/* Numbers outside [0,1) become the nearest inside. */
static double into_unit_interval(double s) {
    return fmin(fmax(s, 0), 1 - 0x1p-53);
}

static drawn_slope draw_slope(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    const double two_pi = 0x1.921fb54442d18p+2;
    s = into_unit_interval(s);
    double azimuth = two_pi * into_unit_interval(t);
    double r = sqrt(-log1p(-s));
    double x = brdf->alpha_x * r * cos(azimuth), y = brdf->alpha_y * r * sin(azimuth);
    double tan2 = x * x + y * y;
    return (drawn_slope){x, y, 1 - s, tan2, 1 - tan2, v.x * x + v.y * y};
}

static drawn_slope negative_slope(drawn_slope p) {
    p.x = -p.x;
    p.y = -p.y;
    p.q = -p.q;
    return p;
}

/* v reflected about the slope (26); the null vector, which is rejected, where v is no direction at all. */
static graze_vec3 reflected(const drawn_slope *p, graze_vec3 v) {
    double square = 1 + p->tan2, scale = 2 * (p->q + v.z) / square;
    graze_vec3 l = {scale * p->x - v.x, scale * p->y - v.y, (v.z * p->u + 2 * p->q) / square};
    return isfinite(l.x + l.y + l.z) ? l : (graze_vec3){0, 0, 0};
}

/* w = 2 lz/hz (15); 0 where l is not above the surface. There vz + q is at least vz/2. */
static double weight_of_new_model(const drawn_slope *p, double vz) {
    double above = vz * p->u + 2 * p->q;
    return above > 0 ? above / (vz + p->q) : 0;
}

/* W, which no rounding brings above 1, since u <= 1. With rho = |q|/vz: (u - 2 rho^2)/(1 - rho^2) where 2 rho < u, else
 * (u + 2 rho)/(2 (1 + rho)). */
static double mean_weight_of_pair(const drawn_slope *p, double vz) {
    double q = fabs(p->q);
    if (2 * q < vz * p->u) {
        double rho2 = (q / vz) * (q / vz);
        return (p->u - 2 * rho2) / (1 - rho2);
    }
    return fmax((vz * p->u + 2 * q) / (2 * (vz + q)), 0);
}

/* f_model/f_new = hz^2/(4 C (1 + tau^2)), with C the model's function of the cosines. */
static double ratio_to_new_model(graze_brdf_model model, const drawn_slope *p, double lz, double vz) {
    double larger = fmax(lz, vz), smaller = fmin(lz, vz);
    double mean = (lz + vz) / (2 * larger); /* this and ratios of cosines keep every power in range */
    double ratio = mean * mean / (1 + p->tan2);
    switch (model) {
    case GRAZE_BRDF_GMD:
        return 1;
    case GRAZE_BRDF_WARD:
        return ratio * sqrt(larger) * sqrt(larger) * sqrt(larger) / sqrt(smaller);
    case GRAZE_BRDF_WARD_DUER:
        return ratio * (larger / smaller);
    default:
        return ratio * larger;
    }
}

/* The sample in hand: density `share` x Ward's pdf, where E = 1 - s makes the pdf E (1 + tau^2)^2/(4 pi ax ay (vz +
 * q)). `weight` is that of the new model. */
static graze_brdf_sample finish_sample(const graze_brdf *brdf, const drawn_slope *p, graze_vec3 v, double share,
                                       double weight) {
    const double four_pi = 0x1.921fb54442d18p+3;
    graze_brdf_sample sample = {reflected(p, v), 0, 0};
    if (!(v.z > 0 && sample.l.z > 0 && weight > 0 && share > 0))
        return sample;
    double square = 1 + p->tan2;
    double pdf = p->gaussian * square * square / (four_pi * brdf->alpha_x * brdf->alpha_y) / (v.z + p->q);
    sample.density = fmin(pdf * share, DBL_MAX);
    sample.weight = fmin(weight * ratio_to_new_model(brdf->model, p, sample.l.z, v.z), DBL_MAX);
    return sample;
}

graze_brdf_sample graze_brdf_sample_ward(const graze_brdf *brdf, graze_vec3 v, double s, double t) {
    drawn_slope p = draw_slope(brdf, v, s, t);
    return finish_sample(brdf, &p, v, 1, weight_of_new_model(&p, v.z));
}

graze_brdf_sample graze_brdf_sample_pair(const graze_brdf *brdf, graze_vec3 v, double s, double t, double u) {
    drawn_slope p = draw_slope(brdf, v, s, t), negative = negative_slope(p);
    double weight = weight_of_new_model(&p, v.z), weight_of_negative = weight_of_new_model(&negative, v.z);
    if (!(into_unit_interval(u) * (weight + weight_of_negative) < weight)) {
        p = negative;
        weight = weight_of_negative;
    }
    double mean = mean_weight_of_pair(&p, v.z);
    return finish_sample(brdf, &p, v, weight / mean, mean);
}
