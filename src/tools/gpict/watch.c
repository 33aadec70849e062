/* A thread that waits for signals and for time to pass.
 *
 * The signals are blocked in all threads, and taken here one after the other; so nothing that is done about them is
 * done in a signal handler, and no state outlives the picture. */
#define _XOPEN_SOURCE 700
#include "tools/gpict/watch.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "base/progress.h"
#include "base/terminal.h"

enum { BAR_INTERVAL = 100 };

static const int stopping[] = {SIGINT, SIGTERM, SIGHUP};
enum { STOPPING_COUNT = sizeof stopping / sizeof *stopping };

/* Something done again and again. */
typedef struct timer {
    int64_t interval, due; /* milliseconds; interval 0: never */
} timer;

struct watch {
    watch_settings settings;
    pthread_t thread;
    sigset_t awaited, before;
    atomic_bool ended;
    int signal; /* that stopped the picture */
    progress *bar;
    int64_t started;
    size_t finished_before, in_checkpoint; /* pixels */
    bool checkpoint_failed;                /* the last attempt; that has been said */
    timer redraw, checkpoint, preview, report;
};

static int64_t milliseconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static timer timer_every(double seconds) {
    int64_t interval = (int64_t)(seconds * 1000);
    if (seconds > 0 && interval == 0)
        interval = 1;
    return (timer){interval, milliseconds() + interval};
}

static bool is_due(timer *t, int64_t now) {
    if (t->interval == 0 || now < t->due)
        return false;
    t->due = now + t->interval;
    return true;
}

/* ---- What is told ---- */

static double part_done(const picture_progress *p) {
    return (double)p->finished / (double)p->total;
}

static void redraw(watch *w) {
    picture_progress now = picture_look(w->settings.picture);
    char detail[64];
    snprintf(detail, sizeof detail, "error %.3g", now.error);
    progress_update(w->bar, part_done(&now), now.finished > 0 ? detail : NULL);
}

static double hours(struct timeval t) {
    return ((double)t.tv_sec + (double)t.tv_usec / 1e6) / 3600;
}

/* The line that rpict prints, and what is new here behind it. */
static void tell(const watch *w) {
    picture_progress now = picture_look(w->settings.picture);
    struct rusage used;
    char host[256] = "";
    getrusage(RUSAGE_SELF, &used);
    gethostname(host, sizeof host - 1);
    double passed = (double)(milliseconds() - w->started) / 3600000, left = 0;
    size_t since = now.finished - w->finished_before;
    if (since > 0)
        left = passed * (double)(now.total - now.finished) / (double)since;
    fprintf(stderr,
            "%sgpict: %llu paths, %.2f%% after %.4fu %.4fs %.4fr hours on %s (PID %ld), error %.3g, %.4f hours left\n",
            terminal_is_fancy() ? TERMINAL_ERASE_LINE : "", (unsigned long long)now.paths, 100 * part_done(&now),
            hours(used.ru_utime), hours(used.ru_stime), passed, host, (long)getpid(), now.error, left);
}

/* ---- What is written ---- */

static void warn_instead(void *user, graze_severity severity, const char *text) {
    (void)severity;
    const graze_report *report = user;
    report->write(report->user, GRAZE_WARNING, text);
}

/* A checkpoint or preview that cannot be written is no reason to lose the picture. */
static graze_report only_warnings(const graze_report *report) {
    return (graze_report){warn_instead, (void *)(uintptr_t)report};
}

/* Of attempts that fail one after another only the first is told, and the one that works again. */
static void write_checkpoint(watch *w) {
    const char *file = w->settings.checkpoint;
    size_t finished = picture_look(w->settings.picture).finished;
    if (finished == w->in_checkpoint)
        return;
    const graze_report warnings = only_warnings(w->settings.report), *report = w->checkpoint_failed ? NULL : &warnings;
    bool failed = checkpoint_write(w->settings.picture, file, &w->settings.labels, report) != GRAZE_OK;
    if (!failed) {
        w->in_checkpoint = finished;
        if (w->checkpoint_failed)
            report_warning(&warnings, &(place){.file = file}, "checkpoints are written again");
    }
    w->checkpoint_failed = failed;
}

