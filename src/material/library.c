/* Files that functions in materials need: each is read once. */
#include "material/library.h"

#include <stdlib.h>
#include <string.h>

#include "base/fingerprint.h"
#include "image/image.h"
#include "rad/path.h"

typedef struct data_entry {
    const char *name;
    graze_status status;
    rad_data data;
    struct data_entry *next;
} data_entry;

typedef struct picture_entry {
    const char *name;
    graze_status status;
    material_picture picture;
    struct picture_entry *next;
} picture_entry;

typedef struct code_entry {
    cal_code *code;
    struct code_entry *next;
} code_entry;

struct material_library {
    arena *memory;
    graze_report report;
    cal_program *program; /* null until it is needed */
    code_entry *codes;
    data_entry *data;
    picture_entry *pictures;
};

material_library *material_library_create(const graze_report *report) {
    arena *memory = arena_create();
    material_library *library = memory ? arena_allocate(memory, sizeof *library) : NULL;
    if (!library) {
        arena_destroy(memory);
        return NULL;
    }
    *library = (material_library){.memory = memory, .report = report ? *report : (graze_report){NULL, NULL}};
    return library;
}

void material_library_destroy(material_library *library) {
    if (!library)
        return;
    for (code_entry *c = library->codes; c; c = c->next)
        cal_code_destroy(c->code);
    cal_program_destroy(library->program);
    arena_destroy(library->memory);
}

const graze_report *material_library_report(const material_library *library) {
    return &library->report;
}

arena *material_library_memory(material_library *library) {
    return library->memory;
}

cal_program *material_library_program(material_library *library) {
    return library->program;
}

static bool find_file(void *user, const char *name, const char **path) {
    material_library *library = user;
    bool found;
    const char *tried = rad_path_find(library->memory, NULL, name, &found);
    *path = found ? tried : NULL;
    return tried != NULL;
}

static graze_status need_program(material_library *library) {
    if (library->program)
        return GRAZE_OK;
    library->program = cal_program_create();
    if (!library->program)
        return report_out_of_memory(&library->report);
    return cal_program_add_scene_names(library->program, &library->report);
}

graze_status material_library_define(material_library *library, const char *text, const char *file) {
    const cal_finder finder = {find_file, library};
    graze_status status = need_program(library);
    if (status)
        return status;
    if (!text)
        return cal_program_add_file(library->program, file, &finder, NULL, &library->report);
    const place where = {.file = file};
    return cal_program_add_text(library->program, NULL, text, strlen(text), &where, &library->report);
}

graze_status material_library_use_file(material_library *library, const char *file, const rad_primitive *p) {
    const cal_finder finder = {find_file, library};
    rad_primitive_name owner = {""};
    const place where = rad_primitive_place(p, &owner);
    graze_status status = need_program(library);
    return status ? status : cal_program_use_file(library->program, file, &finder, &where, &library->report);
}

graze_status material_library_compile(material_library *library, const cal_request *request, cal_code **code) {
    code_entry *entry = arena_allocate(library->memory, sizeof *entry);
    if (!entry)
        return report_out_of_memory(&library->report);
    graze_status status = cal_compile(code, library->program, request, &library->report);
    *entry = (code_entry){*code, library->codes};
    if (!status)
        library->codes = entry;
    return status;
}

static graze_status find_path(material_library *library, const char *name, const char *kind, const rad_primitive *p,
                              const char **path) {
    bool found;
    *path = rad_path_find(library->memory, NULL, name, &found);
    if (!*path)
        return report_out_of_memory(&library->report);
    return found ? GRAZE_OK : rad_primitive_error(&library->report, p, "there is no %s %s along RAYPATH", kind, name);
}

graze_status material_library_data(material_library *library, const char *name, const rad_primitive *p,
                                   const rad_data **data) {
    data_entry *entry = library->data;
    while (entry && strcmp(entry->name, name))
        entry = entry->next;
    if (!entry) {
        const char *path;
        entry = arena_allocate(library->memory, sizeof *entry);
        if (!entry)
            return report_out_of_memory(&library->report);
        *entry = (data_entry){.name = name, .next = library->data};
        library->data = entry;
        rad_primitive_name owner = {""};
        const place where = rad_primitive_place(p, &owner);
        entry->status = find_path(library, name, "data file", p, &path);
        if (!entry->status)
            entry->status = rad_data_read(&entry->data, library->memory, path, name, &where, &library->report);
    }
    *data = &entry->data;
    return entry->status;
}

