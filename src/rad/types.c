/* The primitive types: names, argument counts, and what a transform does to their arguments. */
#include "rad/types.h"

#include <string.h>

#define ANY RAD_ANY_COUNT

/* Of modifiers (they have no inverse) and of surfaces. */
#define MODIFIER(name, action, strings_least, reals_least, reals_most, step)                                           \
    { name, action, strings_least, reals_least, reals_most, step, false, RAD_TYPE_COUNT }
#define SURFACE(name, action, strings_least, reals_least, reals_most, step, inverse)                                   \
    { name, action, strings_least, reals_least, reals_most, step, true, inverse }

static const rad_type_facts facts[RAD_TYPE_COUNT] = {
    [RAD_SOURCE] = SURFACE("source", RAD_DIRECTION, 0, 4, 4, 1, RAD_SOURCE),
    [RAD_SPHERE] = SURFACE("sphere", RAD_BALL, 0, 4, 4, 1, RAD_BUBBLE),
    [RAD_BUBBLE] = SURFACE("bubble", RAD_BALL, 0, 4, 4, 1, RAD_SPHERE),
    [RAD_POLYGON] = SURFACE("polygon", RAD_POINTS, 0, 9, ANY, 3, RAD_POLYGON),
    [RAD_CONE] = SURFACE("cone", RAD_SHAFT, 0, 8, 8, 1, RAD_CUP),
    [RAD_CUP] = SURFACE("cup", RAD_SHAFT, 0, 8, 8, 1, RAD_CONE),
    [RAD_CYLINDER] = SURFACE("cylinder", RAD_SHAFT, 0, 7, 7, 1, RAD_TUBE),
    [RAD_TUBE] = SURFACE("tube", RAD_SHAFT, 0, 7, 7, 1, RAD_CYLINDER),
    [RAD_RING] = SURFACE("ring", RAD_DISK, 0, 8, 8, 1, RAD_RING),
    [RAD_MESH] = SURFACE("mesh", RAD_APPEND_WORDS, 1, 0, ANY, 1, RAD_MESH),
    [RAD_INSTANCE] = SURFACE("instance", RAD_APPEND_WORDS, 1, 0, ANY, 1, RAD_INSTANCE),
    [RAD_LIGHT] = MODIFIER("light", RAD_UNCHANGED, 0, 3, 3, 1),
    [RAD_ILLUM] = MODIFIER("illum", RAD_UNCHANGED, 0, 3, 3, 1),
    [RAD_GLOW] = MODIFIER("glow", RAD_DISTANCE, 0, 4, 4, 1),
    [RAD_SPOTLIGHT] = MODIFIER("spotlight", RAD_AIM, 0, 7, 7, 1),
    [RAD_PLASTIC] = MODIFIER("plastic", RAD_UNCHANGED, 0, 5, 5, 1),
    [RAD_METAL] = MODIFIER("metal", RAD_UNCHANGED, 0, 5, 5, 1),
    [RAD_TRANS] = MODIFIER("trans", RAD_UNCHANGED, 0, 7, 7, 1),
    [RAD_PLASTIC2] = MODIFIER("plastic2", RAD_APPEND_WORDS, 4, 6, 6, 1),
    [RAD_METAL2] = MODIFIER("metal2", RAD_APPEND_WORDS, 4, 6, 6, 1),
    [RAD_TRANS2] = MODIFIER("trans2", RAD_APPEND_WORDS, 4, 8, 8, 1),
    [RAD_ASHIK2] = MODIFIER("ashik2", RAD_APPEND_WORDS, 4, 8, 8, 1),
    [RAD_WGMDFUNC] = MODIFIER("WGMDfunc", RAD_APPEND_WORDS, 13, 9, ANY, 1),
    [RAD_DIELECTRIC] = MODIFIER("dielectric", RAD_ABSORPTION, 0, 5, 5, 1),
    [RAD_INTERFACE] = MODIFIER("interface", RAD_ABSORPTION, 0, 8, 8, 1),
    [RAD_GLASS] = MODIFIER("glass", RAD_UNCHANGED, 0, 3, 4, 1),
    [RAD_MIRROR] = MODIFIER("mirror", RAD_UNCHANGED, 0, 3, 3, 1),
    [RAD_PRISM1] = MODIFIER("prism1", RAD_APPEND_WORDS, 5, 0, ANY, 1),
    [RAD_PRISM2] = MODIFIER("prism2", RAD_APPEND_WORDS, 9, 0, ANY, 1),
    [RAD_MIST] = MODIFIER("mist", RAD_EXTINCTION, 0, 0, 7, 1),
    [RAD_PLASFUNC] = MODIFIER("plasfunc", RAD_APPEND_WORDS, 2, 4, ANY, 1),
    [RAD_METFUNC] = MODIFIER("metfunc", RAD_APPEND_WORDS, 2, 4, ANY, 1),
    [RAD_TRANSFUNC] = MODIFIER("transfunc", RAD_APPEND_WORDS, 2, 6, ANY, 1),
    [RAD_BRTDFUNC] = MODIFIER("BRTDfunc", RAD_APPEND_WORDS, 10, 9, ANY, 1),
    [RAD_PLASDATA] = MODIFIER("plasdata", RAD_APPEND_WORDS, 4, 4, ANY, 1),
    [RAD_METDATA] = MODIFIER("metdata", RAD_APPEND_WORDS, 4, 4, ANY, 1),
    [RAD_TRANSDATA] = MODIFIER("transdata", RAD_APPEND_WORDS, 4, 6, ANY, 1),
    [RAD_BSDF] = MODIFIER("BSDF", RAD_APPEND_WORDS, 6, 0, 9, 3),
    [RAD_ABSDF] = MODIFIER("aBSDF", RAD_APPEND_WORDS, 5, 0, 9, 3),
    [RAD_ANTIMATTER] = MODIFIER("antimatter", RAD_UNCHANGED, 1, 0, ANY, 1),
    [RAD_TEXFUNC] = MODIFIER("texfunc", RAD_APPEND_WORDS, 4, 0, ANY, 1),
    [RAD_TEXDATA] = MODIFIER("texdata", RAD_APPEND_WORDS, 8, 0, ANY, 1),
    [RAD_COLORFUNC] = MODIFIER("colorfunc", RAD_APPEND_WORDS, 4, 0, ANY, 1),
    [RAD_BRIGHTFUNC] = MODIFIER("brightfunc", RAD_APPEND_WORDS, 2, 0, ANY, 1),
    [RAD_COLORDATA] = MODIFIER("colordata", RAD_APPEND_WORDS, 8, 0, ANY, 1),
    [RAD_BRIGHTDATA] = MODIFIER("brightdata", RAD_APPEND_WORDS, 4, 0, ANY, 1),
    [RAD_COLORPICT] = MODIFIER("colorpict", RAD_APPEND_WORDS, 7, 0, ANY, 1),
    [RAD_COLORTEXT] = MODIFIER("colortext", RAD_TEXT, 2, 15, ANY, 1),
    [RAD_BRIGHTTEXT] = MODIFIER("brighttext", RAD_TEXT, 2, 11, ANY, 1),
    [RAD_SPECTRUM] = MODIFIER("spectrum", RAD_UNCHANGED, 0, 5, ANY, 1),
    [RAD_SPECFILE] = MODIFIER("specfile", RAD_UNCHANGED, 1, 0, ANY, 1),
    [RAD_SPECFUNC] = MODIFIER("specfunc", RAD_APPEND_WORDS, 2, 2, ANY, 1),
    [RAD_SPECDATA] = MODIFIER("specdata", RAD_APPEND_WORDS, 4, 0, ANY, 1),
    [RAD_SPECPICT] = MODIFIER("specpict", RAD_UNCHANGED, 5, 0, ANY, 1),
    [RAD_MIXFUNC] = MODIFIER("mixfunc", RAD_APPEND_WORDS, 4, 0, ANY, 1),
    [RAD_MIXDATA] = MODIFIER("mixdata", RAD_APPEND_WORDS, 6, 0, ANY, 1),
    [RAD_MIXPICT] = MODIFIER("mixpict", RAD_APPEND_WORDS, 7, 0, ANY, 1),
    [RAD_MIXTEXT] = MODIFIER("mixtext", RAD_TEXT, 4, 9, ANY, 1),
};

const rad_type_facts *rad_type_look_up(rad_type type) {
    return &facts[type];
}

const char *rad_type_name(rad_type type) {
    return type < RAD_TYPE_COUNT ? facts[type].name : "primitive";
}

int rad_type_is_surface(rad_type type) {
    return type < RAD_TYPE_COUNT && facts[type].is_surface;
}

bool rad_type_find(const char *name, size_t length, rad_type *type) {
    for (int t = 0; t < RAD_TYPE_COUNT; ++t)
        if (facts[t].name[0] == name[0] && strlen(facts[t].name) == length && !memcmp(facts[t].name, name, length)) {
            *type = (rad_type)t;
            return true;
        }
    return false;
}
