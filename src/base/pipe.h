/* Pipes to and from other programs. */
#ifndef BASE_PIPE_H
#define BASE_PIPE_H

/* A pipe whose ends are none of the standard descriptors, so that they cannot be in each other's way, and closed in
 * programs that are started. Gives 0, or -1 and sets errno. */
int pipe_open(int ends[2]);

#endif
