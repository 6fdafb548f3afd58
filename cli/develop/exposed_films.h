// SPDX-License-Identifier: Apache-2.0
// The films that a picture is made of, as one.
#pragma once

#include "cli/develop/develop_arguments.h"
#include "film/develop.h"

namespace vitrail {

struct Exposed {
  std::filesystem::path file;
  Film film;
  double render_time_s = 0;
  std::uint64_t samples_per_pixel = 0;
  bool adaptive = false, complete = true;
  std::string about;
  std::vector<std::uint64_t> seeds;  // ascending
};

// The films of the command line, merged in the order of their seeds, so that their order there does not
// matter. Throws Error where they are not of one picture, or share a seed.
Exposed merge_all(const DevelopArguments& arguments);

// With what the render knew of scene and camera.
Picture picture_of(const Exposed& film);

// As a film of its own, whose seed is a number made of all seeds, so that no render goes on from it; its
// description has the seeds themselves, and it merges with films of others. Throws Error where it is not
// finished, or the file is there.
void write_merged(const std::filesystem::path& file, const Exposed& film);

}  // namespace vitrail
