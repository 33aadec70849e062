/* The optimiser on NIST's certified nonlinear regression problems (StRD), bounds, and problems without an answer. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "fit/least_squares.h"

enum { OBSERVATIONS_MAX = 40, PARAMETERS_MAX = 7 };

/* y = f(x; b) + noise, with NIST's certified values, standard deviations and sum of squares, 11 digits each. */
typedef struct regression {
    const char *name;
    int parameters, observations;
    double (*model)(double x, const double *b, double *slopes);
    double starts[2][PARAMETERS_MAX];
    double certified[PARAMETERS_MAX], deviations[PARAMETERS_MAX], sum;
    double y[OBSERVATIONS_MAX], x[OBSERVATIONS_MAX];
} regression;

static double saturation(double x, const double *b, double *slopes) {
    double e = exp(-b[1] * x);
    slopes[0] = 1 - e;
    slopes[1] = b[0] * x * e;
    return b[0] * (1 - e);
}

static double cubic_ratio(double x, const double *b, double *slopes) {
    double above = b[0] + x * (b[1] + x * (b[2] + x * b[3])), below = 1 + x * (b[4] + x * (b[5] + x * b[6]));
    for (int k = 0; k < 4; k++)
        slopes[k] = pow(x, k) / below;
    for (int k = 4; k < 7; k++)
        slopes[k] = -above / (below * below) * pow(x, k - 3);
    return above / below;
}

static double quadratic_ratio(double x, const double *b, double *slopes) {
    double above = x * x + x * b[1], below = x * x + x * b[2] + b[3];
    slopes[0] = above / below;
    slopes[1] = b[0] * x / below;
    slopes[2] = -b[0] * above * x / (below * below);
    slopes[3] = -b[0] * above / (below * below);
    return b[0] * above / below;
}

static double growth(double x, const double *b, double *slopes) {
    double e = exp(b[1] - b[2] * x), base = 1 + e, value = pow(base, -1 / b[3]);
    slopes[0] = value;
    slopes[1] = -b[0] * value * e / (base * b[3]);
    slopes[2] = b[0] * value * e * x / (base * b[3]);
    slopes[3] = b[0] * value * log(base) / (b[3] * b[3]);
    return b[0] * value;
}

static double peak(double x, const double *b, double *slopes) {
    double z = (x - b[2]) / b[1], e = exp(-.5 * z * z), value = b[0] / b[1] * e;
    slopes[0] = e / b[1];
    slopes[1] = value * (z * z - 1) / b[1];
    slopes[2] = value * z / b[1];
    return value;
}

