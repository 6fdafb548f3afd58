// SPDX-License-Identifier: Apache-2.0
// Preloaded: a disk that takes three seconds for what it is to keep.
#include <sys/syscall.h>
#include <unistd.h>

int fsync(int descriptor) {
  sleep(3);
  return (int)syscall(SYS_fsync, descriptor);
}
