// SPDX-License-Identifier: Apache-2.0
// A checkpoint is the film of a whole job on disk: all ranks' sums, and which work items they hold.
#pragma once

#include "farm/plan/options.h"
#include "farm/plan/rounds.h"
#include "farm/plan/work.h"
#include "farm/transport/transport.h"
#include "film/film_progress.h"

namespace vitrail {

// Returns NAME.film.partial for NAME.film, and NAME.partial for NAME.work, the work file of a picture.
std::filesystem::path checkpoint_path(const std::filesystem::path& film);

// Gathers all ranks' films and item bits on rank 0, whose film then holds everything and the others' nothing.
// All ranks call it together while no ray is alive. `done` is the rank's own bits, and becomes the job's on
// rank 0 and empty elsewhere.
void gather_film(Transport& transport, Film& film, std::vector<std::uint64_t>& done);

// Returns the words that such a film has about itself. A film that is whole does not say in which steps it
// became so.
FilmProgress progress_of(const WorkPlan& plan, const std::vector<std::uint64_t>& done, double render_time_s,
                         const std::string& about);

// It is what earlier runs left of this very job, in its film (finished, or stopped by a time limit) or in its
// checkpoint.
struct EarlierWork {
  WorkPlan plan;                    // with what is to be done first
  std::vector<std::uint64_t> done;  // bits of its items; empty: none is done
  double render_time_s = 0;         // known to rank 0
  bool finished = false;            // the film holds all that is asked for
};

// Adds to `film`, on rank 0, the samples of the file under the job's two names that holds more; every rank
// learns what it is, and what is to be done first. Throws Error where either is of another picture or seed,
// was made by another program, or aims at more than the goal's samples a pixel, and names each difference:
// its samples would be lost. A file without samples is left aside, and so is a work file whose picture was
// written. With options.outputs.force nothing is looked at. `about` is FilmProgress's, of this job.
EarlierWork read_earlier_work(Transport& transport, const RenderOptions& options, Film& film,
                              const Goal& goal, const std::string& about);

}  // namespace vitrail
