/* Patterns, textures and mixtures against values computed by hand; what is refused; compute errors. */
#include "material/modifier.h"

#include "material/support.h"
#include "material/written_modifiers.h"

/* A directory with the files that the scenes here name. */
static int enter_directory(void **state) {
    static char name[] = "/tmp/graze-modifier-XXXXXX";
    static const struct {
        const char *name, *text;
    } files[] = {
        {"own.cal", "grey(x, y, z) = (x + 2*y + 3*z)/6; twice(x) = 2*x; first(x, y, z) = x; depth = T + 10*Ts;"
                    "broken = 1/(Px - 1); odd = missing + 1; all = Nx + 10*Ny + 100*Nz + 1000*Rdot;"
                    "deep(n) = if(n - .5, 1 + deep(n - 1), 0); dug = deep(A1*20000);"},
        {"line.dat", "1\n0 2 3\n1 3 11\n"},
        {"plane.dat", "2\n0 1 2\n0 1 2\n1 2\n3 4\n"},
        {"one.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\naaaabbbb"},
    };
    *state = name;
    if (!mkdtemp(name) || chdir(name))
        return -1;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        FILE *out = fopen(files[i].name, "w");
        if (!out || fputs(files[i].text, out) < 0 || fclose(out))
            return -1;
    }
    /* Two rows of two pixels of 1, 2, 3 and 4 halves of (1, .5, .25), exposed by 2. */
    static const unsigned char pixels[16] = {128, 64, 32, 129, 128, 64, 32, 130, /* top: 1 and 2 */
                                             192, 96, 48, 130, 128, 64, 32, 131};
    FILE *out = fopen("four.hdr", "wb");
    if (!out || fputs("#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n", out) < 0 ||
        fwrite(pixels, 1, sizeof pixels, out) != sizeof pixels || fclose(out))
        return -1;
    return 0;
}

static int leave_directory(void **state) {
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", (const char *)*state);
    return chdir("/") || system(command);
}

/* A scene of modifiers, and the chain of the last of them. */
typedef struct setting {
    written_modifiers of;
    material_chain chain;
    graze_status status;
} setting;

static setting setting_of(const char *text) {
    setting s = {.of = written_modifiers_read(text)};
    if (s.of.status)
        fail_msg("%s", messages);
    s.status = material_chain_find(&s.chain, s.of.modifiers, s.of.number);
    return s;
}

static void setting_end(setting *s) {
    written_modifiers_destroy(&s->of);
}

static material_ray ray_at(double x, double y, double z) {
    return (material_ray){
        .point = {x, y, z}, .direction = {0.6, 0, -0.8}, .normal = {0, 0, 1}, .distance = 7, .last_distance = 3};
}

static material_effect effect_of(const char *text, double x, double y, double z) {
    setting s = setting_of(text);
    if (s.status)
        fail_msg("%s", messages);
    const material_ray ray = ray_at(x, y, z);
    material_effect e = material_modify(s.chain.modifiers, &ray);
    setting_end(&s);
    return e;
}

static void assert_close(double value, double expected) {
    if (!(fabs(value - expected) <= 1e-6 * fmax(1, fabs(expected))))
        fail_msg("%.17g is not %.17g", value, expected);
}

static void assert_color(material_effect e, double r, double g, double b) {
    assert_close(e.color.r, r);
    assert_close(e.color.g, g);
    assert_close(e.color.b, b);
    assert_close(vec3_length(e.perturbation), 0);
}

static void assert_perturbation(material_effect e, double x, double y, double z) {
    assert_close(e.perturbation.x, x);
    assert_close(e.perturbation.y, y);
    assert_close(e.perturbation.z, z);
    assert_close(e.color.r, 1);
}

static void test_functions(void **state) {
    (void)state;
    assert_color(effect_of("void brightfunc b 2 Px*A1+Py . 0 1 2", 3, 4, 5), 10, 10, 10);
    assert_color(effect_of("void colorfunc c 4 Px Py*A2 Pz+AC . 0 2 2 3", 3, 4, 5), 3, 12, 7);
    assert_color(effect_of("void brightfunc b 2 depth own.cal 0 0", 0, 0, 0), 37, 37, 37);
    assert_color(effect_of("void brightfunc b 2 all own.cal 0 0", 0, 0, 0), 900, 900, 900);
    assert_color(effect_of("void brightfunc b 2 dug own.cal 0 1 .5", 0, 0, 0), 10000, 10000, 10000);
}

