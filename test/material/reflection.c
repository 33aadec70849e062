/* Materials of functions: what each argument means, values by hand, what is refused. */
#include "material/reflection.h"

#include "material/support.h"
#include "material/wgmd.h"
#include "material/written_modifiers.h"

/* A scene of one material, and what it is compiled to. */
typedef struct setting {
    written_modifiers of;
    const material_reflection *reflection;
    const material_wgmd *wgmd;
    graze_status status;
} setting;

static setting setting_of(const char *text) {
    setting s = {.of = written_modifiers_read(text)};
    const written_modifiers *of = &s.of;
    s.status = of->status;
    if (s.status)
        return s;
    if (of->last->type == RAD_WGMDFUNC)
        s.status = material_wgmd_compile(&s.wgmd, of->modifiers, of->last);
    else
        s.status = material_reflection_compile(&s.reflection, material_modifiers_library(of->modifiers), of->last);
    return s;
}

static void setting_end(setting *s) {
    written_modifiers_destroy(&s->of);
}

/* Of a reflectance function, or of WGMDfunc. */
static setting compiled(const char *text) {
    setting s = setting_of(text);
    if (!s.status && s.reflection)
        return s;
    fail_msg("%s: %s", text, messages);
    abort();
}

static setting compiled_wgmd(const char *text) {
    setting s = setting_of(text);
    if (!s.status && s.wgmd)
        return s;
    fail_msg("%s: %s", text, messages);
    abort();
}

static void assert_side(material_reflection_side side, rgb diffuse, rgb ambient, rgb function) {
    const rgb found[] = {side.diffuse, side.ambient, side.function}, expected[] = {diffuse, ambient, function};
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++)
            assert_true(fabs(channel(found[i], c) - channel(expected[i], c)) < 1e-15);
}

static const rgb white = {1, 1, 1}, black = {0, 0, 0}, half = {0.5, 0.5, 0.5};

/* Of colour c, specularity s, transmission t and transmitted specularity u, t (1 - s) goes through, the part u of it by
 * the function, which on the viewer's side has the part s and no colour. All light but that of lights is divided
 * between both sides alone. */
static void what_transfunc_divides(void **state) {
    (void)state;
    const rgb c = {0.8, 0.4, 0.2};
    const double t = 0.75 * 0.6, u = t * 0.5;
    setting s = compiled("void transfunc m 2 max . 0 6 .8 .4 .2 .25 .6 .5");
    material_reflection_side above, below;
    for (int behind = 0; behind < 2; behind++) {
        material_reflection_sides(s.reflection, white, behind, &above, &below);
        assert_side(above, rgb_scale(1 - t - 0.25, c), rgb_scale(1 - t, c), rgb_gray(0.25));
        assert_side(below, rgb_scale(t - u, c), rgb_scale(t, c), rgb_scale(u, c));
    }
    material_reflection_sides(s.reflection, half, false, &above, &below);
    assert_side(above, rgb_scale(0.5 * (1 - t - 0.25), c), rgb_scale(0.5 * (1 - t), c), rgb_gray(0.25));
    assert_side(below, rgb_scale(0.5 * (t - u), c), rgb_scale(0.5 * t, c), rgb_scale(0.5 * u, c));
    assert_false(s.reflection->mirrors || s.reflection->passes || s.reflection->keeps_normal);
    setting_end(&s);
    s = compiled("void metfunc m 2 max . 0 4 .8 .4 .2 .25");
    material_reflection_sides(s.reflection, half, false, &above, &below);
    assert_side(above, rgb_scale(0.375, c), rgb_scale(0.5, c), rgb_scale(0.125, c));
    assert_side(below, black, black, black);
    setting_end(&s);
}

