/* brdffit: measured reflectance in; parameters of Ward's model and its variants out, with their uncertainties. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/angle.h"
#include "base/number.h"
#include "tools/brdffit/findings.h"
#include "tools/brdffit/plot.h"
#include "tools/common/model_name.h"
#include "tools/common/tool.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

typedef struct fit_options {
    const char *model, *total, *loss, *roughness;
    const char *format, *columns, *channels, *angles, *quantity, *light, *mirror;
    const char *output, *plot, *name;
    bool isotropic, anisotropic, warnings;
    double max_angle;
} fit_options;

/* --- Words ------------------------------------------------------------------------------------------------------- */

/* The number of the word that an option is set to, among those it can be. */
static graze_status find_word(const char *name, const char *value, const char *const *words, size_t count, int *found,
                              const graze_report *report) {
    char all[128] = "";
    for (size_t i = 0; i < count; i++) {
        if (strcmp(value, words[i]) == 0) {
            *found = (int)i;
            return GRAZE_OK;
        }
        strncat(all, " ", sizeof all - strlen(all) - 1);
        strncat(all, words[i], sizeof all - strlen(all) - 1);
    }
    return report_error(report, NULL, "%s: there is no '%s'; expected one of%s", name, value, all);
}

static graze_status read_conventions(const fit_options *o, fit_conventions *c, const graze_report *report) {
    static const char *const formats[] = {"any", "table", "cornell", "alta", "pab", "merl"};
    static const char *const units[] = {"any", "degrees", "radians"};
    static const char *const quantities[] = {"any", "brdf", "brdf-cosine-out", "brdf-cosine-in"};
    static const char *const lights[] = {"any", "in", "out"};
    static const char *const mirrors[] = {"any", "opposite", "same"};
    int format = 0, unit = 0, quantity = 0, light = 0, mirror = 0;
    graze_status status = find_word("--format", o->format, formats, COUNT(formats), &format, report);
    if (status == GRAZE_OK)
        status = find_word("--angles", o->angles, units, COUNT(units), &unit, report);
    if (status == GRAZE_OK)
        status = find_word("--quantity", o->quantity, quantities, COUNT(quantities), &quantity, report);
    if (status == GRAZE_OK)
        status = find_word("--light", o->light, lights, COUNT(lights), &light, report);
    if (status == GRAZE_OK)
        status = find_word("--mirror", o->mirror, mirrors, COUNT(mirrors), &mirror, report);
    *c = (fit_conventions){(fit_format)format, (fit_unit)unit, (fit_quantity)quantity, (fit_light)light,
                           (fit_mirror)mirror};
    return status;
}

static graze_status read_settings(const fit_options *o, fit_settings *s, const graze_report *report) {
    static const char *const losses[] = {"cosine", "plain", "log"};
    static const char *const roughnesses[] = {"separate", "shared"};
    int loss = 0, shared = 0;
    graze_status status = find_word("--loss", o->loss, losses, COUNT(losses), &loss, report);
    if (status == GRAZE_OK)
        status = find_word("--roughness", o->roughness, roughnesses, COUNT(roughnesses), &shared, report);
    if (status == GRAZE_OK && o->isotropic && o->anisotropic)
        status = report_error(report, NULL, "--isotropic and --anisotropic exclude each other");
    *s = (fit_settings){.anisotropic = o->anisotropic,
                        .shared = shared,
                        .loss = (fit_loss)loss,
                        .max_polar = angle_radians(o->max_angle)};
    return status;
}

/* One number for all channels, or one a channel. */
static graze_status read_total(const char *text, size_t channels, double *total, const graze_report *report) {
    size_t count = 0;
    for (const char *at = text, *end = text + strlen(text);; at++) {
        double value;
        at = number_scan(at, end, &value);
        if (!at || !(value > 0 && value <= 1) || (at != end && *at != ','))
            return report_error(report, NULL,
                                "--total-reflectance: expected numbers above 0 and up to 1, with commas "
                                "between, not '%s'",
                                text);
        if (count < channels)
            total[count] = value;
        count++;
        if (at == end)
            break;
    }
    if (count != 1 && count != channels)
        return report_error(report, NULL, "--total-reflectance: %zu numbers for %zu channels", count, channels);
    for (size_t k = count; k < channels; k++)
        total[k] = total[0];
    return GRAZE_OK;
}

