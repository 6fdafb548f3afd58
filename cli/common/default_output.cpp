// SPDX-License-Identifier: Apache-2.0
#include "cli/common/default_output.h"

#include <regex>
#include <string>

#include "scene/system/input_files.h"

namespace vitrail {

namespace {

// The beginning of a pbrt file, up to the world, without its comments.
std::string header_of(const std::filesystem::path& file) {
  constexpr std::size_t longest = 1 << 20;
  std::ifstream in = open_regular(file);
  std::string header;
  for (std::string line; header.size() < longest && std::getline(in, line);) {
    header += line.substr(0, line.find('#')) + "\n";
    if (line.find("WorldBegin") != std::string::npos) break;
  }
  return header;
}

// Of the Film directive; "" where it has none. A file that is included is not looked into.
std::string film_name(const std::filesystem::path& scene) {
  const std::string header = header_of(scene);
  const std::size_t film = header.find("Film");
  if (film == std::string::npos) return {};
  static const std::regex filename(R"re("string\s+filename"\s*\[?\s*"([^"]+)")re");
  std::smatch match;
  return std::regex_search(header.begin() + static_cast<std::ptrdiff_t>(film), header.end(), match, filename)
             ? match[1].str()
             : "";
}

}  // namespace

std::filesystem::path default_output(const std::filesystem::path& input) {
  std::filesystem::path output;
  if (input.extension() == ".pbrt") output = std::filesystem::path(film_name(input)).filename();
  if (output == "." || output == "..") output.clear();
  if (output.empty()) {
    std::filesystem::path name = input.has_filename() ? input.filename() : input.parent_path().filename();
    if (name.extension() == ".gz") name = name.stem();
    output = name.replace_extension(".exr");
  }
  if (output.extension() != ".png") output.replace_extension(".exr");
  return output;
}

}  // namespace vitrail
