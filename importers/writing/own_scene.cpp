// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/own_scene.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace vitrail {

namespace {

// Of a large scene all that matters lies in here: arrays of glTF are short beside their buffers.
constexpr std::size_t searched = 16 << 20;

}  // namespace

bool is_own_scene(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown) return false;
  std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(size, searched)), '\0');
  std::ifstream(file, std::ios::binary).read(text.data(), static_cast<std::streamsize>(text.size()));
  return text.find(scene_signature) != std::string::npos;
}

}  // namespace vitrail
