// SPDX-License-Identifier: Apache-2.0
// This is convert --check: a scene that looks different when it is converted is a failed conversion.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/records/film_settings.h"

namespace vitrail {

// Compares the pictures of a scene and of what it was converted to. Both are rendered small: 64 pixels of the
// longer side, 32 samples, 256 where these leave the mean unknown, two seeds. Returns the words of `compare
// --metric ztest --json`, "passed", "luminance_ratio" …, and the "samples". `options` are those of reading
// the input. What writer and reader of that format get wrong in the same way is not seen.
nlohmann::ordered_json compare_pictures(const std::filesystem::path& in,
                                        const std::vector<std::string>& options,
                                        const std::filesystem::path& out, const FilmSettings& film);

// Returns "looks the same: luminance +0.20 % ± 0.41 %".
std::string pictures_in_words(const nlohmann::ordered_json& pictures);

// Throws UsageError where the format has no camera (.obj, .ply).
void require_checkable(const std::filesystem::path& out);

}  // namespace vitrail