/* The nine colours of BRTDfunc, which patterns are on; on the functions they are not. */
static void what_brtdfunc_divides(void **state) {
    (void)state;
    setting s = compiled("void BRTDfunc m 10 0 0 0 0 0 0 max 0 max . 0 9 .1 .2 .3 .4 .3 .2 .01 .02 .03");
    material_reflection_side above, below;
    const rgb front = {0.1, 0.2, 0.3}, back = {0.4, 0.3, 0.2}, beyond = {0.01, 0.02, 0.03};
    material_reflection_sides(s.reflection, white, false, &above, &below);
    assert_side(above, front, front, white);
    assert_side(below, beyond, beyond, white);
    material_reflection_sides(s.reflection, half, true, &above, &below);
    assert_side(above, rgb_scale(0.5, back), rgb_scale(0.5, back), white);
    assert_side(below, rgb_scale(0.5, beyond), rgb_scale(0.5, beyond), white);
    assert_false(s.reflection->mirrors || s.reflection->passes);
    assert_true(s.reflection->keeps_normal && s.reflection->by_function);
    setting_end(&s);
    s = compiled("void BRTDfunc m 10 0 0 .1 0 Px 0 0 0 0 . 0 9 .1 .2 .3 .4 .3 .2 .01 .02 .03");
    material_reflection_sides(s.reflection, white, false, &above, &below);
    assert_side(above, front, front, black);
    assert_side(below, beyond, beyond, black);
    assert_true(s.reflection->mirrors && s.reflection->passes && !s.reflection->by_function);
    setting_end(&s);
}

static material_reflection_point point_from(vec3 direction, vec3 own_normal) {
    material_reflection_point at = {.color = {0.5, 0.25, 1}};
    at.ray = (material_ray){.point = {3, 4, 5}, .direction = direction, .normal = own_normal, .distance = 1};
    at.normal = vec3_make(0, 0, direction.z < 0 ? 1 : -1);
    return at;
}

static void assert_color(rgb a, double r, double g, double b) {
    if (!(fabs(a.r - r) < 1e-12 && fabs(a.g - g) < 1e-12 && fabs(a.b - b) < 1e-12))
        fail_msg("%.17g %.17g %.17g is not %g %g %g", a.r, a.g, a.b, r, g, b);
}

/* What functions see: the direction to the light, on either side; the surface's own normal, with RdotP and NzP on the
 * viewer's side; the pattern. What is below 0, or no number, is 0. */
static void what_functions_see(void **state) {
    (void)state;
    setting s = compiled("void BRTDfunc m 10 RdotP Nz NzP Rdot+1 CgP Px max min 0 . 0 9 0 0 0 0 0 0 0 0 0");
    const vec3 up = {0, 0, 1}, light = {0.6, 0, 0.8}, low = {0.6, 0, -0.8};
    material_reflection_point front = point_from(vec3_make(0, 0.6, -0.8), up);
    material_reflection_point back = point_from(vec3_make(0, 0.6, 0.8), up);
    assert_color(material_reflection_mirrored(s.reflection, &front), 0.8, 1, 1);
    assert_color(material_reflection_through(s.reflection, &front), 1.8, 0.25, 3);
    assert_color(material_reflection_mirrored(s.reflection, &back), 0.8, 1, 0);
    assert_color(material_reflection_through(s.reflection, &back), 0.2, 0.25, 3);
    assert_color(material_reflection_value(s.reflection, &front, light), 0.8, 0, 0);
    assert_color(material_reflection_value(s.reflection, &front, low), 0.6, 0, 0);
    setting_end(&s);
    s = compiled("void BRTDfunc m 10 sqrt(-Px) 1 1 -Px 1 1 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0");
    assert_color(material_reflection_mirrored(s.reflection, &front), 0, 0, 0);
    assert_non_null(strstr(messages, "BRTDfunc m: compute error"));
    assert_color(material_reflection_through(s.reflection, &front), 0, 1, 1);
    setting_end(&s);
}

/* A value of data, at the place that a function of the direction to the light gives, is the first argument of the
 * function, before that direction and a solid angle of 0. A place that cannot be computed reflects nothing, nor does a
 * value. */
static void what_data_tell(void **state) {
    (void)state;
    static const char *const data = "1\n0 1 2\n.25 .75\n", *const functions =
                                                               "f(v,x,y,z,w)=10*v+x+2*y+4*z+w;g(x,y,z,w)=sqrt(x)+w;"
                                                               "h(v,x,y,z,w)=sqrt(v-.4);k(v,x,y,z,w)=-v;";
    static const struct {
        const char *function;
        double x, y, z, value;
    } cases[] = {
        {"f", 0.36, 0.48, 0.8, 5.5 + 0.36 + 0.96 + 3.2}, {"f", -0.36, 0.48, 0.8, 0}, {"h", 0, 0.6, 0.8, 0},
        {"h", 0.36, 0.48, 0.8, 0.38729833462074169},     {"k", 0.36, 0.48, 0.8, 0},
    };
    const material_reflection_point at = point_from(vec3_make(0, 0.6, -0.8), vec3_make(0, 0, 1));
    written_file values = written_file_make(data, strlen(data)), file = written_file_make(functions, strlen(functions));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text, "void metdata m 4 %s %s %s g 0 4 .8 .4 .2 .25", cases[i].function, values.name,
                 file.name);
        setting s = compiled(text);
        assert_string_equal(messages, "");
        rgb found = material_reflection_value(s.reflection, &at, vec3_make(cases[i].x, cases[i].y, cases[i].z));
        assert_color(found, cases[i].value, cases[i].value, cases[i].value);
        setting_end(&s);
    }
    unlink(values.name);
    unlink(file.name);
}

