/* Features by Radiance's names. */
#include "tools/gtrace/features.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const struct feature {
    const char *name, *parts; /* with commas between; null: it has none */
} features[] = {
    {"VirtualSources", NULL},
    {"SecondarySources", NULL},
    {"SourceSubsampling", NULL},
    {"SourceVisibility", NULL},
    {"AmbientModifierSelection", NULL},
    {"PathTracing", NULL},
    {"RussianRoulette", NULL},
    {"LowDiscrepancySeq", NULL},
    {"SpecularSampling", NULL},
    {"MaterialMixtures", NULL},
    {"Antimatter", NULL},
    {"BackFaceVisibility", NULL},
    {"ScatteringModels", "WGMD,Ashikhmin-Shirley"},
    {"Instancing", "Octree,TriangleMesh"},
    {"Aliases", NULL},
    {"Multiprocessing", NULL},
    {"IrradianceCalc", NULL},
    {"ImmediateIrradiance", NULL},
    {"DistanceLimiting", NULL},
    {"ParticipatingMedia", "Mist"},
    {"InputFormats", "a,f,d"},
    {"OutputFormats", "a,f,d,c"},
    {"Outputs", "o,d,v,e,V,w,W,l,L,c,p,n,N,s,m,M,r,x,R,X,~"},
    {"OutputCS", "RGB,XYZ,Y,S,M,A,prims"},
};
enum { FEATURE_COUNT = sizeof features / sizeof *features };

static void print_feature(const struct feature *f) {
    printf("%s%s%s\n", f->name, f->parts ? "=" : "", f->parts ? f->parts : "");
}

/* Whether `part`, of that length, is one of the parts. */
static bool has_part(const char *parts, const char *part, size_t length) {
    for (; parts; parts = strchr(parts, ',')) {
        parts += *parts == ',';
        if (strcspn(parts, ",") == length && strncmp(parts, part, length) == 0)
            return true;
    }
    return false;
}

/* `wanted` is what stands behind the `=`. */
static bool has_parts(const struct feature *f, const char *wanted) {
    while (*wanted) {
        size_t length = strcspn(wanted, ",");
        if (!has_part(f->parts, wanted, length))
            return false;
        wanted += length + (wanted[length] == ',');
    }
    return true;
}

static bool answer_word(const char *word) {
    size_t length = strcspn(word, "=");
    for (int i = 0; i < FEATURE_COUNT; i++) {
        const struct feature *f = &features[i];
        if (strlen(f->name) != length || strncmp(f->name, word, length) != 0)
            continue;
        if (word[length])
            return has_parts(f, word + length + 1);
        if (f->parts)
            print_feature(f);
        return true;
    }
    return false;
}

graze_status features_answer(int count, char *const *words, const graze_report *report) {
    for (int i = 0; i < FEATURE_COUNT && count == 0; i++)
        print_feature(&features[i]);
    for (int i = 0; i < count; i++)
        if (!answer_word(words[i]))
            return report_error(report, NULL, "missing feature - %s", words[i]);
    if (fflush(stdout) != 0)
        return report_system_error(report, NULL, "cannot write to standard output");
    return GRAZE_OK;
}
