// SPDX-License-Identifier: Apache-2.0
// Scenes of Nori, the teaching renderer of ETH Zürich, said in Mitsuba's words: its conventions are the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::test {

// One scene as the text of a Mitsuba file, with absolute paths; `sample_count` where the file gives none.
struct NoriScene {
  std::string mitsuba;
  int width = 0, height = 0;
  double reference = 0;  // radiance of the one pixel; tests only
};

// Those of a file: its scene, or all of its test with their references.
std::vector<NoriScene> read_nori(const std::filesystem::path& file);

}  // namespace vitrail::test