/* The models that a word stands for: from the first up to, but not with, the end. */
typedef struct model_range {
    int first, end;
} model_range;

static graze_status find_models(const char *word, model_range *range, const graze_report *report) {
    graze_brdf_model model;
    *range = (model_range){0, GRAZE_BRDF_MODEL_COUNT};
    if (strcmp(word, "all") == 0)
        return GRAZE_OK;
    if (!model_find(word, &model))
        return report_error(report, NULL, "-m: there is no '%s'; expected one of %s all", word, model_list());
    *range = (model_range){(int)model, (int)model + 1};
    return GRAZE_OK;
}

/* A material's name must be one word of a scene. */
static graze_status check_name(const char *name, const graze_report *report) {
    bool good = *name != 0 && *name != '!' && *name != '#';
    for (const char *c = name; *c; c++)
        good &= *c > ' ' && *c != '"' && *c != '\'' && *c != 127;
    return good ? GRAZE_OK : report_error(report, NULL, "--name: '%s' cannot be the name of a material", name);
}

/* --- The work ---------------------------------------------------------------------------------------------------- */

static graze_status read_files(const tool_arguments *arguments, const fit_read_options *options, fit_measurements *m,
                               const graze_report *report) {
    graze_status status = GRAZE_OK;
    int inputs = 0;
    if (arguments->operand_count == 0)
        return report_error(report, NULL, "no file of measurements given; try --help");
    for (int i = 0; i < arguments->operand_count; i++)
        inputs += strcmp(arguments->operands[i], "-") == 0;
    if (inputs > 1)
        return report_error(report, NULL, "standard input can be only one of the files");
    for (int i = 0; i < arguments->operand_count && status == GRAZE_OK; i++)
        status = fit_read(m, arguments->operands[i], options, report);
    return status;
}

/* A parameter of a channel, by its place in the struct. */
static const struct {
    const char *name;
    size_t offset;
    bool of_lobe; /* the same in all channels if the roughness is shared */
} parameters[] = {{"alpha_x", offsetof(fit_channel, alpha_x), true},
                  {"alpha_y", offsetof(fit_channel, alpha_y), true},
                  {"rs", offsetof(fit_channel, rs), false},
                  {"rd", offsetof(fit_channel, rd), false}};

/* What is worth a warning of a parameter, if anything. */
static const char *weakness_of(const fit_estimate *e) {
    if (e->state != FIT_DETERMINED)
        return findings_state_name(e->state);
    return e->error > .5 * fabs(e->value) ? "known to worse than half its size" : NULL;
}

static const fit_estimate *estimate_of(const fit_channel *c, size_t offset) {
    return (const fit_estimate *)((const char *)c + offset);
}

/* One message for all channels that suffer from the same. */
static void warn_of_parameter(const findings *r, const fit_result *f, size_t parameter, const char *weakness,
                              const graze_report *report) {
    size_t channels = r->settings->shared && parameters[parameter].of_lobe ? 1 : f->channel_count, count = 0, first = 0;
    for (size_t k = channels; k-- > 0;) {
        const char *own = weakness_of(estimate_of(&f->channels[k], parameters[parameter].offset));
        if (own && strcmp(own, weakness) == 0) {
            count++;
            first = k;
        }
    }
    const char *model = model_name(f->model), *name = parameters[parameter].name;
    if (parameter == 0 && !r->settings->anisotropic)
        name = "alpha";
    if (count > 0 && channels == 1)
        report_warning(report, NULL, "%s: %s is %s", model, name, weakness);
    else if (count > 0)
        report_warning(report, NULL, "%s: %s is %s in %zu of %zu channels, %s the first", model, name, weakness, count,
                       channels, r->measurements->channels[first].text);
}

