// SPDX-License-Identifier: Apache-2.0
// Preloaded: a disk that takes half a second for each part of what it is to keep.
#include <sys/syscall.h>
#include <unistd.h>

static const unsigned half_a_second_us = 500000;

ssize_t write(int descriptor, const void* bytes, size_t count) {
  if (descriptor > STDERR_FILENO && count > 4096) usleep(half_a_second_us);
  return syscall(SYS_write, descriptor, bytes, count);
}

int fsync(int descriptor) {
  usleep(half_a_second_us);
  return (int)syscall(SYS_fsync, descriptor);
}
