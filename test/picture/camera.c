/* Rays of the lens and the shutter, against the geometry of views. */
#include "picture/support.h"

#include "picture/camera.h"

static const char types[] = "vlchas";

static picture_settings settings_of(char type) {
    picture_settings s = room_settings();
    s.view.type = type;
    s.view.direction = (vec3){0.5, 2, -0.3};
    s.view.horizontal = type == 'l' ? 3 : 70;
    s.view.vertical = type == 'l' ? 2 : 50;
    s.view.shift = 0.2;
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    return s;
}

static graze_ray ray_at(const picture_settings *s, int column, int row, double u, double v) {
    graze_ray ray;
    camera_sample sample = camera_center;
    sample.lens[0] = u;
    sample.lens[1] = v;
    assert_true(camera_ray(s, column, row, &sample, &ray));
    assert_true(fabs(vec3_length(ray.direction) - 1) < 1e-14);
    return ray;
}

static void assert_near(vec3 a, vec3 b, double tolerance) {
    if (!(vec3_length(vec3_subtract(a, b)) <= tolerance))
        fail_msg("(%.17g %.17g %.17g) is not (%.17g %.17g %.17g)", a.x, a.y, a.z, b.x, b.y, b.z);
}

/* Where the middle of the lens has its point in focus: on a plane for flat views, on a cylinder, or on a sphere. */
static vec3 in_focus(const picture_settings *s, const graze_ray *ray) {
    double distance = vec3_length(s->view.direction);
    if (s->view.type == 'v' || s->view.type == 'l')
        distance /= vec3_dot(ray->direction, s->view.axis);
    if (s->view.type == 'c') {
        vec3 up = vec3_normalize(s->view.above);
        double rise = vec3_dot(ray->direction, up);
        distance /= sqrt(1 - rise * rise);
    }
    return vec3_add_scaled(ray->origin, distance, ray->direction);
}

static void all_of_the_lens_sees_the_point_in_focus(void **state) {
    (void)state;
    for (const char *t = types; *t; t++) {
        picture_settings s = settings_of(*t);
        s.aperture = 0.4;
        for (int i = 0; i < 40; i++) {
            int column = 7 + i % 5 * 6, row = 5 + i / 5 * 2;
            graze_ray middle = ray_at(&s, column, row, 0.5, 0.5);
            graze_ray ray = ray_at(&s, column, row, (i * 7 % 40 + 0.5) / 40, (i * 11 % 40 + 0.5) / 40);
            vec3 focus = in_focus(&s, &middle), offset = vec3_subtract(ray.origin, middle.origin);
            assert_true(vec3_length(offset) <= 0.2);
            if (*t == 'v' || *t == 'l')
                assert_true(fabs(vec3_dot(offset, s.view.axis)) < 1e-14);
            assert_near(vec3_normalize(vec3_subtract(focus, ray.origin)), ray.direction, 1e-14);
        }
    }
}

/* Equal areas of the lens have equal chances: of the numbers, 0.6^2 are within 0.6 of its radius. */
static void the_lens_is_a_disk(void **state) {
    (void)state;
    picture_settings s = settings_of('v');
    s.aperture = 2;
    int inside = 0;
    double most = 0;
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < 100; i++)
        for (int k = 0; k < 100; k++) {
            graze_ray ray = ray_at(&s, 20, 15, (i + 0.5) / 100, (k + 0.5) / 100);
            vec3 offset = vec3_subtract(ray.origin, s.view.point);
            double length = vec3_length(offset);
            inside += length < 0.6;
            most = fmax(most, length);
            sum = vec3_add(sum, offset);
        }
    assert_true(most <= 1 && most > 0.99);
    assert_int_equal(inside, 3600);
    assert_near(sum, (vec3){0, 0, 0}, 1e-9);
}

/* Rays begin on the fore plane and end on the aft plane wherever they come from on the lens. */
static void clipping_planes_stay_where_they_are(void **state) {
    (void)state;
    static const char flat[] = "vl";
    for (const char *t = flat; *t; t++) {
        picture_settings s = settings_of(*t);
        s.view.fore = 0.5;
        s.view.aft = 3;
        s.aperture = 0.4;
        for (int i = 0; i < 40; i++) {
            graze_ray ray = ray_at(&s, i, 3, (i * 7 % 40 + 0.5) / 40, (i * 11 % 40 + 0.5) / 40);
            vec3 end = vec3_add_scaled(ray.origin, ray.limit, ray.direction);
            assert_true(fabs(vec3_dot(vec3_subtract(ray.origin, s.view.point), s.view.axis) - 0.5) < 1e-12);
            assert_true(fabs(vec3_dot(vec3_subtract(end, s.view.point), s.view.axis) - 3) < 1e-12);
        }
    }
}

/* A quarter of the way to where the eye was; and as far beyond, on the other side of the exposure. */
static void the_shutter_follows_the_eye(void **state) {
    (void)state;
    picture_settings s = settings_of('v');
    s.previous = s.view;
    s.previous.point = vec3_add(s.view.point, (vec3){1, 2, 4});
    s.shutter = 0.5;
    graze_ray still, early, late;
    camera_sample sample = camera_center;
    assert_true(camera_ray(&s, 3, 4, &sample, &still));
    sample.time = 0.5;
    assert_true(camera_ray(&s, 3, 4, &sample, &early));
    sample.time = -0.5;
    assert_true(camera_ray(&s, 3, 4, &sample, &late));
    assert_near(still.origin, s.view.point, 0);
    assert_near(early.origin, vec3_add(s.view.point, (vec3){0.25, 0.5, 1}), 1e-14);
    assert_near(late.origin, vec3_subtract(s.view.point, (vec3){0.25, 0.5, 1}), 1e-14);
    assert_near(early.direction, still.direction, 1e-14);
}

static void corners_of_a_fisheye_have_no_rays(void **state) {
    (void)state;
    picture_settings s = settings_of('h');
    s.view.horizontal = s.view.vertical = 180;
    s.view.shift = 0;
    assert_int_equal(rad_view_prepare(&s.view, NULL, NULL), GRAZE_OK);
    graze_ray ray;
    assert_false(camera_ray(&s, 0, 0, &camera_center, &ray));
    assert_true(camera_ray(&s, 20, 15, &camera_center, &ray));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_of_the_lens_sees_the_point_in_focus), cmocka_unit_test(the_lens_is_a_disk),
        cmocka_unit_test(clipping_planes_stay_where_they_are),     cmocka_unit_test(the_shutter_follows_the_eye),
        cmocka_unit_test(corners_of_a_fisheye_have_no_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
