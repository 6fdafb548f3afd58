// SPDX-License-Identifier: Apache-2.0
// Preloaded into POV-Ray: its threads poll each other with waits of 10 to 150 ms, so that a picture of 20 ms
// takes .7 s. These waits are a fiftieth here. Longer ones, which are limits of time, stay.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <time.h>

enum { second = 1000000000, longest = 200000000, share = 50 };

static long nanoseconds_between(const struct timespec* begin, const struct timespec* end) {
  const time_t seconds = end->tv_sec - begin->tv_sec;
  return seconds < 0 || seconds > 1 ? 0 : (long)seconds * second + end->tv_nsec - begin->tv_nsec;
}

int nanosleep(const struct timespec* asked, struct timespec* left) {
  struct timespec wait = *asked;
  if (wait.tv_sec == 0 && wait.tv_nsec <= longest) wait.tv_nsec /= share;
  return clock_nanosleep(CLOCK_REALTIME, 0, &wait, left);
}

int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const struct timespec* asked) {
  static int (*wait)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  if (!wait) *(void**)&wait = dlsym(RTLD_NEXT, "pthread_cond_timedwait");
  struct timespec end = *asked;
  const clockid_t clocks[] = {CLOCK_MONOTONIC,
                              CLOCK_REALTIME};  // decades apart: only that of the condition is near
  for (int i = 0; i < 2; ++i) {
    struct timespec now;
    clock_gettime(clocks[i], &now);
    const long left = nanoseconds_between(&now, asked);
    if (left <= 0 || left > longest) continue;
    const long then = now.tv_nsec + left / share;
    end = (struct timespec){now.tv_sec + then / second, then % second};
  }
  return wait(condition, mutex, &end);
}
