/* The output of commands. */
#include "rad/command.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/pipe.h"

static void close_pipe(const int ends[2]) {
    close(ends[0]);
    close(ends[1]);
}

/* In the child, where only async-signal-safe functions may be called. Tells `trouble` what failed. */
static void become_shell(const char *command, const char *directory, int output, int trouble) {
    int nothing = open("/dev/null", O_RDONLY);
    signal(SIGPIPE, SIG_DFL);
    if (nothing >= 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(output, STDOUT_FILENO) >= 0 &&
        (!directory || chdir(directory) == 0)) {
        if (nothing > STDERR_FILENO)
            close(nothing);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    }
    int number = errno;
    ssize_t ignored = write(trouble, &number, sizeof number);
    (void)ignored;
    _exit(127);
}

static pid_t start_shell(const char *command, const char *directory, int *output) {
    int data[2], trouble[2];
    if (pipe_open(data) != 0)
        return -1;
    if (pipe_open(trouble) != 0) {
        close_pipe(data);
        return -1;
    }
    pid_t child = fork();
    if (child == 0)
        become_shell(command, directory, data[1], trouble[1]);
    int number = child < 0 ? errno : 0;
    close(data[1]);
    close(trouble[1]);
    if (child > 0) {
        ssize_t got;
        do
            got = read(trouble[0], &number, sizeof number);
        while (got < 0 && errno == EINTR);
        if (got != (ssize_t)sizeof number)
            number = 0;
        else
            while (waitpid(child, NULL, 0) < 0 && errno == EINTR)
                continue;
    }
    close(trouble[0]);
    if (number == 0) {
        *output = data[0];
        return child;
    }
    close(data[0]);
    errno = number;
    return -1;
}

static graze_status check_outcome(int outcome, const char *command, const place *where, const graze_report *report) {
    if (WIFSIGNALED(outcome))
        return report_error(report, where, "command \"%.200s\" was ended by signal %d (%s)", command, WTERMSIG(outcome),
                            strsignal(WTERMSIG(outcome)));
    if (WEXITSTATUS(outcome) != 0)
        return report_error(report, where, "command \"%.200s\" failed with status %d", command, WEXITSTATUS(outcome));
    return GRAZE_OK;
}

graze_status rad_command_output(whole_file *text, const char *command, const char *directory, const place *where,
                                const graze_report *report) {
    *text = (whole_file){0};
    int output;
    pid_t child = start_shell(command, directory, &output);
    if (child < 0)
        return report_system_error(report, where, "cannot run \"%.200s\"%s%.200s", command, directory ? " in " : "",
                                   directory ? directory : "");
    graze_status status = whole_file_read(text, output, "a command's output", where, report);
    close(output);
    int outcome;
    while (waitpid(child, &outcome, 0) < 0)
        if (errno != EINTR) {
            outcome = 0;
            if (!status)
                status = report_system_error(report, where, "cannot tell how \"%.200s\" ended", command);
            break;
        }
    if (!status)
        status = check_outcome(outcome, command, where, report);
    if (status) {
        free(text->bytes);
        *text = (whole_file){0};
    }
    return status;
}
