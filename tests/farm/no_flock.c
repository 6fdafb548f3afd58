// SPDX-License-Identifier: Apache-2.0
// Preloaded: a file system that has no locks.
#include <errno.h>

int flock(int descriptor, int operation) {
  (void)descriptor, (void)operation;
  errno = ENOSYS;
  return -1;
}
