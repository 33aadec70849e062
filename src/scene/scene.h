/* The inside of graze_scene: surfaces, what they are made of, and the lights among them. */
#ifndef SCENE_SCENE_H
#define SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/vector.h"
#include "geometry/geometry.h"
#include "graze/material.h"
#include "graze/scene.h"
#include "material/orientation.h"
#include "material/reflection.h"
#include "material/wgmd.h"
#include "rad/scene_file.h"
#include "scene/light_tree.h"

/* Of a light, and of the ambient value: sums and squares of radiances then stay far from overflow. */
#define SCENE_LARGEST_RADIANCE 1e100

/* How a light takes part in the lighting of a point. */
typedef enum light_role {
    LIGHT_NONE,    /* only seen: glow with a negative radius */
    LIGHT_AMBIENT, /* lights like any bright surface: through glossy reflection, and the diffuse one while bounces are
                      left */
    LIGHT_DIRECT,  /* lights everything that sees it */
} light_role;

/* A light: a shape of the scene that shines from its front, or a `source` infinitely far away. */
typedef struct scene_light {
    rgb radiance;
    const material_modifier *modifiers; /* patterns, or null */
    rgb typical;                        /* the mean of the radiance, patterns and all; never black */
    const struct source_table *table;   /* of a source with patterns; else null */
    const shape *shape;                 /* null for a source */
    int surface;                        /* index of the shape; -1 for a source */
    int primitive;                      /* of the surface, in the description */
    bool glow;
    double glow_radius; /* of a glow: where it is LIGHT_DIRECT; 0: nowhere; negative: LIGHT_NONE everywhere */
    bool spot;
    vec3 spot_axis;     /* unit, the way the light goes */
    double spot_cosine; /* of the half angle of the cone */
    double spot_focus;  /* how far behind the light its cone begins */
    vec3 center;        /* of a source: the unit direction towards it */
    double half_angle;  /* of a source, radians */
    bool only_seen;     /* it is in a copy: no light for others, but of a glow beyond its radius */
} scene_light;

/* What a material does, with all that modifies it: it reflects, it shines, or it is one of two materials. */
typedef struct scene_material {
    int primitive; /* the material, or the mixture, in the description */
    bool emits;
    bool plain;                              /* it reflects, and `reflector` is all there is to it: */
    graze_material reflector;                /* unless `emits`, nor a mixture */
    scene_light light;                       /* if it emits: what the material says of a light */
    const material_orientation *orientation; /* by functions, or null */
    const material_reflection *reflection;   /* the same; `reflector` is then not set */
    const material_wgmd *wgmd;               /* the same; `reflector` has no more than the model */
    const material_modifier *modifiers;      /* patterns and textures, or null */
    const material_modifier *mixture;        /* or null: */
    int fore, back;                          /* indices into materials */
    int seen_light;                          /* index into lights of the one that surfaces in copies are; or -1 */
} scene_material;

typedef struct scene_surface {
    int primitive;   /* in the description */
    int material;    /* index into materials */
    int light;       /* index into lights, or -1 */
    bool no_ambient; /* its modifier is among those whose diffuse interreflection is not computed */
    bool mirrors;    /* flat, of the material `mirror`, not patterned */
} scene_surface;

/* An instance or a mesh in a part. */
typedef struct scene_copy {
    int part;              /* that it is a copy of */
    bool replaces;         /* its own modifier stands for all modifiers in it: all its surfaces are */
    scene_surface surface; /* this */
} scene_copy;

/* The scene itself, or what a file holds that instances or meshes name. */
typedef struct scene_part {
    shape *shapes;
    scene_surface *surfaces; /* surface_count of them, as of the shapes */
    size_t surface_count;
    geometry_placement *placements;
    scene_copy *copies; /* copy_count of them, as of the placements */
    size_t copy_count;
    const rad_mesh *mesh; /* or null; its triangles are the surfaces, in their order */
    bool own_materials;   /* some copy of the mesh has no modifier of its own */
} scene_part;

struct graze_scene {
    rad_scene *description;
    const rad_primitive *primitives;
    size_t primitive_count;
    arena *memory;
    shape *shapes; /* surface_count of them, the same index as `surfaces` */
    scene_surface *surfaces;
    size_t surface_count;
    scene_part *parts; /* the first is the scene itself; none where it has no copies of others */
    size_t part_count;
    scene_material *materials;
    size_t material_count;
    material_modifiers *modifiers; /* null where no material has any */
    bool has_mirrors;              /* not faint ones, or dielectrics: light comes by ways that no light sample finds */
    int *mirrors;                  /* mirror_count surfaces that do mirror */
    size_t mirror_count;
    bool has_panes;      /* surfaces that light goes straight through */
    bool has_refraction; /* dielectrics */
    scene_light *lights; /* the shapes first, then the sources; and behind these, what is only seen */
    size_t light_count;
    size_t seen_light_count;
    size_t first_source; /* lights[first_source ..] are sources: `light` ones before `glow` ones */
    bool sources_apart;  /* no direction is in two of them */
    light_tree light_tree;
    geometry *geometry;
};

/* The name of the surface with this index in the description, of its modifier, and of the material that this has or is,
 * or is an alias of ("void" where there is none; of a mixture of materials its own). */
const char *scene_name(const graze_scene *, int primitive);
const char *scene_modifier_name(const graze_scene *, int primitive);
const char *scene_material_name(const graze_scene *, int primitive);

#endif
