/* The bytes of scene files and of the output of commands. */
#include "rad/input.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* What can be told of the size beforehand, so that large files are read in one piece. */
static size_t expected_size(int descriptor) {
    struct stat facts;
    if (fstat(descriptor, &facts) != 0 || !S_ISREG(facts.st_mode) || facts.st_size < 0)
        return 0;
    return (size_t)facts.st_size;
}

static graze_status grow(rad_text *text, size_t capacity, const graze_report *report) {
    char *bytes = realloc(text->bytes, capacity);
    if (!bytes)
        return report_out_of_memory(report);
    text->bytes = bytes;
    return GRAZE_OK;
}

static graze_status read_all(rad_text *text, int descriptor, const char *name, const place *where,
                             const graze_report *report) {
    size_t capacity = expected_size(descriptor) + 4096;
    graze_status status = grow(text, capacity, report);
    while (!status) {
        ssize_t got = read(descriptor, text->bytes + text->length, capacity - text->length - 1);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return report_file_error(report, where, "cannot read %s", name);
        text->length += (size_t)got;
        text->bytes[text->length] = 0;
        if (got == 0)
            break;
        if (capacity - text->length < 2048) {
            capacity *= 2;
            status = grow(text, capacity, report);
        }
    }
    return status;
}

graze_status rad_input_descriptor(rad_text *text, int descriptor, const char *name, const place *where,
                                  const graze_report *report) {
    *text = (rad_text){0};
    graze_status status = read_all(text, descriptor, name, where, report);
    if (status) {
        free(text->bytes);
        *text = (rad_text){0};
    }
    return status;
}

graze_status rad_input_file(rad_text *text, const char *path, const place *where, const graze_report *report) {
    *text = (rad_text){0};
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return report_file_error(report, where, "cannot open %s", path);
    graze_status status = rad_input_descriptor(text, descriptor, path, where, report);
    close(descriptor);
    return status;
}

/* A pipe whose ends are none of the standard descriptors, so that they cannot be in each other's way. */
static int open_pipe(int ends[2]) {
    int low[2];
    if (pipe(low) != 0)
        return -1;
    for (int i = 0; i < 2; ++i)
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 3);
    int trouble = errno;
    close(low[0]);
    close(low[1]);
    if (ends[0] >= 0 && ends[1] >= 0)
        return 0;
    for (int i = 0; i < 2; ++i)
        if (ends[i] >= 0)
            close(ends[i]);
    errno = trouble;
    return -1;
}

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
    if (open_pipe(data) != 0)
        return -1;
    if (open_pipe(trouble) != 0) {
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

graze_status rad_input_command(rad_text *text, const char *command, const char *directory, const place *where,
                               const graze_report *report) {
    *text = (rad_text){0};
    int output;
    pid_t child = start_shell(command, directory, &output);
    if (child < 0)
        return report_system_error(report, where, "cannot run \"%.200s\"%s%.200s", command, directory ? " in " : "",
                                   directory ? directory : "");
    graze_status status = read_all(text, output, "a command's output", where, report);
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
        *text = (rad_text){0};
    }
    return status;
}
