/* Readers of measurement files: what each format says, conventions assumed, told and stated, and files that are wrong.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fit/measured_text.h"

static const double pi = 3.14159265358979323846;
static const fit_read_options plain = {0};

static bool is_direction(graze_vec3 v, double polar, double azimuth) {
    double t = polar * pi / 180, p = azimuth * pi / 180;
    return fabs(v.x - sin(t) * cos(p)) < 1e-12 && fabs(v.y - sin(t) * sin(p)) < 1e-12 && fabs(v.z - cos(t)) < 1e-12;
}

static bool is_close(double a, double b) {
    return fabs(a - b) <= 1e-12 * fabs(b);
}

static void names_of_columns(void **state) {
    (void)state;
    /* The same pair, light at (30, 10), view at (40, 200), value .25. */
    static const char in_components[] = "lx ly lz vx vy vz f\n.49240387650610395 .08682408883346515 .8660254037844387 "
                                        "-.6040227735550537 -.21984631039295419 .766044443118978 .25\n";
    static const char in_radians[] = "theta_i[rad],phi_i[rad],theta_o[rad],phi_o[rad],f\n"
                                     ".5235987755982988,.17453292519943295,.6981317007977318,3.490658503988659,.25\n";
    static const char *const tables[] = {
        "theta_i,phi_i,theta_o,phi_o,f\n30,10,40,200,.25\n",
        "theta_l,phi_l,theta_v,phi_v,f\n30,10,40,200,.25\n",
        "# a comment\n\nThetaI PhiI ThetaR PhiR f\n30 10 40 200 .25\n",
        "# theta_i phi_i theta_s phi_s f\n30 10 40 200 .25\n",
        "#f;theta_i;phi_i;theta_s;phi_s\n.25;30;10;40;200\n",
        "\"theta_i (deg)\",\"phi_i (deg)\",\"theta_o (deg)\",\"phi_o (deg)\",\"f\"\r\n30,10,40,200,0.25\r\n",
        "theta_i\tdphi\tphi_i\ttheta_o\tf\n30\t190\t10\t40\t.25",
        in_radians,
        "\xef\xbb\xbftheta_i,phi_i,theta_o,phi_o,f\n30,10,40,200,.25\n",
        in_components,
    };
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        fit_measurements m = {0};
        if (read_text(&m, tables[i], &plain) != GRAZE_OK)
            fail_msg("table %zu: %s", i, messages);
        assert_int_equal(m.count, 1);
        assert_int_equal(m.channel_count, 1);
        assert_string_equal(m.channels[0].text, "f");
        if (!is_direction(m.pairs[0].l, 30, 10) || !is_direction(m.pairs[0].v, 40, 200) || m.values[0] != .25)
            fail_msg("table %zu", i);
        assert_true(m.pairs[0].weight == 1);
        assert_int_equal(m.sources[0].conventions.format, FIT_FORMAT_TABLE);
        assert_int_equal(m.sources[0].origins.light, i == 1 || i == 9 ? FIT_OF_FILE : FIT_ASSUMED);
        assert_int_equal(m.sources[0].origins.unit, i == 5 || i == 7 || i == 9 ? FIT_OF_FILE : FIT_ASSUMED);
        assert_string_equal(messages, "");
        fit_measurements_free(&m);
    }
}

