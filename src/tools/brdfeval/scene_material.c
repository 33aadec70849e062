/* Finding a material in a scene file, and what of it brdfeval can evaluate. */
#include "tools/brdfeval/scene_material.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "material/from_primitive.h"
#include "material/orientation.h"
#include "scene/emitter.h"

static const char *place_name(const char *file) {
    return strcmp(file, "-") == 0 ? "standard input" : file;
}

/* Names the last materials that there are, for whom has misspelt one. */
static graze_status report_missing(const rad_primitive *primitives, size_t count, const char *file, const char *name,
                                   const graze_report *report) {
    char others[400] = "";
    size_t length = 0;
    for (size_t i = count; i-- > 0;) {
        if (rad_type_is_surface(primitives[i].type))
            continue;
        int added =
            snprintf(others + length, sizeof others - length, "%s%s", length ? ", " : "; it has ", primitives[i].id);
        if (added < 0 || (size_t)added >= sizeof others - length) {
            snprintf(others + length, sizeof others - length, "%s", length + 4 < sizeof others ? " ..." : "");
            break;
        }
        length += (size_t)added;
    }
    return report_error(report, &(place){.file = place_name(file)}, "there is no material '%s'%s", name, others);
}

static graze_status find(const rad_scene *scene, const rad_primitive **found, const char *file, const char *name,
                         const graze_report *report) {
    size_t count;
    const rad_primitive *primitives = rad_scene_primitives(scene, &count), *surface = NULL;
    for (size_t i = count; i-- > 0;) {
        *found = &primitives[i];
        if (strcmp(primitives[i].id, name) != 0)
            continue;
        if (!rad_type_is_surface(primitives[i].type))
            return GRAZE_OK;
        surface = surface ? surface : &primitives[i];
    }
    if (surface)
        return rad_primitive_error(report, surface, "is a surface; -M wants the name of a material");
    return report_missing(primitives, count, file, name, report);
}

static graze_status read_material(graze_material *material, const rad_scene *scene, const rad_primitive *p,
                                  const graze_report *report) {
    size_t count;
    if (emitter_is(p->type))
        return rad_primitive_error(report, p, "shines, and has no reflectance");
    graze_status status = material_from_primitive(material, p, report);
    if (status == GRAZE_OK && material_orients_by_function(p))
        status = rad_primitive_error(report, p, "its orientation depends on where in a scene it is seen");
    if (status == GRAZE_OK && p->modifier != RAD_VOID)
        status = rad_primitive_error(report, &rad_scene_primitives(scene, &count)[p->modifier],
                                     "modifies %s %s, which is not supported yet", rad_type_name(p->type), p->id);
    return status;
}

static void take_colour(double channels[3], rgb colour) {
    channels[0] = fmin(colour.r, DBL_MAX);
    channels[1] = fmin(colour.g, DBL_MAX);
    channels[2] = fmin(colour.b, DBL_MAX);
}

/* The frame's x is where the orientation points, whatever that is in the scene; no surface is at hand that could be at
 * an angle to it. */
static graze_status take_material(reflectance *r, graze_material material, const rad_primitive *p,
                                  const graze_report *report) {
    const vec3 normal = {0, 0, 1};
    graze_surface surface;
    int illegal = 0;
    if (vec3_max_abs(material.orientation) > 0)
        material.orientation = vec3_make(1, 0, 0);
    material.model = r->lobe.model;
    graze_surface_prepare(&surface, &material, normal, normal, &illegal);
    if (material.kind == GRAZE_ASHIKHMIN)
        return rad_primitive_error(report, p, "has a lobe of its own, which is none of the models that -m names");
    if (surface.transmits)
        return rad_primitive_error(report, p, "lets light through; only what is reflected can be evaluated");
    if (surface.specular_lobe == GRAZE_LOBE_MIRROR)
        return rad_primitive_error(report, p, "is a mirror: with a roughness this small it has no value to evaluate");
    if (illegal)
        rad_primitive_warning(report, p, "its orientation vector is null: it is then isotropic");
    r->has_lobe = surface.specular_lobe == GRAZE_LOBE_GLOSSY;
    r->lobe = surface.lobe;
    r->channels = 3;
    take_colour(r->diffuse, surface.diffuse);
    take_colour(r->specular, surface.specular);
    return GRAZE_OK;
}

graze_status scene_material_read(reflectance *r, const char *file, const char *name, const graze_report *report) {
    rad_scene *scene = NULL;
    const rad_primitive *primitive = NULL;
    graze_material material;
    graze_status status = rad_scene_read(&scene, &file, 1, report);
    if (status == GRAZE_OK)
        status = find(scene, &primitive, file, name, report);
    if (status == GRAZE_OK)
        status = read_material(&material, scene, primitive, report);
    if (status == GRAZE_OK)
        status = take_material(r, material, primitive, report);
    rad_scene_destroy(scene);
    return status;
}
