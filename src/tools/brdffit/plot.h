/* The paper's Figure 9: measured and fitted values over the viewing angle, a panel an incident angle. */
#ifndef TOOLS_BRDFFIT_PLOT_H
#define TOOLS_BRDFFIT_PLOT_H

#include "tools/brdffit/findings.h"

/* Checks the suffix: .svg, .png, or .gp for the script that would draw it. */
graze_status plot_check_name(const char *file, const graze_report *);

/* Draws the pairs in the plane of incidence into the file. Fails where there are none, and where gnuplot does. */
graze_status plot_write(const char *file, const findings *, const graze_report *);

#endif
