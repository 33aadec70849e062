/* What the files that prepare vertices share, each for some kinds of materials. */
#ifndef TRACE_APPEARANCE_KINDS_H
#define TRACE_APPEARANCE_KINDS_H

#include "trace/encounter.h"

/* True as often as this share says, of one path's random numbers; one of so many, each as often. */
bool appearance_draw(const path *, double share);
int appearance_draw_of(const path *, int count);

/* The normal with a perturbation, on the viewer's side; tells the vertex whether it leans. */
vec3 appearance_lean(const path_hit *, const encounter *, const material_effect *, vertex *);

/* Where the viewer looks on straight through a surface of this perturbation, which is taken off the direction unless he
 * would then not get through. As in Radiance, light that is scattered beyond goes straight on, as light samples do,
 * unless the surface is rough. */
vec3 appearance_straight_on(const path *, const path_hit *, vec3 perturbation, bool rough);

/* Prepares a vertex for SCENE_FUNCTION. */
void appearance_prepare_function(const path *, const path_hit *, const encounter *, const material_reflection *,
                                 const material_effect *, vertex *);

/* What goes straight through such a surface, and one of SCENE_WGMD. */
rgb appearance_through_function(const path_hit *, const encounter *, const material_reflection *,
                                const material_effect *);
rgb appearance_through_wgmd(const path_hit *, const encounter *, const scene_material *, material_effect before,
                            const material_effect *own);

/* Prepares a vertex for SCENE_WGMD, `before` being what mixtures and meshes do to it, `own` that with its modifiers:
 * one surface where all its parts have the same normal, as they mostly do; else those of one normal are drawn, for all.
 */
void appearance_prepare_wgmd(const path *, const path_hit *, const encounter *, const scene_material *,
                             material_effect before, const material_effect *own, vertex *);

/* Prepares a vertex for SCENE_PRISM; of two ways on, one is drawn. */
void appearance_prepare_prism(const path *, const path_hit *, const encounter *, const material_prism *, vertex *);

#endif
