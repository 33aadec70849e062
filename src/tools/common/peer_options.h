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

#endif
