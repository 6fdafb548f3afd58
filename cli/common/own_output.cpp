// SPDX-License-Identifier: Apache-2.0
#include "cli/common/own_output.h"

#include <fstream>
#include <string>

#include "scene/system/diagnostics.h"

namespace vitrail {

void require_own(const std::filesystem::path& file, bool (*is_own)(const std::filesystem::path&),
                 bool force) {
  std::error_code unknown;
  if (force || file.empty() || !std::filesystem::is_regular_file(file, unknown) ||
      std::filesystem::is_empty(file, unknown) || is_own(file))
    return;
  throw Error(
      "this file exists, and does not say that vitrail made it; --force replaces it, and another name keeps "
      "it",
      {file.string()});
}

bool is_own_text(const std::filesystem::path& file) {
  std::string text(4096, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text.find("vitrail") != std::string::npos || text.starts_with("wavelength_nm,");
}

void require_own_texts(std::initializer_list<std::filesystem::path> files, bool force) {
  for (const std::filesystem::path& file : files) require_own(file, is_own_text, force);
}

}  // namespace vitrail
