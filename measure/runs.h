// SPDX-License-Identifier: Apache-2.0
// Renders that are kept: each is a file that appears when it is done, so that an interrupted measurement goes
// on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scene/image.h"

namespace vitrail {

// Runs a program of the suite, of this name and these arguments, to its end; throws where it fails.
using Execute = std::function<void(const std::string& program, const std::vector<std::string>& arguments)>;

// What is asked for, and what of it is not for the eye.
struct RunRequest {
  std::vector<std::string> render, partition;  // arguments
  int spp = 1;
  std::uint64_t seed = 0;
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

  // Pixels of the whole picture that the scene asks for, over those of one that is measured.
  double full_size_ratio();
  int scene_spp();  // that it asks for

 private:
  std::filesystem::path bundle(const std::vector<std::string>& partition);
  std::string key(const RunRequest& request);
  std::filesystem::path record(const RunRequest& request);

  std::filesystem::path scene_, folder_;
  int width_;
  Execute execute_;
};

}  // namespace vitrail