static const regression regressions[] = {
    {.name = "Misra1a",
     .parameters = 2,
     .observations = 14,
     .model = saturation,
     .starts = {{500, .0001}, {250, .0005}},
     .certified = {2.3894212918E+02, 5.5015643181E-04},
     .deviations = {2.7070075241E+00, 7.2668688436E-06},
     .sum = 1.2455138894E-01,
     .y = {10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78},
     .x = {77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0}},
    {.name = "BoxBOD",
     .parameters = 2,
     .observations = 6,
     .model = saturation,
     .starts = {{1, 1}, {100, .75}},
     .certified = {2.1380940889E+02, 5.4723748542E-01},
     .deviations = {1.2354515176E+01, 1.0455993237E-01},
     .sum = 1.1680088766E+03,
     .y = {109, 149, 149, 191, 213, 224},
     .x = {1, 2, 3, 5, 7, 10}},
    {.name = "Thurber",
     .parameters = 7,
     .observations = 37,
     .model = cubic_ratio,
     .starts = {{1000, 1000, 400, 40, .7, .3, .03}, {1300, 1500, 500, 75, 1, .4, .05}},
     .certified = {1.2881396800E+03, 1.4910792535E+03, 5.8323836877E+02, 7.5416644291E+01, 9.6629502864E-01,
                   3.9797285797E-01, 4.9727297349E-02},
     .deviations = {4.6647963344E+00, 3.9571156086E+01, 2.8698696102E+01, 5.5675370270E+00, 3.1333340687E-02,
                    1.4984928198E-02, 6.5842344623E-03},
     .sum = 5.6427082397E+03,
     .y = {80.574,   84.248,   87.264,   87.195,   89.076,   89.608,   89.868,   90.101,   92.405,   95.854,
           100.696,  101.060,  401.672,  390.724,  567.534,  635.316,  733.054,  759.087,  894.206,  990.785,
           1090.109, 1080.914, 1122.643, 1178.351, 1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509,
           1425.208, 1421.384, 1442.962, 1464.350, 1468.705, 1447.894, 1457.628},
     .x = {-3.067, -2.981, -2.921, -2.912, -2.840, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322, -1.501,
           -1.460, -1.274, -1.212, -1.100, -1.046, -0.915, -0.714, -0.566, -0.545, -0.400, -0.309, -0.109, -0.103,
           0.010,  0.119,  0.377,  0.790,  0.963,  1.006,  1.115,  1.572,  1.841,  2.047,  2.200}},
    {.name = "MGH09",
     .parameters = 4,
     .observations = 11,
     .model = quadratic_ratio,
     .starts = {{25, 39, 41.5, 39}, {.25, .39, .415, .39}},
     .certified = {1.9280693458E-01, 1.9128232873E-01, 1.2305650693E-01, 1.3606233068E-01},
     .deviations = {1.1435312227E-02, 1.9633220911E-01, 8.0842031232E-02, 9.0025542308E-02},
     .sum = 3.0750560385E-04,
     .y = {.1957, .1947, .1735, .1600, .0844, .0627, .0456, .0342, .0323, .0235, .0246},
     .x = {4, 2, 1, .5, .25, .167, .125, .1, .0833, .0714, .0625}},
    {.name = "Rat43",
     .parameters = 4,
     .observations = 15,
     .model = growth,
     .starts = {{100, 10, 1, 1}, {700, 5, .75, 1.3}},
     .certified = {6.9964151270E+02, 5.2771253025E+00, 7.5962938329E-01, 1.2792483859E+00},
     .deviations = {1.6302297817E+01, 2.0828735829E+00, 1.9566123451E-01, 6.8761936385E-01},
     .sum = 8.7864049080E+03,
     .y = {16.08, 33.83, 65.80, 97.20, 191.55, 326.20, 386.87, 520.53, 590.03, 651.92, 724.93, 699.56, 689.96, 637.56,
           717.41},
     .x = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}},
    {.name = "Eckerle4",
     .parameters = 3,
     .observations = 35,
     .model = peak,
     .starts = {{1, 10, 500}, {1.5, 5, 450}},
     .certified = {1.5543827178E+00, 4.0888321754E+00, 4.5154121844E+02},
     .deviations = {1.5408051163E-02, 4.6803020753E-02, 4.6800518816E-02},
     .sum = 1.4635887487E-03,
     .y = {.0001575, .0001699, .0002350, .0003102, .0004917, .0008710, .0017418, .0046400, .0065895,
           .0097302, .0149002, .0237310, .0401683, .0712559, .1264458, .2073413, .2902366, .3445623,
           .3698049, .3668534, .3106727, .2078154, .1164354, .0616764, .0337200, .0194023, .0117831,
           .0074357, .0022732, .0008800, .0004579, .0002345, .0001586, .0001143, .0000710},
     .x = {400,   405, 410,   415, 420,   425, 430,   435, 436.5, 438, 439.5, 441, 442.5, 444, 445.5, 447, 448.5, 450,
           451.5, 453, 454.5, 456, 457.5, 459, 460.5, 462, 463.5, 465, 470,   475, 480,   485, 490,   495, 500}},
};
enum { REGRESSIONS = sizeof regressions / sizeof *regressions };

static void residuals(void *user, const double *b, double *out) {
    const regression *r = user;
    double slopes[PARAMETERS_MAX];
    for (int i = 0; i < r->observations; i++)
        out[i] = r->model(r->x[i], b, slopes) - r->y[i];
}

static void jacobian(void *user, const double *b, double *out) {
    const regression *r = user;
    double slopes[PARAMETERS_MAX];
    for (int i = 0; i < r->observations; i++) {
        r->model(r->x[i], b, slopes);
        for (int k = 0; k < r->parameters; k++)
            out[k * r->observations + i] = slopes[k];
    }
}

static double relative(double a, double b) {
    return fabs(a - b) / fabs(b);
}

typedef struct answer {
    fit_estimate estimates[PARAMETERS_MAX], rival_estimates[PARAMETERS_MAX];
    fit_minimum minimum, rival;
} answer;

