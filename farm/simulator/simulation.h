// SPDX-License-Identifier: Apache-2.0
// It simulates a job of many ranks: the schedulers are the farm's own, while threads, network and disks are
// events of a simulated clock. After every event it looks for what may never happen.
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "farm/scheduler/residency.h"
#include "farm/simulator/workload.h"

namespace vitrail {

// It is the cluster, in seconds and bytes a second.
struct Machine {
  int ranks = 1;
  int workers = 1;  // a rank
  int loaders = loaders_of_a_rank;
  std::uint64_t domain_bytes = 0;  // a rank, for domains
  std::optional<Homes> homes;      // empty: by bytes
  Distribution distribution = Distribution::automatic;
  std::int64_t rays_allowed = 0;  // alive in the whole job
  // It is a rank's memory for rays that wait; the others go to its scratch disk, and a worker that takes them
  // waits for writing and reading them.
  std::uint64_t queue_bytes = std::numeric_limits<std::uint64_t>::max();
  double scratch_bytes_s = 1e9;
  std::uint64_t bytes_a_ray = 48;
  double latency_s = 5e-6;         // of a message
  double network_bytes_s = 1e10;   // a link, each way; what comes from many senders comes one after the other
  int ranks_of_a_link = 1;         // its neighbours by number, of one node; among them nothing takes the link
  double wake_s = 6e-5;            // that a thread sleeps longer than it means to: Linux adds 50 µs
  double ray_handling_s = 1.2e-7;  // of a worker, for a ray that waits: packed, queued, unpacked
  double disk_latency_s = 1e-3;    // of a file
  double disk_bytes_s = 1e9;       // a disk, which reads one file after the other
  int ranks_of_a_disk = 1;         // its neighbours by number
  double files_s = std::numeric_limits<double>::infinity();  // that one server opens a second, for all ranks
  std::uint64_t rays_of_a_batch = 1024;
  double round_interval_s = 1e-3;
  double jitter = 0;      // any of these takes up to 1 + this times as long: messages overtake
  double patience_s = 0;  // Watch's; 0: a rank that is silent is waited for
  // It is the time before the first ray, on each rank, and after the last.
  double setup_s = 0;
  double film_bytes = 0;           // that come together on rank 0
  double reduction_bytes_s = 9e8;  // of a rank that adds up another's film: measured, two ranks on two cores
};

// It is what a checkpoint holds: whole rounds of samples, and items of the next one.
struct KeptWork {
  int rounds = 0;
  std::uint64_t items = 0;
};

// All of a rank stands still, and what comes for it waits.
struct Silence {
  int rank = -1;
  double from_s = std::numeric_limits<double>::infinity();
  double to_s = std::numeric_limits<double>::infinity();  // ∞: it is dead
};

// No file can be loaded on a rank from a moment on: the job ends everywhere.
struct DiskError {
  int rank = -1;
  double from_s = std::numeric_limits<double>::infinity();
};

// These mishaps happen on purpose.
struct Mishaps {
  int checkpoints = 0;        // at random moments
  int rounds_of_samples = 1;  // the items come so many times
  double checkpoint_mean_s = 1e-3;
  double slow_rank = 1;           // a rank whose work takes so many times as long
  std::vector<Silence> silences;  // at most one a rank
  DiskError disk_error;
  // Messages come in two parts: the head, and when the sender has heard that it came, the rest.
  bool in_two_parts = false;
  // It is the number of a message, from 0, that never arrives.
  std::optional<std::uint64_t> lost_message;
  KeptWork kept;  // of an earlier run: this one goes on from there
};

// It says that something happened that never may. The message says what, where and when.
struct InvariantBroken : std::logic_error {
  using std::logic_error::logic_error;
};

struct SimulationResult {
  double seconds = 0;     // of the clock, to the end
  double around_s = 0;    // of these before the first ray and after the last
  double busy_s = 0;      // of all workers
  double efficiency = 0;  // busy_s ÷ (seconds × workers)
  // They are the share of the time of the rank, or the link, where it is greatest. A loader waits for one
  // file at least.
  double busiest_workers = 0, busiest_loader = 0, busiest_link = 0;
  std::uint64_t events = 0, messages = 0, rays = 0, forwarded_rays = 0, loads = 0, evictions = 0;
  std::uint64_t rounds = 0, checkpoints = 0;
  std::uint64_t loaded_bytes = 0;
  std::uint64_t most_bytes = 0;      // of domains in memory: each rank's most, summed
  std::uint64_t most_alive = 0;      // rays in the whole job
  std::uint64_t spilled_rays = 0;    // that waited on a disk
  std::uint64_t given_items = 0;     // from rank to rank
  std::uint64_t most_on_a_rank = 0;  // rays that wait on one
  std::vector<int> silent;           // the job ended because these did not answer
  bool failed = false;               // it ended because of a disk
  bool stalled = false;              // it ended because nobody had anything to do
  KeptWork kept;                     // in its last checkpoint
};

// Simulates the job; the same seed gives the same run. Throws InvariantBroken.
SimulationResult simulate(const Workload& workload, const Machine& machine, const Mishaps& mishaps,
                          std::uint64_t seed);

}  // namespace vitrail
