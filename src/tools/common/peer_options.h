/* Options of Radiance's that need words of their own to be taken, and then do nothing or little here. */
#ifndef TOOLS_COMMON_PEER_OPTIONS_H
#define TOOLS_COMMON_PEER_OPTIONS_H

#include "base/options.h"

/* Each is the `handle` of an option. */

/* -P FILE, -PP FILE: a server that Radiance would leave running. */
graze_status peer_take_persist(void *target, const char *suffix, int count, const char *const *words, int *used,
                               const graze_report *);
/* -ap FILE [N [N]]: a photon map. */
graze_status peer_take_photon_map(void *target, const char *suffix, int count, const char *const *words, int *used,
                                  const graze_report *);
/* -cw NM NM: the range of wavelengths. */
graze_status peer_take_wavelengths(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *);
/* -f FILE: definitions for function files. */
graze_status peer_take_definitions(void *target, const char *suffix, int count, const char *const *words, int *used,
                                   const graze_report *);
/* -e: with = or : in its word a definition, which does nothing; else the name of a file for messages, for *target, a
 * const char *. */
graze_status peer_take_expression(void *target, const char *suffix, int count, const char *const *words, int *used,
                                  const graze_report *);
/* Prints that file. */
void peer_print_error_file(void *target, FILE *);

#endif
