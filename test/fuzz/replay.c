/* Feeds a fuzz target its corpus, test/fuzz/corpus/NAME for a program of that NAME, and mutations of it that are the
 * same every time. TAP: a result for each file of the corpus, with the input that failed. */
#define _DEFAULT_SOURCE /* anonymous mappings */
#include <dirent.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fuzz/target.h"

enum { MUTATIONS = 10000, INPUT_MAX = 4096 };

typedef struct input {
    uint8_t bytes[INPUT_MAX];
    size_t size;
} input;

static uint64_t random_bits(uint64_t *state) {
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

static size_t below(uint64_t *state, size_t limit) {
    return (size_t)(random_bits(state) % limit);
}

static void fail(const char *what) {
    printf("Bail out! %s\n", what);
    exit(1);
}

static int is_visible(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

static void read_seed(const char *corpus, const char *name, input *in) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", corpus, name);
    FILE *file = fopen(path, "rb");
    if (!file)
        fail(path);
    in->size = fread(in->bytes, 1, sizeof in->bytes, file);
    if (ferror(file) || fgetc(file) != EOF)
        fail(path);
    fclose(file);
}

static void feed(const input *in) {
    uint8_t *exact = malloc(in->size ? in->size : 1); /* of just this size, for the sanitizer to watch its end */
    if (!exact)
        fail("out of memory");
    memcpy(exact, in->bytes, in->size);
    LLVMFuzzerTestOneInput(exact, in->size);
    free(exact);
}

/* Opens a gap of `length` bytes at `at`, as far as there is room. */
static size_t open_gap(input *in, size_t at, size_t length) {
    if (length > sizeof in->bytes - in->size)
        length = sizeof in->bytes - in->size;
    memmove(in->bytes + at + length, in->bytes + at, in->size - at);
    in->size += length;
    return length;
}

static void insert_word(input *in, size_t at, uint64_t *state) {
    static const char *const words[] = {" ",   "\n",  ".",  "e", "-",     "+",      ",",
                                        ":",   "/",   "=",  "0", "1e308", "1e-320", "9999999999999999999",
                                        "nan", "tv=", "s=/"};
    const char *word = words[below(state, sizeof words / sizeof *words)];
    size_t length = open_gap(in, at, strlen(word));
    memcpy(in->bytes + at, word, length);
}

static void mutate_once(input *in, const input *other, uint64_t *state) {
    size_t at = below(state, in->size + 1), length = below(state, in->size - at + 1),
           from = below(state, other->size + 1);
    switch (random_bits(state) % 6) {
    case 0:
        if (at < in->size)
            in->bytes[at] ^= (uint8_t)(1u << below(state, 8));
        break;
    case 1:
        if (at < in->size)
            in->bytes[at] = (uint8_t)random_bits(state);
        break;
    case 2:
        insert_word(in, at, state);
        break;
    case 3: /* a piece goes */
        memmove(in->bytes + at, in->bytes + at + length, in->size - at - length);
        in->size -= length;
        break;
    case 4: /* a piece of another seed comes */
        length = open_gap(in, at, below(state, other->size - from + 1));
        memcpy(in->bytes + at, other->bytes + from, length);
        break;
    default: /* a piece is there twice */
        length = open_gap(in, at, length);
        if (at + 2 * length <= in->size)
            memcpy(in->bytes + at, in->bytes + at + length, length);
        break;
    }
}

static void mutate(input *in, const input *other, uint64_t *state) {
    for (size_t i = 1 + below(state, 5); i > 0; i--)
        mutate_once(in, other, state);
}

/* In a process of its own, which the target may end; `current` is shared with it. */
static void run_seed(const input *seeds, size_t count, size_t seed, int mutations, input *current) {
    uint64_t state = seed + 1;
    *current = seeds[seed];
    feed(current);
    for (int i = 0; i < mutations; i++) {
        *current = seeds[seed];
        mutate(current, &seeds[below(&state, count)], &state);
        feed(current);
    }
}

static void print_input(const input *in) {
    printf("# fails with these %zu bytes:", in->size);
    for (size_t i = 0; i < in->size; i++)
        printf("%s%02x", i % 32 ? " " : "\n# ", in->bytes[i]);
    putchar('\n');
}

static void test_seed(const input *seeds, size_t count, size_t seed, const char *name, input *current) {
    int mutations = MUTATIONS / (int)count, status = -1;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        run_seed(seeds, count, seed, mutations, current);
        exit(0);
    }
    if (child < 0 || waitpid(child, &status, 0) != child)
        fail("cannot fork");
    printf("%sok %zu - %s and %d mutations of it\n", status ? "not " : "", seed + 1, name, mutations);
    if (status)
        print_input(current);
}

int main(int argc, char **argv) {
    (void)argc;
    const char *slash = strrchr(argv[0], '/');
    char corpus[256];
    snprintf(corpus, sizeof corpus, "test/fuzz/corpus/%s", slash ? slash + 1 : argv[0]);
    struct dirent **names;
    int count = scandir(corpus, &names, is_visible, alphasort);
    if (count < 1)
        fail(corpus);
    input *seeds = calloc((size_t)count, sizeof *seeds);
    input *current = mmap(NULL, sizeof *current, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (!seeds || current == MAP_FAILED)
        fail("out of memory");
    printf("1..%d\n", count);
    for (int i = 0; i < count; i++)
        read_seed(corpus, names[i]->d_name, &seeds[i]);
    for (int i = 0; i < count; i++) {
        test_seed(seeds, (size_t)count, (size_t)i, names[i]->d_name, current);
        free(names[i]);
    }
    free(names);
    free(seeds);
    return 0;
}
