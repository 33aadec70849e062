/* A child process: script on its standard input, picture from its standard output. */
#include "tools/brdffit/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/pipe.h"

extern char **environ;

static int create(const char *file) {
    return open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

/* Closes it, and removes it after a failure, unless it is no ordinary file of ours. */
static graze_status close_file(int descriptor, const char *file, graze_status status, const graze_report *report) {
    if (close(descriptor) != 0 && status == GRAZE_OK)
        status = report_system_error(report, &(place){.file = file}, "cannot write it");
    if (status != GRAZE_OK)
        unlink(file);
    return status;
}

graze_status gnuplot_write_file(record_buffer *buffer, const char *file, const graze_report *report) {
    int descriptor = create(file);
    if (descriptor < 0)
        return report_file_error(report, &(place){.file = file}, "cannot create it");
    return close_file(descriptor, file, record_buffer_write(buffer, descriptor, file, report), report);
}

/* posix_spawnp's error number. The child gets the signals back that the tool ignores. */
static int start(pid_t *child, int input, int output) {
    static char name[] = "gnuplot", defaults[] = "-d";
    char *const words[] = {name, defaults, NULL};
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t signals;
    int trouble = posix_spawn_file_actions_init(&actions);
    if (trouble)
        return trouble;
    trouble = posix_spawnattr_init(&attributes);
    if (!trouble) {
        sigemptyset(&signals);
        sigaddset(&signals, SIGPIPE);
        posix_spawnattr_setsigdefault(&attributes, &signals);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        trouble = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
        if (!trouble)
            trouble = posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
        if (!trouble)
            trouble = posix_spawnp(child, name, &actions, &attributes, words, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return trouble;
}

static graze_status wait_for(pid_t child, const graze_report *report) {
    int outcome;
    while (waitpid(child, &outcome, 0) < 0)
        if (errno != EINTR)
            return report_system_error(report, NULL, "cannot tell how gnuplot ended");
    if (WIFSIGNALED(outcome))
        return report_error(report, NULL, "gnuplot was ended by signal %d", WTERMSIG(outcome)), GRAZE_SYSTEM_ERROR;
    if (WEXITSTATUS(outcome) != 0)
        return report_error(report, NULL, "gnuplot failed with status %d", WEXITSTATUS(outcome)), GRAZE_SYSTEM_ERROR;
    return GRAZE_OK;
}

static graze_status run(record_buffer *script, int output, const graze_report *report) {
    int ends[2];
    pid_t child = -1;
    if (pipe_open(ends) != 0)
        return report_system_error(report, NULL, "cannot make a pipe to gnuplot");
    errno = start(&child, ends[0], output);
    int trouble = errno;
    close(ends[0]);
    graze_status status = GRAZE_OK;
    if (trouble) {
        errno = trouble;
        status = report_system_error(report, NULL,
                                     "cannot run gnuplot, which draws the picture (a name that ends in .gp "
                                     "gets the script instead)");
    } else {
        status = record_buffer_write(script, ends[1], "gnuplot", report);
    }
    close(ends[1]);
    if (!trouble) {
        graze_status outcome = wait_for(child, report);
        status = status == GRAZE_OK ? outcome : status;
    }
    return status;
}

graze_status gnuplot_draw(record_buffer *script, const char *file, const graze_report *report) {
    int descriptor = create(file);
    if (descriptor < 0)
        return report_file_error(report, &(place){.file = file}, "cannot create it");
    return close_file(descriptor, file, run(script, descriptor, report), report);
}
