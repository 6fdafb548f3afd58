// SPDX-License-Identifier: Apache-2.0
// A JobPlan says what a job is to do and in how much memory: it is a function of the manifest and the options
// alone. Nothing is traced, sent or allocated before it stands; `--dry-run` prints its memory and an estimate
// of the time.
#pragma once

#include "farm/plan/memory.h"
#include "farm/plan/options.h"
#include "farm/plan/rounds.h"
#include "farm/scheduler/homes.h"
#include "farm/scheduler/scheduler.h"
#include "film/film.h"

namespace vitrail {

// It says which rank this is, of how many.
struct Place {
  int rank = 0, ranks = 1;
};

// They are bytes of this rank once the scene is read: what it holds, the most that it held, and room for
// tiles of images that are read later.
struct SceneMemory {
  std::uint64_t resident = 0, peak = 0, textures = 0;
};

struct JobPlan {
  int threads = 1;  // of this rank
  Goal goal;
  FilmKey key;
  SceneMemory scene;
  std::uint64_t base_bytes = 0;  // resident once tables are there: film, domains and rays aside
  FilmMemory film;
  MemoryPlan memory;
  std::uint64_t all_domains = 0;  // bytes
  std::size_t most_photons = 0;   // in memory, of those that land here; 0: no limit
  Homes homes{{}, 1};
  // The job may settle its homes (run/settling.h), and sets this aside for the profile until then.
  bool may_settle = false;
  std::uint64_t profile_bytes = 0;
  QueueBounds queues;
  Scheduler::Job scheduler;
};

// Returns the bytes for tiles of images: all of them if there is no limit (memory_bytes = 0), else a quarter
// of it at most.
std::uint64_t texture_budget(const Manifest& manifest, std::uint64_t memory_bytes);

// Plans the job. `manifest` is read_job_manifest's. It reads the profile that options.resources.homes names.
// Throws MachineError where options.resources.memory_bytes is too little, with what would do.
JobPlan plan_job(const Manifest& manifest, const RenderOptions& options, const Place& place,
                 const SceneMemory& scene);

// Returns the bytes of the file of such a film: its sums, and what it says of itself.
std::uint64_t film_file_bytes(const FilmSettings& film, const FilmKey& key);

}  // namespace vitrail