static graze_status minimise(answer *a, const regression *r, const fit_range *ranges, const double *starts,
                             size_t count) {
    const fit_problem problem = {.residual_count = (size_t)r->observations,
                                 .parameter_count = r->parameters,
                                 .ranges = ranges,
                                 .user = (void *)r,
                                 .residuals = residuals,
                                 .jacobian = jacobian};
    memset(a, 0, sizeof *a);
    a->minimum.estimates = a->estimates;
    return fit_minimise(&problem, starts, count, &a->minimum, &a->rival, a->rival_estimates, NULL);
}

/* All 11 certified digits would be 5e-11; rounding in the residuals leaves 8 to 10 of them. */
static void is_certified(const regression *r, const answer *a) {
    if (relative(a->minimum.sum, r->sum) > 1e-10)
        fail_msg("%s: sum %.12g, not %.12g", r->name, a->minimum.sum, r->sum);
    for (int k = 0; k < r->parameters; k++) {
        const fit_estimate *e = &a->estimates[k];
        assert_int_equal(e->state, FIT_DETERMINED);
        if (relative(e->value, r->certified[k]) > 1e-7)
            fail_msg("%s: b%d is %.12g, not %.12g", r->name, k + 1, e->value, r->certified[k]);
        if (relative(e->error, r->deviations[k]) > 1e-7)
            fail_msg("%s: deviation of b%d is %.12g, not %.12g", r->name, k + 1, e->error, r->deviations[k]);
    }
}

/* From each of NIST's starting points, the far one and the near one. */
static void certified_values(void **state) {
    (void)state;
    const fit_range ranges[PARAMETERS_MAX] = {{FIT_RANGE_FREE, 0, 0}};
    for (int i = 0; i < REGRESSIONS; i++)
        for (int start = 0; start < 2; start++) {
            const regression *r = &regressions[i];
            answer a;
            assert_int_equal(minimise(&a, r, ranges, r->starts[start], 1), GRAZE_OK);
            is_certified(r, &a);
            assert_true(a.minimum.converged && a.minimum.condition >= 1);
            assert_int_equal(a.minimum.degrees, r->observations - r->parameters);
            assert_null(a.rival.estimates);
        }
}

/* Bounds that do not bind change neither the minimum nor the errors. */
static void loose_bounds(void **state) {
    (void)state;
    const fit_range ranges[][2] = {{{FIT_RANGE_INTERVAL, 0, 1000}, {FIT_RANGE_INTERVAL, 0, .01}},
                                   {{FIT_RANGE_LOG, 1, 1e4}, {FIT_RANGE_LOG, 1e-6, 1}}};
    for (int i = 0; i < 2; i++) {
        answer a;
        assert_int_equal(minimise(&a, &regressions[0], ranges[i], regressions[0].starts[1], 1), GRAZE_OK);
        is_certified(&regressions[0], &a);
    }
}

/* A bound that binds is kept, said, and its parameter counts as known for the others' errors. */
static void tight_bounds(void **state) {
    (void)state;
    const fit_range ranges[][2] = {{{FIT_RANGE_INTERVAL, 0, 200}, {FIT_RANGE_INTERVAL, 0, .01}},
                                   {{FIT_RANGE_LOG, 300, 900}, {FIT_RANGE_LOG, 1e-6, 1}}};
    for (int i = 0; i < 2; i++) {
        answer a;
        const regression *r = &regressions[0];
        const double start[] = {i ? 500 : 150, 5e-4};
        assert_int_equal(minimise(&a, r, ranges[i], start, 1), GRAZE_OK);
        assert_int_equal(a.estimates[0].state, i ? FIT_AT_LOW : FIT_AT_HIGH);
        assert_true(a.estimates[0].value >= ranges[i][0].low && a.estimates[0].value <= ranges[i][0].high);
        assert_true(relative(a.estimates[0].value, i ? 300 : 200) < 1e-5);
        assert_true(a.estimates[0].error == 0);
        assert_int_equal(a.minimum.degrees, r->observations - 1);
        /* One parameter: its variance is sum/degrees over the squared length of its column. */
        double length = 0, slopes[PARAMETERS_MAX], b[2] = {a.estimates[0].value, a.estimates[1].value};
        for (int k = 0; k < r->observations; k++) {
            r->model(r->x[k], b, slopes);
            length += slopes[1] * slopes[1];
        }
        assert_int_equal(a.estimates[1].state, FIT_DETERMINED);
        assert_true(relative(a.estimates[1].error, sqrt(a.minimum.sum / (double)a.minimum.degrees / length)) < 1e-6);
        assert_true(a.minimum.condition == 1);
    }
}

