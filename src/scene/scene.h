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
#include "material/prism.h"
#include "material/reflection.h"
#include "material/wgmd.h"
#include "rad/scene_file.h"
#include "scene/light_tree.h"

/* Of a light, and of the ambient value: sums and squares of radiances then stay far from overflow. */
#define SCENE_LARGEST_RADIANCE 1e100

/* A source as wide as this is a sky: 30 degrees, in radians. */
#define SCENE_SKY_HALF_ANGLE 0.5235987755982988

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
    int64_t surface;                    /* its number; -1 for a source */
    int primitive;                      /* of the surface, in the description */
    bool secondary;                     /* of the material illum: its surface is seen as another material */
    bool glow;
    double glow_radius; /* of a glow: where it is LIGHT_DIRECT; 0: nowhere; negative: LIGHT_NONE everywhere */
    bool spot;
    vec3 spot_axis;     /* unit, the way the light goes */
    double spot_cosine; /* of the half angle of the cone */
    double spot_focus;  /* how far behind the light its cone begins */
    vec3 center;        /* of a source: the unit direction towards it */
    bool alone;         /* of a source: no part of it is a source's that is before it in the scene's lights */
    double half_angle;  /* of a source, radians */
    bool only_seen;     /* it is in a copy, or a mixture: no light for others, but of a glow beyond its radius */
    int seen_as;        /* of a glow in a copy that is sampled: the light that stands for all such copies */
    const rad_transform *frame; /* from where its patterns are written to the scene; null: they are written there */
} scene_light;

/* Whether it is LIGHT_AMBIENT, if anything, to all points. */
static inline bool light_is_ambient(const scene_light *light) {
    return light->glow && (light->glow_radius == 0 || light->only_seen);
}

/* Whether it is a source as wide as a sky. */
static inline bool scene_light_is_sky(const scene_light *light) {
    return !light->shape && light->half_angle >= SCENE_SKY_HALF_ANGLE;
}

typedef enum scene_material_kind {
    SCENE_REFLECTOR, /* what include/graze/material.h knows: opaque, transmitting, clear, or a mirror */
    SCENE_ORIENTED,  /* the same, its orientation by functions */
    SCENE_EMITTER,   /* it shines */
    SCENE_FUNCTION,  /* it scatters lights by a function */
    SCENE_WGMD,      /* WGMDfunc */
    SCENE_PRISM,     /* it sends light on in directions by functions */
    SCENE_MIXTURE,   /* it is one of two materials, or both in part */
    SCENE_NOTHING,   /* void, in a mixture or as an alternate: light goes straight on */
} scene_material_kind;

/* What a material does, with all that modifies it. */
typedef struct scene_material {
    scene_material_kind kind;
    int primitive;    /* the material, or the mixture, in the description */
    int alternate;    /* index into materials of what it is seen as; -1: as itself */
    int mist;         /* index into scene->mist: its surfaces bound that, and are no surfaces; -1: no mist */
    bool cuts;        /* antimatter: SCENE_NOTHING, its alternate what it closes bodies with, if with anything */
    bool keeps_front; /* with an alternate: the front of a mirror, which paths meet as that once they are scattered */
    const material_modifier *modifiers; /* patterns and textures, or null */
    union {
        struct { /* SCENE_REFLECTOR, SCENE_ORIENTED */
            graze_material reflector;
            const material_orientation *orientation; /* SCENE_ORIENTED */
        };
        struct {               /* SCENE_EMITTER */
            scene_light light; /* what the material says of a light */
            int seen_light;    /* index into lights of the one that surfaces in copies and mixtures are; or -1 */
        };
        const material_reflection *reflection; /* SCENE_FUNCTION */
        const material_prism *prism;           /* SCENE_PRISM */
        struct {                               /* SCENE_WGMD */
            const material_wgmd *wgmd;
            graze_brdf_model model;
        };
        struct { /* SCENE_MIXTURE */
            const material_modifier *share;
            int fore, back; /* indices into materials */
            int shining;    /* the emitter among these, and theirs, or -1 */
            bool bends;     /* scene_material_bends, of either; and scene_material_has_back */
            bool has_back;
        };
    };
} scene_material;

typedef struct scene_surface {
    int primitive;        /* in the description */
    int material;         /* index into materials */
    int light;            /* index into lights, or -1 */
    bool no_ambient;      /* its modifier is among those whose diffuse interreflection is not computed */
    bool mirrors;         /* lights are sampled in it (scene/mirrors.h) that paths see there, too */
    unsigned short cells; /* index and 1 of its cells (scene/sight_cells.h); 0: it has none */
} scene_surface;

