// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/foreign_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace vitrail {

namespace {

namespace fs = std::filesystem;

bool lies_in_folder_of(const fs::path& file, const fs::path& scene_file) {
  std::error_code unknown;
  const fs::path folder = fs::weakly_canonical(fs::absolute(scene_file).parent_path(), unknown);
  const fs::path there = fs::weakly_canonical(file, unknown);
  return std::ranges::mismatch(folder, there).in1 == folder.end();
}

// From the first of the opening marks to the last of the closing ones: what is quoted may hold some.
void cut_quoted(std::string& message, const std::string& open, const std::string& close) {
  const std::size_t from = message.find(open);
  const std::size_t to = message.rfind(close);
  if (from == std::string::npos || to == std::string::npos || to < from + open.size()) return;
  message.replace(from + open.size(), to - from - open.size(), "…");
}

}  // namespace

Error without_foreign_text(const Error& error, const fs::path& scene_file) {
  if (error.location.file.empty() || lies_in_folder_of(error.location.file, scene_file)) return error;
  std::string message = fmt::format(" {}", error.what());  // a quote follows a blank, an apostrophe does not
  cut_quoted(message, "\"", "\"");
  cut_quoted(message, " '", "'");
  cut_quoted(message, "<", ">");
  return {message.substr(1), error.location};
}

}  // namespace vitrail