static void assert_refused(const char *text, const char *message) {
    setting s = setting_of(text);
    assert_int_not_equal(s.status, GRAZE_OK);
    if (!strstr(messages, message))
        fail_msg("%s: %s", text, messages);
    setting_end(&s);
}

static void arguments_are_checked(void **state) {
    (void)state;
    assert_refused("void transfunc m 2 max . 0 5 .8 .4 .2 .25 .6", ":1:1: transfunc m: ");
    assert_refused("void transfunc m 2 max . 0 6 .8 .4 .2 .25 -.6 .5",
                   ":1:1: transfunc m: real argument 5 is negative");
    assert_refused("void transfunc m 2 max . 0 6 .8 .4 .2 .25 1.6 .5", "the transmission and the transmitted");
    assert_refused("void transfunc m 2 max . 0 6 .8 .4 .2 .25 .6 1.5", "the transmission and the transmitted");
    assert_refused("void transfunc m 2 max . 0 6 .8 .4 .2 1.25 .6 .5", "the specularity must be in 0 .. 1");
    assert_refused("void transfunc m 2 nothing . 0 6 .8 .4 .2 .25 .6 .5", "there is no function nothing");
    assert_refused("void transdata m 4 max none.dat . Px 0 6 .8 .4 .2 .25 .6 .5", "transdata m: ");
    assert_refused("void BRTDfunc m 9 0 0 0 0 0 0 0 0 0 0 9 0 0 0 0 0 0 0 0 0", "BRTDfunc m: ");
    assert_refused("void BRTDfunc m 10 0 0 0 0 0 0 0 0 0 . 0 8 0 0 0 0 0 0 0 0", "BRTDfunc m: ");
    assert_refused("void BRTDfunc m 10 0 0 0 0 0 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 -1", "real argument 9 is negative");
    assert_refused("void BRTDfunc m 10 0 0 0 0 0 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 2e10", "real argument 9 is above 1e10");
    assert_refused("void BRTDfunc m 10 0 0 0 0 0 0 0 0 0. . 0 9 0 0 0 0 0 0 0 0 0", "BRTDfunc m: ");
    assert_refused("void BRTDfunc m 10 0 0 0 q 0 0 0 0 0 . 0 9 0 0 0 0 0 0 0 0 0", "BRTDfunc m: ");
    assert_refused(
        "void plastic p 0 0 5 .5 .5 .5 0 0 void WGMDfunc m 13 p .1 0 0 void 0 0 0 void 1 0 0 . 0 9 0 0 0 0 0 0 "
        "0 0 0",
        "WGMDfunc m: 'p' is a material, not a pattern");
    assert_refused("void WGMDfunc m 13 void 0 0 0 void 0 0 0 void 1 0 0 . 0 9 0 0 0 0 0 0 0 -1 0",
                   "real argument 8 is negative");
    assert_refused("void WGMDfunc m 13 void 0 0 0 void 0 0 0 void 1 0 0 . 0 9 -1 0 0 0 0 0 0 0 0",
                   "real argument 1 is negative");
    assert_refused("void WGMDfunc m 13 void 0 0 0 void 0 0 0 void 1 0 0 . 0 9 0 0 0 0 0 0 0 0 -1",
                   "real argument 9 is negative");
    assert_refused("void WGMDfunc m 13 void 0 0 0 lost .1 0 0 void 1 0 0 . 0 9 0 0 0 0 0 0 0 0 0",
                   "there is no modifier 'lost' before it");
    assert_refused("void WGMDfunc m 13 void 0 0 0 void 0 0 0 lost 1 0 0 . 0 9 0 0 0 0 0 0 0 0 1",
                   "there is no modifier 'lost' before it");
}

