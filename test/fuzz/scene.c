/* Fuzz target: scene files, and octrees in their place. Whatever they hold is read or refused; and what is read is fit
 * to use. Commands are taken apart, and xform is done, but nothing is run. */
#include "fuzz/scene_files.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    int errors = 0;
    const graze_report report = {count_error, &errors};
    const char *name = "input.rad";
    if (has_large_array(data, size))
        return 0;
    set_input(name, data, size);
    rad_scene *scene;
    graze_status status = rad_scene_read(&scene, &name, 1, &report);
    check_outcome(status, scene, errors);
    MUST(errors <= 20);
    if (scene)
        check_primitives(scene);
    rad_scene_destroy(scene);
    return 0;
}