static void warn_of_quality(const findings *r, const fit_result *f, const char *where, const fit_quality *q,
                            const graze_report *report) {
    const char *model = model_name(f->model);
    if (!q->converged)
        report_warning(report, NULL, "%s%s: the least squares did not converge", model, where);
    if (q->condition > FIT_CONDITION_MAX)
        report_warning(report, NULL, "%s%s: the data hardly tell the parameters from each other (condition %.3g)",
                       model, where, q->condition);
    /* What is undetermined always has others that are as good. */
    if (!q->has_rival || q->condition == 0)
        return;
    if (r->settings->anisotropic)
        report_warning(report, NULL, "%s%s: another minimum is as good, at alpha %.4g %.4g", model, where,
                       q->rival_alpha_x, q->rival_alpha_y);
    else
        report_warning(report, NULL, "%s%s: another minimum is as good, at alpha %.4g", model, where, q->rival_alpha_x);
}

static void warn(const findings *r, const fit_result *f, const graze_report *report) {
    static const char *const weaknesses[] = {"at its lower bound", "at its upper bound", "undetermined",
                                             "known to worse than half its size"};
    for (size_t i = 0; i < COUNT(parameters); i++)
        for (size_t w = 0; w < COUNT(weaknesses); w++)
            if (i != 1 || r->settings->anisotropic)
                warn_of_parameter(r, f, i, weaknesses[w], report);
    for (size_t i = 0; i < f->fit_count; i++) {
        char where[64] = "";
        if (f->fit_count > 1)
            snprintf(where, sizeof where, " (%.50s)", r->measurements->channels[i].text);
        warn_of_quality(r, f, where, &f->qualities[i], report);
    }
}

static graze_status fit_models(findings *r, model_range models, const graze_report *report) {
    graze_status status = GRAZE_OK;
    for (int i = models.first; i < models.end && status == GRAZE_OK; i++) {
        fit_settings settings = *r->settings;
        settings.model = (graze_brdf_model)i;
        fit_result *f = &r->fits[r->fit_count++];
        status = fit_reflectance(f, r->measurements, &settings, report);
        if (status == GRAZE_OK)
            warn(r, f, report);
    }
    return status;
}

static graze_status write_findings(const findings *r, const fit_options *o, const graze_report *report) {
    record_buffer out = {0};
    if (strcmp(o->output, "json") == 0)
        findings_append_json(&out, r);
    else if (strcmp(o->output, "table") == 0)
        findings_append_table(&out, r);
    else {
        findings_append_conventions(&out, r);
        findings_append_material(&out, r);
    }
    graze_status status = record_buffer_write(&out, STDOUT_FILENO, "standard output", report);
    record_buffer_free(&out);
    return status;
}

/* All that can be wrong before a file is read. */
static graze_status prepare(const fit_options *o, model_range *models, fit_settings *s, fit_read_options *reading,
                            const graze_report *report) {
    static const char *const outputs[] = {"table", "json", "rad"};
    int output = 0;
    graze_status status = find_models(o->model, models, report);
    if (status == GRAZE_OK)
        status = read_settings(o, s, report);
    reading->columns = o->columns;
    reading->channels = o->channels;
    if (status == GRAZE_OK)
        status = read_conventions(o, &reading->conventions, report);
    if (status == GRAZE_OK)
        status = find_word("--output", o->output, outputs, COUNT(outputs), &output, report);
    if (status == GRAZE_OK && strcmp(o->output, "rad") == 0 && strcmp(o->model, "all") != 0 &&
        strcmp(o->model, "gmd") != 0)
        status = report_error(report, NULL, "--output rad: plastic2 and metal2 are the model gmd, not %s", o->model);
    if (status == GRAZE_OK)
        status = check_name(o->name, report);
    if (status == GRAZE_OK && o->plot)
        status = plot_check_name(o->plot, report);
    return status;
}

static graze_status run(void *user, const tool_arguments *arguments, const graze_report *full_report) {
    const fit_options *o = user;
    const graze_report quiet = tool_report(full_report, o->warnings), *messages = &quiet;
    fit_measurements measurements = {0};
    model_range models;
    fit_settings settings;
    fit_read_options reading = {0};
    double *total = NULL;
    findings r = {.measurements = &measurements, .settings = &settings, .name = o->name};
    graze_status status = prepare(o, &models, &settings, &reading, messages);
    if (status == GRAZE_OK)
        status = read_files(arguments, &reading, &measurements, messages);
    if (status == GRAZE_OK && o->total) {
        total = calloc(measurements.channel_count + 1, sizeof *total);
        status =
            total ? read_total(o->total, measurements.channel_count, total, messages) : report_out_of_memory(messages);
        settings.total = total;
    }
    if (status == GRAZE_OK)
        status = fit_models(&r, models, messages);
    if (status == GRAZE_OK)
        status = write_findings(&r, o, messages);
    if (status == GRAZE_OK && o->plot)
        status = plot_write(o->plot, &r, messages);
    for (size_t i = 0; i < r.fit_count; i++)
        fit_result_free(&r.fits[i]);
    free(total);
    fit_measurements_free(&measurements);
    return status;
}

