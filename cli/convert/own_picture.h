// SPDX-License-Identifier: Apache-2.0
// This renders a scene, small, by the program of its own format.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/convert/block_luminances.h"
#include "scene/system/temporary_folder.h"

namespace vitrail {

// An OwnProgram is a program that others wrote, and the format that is its own.
struct OwnProgram {
  const char *extension, *name, *usual;  // ".pov", "POV-Ray", "povray"
};
// Returns null for formats without one.
const OwnProgram* own_program(const std::filesystem::path& scene);

struct OwnPicture {
  Luminances luminances;    // empty: it shows nothing
  std::string said;         // its words then
  bool is_missing = false;  // the program is not there: `said` names it
};

// Asks Mitsuba (`program` is a Python that has it) for 1024 samples of each pixel of `size`, and pbrt for as
// many or more. Asks POV-Ray for 8 × 8 antialiased pixels of each. pbrt's scene is copied beside itself
// meanwhile, with another size of its film. Formats without a program show nothing.
OwnPicture own_picture(const std::filesystem::path& scene, const std::string& program, SmallPicture size,
                       const TemporaryFolder& folder);

// This is what mitsuba_peer.inc answers, or null and the words of a program that fails.
struct Answer {
  nlohmann::ordered_json json;
  std::string said;
  bool is_missing = false;
};
// Runs the script with `words` as its arguments.
Answer ask_mitsuba(const std::string& python, const std::vector<std::string>& words,
                   const TemporaryFolder& folder);

// Returns the line of a program's words that says what is wrong: the last that has "Error", else the last.
std::string last_words(const std::string& file);

}  // namespace vitrail