static void tables_with_more(void **state) {
    (void)state;
    fit_measurements m = {0};
    /* Several channels, weights, deviations, a column nobody wants. */
    const fit_read_options two = {.channels = "B,R"};
    assert_int_equal(
        read_text(&m, "theta_i,phi_i,theta_o,phi_o,R,note,B,weight,sigma\n30,0,30,180,1,good,2,8,2\n", &two), GRAZE_OK);
    assert_int_equal(m.channel_count, 2);
    assert_string_equal(m.channels[0].text, "R");
    assert_true(m.values[0] == 1 && m.values[1] == 2 && m.pairs[0].weight == 2);
    /* A second file of the same channels adds to the first; one of others does not. */
    assert_int_equal(read_text(&m, "R theta_i phi_i theta_o phi_o B\n3 20 0 20 180 4\n5 95 0 20 180 6\n", &two),
                     GRAZE_OK);
    assert_int_equal(m.count, 2);
    assert_true(m.values[2] == 3 && m.values[3] == 4);
    assert_int_equal(m.sources[1].pairs, 1);
    assert_int_equal(m.sources[1].below, 1);
    assert_int_equal(read_text(&m, "theta_i phi_i theta_o phi_o f\n20 0 20 180 4\n", &plain), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, "its channels are not those of"));
    fit_measurements_free(&m);
    /* Names told, with and without a line of names to replace. */
    const fit_read_options told = {.columns = "theta_i,phi_i,theta_o,phi_o,550nm"};
    for (int i = 0; i < 2; i++) {
        assert_int_equal(read_text(&m, i ? "# none\n30 0 40 180 .5\n" : "a b c d e\n30 0 40 180 .5\n", &told),
                         GRAZE_OK);
        assert_true(m.count == 1 && m.values[0] == .5 && m.channels[0].wavelength == 550);
        fit_measurements_free(&m);
    }
    /* No azimuths: one plane, positive angles on the mirror's side. */
    assert_int_equal(read_text(&m, "theta_i theta_o f\n30 30 1\n30 -80 2\n", &plain), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].l, 30, 0) && is_direction(m.pairs[0].v, 30, 180));
    assert_true(is_direction(m.pairs[1].v, 80, 0) && m.sources[0].azimuths_are_zero);
    fit_measurements_free(&m);
}

static void conventions_told(void **state) {
    (void)state;
    const char *table = "theta_i,phi_i,theta_o,phi_o,f\n60,10,40,30,.25\n";
    fit_measurements m = {0};
    fit_read_options o = {.conventions = {.quantity = FIT_TIMES_COSINE_VIEW, .mirror = FIT_MIRROR_SAME}};
    assert_int_equal(read_text(&m, table, &o), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].l, 60, 10) && is_direction(m.pairs[0].v, 40, 210));
    assert_true(is_close(m.values[0], .25 / cos(40 * pi / 180)));
    assert_int_equal(m.sources[0].origins.quantity, FIT_TOLD);
    assert_int_equal(m.sources[0].origins.mirror, FIT_TOLD);
    fit_measurements_free(&m);
    o = (fit_read_options){.conventions = {.quantity = FIT_TIMES_COSINE_LIGHT, .light = FIT_LIGHT_OUTGOING}};
    assert_int_equal(read_text(&m, table, &o), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, 60, 10) && is_direction(m.pairs[0].l, 40, 30));
    assert_true(is_close(m.values[0], .25 / cos(60 * pi / 180)));
    assert_int_equal(m.sources[0].conventions.light, FIT_LIGHT_OUTGOING);
    fit_measurements_free(&m);
    o = (fit_read_options){.conventions = {.unit = FIT_RADIANS}};
    assert_int_equal(read_text(&m, "theta_i,phi_i,theta_o,phi_o,f\n.5,.1,.7,.3,.25\n", &o), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].l, .5 * 180 / pi, .1 * 180 / pi));
    fit_measurements_free(&m);
}

/* The wrong unit is noticed. */
static void unlikely_units(void **state) {
    (void)state;
    fit_measurements m = {0};
    assert_int_equal(read_text(&m, "theta_i,phi_i,theta_o,phi_o,f\n.5,.1,1.5,3,.25\n", &plain), GRAZE_OK);
    assert_non_null(strstr(messages, "warning"));
    assert_non_null(strstr(messages, "--angles radians"));
    fit_measurements_free(&m);
    const fit_read_options radians = {.conventions = {.unit = FIT_RADIANS}};
    assert_int_equal(read_text(&m, "theta_i,phi_i,theta_o,phi_o,f\n1,.1,20,3,.25\n", &radians), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, ":2:6: expected a polar angle of at most pi"));
    assert_non_null(strstr(messages, "--angles degrees"));
    fit_measurements_free(&m);
}

