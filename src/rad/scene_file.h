/* Radiance scene descriptions as data: reads .rad files and commands into a flat list of primitives. */
#ifndef RAD_SCENE_FILE_H
#define RAD_SCENE_FILE_H

#include <stddef.h>
#include <stdint.h>

#include "base/report.h"
#include "base/vector.h"
#include "rad/transform.h"

/* All primitive types of the language, so that an unsupported one can be told from a misspelt one. */
typedef enum rad_type {
    RAD_SOURCE,
    RAD_SPHERE,
    RAD_BUBBLE,
    RAD_POLYGON,
    RAD_CONE,
    RAD_CUP,
    RAD_CYLINDER,
    RAD_TUBE,
    RAD_RING,
    RAD_MESH,
    RAD_INSTANCE,
    RAD_LIGHT,
    RAD_ILLUM,
    RAD_GLOW,
    RAD_SPOTLIGHT,
    RAD_PLASTIC,
    RAD_METAL,
    RAD_TRANS,
    RAD_PLASTIC2,
    RAD_METAL2,
    RAD_TRANS2,
    RAD_ASHIK2,
    RAD_WGMDFUNC,
    RAD_DIELECTRIC,
    RAD_INTERFACE,
    RAD_GLASS,
    RAD_MIRROR,
    RAD_PRISM1,
    RAD_PRISM2,
    RAD_MIST,
    RAD_PLASFUNC,
    RAD_METFUNC,
    RAD_TRANSFUNC,
    RAD_BRTDFUNC,
    RAD_PLASDATA,
    RAD_METDATA,
    RAD_TRANSDATA,
    RAD_BSDF,
    RAD_ABSDF,
    RAD_ANTIMATTER,
    RAD_TEXFUNC,
    RAD_TEXDATA,
    RAD_COLORFUNC,
    RAD_BRIGHTFUNC,
    RAD_COLORDATA,
    RAD_BRIGHTDATA,
    RAD_COLORPICT,
    RAD_COLORTEXT,
    RAD_BRIGHTTEXT,
    RAD_SPECTRUM,
    RAD_SPECFILE,
    RAD_SPECFUNC,
    RAD_SPECDATA,
    RAD_SPECPICT,
    RAD_MIXFUNC,
    RAD_MIXDATA,
    RAD_MIXPICT,
    RAD_MIXTEXT,
    RAD_TYPE_COUNT
} rad_type;

const char *rad_type_name(rad_type); /* as in scene files: "plastic2" */
int rad_type_is_surface(rad_type);   /* source .. instance: may not be a modifier */

/* As rad_primitive's modifier: `void`. */
#define RAD_VOID (-1)

typedef struct rad_primitive {
    rad_type type;
    int32_t modifier; /* index of the primitive that modifies this one, always smaller than its own; or RAD_VOID */
    const char *id;
    const char *original_id; /* of an alias: the id of what it stands for in the end; else the same as `id` */
    uint32_t string_count, real_count;
    const char *const *strings;
    const double *reals;
    const place *where; /* of the first word of the primitive, parents and all */
} rad_primitive;

/* A compiled mesh. */
typedef struct rad_mesh {
    vec3 *points;
    vec3 *normals;         /* by point: unit, or null vectors where there is none; null: nowhere */
    double (*uv)[2];       /* by point: texture coordinates; null: nowhere */
    unsigned char *has_uv; /* whether the point has them */
    uint32_t point_count;
    struct rad_mesh_triangle {
        uint32_t points[3];
        int32_t primitive; /* index of the primitive that stands for it and has its material as modifier; or -1 */
    } * triangles;
    uint32_t triangle_count;
} rad_mesh;

/* The scene itself, or what a file holds that an instance or a mesh names. Copies are of later parts than the one that
 * they are in. */
typedef struct rad_part {
    const char *path;          /* of the file; null: the scene itself, which is the first part */
    size_t first, count;       /* its primitives */
    size_t first_copy, copies; /* its instances and meshes */
    const rad_mesh *mesh;      /* null: it is an octree, or the scene */
} rad_part;

/* What an instance or a mesh places. */
typedef struct rad_copy {
    int32_t primitive; /* the instance or mesh */
    int32_t part;
    rad_transform transform;
} rad_copy;

/* Parts in parts in parts: so deep. */
#define RAD_DEPTH 32

typedef struct rad_scene rad_scene;

/* Reads the named scenes in order, as one description: each a .rad file, an octree, `!command` (run by the shell;
 * `!xform` is done here), or `-` for standard input. Aliases are resolved: an alias appears as a primitive of its own
 * with the type and arguments of what it stands for. Undefined modifiers, unknown types, wrong argument counts or
 * malformed numbers, a failing command: errors with their place. All errors of a file that can be told apart are
 * reported, up to 20, before this returns. */
graze_status rad_scene_read(rad_scene **, const char *const *names, size_t count, const graze_report *);
/* The same, and large texts by several threads. */
graze_status rad_scene_read_by(int threads, rad_scene **, const char *const *names, size_t count, const graze_report *);
/* Reads the octrees and meshes that the scene's instances and meshes name, each once, and those that these name.
 * Octrees in octrees that hold themselves are an error, and so are files that are not there, or damaged. */
graze_status rad_scene_read_parts(rad_scene *, const graze_report *);
void rad_scene_destroy(rad_scene *);

/* Of all parts that have been read: of the scene alone before rad_scene_read_parts. */
const rad_primitive *rad_scene_primitives(const rad_scene *, size_t *count);
/* How many of a type there are among them. */
size_t rad_scene_count(const rad_scene *, rad_type);
/* These are there after rad_scene_read_parts. */
const rad_part *rad_scene_parts(const rad_scene *, size_t *count);
const rad_copy *rad_scene_copies(const rad_scene *);

/* The latest modifier of that name among the primitives from `first` on that are before `end`: its index from `first`,
 * or RAD_VOID where there is none. */
int rad_modifier_before(const rad_primitive *first, const rad_primitive *end, const char *name);

/* "sphere ball" */
typedef struct rad_primitive_name {
    char text[120];
} rad_primitive_name;

/* Reports an error about a primitive: "FILE:LINE:COLUMN: TYPE ID: TEXT". */
graze_status rad_primitive_error(const graze_report *, const rad_primitive *, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Its place, under its name, for messages from where primitives are not known. It is valid as long as *name. */
place rad_primitive_place(const rad_primitive *, rad_primitive_name *name);
void rad_primitive_warning(const graze_report *, const rad_primitive *, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