int main(int argc, char **argv) {
    graze_report standard_error = options_standard_error_report("brdffit");
    fit_options o = {.model = "all",
                     .loss = "cosine",
                     .roughness = "shared",
                     .format = "any",
                     .angles = "any",
                     .quantity = "any",
                     .light = "any",
                     .mirror = "any",
                     .output = "table",
                     .name = "fitted",
                     .warnings = true,
                     .max_angle = 90};
    char models[128];
    snprintf(models, sizeof models, "%s, or all of them side by side", model_list());
    option table[] = {
        {"", OPTION_HEADING, NULL, NULL, "The fit", 0, 0, NULL, NULL},
        {"-m", OPTION_TEXT, &o.model, "MODEL", models, 0, 0, NULL, NULL},
        {"--isotropic", OPTION_FLAG, &o.isotropic, NULL, "one roughness in all directions (default)", 0, 0, NULL, NULL},
        {"--anisotropic", OPTION_FLAG, &o.anisotropic, NULL, "one along x, one along y", 0, 0, NULL, NULL},
        {"--total-reflectance", OPTION_TEXT, &o.total, "R[,R...]",
         "rd = R - rs, with R for all channels or one a channel; without it rd is free", 0, 0, NULL, NULL},
        {"--loss", OPTION_TEXT, &o.loss, "LOSS", "cosine (Eq. 20), plain or log", 0, 0, NULL, NULL},
        {"--max-angle", OPTION_REAL, &o.max_angle, "DEGREES", "leave out directions farther from the normal", 1, 90,
         NULL, NULL},
        {"--roughness", OPTION_TEXT, &o.roughness, "WHICH", "shared by all channels, or separate", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "What the files mean", 0, 0, NULL, NULL},
        {"--format", OPTION_TEXT, &o.format, "FORMAT", "table cornell alta pab merl; any: by content", 0, 0, NULL,
         NULL},
        {"--columns", OPTION_TEXT, &o.columns, "NAMES", "names of a table's columns, with commas between", 0, 0, NULL,
         NULL},
        {"--channels", OPTION_TEXT, &o.channels, "NAMES", "use only these channels or wavelengths", 0, 0, NULL, NULL},
        {"--angles", OPTION_TEXT, &o.angles, "UNIT", "degrees or radians", 0, 0, NULL, NULL},
        {"--quantity", OPTION_TEXT, &o.quantity, "WHAT", "values are brdf, brdf-cosine-out or brdf-cosine-in", 0, 0,
         NULL, NULL},
        {"--light", OPTION_TEXT, &o.light, "WHICH", "the light is the file's in or out direction", 0, 0, NULL, NULL},
        {"--mirror", OPTION_TEXT, &o.mirror, "WHERE",
         "the mirror direction has the opposite azimuth of the light, or the same", 0, 0, NULL, NULL},
        {"", OPTION_HEADING, NULL, NULL, "The result", 0, 0, NULL, NULL},
        {"--output", OPTION_TEXT, &o.output, "FORM", "table, json, or rad: a plastic2 or metal2", 0, 0, NULL, NULL},
        {"--name", OPTION_TEXT, &o.name, "NAME", "of the material", 0, 0, NULL, NULL},
        {"--plot", OPTION_TEXT, &o.plot, "FILE", "draw data and fits: .svg, .png, or .gp for gnuplot's script", 0, 0,
         NULL, NULL},
        {"-w", OPTION_FLAG, &o.warnings, NULL, "warnings", 0, 0, NULL, NULL},
    };
    option_table options = {.program = "brdffit",
                            .synopsis = "[options] file...",
                            .summary = "Fits Ward's reflectance model and its variants to measured data.",
                            .options = table,
                            .count = (int)COUNT(table)};
    return tool_main(&options, argc, argv, &standard_error, run, &o);
}
