/* Pipes beyond the standard descriptors. */
#include "base/pipe.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

int pipe_open(int ends[2]) {
    int low[2];
    if (pipe(low) != 0)
        return -1;
    for (int i = 0; i < 2; ++i)
        ends[i] = fcntl(low[i], F_DUPFD_CLOEXEC, 3);
    int trouble = errno;
    close(low[0]);
    close(low[1]);
    if (ends[0] >= 0 && ends[1] >= 0)
        return 0;
    for (int i = 0; i < 2; ++i)
        if (ends[i] >= 0)
            close(ends[i]);
    errno = trouble;
    return -1;
}