/* Functions are defined where the transform begins: a point at 2 (1, 2, 3) turned by 90 degrees about z. */
static void test_transform(void **state) {
    (void)state;
    static const char *const moved = "-s 2 -rz 90 -t 10 0 0";
    char text[200];
    snprintf(text, sizeof text, "void colorfunc c 12 Px Py Pz . %s 0 0", moved);
    assert_color(effect_of(text, 10 - 4, 2, 6), 1, 2, 3);
    snprintf(text, sizeof text, "void colorfunc c 12 Dx Dy Dz . %s 0 0", moved);
    assert_color(effect_of(text, 0, 0, 0), 0, -0.6, -0.8);
    snprintf(text, sizeof text, "void colorfunc c 12 T Ts S . %s 0 0", moved);
    assert_color(effect_of(text, 0, 0, 0), 3.5, 1.5, 0.5);
    snprintf(text, sizeof text, "void colorfunc c 12 Tx Ty Ix*10+Iy . %s 0 0", moved);
    assert_color(effect_of(text, 0, 0, 0), 0, 5, -1);
    snprintf(text, sizeof text, "void texfunc t 12 1 0 .5 . %s 0 0", moved);
    assert_perturbation(effect_of(text, 0, 0, 0), 0, 1, 0.5);
    assert_color(effect_of("void colorfunc c 5 Px Py Pz . -mx 0 0", 1, 2, 3), -1, 2, 3);
}

static void test_order(void **state) {
    (void)state;
    material_effect e = effect_of("void brightfunc a 2 2 . 0 0 a texfunc b 4 .1 0 0 . 0 0 b plastic m 0 0 5 1 1 1 0 0 "
                                  "m colorfunc c 4 1 3 5 . 0 0 c texfunc d 4 .1 .2 .3 . 0 0",
                                  0, 0, 0);
    assert_close(e.color.r, 2);
    assert_close(e.color.g, 6);
    assert_close(e.color.b, 10);
    assert_close(e.perturbation.x, 0.2);
    assert_close(e.perturbation.z, 0.3);
}

static void test_data(void **state) {
    (void)state;
    assert_color(effect_of("void brightdata d 4 noop line.dat . Px 0 0", 1.5, 0, 0), 7, 7, 7);
    assert_color(effect_of("void brightdata d 4 twice line.dat own.cal Px*Py 0 0", 2, 0.25, 0), 4, 4, 4);
    assert_color(effect_of("void brightdata d 6 noop line.dat . Px -s 2 0 0", 3, 0, 0), 7, 7, 7);
    /* The first dimension comes first. */
    assert_color(effect_of("void brightdata d 5 noop plane.dat . Px Py 0 0", 1, 0, 0), 3, 3, 3);
    /* grey sees all three, twice its own. */
    assert_color(effect_of("void colordata d 8 grey twice noop line.dat line.dat line.dat own.cal Px 0 0", 0, 0, 0), 1,
                 2, 1);
    assert_color(
        effect_of("void colordata d 9 grey twice noop plane.dat plane.dat plane.dat own.cal Px Py 0 0", 0.5, 0, 0), 2,
        4, 2);
    assert_perturbation(
        effect_of("void texdata d 8 first first grey line.dat line.dat line.dat own.cal Px 0 0", 1, 0, 0), 3, 3, 3);
}

static void test_picture(void **state) {
    (void)state;
    /* Pixels are 1, 2 over 3, 4 in red, whatever the exposure; half a step of rgbe on top. */
    double up = 1 + 0.5 / 128;
    assert_color(effect_of("void colorpict p 7 noop noop noop four.hdr . Px Py 0 0", 0, 1, 0), up, .5 * (1 + 1. / 128),
                 .25 * (1 + 1. / 64));
    assert_close(effect_of("void colorpict p 7 noop noop noop four.hdr . Px Py 0 0", 1, 1, 0).color.r, 2 * up);
    assert_close(effect_of("void colorpict p 7 noop noop noop four.hdr . Px Py 0 0", 0, 0, 0).color.r, 3 + 0.5 / 64);
    assert_close(effect_of("void colorpict p 7 noop noop noop four.hdr . Px Py 0 0", 0.5, 1, 0).color.r, 1.5 * up);
}

