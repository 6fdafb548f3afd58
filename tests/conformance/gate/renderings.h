// SPDX-License-Identifier: Apache-2.0
// What two renderers make of scenes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/records/scene.h"
#include "tests/conformance/gate/block_means.h"

namespace vitrail::test {

struct Sampling {
  int samples = 24, seeds = 12;
};

// Of this renderer.
std::vector<BlockMeans> rendered(const Scene& scene, const Sampling& sampling);
// Whether this renderer shows all that the scene says.
bool renders_exactly(const Scene& scene);

// Of Mitsuba, one for each file.
struct MitsubaAnswer {
  std::string refused;  // "" where it was loaded
  std::vector<std::string> warnings;
  std::vector<BlockMeans> means;  // of each seed
};
std::vector<MitsubaAnswer> rendered_by_mitsuba(const std::vector<std::filesystem::path>& scenes,
                                               const Sampling& sampling, const std::filesystem::path& folder);

// The first of $VITRAIL_MITSUBA_PYTHON, python3 and /usr/bin/python3 that can import mitsuba; "" if none.
const std::string& python_with_mitsuba();

}  // namespace vitrail::test
