// SPDX-License-Identifier: Apache-2.0
#include "importers/pbrt/read/context.h"

#include <optional>

namespace vitrail::pbrt {

namespace {

namespace fs = std::filesystem;

std::optional<fs::path> found(const fs::path& directory, const std::string& name) {
  std::error_code ignored;
  if (fs::exists(directory / name, ignored)) return directory / name;
  if (fs::exists(name, ignored)) return fs::path(name);
  return std::nullopt;
}

// With / for every backslash, those too that the lexer took for the beginning of an escape.
std::string with_slashes(const std::string& name) {
  constexpr std::string_view escaped = "\b\f\n\r\t", letters = "bfnrt";
  std::string result;
  for (const char c : name) {
    const auto escape = escaped.find(c);
    if (c == '\\')
      result += '/';
    else if (escape != std::string_view::npos)
      (result += '/') += letters[escape];
    else
      result += c;
  }
  return result;
}

}  // namespace

fs::path Context::resolve(const std::string& name) const {
  if (const auto path = found(directory, name)) return *path;
  return found(directory, with_slashes(name)).value_or(directory / name);
}

}  // namespace vitrail::pbrt
