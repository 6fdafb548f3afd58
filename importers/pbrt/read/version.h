// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "importers/pbrt/read/lexer.h"

namespace vitrail::pbrt {

enum class Version { v3, v4 };

// It is the version whose meaning a file has where the two differ.
struct DetectedVersion {
  Version version = Version::v4;
  bool certain = false;
};

// Tells the version by the first word in the main file that only one of them knows (Film "image", WorldEnd,
// matte, color … against Film "rgb", ColorSpace, diffuse …). Where there is none it is v4, and not certain.
DetectedVersion detect_version(const std::filesystem::path& file);

}  // namespace vitrail::pbrt
