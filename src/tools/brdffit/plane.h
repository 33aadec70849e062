/* The measurements in planes of incidence, sorted into panels of nearly the same incident direction. */
#ifndef TOOLS_BRDFFIT_PLANE_H
#define TOOLS_BRDFFIT_PLANE_H

#include "fit/measurements.h"

typedef struct plane_point {
    double polar, azimuth; /* of the incident direction, in degrees */
    double view;           /* the viewing angle in degrees: positive on the mirror's side */
    size_t pair;
} plane_point;

typedef struct plane_panel {
    size_t first, count; /* of its points */
} plane_panel;

typedef struct plane {
    plane_point *points; /* panel by panel, by viewing angle */
    size_t point_count;
    plane_panel *panels;
    size_t panel_count;
} plane;

/* Panels with three points or more. Incident azimuths count only where `by_azimuth` says so. */
graze_status plane_create(plane *, const fit_measurements *, bool by_azimuth, const graze_report *);
void plane_free(plane *);
/* The directions of a panel's incident light and of a view. */
graze_vec3 plane_light(const plane_point *);
graze_vec3 plane_view(const plane_point *, double view);

#endif
