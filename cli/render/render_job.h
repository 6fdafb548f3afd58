// SPDX-License-Identifier: Apache-2.0
// A render job makes one picture, on all ranks.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

#include "cli/render/other_camera.h"
#include "cli/render/render_arguments.h"
#include "farm/files/output_lock.h"
#include "farm/transport/transport.h"

namespace vitrail {

// Takes what is known of the picture from the bundle alone, or from another scene's camera. It runs on one
// rank alone; `manifest` is the bundle's, read already.
void complete_picture(RenderArguments& arguments, const Manifest& manifest, KnownViews& views);

// Takes the right to write the film, and removes what a killed writer left half written. It runs on rank 0
// alone. Throws as wait_for_lock does, and says that it waits.
void lock_film(const RenderArguments& arguments, std::unique_ptr<OutputLock>& lock,
               std::chrono::milliseconds longest_wait = {});

struct JobSteps {
  KnownViews* views = nullptr;               // read before, on rank 0
  std::function<void()> once_written;        // write_picture_of_film's
  std::function<void(double)> expected_s{};  // of a dry run, on rank 0: how long the picture takes
};

// Interprets the arguments, checks the outputs, locks the film and renders, on all ranks
// together. Returns the exit status.
int render_job(const CLI::App& app, Transport& transport, RenderArguments& arguments);

// Does the part after that, with a film that rank 0 has locked.
int render_locked(Transport& transport, RenderArguments& arguments, const JobSteps& steps = {});

}  // namespace vitrail
