/* Scenes of few surfaces, on any processor. */
#define LANES   2
#define MASK(f) (unsigned)(((f)[0] & 1) | ((f)[1] & 2))
#include "geometry/few_look.h"

void few_look_baseline(struct query *q) {
    look_through(q);
}