static graze_status take_picture(material_library *library, material_picture *taken, const image *picture,
                                 const rad_primitive *p) {
    size_t width = (size_t)picture->width, height = (size_t)picture->height;
    double tall = picture->pixel_aspect * (double)height / (double)width;
    if (width < 2 || height < 2)
        return rad_primitive_error(&library->report, p, "a picture of less than 2 x 2 pixels has nothing between them");
    taken->grid = (rad_data){.dimensions = 2,
                             .axes = {{.length = tall < 1 ? 1 : tall, .count = height},
                                      {.length = tall < 1 ? 1 / tall : 1, .count = width}}};
    float *values = arena_allocate(library->memory, 3 * width * height * sizeof *values);
    if (!values)
        return report_out_of_memory(&library->report);
    for (int c = 0; c < 3; c++) {
        taken->planes[c] = values;
        for (size_t row = height; row-- > 0;)
            for (size_t column = 0; column < width; column++)
                *values++ = (float)((double)picture->channels[c][row * width + column] * picture->pixel_scale[c]);
    }
    return GRAZE_OK;
}

/* ---- Pictures' messages, with the pattern that asks for the picture ---- */

typedef struct asked_report {
    const graze_report *report;
    place who;
} asked_report;

static void write_asked(void *user, graze_severity severity, const char *text) {
    const asked_report *asked = user;
    const place where = {.parent = &asked->who};
    if (severity == GRAZE_ERROR)
        report_error(asked->report, &where, "%s", text);
    else
        report_warning(asked->report, &where, "%s", text);
}

static graze_status read_image(image **picture, const char *path, const material_library *library,
                               const rad_primitive *p) {
    rad_primitive_name name = {""};
    asked_report asked = {&library->report, rad_primitive_place(p, &name)};
    return image_read(picture, path, &(graze_report){write_asked, &asked});
}

static graze_status read_picture(material_library *library, material_picture *taken, const char *name,
                                 const rad_primitive *p) {
    const char *path;
    image *picture = NULL;
    graze_status status = find_path(library, name, "picture", p, &path);
    if (!status)
        status = read_image(&picture, path, library, p);
    if (!status)
        status = take_picture(library, taken, picture, p);
    image_destroy(picture);
    return status;
}

graze_status material_library_picture(material_library *library, const char *name, const rad_primitive *p,
                                      const material_picture **picture) {
    picture_entry *entry = library->pictures;
    while (entry && strcmp(entry->name, name))
        entry = entry->next;
    if (!entry) {
        entry = arena_allocate(library->memory, sizeof *entry);
        if (!entry)
            return report_out_of_memory(&library->report);
        *entry = (picture_entry){.name = name, .next = library->pictures};
        library->pictures = entry;
        entry->status = read_picture(library, &entry->picture, name, p);
    }
    *picture = &entry->picture;
    return entry->status;
}

static uint64_t add_grid(uint64_t f, const rad_data *grid) {
    f = fingerprint_add(f, &grid->dimensions, sizeof grid->dimensions);
    for (int d = 0; d < grid->dimensions; d++) {
        const rad_data_axis *axis = &grid->axes[d];
        f = fingerprint_add(f, &axis->begin, sizeof axis->begin);
        f = fingerprint_add(f, &axis->length, sizeof axis->length);
        f = fingerprint_add(f, &axis->count, sizeof axis->count);
        if (axis->places)
            f = fingerprint_add(f, axis->places, axis->count * sizeof *axis->places);
    }
    return f;
}

static uint64_t add_plane(uint64_t f, const rad_data *grid, const float *plane) {
    size_t count = 1;
    for (int d = 0; d < grid->dimensions; d++)
        count *= grid->axes[d].count;
    return fingerprint_add(f, plane, count * sizeof *plane);
}

uint64_t material_library_fingerprint(const material_library *library) {
    uint64_t f = library->program ? cal_program_fingerprint(library->program) : FINGERPRINT_OF_NOTHING;
    for (const data_entry *e = library->data; e; e = e->next)
        if (!e->status)
            f = add_plane(add_grid(f, &e->data), &e->data, e->data.values);
    for (const picture_entry *e = library->pictures; e; e = e->next)
        for (int c = 0; c < 3 && !e->status; c++)
            f = add_plane(add_grid(f, &e->picture.grid), &e->picture.grid, e->picture.planes[c]);
    return f;
}
