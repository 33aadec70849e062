/* Which measurements lie in the plane of incidence, and which of them belong together. */
#include "tools/brdffit/plane.h"

#include <math.h>
#include <stdlib.h>

#include "base/angle.h"
#include "base/vector.h"

/* A view may be so far out of the plane, in degrees; and incident directions that differ by less are one panel's. */
#define OUT_OF_PLANE 2.5
#define PANEL_WIDTH  1.0

graze_vec3 plane_light(const plane_point *p) {
    double t = angle_radians(p->polar), a = angle_radians(p->azimuth);
    return vec3_make(sin(t) * cos(a), sin(t) * sin(a), cos(t));
}

graze_vec3 plane_view(const plane_point *p, double view) {
    double t = angle_radians(view), a = angle_radians(p->azimuth);
    return vec3_make(-sin(t) * cos(a), -sin(t) * sin(a), cos(t));
}

/* Light from above makes every view one of the plane, of the plane through x for the sign. */
static bool make_point(plane_point *p, const fit_pair *pair, size_t index) {
    double polar = angle_degrees(acos(fmin(pair->l.z, 1)));
    bool above = polar < PANEL_WIDTH / 2;
    double azimuth = above ? PI : atan2(pair->l.y, pair->l.x), c = cos(azimuth), s = sin(azimuth);
    double along = -pair->v.x * c - pair->v.y * s, across = pair->v.x * s - pair->v.y * c;
    if (above)
        along = copysign(hypot(along, across), along);
    else if (fabs(across) > sin(angle_radians(OUT_OF_PLANE)))
        return false;
    *p = (plane_point){polar, above ? 180 : angle_degrees(azimuth), angle_degrees(atan2(along, pair->v.z)), index};
    return true;
}

static int compare(double a, double b) {
    return a < b ? -1 : a > b;
}

static int by_polar(const void *a, const void *b) {
    const plane_point *p = a, *q = b;
    int order = compare(p->polar, q->polar);
    return order ? order : compare((double)p->pair, (double)q->pair);
}

static int by_azimuth_then_polar(const void *a, const void *b) {
    const plane_point *p = a, *q = b;
    int order = compare(floor(p->azimuth / PANEL_WIDTH + .5), floor(q->azimuth / PANEL_WIDTH + .5));
    return order ? order : by_polar(a, b);
}

static int by_view(const void *a, const void *b) {
    const plane_point *p = a, *q = b;
    int order = compare(p->view, q->view);
    return order ? order : compare((double)p->pair, (double)q->pair);
}

static bool belongs(const plane_point *first, const plane_point *p, bool by_azimuth) {
    return p->polar - first->polar <= PANEL_WIDTH && p->polar >= first->polar &&
           (!by_azimuth || fabs(p->azimuth - first->azimuth) <= PANEL_WIDTH);
}

graze_status plane_create(plane *all, const fit_measurements *m, bool by_azimuth, const graze_report *report) {
    all->points = calloc(m->count + 1, sizeof *all->points);
    all->panels = calloc(m->count + 1, sizeof *all->panels);
    all->point_count = all->panel_count = 0;
    if (!all->points || !all->panels)
        return report_out_of_memory(report);
    for (size_t i = 0; i < m->count; i++)
        all->point_count += make_point(&all->points[all->point_count], &m->pairs[i], i);
    qsort(all->points, all->point_count, sizeof *all->points, by_azimuth ? by_azimuth_then_polar : by_polar);
    for (size_t first = 0, end; first < all->point_count; first = end) {
        for (end = first; end < all->point_count && belongs(&all->points[first], &all->points[end], by_azimuth);)
            end++;
        if (end - first < 3)
            continue;
        all->panels[all->panel_count++] = (plane_panel){first, end - first};
    }
    for (size_t i = 0; i < all->panel_count; i++)
        qsort(all->points + all->panels[i].first, all->panels[i].count, sizeof *all->points, by_view);
    return GRAZE_OK;
}

void plane_free(plane *all) {
    free(all->points);
    free(all->panels);
    *all = (plane){0};
}
