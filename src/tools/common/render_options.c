/* The table of the shared options, and what their values mean. */
#include "tools/common/render_options.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "tools/common/model_name.h"
#include "tools/common/peer_options.h"

render_options render_options_default(double error) {
    graze_trace_settings defaults = graze_trace_defaults();
    render_options o = {
        .back_faces = true,
        .lights_visible = true,
        .warnings = true,
        .ambient_divisions = 1024,
        .reflection_limit = defaults.reflection_limit,
        .threads = parallel_processor_count(),
        .minimum_weight = defaults.minimum_weight,
        .error = error,
        .sample_limit = (int)defaults.sample_limit,
        .strategy = "mis",
        .components = 3,
        .ambient_modifiers = {.letter = 'a'},
    };
    o.ambient_accuracy = 0.1;
    o.ignored.ambient_resolution = 256;
    o.ignored.ambient_supersamples = 512;
    o.ignored.direct_threshold = 0.03;
    o.ignored.direct_certainty = 0.75;
    o.ignored.direct_sampling = 0.2;
    o.ignored.direct_relays = 2;
    o.ignored.direct_pretest = 512;
    o.ignored.specular_sampling = 1;
    o.ignored.ambient_file = "";
    o.ignored.uncorrelated = true;
    return o;
}

render_options render_options_in_effect(const render_options *given) {
    const render_options plain = render_options_default(given->error);
    render_options o = *given;
    o.ignored = plain.ignored;
    o.components = plain.components;
    o.all_components = plain.all_components;
    o.definitions = plain.definitions; /* what they say is the scene's */
    if (o.ambient_divisions > 0)
        o.ambient_divisions = plain.ambient_divisions;
    if (o.ambient_accuracy > 0)
        o.ambient_accuracy = plain.ambient_accuracy;
    return o;
}

/* Takes `MODEL` or `MATERIAL=MODEL`; a material's name may hold a =, a model's does not. */
static graze_status take_model(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    model_options *o = target;
    if (*suffix || count < 1)
        return report_error(report, NULL, "option '--model' needs a model: [MATERIAL=]MODEL");
    if (o->count == RENDER_MODEL_LIMIT)
        return report_error(report, NULL, "--model may be given %d times at most", RENDER_MODEL_LIMIT);
    const char *equals = strrchr(words[0], '='), *model = equals ? equals + 1 : words[0];
    graze_model_choice *choice = &o->choices[o->count];
    *choice = (graze_model_choice){0};
    if (!model_find(model, &choice->model))
        return report_error(report, NULL, "--model: there is no model '%s'; models: %s", model, model_list());
    if (equals) {
        size_t length = (size_t)(equals - words[0]);
        if (length == 0 || length >= sizeof o->names[0])
            return report_error(report, NULL, "--model %s: a material's name has 1 to %zu characters", words[0],
                                sizeof o->names[0] - 1);
        memcpy(o->names[o->count], words[0], length);
        o->names[o->count][length] = 0;
        choice->material = o->names[o->count];
    }
    o->count++;
    *used = 1;
    return GRAZE_OK;
}

static void print_models(void *target, FILE *out) {
    const model_options *o = target;
    for (size_t i = 0; i < o->count; i++) {
        char word[sizeof o->names[0] + 32];
        const char *name = o->choices[i].material;
        snprintf(word, sizeof word, "%s%s%s", name ? name : "", name ? "=" : "", model_name(o->choices[i].model));
        fputs("--model ", out);
        options_print_word(out, word);
        fputs(i + 1 < o->count ? " " : "", out);
    }
}

