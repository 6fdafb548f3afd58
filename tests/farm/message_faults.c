// SPDX-License-Identifier: Apache-2.0
// Preloaded: a network that gives messages in two parts. The head comes as it does; the rest, and the end of
// a round or of a send, some time later, so that later ones come first; one message's rest never comes.
// VITRAIL_MESSAGE_FAULTS is "SEED MOST_MILLISECONDS RANK NUMBER": the NUMBERth message that RANK receives is
// that one. Who waits inside MPI for the rest waits as long as it takes.
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { most_held = 4096 };
static struct {
  MPI_Request request;
  double until_s;
} held[most_held];
static int held_count, messages;

static struct {
  unsigned seed;
  double most_s;
  int rank, number;
} faults = {1, 0, -1, 0};
static const double never_s = 1e30;

__attribute__((constructor)) static void read_environment(void) {
  double most_ms = 0;
  const char *text = getenv("VITRAIL_MESSAGE_FAULTS"), *rank = getenv("OMPI_COMM_WORLD_RANK");
  if (text) sscanf(text, "%u %lf %d %d", &faults.seed, &most_ms, &faults.rank, &faults.number);
  faults.most_s = most_ms * 1e-3;
  const int own = rank ? atoi(rank) : 0;
  faults.seed += (unsigned)own;
  if (own != faults.rank) faults.number = 0;
}

static double now_s(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double later_s(void) { return now_s() + faults.most_s * rand_r(&faults.seed) / RAND_MAX; }

static double arrival_s(void) { return ++messages == faults.number ? never_s : later_s(); }

static void hold(MPI_Request request, double until_s) {
  if (held_count == most_held || request == MPI_REQUEST_NULL) return;
  held[held_count].request = request;
  held[held_count++].until_s = until_s;
}

// Whether it is still under way; lets it go where it is not.
static int is_held(MPI_Request request) {
  for (int i = 0; i < held_count; ++i) {
    if (held[i].request != request) continue;
    if (now_s() < held[i].until_s) return 1;
    held[i] = held[--held_count];
    return 0;
  }
  return 0;
}

int MPI_Imrecv(void* to, int count, MPI_Datatype type, MPI_Message* message, MPI_Request* request) {
  const int result = PMPI_Imrecv(to, count, type, message, request);
  hold(*request, arrival_s());
  return result;
}

int MPI_Mrecv(void* to, int count, MPI_Datatype type, MPI_Message* message, MPI_Status* status) {
  const double until_s = arrival_s();
  while (now_s() < until_s) nanosleep(&(struct timespec){0, 1000000}, NULL);
  return PMPI_Mrecv(to, count, type, message, status);
}

// Of rounds; not of words, of a byte, which are heard again and again.
int MPI_Irecv(void* to, int count, MPI_Datatype type, int from, int tag, MPI_Comm of, MPI_Request* request) {
  const int result = PMPI_Irecv(to, count, type, from, tag, of, request);
  if (count > 1) hold(*request, later_s());
  return result;
}

// Not of words either: who sends them lets the request go at once.
int MPI_Isend(const void* from, int count, MPI_Datatype type, int to, int tag, MPI_Comm of,
              MPI_Request* request) {
  const int result = PMPI_Isend(from, count, type, to, tag, of, request);
  if (count > 1) hold(*request, later_s());
  return result;
}

int MPI_Test(MPI_Request* request, int* done, MPI_Status* status) {
  *done = 0;
  return is_held(*request) ? MPI_SUCCESS : PMPI_Test(request, done, status);
}
