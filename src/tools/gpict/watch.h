/* What happens beside a rendering: signals, checkpoints, previews, and what the user is told of its progress. */
#ifndef TOOLS_GPICT_WATCH_H
#define TOOLS_GPICT_WATCH_H

#include "picture/checkpoint.h"
#include "picture/picture.h"

typedef struct watch_settings {
    rendering *picture;
    const char *checkpoint; /* its file; null: none */
    checkpoint_labels labels;
    double checkpoint_interval; /* seconds, of each of these; 0: never */
    double preview_interval;
    double report_interval;
    bool bar; /* a progress bar, where there is a terminal for it */
    /* Writes a preview. */
    graze_status (*preview)(void *user, const graze_report *);
    void *user;
    const graze_report *report;
} watch_settings;

/* From now on SIGUSR1 and SIGCONT wait until a picture is watched. */
void watch_prepare(void);

typedef struct watch watch;

/* Watches from a thread of its own. With a checkpoint to write, SIGINT, SIGTERM and SIGHUP stop the picture (twice: end
 * the program), unless they are ignored. */
graze_status watch_start(watch **, const watch_settings *);
/* Ends watching; gives the signal that has stopped the picture, or 0. */
int watch_end(watch *);

/* Ends the program by the signal, as if it had not been waited for. */
void watch_die(int signal);

#endif
