// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "farm/files/film_keeper.h"
#include "farm/plan/job_plan.h"
#include "tracer/prepared/render_scene.h"

namespace vitrail {

// A rank holds it from the first step of a render to the last.
struct Job {
  std::unique_ptr<RenderScene> scene;
  std::string about;  // of its film (about.h)
  JobPlan plan;
  Film film;
  std::unique_ptr<FilmKeeper> keeper;  // on rank 0, unless it is a dry run
};

// Reads the bundle. A bundle that is too large for its memory is refused before it takes the memory.
Job set_up(const RenderOptions& options, const Place& place);

}  // namespace vitrail
