// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/side_files.h"

#include <fmt/format.h>

#include <fstream>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

// The words of a file that begin with `stem` and "-" or ".", up to a quote, a blank or a bracket.
std::unordered_set<std::string> words_of(const std::filesystem::path& file, const std::string& stem) {
  std::unordered_set<std::string> words;
  std::ifstream in(file);
  for (std::string line; !stem.empty() && std::getline(in, line);)
    for (std::size_t at = line.find(stem); at != std::string::npos; at = line.find(stem, at + 1)) {
      const char next = at + stem.size() < line.size() ? line[at + stem.size()] : ' ';
      if (next == '-' || next == '.')
        words.insert(line.substr(at, line.find_first_of("\"' \t\r<>", at) - at));
    }
  return words;
}

}  // namespace

SideFiles::SideFiles(const std::filesystem::path& scene_file)
    : directory_(scene_file.parent_path()),
      stem_(scene_file.stem().string()),
      own_(words_of(scene_file, stem_)) {}

std::string SideFiles::name(const std::string& kind, std::size_t number, const std::string& extension) const {
  const std::string folder = stem_ + "-" + kind;
  std::error_code error;
  std::filesystem::create_directory(directory_ / folder, error);
  if (error)
    throw MachineError(fmt::format("cannot create {}: {}", (directory_ / folder).string(), error.message()));
  return free_name(fmt::format("{}/{:06}", folder, number), extension);
}

std::string SideFiles::name(const std::string& extension) const { return free_name(stem_, extension); }

std::string SideFiles::free_name(const std::string& name, const std::string& extension) const {
  std::string candidate = fmt::format("{}.{}", name, extension);
  const auto taken = [&] {
    std::error_code ignored;
    const std::filesystem::path file = directory_ / candidate;
    return std::filesystem::exists(std::filesystem::symlink_status(file, ignored)) &&
           (is_input(file) || !own_.contains(candidate));
  };
  for (int i = 2; taken(); ++i) candidate = fmt::format("{}-{}.{}", name, i, extension);
  return candidate;
}

}  // namespace vitrail
