// SPDX-License-Identifier: Apache-2.0
// Renders that are kept: each is a file that appears when it is done, so that an interrupted measurement goes
// on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// Runs a program of the suite, of this name and these arguments, to its end; throws where it fails. What it
// prints goes to a file where one is named.
using Execute = std::function<void(const std::string& program, const std::vector<std::string>& arguments,
                                   const std::filesystem::path& standard_output)>;

// A cluster that jobs are planned on.
struct Farm {
  int ranks = 64, threads = 16;  // of a rank; no ranks: nothing is planned
};

// What `vitrail plan` says of a job there. Without seconds where it says nothing.
struct PlannedJob {
  double seconds = 0, efficiency = 0;
  std::string limit;  // what its efficiency is lost to
};

// What is asked for, and what of it is not for the eye.
struct RunRequest {
  std::vector<std::string> render, partition;  // arguments
  int spp = 1;
  std::uint64_t seed = 0;
  bool profile = false;  // keep where its rays went
};

struct RunResult {
  Image picture;  // linear sRGB
  double cpu_s = 0, wall_s = 0;
  double rays = 0;
  double peak_memory_bytes = 0, bundle_bytes = 0;
  std::string film_hash;
};

class Runs {
 public:
  // `folder` is made. `width`: of the pictures, in pixels.
  Runs(std::filesystem::path scene, std::filesystem::path folder, int width, Execute execute);

  // Renders, or reads what was rendered before. A scene file that changed since is rendered again; files that
  // it names are not looked at.
  RunResult operator()(const RunRequest& request);

  // Of `times` as many samples, for a request with a profile that was rendered.
  PlannedJob plan_job(const RunRequest& request, const Farm& farm, double times);

  // Pixels of the whole picture that the scene asks for, over those of one that is measured.
  double full_size_ratio();
  int scene_spp();         // that it asks for
  bool scene_is_direct();  // asks for direct light alone

 private:
  std::filesystem::path bundle(const std::vector<std::string>& partition);
  std::string key(const RunRequest& request);
  std::filesystem::path record(const RunRequest& request);

  std::filesystem::path scene_, folder_;
  int width_;
  Execute execute_;
};

}  // namespace vitrail