static void cornell(void **state) {
    (void)state;
    fit_measurements m = {0};
    assert_int_equal(read_text(&m,
                               "# Cornell\n# num wls\n3\n\n# wls\n400 500\n600\n# theta i, ...\n"
                               "0.5 0 0.7 3.2 .1 .2 .3\n\n0.6 0.1 0.7 3.1 .4 .5 .6\n",
                               &plain),
                     GRAZE_OK);
    assert_true(m.count == 2 && m.channel_count == 3 && m.channels[2].wavelength == 600);
    assert_true(m.values[0] == .1 && m.values[5] == .6);
    assert_true(is_direction(m.pairs[0].l, .5 * 180 / pi, 0) &&
                is_direction(m.pairs[0].v, .7 * 180 / pi, 3.2 * 180 / pi));
    assert_int_equal(m.sources[0].conventions.format, FIT_FORMAT_CORNELL);
    assert_int_equal(m.sources[0].origins.unit, FIT_OF_FORMAT);
    fit_measurements_free(&m);
}

static void alta(void **state) {
    (void)state;
    fit_measurements m = {0};
    assert_int_equal(
        read_text(&m,
                  "#ALTA HEADER BEGIN\n#DIM 4 3\n#PARAM_IN  SPHERICAL_TL_PL_TV_PV\n#PARAM_OUT RGB_COLOR\n#VS 1\n"
                  "0.5 0 0.7 3 .1 .2 .3 .01\n",
                  &plain),
        GRAZE_OK);
    assert_true(m.count == 1 && m.channel_count == 3 && m.values[2] == .3);
    assert_string_equal(m.channels[1].text, "G");
    assert_true(is_direction(m.pairs[0].l, .5 * 180 / pi, 0) &&
                is_direction(m.pairs[0].v, .7 * 180 / pi, 3 * 180 / pi));
    assert_int_equal(m.sources[0].conventions.format, FIT_FORMAT_ALTA);
    fit_measurements_free(&m);
    assert_int_equal(read_text(&m,
                               "#DIM 3 1\n#PARAM_IN ISOTROPIC_TV_TL_DPHI\n#PARAM_OUT INV_STERADIAN_COSINE_FACTOR\n"
                               "0.5 0.7 3 .1\n",
                               &plain),
                     GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, .5 * 180 / pi, 0) &&
                is_direction(m.pairs[0].l, .7 * 180 / pi, 3 * 180 / pi));
    assert_true(is_close(m.values[0], .1 / cos(.5)));
    assert_int_equal(m.sources[0].origins.quantity, FIT_OF_FILE);
    fit_measurements_free(&m);
    assert_int_equal(read_text(&m, "#DIM 6 1\n#PARAM_IN CARTESIAN\n0 0 1 .6 0 .8 .1\n", &plain), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, 0, 0) && fabs(m.pairs[0].l.x - .6) < 1e-15);
    assert_int_equal(m.sources[0].origins.quantity, FIT_ASSUMED);
    fit_measurements_free(&m);
    /* Half vector along the normal: mirror directions; difference along the half vector: both are the half vector. */
    assert_int_equal(read_text(&m,
                               "#DIM 4 1\n#PARAM_IN RUSIN_TH_PH_TD_PD\n#PARAM_OUT INV_STERADIAN\n0 0 .5 .25 1\n"
                               ".4 .3 0 0 2\n",
                               &plain),
                     GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, .5 * 180 / pi, .25 * 180 / pi));
    assert_true(is_direction(m.pairs[0].l, .5 * 180 / pi, .25 * 180 / pi + 180));
    assert_true(is_direction(m.pairs[1].l, .4 * 180 / pi, .3 * 180 / pi));
    assert_true(is_direction(m.pairs[1].v, .4 * 180 / pi, .3 * 180 / pi));
    fit_measurements_free(&m);
    /* Angles may be degrees if that is told. */
    const fit_read_options degrees = {.conventions = {.unit = FIT_DEGREES}};
    assert_int_equal(read_text(&m, "#DIM 4 1\n#PARAM_IN RUSIN_TH_PH_TD_PD\n40 30 0 0 2\n", &degrees), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, 40, 30) && is_direction(m.pairs[0].l, 40, 30));
    fit_measurements_free(&m);
    /* In the plane of the half vector, angles add. */
    assert_int_equal(read_text(&m, "#DIM 3 1\n#PARAM_IN RUSIN_TH_TD_PD\n.3 .2 0 1\n", &plain), GRAZE_OK);
    assert_true(is_direction(m.pairs[0].v, .5 * 180 / pi, 0) && is_direction(m.pairs[0].l, .1 * 180 / pi, 0));
    fit_measurements_free(&m);
}

