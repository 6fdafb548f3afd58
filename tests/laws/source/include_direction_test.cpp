// SPDX-License-Identifier: Apache-2.0
// Data flows one way: which folder may include which.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace vitrail::include_direction_test {
namespace {

const std::map<std::string, std::set<std::string>>& allowed() {
  static const std::map<std::string, std::set<std::string>> folders{
      {"scene", {}},
      {"glazing", {"scene"}},
      {"images", {"scene"}},
      {"importers", {"scene", "glazing", "images"}},
      {"bundle", {"scene"}},
      {"partitioner", {"scene", "images", "bundle"}},
      {"film", {"scene", "images"}},
      {"denoise", {"scene", "film"}},
      {"tracer", {"scene", "bundle", "film"}},
      {"farm", {"scene", "bundle", "film", "tracer"}},
      {"compare", {"scene", "film"}},
      {"measure", {"scene", "film", "compare"}},
      {"cli",
       {"scene", "glazing", "images", "importers", "bundle", "partitioner", "film", "tracer", "farm",
        "denoise", "compare", "measure"}},
      {"python", {"scene", "bundle", "film"}}};
  return folders;
}

bool is_source(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h" || extension == ".cpp" || extension == ".inl";
}

TEST(IncludeDirection, FoldersDependOnlyOnThoseBelow) {
  const std::filesystem::path root = test::source_dir();
  const std::regex include(R"rx(^\s*#\s*include\s*"([a-z]+)/)rx");
  int seen = 0;
  for (const auto& [folder, may] : allowed())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        std::smatch found;
        if (!std::regex_search(line, found, include)) continue;
        ++seen;
        const std::string target = found[1];
        EXPECT_TRUE(target == folder || may.contains(target))
            << entry.path().string() << ':' << number << " includes " << target << '/';
      }
    }
  EXPECT_GT(seen, 100);
}

// The rooms of a folder, lower floors first: each includes only what stands before it, or itself.
const std::map<std::string, std::vector<std::string>>& floors() {
  static const std::map<std::string, std::vector<std::string>> rooms{
      {"scene", {"system", "geometry", "spectra", "shapes", "records", "daylight", "models"}},
      {"tracer",
       {"simd", "sampling", "rays", "quadrics", "bsdf", "textures", "intersect", "lights", "lanes", "media",
        "surfaces", "view", "prepared", "panes", "photons", "transport", "transport/waves"}},
      {"farm", {"scheduler", "transport", "rays", "files", "plan", "run", "conclude", "", "simulator"}},
      {"importers", {"bytes",        "shapes",    "solids",       "spectra",       "reading",
                     "writing",      "images",    "ply/read",     "ply/write",     "stl/read",
                     "obj/read",     "obj/write", "assimp",       "assimp/read",   "pbrt/read",
                     "pbrt/write",   "mitsuba",   "mitsuba/read", "mitsuba/write", "povray/read",
                     "povray/write", "gltf",      "gltf/read",    "gltf/write",    ""}}};
  return rooms;
}

TEST(IncludeDirection, RoomsDependOnlyOnFloorsBelow) {
  const std::filesystem::path root = test::source_dir();
  for (const auto& [folder, rooms] : floors()) {
    const std::regex include("^#include \"" + folder + R"rx(/(?:(.*)/)?[^/"]+")rx");
    const auto floor_of = [&rooms = rooms](const std::string& room) {
      return std::ranges::find(rooms, room);
    };
    int seen = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      const std::string room = std::filesystem::relative(entry.path().parent_path(), root / folder).string();
      const auto own = floor_of(room == "." ? "" : room);
      EXPECT_NE(own, rooms.end()) << entry.path().string() << " stands in a room without a floor";
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch found;
        if (!std::regex_search(line, found, include)) continue;
        ++seen;
        EXPECT_LE(floor_of(found[1]), own) << entry.path().string() << ": " << line;
      }
    }
    EXPECT_GT(seen, 50) << folder;
  }
}

TEST(IncludeDirection, OnlyTheFarmSpeaksMpi) {
  const std::filesystem::path root = test::source_dir();
  for (const auto& [folder, may] : allowed())
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path()) || folder == "farm") continue;
      std::ifstream in(entry.path());
      const std::string text(std::istreambuf_iterator<char>(in), {});
      EXPECT_EQ(text.find("<mpi.h>"), std::string::npos) << entry.path().string();
    }
}

TEST(Sources, CarryTheirLicence) {
  const std::filesystem::path root = test::source_dir();
  // In two parts: this line states nothing of this file.
  const std::string licence = std::string("SPDX-License") + "-Identifier: Apache-2.0";
  for (const char* folder :
       {"scene", "glazing", "images", "importers", "bundle", "partitioner", "film", "denoise", "tracer",
        "farm", "compare", "measure", "cli", "python", "tests", "scripts", "examples", "cmake"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      constexpr const char* kinds[] = {".h", ".cpp", ".inl", ".py", ".cmake"};
      if (std::ranges::find(kinds, extension) == std::end(kinds)) continue;
      std::ifstream in(entry.path());
      std::string first, second;
      std::getline(in, first);
      std::getline(in, second);
      EXPECT_NE((first + second).find(licence), std::string::npos) << entry.path().string();
    }
}

}  // namespace
}  // namespace vitrail::include_direction_test
