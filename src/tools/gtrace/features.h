/* What scripts ask Radiance's programs before they use it: -features. */
#ifndef TOOLS_GTRACE_FEATURES_H
#define TOOLS_GTRACE_FEATURES_H

#include "base/report.h"

/* Lists all features, or those named, each NAME or NAME=SUB,SUB ...: one that is not there is an error. */
graze_status features_answer(int count, char *const *words, const graze_report *);

#endif
