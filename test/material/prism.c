/* Where prisms send light on: by hand, and where their functions fail. */
#include "material/prism.h"

#include "material/support.h"
#include "material/written_modifiers.h"

/* A scene of which the last primitive is a prism. */
typedef struct setting {
    written_modifiers of;
    const material_prism *prism;
} setting;

static setting compiled(const char *text) {
    setting s = {.of = written_modifiers_read(text)};
    graze_status status = s.of.status;
    if (!status)
        status = material_prism_compile(&s.prism, material_modifiers_library(s.of.modifiers), s.of.last);
    if (status)
        fail_msg("%s: %s", text, messages);
    return s;
}

static void setting_end(setting *s) {
    written_modifiers_destroy(&s->of);
}

static const material_ray ray = {
    .point = {3, 4, 5}, .direction = {0, 0.6, -0.8}, .normal = {0, 0, 1}, .distance = 1, .last_distance = 1};

static void assert_way(material_way way, double coefficient, double x, double y, double z) {
    if (!(fabs(way.coefficient - coefficient) <= 1e-12 * coefficient))
        fail_msg("%.17g is not %.17g", way.coefficient, coefficient);
    if (coefficient > 0 && !(vec3_max_abs(vec3_subtract(way.direction, vec3_make(x, y, z))) < 1e-12))
        fail_msg("%g %g %g is not %g %g %g", way.direction.x, way.direction.y, way.direction.z, x, y, z);
}

/* Both ways, of any length; the second is none of a prism1. What turns a prism turns what its functions know and say.
 */
static void ways_are_functions(void **state) {
    (void)state;
    material_way ways[2];
    setting s = compiled("void prism2 m 9 Px/10 Dx Dy Dz A1 3 0 -4*Nz . 0 1 2.5");
    material_prism_ways(s.prism, &ray, ways);
    assert_way(ways[0], 0.3, 0, 0.6, -0.8);
    assert_way(ways[1], 2.5, 0.6, 0, -0.8);
    setting_end(&s);
    s = compiled("void prism1 m 7 -Dy+.5 0 0 2 . -rx 90 0 0");
    material_prism_ways(s.prism, &ray, ways);
    assert_way(ways[0], 0.5 + 0.8, 0, -1, 0);
    assert_way(ways[1], 0, 0, 0, 0);
    setting_end(&s);
}

/* A way of no coefficient above 0, or of no direction, is none; the other one stays. No coefficient is boundless. */
static void ways_that_lead_nowhere(void **state) {
    (void)state;
    static const struct {
        const char *first;
        double coefficient;
    } cases[] = {
        {"0 Dx Dy Dz", 0}, {"-1 Dx Dy Dz", 0}, {"1 0 0 0", 0}, {"1e300 0 1e-9 0", 1e10}, {"9e9 0 1 0", 9e9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        material_way ways[2];
        snprintf(text, sizeof text, "void prism2 m 9 %s .5 0 0 -1 . 0 0", cases[i].first);
        setting s = compiled(text);
        material_prism_ways(s.prism, &ray, ways);
        assert_way(ways[0], cases[i].coefficient, 0, 1, 0);
        assert_way(ways[1], 0.5, 0, 0, -1);
        setting_end(&s);
    }
    /* Turned, it is longer than any number. */
    material_way ways[2];
    setting s = compiled("void prism1 m 7 1 1.7e308 1.7e308 0 . -rz 45 0 0");
    material_prism_ways(s.prism, &ray, ways);
    assert_way(ways[0], 0, 0, 0, 0);
    setting_end(&s);
    s = compiled("void prism2 m 9 .5 0 0 -1 .5 Dx Dy sqrt(-Px) . 0 0");
    material_prism_ways(s.prism, &ray, ways);
    assert_way(ways[0], 0, 0, 0, 0);
    assert_way(ways[1], 0, 0, 0, 0);
    assert_non_null(strstr(messages, ":1:1: prism2 m: compute error"));
    setting_end(&s);
}

/* No ray is aimed at a light, and what modifies a prism does nothing: both are told. */
static void what_is_without_effect_is_told(void **state) {
    (void)state;
    material_way ways[2];
    setting s = compiled("void brightfunc b 2 .5 . 0 0\nb prism1 m 5 .5+DxA+DyA+DzA 0 0 -1 . 0 0");
    assert_non_null(strstr(messages, ":2:1: prism1 m: what modifies it has no effect, as in Radiance"));
    assert_non_null(strstr(messages, ":2:1: prism1 m: DxA, DyA and DzA are 0"));
    material_prism_ways(s.prism, &ray, ways);
    assert_way(ways[0], 0.5, 0, 0, -1);
    setting_end(&s);
}

/* Told where a ray meets it, and once. */
static void amplification_is_told(void **state) {
    (void)state;
    static const struct {
        const char *text, *told;
    } cases[] = {
        {"void prism1 m 5 Px/3 Dx Dy Dz . 0 0", ""},
        {"void prism1 m 5 .4*Px Dx Dy Dz . 0 0", "prism1 m: unphysical: its coefficient comes above 1"},
        {"void prism2 m 9 .7 Dx Dy Dz .1*Px Dx Dy Dz . 0 0", ""},
        {"void prism2 m 9 .8 Dx Dy Dz .1*Px Dx Dy Dz . 0 0", "prism2 m: unphysical: its coefficients add up"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        material_way ways[2];
        setting s = compiled(cases[i].text);
        assert_string_equal(messages, "");
        material_prism_ways(s.prism, &ray, ways);
        if (*cases[i].told ? !strstr(messages, cases[i].told) : *messages)
            fail_msg("%s: \"%s\"", cases[i].text, messages);
        *messages = '\0';
        material_prism_ways(s.prism, &ray, ways);
        assert_string_equal(messages, "");
        setting_end(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_are_functions),
        cmocka_unit_test(ways_that_lead_nowhere),
        cmocka_unit_test(amplification_is_told),
        cmocka_unit_test(what_is_without_effect_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
