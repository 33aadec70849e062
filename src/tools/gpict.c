/* gpict: pictures of a scene, in rpict's manners. */
#include <unistd.h>

#include "tools/common/tool.h"
#include "tools/gpict/options.h"
#include "tools/gpict/sequence.h"
#include "tools/gpict/shot.h"
#include "tools/gpict/watch.h"

enum { COARSEST = 16 };

/* The program: its options and what has become of it. */
typedef struct program {
    gpict_options options;
    option table[GPICT_TABLE_SIZE];
    int signal;
} program;

static graze_status check(const gpict_options *o, const tool_arguments *arguments, const graze_report *report) {
    if (o->spacing > COARSEST)
        report_warning(report, NULL, "-ps %d: the spacing is %d", o->spacing, COARSEST);
    if (o->spacing < 1)
        report_warning(report, NULL, "-ps %d: the spacing is 1", o->spacing);
    if (output_color_prepare(&o->render.color).numbers != 3)
        return report_error(report, NULL, "a picture has three colors: -pRGB, -pXYZ or -pc");
    return tool_check_scenes(arguments, o->first_frame > 0, report);
}

static graze_status render_one(job *j) {
    shot *f;
    graze_status status = shot_prepare(&f, j, 0, &j->options->view, NULL);
    if (f)
        status = shot_render(f, j);
    shot_destroy(f);
    return status;
}

/* Without a scene it comes by standard input, as rpict's does; but not from a terminal, where one was forgotten. */
static tool_arguments with_scene(const tool_arguments *given, const gpict_options *o) {
    static const char *const input[] = {"-"};
    tool_arguments arguments = *given;
    if (given->operand_count == 0 && o->first_frame == 0 && !isatty(STDIN_FILENO)) {
        arguments.operands = input;
        arguments.operand_count = 1;
    }
    return arguments;
}

static graze_status run(void *user, const tool_arguments *given, const graze_report *full_report) {
    program *p = user;
    const tool_arguments with = with_scene(given, &p->options), *arguments = &with;
    const graze_report quiet = tool_report(full_report, p->options.render.warnings), *report = &quiet;
    job j = {.options = &p->options, .arguments = arguments, .report = report};
    graze_status status = render_options_begin(&p->options.render, arguments, report);
    if (status == GRAZE_OK)
        status = render_options_settings(&p->options.render, false, &j.trace, report);
    if (status == GRAZE_OK)
        status = check(&p->options, arguments, report);
    if (status == GRAZE_OK)
        status = p->options.first_frame > 0 ? sequence_render(&j) : render_one(&j);
    graze_scene_destroy(j.scene);
    p->signal = j.signal;
    return status;
}

int main(int argc, char **argv) {
    graze_report report = options_standard_error_report("gpict");
    program p = {.options = gpict_options_default()};
    gpict_options_table(&p.options, p.table);
    option_table options = {.program = "gpict",
                            .synopsis = "[options] [scene...]",
                            .summary = "Renders pictures of Radiance scenes to a stated error.",
                            .options = p.table,
                            .count = GPICT_TABLE_SIZE};
    watch_prepare();
    int status = tool_main(&options, argc, argv, &report, run, &p);
    render_options_free(&p.options.render);
    if (p.signal && status == GRAZE_OK)
        watch_die(p.signal);
    return status;
}