static void what_is_unphysical_is_told(void **state) {
    (void)state;
    static const char *const texts[] = {
        "void BRTDfunc m 10 0 0 0 0 0 0 0 0 0 . 0 9 .5 .5 .5 .1 .1 .1 .6 .1 .1",
        "void BRTDfunc m 10 0 0 0 0 0 0 0 0 0 . 0 9 .1 .1 .1 .5 .5 .5 .1 .1 .6",
        "void WGMDfunc m 13 void 0 0 0 void 0 0 0 void 1 0 0 . 0 9 .5 .5 .5 .1 .1 .1 .6 .1 .1",
        "void WGMDfunc m 13 void 0 0 0 void 0 0 0 void 1 0 0 . 0 9 .1 .1 .1 .5 .5 .5 .1 .1 .6",
        "void transfunc m 2 max . 0 6 1.8 .4 .2 .25 .6 .5",
        "void transfunc m 2 max . 0 6 .8 1.4 .2 .25 .6 .5",
        "void transfunc m 2 max . 0 6 .8 .4 1.2 .25 .6 .5",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        setting s = setting_of(texts[i]);
        assert_int_equal(s.status, GRAZE_OK);
        if (!strstr(messages, ":1:1: ") || !strstr(messages, " m: unphysical"))
            fail_msg("%s: '%s'", texts[i], messages);
        setting_end(&s);
    }
}

/* The parts of a WGMDfunc with roughnesses are two lobes, with those that are 0 a mirror and a clear pane; a mirror
 * takes the same from all that is not mirrored. A part that is 0 in the scene is none, its modifier is not looked for.
 */
static void what_wgmdfunc_transmits(void **state) {
    (void)state;
    setting s =
        compiled_wgmd("void WGMDfunc m 13 lost 0 0 0 void .4 .2 .1 void 1 0 0 . 0 9 .1 .1 .1 .2 .2 .2 .3 .2 .1");
    const vec3 normal = {0, 0, 1}, direction = {0.6, 0, -0.8};
    material_wgmd_point at = {.ray = {.point = {0, 0, 0}, .direction = direction, .normal = normal},
                              .model = GRAZE_BRDF_GMD};
    for (int i = 0; i < WGMD_PARTS; i++) {
        at.normals[i] = normal;
        at.colors[i] = rgb_gray(1);
    }
    graze_surface parts[WGMD_PARTS];
    assert_false(s.wgmd->has[WGMD_SPECULAR] || s.wgmd->may_mirror || s.wgmd->may_be_clear);
    material_wgmd_prepare(s.wgmd, &at, parts);
    graze_surface joined = parts[WGMD_DIFFUSE];
    material_wgmd_join(&joined, &parts[WGMD_THROUGH]);
    material_wgmd_join(&joined, &parts[WGMD_THROUGH_DIFFUSE]);
    assert_color(joined.diffuse, 0.1, 0.1, 0.1);
    assert_color(joined.transmitted_diffuse, 0.3, 0.2, 0.1);
    assert_color(joined.transmitted_specular, 0.4, 0.4, 0.4);
    assert_int_equal(joined.transmitted_lobe, GRAZE_LOBE_TRANSMITTED_GLOSSY);
    assert_true(joined.transmitted_u == 0.2 && joined.transmitted_v == 0.1 && joined.transmits && !joined.fresnel);
    assert_color(material_wgmd_through(s.wgmd, &at), 0, 0, 0);
    setting_end(&s);
    s = compiled_wgmd("void WGMDfunc m 13 void .1 0 .2 void .4 .2 0 void 1 0 0 . 0 9 .1 .1 .1 .2 .2 .2 .3 .2 .1");
    material_wgmd_prepare(s.wgmd, &at, parts);
    const double fresnel = exp(-5.85 * 0.8) - exp(-5.85), left = 1 - fresnel;
    assert_true(fabs(parts[WGMD_SPECULAR].specular.g - (0.1 + 0.9 * fresnel)) < 1e-6);
    assert_int_equal(parts[WGMD_SPECULAR].specular_lobe, GRAZE_LOBE_MIRROR);
    assert_true(fabs(parts[WGMD_THROUGH].transmitted_specular.g - 0.4 * left) < 1e-6);
    assert_int_equal(parts[WGMD_THROUGH].transmitted_lobe, GRAZE_LOBE_TRANSMITTED);
    assert_true(fabs(parts[WGMD_THROUGH_DIFFUSE].transmitted_diffuse.g - 0.2 * left) < 1e-6);
    assert_true(fabs(material_wgmd_through(s.wgmd, &at).g - 0.4 * left) < 1e-6);
    setting_end(&s);
}

