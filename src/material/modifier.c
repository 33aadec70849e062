/* Compiling modifiers: what their string arguments mean, and how they hang together. */
#include "material/modifier.h"

#include <stdlib.h>
#include <string.h>

/* Mixtures within mixtures: each level may double the work. */
enum { MIXTURES_DEEP = 12 };

/* Where a type has what among its string arguments; -1: nowhere. */
typedef struct layout {
    rad_type type;
    material_modifier_kind kind;
    int values, value_count; /* functions that give the values, or expressions where there is no data */
    int data, data_count;    /* names of data files, or of a picture */
    int file;
    int places; /* expressions, one a dimension */
    bool picture;
    int arguments; /* of the functions: 1, or 3; of patterns in colour that depends on the function */
} layout;

static const layout layouts[] = {
    {RAD_COLORFUNC, MATERIAL_PATTERN, 0, 3, -1, 0, 3, -1, false, 0},
    {RAD_BRIGHTFUNC, MATERIAL_PATTERN, 0, 1, -1, 0, 1, -1, false, 0},
    {RAD_COLORDATA, MATERIAL_PATTERN, 0, 3, 3, 3, 6, 7, false, 3},
    {RAD_BRIGHTDATA, MATERIAL_PATTERN, 0, 1, 1, 1, 2, 3, false, 1},
    {RAD_COLORPICT, MATERIAL_PATTERN, 0, 3, 3, 1, 4, 5, true, 3},
    {RAD_TEXFUNC, MATERIAL_TEXTURE, 0, 3, -1, 0, 3, -1, false, 0},
    {RAD_TEXDATA, MATERIAL_TEXTURE, 0, 3, 3, 3, 6, 7, false, 3},
    {RAD_MIXFUNC, MATERIAL_MIXTURE, 2, 1, -1, 0, 3, -1, false, 0},
    {RAD_MIXDATA, MATERIAL_MIXTURE, 2, 1, 3, 1, 4, 5, false, 1},
    {RAD_MIXPICT, MATERIAL_MIXTURE, 2, 1, 3, 1, 4, 5, true, 3},
};

struct material_modifiers {
    const rad_primitive *primitives;
    size_t count;
    graze_report report;
    material_library *library;
    material_modifier **made; /* by primitive; null: not yet */
    graze_status *failed;     /* by primitive */
};

material_modifiers *material_modifiers_create(const rad_primitive *primitives, size_t count,
                                              const graze_report *report) {
    material_modifiers *m = malloc(sizeof *m);
    if (!m)
        return NULL;
    *m = (material_modifiers){.primitives = primitives, .count = count};
    m->report = report ? *report : (graze_report){NULL, NULL};
    m->library = material_library_create(report);
    m->made = calloc(count + 1, sizeof(material_modifier *));
    m->failed = calloc(count + 1, sizeof *m->failed);
    if (m->library && m->made && m->failed)
        return m;
    material_modifiers_destroy(m);
    return NULL;
}

void material_modifiers_destroy(material_modifiers *m) {
    if (!m)
        return;
    material_library_destroy(m->library);
    free(m->made);
    free(m->failed);
    free(m);
}

material_library *material_modifiers_library(material_modifiers *m) {
    return m->library;
}

static const layout *layout_of(rad_type type) {
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++)
        if (layouts[i].type == type)
            return &layouts[i];
    return NULL;
}

static bool is_unsupported_pattern(rad_type type) {
    return type == RAD_COLORTEXT || type == RAD_BRIGHTTEXT || type == RAD_MIXTEXT ||
           (type >= RAD_SPECTRUM && type <= RAD_SPECPICT);
}

/* The latest modifier of that name before the primitive. */
static graze_status find_modifier(const material_modifiers *m, const rad_primitive *p, const char *name, int *found) {
    *found = strcmp(name, "void") ? rad_modifier_before(m->primitives, p, name) : RAD_VOID;
    if (*found == RAD_VOID && strcmp(name, "void"))
        return rad_primitive_error(&m->report, p, "there is no modifier '%.64s' before it", name);
    return GRAZE_OK;
}