void render_options_table(render_options *o, option table[RENDER_OPTION_COUNT]) {
    const option options[RENDER_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "Accuracy", 0, 0, NULL, NULL},
        {"--error", OPTION_REAL, &o->error, "E", "standard error to reach, as a part of the value, 1e-6 .. 1e6", 1e-6,
         1e6, NULL, NULL},
        {"--floor", OPTION_REAL, &o->floor, "F", "smaller values need only E x F", 0, INFINITY, NULL, NULL},
        {"--samples", OPTION_INTEGER, &o->samples, "N", "take exactly N paths instead; 0: by --error", 0, 1 << 30, NULL,
         NULL},
        {"--max-samples", OPTION_INTEGER, &o->sample_limit, "N", "never more paths than this", 2, 1 << 30, NULL, NULL},
        {"--seed", OPTION_INTEGER, &o->seed, "S", "other seeds give other, equally good answers", 0, 2147483647, NULL,
         NULL},
        {"--strategy", OPTION_TEXT, &o->strategy, "S",
         "light (Eq. 18), brdf (Eq. 16), mis (both); or unweighted, as old Radiance", 0, 0, NULL, NULL},
        {"--model", OPTION_CUSTOM, &o->models, "[MATERIAL=]MODEL", model_list(), 0, 0, take_model, print_models},
        {"-n", OPTION_INTEGER, &o->threads, "N", "number of threads", 1, 1024, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Light", 0, 0, NULL, NULL},
        {"-ab", OPTION_INTEGER, &o->ambient_bounces, "N", "diffuse interreflections", 0, 1000000, NULL, NULL},
        {"-av", OPTION_REAL3, o->ambient_value, "R G B", "ambient radiance beyond those", 0, INFINITY, NULL, NULL},
        {"-ad", OPTION_INTEGER, &o->ambient_divisions, "N", "0: no diffuse interreflection; else ignored", 0,
         2147483647, NULL, NULL},
        {"-aa", OPTION_REAL, &o->ambient_accuracy, "A", "0: no irradiance cache, in pictures; else ignored", 0,
         INFINITY, NULL, NULL},
        {"-i", OPTION_FLAG, &o->irradiance, NULL, "irradiance where the ray first hits, instead of radiance", 0, 0,
         NULL, NULL},
        {"-bv", OPTION_FLAG, &o->back_faces, NULL, "surfaces are seen from behind", 0, 0, NULL, NULL},
        {"-dv", OPTION_FLAG, &o->lights_visible, NULL, "lights are seen", 0, 0, NULL, NULL},
        {"-st", OPTION_REAL, &o->specular_threshold, "R", "rough lobes up to this specularity count as diffuse", 0, 1,
         NULL, NULL},
        {"-lr", OPTION_INTEGER, &o->reflection_limit, "N", "limit of reflections; <= 0: roulette; 0: none", -1000000,
         1000000, NULL, NULL},
        {"-lw", OPTION_REAL, &o->minimum_weight, "W", "weight below which paths play roulette or end", 0, 1, NULL,
         NULL},
        {"-ae", OPTION_CUSTOM, &o->ambient_modifiers, "MODIFIER", "no diffuse interreflection on surfaces of it", 0, 0,
         modifier_list_exclude, modifier_list_print},
        {"-aE", OPTION_CUSTOM, &o->ambient_modifiers, "FILE", "... of those in the file", 0, 0,
         modifier_list_exclude_file, NULL},
        {"-ai", OPTION_CUSTOM, &o->ambient_modifiers, "MODIFIER", "diffuse interreflection on surfaces of it alone", 0,
         0, modifier_list_include, NULL},
        {"-aI", OPTION_CUSTOM, &o->ambient_modifiers, "FILE", "... of those in the file", 0, 0,
         modifier_list_include_file, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Colors, functions, messages", 0, 0, NULL, NULL},
        {"-p", OPTION_SUFFIX, &o->color, "RGB", "colors of values: RGB XYZ Y S M A, or c and 8 chromaticities", 0, 0,
         output_color_take, output_color_print},
        {"-w", OPTION_FLAG, &o->warnings, NULL, "warnings", 0, 0, NULL, NULL},
        {"-e", OPTION_CUSTOM, &o->definitions, "WORD",
         "definition (with = or :) for function files; else a file to append messages to", 0, 0,
         definition_list_take_expression, definition_list_print},
        {"-f", OPTION_CUSTOM, &o->definitions, "FILE", "definitions for all function files", 0, 0,
         definition_list_take_file, NULL},
        {"", OPTION_HEADING, NULL, NULL, "Refused unless they change nothing", 0, 0, NULL, NULL},
        {"-me", OPTION_REAL3, o->mist_extinction, "R G B", "mist everywhere: 0 0 0, there is none", 0, INFINITY, NULL,
         NULL},
        {"-co", OPTION_FLAG, &o->all_components, NULL, "print all components of spectra: 3", 0, 0, NULL, NULL},
        {"-cs", OPTION_INTEGER, &o->components, "N", "components of spectra; with -co+, 3 at most", 1, 1000, NULL,
         NULL},
        {"", OPTION_HEADING, NULL, NULL, "Accepted for Radiance's sake, without effect", 0, 0, NULL, NULL},
        {"-ar", OPTION_INTEGER, &o->ignored.ambient_resolution, "N", "ambient resolution", 0, 2147483647, NULL, NULL},
        {"-as", OPTION_INTEGER, &o->ignored.ambient_supersamples, "N", "ambient super-samples", 0, 2147483647, NULL,
         NULL},
        {"-aw", OPTION_INTEGER, &o->ignored.ambient_weight, "N", "weight of the ambient value", 0, 2147483647, NULL,
         NULL},
        {"-af", OPTION_TEXT, &o->ignored.ambient_file, "FILE", "ambient file: neither read nor written", 0, 0, NULL,
         NULL},
        {"-dt", OPTION_REAL, &o->ignored.direct_threshold, "R", "direct threshold", 0, 1, NULL, NULL},
        {"-dc", OPTION_REAL, &o->ignored.direct_certainty, "R", "direct certainty", 0, 1, NULL, NULL},
        {"-dj", OPTION_REAL, &o->ignored.direct_jitter, "R", "direct jitter", 0, 1, NULL, NULL},
        {"-ds", OPTION_REAL, &o->ignored.direct_sampling, "R", "source subdivision", 0, INFINITY, NULL, NULL},
        {"-dr", OPTION_INTEGER, &o->ignored.direct_relays, "N", "virtual source relays", 0, 2147483647, NULL, NULL},
        {"-dp", OPTION_INTEGER, &o->ignored.direct_pretest, "N", "virtual source pretest density", 0, 2147483647, NULL,
         NULL},
        {"-ap", OPTION_CUSTOM, NULL, "FILE [N [N]]", "photon map: not read", 0, 0, peer_take_photon_map, NULL},
        {"-am", OPTION_REAL, &o->ignored.photon_radius, "R", "photon search radius", 0, INFINITY, NULL, NULL},
        {"-ac", OPTION_TEXT, &o->ignored.photon_page, "N", "photon cache page", 0, 0, NULL, NULL},
        {"-aC", OPTION_TEXT, &o->ignored.photon_cache, "N", "photon cache size", 0, 0, NULL, NULL},
        {"-ma", OPTION_REAL3, o->ignored.mist_albedo, "R G B", "mist albedo", 0, 1, NULL, NULL},
        {"-mg", OPTION_REAL, &o->ignored.mist_eccentricity, "G", "mist eccentricity", -1, 1, NULL, NULL},
        {"-ms", OPTION_REAL, &o->ignored.mist_distance, "D", "mist sampling distance", 0, INFINITY, NULL, NULL},
        {"-cw", OPTION_CUSTOM, NULL, "NM NM", "range of wavelengths", 0, 0, peer_take_wavelengths, NULL},
        {"-P", OPTION_CUSTOM, NULL, "FILE", "persistent server (also -PP): the scene is loaded anew", 0, 0,
         peer_take_persist, NULL},
        {"-ss", OPTION_REAL, &o->ignored.specular_sampling, "N", "specular sampling: the whole lobe always is", 0,
         INFINITY, NULL, NULL},
        {"-u", OPTION_FLAG, &o->ignored.uncorrelated, NULL, "uncorrelated sampling", 0, 0, NULL, NULL},
    };
    memcpy(table, options, sizeof options);
}

static graze_status read_strategy(const char *name, graze_strategy *strategy, const graze_report *report) {
    static const char *const names[] = {
        [GRAZE_STRATEGY_MIS] = "mis",
        [GRAZE_STRATEGY_LIGHT] = "light",
        [GRAZE_STRATEGY_BRDF] = "brdf",
        [GRAZE_STRATEGY_UNWEIGHTED] = "unweighted",
    };
    for (int i = 0; i < (int)(sizeof names / sizeof *names); i++)
        if (strcmp(name, names[i]) == 0) {
            *strategy = (graze_strategy)i;
            return GRAZE_OK;
        }
    return report_error(report, NULL, "--strategy must be light, brdf, mis or unweighted, not '%s'", name);
}

graze_status render_options_settings(const render_options *o, bool sensor, graze_trace_settings *s,
                                     const graze_report *report) {
    if (o->mist_extinction[0] > 0 || o->mist_extinction[1] > 0 || o->mist_extinction[2] > 0)
        return report_error(report, NULL, "option '-me': mist is not supported yet");
    if (o->all_components && o->components > 3)
        return report_error(report, NULL, "options '-co' and '-cs': spectra are not supported yet");
    *s = graze_trace_defaults();
    s->quantity = sensor ? GRAZE_IRRADIANCE : o->irradiance ? GRAZE_IRRADIANCE_HIT : GRAZE_RADIANCE;
    s->ambient_bounces = o->ambient_divisions > 0 ? o->ambient_bounces : 0;
    s->ambient_value = (graze_rgb){o->ambient_value[0], o->ambient_value[1], o->ambient_value[2]};
    s->back_faces_visible = o->back_faces;
    s->lights_visible = o->lights_visible;
    s->reflection_limit = o->reflection_limit;
    s->minimum_weight = o->minimum_weight;
    s->specular_threshold = o->specular_threshold;
    s->error = o->error;
    s->floor = o->floor;
    s->samples = (uint32_t)o->samples;
    s->sample_limit = (uint32_t)o->sample_limit;
    s->seed = (uint64_t)o->seed;
    graze_status status = read_strategy(o->strategy, &s->strategy, report);
    return status != GRAZE_OK ? status : graze_trace_check(s, report);
}

graze_scene_settings render_options_scene(const render_options *o) {
    return (graze_scene_settings){
        .threads = o->threads,
        .models = o->models.choices,
        .model_count = o->models.count,
        .ambient_modifiers = o->ambient_modifiers.names,
        .ambient_modifier_count = o->ambient_modifiers.count,
        .ambient_modifiers_included = o->ambient_modifiers.include,
        .definitions = o->definitions.definitions,
        .definition_count = o->definitions.count,
    };
}

graze_status render_options_begin(const render_options *o, const tool_arguments *arguments,
                                  const graze_report *report) {
    const char *file = o->definitions.error_file;
    return file ? tool_redirect_messages(file, arguments, report) : GRAZE_OK;
}

void render_options_free(render_options *o) {
    modifier_list_free(&o->ambient_modifiers);
    definition_list_free(&o->definitions);
}
