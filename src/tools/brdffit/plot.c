/* gnuplot's script for measured and fitted values. */
#include "tools/brdffit/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/brdffit/gnuplot.h"
#include "tools/brdffit/plane.h"
#include "tools/common/model_name.h"

enum {
    PANELS_MAX = 12,
    CURVE_STEPS = 720,
    PANEL_WIDTH_PIXELS = 420,
    PANEL_HEIGHT_PIXELS = 320,
    KEY_HEIGHT_PIXELS = 40,
};

/* What fits reach may make the measurements so many times lower, and no more. */
#define FIT_ABOVE_DATA 4
/* A panel shows the views at which anything is higher than this part of its height, and so many degrees to both sides.
 */
#define LOW_PART    .05
#define VIEW_MARGIN 10.0

/* Lines as in the paper's figures as figures/style.gp has them: colours that the colour-blind tell apart, and dashes
 * through which a curve below, of nearly the same values, is seen. The solid one is drawn first. */
static const char *const line_styles[GRAZE_BRDF_MODEL_COUNT] = {
    [GRAZE_BRDF_GMD] = "linecolor rgb '#0072B2' linewidth 2.5 dashtype solid",
    [GRAZE_BRDF_WARD] = "linecolor rgb '#E69F00' linewidth 2 dashtype (14, 5)",
    [GRAZE_BRDF_WARD_DUER] = "linecolor rgb '#D55E00' linewidth 2 dashtype (5, 4)",
    [GRAZE_BRDF_WARD_NEUMANN] = "linecolor rgb '#009E73' linewidth 2 dashtype (14, 4, 2, 4)",
};
static const char point_style[] = "points pointtype 7 pointsize 0.5 linecolor 'black'";

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

static double curve_view(int step) {
    return -90 + 180.0 * step / CURVE_STEPS;
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
        for (int i = 1; i < CURVE_STEPS; i++)
            append_point(out, curve_view(i),
                         mean_fitted(&r->fits[k], plane_light(&points[0]), plane_view(&points[0], curve_view(i))));
        record_append_text(out, "END\n");
    }
}

/* What of a panel is to be seen: views in degrees, and values from 0 on. */
typedef struct frame {
    double left, right, top;
} frame;

static double largest_measured(const findings *r, const plane *all, const plane_panel *panel) {
    double most = 0;
    for (size_t i = 0; i < panel->count; i++)
        most = fmax(most, mean_measured(r->measurements, all->points[panel->first + i].pair));
    return most;
}

/* The fits' largest value for the step of a curve. */
static double largest_fitted(const findings *r, const plane_point *of, int step) {
    double most = 0;
    for (size_t k = 0; k < r->fit_count; k++)
        most = fmax(most, mean_fitted(&r->fits[k], plane_light(of), plane_view(of, curve_view(step))));
    return most;
}

static void widen(frame *f, double view) {
    f->left = fmin(f->left, view);
    f->right = fmax(f->right, view);
}

/* Fits count between the outermost measurements, for a peak may lie between two; what they reach at the horizon must
 * not flatten the picture. */
static frame frame_of(const findings *r, const plane *all, const plane_panel *panel) {
    const plane_point *points = all->points + panel->first;
    double first = points[0].view, last = points[panel->count - 1].view;
    double data = largest_measured(r, all, panel), fits = 0, fitted[CURVE_STEPS] = {0};
    for (int i = 1; i < CURVE_STEPS; i++)
        if (curve_view(i) >= first && curve_view(i) <= last)
            fits = fmax(fits, fitted[i] = largest_fitted(r, &points[0], i));
    frame f = {90, -90, data > 0 ? fmax(data, fmin(fits, FIT_ABOVE_DATA * data)) : fits};
    for (int i = 1; i < CURVE_STEPS; i++)
        if (fitted[i] > LOW_PART * f.top)
            widen(&f, curve_view(i));
    for (size_t i = 0; i < panel->count; i++)
        if (mean_measured(r->measurements, points[i].pair) > LOW_PART * f.top)
            widen(&f, points[i].view);
    if (f.left > f.right)
        return (frame){-90, 90, 1};
    f.left = fmax(f.left - VIEW_MARGIN, -90);
    f.right = fmin(f.right + VIEW_MARGIN, 90);
    return f;
}

