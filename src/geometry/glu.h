/* GLU's tessellator, opened only when a polygon needs it: so that Graze runs where no OpenGL is installed. */
#ifndef GEOMETRY_GLU_H
#define GEOMETRY_GLU_H

#include <GL/glu.h>

/* GLU's functions, by their own prototypes. */
typedef struct geometry_glu {
    char trouble[256]; /* why there are none, or "" */
    __typeof__(gluNewTess) *new_tess;
    __typeof__(gluDeleteTess) *delete_tess;
    __typeof__(gluTessCallback) *callback;
    __typeof__(gluTessProperty) *property;
    __typeof__(gluTessNormal) *normal;
    __typeof__(gluTessBeginPolygon) *begin_polygon;
    __typeof__(gluTessBeginContour) *begin_contour;
    __typeof__(gluTessVertex) *vertex;
    __typeof__(gluTessEndContour) *end_contour;
    __typeof__(gluTessEndPolygon) *end_polygon;
    __typeof__(gluErrorString) *error_string;
} geometry_glu;

/* Opens GLU at the first call, from any thread. */
const geometry_glu *geometry_glu_open(void);

#endif