/* e^-5.85, as Radiance rounds it in its estimate. */
#define ROUNDED 0.00287989916

/* A point of a WGMDfunc without patterns or textures, seen from this direction. */
static material_wgmd_point wgmd_point_from(vec3 direction) {
    const double side = direction.z < 0 ? 1 : -1;
    material_wgmd_point at = {.ray = {.point = {3, 4, 5}, .direction = direction, .normal = {0, 0, 1}},
                              .model = GRAZE_BRDF_GMD};
    for (int i = 0; i < WGMD_PARTS; i++) {
        at.normals[i] = vec3_make(0, 0, side);
        at.colors[i] = white;
    }
    return at;
}

/* Joined, a mirror is that of the whole. From behind it is another colour that is diffuse, and what mirrors or
 * transmits is the same; very nearly along the surface, the cosine that Fresnel's estimate is of is 0.001. */
static void what_is_left_of_wgmdfunc(void **state) {
    (void)state;
    static const vec3 directions[] = {{0.6, 0, -0.8}, {0.6, 0, 0.8}, {1, 0, -1e-7}};
    static const double cosines[] = {0.8, 0.8, 1e-3};
    setting s =
        compiled_wgmd("void WGMDfunc m 13 void .1 0 .2 void .4 .2 0 void 1 0 0 . 0 9 .1 .2 .3 .4 .5 .6 .3 .2 .1");
    for (int i = 0; i < 3; i++) {
        const material_wgmd_point at = wgmd_point_from(directions[i]);
        const double left = 1 - (exp(-5.85 * cosines[i]) - ROUNDED), more = i == 1 ? 0.3 : 0;
        graze_surface parts[WGMD_PARTS];
        material_wgmd_prepare(s.wgmd, &at, parts);
        graze_surface joined = parts[WGMD_DIFFUSE];
        for (int part = WGMD_SPECULAR; part < WGMD_PARTS; part++)
            material_wgmd_join(&joined, &parts[part]);
        assert_int_equal(joined.specular_lobe, GRAZE_LOBE_MIRROR);
        assert_true(joined.specular.g == parts[WGMD_SPECULAR].specular.g && joined.transmits && joined.fresnel);
        assert_color(joined.diffuse, (0.1 + more) * left, (0.2 + more) * left, (0.3 + more) * left);
        assert_color(joined.transmitted_diffuse, 0.3 * left, 0.2 * left, 0.1 * left);
        assert_color(joined.transmitted_specular, 0.4 * left, 0.4 * left, 0.4 * left);
        assert_color(material_wgmd_through(s.wgmd, &at), 0.4 * left, 0.4 * left, 0.4 * left);
    }
    setting_end(&s);
}

/* Functions see the surface's own normal and the part's on the viewer's side, from where the material is turned to. */
static void what_functions_of_wgmdfunc_see(void **state) {
    (void)state;
    static const char *const texts[] = {
        "void WGMDfunc m 13 void RdotP/10 0 0 void -NzP*.4 Nz*.2 -Rdot*.25 void 1 0 0 . 0 9 0 0 0 0 0 0 0 0 0",
        "void WGMDfunc m 15 void RdotP/10 0 0 void NzP*.4 -Nz*.2 -Rdot*.25 void 1 0 0 . -rx 180 0 9 0 0 0 0 0 0 0 0 0",
    };
    for (int i = 0; i < 2; i++) {
        setting s = compiled_wgmd(texts[i]);
        const material_wgmd_point at = wgmd_point_from(vec3_make(0.6, 0, 0.8));
        const double fresnel = exp(-5.85 * 0.8) - ROUNDED;
        graze_surface parts[WGMD_PARTS];
        material_wgmd_prepare(s.wgmd, &at, parts);
        const double mirrored = 0.08 + 0.92 * fresnel, through = 0.4 * (1 - fresnel);
        assert_color(parts[WGMD_SPECULAR].specular, mirrored, mirrored, mirrored);
        assert_color(parts[WGMD_THROUGH].transmitted_specular, through, through, through);
        assert_true(fabs(parts[WGMD_THROUGH].transmitted_u - 0.2) < 1e-12);
        assert_true(fabs(parts[WGMD_THROUGH].transmitted_v - 0.2) < 1e-12);
        setting_end(&s);
    }
}