static void append_range(record_buffer *out, const char *axis, double low, double high) {
    findings_append_format(out, "set %srange [", axis);
    findings_append_number(out, 6, low);
    record_append_text(out, ":");
    findings_append_number(out, 6, high);
    record_append_text(out, "]\n");
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
    record_append_text(out, "'\n");
    frame f = frame_of(r, all, panel);
    append_range(out, "x", f.left, f.right);
    append_range(out, "y", 0, 1.1 * f.top);
    for (size_t k = 0; k < r->fit_count; k++)
        findings_append_format(out, "%s$fit%zu_%zu with lines %s", k ? ", \\\n    " : "plot ", number, k,
                               line_styles[r->fits[k].model]);
    findings_append_format(out, ", \\\n    $measured%zu with %s\n", number, point_style);
}

/* A strip below all panels, so that it lies over no curve. */
static void append_key(record_buffer *out, const findings *r, double height) {
    record_append_text(out, "set origin 0, 0\nset size 1, ");
    findings_append_number(out, 6, height);
    findings_append_format(
        out,
        "\nset margins 0, 0, 0, 0\nset yrange [0:1]\nunset title\nunset border\nunset tics\n"
        "unset xlabel\nunset ylabel\nunset grid\nset key center horizontal Left reverse samplen 3 width 1 autotitle\n"
        "plot NaN with %s title 'measured'",
        point_style);
    for (size_t k = 0; k < r->fit_count; k++)
        findings_append_format(out, ", \\\n    NaN with lines %s title '%s'", line_styles[r->fits[k].model],
                               model_name(r->fits[k].model));
    record_append_text(out, "\n");
}

/* A row's panels side by side, rows from the top down to the key. */
static void append_place(record_buffer *out, size_t columns, size_t rows, double key_height, size_t i) {
    size_t row = i / columns, column = i % columns;
    double width = 1 / (double)columns, height = (1 - key_height) / (double)rows;
    const double corner_and_size[] = {width * (double)column, 1 - height * (double)(row + 1), width, height};
    const char *const before[] = {"set origin ", ", ", "\nset size ", ", "};
    for (int k = 0; k < 4; k++) {
        record_append_text(out, before[k]);
        findings_append_number(out, 6, corner_and_size[k]);
    }
    record_append_text(out, "\n");
}

/* Of many panels, some that are evenly spread, the ends among them. */
static const plane_panel *chosen_panel(const plane *all, size_t shown, size_t i) {
    return &all->panels[shown > 1 ? i * (all->panel_count - 1) / (shown - 1) : 0];
}

static void append_script(record_buffer *out, const findings *r, const plane *all, const char *file) {
    size_t shown = all->panel_count < PANELS_MAX ? all->panel_count : PANELS_MAX;
    size_t columns = (size_t)ceil(sqrt((double)shown)), rows = (shown + columns - 1) / columns;
    size_t height = rows * PANEL_HEIGHT_PIXELS + KEY_HEIGHT_PIXELS;
    double key_height = KEY_HEIGHT_PIXELS / (double)height;
    for (size_t i = 0; i < shown; i++)
        append_data(out, r, all, chosen_panel(all, shown, i), i);
    if (!has_suffix(file, ".gp"))
        findings_append_format(out, "set terminal %s size %zu,%zu background 'white'\n",
                               has_suffix(file, ".svg") ? "svg" : "pngcairo", columns * PANEL_WIDTH_PIXELS, height);
    findings_append_format(out,
                           "set encoding utf8\nset grid\nunset key\n"
                           "set xlabel 'view, degrees; mirror side positive'\nset ylabel 'BRDF, 1/sr%s'\n"
                           "set multiplot\n",
                           r->measurements->channel_count > 1 ? ", mean of the channels" : "");
    for (size_t i = 0; i < shown; i++) {
        append_place(out, columns, rows, key_height, i);
        append_panel(out, r, all, chosen_panel(all, shown, i), i);
    }
    append_key(out, r, key_height);
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
