/* Run by `make accuracy`: all functions of the reflectance models against arbitrary precision at millions of hard
 * pairs, with all processors. Prints the largest errors and where they are; exits with 1 where a promise is broken.
 *
 *   accuracy PAIRS [FILE]    so many pairs in double, and a quarter as many in float; worst cases into FILE */
#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include "accuracy/check.h"

enum { GROUPS = 256 }; /* to a piece of work */
enum { DOUBLE, FLOAT, FORMATS };

/* Cosines that the bounds hold down to. */
static const double least_cosine[FORMATS] = {1e-150, 0x1.44p-100 /* a float next to 1e-30 */};

typedef struct survey {
    accuracy_tally tally[FORMATS][PAIR_KINDS];
    long pieces[FORMATS]; /* of each kind */
    long next;
    pthread_mutex_t lock;
} survey;

static void merge_tally(accuracy_tally *sum, const accuracy_tally *t) {
    for (int row = 0; row < ROWS; ++row) {
        accuracy_keep_worst(&sum->worst[row], t->worst[row].ulps, t->worst[row].result, &t->worst[row].in);
        accuracy_keep_worst(&sum->naive[row], t->naive[row].ulps, t->naive[row].result, &t->naive[row].in);
        sum->tiny[row] = fmax(sum->tiny[row], t->tiny[row]);
        sum->results[row] += t->results[row];
        sum->tinies[row] += t->tinies[row];
        sum->naive_large[row] += t->naive_large[row];
    }
    sum->pairs += t->pairs;
    sum->broken += t->broken;
    if (sum->unlike == 0)
        sum->first_unlike = t->first_unlike;
    sum->unlike += t->unlike;
}

static void survey_piece(reference *r, int format, int kind, long piece, accuracy_tally *t) {
    uint64_t seed = (uint64_t)piece * 0x9e3779b97f4a7c15 + (uint64_t)(kind * FORMATS + format);
    for (int warm = 0; warm < 3; ++warm)
        seed = (uint64_t)(draw(&seed) * 0x1p53);
    for (int i = 0; i < GROUPS; ++i) {
        pair_group g;
        pairs_draw(&seed, &pair_kinds[kind], least_cosine[format], &g);
        if (format == DOUBLE) {
            accuracy_check(r, &g, PAIRS, t);
        } else {
            accuracy_round(&g);
            accuracy_check_float(r, &g, PAIRS, t);
        }
    }
}

static void *survey_pieces(void *context) {
    survey *s = context;
    reference r;
    accuracy_tally *t = malloc(sizeof *t);
    if (!t) {
        fputs("accuracy: out of memory\n", stderr);
        exit(2);
    }
    reference_start(&r);
    pthread_mutex_lock(&s->lock);
    while (s->next < PAIR_KINDS * (s->pieces[DOUBLE] + s->pieces[FLOAT])) {
        long number = s->next++, piece = number / PAIR_KINDS;
        int kind = (int)(number % PAIR_KINDS), format = piece < s->pieces[DOUBLE] ? DOUBLE : FLOAT;
        pthread_mutex_unlock(&s->lock);
        memset(t, 0, sizeof *t);
        survey_piece(&r, format, kind, piece, t);
        pthread_mutex_lock(&s->lock);
        merge_tally(&s->tally[format][kind], t);
    }
    pthread_mutex_unlock(&s->lock);
    reference_stop(&r);
    free(t);
    return NULL;
}

static void run_survey(survey *s) {
    enum { MOST = 256 };
    pthread_t threads[MOST];
    long processors = sysconf(_SC_NPROCESSORS_ONLN), count = 0;
    while (count < processors && count < MOST && pthread_create(&threads[count], NULL, survey_pieces, s) == 0)
        ++count;
    if (count == 0)
        survey_pieces(s);
    for (long i = 0; i < count; ++i)
        pthread_join(threads[i], NULL);
}

