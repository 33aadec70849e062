/* Large texts read in pieces by several threads. */
#ifndef RAD_PIECES_H
#define RAD_PIECES_H

#include "rad/source.h"

/* Whether the text is large, and there are threads for it. */
bool rad_pieces_are_worth_it(const rad_source *);
/* Reads what pieces there are; the source then stands behind them. It gives what rad_source_read gives, in the same
 * order, messages too. */
graze_status rad_pieces_read(rad_source *);

#endif
