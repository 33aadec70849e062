/* Views: options, files, mistakes, rays of every type. */
#include "support.h"

#include "rad/view.h"

/* A view from words as they stand on a command line. */
static rad_view view_of(const char *text) {
    char copy[512];
    const char *words[64];
    int count = 0, used;
    snprintf(copy, sizeof copy, "%s", text);
    for (char *word = strtok(copy, " "); word; word = strtok(NULL, " "))
        words[count++] = word;
    rad_view v = rad_view_default();
    for (int i = 0; i < count; i += used) {
        assert_int_equal(rad_view_option(&v, count - i, words + i, &used, NULL, NULL), GRAZE_OK);
        assert_true(used > 0);
    }
    return v;
}

static rad_view prepared(const char *text) {
    rad_view v = view_of(text);
    assert_int_equal(rad_view_prepare(&v, NULL, NULL), GRAZE_OK);
    return v;
}

typedef struct ray {
    vec3 origin, direction;
    double limit;
} ray;

static ray ray_at(const rad_view *v, double x, double y) {
    ray r;
    assert_true(rad_view_ray(v, x, y, &r.origin, &r.direction, &r.limit));
    assert_true(fabs(vec3_length(r.direction) - 1) < 1e-14);
    return r;
}

static void assert_near(vec3 a, vec3 b) {
    assert_true(vec3_max_abs(vec3_subtract(a, b)) < 1e-14);
}

static const double sqrt_half = 0.70710678118654752440;