static double bound_of(int format, int row) {
    return (format == DOUBLE ? accuracy_bound : accuracy_float_bound)[accuracy_rows[row].function];
}

static double tiny_bound_of(int format, int row) {
    return (format == DOUBLE ? accuracy_tiny_bound : accuracy_tiny_float_bound)[accuracy_rows[row].function];
}

static void print_row(const char *name, double bound, const double *ulps) {
    printf("%-26s %5.3g ", name, bound);
    for (int kind = 0; kind < PAIR_KINDS; ++kind)
        printf(ulps[kind] < 1000 ? " %7.3f" : " %7.0e", ulps[kind]);
    putchar('\n');
}

static void print_heading(const char *title) {
    printf("\n%s\n%-26s %5s ", title, "", "bound");
    for (int kind = 0; kind < PAIR_KINDS; ++kind)
        printf(" %7c", 'A' + kind);
    putchar('\n');
}

static void print_tables(const survey *s, int format) {
    double ulps[PAIR_KINDS];
    print_heading(format == DOUBLE ? "double: largest error in ulp, true values in normal range"
                                   : "float: largest error in ulp, true values in normal range");
    for (int row = 0; row < ROWS; ++row) {
        for (int kind = 0; kind < PAIR_KINDS; ++kind)
            ulps[kind] = s->tally[format][kind].worst[row].ulps;
        print_row(accuracy_rows[row].name, bound_of(format, row), ulps);
    }
    print_heading("tiny true values: below the normal range, and float values below 2^-124");
    for (int row = 0; row < ROWS; ++row) {
        for (int kind = 0; kind < PAIR_KINDS; ++kind)
            ulps[kind] = s->tally[format][kind].tiny[row];
        print_row(accuracy_rows[row].name, tiny_bound_of(format, row), ulps);
    }
    if (format == FLOAT)
        return;
    print_heading("the naive formulas in double at the same pairs, normal range");
    for (int row = 0; row < ROWS; ++row) {
        for (int kind = 0; kind < PAIR_KINDS; ++kind)
            ulps[kind] = s->tally[format][kind].naive[row].ulps;
        print_row(accuracy_rows[row].name, HUGE_VAL, ulps);
    }
}

static void print_counts(const survey *s, int format) {
    printf("\n%-26s %10s %10s %14s %14s %s\n", format == DOUBLE ? "double" : "float", "pairs", "results",
           "in normal range", "naive > 100 ulp", "promises broken");
    for (int kind = 0; kind < PAIR_KINDS; ++kind) {
        const accuracy_tally *t = &s->tally[format][kind];
        long normal = 0, tiny = 0, naive = 0;
        for (int row = 0; row < ROWS; ++row) {
            normal += t->results[row];
            tiny += t->tinies[row];
            naive += t->naive_large[row];
        }
        printf("%c %-24s %10ld %10ld %14ld %15ld %ld\n", 'A' + kind, pair_kinds[kind].name, t->pairs, normal + tiny,
               normal, naive, t->broken);
    }
}

static void print_worst_cases(const survey *s, int format) {
    printf("\n%s: worst cases as alpha_x alpha_y l v\n", format == DOUBLE ? "double" : "float");
    for (int row = 0; row < ROWS; ++row)
        for (int kind = 0; kind < PAIR_KINDS; ++kind) {
            const accuracy_worst *worst = &s->tally[format][kind].worst[row];
            char text[CASE_TEXT];
            printf("%-26s %-18s %7.3f  %s\n", accuracy_rows[row].name, pair_kinds[kind].name, worst->ulps,
                   accuracy_text(&worst->in, text));
        }
}

/* The worst of each row, in any kind. */
static const accuracy_worst *worst_of_row(const survey *s, int format, int row) {
    const accuracy_worst *worst = &s->tally[format][0].worst[row];
    for (int kind = 1; kind < PAIR_KINDS; ++kind)
        if (s->tally[format][kind].worst[row].ulps > worst->ulps)
            worst = &s->tally[format][kind].worst[row];
    return worst;
}

