/* Taking Radiance's options that do nothing here, so that its command lines work. */
#include "tools/common/peer_options.h"

#include <string.h>

/* Checks that the option is this, without more letters, and that so many words follow it. */
static graze_status expect(const char *name, const char *suffix, int words, int count, const char *what,
                           const graze_report *report) {
    if (*suffix)
        return report_error(report, NULL, "unknown option '%s%s'", name, suffix);
    return count < words ? report_error(report, NULL, "option '%s' lacks an argument: %s", name, what) : GRAZE_OK;
}

graze_status peer_take_persist(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *report) {
    (void)target, (void)words;
    *used = 1;
    return expect("-P", strcmp(suffix, "P") == 0 ? "" : suffix, 1, count, "the name of a file", report);
}

graze_status peer_take_photon_map(void *target, const char *suffix, int count, const char *const *words, int *used,
                                  const graze_report *report) {
    int number;
    (void)target;
    for (*used = 1; *used < count && *used < 3 && text_to_integer(words[*used], &number);)
        ++*used;
    return expect("-ap", suffix, 1, count, "the name of a file", report);
}

graze_status peer_take_wavelengths(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *report) {
    double number;
    (void)target;
    graze_status status = expect("-cw", suffix, 2, count, "two wavelengths in nm", report);
    for (*used = 0; *used < 2 && status == GRAZE_OK; ++*used)
        if (!text_to_real(words[*used], &number))
            status = report_error(report, NULL, "option '-cw': '%s' is not a number", words[*used]);
    return status;
}