static void centre_and_edges(void **state) {
    (void)state;
    /* Looking along +y with z up, right is +x: the middle of the right edge of views 90 degrees wide. */
    static const struct {
        const char *options;
        vec3 right;
    } cases[] = {
        {"-vtv -vh 90 -vv 90", {0.70710678118654752440, 0.70710678118654752440, 0}},
        {"-vtc -vh 180 -vv 90", {1, 0, 0}},
        {"-vth -vh 180 -vv 180", {1, 0, 0}},
        {"-vta -vh 180 -vv 180", {1, 0, 0}},
        {"-vta -vh 270 -vv 270", {0.70710678118654752440, -0.70710678118654752440, 0}},
        {"-vts -vh 180 -vv 180", {1, 0, 0}},
        {"-vtl -vh 2 -vv 2", {0, 1, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rad_view v = prepared(cases[i].options);
        ray centre = ray_at(&v, .5, .5), right = ray_at(&v, 1, .5);
        assert_near(centre.direction, vec3_make(0, 1, 0));
        assert_near(right.direction, cases[i].right);
        assert_near(right.origin, v.type == 'l' ? vec3_make(1, 0, 0) : vec3_make(0, 0, 0));
        assert_true(centre.limit == 0);
    }
}

static void shift_and_lift(void **state) {
    (void)state;
    rad_view plain = prepared("-vh 40 -vv 30"), moved = prepared("-vh 40 -vv 30 -vs .25 -vl -1.5");
    assert_near(ray_at(&moved, .3, .8).direction, ray_at(&plain, .55, -.7).direction);
}

static void fisheyes_end(void **state) {
    (void)state;
    vec3 origin, direction;
    double limit;
    rad_view h = prepared("-vth -vh 180 -vv 180"), a = prepared("-vta -vh 360 -vv 360");
    assert_false(rad_view_ray(&h, .99, .99, &origin, &direction, &limit));
    assert_false(rad_view_ray(&a, .01, .99, &origin, &direction, &limit));
    assert_true(rad_view_ray(&a, .01, .5, &origin, &direction, &limit));
    assert_true(rad_view_ray(&h, .5, 1, &origin, &direction, &limit));
}

static void clipping(void **state) {
    (void)state;
    rad_view v = prepared("-vh 90 -vv 90 -vo 2 -va 5 -vp 1 1 1");
    ray edge = ray_at(&v, 1, .5);
    assert_near(edge.origin, vec3_make(3, 3, 1));
    assert_true(fabs(edge.limit - 3 / sqrt_half) < 1e-14);
    v = prepared("-vta -vh 180 -vv 180 -vo 2 -va 5");
    edge = ray_at(&v, 1, .5);
    assert_near(edge.origin, vec3_make(2, 0, 0));
    assert_true(edge.limit == 3);
    v = prepared("-vtl -vo 2");
    assert_near(ray_at(&v, .5, .5).origin, vec3_make(0, 2, 0));
    assert_true(ray_at(&v, .5, .5).limit == 0);
}

static void printing(void **state) {
    (void)state;
    char text[512];
    rad_view v = prepared("-vp 1.23456789 0 -1e-9 -vd 0 3 4 -vu 0 0 7 -vh 33.333333 -vtl -vs .1 -va 7");
    assert_near(v.axis, vec3_make(0, .6, .8));
    rad_view_print(&v, text, sizeof text);
    assert_string_equal(text,
                        " -vtl -vp 1.234568 0 -1e-09 -vd 0 3 4 -vu 0 0 1 -vh 33.333 -vv 45 -vo 0 -va 7 -vs 0.1 -vl 0");
    v = rad_view_default();
    rad_view_print(&v, text, sizeof text);
    assert_string_equal(text, " -vtv -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 45 -vv 45 -vo 0 -va 0 -vs 0 -vl 0");
}

static void bad_views(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"-vd 0 0 0", "zero view direction"},
        {"-vu 0 0 0", "zero view up vector"},
        {"-vd 0 0 -2", "view up parallel to view direction"},
        {"-vd 1 2 3 -vu .1 .2 .3", "view up parallel to view direction"},
        {"-vh 180", "illegal horizontal view size"},
        {"-vv 180", "illegal vertical view size"},
        {"-vh 0", "illegal horizontal view size"},
        {"-vv -4", "illegal vertical view size"},
        {"-vtc -vh 361", "illegal horizontal view size"},
        {"-vtc -vv 180", "illegal vertical view size"},
        {"-vth -vh 181", "illegal horizontal view size"},
        {"-vta -vv 361", "illegal vertical view size"},
        {"-vts -vh 360", "illegal horizontal view size"},
        {"-vtl -vv 0", "illegal vertical view size"},
        {"-vtx", "unknown view type"},
        {"-vo -1", "illegal fore/aft clipping plane"},
        {"-va -1", "illegal fore/aft clipping plane"},
        {"-vo 3 -va 2", "illegal fore/aft clipping plane"},
        {"-vp 1e200 0 0", "view parameter out of range"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rad_view v = view_of(cases[i][0]);
        messages m;
        graze_report report = messages_report(&m);
        assert_int_equal(rad_view_prepare(&v, NULL, &report), GRAZE_INPUT_ERROR);
        assert_contains(m.text, cases[i][1]);
    }
    prepared("-vd 1e-200 0 0");
    prepared("-vtc -vh 360");
    prepared("-vta -vh 360 -vv 360");
    prepared("-vd 1e90 1e90 1e90");
}

static void bad_options(void **state) {
    (void)state;
    static const struct {
        const char *words[3];
        int count;
        const char *message; /* null: no view option */
    } cases[] = {
        {{"-vp", "1", "2"}, 3, "option '-vp': 1 number missing"},
        {{"-vh"}, 1, "option '-vh': 1 number missing"},
        {{"-vh", "wide"}, 2, "option '-vh': 'wide' is not a number"},
        {{"-vh", "nan"}, 2, "is not a number"},
        {{"-vt"}, 1, "one letter"},
        {{"-vtvv"}, 1, "one letter"},
        {{"-vf", "x"}, 2, NULL},
        {{"-vx", "1"}, 2, NULL},
        {{"-vhh", "1"}, 2, NULL},
        {{"-v"}, 1, NULL},
        {{"-version"}, 1, NULL},
        {{"vp", "1", "2"}, 3, NULL},
        {{""}, 1, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        rad_view v = rad_view_default(), before = v;
        messages m;
        graze_report report = messages_report(&m);
        int used = -1;
        graze_status status = rad_view_option(&v, cases[i].count, cases[i].words, &used, NULL, &report);
        assert_int_equal(used, 0);
        assert_int_equal(status, cases[i].message ? GRAZE_INPUT_ERROR : GRAZE_OK);
        assert_contains(m.text, cases[i].message ? cases[i].message : "");
        assert_memory_equal(&v, &before, sizeof v);
    }
}

static void view_files(void **state) {
    (void)state;
    static const char picture[] =
        "#?RADIANCE\nrpict -vf other.vf -vp 9 9 9 -vs .5 -ab 2 room.oct\n\tVIEW= -vp 8 8 8\n"
        "/usr/bin/rvu -vl 2 -vh x\nVIEW= -vtl -vp 1 2 3 -vh 5 nonsense -vu 0 1\r\nSOFTWARE= VIEW= -vv 3\n"
        "FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\0\nVIEW= -vp 7 7 7\n";
    write_bytes("picture.hdr", picture, sizeof picture - 1);
    rad_view v = view_of("-va 11 -vs 0");
    assert_int_equal(rad_view_read(&v, "picture.hdr", NULL), GRAZE_OK);
    char text[512];
    rad_view_print(&v, text, sizeof text);
    assert_string_equal(text, " -vtl -vp 1 2 3 -vd 0 1 0 -vu 0 0 1 -vh 5 -vv 45 -vo 0 -va 11 -vs 0.5 -vl 2");

    messages m;
    graze_report report = messages_report(&m);
    assert_int_equal(rad_view_read(&v, "missing.vf", &report), GRAZE_INPUT_ERROR);
    assert_int_equal(rad_view_read(&v, ".", &report), GRAZE_INPUT_ERROR);
    write_file("no.vf", "VIEW= nothing\n\nVIEW= -vp 1 1 1\n");
    assert_int_equal(rad_view_read(&v, "no.vf", &report), GRAZE_INPUT_ERROR);
    assert_contains(m.text, "no view in no.vf");
    write_file("short.vf", "VIEW= -vd 1 0 0");
    assert_int_equal(rad_view_read(&v, "short.vf", &report), GRAZE_OK);
    assert_true(v.direction.x == 1);
}

static void view_lines(void **state) {
    (void)state;
    static const struct {
        const char *line;
        bool found;
        const char *message; /* null: none */
    } cases[] = {
        {"VIEW= -vp 1 2 3", true, NULL},
        {"VIEW=-vp 1 2 3", true, NULL},
        {"/usr/bin/rvu -x 5 -vp 1 2 3 -vf other.vf", true, NULL},
        {"rpict -x 5", false, NULL},
        {"a view -vp 1 2 3", false, NULL},
        {"", false, NULL},
        {"VIEW= -vp 1 2 3 -vh wide", false, "stdin:3:17: option '-vh': 'wide' is not a number"},
        {"rvu -vp 1 2 3 -vh", false, "stdin:3:15: option '-vh': 1 number missing"},
        {"VIEW= -vp 1 2 3 -vq", false, "stdin:3:17: '-vq' is no view option"},
        {"VIEW= -vp 1 2 3 4", false, "stdin:3:17: '4' is no view option"},
        {"VIEW= ", false, "stdin:3: VIEW= without a view option"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        rad_view v = rad_view_default();
        messages m;
        graze_report report = messages_report(&m);
        bool found = !cases[i].found;
        graze_status status =
            rad_view_take_line(&v, cases[i].line, &found, &(place){.file = "stdin", .line = 3}, &report);
        assert_int_equal(status, cases[i].message ? GRAZE_INPUT_ERROR : GRAZE_OK);
        assert_contains(m.text, cases[i].message ? cases[i].message : "");
        assert_int_equal(found, cases[i].found);
        assert_true(v.point.z == (cases[i].found ? 3 : 0));
    }
}

static void view_files_of_anything(void **state) {
    (void)state;
    static const char *const pieces[] = {"VIEW=", " -vp", " -vt", "v", " 1", " -vh 3", "\n",
                                         "rpict", "/",    "\r",   " ", "\t", "1e999"};
    dice d = {3};
    int found = 0, good = 0, bad = 0;
    for (int round = 0; round < 2000; ++round) {
        char text[300] = "VIEW=";
        size_t length = 5;
        for (int n = (int)(roll_bits(&d) % 20); n > 0; --n) {
            const char *piece = pieces[roll_bits(&d) % (sizeof pieces / sizeof *pieces)];
            memcpy(text + length, piece, strlen(piece));
            length += strlen(piece);
            if (roll_bits(&d) % 64 == 0)
                text[length++] = (char)roll_bits(&d);
        }
        write_bytes("any.vf", text, length);
        rad_view v = rad_view_default();
        found += rad_view_read(&v, "any.vf", NULL) == GRAZE_OK;
        text[length] = 0;
        bool taken;
        graze_status status = rad_view_take_line(&v, text, &taken, NULL, NULL);
        good += taken;
        bad += status == GRAZE_INPUT_ERROR;
        assert_true(isfinite(v.point.x) && isfinite(v.horizontal));
    }
    assert_true(found > 100 && good > 10 && bad > 100);
}

static void fitting(void **state) {
    (void)state;
    rad_view v = prepared("-vtl -vh 4 -vv 1");
    assert_true(rad_view_aspect(&v) == .25);
    int width = 100, height = 100;
    double pixel_aspect = 1;
    rad_view_fit(&v, &pixel_aspect, &width, &height);
    assert_int_equal(width, 100);
    assert_int_equal(height, 25);
    width = 1000;
    height = 10;
    pixel_aspect = 2;
    rad_view_fit(&v, &pixel_aspect, &width, &height);
    assert_int_equal(width, 80);
    assert_int_equal(height, 10);
    width = 30;
    height = 60;
    pixel_aspect = 0;
    rad_view_fit(&v, &pixel_aspect, &width, &height);
    assert_true(width == 30 && height == 60 && pixel_aspect == .125);
    width = 0;
    pixel_aspect = 0;
    rad_view_fit(&v, &pixel_aspect, &width, &height);
    assert_true(width == 0 && pixel_aspect == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(centre_and_edges), cmocka_unit_test(shift_and_lift),
        cmocka_unit_test(fisheyes_end),     cmocka_unit_test(clipping),
        cmocka_unit_test(printing),         cmocka_unit_test(bad_views),
        cmocka_unit_test(bad_options),      cmocka_unit_test(view_files),
        cmocka_unit_test(view_lines),       cmocka_unit_test(view_files_of_anything),
        cmocka_unit_test(fitting),
    };
    return cmocka_run_group_tests(tests, enter_directory, leave_directory);
}