static void pab(void **state) {
    (void)state;
    fit_measurements m = {0};
    const char *header = "#sample_name \"x\"\n#intheta 60\n#inphi 0\n#upphi 0\n#format: theta phi DSF\n";
    char text[512];
    snprintf(text, sizeof text, "%s40 180 .1\n120 180 .2\n", header);
    assert_int_equal(read_text(&m, text, &plain), GRAZE_OK);
    assert_true(m.count == 1 && m.sources[0].below == 1 && is_close(m.values[0], .1 / cos(40 * pi / 180)));
    assert_true(is_direction(m.pairs[0].l, 60, 0) && is_direction(m.pairs[0].v, 40, 180));
    assert_int_equal(m.sources[0].conventions.format, FIT_FORMAT_PAB);
    assert_int_equal(m.sources[0].origins.quantity, FIT_OF_FILE);
    /* Another incident direction. */
    assert_int_equal(read_text(&m, "#incident_angle 30 90\n#format: theta phi BRDF\n10 270 .5\n", &plain), GRAZE_OK);
    assert_true(m.count == 2 && m.values[1] == .5 && is_direction(m.pairs[1].l, 30, 90));
    fit_measurements_free(&m);
    assert_int_equal(
        read_text(&m, "#incident_angle 30 90\n#colorimetry: CIE-XYZ\n#format: theta phi bsdf\n10 270 1 2 3\n", &plain),
        GRAZE_OK);
    assert_true(m.channel_count == 3 && m.values[2] == 3);
    assert_string_equal(m.channels[0].text, "X");
    fit_measurements_free(&m);
}

enum { MERL_CELLS = 90 * 90 * 180 };

static void put_little_endian(unsigned char *to, uint64_t number, int count) {
    for (int i = 0; i < count; i++)
        to[i] = (unsigned char)(number >> (8 * i));
}

static void put_merl(unsigned char *bytes, int channel, int half, int difference, int azimuth, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_little_endian(
        bytes + 12 + 8 * ((size_t)channel * MERL_CELLS + (size_t)((half * 90 + difference) * 180 + azimuth)), bits, 8);
}