static graze_status make_modifier(material_modifiers *, int index, int depth, material_modifier **result);

/* The whole chain that begins with a modifier, compiled. */
static graze_status make_chain(material_modifiers *m, int modifier, int depth, const material_modifier **first) {
    graze_status worst = GRAZE_OK;
    const material_modifier **link = first;
    *first = NULL;
    for (int i = modifier; i != RAD_VOID; i = m->primitives[i].modifier) {
        bool made_before = m->made[i] != NULL;
        material_modifier *made;
        graze_status status = make_modifier(m, i, depth, &made);
        if (status > worst)
            worst = status;
        if (!made)
            break;
        *link = made;
        link = &made->next;
        /* And so is all behind it. */
        if (made_before && made->next)
            break;
    }
    return worst;
}

static const material_modifier *end_of(const material_modifier *first) {
    const material_modifier *material = NULL;
    for (const material_modifier *i = first; i; i = i->next)
        if (i->kind == MATERIAL_ITSELF || i->kind == MATERIAL_MATERIALS)
            material = i;
    return material;
}

static graze_status make_mixture(material_modifiers *m, material_modifier *made, int depth) {
    const rad_primitive *p = made->primitive;
    if (depth >= MIXTURES_DEEP)
        return rad_primitive_error(&m->report, p, "more than %d mixtures of mixtures of mixtures ...", MIXTURES_DEEP);
    graze_status status = find_modifier(m, p, p->strings[0], &made->fore);
    graze_status other = find_modifier(m, p, p->strings[1], &made->back);
    if (!status)
        status = other;
    if (!status)
        status = make_chain(m, made->fore, depth + 1, &made->fore_modifiers);
    if (!status)
        status = make_chain(m, made->back, depth + 1, &made->back_modifiers);
    if (status || (!end_of(made->fore_modifiers) && !end_of(made->back_modifiers)))
        return status;
    made->kind = MATERIAL_MATERIALS;
    if (p->modifier != RAD_VOID)
        return rad_primitive_error(&m->report, p, "a mixture of materials cannot be modified; its materials can");
    return GRAZE_OK;
}

/* Functions of what was found in data. Of a pattern in colour a function of less than three arguments gets the one
 * of its own colour; that of a texture always gets three. */
static graze_status compile_functions(material_modifiers *m, material_modifier *made, const layout *l) {
    const rad_primitive *p = made->primitive;
    cal_expression functions[3];
    const char *file = p->strings[l->file];
    for (int i = 0; i < l->value_count; i++) {
        const char *name = p->strings[l->values + i];
        int arguments = l->arguments, first = MATERIAL_OWN_CHANNEL, parameters = 3;
        if (l->kind == MATERIAL_PATTERN && arguments == 3)
            parameters = cal_program_parameter_count(material_library_program(m->library), file, name);
        if (parameters < 0)
            return report_out_of_memory(&m->report);
        bool own = parameters < 3;
        functions[i] = (cal_expression){name, own ? 1 : arguments, first + (own ? i : 0)};
    }
    return material_function_compile(&made->values, m->library, &made->owner, (uint32_t)l->file, functions,
                                     (size_t)l->value_count,
                                     CAL_CHANNEL_BITS(MATERIAL_OWN_CHANNEL, MATERIAL_OWN_CHANNEL + 2));
}

static graze_status compile_expressions(material_modifiers *m, material_function *f, const material_owner *o,
                                        const layout *l, int first, int count) {
    cal_expression expressions[RAD_DATA_DIMENSIONS];
    for (int i = 0; i < count; i++)
        expressions[i] = (cal_expression){.text = o->primitive->strings[first + i]};
    return material_function_compile(f, m->library, o, (uint32_t)l->file, expressions, (size_t)count, 0);
}

