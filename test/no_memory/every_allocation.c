/* A tool's main under which memory runs out. The tool runs once as it is, and then again for each place in its code
 * that allocates, told apart by its innermost callers: there the allocation fails, alone and then with all that follow.
 * Every run is a process of its own. It must say that memory is missing and end as the system's fault, or go on as if
 * nothing had happened; one that is killed or loses memory (under the sanitizer) fails the test. Linked with --wrap for
 * what is wrapped below, so it reaches our own allocations and pieces of arenas, but none inside of other libraries.
 *
 * The environment may set EXPECTED_STATUS (0), how the tool ends where nothing fails. */
#include <errno.h>
#include <execinfo.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SYSTEM_ERROR = 2, BROKEN = 99, LARGEST_OUTPUT = 1 << 20, CALLERS = 5 };

/* What fails in this process, and the file that is told of it. */
static struct {
    long first, last; /* the allocations that fail, counted from 1 */
    bool all_told;    /* of each allocation its place is told, not only of those that fail */
    atomic_long count;
    int log;
} failing;

/* A number of the functions that are being called, but for this one and the next. */
static uint64_t place_of_call(void) {
    void *frames[CALLERS + 2];
    uint64_t place = 0;
    for (int i = backtrace(frames, CALLERS + 2) - 1; i >= 2; i--)
        place = (place ^ (uintptr_t)frames[i]) * 0x100000001b3u;
    return place;
}

static bool fails(void) {
    const int before = errno;
    const uint64_t place = failing.all_told ? place_of_call() : 0;
    long n = atomic_fetch_add(&failing.count, 1) + 1;
    bool now = n >= failing.first && n <= failing.last;
    if ((now || failing.all_told) && write(failing.log, &place, sizeof place) != sizeof place)
        _exit(BROKEN);
    errno = now ? ENOMEM : before;
    return now;
}

/* The function of that name, unless it is to fail. */
#define WRAP(result, name, parameters, arguments)                                                                      \
    result __real_##name parameters;                                                                                   \
    result __wrap_##name parameters;                                                                                   \
    result __wrap_##name parameters {                                                                                  \
        return fails() ? NULL : __real_##name arguments;                                                               \
    }

WRAP(void *, malloc, (size_t size), (size))
WRAP(void *, calloc, (size_t count, size_t size), (count, size))
WRAP(void *, realloc, (void *memory, size_t size), (memory, size))
WRAP(void *, aligned_alloc, (size_t alignment, size_t size), (alignment, size))
WRAP(char *, strdup, (const char *text), (text))
WRAP(char *, strndup, (const char *text, size_t most), (text, most))
WRAP(FILE *, fopen, (const char *file, const char *mode), (file, mode))
WRAP(FILE *, open_memstream, (char **text, size_t *size), (text, size))
WRAP(void *, arena_allocate, (void *memory, size_t size), (memory, size))
WRAP(char *, arena_copy_text, (void *memory, const char *text, size_t length), (memory, text, length))

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);

/* What a run writes. */
typedef struct streams {
    FILE *out, *err, *log;
} streams;

static void must(bool condition) {
    if (!condition)
        _exit(BROKEN);
}

static void empty(FILE *file) {
    must(ftruncate(fileno(file), 0) == 0 && lseek(fileno(file), 0, SEEK_SET) == 0);
}

/* Runs the tool with the allocations `first` to `last` failing; gives how it ended. */
static int run(const streams *s, long first, long last, int argc, char **argv) {
    int status = 0;
    empty(s->out);
    empty(s->err);
    empty(s->log);
    lseek(STDIN_FILENO, 0, SEEK_SET);
    pid_t child = fork();
    if (child == 0) {
        must(dup2(fileno(s->out), STDOUT_FILENO) >= 0 && dup2(fileno(s->err), STDERR_FILENO) >= 0);
        failing.first = first;
        failing.last = last;
        failing.all_told = last < first;
        failing.log = fileno(s->log);
        atomic_store(&failing.count, 0);
        exit(__real_main(argc, argv));
    }
    must(child > 0 && waitpid(child, &status, 0) == child);
    return status;
}

static size_t content(FILE *file, char text[LARGEST_OUTPUT]) {
    ssize_t length = pread(fileno(file), text, LARGEST_OUTPUT, 0);
    must(length >= 0 && length < LARGEST_OUTPUT);
    text[length] = 0;
    return (size_t)length;
}

/* The places of all allocations, in their order; *count of them. */
static uint64_t *places(FILE *log, long *count) {
    struct stat facts;
    must(fstat(fileno(log), &facts) == 0);
    uint64_t *all = __real_malloc((size_t)facts.st_size + 1);
    must(all && pread(fileno(log), all, (size_t)facts.st_size, 0) == facts.st_size);
    *count = (long)((size_t)facts.st_size / sizeof *all);
    return all;
}

static bool is_first(const uint64_t *all, long n) {
    long i = 0;
    while (all[i] != all[n])
        i++;
    return i == n;
}

/* How the tool ends where nothing fails. */
typedef struct ending {
    char out[LARGEST_OUTPUT];
    size_t length;
    int status;
} ending;

static bool ended_well(const streams *s, int status, const ending *usual) {
    static char out[LARGEST_OUTPUT], err[LARGEST_OUTPUT];
    size_t length = content(s->out, out);
    content(s->err, err);
    if (!WIFEXITED(status) || strstr(err, "Sanitizer"))
        return false;
    if (WEXITSTATUS(status) == SYSTEM_ERROR)
        return strstr(err, "memory") != NULL;
    return status == usual->status && length == usual->length && memcmp(out, usual->out, length) == 0;
}

static void show(const streams *s, long n, bool lasting, int status) {
    static char err[LARGEST_OUTPUT];
    content(s->err, err);
    printf("allocation %ld%s fails: %s %d\n%s\n", n, lasting ? " and all behind it" : "",
           WIFEXITED(status) ? "exit status" : "signal", WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status),
           err);
}

int __wrap_main(int argc, char **argv) {
    static ending usual;
    const char *expected = getenv("EXPECTED_STATUS");
    const streams s = {tmpfile(), tmpfile(), tmpfile()};
    must(s.out && s.err && s.log);
    long count, runs = 0, wrong = 0;
    usual.status = run(&s, 1, 0, argc, argv);
    usual.length = content(s.out, usual.out);
    if (!WIFEXITED(usual.status) || WEXITSTATUS(usual.status) != (expected ? atoi(expected) : 0)) {
        show(&s, 0, false, usual.status);
        return 1;
    }
    uint64_t *all = places(s.log, &count);
    for (long n = 1; n <= count; n++)
        for (int lasting = 0; lasting < 2 && is_first(all, n - 1); lasting++) {
            int status = run(&s, n, lasting ? count + 1000000 : n, argc, argv);
            runs++;
            if (ended_well(&s, status, &usual))
                continue;
            wrong++;
            show(&s, n, lasting, status);
        }
    free(all);
    printf("%ld allocations, %ld runs, %ld end badly\n", count, runs, wrong);
    return wrong > 0;
}