static void test_mixture_of_patterns(void **state) {
    (void)state;
    static const char *const both = "void brightfunc a 2 3 . 0 0 void texfunc b 4 .4 0 .8 . 0 0 ";
    char text[300];
    snprintf(text, sizeof text, "%svoid mixfunc m 4 a b Px . 0 0", both);
    material_effect e = effect_of(text, 0.25, 0, 0);
    assert_close(e.color.r, 0.25 * 3 + 0.75);
    assert_close(e.perturbation.x, 0.3);
    assert_close(e.perturbation.z, 0.6);
    assert_close(effect_of(text, 7, 0, 0).color.r, 3);
    assert_close(effect_of(text, -1, 0, 0).perturbation.z, 0.8);
    snprintf(text, sizeof text, "%svoid mixdata m 6 void a twice line.dat own.cal Px/100 0 0", both);
    assert_color(effect_of(text, -45, 0, 0), 0.2 + 0.8 * 3, 0.2 + 0.8 * 3, 0.2 + 0.8 * 3);
    /* By a sixth of red, two of green, three of blue: (1 + 1 + .75)/6 with half a step of rgbe. */
    snprintf(text, sizeof text, "%svoid mixpict m 7 a void grey four.hdr own.cal Px Py 0 0", both);
    double share = ((1 + 0.5 / 128) + (1 + 1. / 128) + 0.75 * (1 + 1. / 64)) / 6;
    assert_close(effect_of(text, 0, 1, 0).color.r, 1 + 2 * share);
}

static void test_mixture_of_materials(void **state) {
    (void)state;
    setting s = setting_of("void plastic p 0 0 5 1 1 1 0 0 void metal q 0 0 5 1 1 1 0 0 void mixfunc m 4 p q Px . 0 0 "
                           "m brightfunc above 2 2 . 0 0");
    const material_ray ray = ray_at(0.3, 0, 0);
    assert_int_equal(s.status, GRAZE_OK);
    assert_int_equal(s.chain.material, 2);
    assert_non_null(s.chain.mixture);
    assert_int_equal(s.chain.mixture->fore, 0);
    assert_int_equal(s.chain.mixture->back, 1);
    double share;
    assert_true(material_mixture_share(s.chain.mixture, &ray, &share));
    assert_close(share, 0.3);
    assert_close(material_modify(s.chain.modifiers, &ray).color.r, 2);
    setting_end(&s);
}

/* A material without modifiers is a chain of nothing but itself. */
static void test_material_alone(void **state) {
    (void)state;
    setting s = setting_of("void plastic p 0 0 5 1 1 1 0 0 void alias q p");
    assert_int_equal(s.chain.material, 1);
    assert_null(s.chain.modifiers);
    assert_null(s.chain.mixture);
    setting_end(&s);
}

static void assert_refused(const char *text, const char *why) {
    setting s = setting_of(text);
    if (!s.status)
        fail_msg("'%s' is taken", text);
    if (!strstr(messages, why))
        fail_msg("'%s': %s", text, messages);
    setting_end(&s);
}

static void test_refused(void **state) {
    (void)state;
    assert_refused("void brightfunc b 2 if(Py-3,missing,1) . 0 0",
                   "in the expression 'if(Py-3,missing,1)', column 9: there is no variable missing");
    assert_refused("void brightfunc b 2 if(Py-3,missing(Px),1) . 0 0", "there is no function missing");
    assert_refused("void colorfunc b 4 Px 1+missing Py . 0 0",
                   "colorfunc b: in the expression '1+missing', column 3: there is no variable missing");
    assert_refused("void brightfunc b 2 if(Py-3,odd,1) own.cal 0 0", "own.cal:1:117: there is no variable missing");
    assert_refused("void brightfunc b 2 odd own.cal 0 0", "brightfunc b: own.cal:1:117: there is no variable missing");
    assert_refused("void brightfunc b 2 Px+ . 0 0", "Px+");
    assert_refused("void brightfunc b 2 A3 . 0 0", "no real argument 3");
    assert_refused("void brightfunc b 2 Px none.cal 0 0", "there is no function file none.cal along RAYPATH");
    assert_refused("void brightfunc b 4 Px . -s 0 0 0", "bad transform");
    assert_refused("void brightdata b 4 noop none.dat . Px 0 0", "brightdata b: there is no data file none.dat");
    assert_refused("void brightdata b 4 noop plane.dat . Px 0 0", "needs at least 5 string arguments, not 4");
    assert_refused("void brightdata b 4 nothing line.dat . Px 0 0", "nothing");
    assert_refused("void colordata b 9 noop noop noop plane.dat line.dat line.dat . Px Py 0 0", "2 and 1 dimensions");
    assert_refused("void colorpict b 7 noop noop noop none.hdr . Px Py 0 0", "there is no picture none.hdr");
    assert_refused("void colorpict b 7 noop noop noop one.hdr . Px Py 0 0", "less than 2 x 2 pixels");
    assert_refused("void mixfunc b 4 nobody void .5 . 0 0", "there is no modifier 'nobody' before it");
    assert_refused("void brightfunc a 2 1 . 0 0 void plastic p 0 0 5 1 1 1 0 0 a mixfunc b 4 p void .5 . 0 0",
                   "a mixture of materials cannot be modified");
    assert_refused("void plastic p 0 0 5 1 1 1 0 0 p brightfunc a 2 1 . 0 0 a metal m 0 0 5 1 1 1 0 0",
                   "this material modifies another one");
    assert_refused("void brighttext t 2 f x 0 11 0 0 0 1 0 0 0 1 0 0 1", "brighttext is not supported yet");
}

