/* The progress line. */
#include "base/progress.h"

#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

#include "base/terminal.h"

enum { BAR_WIDTH = 24, LONGEST_LINE = 512 };

struct progress {
    char what[64];
    pthread_mutex_t drawing;
    int64_t started, drawn; /* milliseconds; drawn: 0 before the first time */
    double before;          /* what was done already when that came */
};

static int64_t milliseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000 + 1;
}

progress *progress_start(const char *what, bool wanted) {
    if (!wanted || !terminal_is_fancy())
        return NULL;
    progress *p = malloc(sizeof *p);
    if (!p)
        return NULL;
    snprintf(p->what, sizeof p->what, "%s", what);
    if (pthread_mutex_init(&p->drawing, NULL) != 0) {
        free(p);
        return NULL;
    }
    p->started = milliseconds();
    p->drawn = 0;
    return p;
}

static void format_duration(char text[32], int64_t duration) {
    long long seconds = duration / 1000;
    if (seconds >= 3600)
        snprintf(text, 32, "%lld:%02lld:%02lld", seconds / 3600, seconds / 60 % 60, seconds % 60);
    else
        snprintf(text, 32, "%lld:%02lld", seconds / 60, seconds % 60);
}

static size_t terminal_width(void) {
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
        return size.ws_col - 1;
    return 79;
}

/* An early estimate of the time left would be a guess: it waits for a second and a hundredth of the work. Work that was
 * done before the start, as of a picture that goes on, tells nothing of speed. */
static void format_line(char line[LONGEST_LINE], const progress *p, double done, int64_t elapsed, const char *detail) {
    char bar[BAR_WIDTH + 1], spent[32], left[32] = "-:--";
    int full = (int)(done * BAR_WIDTH);
    memset(bar, '#', (size_t)full);
    memset(bar + full, '.', (size_t)(BAR_WIDTH - full));
    bar[BAR_WIDTH] = 0;
    format_duration(spent, elapsed);
    if (elapsed >= 1000 && done - p->before >= .01)
        format_duration(left, (int64_t)((double)elapsed * (1 - done) / (done - p->before)));
    snprintf(line, LONGEST_LINE, "%s %3d%% [%s] %s spent, %s left%s%s", p->what, (int)(100 * done), bar, spent, left,
             detail ? "  " : "", detail ? detail : "");
    size_t width = terminal_width();
    if (width < LONGEST_LINE)
        line[width] = 0;
}

void progress_update(progress *p, double done, const char *detail) {
    /* Another thread that is drawing draws as good a line. */
    if (!p || pthread_mutex_trylock(&p->drawing) != 0)
        return;
    int64_t now = milliseconds();
    if (p->drawn == 0 || now - p->drawn >= 100) {
        char line[LONGEST_LINE];
        done = done > 0 ? (done < 1 ? done : 1) : 0;
        if (p->drawn == 0)
            p->before = done;
        format_line(line, p, done, now - p->started, detail);
        fprintf(stderr, TERMINAL_ERASE_LINE "%s", line);
        p->drawn = now;
    }
    pthread_mutex_unlock(&p->drawing);
}

void progress_finish(progress *p) {
    if (!p)
        return;
    if (p->drawn)
        fputs(TERMINAL_ERASE_LINE, stderr);
    pthread_mutex_destroy(&p->drawing);
    free(p);
}
