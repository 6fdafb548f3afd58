// SPDX-License-Identifier: Apache-2.0
// The film of a whole job on disk: all ranks' sums, and which work items they hold.
#pragma once

#include "farm/transport.h"
#include "farm/work.h"
#include "film/film.h"

namespace vitrail {

std::filesystem::path checkpoint_path(const std::filesystem::path& film);

// Gathers all ranks' films and item bits on rank 0, whose film then holds everything and the others' nothing,
// and writes them there. To be called by all ranks together while no ray is alive. `done` is the rank's own
// bits, and becomes the job's on rank 0 and empty elsewhere.
void write_job_film(Transport& transport, const std::filesystem::path& file, Film& film,
                    std::vector<std::uint64_t>& done, const WorkPlan& plan, double render_time_s);

// Rank 0 reads the checkpoint into `film`; every rank gets the items it holds. Throws Error when it is of
// another picture, seed or sample count, or was made by another program.
struct Resumed {
  std::vector<std::uint64_t> done;
  double render_time_s = 0;  // known to rank 0
};
Resumed read_checkpoint(Transport& transport, const std::filesystem::path& file, Film& film,
                        const WorkPlan& plan);

}  // namespace vitrail
