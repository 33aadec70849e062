/* The options -m, -a, -ax, -ay, -rs, -rd and -M. */
#include "tools/brdfeval/reflectance_options.h"

#include <string.h>

#include "tools/brdfeval/scene_material.h"
#include "tools/common/model_name.h"

static graze_status find_model(const char *name, graze_brdf_model *model, const graze_report *report) {
    if (model_find(name, model))
        return GRAZE_OK;
    return report_error(report, NULL, "-m: there is no model '%s'; models: %s", name, model_list());
}

/* --- Numbers ----------------------------------------------------------------------------------------------------- */

static graze_status report_expected(const reflectance_parameter *p, const char *name, const char *got,
                                    const graze_report *report) {
    char low[NUMBER_TEXT_SIZE], high[NUMBER_TEXT_SIZE];
    number_print_exact(low, p->low);
    number_print_exact(high, p->high);
    return report_error(report, NULL, "%s: expected a %s from %s to %s, got '%s'", name, p->what, low, high, got);
}

/* As read_parameter; `name` is the option's. */
static graze_status read_number(reflectance_parameter *p, const char *name, const char *suffix, int count,
                                const char *const *words, int *used, const graze_report *report) {
    if (*suffix)
        return report_error(report, NULL, "unknown option '%s%s' (brdfeval --help lists all)", name, suffix);
    if (count < 1 || !text_to_real(words[0], &p->value) || !(p->value >= p->low && p->value <= p->high))
        return report_expected(p, name, count < 1 ? "nothing" : words[0], report);
    p->given = name;
    *used = 1;
    return GRAZE_OK;
}

static graze_status read_parameter(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    reflectance_parameter *p = target;
    return read_number(p, p->name, suffix, count, words, used, report);
}

/* -a sets both roughnesses; -defaults shows them as -ax and -ay. */
static graze_status read_both(void *target, const char *suffix, int count, const char *const *words, int *used,
                              const graze_report *report) {
    reflectance_options *o = target;
    reflectance_parameter *x = &o->parameters[ALPHA_X], *y = &o->parameters[ALPHA_Y];
    graze_status status = read_number(x, "-a", suffix, count, words, used, report);
    y->value = x->value;
    y->given = x->given;
    return status;
}

/* Beside a material only what is in its way is printed, which is an error then as it is now. */
static void print_parameter(void *target, FILE *out) {
    const reflectance_parameter *p = target;
    char text[NUMBER_TEXT_SIZE];
    number_print_exact(text, p->value);
    if (p->given || !p->options->material_file)
        fprintf(out, "%s %s", p->name, text);
}

/* --- Materials --------------------------------------------------------------------------------------------------- */

static graze_status read_material(void *target, const char *suffix, int count, const char *const *words, int *used,
                                  const graze_report *report) {
    reflectance_options *o = target;
    if (*suffix)
        return report_error(report, NULL, "unknown option '-M%s' (brdfeval --help lists all)", suffix);
    if (count < 2)
        return report_error(report, NULL, "-M: expected a scene file, and the name of a material in it");
    o->material_file = words[0];
    o->material_name = words[1];
    *used = 2;
    return GRAZE_OK;
}

static void print_material(void *target, FILE *out) {
    const reflectance_options *o = target;
    if (!o->material_file)
        return;
    fputs("-M ", out);
    options_print_word(out, o->material_file);
    putc(' ', out);
    options_print_word(out, o->material_name);
}

/* --- All --------------------------------------------------------------------------------------------------------- */

void reflectance_options_begin(reflectance_options *o, option table[REFLECTANCE_OPTION_COUNT]) {
    *o = (reflectance_options){
        .model = model_name(GRAZE_BRDF_GMD),
        .parameters = {
            [ALPHA_X] = {"-ax", "roughness", GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX, .1, NULL, o},
            [ALPHA_Y] = {"-ay", "roughness", GRAZE_ROUGHNESS_MIN, GRAZE_ROUGHNESS_MAX, .1, NULL, o},
            [SPECULAR] = {"-rs", "reflectance", 0, 1, 1, NULL, o},
            [DIFFUSE] = {"-rd", "reflectance", 0, 1, 0, NULL, o},
        }};
    reflectance_parameter *p = o->parameters;
    const option entries[REFLECTANCE_OPTION_COUNT] = {
        {"", OPTION_HEADING, NULL, NULL, "Reflectance", 0, 0, NULL, NULL},
        {"-m", OPTION_TEXT, &o->model, "MODEL", model_list(), 0, 0, NULL, NULL},
        {"-a", OPTION_CUSTOM, o, "A", "roughness along x and y", 0, 0, read_both, NULL},
        {"-ax", OPTION_CUSTOM, &p[ALPHA_X], "A", "roughness along x", 0, 0, read_parameter, print_parameter},
        {"-ay", OPTION_CUSTOM, &p[ALPHA_Y], "A", "roughness along y", 0, 0, read_parameter, print_parameter},
        {"-rs", OPTION_CUSTOM, &p[SPECULAR], "R", "specular reflectance", 0, 0, read_parameter, print_parameter},
        {"-rd", OPTION_CUSTOM, &p[DIFFUSE], "R", "diffuse reflectance", 0, 0, read_parameter, print_parameter},
        {"-M", OPTION_CUSTOM, o, "FILE NAME", "in place of these, a material of a scene file, in RGB", 0, 0,
         read_material, print_material},
    };
    memcpy(table, entries, sizeof entries);
}

/* Neither takes precedence: who gives both would be surprised by either. */
static graze_status check_material(const reflectance_options *o, bool input_taken, const graze_report *report) {
    for (int i = 0; i < PARAMETER_COUNT; i++)
        if (o->parameters[i].given)
            return report_error(report, NULL, "-M takes all parameters from the material: %s does not go with it",
                                o->parameters[i].given);
    if (input_taken && strcmp(o->material_file, "-") == 0)
        return report_error(report, NULL, "-M: the file cannot be '-': records come from standard input");
    return GRAZE_OK;
}

graze_status reflectance_options_read(const reflectance_options *o, bool input_taken, reflectance *r,
                                      const graze_report *report) {
    const reflectance_parameter *p = o->parameters;
    graze_status status = find_model(o->model, &r->lobe.model, report);
    if (status == GRAZE_OK && o->material_file) {
        status = check_material(o, input_taken, report);
        return status == GRAZE_OK ? scene_material_read(r, o->material_file, o->material_name, report) : status;
    }
    r->has_lobe = true;
    r->lobe.alpha_x = p[ALPHA_X].value;
    r->lobe.alpha_y = p[ALPHA_Y].value;
    r->channels = 1;
    r->specular[0] = p[SPECULAR].value;
    r->diffuse[0] = p[DIFFUSE].value;
    return status;
}
