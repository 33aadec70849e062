/* What the files that prepare vertices share, each for some kinds of materials. */
#ifndef TRACE_APPEARANCE_KINDS_H
#define TRACE_APPEARANCE_KINDS_H

#include "trace/encounter.h"

/* True as often as this share says, of one path's random numbers. */
bool appearance_draw(const path *, double share);

/* Prepares a vertex for SCENE_WGMD, `before` being what mixtures and meshes do to it: one surface where both its parts
 * have the same normal, as they mostly do; else one of them is drawn, for both. */
void appearance_prepare_wgmd(const path *, const path_hit *, const encounter *, const scene_material *,
                             material_effect before, vertex *);

/* Prepares a vertex for SCENE_PRISM; of two ways on, one is drawn. */
void appearance_prepare_prism(const path *, const path_hit *, const encounter *, const material_prism *, vertex *);

#endif