/* Reads the data; *dimensions is how many there are. */
static graze_status read_data(material_modifiers *m, material_modifier *made, const layout *l, int *dimensions) {
    const rad_primitive *p = made->primitive;
    graze_status status;
    made->data_count = l->data_count;
    *dimensions = 2;
    if (l->picture)
        return material_library_picture(m->library, p->strings[l->data], p, &made->picture);
    status = material_library_data(m->library, p->strings[l->data], p, &made->data[0]);
    if (status)
        return status;
    *dimensions = made->data[0]->dimensions;
    for (int i = 1; i < l->data_count && !status; i++) {
        status = material_library_data(m->library, p->strings[l->data + i], p, &made->data[i]);
        if (!status && made->data[i]->dimensions != *dimensions)
            status = rad_primitive_error(&m->report, p, "its data files have %d and %d dimensions", *dimensions,
                                         made->data[i]->dimensions);
    }
    return status;
}

static graze_status compile(material_modifiers *m, material_modifier *made, const layout *l) {
    const rad_primitive *p = made->primitive;
    int dimensions = 0;
    graze_status status = l->data >= 0 ? read_data(m, made, l, &dimensions) : GRAZE_OK;
    uint32_t rest = (uint32_t)(l->data >= 0 ? l->places + dimensions : l->file + 1);
    if (!status)
        status = material_owner_begin(&made->owner, m->library, p, (uint32_t)l->file, rest);
    if (status)
        return status;
    if (l->data < 0)
        return compile_expressions(m, &made->values, &made->owner, l, l->values, l->value_count);
    status = compile_expressions(m, &made->places, &made->owner, l, l->places, dimensions);
    return status ? status : compile_functions(m, made, l);
}

static graze_status make_modifier(material_modifiers *m, int index, int depth, material_modifier **result) {
    const rad_primitive *p = &m->primitives[index];
    const layout *l = layout_of(p->type);
    *result = m->made[index];
    if (*result)
        return m->failed[index];
    material_modifier *made = arena_allocate(material_library_memory(m->library), sizeof *made);
    if (!made)
        return report_out_of_memory(&m->report);
    *made = (material_modifier){.kind = l ? l->kind : MATERIAL_ITSELF, .primitive = p};
    graze_status status = GRAZE_OK;
    if (is_unsupported_pattern(p->type))
        status = rad_primitive_error(&m->report, p, "%s is not supported yet", rad_type_name(p->type));
    else if (l)
        status = compile(m, made, l);
    if (!status && made->kind == MATERIAL_MIXTURE)
        status = make_mixture(m, made, depth);
    m->failed[index] = status;
    *result = m->made[index] = made;
    return status;
}

graze_status material_chain_find(material_chain *chain, material_modifiers *m, int modifier) {
    const material_modifier *first;
    *chain = (material_chain){.material = RAD_VOID};
    graze_status status = make_chain(m, modifier, 0, &first);
    for (const material_modifier *i = first; i && !status; i = i->next) {
        if (i->kind != MATERIAL_ITSELF && i->kind != MATERIAL_MATERIALS) {
            /* The first one: what comes before the material, and what comes behind it. */
            if (!chain->modifiers)
                chain->modifiers = i;
            continue;
        }
        if (chain->material != RAD_VOID)
            return rad_primitive_error(&m->report, i->primitive, "this material modifies another one, %s",
                                       m->primitives[chain->material].id);
        chain->material = (int)(i->primitive - m->primitives);
        chain->mixture = i->kind == MATERIAL_MATERIALS ? i : NULL;
    }
    return status;
}

graze_status material_modifiers_find(const material_modifier **first, material_modifiers *m, const rad_primitive *p,
                                     const char *name) {
    int modifier;
    *first = NULL;
    graze_status status = find_modifier(m, p, name, &modifier);
    if (!status)
        status = make_chain(m, modifier, 0, first);
    if (!status && end_of(*first))
        return rad_primitive_error(&m->report, p, "'%.64s' is a material, not a pattern", name);
    return status;
}