static void write_preview(const watch *w) {
    const graze_report report = only_warnings(w->settings.report);
    (void)w->settings.preview(w->settings.user, &report);
}

/* ---- Waiting ---- */

void watch_die(int signal) {
    sigset_t set;
    struct sigaction plain = {.sa_handler = SIG_DFL};
    sigemptyset(&set);
    sigaddset(&set, signal);
    sigaction(signal, &plain, NULL);
    raise(signal);
    pthread_sigmask(SIG_UNBLOCK, &set, NULL);
}

static void answer(watch *w, int signal) {
    if (atomic_load(&w->ended))
        return;
    if (signal == SIGUSR1) {
        write_preview(w);
    } else if (signal == SIGCONT) {
        tell(w);
    } else if (w->signal) {
        watch_die(signal);
    } else {
        w->signal = signal;
        picture_stop(w->settings.picture);
    }
}

static int64_t earlier(int64_t a, const timer *t) {
    return t->interval > 0 && t->due < a ? t->due : a;
}

/* Waits for a signal until something is due. 0: none came. */
static int await(const watch *w) {
    int64_t now = milliseconds(), next = now + 3600000;
    next = earlier(earlier(earlier(earlier(next, &w->redraw), &w->checkpoint), &w->preview), &w->report);
    int64_t left = next > now ? next - now : 0;
    const struct timespec timeout = {(time_t)(left / 1000), (long)(left % 1000) * 1000000};
    int signal = sigtimedwait(&w->awaited, NULL, &timeout);
    return signal > 0 ? signal : 0;
}

static void *watch_loop(void *user) {
    watch *w = user;
    redraw(w);
    while (!atomic_load(&w->ended)) {
        int signal = await(w);
        if (signal)
            answer(w, signal);
        int64_t now = milliseconds();
        if (is_due(&w->redraw, now))
            redraw(w);
        if (is_due(&w->report, now))
            tell(w);
        if (is_due(&w->preview, now))
            write_preview(w);
        if (is_due(&w->checkpoint, now))
            write_checkpoint(w);
    }
    return NULL;
}

void watch_prepare(void) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGUSR1);
    sigaddset(&set, SIGCONT);
    pthread_sigmask(SIG_BLOCK, &set, NULL);
}

static void choose_signals(watch *w) {
    sigemptyset(&w->awaited);
    sigaddset(&w->awaited, SIGUSR1);
    sigaddset(&w->awaited, SIGCONT);
    for (int i = 0; i < STOPPING_COUNT && w->settings.checkpoint; i++) {
        struct sigaction now;
        if (sigaction(stopping[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaddset(&w->awaited, stopping[i]);
    }
    pthread_sigmask(SIG_BLOCK, &w->awaited, &w->before);
}

graze_status watch_start(watch **out, const watch_settings *settings) {
    watch *w = *out = calloc(1, sizeof *w);
    if (!w)
        return report_out_of_memory(settings->report);
    w->settings = *settings;
    w->started = milliseconds();
    w->finished_before = w->in_checkpoint = picture_look(settings->picture).finished;
    w->bar = progress_start("rendering", settings->bar);
    w->redraw = timer_every(w->bar ? BAR_INTERVAL / 1000.0 : 0);
    w->checkpoint = timer_every(settings->checkpoint ? settings->checkpoint_interval : 0);
    w->preview = timer_every(settings->preview_interval);
    w->report = timer_every(settings->report_interval);
    atomic_init(&w->ended, false);
    choose_signals(w);
    errno = pthread_create(&w->thread, NULL, watch_loop, w);
    if (errno == 0)
        return GRAZE_OK;
    graze_status status = report_system_error(settings->report, NULL, "cannot start a thread");
    pthread_sigmask(SIG_SETMASK, &w->before, NULL);
    progress_finish(w->bar);
    free(w);
    *out = NULL;
    return status;
}

int watch_end(watch *w) {
    atomic_store(&w->ended, true);
    pthread_kill(w->thread, SIGUSR1);
    pthread_join(w->thread, NULL);
    progress_finish(w->bar);
    if (w->settings.report_interval > 0)
        tell(w);
    pthread_sigmask(SIG_SETMASK, &w->before, NULL);
    int signal = w->signal;
    free(w);
    return signal;
}