/* Two parameters at bounds, and one that begins next to a bound it must leave. */
static void many_bounds(void **state) {
    (void)state;
    const regression *r = &regressions[0];
    const fit_range wrong[] = {{FIT_RANGE_INTERVAL, 0, 100}, {FIT_RANGE_INTERVAL, 1e-3, 1}};
    const fit_range wide[] = {{FIT_RANGE_INTERVAL, 0, 300}, {FIT_RANGE_INTERVAL, 0, .1}};
    const double inside[] = {50, .5}, corner[] = {1e-3, 1e-7};
    answer a;
    assert_int_equal(minimise(&a, r, wrong, inside, 1), GRAZE_OK);
    assert_true(a.estimates[0].state == FIT_AT_HIGH && a.estimates[0].value == 100);
    assert_true(a.estimates[1].state == FIT_DETERMINED && a.estimates[1].value > 1e-3);
    assert_true(a.minimum.converged);
    assert_int_equal(minimise(&a, r, wide, corner, 1), GRAZE_OK);
    is_certified(r, &a);
}

/* y = b0 + b1 + b2 x: no data tell b0 from b1. */
static double redundant(double x, const double *b, double *slopes) {
    slopes[0] = slopes[1] = 1;
    slopes[2] = x;
    return b[0] + b[1] + b[2] * x;
}

static void undetermined(void **state) {
    (void)state;
    static const regression r = {.parameters = 3,
                                 .observations = 5,
                                 .model = redundant,
                                 .starts = {{1, 1, 1}},
                                 .y = {1, 3.1, 4.9, 7.2, 8.8},
                                 .x = {0, 1, 2, 3, 4}};
    const fit_range ranges[3] = {{FIT_RANGE_FREE, 0, 0}};
    answer a;
    assert_int_equal(minimise(&a, &r, ranges, r.starts[0], 1), GRAZE_OK);
    assert_int_equal(a.estimates[0].state, FIT_UNDETERMINED);
    assert_int_equal(a.estimates[1].state, FIT_UNDETERMINED);
    assert_true(a.estimates[0].error == 0 && a.estimates[1].error == 0);
    assert_int_equal(a.estimates[2].state, FIT_DETERMINED);
    assert_true(relative(a.estimates[2].value, 1.97) < 1e-10);
    assert_true(a.minimum.condition == 0);
}

/* y = b^2: minima at both roots are equally good. */
static double square(double x, const double *b, double *slopes) {
    (void)x;
    slopes[0] = 2 * b[0];
    return b[0] * b[0];
}

static void rivals(void **state) {
    (void)state;
    static const regression r = {
        .parameters = 1, .observations = 4, .model = square, .y = {3.9, 4.1, 4.05, 3.95}, .x = {0, 0, 0, 0}};
    const fit_range range = {FIT_RANGE_FREE, 0, 0};
    const double both[] = {1, -1}, one[] = {1, 5};
    answer a;
    assert_int_equal(minimise(&a, &r, &range, both, 2), GRAZE_OK);
    assert_non_null(a.rival.estimates);
    assert_true(fabs(a.estimates[0].value + a.rival.estimates[0].value) < 1e-9 && a.rival.start != a.minimum.start);
    assert_int_equal(minimise(&a, &r, &range, one, 2), GRAZE_OK);
    assert_null(a.rival.estimates);
}

static void too_few_data(void **state) {
    (void)state;
    regression r = regressions[1];
    const fit_range ranges[PARAMETERS_MAX] = {{FIT_RANGE_FREE, 0, 0}};
    answer a;
    r.observations = 2;
    assert_int_equal(minimise(&a, &r, ranges, r.starts[1], 1), GRAZE_INPUT_ERROR);
    r.observations = 3;
    assert_int_equal(minimise(&a, &r, ranges, r.starts[1], 1), GRAZE_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(certified_values), cmocka_unit_test(loose_bounds), cmocka_unit_test(tight_bounds),
        cmocka_unit_test(many_bounds),      cmocka_unit_test(undetermined), cmocka_unit_test(rivals),
        cmocka_unit_test(too_few_data),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