/* The worst case of each kind and row, once. */
static bool write_worst_cases(const survey *s, const char *path) {
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    fputs("# The pairs with the largest errors in `make accuracy`, for each function, model and kind of pairs.\n"
          "# `make accuracy WORST=test/accuracy/worst.txt` writes this file.\n"
          "# alpha_x alpha_y lx ly lz vx vy vz format ulp, what of\n",
          file);
    for (int format = 0; format < FORMATS; ++format)
        for (int row = 0; row < ROWS; ++row)
            for (int kind = 0; kind < PAIR_KINDS; ++kind) {
                const accuracy_worst *worst = &s->tally[format][kind].worst[row];
                if (!(worst->ulps > .55 || worst == worst_of_row(s, format, row)))
                    continue; /* as good as it gets */
                char text[CASE_TEXT];
                fprintf(file, "%s %s %.3f, %s\n", accuracy_text(&worst->in, text),
                        format == DOUBLE ? "double" : "float", worst->ulps, accuracy_rows[row].name);
            }
    bool written = !ferror(file);
    return fclose(file) == 0 && written;
}

int main(int argc, char **argv) {
    static survey s;
    double wanted = argc > 1 ? atof(argv[1]) : 0;
    if (argc > 3 || !(wanted >= 1)) {
        fputs("usage: accuracy PAIRS [FILE]\n", stderr);
        return 2;
    }
    pthread_mutex_init(&s.lock, NULL);
    s.pieces[DOUBLE] = (long)ceil(wanted / (GROUPS * PAIRS * PAIR_KINDS));
    s.pieces[FLOAT] = (s.pieces[DOUBLE] + 3) / 4;
    run_survey(&s);

    long broken = 0, unlike = 0, pairs[FORMATS] = {0};
    puts("kinds of pairs:");
    for (int kind = 0; kind < PAIR_KINDS; ++kind)
        printf("  %c  %s\n", 'A' + kind, pair_kinds[kind].name);
    for (int format = 0; format < FORMATS; ++format)
        print_tables(&s, format);
    for (int format = 0; format < FORMATS; ++format) {
        print_counts(&s, format);
        for (int kind = 0; kind < PAIR_KINDS; ++kind) {
            pairs[format] += s.tally[format][kind].pairs;
            broken += s.tally[format][kind].broken;
            unlike += s.tally[format][kind].unlike;
        }
    }
    for (int format = 0; format < FORMATS; ++format)
        print_worst_cases(&s, format);
    for (int kind = 0; kind < PAIR_KINDS; ++kind)
        if (s.tally[DOUBLE][kind].unlike > 0) {
            const accuracy_worst *first = &s.tally[DOUBLE][kind].first_unlike;
            char text[CASE_TEXT];
            printf("\nbatch unlike scalar: %s gives %a at %s\n", accuracy_rows[(int)first->ulps].name, first->result,
                   accuracy_text(&first->in, text));
        }

    puts("\nlargest of all, ulp:");
    for (int row = 0; row < ROWS; ++row)
        printf("  %-26s double %6.3f (promised %g)   float %6.3f (promised %g)\n", accuracy_rows[row].name,
               worst_of_row(&s, DOUBLE, row)->ulps, bound_of(DOUBLE, row), worst_of_row(&s, FLOAT, row)->ulps,
               bound_of(FLOAT, row));
    printf("%ld pairs in double, %ld in float: %ld promises broken, %ld batch results unlike the scalar's\n",
           pairs[DOUBLE], pairs[FLOAT], broken, unlike);
    if (argc == 3 && !write_worst_cases(&s, argv[2])) {
        fprintf(stderr, "accuracy: cannot write %s\n", argv[2]);
        return 2;
    }
    return broken != 0 || unlike != 0;
}
