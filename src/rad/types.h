/* What is known of each primitive type: its name, its arguments, what a transform does to it. */
#ifndef RAD_TYPES_H
#define RAD_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rad/scene_file.h"

/* How a transform acts on a type's arguments. */
typedef enum rad_action {
    RAD_UNCHANGED,
    RAD_APPEND_WORDS, /* the transform's words go behind the string arguments, for whoever evaluates them */
    RAD_POINTS,       /* polygon */
    RAD_BALL,         /* centre, radius */
    RAD_SHAFT,        /* two points, then radii: cones and cylinders */
    RAD_DISK,         /* centre, normal, two radii */
    RAD_DIRECTION,    /* source */
    RAD_DISTANCE,     /* glow */
    RAD_AIM,          /* spotlight */
    RAD_ABSORPTION,   /* transmittances per unit length: dielectric, interface */
    RAD_EXTINCTION,   /* mist */
    RAD_TEXT,         /* anchor, right and down vectors */
} rad_action;

enum { RAD_ANY_COUNT = -1 };

typedef struct rad_type_facts {
    const char *name;
    rad_action action;
    int strings_least;           /* more of them are ignored, or used by what the type is about */
    int reals_least, reals_most; /* most: or RAD_ANY_COUNT */
    int reals_step;              /* their number is a multiple of this */
    bool is_surface;
    rad_type inverse; /* of a surface: the one that faces the other way */
} rad_type_facts;

const rad_type_facts *rad_type_look_up(rad_type);
/* False where `name` is no type. */
bool rad_type_find(const char *name, size_t length, rad_type *type);

#endif
