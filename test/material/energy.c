/* A white furnace: under radiance 1 from everywhere, a surface sends out its albedo, and that is at most 1. */
#include "support.h"

/* All of it in one channel, so that a material is one number. */
typedef struct furnace_case {
    graze_material_kind kind;
    double color, specularity, u, v;
} furnace_case;

static const furnace_case cases[] = {
    {GRAZE_PLASTIC, 1, 0.05, 0, 0},     {GRAZE_PLASTIC, 1, 0.5, 0, 0},      {GRAZE_PLASTIC, 0.3, 1, 0, 0},
    {GRAZE_METAL, 1, 0.9, 0, 0},        {GRAZE_METAL, 0.5, 0.5, 0, 0},      {GRAZE_PLASTIC, 1, 0.017, 0, 0},
    {GRAZE_PLASTIC, 1, 0, 0.1, 0.1},    {GRAZE_PLASTIC, 1, 0.05, 0.2, 0.2}, {GRAZE_METAL, 1, 1, 0.2, 0.2},
    {GRAZE_METAL, 0.8, 0.5, 0.15, 0.4}, {GRAZE_PLASTIC, 1, 0.5, 0.9, 0.2},  {GRAZE_METAL, 1, 1, 0.3, 0.15},
};
#define CASE_COUNT (sizeof cases / sizeof *cases)

/* Cosines of 0, 35, 60, 75, 85 and 89 degrees. */
static const double cosines[] = {
    1, 0.8191520442889918, 0.5, 0.25881904510252074, 0.08715574274765817, 0.01745240643728351};
#define COSINE_COUNT (sizeof cosines / sizeof *cosines)

static graze_surface prepare_case(const furnace_case *c, double cosine, generator *g) {
    graze_material m = material_make(c->kind, rgb_gray(c->color), c->specularity, c->u, c->v);
    m.has_orientation = c->u != c->v;
    m.orientation = random_direction(g);
    return prepare(&m, g, cosine);
}

/* The integrals of value x cosine over the hemisphere, by midpoints in substituted variables. lz = x^3 (10 - 15 x + 6
 * x^2) is flat at both ends and crowds the points towards the horizon, where the lobe has a boundary layer as wide as
 * the view's cosine; angle = y - sin y, periodic and measured from the mirror direction, crowds them to where that
 * layer is narrow in azimuth as well. */
static void integrate(const graze_surface *s, double *diffuse, double *glossy) {
    const int steps = 300, turns = 300;
    const double pi = (double)SUPPORT_PI, mirror = atan2(-s->local_view.y, -s->local_view.x);
    frame f = {s->x, s->y, s->n};
    *diffuse = *glossy = 0;
    for (int i = 0; i < steps; i++) {
        double x = (i + 0.5) / steps, z = x * x * x * (10 - 15 * x + 6 * x * x),
               z_slope = 30 * x * x * (1 - x) * (1 - x);
        double r = sqrt(1 - z * z);
        for (int k = 0; k < turns; k++) {
            double y = pi * (2 * (k + 0.5) / turns - 1), angle = mirror + y - sin(y), angle_slope = 1 - cos(y);
            rgb d, g;
            graze_surface_value(s, frame_to_world(&f, vec3_make(r * cos(angle), r * sin(angle), z)), &d, &g);
            double measure = z * z_slope / steps * angle_slope * (2 * pi / turns);
            *diffuse += d.r * measure;
            *glossy += g.r * measure;
        }
    }
}

/* The mean weight of a lobe's samples, on a lattice that fills the cube of random numbers evenly. */
static double mean_weight(const graze_surface *s, graze_lobe lobe) {
    const int count = 200000;
    double sum = 0;
    for (int i = 0; i < count; i++) {
        double a = (i + 0.5) / count, b = i * 0.7548776662466927, c = i * 0.5698402909980532;
        sum += graze_surface_sample_lobe(s, lobe, a, b - floor(b), c - floor(c)).weight.r;
    }
    return sum / count;
}

static void no_surface_sends_out_more_than_it_receives(void **state) {
    (void)state;
    generator g = {31};
    for (size_t i = 0; i < CASE_COUNT; i++)
        for (size_t k = 0; k < COSINE_COUNT; k++) {
            graze_surface s = prepare_case(&cases[i], cosines[k], &g);
            double diffuse, glossy;
            integrate(&s, &diffuse, &glossy);
            double mirror = graze_surface_sample_lobe(&s, GRAZE_LOBE_MIRROR, 0, 0, 0).weight.r;
            double sampled_diffuse = mean_weight(&s, GRAZE_LOBE_DIFFUSE);
            double sampled_glossy = mean_weight(&s, GRAZE_LOBE_GLOSSY);
            assert_true(diffuse + glossy + mirror < 1 + 1e-9);
            assert_true(sampled_diffuse + sampled_glossy + mirror < 1 + 1e-12);
            if (fabs(diffuse - sampled_diffuse) > 1e-6 || fabs(glossy - sampled_glossy) > 1e-5)
                fail_msg("case %zu, cosine %g: diffuse %.7f or %.7f, glossy %.7f or %.7f", i, cosines[k], diffuse,
                         sampled_diffuse, glossy, sampled_glossy);
        }
}

/* Albedos of the paper's model for specular reflectance 1, from its published formula by independent quadrature. */
static void glossy_albedos_are_the_known_ones(void **state) {
    (void)state;
    const double albedo[] = {0.960000, 0.949092, 0.897580, 0.821169, 0.805507, 0.898875};
    const furnace_case metal = {GRAZE_METAL, 1, 1, 0.2, 0.2};
    generator g = {32};
    for (size_t k = 0; k < COSINE_COUNT; k++) {
        graze_surface s = prepare_case(&metal, cosines[k], &g);
        double diffuse, glossy;
        integrate(&s, &diffuse, &glossy);
        assert_true(fabs(glossy - albedo[k]) < 1e-6);
        assert_true(fabs(mean_weight(&s, GRAZE_LOBE_GLOSSY) - albedo[k]) < 1e-5);
    }
}

/* At grazing view a mirror reflects all, and its diffuse part goes dark: the estimate F tends to 0.991. */
static void mirrors_take_over_from_the_diffuse_part_at_grazing_angles(void **state) {
    (void)state;
    const furnace_case plastic = {GRAZE_PLASTIC, 1, 0.05, 0, 0};
    generator g = {33};
    graze_surface s = prepare_case(&plastic, 1e-4, &g);
    assert_true(s.specular.r > 0.99 && s.diffuse.r < 0.01);
    assert_close_relative(s.specular.r + s.diffuse.r, 1, 1e-14);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_surface_sends_out_more_than_it_receives),
        cmocka_unit_test(glossy_albedos_are_the_known_ones),
        cmocka_unit_test(mirrors_take_over_from_the_diffuse_part_at_grazing_angles),
    };
    return cmocka_run_group_tests_name("material/energy", tests, NULL, NULL);
}
