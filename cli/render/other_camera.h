// SPDX-License-Identifier: Apache-2.0
// This file reads the camera alone of another scene than the bundle's.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "bundle/view.h"

namespace vitrail {

// KnownViews are the views of scenes as text, by their files: read once for all frames.
using KnownViews = std::map<std::filesystem::path, std::string>;

// Returns what view_from_text takes. vitrail-partition reads the scene; what it writes lies beside `output`
// for a moment. Throws what run_program does.
std::string text_of_view(const std::filesystem::path& scene, const std::filesystem::path& output,
                         KnownViews& known);

View view_from_text(const std::string& text);

}  // namespace vitrail
