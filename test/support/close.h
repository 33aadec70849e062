/* Comparing doubles, which Debian 12's cmocka lacks. Include after cmocka.h. */
#ifndef TEST_SUPPORT_CLOSE_H
#define TEST_SUPPORT_CLOSE_H

#include <math.h>

#define assert_close(value, truth, tolerance)                                                                          \
    do {                                                                                                               \
        double close_value = (value), close_truth = (truth);                                                           \
        if (!(fabs(close_value - close_truth) <= (tolerance)))                                                         \
            fail_msg("%s is %.17g, not %.17g", #value, close_value, close_truth);                                      \
    } while (0)

#endif