static void merl(void **state) {
    (void)state;
    size_t length = 12 + (size_t)8 * 3 * MERL_CELLS;
    unsigned char *bytes = malloc(length);
    assert_non_null(bytes);
    put_little_endian(bytes, 90, 4);
    put_little_endian(bytes + 4, 90, 4);
    put_little_endian(bytes + 8, 180, 4);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < MERL_CELLS; i++)
            put_merl(bytes, k, i / 16200, i / 180 % 90, i % 180, -1);
    for (int k = 0; k < 3; k++) {
        put_merl(bytes, k, 0, 40, 45, 1500 * (k + 1));
        put_merl(bytes, k, 89, 89, 0, 1500);
    }
    fit_measurements m = {0};
    assert_int_equal(read_written(&m, bytes, length, &plain), GRAZE_OK);
    assert_int_equal(m.count, 1);
    assert_int_equal(m.sources[0].below, 1);
    assert_int_equal(m.sources[0].absent, MERL_CELLS - 2);
    assert_true(is_close(m.values[0], 1) && is_close(m.values[1], 2.3) && is_close(m.values[2], 4.98));
    /* The half vector is all but the normal (0.0028 degrees), so both directions are 40.5 degrees away from it. */
    assert_true(fabs(m.pairs[0].l.z - cos(40.5 * pi / 180)) < 1e-4 &&
                fabs(m.pairs[0].v.z - cos(40.5 * pi / 180)) < 1e-4);
    assert_true(fabs(atan2(m.pairs[0].l.y, m.pairs[0].l.x) - 45.5 * pi / 180) < 1e-3);
    fit_measurements_free(&m);
    assert_int_equal(read_written(&m, bytes, length - 1, &plain), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, "has 34992011 bytes, but a MERL table has 34992012"));
    fit_measurements_free(&m);
    put_merl(bytes, 0, 5, 5, 5, NAN);
    assert_int_equal(read_written(&m, bytes, length, &plain), GRAZE_INPUT_ERROR);
    fit_measurements_free(&m);
    free(bytes);
}