/* The scene itself, or what a file holds that instances or meshes name. */
typedef struct scene_part {
    shape *shapes;
    scene_surface *surfaces; /* surface_count of them, as of the shapes */
    size_t surface_count;
    geometry_placement *placements; /* copy_count of them: its instances and meshes, by the parts they are of */
    scene_surface *replacing;       /* as many: of those that replace, by a modifier of their own, all their surfaces */
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
    bool has_mirrors;              /* not faint ones: light comes by ways that no light sample finds */
    int *mirror_surfaces;          /* mirror_surface_count of them, that lights are sampled in */
    size_t mirror_surface_count;
    struct scene_mirror *mirrors; /* (scene/mirrors.h) which they make up */
    int *mirror_of;               /* by surface: the index of the mirror that it is of; of others not set */
    size_t mirror_count;
    struct scene_mirrored_light *mirrored_lights; /* where lights are few; else null */
    bool has_panes;                               /* surfaces that light goes straight through */
    bool has_refraction;                          /* dielectrics, prisms */
    bool has_secondary;                           /* lights of the material illum */
    bool mist_in_copies;                          /* its surfaces are among these, and passed over */
    struct scene_mist *mist;                      /* (scene/mist.h) null: none */
    struct scene_cuts *cuts;                      /* by antimatter (scene/cuts.h); null: none, nor mist in copies */
    struct scene_balls *balls;                    /* (scene/balls.h) that throw lights back; null: none */
    struct sight_cells *sight_cells;              /* null: none */
    struct scene_windows *windows;                /* (scene/windows.h) that show the sky; null: none */
    scene_light *lights; /* the scene's shapes, the sources, and glows in copies; and behind, what is only seen */
    size_t light_count;
    size_t seen_light_count;
    size_t first_source;     /* lights[first_source .. first_copied - 1] are sources: `light` ones before `glow` ones */
    size_t first_copied;     /* lights[first_copied ..] are glows in copies, in the order of their surfaces' numbers */
    bool meets_glows;        /* that light what is about but are not sampled: in mixtures, or too many copies */
    bool has_sky;            /* one of them is so wide that it is a sky */
    bool suns_overlap;       /* a direction is in two of the `light` ones */
    bool sky_beside_windows; /* some of it comes into rooms where no windows are */
    bool sun_comes_in;       /* one that is no sky shines through one of the windows */
    light_tree light_tree;
    geometry *geometry;
};

/* What a material is seen as, by all but light samples. */
static inline const scene_material *scene_material_seen(const graze_scene *scene, const scene_material *material) {
    while (material->alternate >= 0)
        material = &scene->materials[material->alternate];
    return material;
}

/* Whether the material shines: it is then no more than that. */
static inline bool scene_material_emits(const scene_material *m) {
    return m->kind == SCENE_EMITTER;
}

/* Whether it says what is inside of its surfaces, not what these are. */
static inline bool scene_material_is_volume(const scene_material *m) {
    return m->mist >= 0 || m->cuts;
}

/* Which material it shines by, itself or one in its mixtures; or -1. */
static inline int scene_material_shining(const graze_scene *scene, int material) {
    const scene_material *m = &scene->materials[material];
    return scene_material_emits(m) ? material : m->kind == SCENE_MIXTURE ? m->shining : -1;
}

/* Whether it bounds a clear body that refracts. */
static inline bool scene_material_refracts(const scene_material *m) {
    return m->kind == SCENE_REFLECTOR && m->reflector.kind == GRAZE_DIELECTRIC;
}

/* Whether light comes through some of it, but not straight on: from either side, and where no light sample looks for
 * it. */
static inline bool scene_material_bends(const scene_material *m) {
    return m->kind == SCENE_PRISM || scene_material_refracts(m) || (m->kind == SCENE_MIXTURE && m->bends);
}

/* Whether some of it is there from behind, too, where back faces are not visible. */
static inline bool scene_material_has_back(const scene_material *m) {
    return scene_material_bends(m) || (m->kind == SCENE_FUNCTION && m->reflection->keeps_normal) ||
           (m->kind == SCENE_MIXTURE && m->has_back);
}

/* The name of the surface with this index in the description, of its modifier, and of the material that this has or is,
 * or is an alias of ("void" where there is none; of a mixture of materials its own). */
const char *scene_name(const graze_scene *, int primitive);
const char *scene_modifier_name(const graze_scene *, int primitive);
const char *scene_material_name(const graze_scene *, int primitive);

#endif
