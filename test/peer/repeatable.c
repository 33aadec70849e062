/* rtrace -u+ seeds its random numbers with the time of day; loaded before it, this time stands still, so that the peer
 * tests' outcome never depends on when they run. */
#include <stdlib.h>
#include <time.h>

time_t time(time_t *result) {
    const char *seed = getenv("GRAZE_PEER_SEED");
    time_t value = seed ? strtol(seed, NULL, 10) : 1;
    if (result)
        *result = value;
    return value;
}
