// SPDX-License-Identifier: Apache-2.0
// This is convert --check=peer: it asks the program of the written format what it makes of the output.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/records/film_settings.h"

namespace vitrail {

struct PeerCheck {
  std::filesystem::path in, out;
  std::vector<std::string> options;  // of reading `in`
  // These are asked about what was written and, where it is of another format, about the input: a Python with
  // Mitsuba, povray or pbrt. Empty ones are the usual ones on the path.
  std::string program, program_of_input;
};

// Loads `out` there. Mitsuba renders 64 pixels in each common variant, with 512, 2048 or 8192 samples each,
// until noise hides nothing beyond the tolerance; POV-Ray and pbrt likewise. Pictures are compared with
// those of `in` by its own program, where it is there and shows the scene, else by vitrail. Where the two
// programs differ, vitrail's picture of the input says which of them it sees alike.
//
//   {"name": "Mitsuba", "version": "3.9.1", "passed": true, "variants": [{"variant": "scalar_rgb", "loads":
//    true, "compared_with": "itself", "luminance_ratio": 1.0003, "mean_noise": 0.0007, "worst_pixel": 0.004,
//    "pixel_noise": 0.002, "tolerance": 0.01, "passed": true}]}
//   {"name": "Mitsuba", "missing": "python3 has no module mitsuba …"}
//
// "said" has the peer's own words, where it refuses; "not_compared" those on `in`, where vitrail's picture
// stands for its own. Throws UsageError for formats without a peer, and where `program` was named and is not
// there.
nlohmann::ordered_json check_in_peer(const PeerCheck& check, const FilmSettings& film);

// Returns a line for each variant, with `between` between them.
std::string peer_in_words(const nlohmann::ordered_json& peer, const char* between = "\n");

}  // namespace vitrail
