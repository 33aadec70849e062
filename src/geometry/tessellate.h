/* Cuts polygons into triangles. */
#ifndef GEOMETRY_TESSELLATE_H
#define GEOMETRY_TESSELLATE_H

#include "base/arena.h"
#include "base/report.h"
#include "geometry/shape.h"

/* Fills in the triangles of a polygon whose outline, normal and center are known, and puts further vertices behind the
 * outline where outlines cross. Inside is what an odd number of outlines surrounds. Triangles without area are left
 * out, so there may be none. */
graze_status shape_tessellate(shape *polygon, arena *, const rad_primitive *, const graze_report *);

#endif
