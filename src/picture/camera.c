/* Rays through a lens: the eye is a disk, and all of its rays through a pixel meet where the view is in focus. */
#include "picture/camera.h"

#include "base/angle.h"

const camera_sample camera_center = {0.5, 0.5, {0.5, 0.5}, 0};

/* Distances of clipping surfaces and of the focus are measured along the axis of flat views, away from the axis of a
 * cylinder, and along the ray in all others: how much further it is along the ray. */
static double stretch(const rad_view *v, vec3 direction) {
    double across;
    switch (v->type) {
    case 'v':
    case 'l':
        across = vec3_dot(direction, v->axis);
        break;
    case 'c': {
        vec3 along = vec3_normalize(v->above);
        across = vec3_length(vec3_add_scaled(direction, -vec3_dot(direction, along), along));
        break;
    }
    default:
        return 1;
    }
    return across > 0 ? 1 / across : 1;
}

/* A square to a disk of radius 1, area by area (Shirley and Chiu's map), so that well spread points stay so. */
static void square_to_disk(const double square[2], double disk[2]) {
    double a = 2 * square[0] - 1, b = 2 * square[1] - 1, radius, angle;
    if (a == 0 && b == 0) {
        disk[0] = disk[1] = 0;
        return;
    }
    if (fabs(a) > fabs(b)) {
        radius = a;
        angle = PI / 4 * (b / a);
    } else {
        radius = b;
        angle = PI / 2 - PI / 4 * (a / b);
    }
    disk[0] = radius * cos(angle);
    disk[1] = radius * sin(angle);
}

/* A point of the lens, from its middle. It lies in the plane of flat views, else across the ray. */
static vec3 lens_point(const picture_settings *s, vec3 direction, const double square[2]) {
    const rad_view *v = &s->view;
    double disk[2];
    square_to_disk(square, disk);
    bool flat = v->type == 'v' || v->type == 'l';
    frame f = flat ? (frame){vec3_normalize(v->right), vec3_normalize(v->above), v->axis} : frame_around(direction);
    return frame_to_world(&f, vec3_scale(s->aperture / 2, (vec3){disk[0], disk[1], 0}));
}

/* Moves the ray's beginning on the lens, keeping its point in focus. */
static void through_lens(const picture_settings *s, const double square[2], graze_ray *ray) {
    const rad_view *v = &s->view;
    double far = stretch(v, ray->direction);
    vec3 eye = vec3_add_scaled(ray->origin, -v->fore * far, ray->direction);
    vec3 focus = vec3_add_scaled(eye, vec3_safe_length(v->direction) * far, ray->direction);
    vec3 lens = vec3_add(eye, lens_point(s, ray->direction, square));
    vec3 direction = vec3_safe_normalize(vec3_subtract(focus, lens));
    double now = stretch(v, direction);
    ray->origin = vec3_add_scaled(lens, v->fore * now, direction);
    ray->limit *= now / far;
    ray->direction = direction;
}

static vec3 between(vec3 a, vec3 b, double part) {
    return vec3_add(vec3_scale(1 - part, a), vec3_scale(part, b));
}

/* Moves the ray towards where it was in the frame before, or as far beyond. */
static void at_time(const rad_view *previous, double x, double y, double part, graze_ray *ray) {
    graze_ray was;
    if (!rad_view_ray(previous, x, y, &was.origin, &was.direction, &was.limit))
        return;
    vec3 direction = vec3_normalize(between(ray->direction, was.direction, part));
    if (vec3_max_abs(direction) == 0)
        return;
    ray->origin = between(ray->origin, was.origin, part);
    ray->direction = direction;
}

bool camera_ray(const picture_settings *s, int column, int row, const camera_sample *sample, graze_ray *ray) {
    double x = (column + sample->x) / s->width, y = (s->height - 1 - row + sample->y) / s->height;
    if (!rad_view_ray(&s->view, x, y, &ray->origin, &ray->direction, &ray->limit))
        return false;
    if (s->shutter > 0)
        at_time(&s->previous, x, y, s->shutter * sample->time, ray);
    if (s->aperture > 0)
        through_lens(s, sample->lens, ray);
    return true;
}
