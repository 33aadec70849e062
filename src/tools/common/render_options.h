/* The options that gtrace and gpict share: how light is traced. */
#ifndef TOOLS_COMMON_RENDER_OPTIONS_H
#define TOOLS_COMMON_RENDER_OPTIONS_H

#include <stdbool.h>

#include "base/options.h"
#include "graze/trace.h"
#include "tools/common/definition_list.h"
#include "tools/common/modifier_list.h"
#include "tools/common/output_color.h"
#include "tools/common/tool.h"

#define RENDER_MODEL_LIMIT 32

/* What --model says, as often as it is given. */
typedef struct model_options {
    size_t count;
    graze_model_choice choices[RENDER_MODEL_LIMIT]; /* `material` is one of names, or null */
    char names[RENDER_MODEL_LIMIT][256];
} model_options;

/* Where the options' values go, in the types that base/options.h wants. */
typedef struct render_options {
    bool irradiance, back_faces, lights_visible, warnings;
    int ambient_bounces, ambient_divisions, reflection_limit, threads;
    double ambient_value[3];
    double minimum_weight, specular_threshold, error, floor;
    int samples, sample_limit, seed;
    const char *strategy;
    output_color_option color;
    model_options models;
    modifier_list ambient_modifiers;
    definition_list definitions;
    bool all_components;     /* -co */
    int components;          /* -cs */
    double ambient_accuracy; /* 0: without an irradiance cache, in pictures */
    double mist_extinction[3];
    /* Accepted so that Radiance's command lines work; Graze has nothing that they could steer. */
    struct {
        double direct_threshold, direct_certainty, direct_jitter, direct_sampling, specular_sampling;
        double photon_radius, mist_albedo[3], mist_eccentricity, mist_distance;
        int ambient_weight, ambient_resolution, ambient_supersamples, direct_relays, direct_pretest;
        const char *ambient_file, *photon_page, *photon_cache;
        bool uncorrelated;
    } ignored;
} render_options;

render_options render_options_default(double error);

/* The same with its plainest value wherever another would change no answer: what has no effect is the default's. */
render_options render_options_in_effect(const render_options *);

/* How many entries render_options_table fills. */
#define RENDER_OPTION_COUNT 55

/* Fills in table entries that store into the options. */
void render_options_table(render_options *, option table[RENDER_OPTION_COUNT]);

void render_options_free(render_options *);

/* What must come before any message: sends them to the file of -e. */
graze_status render_options_begin(const render_options *, const tool_arguments *, const graze_report *);

/* Turns the values into settings, checked. `sensor` is rtrace's -I. */
graze_status render_options_settings(const render_options *, bool sensor, graze_trace_settings *, const graze_report *);

/* How the scene is to be built. The options must outlive the result. */
graze_scene_settings render_options_scene(const render_options *);

#endif
