/* A group as Embree has it. */
#ifndef GEOMETRY_EMBREE_SCENE_H
#define GEOMETRY_EMBREE_SCENE_H

#include "geometry/survey.h"

/* Embree's part of a group's tree that has been surveyed, and has room for its triangles and curved surfaces. */
graze_status geometry_scene_build(geometry *, geometry_survey *, int threads, const graze_report *);

#endif
