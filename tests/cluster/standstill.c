// SPDX-License-Identifier: Apache-2.0
// Preloaded: on one rank one call stands still. VITRAIL_STANDSTILL is "RANK CALL NUMBER HOW FILE": the
// NUMBERth call of CALL (open, pread, mmap, fsync or an MPI function below, or barrier_of_part; of the former
// those of files with FILE in their name) HOW: "stop" stops the process as SIGSTOP does, a number sleeps so
// many seconds before each call from there on. `round` is where a rank joins one; round_after_MPI_Ireduce is
// that alone: where a film that was put together is written. When it begins it makes the file
// VITRAIL_STANDSTILL_MARK.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <mpi.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static struct {
  int rank, number;
  char call[64], how[64], file[256];
} wanted = {-1, 0, "", "", ""};
static atomic_int calls, after_reduce, within_reduce;

__attribute__((constructor)) static void read_environment(void) {
  const char* text = getenv("VITRAIL_STANDSTILL");
  if (text)
    sscanf(text, "%d %63s %d %63s %255s", &wanted.rank, wanted.call, &wanted.number, wanted.how, wanted.file);
  const char* rank = getenv("OMPI_COMM_WORLD_RANK");
  if (atoi(rank ? rank : "0") != wanted.rank || !strstr(program_invocation_short_name, "render"))
    wanted.rank = -1;
}

static void sleep_for(double seconds) {
  struct timespec left = {(time_t)seconds, (long)((seconds - (double)(time_t)seconds) * 1e9)};
  while (nanosleep(&left, &left) != 0) {
  }
}

static void stand_still(const char* call) {
  if (wanted.rank < 0 || strcmp(call, wanted.call) != 0) return;
  const int number = ++calls;
  const char* mark = getenv("VITRAIL_STANDSTILL_MARK");
  if (number == wanted.number && mark)
    close((int)syscall(SYS_openat, AT_FDCWD, mark, O_CREAT | O_WRONLY, 0644));
  if (strcmp(wanted.how, "stop") != 0) {
    if (number >= wanted.number) sleep_for(atof(wanted.how));
  } else if (number == wanted.number) {
    kill(getpid(), SIGSTOP);
  }
}

static void stand_still_at(const char* call, const char* file) {
  if (wanted.rank >= 0 && strstr(file, wanted.file)) stand_still(call);
}

static void stand_still_in(const char* call, int descriptor) {
  if (wanted.rank < 0) return;
  char link[64], file[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, file, sizeof file - 1);
  if (length < 0) return;
  file[length] = 0;
  stand_still_at(call, file);
}

#define OWN(function) ((__typeof__(&function))dlsym(RTLD_NEXT, #function))

int open(const char* file, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int mode = va_arg(more, int);
  va_end(more);
  stand_still_at("open", file);
  return OWN(open)(file, flags, mode);
}

ssize_t pread(int descriptor, void* to, size_t bytes, off_t offset) {
  stand_still_in("pread", descriptor);
  return OWN(pread)(descriptor, to, bytes, offset);
}

void* mmap(void* at, size_t bytes, int protection, int flags, int descriptor, off_t offset) {
  if (descriptor >= 0) stand_still_in("mmap", descriptor);
  return OWN(mmap)(at, bytes, protection, flags, descriptor, offset);
}

int fsync(int descriptor) {
  stand_still_in("fsync", descriptor);
  return OWN(fsync)(descriptor);
}

int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  stand_still("MPI_Init_thread");
  return PMPI_Init_thread(argc, argv, required, provided);
}

int MPI_Finalize(void) {
  stand_still("MPI_Finalize");
  return PMPI_Finalize();
}

// A reduction has one behind each MPI_Ireduce of a part; the others are of the end.
int MPI_Ibarrier(MPI_Comm of, MPI_Request* request) {
  stand_still(atomic_exchange(&within_reduce, 0) ? "barrier_of_part" : "MPI_Ibarrier");
  return PMPI_Ibarrier(of, request);
}

int MPI_Ireduce(const void* from, void* to, int count, MPI_Datatype type, MPI_Op op, int root, MPI_Comm of,
                MPI_Request* request) {
  stand_still("MPI_Ireduce");
  after_reduce = within_reduce = 1;
  return PMPI_Ireduce(from, to, count, type, op, root, of, request);
}

int MPI_Ibcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm of, MPI_Request* request) {
  stand_still("MPI_Ibcast");
  after_reduce = 0;
  return PMPI_Ibcast(buffer, count, type, root, of, request);
}

// The rounds, and what all agree on: each begins with this, of the parent, or of rank 0's first child.
enum { tag_of_rounds = 2 };
int MPI_Irecv(void* to, int count, MPI_Datatype type, int from, int tag, MPI_Comm of, MPI_Request* request) {
  int own = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  if (tag == tag_of_rounds && (from < own || (own == 0 && from == 1))) {
    stand_still("round");
    if (after_reduce) stand_still("round_after_MPI_Ireduce");
    after_reduce = 0;
  }
  return PMPI_Irecv(to, count, type, from, tag, of, request);
}

int MPI_Isend(const void* from, int count, MPI_Datatype type, int to, int tag, MPI_Comm of,
              MPI_Request* request) {
  if (tag != tag_of_rounds) stand_still("MPI_Isend");
  return PMPI_Isend(from, count, type, to, tag, of, request);
}