/* Each is refused with a message that names the place. */
static void malformed(void **state) {
    (void)state;
    static const struct {
        const char *text, *message;
        fit_format format;
    } cases[] = {
        {"", "there is no table in it", FIT_FORMAT_ANY},
        {"# only a comment\n\n", "there is no table in it", FIT_FORMAT_ANY},
        {"30 10 40 200 .25\n", ":1: the columns have no names", FIT_FORMAT_ANY},
        {"theta_i,phi_i,phi_o,f\n1,2,3,4\n", "do not tell two directions", FIT_FORMAT_ANY},
        {"theta_i,theta_o,theta_l,f\n1,2,3,4\n", "tells what an earlier one does", FIT_FORMAT_ANY},
        {"theta_i,theta_o\n1,2\n", "there are no values", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n100,10,1\n", "no measurement of two directions", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,2\n", ":2:4: the line ends where the f is expected", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,2,3,4\n", ":2:7: expected the line's end, not '4'", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1, two,3\n", ":2:4: expected a finite number, the theta_o, not 'two'", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,,3\n", ":2:3: expected a finite number", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,2,nan\n", ":2:5: expected a finite number", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,2,1e999\n", ":2:5: expected a finite number", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f,weight\n1,2,3,0\n", ":2: weights and deviations must be positive", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f,sigma\n1,2,3,-1\n", ":2: weights and deviations must be positive", FIT_FORMAT_ANY},
        {"3\n400 500\n", "the file ends before its data", FIT_FORMAT_ANY},
        {"0\n", "number of wavelengths must be", FIT_FORMAT_ANY},
        {"1e9\n", "number of wavelengths must be", FIT_FORMAT_ANY},
        {"1.5\n400\n", "number of wavelengths must be", FIT_FORMAT_ANY},
        {"1\nblue\n", ":2:1: expected a wavelength, not 'blue'", FIT_FORMAT_ANY},
        {"1\n400\n.1 .2 .3\n", ":3:9: the line ends where the scattered azimuth", FIT_FORMAT_ANY},
        {"1\n400\n.1 .2 .3 .4 .5 .6\n", ":3:16: expected the line's end", FIT_FORMAT_ANY},
        {"1\n400\n", "there are no lines of data", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n", "there are no lines of data", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\r30,40,1\r", "there are no lines of data", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1e9,2,1\n", ":2:1: expected a polar angle of at most 180 degrees", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f\n1,-181,1\n", ":2:3: expected a polar angle of at most 180 degrees", FIT_FORMAT_ANY},
        {"theta_i,phi_i,theta_o,phi_o,f\n1,2,3,361,1\n",
         ":2:7: expected an azimuth of at most 360 degrees in size, not '361'", FIT_FORMAT_ANY},
        {"theta_i,theta_o,dphi,f\n1,2,-361,1\n", ":2:5: expected an azimuth", FIT_FORMAT_ANY},
        {"1\n400\n3.15 .2 .3 .4 .5\n", ":3:1: expected a polar angle of at most pi radians", FIT_FORMAT_ANY},
        {"1\n400\n.1 .2 .3 6.3 .5\n", ":3:10: expected an azimuth of at most 2 pi radians", FIT_FORMAT_ANY},
        {"#DIM 3 1\n#PARAM_IN RUSIN_TH_TD_PD\n.3 .2 -7 1\n", ":3:7: expected an azimuth", FIT_FORMAT_ANY},
        {"#DIM 3 1\n#PARAM_IN ISOTROPIC_TV_TL_DPHI\n.3 4 0 1\n", ":3:4: expected a polar", FIT_FORMAT_ANY},
        {"#intheta 200\n", ":1:10: expected a polar angle", FIT_FORMAT_ANY},
        {"#incident_angle 30 400\n", ":1:20: expected an azimuth", FIT_FORMAT_ANY},
        {"#intheta 30\n#inphi 0\n1 -400 3\n", ":3:3: expected an azimuth", FIT_FORMAT_ANY},
        {"", "the file ends before its data", FIT_FORMAT_CORNELL},
        {"#DIM 3 1\n#PARAM_IN COS_TH\n1 1\n", ":2:11: expected SPHERICAL", FIT_FORMAT_ANY},
        {"#DIM 3 1\n#PARAM_IN CARTESIAN\n1 1\n", "has 6 inputs, but #DIM says 3", FIT_FORMAT_ANY},
        {"#PARAM_IN CARTESIAN\n1 1\n", ":1: #PARAM_IN must come behind #DIM", FIT_FORMAT_ANY},
        {"#DIM 7 1\n", "#DIM must be", FIT_FORMAT_ANY},
        {"#DIM 3 1e9\n", "#DIM must be", FIT_FORMAT_ANY},
        {"#DIM 3\n", ":1:7: the line ends", FIT_FORMAT_ANY},
        {"#DIM 6 1\n1 2 3 4 5 6 7\n", ":2: data before #DIM and #PARAM_IN", FIT_FORMAT_ANY},
        {"#DIM 6 1\n#PARAM_IN CARTESIAN\n#PARAM_OUT ENERGY\n", ":3:12: expected INV_STERADIAN", FIT_FORMAT_ANY},
        {"#DIM 6 1\n#FORMAT binary\n", "binary files cannot be read", FIT_FORMAT_ANY},
        {"#DIM 6 1\n#PARAM_IN CARTESIAN\n1 2 3\n", ":3:6: the line ends", FIT_FORMAT_ANY},
        {"#intheta 30\n#format: theta phi DSF\n1 2 3\n", ":3: data before the incident direction", FIT_FORMAT_ANY},
        {"#intheta x\n", ":1:10: expected a finite number", FIT_FORMAT_ANY},
        {"#intheta 30\n#inphi 0\n#format: theta phi FOO\n", ":3:20: expected values of a kind", FIT_FORMAT_ANY},
        {"#intheta 30\n#inphi 0\n#format: phi theta DSF\n", ":3: expected 'format: theta phi'", FIT_FORMAT_ANY},
        {"#intheta 30\n#inphi 0\n1 2\n", ":3:4: the line ends", FIT_FORMAT_ANY},
        {"#intheta 30\n#inphi 0\n1 2 3 4\n", ":3:7: expected the line's end", FIT_FORMAT_ANY},
        {"#DIM 3 1\n#PARAM_IN RUSIN_TH_TD_PD\n#DIM 3 2\n", ":3: a second #DIM", FIT_FORMAT_ANY},
        {"theta_i", "is no MERL table", FIT_FORMAT_MERL},
        {"theta_i,theta_o,f\n1,2,-1.01e50\n", ":2: a value of -1.01e+50 is out of range: a BRDF is at most 1e+50",
         FIT_FORMAT_ANY},
        {"theta_i,theta_o,f,weight\n1,2,3,1e51\n", ":2: a weight of 1e+51 is out of range", FIT_FORMAT_ANY},
        {"theta_i,theta_o,f,weight\n1,2,3,1e-51\n", ":2: a weight of 1e-51 is out of range", FIT_FORMAT_ANY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fit_measurements m = {0};
        const fit_read_options o = {.conventions = {.format = cases[i].format}};
        graze_status status = read_text(&m, cases[i].text, &o);
        fit_measurements_free(&m);
        if (status != GRAZE_INPUT_ERROR || !strstr(messages, cases[i].message) || !strstr(messages, measured_name))
            fail_msg("case %zu, '%s': status %d, %s", i, cases[i].text, (int)status, messages);
    }
}

/* Any beginning of a good file, and any byte changed, is read or refused, never worse. */
static void damaged(void **state) {
    (void)state;
    static const char *const texts[] = {
        "# c\ntheta_i, phi_i,theta_o,\"phi_o\",R,G,sigma\n30,10,40,200,.25,.5,1\n30,10,41,200,.2,.4,1\n",
        "# c\n2\n400 500\n.1 .2 .3 .4 .5 .6\n.2 .2 .3 .4 .5 .6\n",
        "#DIM 3 1\n#PARAM_IN RUSIN_TH_TD_PD\n#PARAM_OUT INV_STERADIAN\n#VS 0\n.3 .2 0 1\n",
        "#intheta 30\n#inphi 0\n#colorimetry: CIE-XYZ\n#format: theta phi DSF\n10 180 1 2 3\n",
    };
    static const char changes[] = {0, '\n', ' ', ',', '#', '-', '9', '\x80', '"', 'e'};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        char text[256];
        size_t length = strlen(texts[i]);
        for (size_t at = 0; at < length; at++)
            for (size_t c = 0; c <= sizeof changes; c++) {
                fit_measurements m = {0};
                memcpy(text, texts[i], length);
                if (c < sizeof changes)
                    text[at] = changes[c];
                graze_status status = read_written(&m, text, c < sizeof changes ? length : at, &plain);
                assert_true(status == GRAZE_OK ? m.count > 0 : strstr(messages, "error: ") != NULL);
                for (size_t k = 0; k < m.count * m.channel_count; k++)
                    assert_true(isfinite(m.values[k]));
                fit_measurements_free(&m);
            }
    }
}

static void files_that_are_not_there(void **state) {
    (void)state;
    fit_measurements m = {0};
    messages[0] = 0;
    assert_int_equal(fit_read(&m, "/nonexistent/file", &plain, &remembering), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, "/nonexistent/file: cannot open it: "));
    fit_measurements_free(&m);
    assert_int_equal(fit_read(&m, "/tmp", &plain, &remembering), GRAZE_INPUT_ERROR);
    fit_measurements_free(&m);
    const fit_read_options wanted = {.channels = "f,g"};
    assert_int_equal(read_text(&m, "theta_i,theta_o,f\n1,2,3\n", &wanted), GRAZE_INPUT_ERROR);
    assert_non_null(strstr(messages, "there is no channel 'g'"));
    fit_measurements_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_of_columns),
        cmocka_unit_test(tables_with_more),
        cmocka_unit_test(conventions_told),
        cmocka_unit_test(unlikely_units),
        cmocka_unit_test(cornell),
        cmocka_unit_test(alta),
        cmocka_unit_test(pab),
        cmocka_unit_test(merl),
        cmocka_unit_test(malformed),
        cmocka_unit_test(damaged),
        cmocka_unit_test(files_that_are_not_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
