/* Several threads that run the same function, the caller's among them. */
#ifndef BASE_PARALLEL_TEAM_H
#define BASE_PARALLEL_TEAM_H

/* Calls run(user, worker) for worker 0 in this thread, and for others in as many of threads - 1 more as can be started;
 * returns when all have returned. */
void parallel_run_team(int threads, void (*run)(void *user, int worker), void *user);

#endif