/* Up to so many, and not more. */
static void test_mixtures_of_mixtures(void **state) {
    (void)state;
    char text[1000] = "void brightfunc m0 2 3 . 0 0 ";
    for (int i = 1; i <= 13; i++) {
        size_t length = strlen(text);
        snprintf(text + length, sizeof text - length, "void mixfunc m%d 4 m%d void 1 . 0 0 ", i, i - 1);
        if (i == 12)
            assert_color(effect_of(text, 0, 0, 0), 3, 3, 3);
    }
    assert_refused(text, "more than 12 mixtures of mixtures of mixtures");
}

static void test_meaningless_words_are_told(void **state) {
    (void)state;
    setting s = setting_of("void brightfunc b 5 Px . else -s 2 0 0");
    assert_int_equal(s.status, GRAZE_OK);
    assert_non_null(strstr(messages, "its string argument 3, 'else', has no meaning"));
    setting_end(&s);
}

/* The modifier is left out, and that is told once. */
static void test_compute_error(void **state) {
    (void)state;
    setting s = setting_of("void brightfunc a 2 3 . 0 0 a brightfunc b 2 broken own.cal 0 0");
    const material_ray good = ray_at(3, 0, 0), bad = ray_at(1, 0, 0);
    assert_int_equal(s.status, GRAZE_OK);
    assert_close(material_modify(s.chain.modifiers, &good).color.r, 1.5);
    assert_string_equal(messages, "");
    assert_close(material_modify(s.chain.modifiers, &bad).color.r, 3);
    assert_non_null(strstr(messages, "brightfunc b: compute error: a division by 0"));
    messages[0] = 0;
    assert_close(material_modify(s.chain.modifiers, &bad).color.r, 3);
    assert_string_equal(messages, "");
    setting_end(&s);
}

/* The normal stays on the viewer's side: it is mirrored at the plane across the ray. */
static void test_normal(void **state) {
    (void)state;
    const vec3 up = {0, 0, 1}, ray = vec3_normalize(vec3_make(1, 0, -0.1));
    vec3 n = material_perturbed_normal(up, vec3_make(0, 0.5, 0), ray);
    assert_close(n.y, 0.5 / sqrt(1.25));
    n = material_perturbed_normal(up, vec3_make(1e-7, 0, 0), ray);
    assert_true(n.x == 0 && n.z == 1);
    n = material_perturbed_normal(up, vec3_make(1, 0, 0), ray);
    vec3 leaned = vec3_normalize(vec3_make(1, 0, 1));
    assert_close(vec3_dot(n, ray), -vec3_dot(leaned, ray));
    assert_true(vec3_dot(n, ray) < 0);
    assert_unit(n);
    n = material_perturbed_normal(up, vec3_make(0, 0, -1), ray);
    assert_true(n.z == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_functions),
        cmocka_unit_test(test_transform),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_data),
        cmocka_unit_test(test_picture),
        cmocka_unit_test(test_mixture_of_patterns),
        cmocka_unit_test(test_mixture_of_materials),
        cmocka_unit_test(test_material_alone),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_mixtures_of_mixtures),
        cmocka_unit_test(test_meaningless_words_are_told),
        cmocka_unit_test(test_compute_error),
        cmocka_unit_test(test_normal),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
