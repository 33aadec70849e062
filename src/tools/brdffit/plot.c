/* gnuplot's script for measured and fitted values. */
#include "tools/brdffit/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/brdffit/gnuplot.h"
#include "tools/brdffit/plane.h"
#include "tools/common/model_name.h"

enum { PANELS_MAX = 12, CURVE_STEPS = 720, PANEL_WIDTH_PIXELS = 420, PANEL_HEIGHT_PIXELS = 320 };

/* What is drawn where there are several channels. */
static double mean_measured(const fit_measurements *m, size_t pair) {
    double sum = 0;
    for (size_t k = 0; k < m->channel_count; k++)
        sum += m->values[pair * m->channel_count + k];
    return sum / (double)m->channel_count;
}

static double mean_fitted(const fit_result *f, graze_vec3 l, graze_vec3 v) {
    double sum = 0;
    for (size_t k = 0; k < f->channel_count; k++)
        sum += fit_result_value(f, k, l, v);
    return sum / (double)f->channel_count;
}

static bool has_suffix(const char *file, const char *suffix) {
    size_t length = strlen(file), tail = strlen(suffix);
    return length > tail && strcmp(file + length - tail, suffix) == 0;
}

graze_status plot_check_name(const char *file, const graze_report *report) {
    if (has_suffix(file, ".svg") || has_suffix(file, ".png") || has_suffix(file, ".gp"))
        return GRAZE_OK;
    return report_error(report, NULL, "--plot: '%s' ends in none of .svg .png .gp", file);
}

static void append_point(record_buffer *out, double x, double y) {
    findings_append_number(out, 9, x);
    record_append_text(out, " ");
    findings_append_number(out, 9, y);
    record_append_text(out, "\n");
}

static void append_data(record_buffer *out, const findings *r, const plane *all, const plane_panel *panel,
                        size_t number) {
    const plane_point *points = all->points + panel->first;
    findings_append_format(out, "$measured%zu << END\n", number);
    for (size_t i = 0; i < panel->count; i++)
        append_point(out, points[i].view, mean_measured(r->measurements, points[i].pair));
    record_append_text(out, "END\n");
    for (size_t k = 0; k < r->fit_count; k++) {
        findings_append_format(out, "$fit%zu_%zu << END\n", number, k);
        for (int i = 1; i < CURVE_STEPS; i++) {
            double view = -90 + 180.0 * i / CURVE_STEPS;
            append_point(out, view, mean_fitted(&r->fits[k], plane_light(&points[0]), plane_view(&points[0], view)));
        }
        record_append_text(out, "END\n");
    }
}

/* Values that the fits reach where nothing was measured, at the horizon, must not flatten the picture. */
static double largest_value(const findings *r, const plane *all, const plane_panel *panel) {
    double most = 0;
    for (size_t i = 0; i < panel->count; i++)
        most = fmax(most, mean_measured(r->measurements, all->points[panel->first + i].pair));
    return most > 0 ? most : 1;
}

static void append_panel(record_buffer *out, const findings *r, const plane *all, const plane_panel *panel,
                         size_t number) {
    const plane_point *first = &all->points[panel->first];
    record_append_text(out, "set title 'light at ");
    findings_append_number(out, 3, first->polar);
    record_append_text(out, "°");
    if (r->settings->anisotropic) {
        record_append_text(out, ", azimuth ");
        findings_append_number(out, 3, first->azimuth);
        record_append_text(out, "°");
    }
    findings_append_format(out,
                           "'\nset key %s\nset yrange [0:", number == 0 ? "top left Left reverse samplen 1" : "off");
    findings_append_number(out, 6, 1.3 * largest_value(r, all, panel));
    findings_append_format(
        out, "]\nplot $measured%zu with points pointtype 6 pointsize 0.5 linecolor 'black' title 'measured'", number);
    for (size_t k = 0; k < r->fit_count; k++)
        findings_append_format(out, ", \\\n    $fit%zu_%zu with lines linewidth 1.5 linetype %zu title '%s'", number, k,
                               k + 1, model_name(r->fits[k].model));
    record_append_text(out, "\n");
}

/* Of many panels, some that are evenly spread, the ends among them. */
static const plane_panel *chosen_panel(const plane *all, size_t shown, size_t i) {
    return &all->panels[shown > 1 ? i * (all->panel_count - 1) / (shown - 1) : 0];
}

static void append_script(record_buffer *out, const findings *r, const plane *all, const char *file) {
    size_t shown = all->panel_count < PANELS_MAX ? all->panel_count : PANELS_MAX;
    size_t columns = (size_t)ceil(sqrt((double)shown)), rows = (shown + columns - 1) / columns;
    for (size_t i = 0; i < shown; i++)
        append_data(out, r, all, chosen_panel(all, shown, i), i);
    if (!has_suffix(file, ".gp"))
        findings_append_format(out, "set terminal %s size %zu,%zu background 'white'\n",
                               has_suffix(file, ".svg") ? "svg" : "pngcairo", columns * PANEL_WIDTH_PIXELS,
                               rows * PANEL_HEIGHT_PIXELS);
    findings_append_format(out,
                           "set encoding utf8\nset xrange [-90:90]\nset xtics 30\nset grid\n"
                           "set xlabel 'view, degrees; mirror side positive'\nset ylabel 'BRDF, 1/sr%s'\n"
                           "set multiplot layout %zu,%zu\n",
                           r->measurements->channel_count > 1 ? ", mean of the channels" : "", rows, columns);
    for (size_t i = 0; i < shown; i++)
        append_panel(out, r, all, chosen_panel(all, shown, i), i);
    record_append_text(out, "unset multiplot\n");
}

graze_status plot_write(const char *file, const findings *r, const graze_report *report) {
    plane all = {0};
    record_buffer script = {0};
    graze_status status = plane_create(&all, r->measurements, r->settings->anisotropic, report);
    if (status == GRAZE_OK && all.panel_count == 0)
        status = report_error(report, NULL,
                              "--plot: no three measurements share a plane of incidence and an incident "
                              "angle");
    if (status == GRAZE_OK) {
        append_script(&script, r, &all, file);
        status =
            has_suffix(file, ".gp") ? gnuplot_write_file(&script, file, report) : gnuplot_draw(&script, file, report);
    }
    plane_free(&all);
    record_buffer_free(&script);
    return status;
}
