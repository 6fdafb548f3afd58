// SPDX-License-Identifier: Apache-2.0
// Runs keeps renders: each is a file that appears when the render is done, so that an interrupted
// measurement goes on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scene/records/image.h"

namespace vitrail {

// Runs a program of the suite, of this name and these arguments, to its end; throws where it fails. It writes
// what the program prints to a file where one is named.
using Execute = std::function<void(const std::string& program, const std::vector<std::string>& arguments,
                                   const std::filesystem::path& standard_output)>;

// A Farm is a cluster that jobs are planned on.
struct Farm {
  int ranks = 64, threads = 16;  // of a rank; no ranks: nothing is planned
};

// A PlannedJob is what `vitrail plan` says of a job there. It has no seconds where plan says nothing.
struct PlannedJob {
  double seconds = 0, efficiency = 0;
  std::string limit;  // what its efficiency is lost to
};

// A RunRequest is one render that is asked for; `profile` asks for a record beside the picture.
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
  // The constructor makes `folder`. `width` is that of the pictures, in pixels.
  Runs(std::filesystem::path scene, std::filesystem::path folder, int width, Execute execute);

  // Renders, or reads what was rendered before. A scene file that changed since is rendered again; files
  // that it names are not looked at.
  RunResult operator()(const RunRequest& request);

  // Plans a job of `times` as many samples, for a request with a profile that was rendered.
  PlannedJob plan_job(const RunRequest& request, const Farm& farm, double times);

  // Returns the pixels of the whole picture that the scene asks for, over those of one that is measured.
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