/* Nothing comes through where there is no such part, and none is prepared. */
static void parts_that_are_not_there(void **state) {
    (void)state;
    setting s =
        compiled_wgmd("void WGMDfunc m 13 inherit .1 .1 .1 inherit 0 .1 .1 lost 1 0 0 . 0 9 .1 .2 .3 0 0 0 0 0 0");
    const material_wgmd_point at = wgmd_point_from(vec3_make(0.6, 0, -0.8));
    graze_surface parts[WGMD_PARTS] = {{.transmits = 7}, {.transmits = 7}, {.transmits = 7}, {.transmits = 7}};
    assert_true(s.wgmd->has[WGMD_SPECULAR] && s.wgmd->inherits[WGMD_SPECULAR] && !s.wgmd->may_mirror);
    assert_false(s.wgmd->has[WGMD_THROUGH] || s.wgmd->has[WGMD_THROUGH_DIFFUSE] || s.wgmd->may_be_clear);
    material_wgmd_prepare(s.wgmd, &at, parts);
    assert_int_equal(parts[WGMD_DIFFUSE].transmits, 0);
    assert_int_equal(parts[WGMD_SPECULAR].transmits, 0);
    assert_int_equal(parts[WGMD_THROUGH].transmits, 7);
    assert_int_equal(parts[WGMD_THROUGH_DIFFUSE].transmits, 7);
    assert_color(material_wgmd_through(s.wgmd, &at), 0, 0, 0);
    setting_end(&s);
}

/* A weak mirror has no Fresnel's estimate and takes nothing from what else there is; one that is next to nothing, or
 * that no value can be computed of, is none. So are roughnesses next to nothing. */
static void what_is_weak_in_wgmdfunc(void **state) {
    (void)state;
    static const struct {
        const char *specular;
        double mirrored;
        bool mirrors, has, rough;
    } cases[] = {
        {".017 0 0", 0.017, true, true, false},         {".000001001 0 .2", 1.001e-6, true, true, false},
        {".000000999 0 0", 0, false, false, false},     {"Px*1e-7 0 0", 0, true, true, false},
        {"sqrt(-Px) 0 0", 0, true, true, false},        {".01 .000000999 .2", 0.01, true, true, false},
        {".01 .2 .000000999", 0.01, true, true, false}, {".01 .000001001 .000001001", 0.01, false, true, true},
        {".01 Px 0", 0.01, true, true, false},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "void WGMDfunc m 13 void %s void .4 0 0 void sqrt(-Px) 0 0 . 0 9 .1 .1 .1 0 0 0 0 0 0",
                 cases[i].specular);
        setting s = compiled_wgmd(text);
        const material_wgmd_point at = wgmd_point_from(vec3_make(0.6, 0, -0.8));
        graze_surface parts[WGMD_PARTS];
        material_wgmd_prepare(s.wgmd, &at, parts);
        const bool has = s.wgmd->has[WGMD_SPECULAR];
        const double mirrored = has ? parts[WGMD_SPECULAR].specular.g : 0;
        const bool rough = has && parts[WGMD_SPECULAR].specular_lobe == GRAZE_LOBE_GLOSSY;
        if (has != cases[i].has || s.wgmd->may_mirror != cases[i].mirrors || rough != cases[i].rough ||
            !(fabs(mirrored - cases[i].mirrored) <= 1e-12 * cases[i].mirrored) || parts[WGMD_DIFFUSE].fresnel)
            fail_msg("%s: %d %d %d %g", text, has, s.wgmd->may_mirror, rough, mirrored);
        assert_color(parts[WGMD_DIFFUSE].diffuse, 0.1, 0.1, 0.1);
        assert_color(parts[WGMD_THROUGH].transmitted_specular, 0.4, 0.4, 0.4);
        assert_color(material_wgmd_through(s.wgmd, &at), 0.4, 0.4, 0.4);
        setting_end(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_transfunc_divides),
        cmocka_unit_test(what_brtdfunc_divides),
        cmocka_unit_test(what_functions_see),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(what_is_unphysical_is_told),
        cmocka_unit_test(what_wgmdfunc_transmits),
        cmocka_unit_test(what_functions_of_wgmdfunc_see),
        cmocka_unit_test(parts_that_are_not_there),
        cmocka_unit_test(what_data_tell),
        cmocka_unit_test(what_is_left_of_wgmdfunc),
        cmocka_unit_test(what_is_weak_in_wgmdfunc),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
