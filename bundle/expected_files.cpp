// SPDX-License-Identifier: Apache-2.0
#include "bundle/expected_files.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "bundle/manifest.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

constexpr const char* folders[] = {"domains", "objects", "textures"};

// "domains/000012.dom": 13 files at least. 0 for other names.
std::uint32_t files_up_to(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  return stem.size() == 6 && error == std::errc{} && end == stem.data() + 6 ? number + 1 : 0;
}

// What the manifest lists; empty where it is no JSON.
nlohmann::json listed(const nlohmann::json& manifest, const std::string& folder) {
  const std::string key = folder == "textures" ? "texture_files" : folder;
  if (!manifest.is_object() || !manifest.contains(key) || !manifest[key].is_array())
    return nlohmann::json::array();
  return manifest[key];
}

// 0 where the file is damaged, which is found later.
std::uint32_t referred_to(const fs::path& file) try {
  std::uint32_t objects = 0;
  for (const InstanceRef& ref : read_instances({file})) objects = std::max(objects, ref.object + 1);
  return objects;
} catch (const std::exception&) {
  return 0;
}

}  // namespace

std::set<fs::path> expected_files(const fs::path& bundle, const std::set<fs::path>& present) {
  std::set<fs::path> files;
  std::map<std::string, std::uint32_t> counts;
  const auto at_least = [&](const std::string& folder, std::uint32_t count) {
    counts[folder] = std::max(counts[folder], count);
  };
  std::ifstream in = open_regular(bundle / "manifest.json");
  const auto manifest = nlohmann::json::parse(in, nullptr, false);
  for (const char* folder : folders)
    at_least(folder, static_cast<std::uint32_t>(listed(manifest, folder).size()));
  for (const fs::path& file : present) {
    if (file.extension() != ".dom" && file.extension() != ".tex") continue;
    files.insert(file);
    at_least(file.parent_path().filename().string(), files_up_to(file));
    if (file.extension() == ".dom") at_least("objects", referred_to(file));
  }
  for (const char* folder : folders)
    for (std::uint32_t i = 0; i < counts[folder]; ++i)
      files.insert(bundle / folder /
                   fmt::format("{:06}.{}", i, std::string(folder) == "textures" ? "tex" : "dom"));
  const auto domains = listed(manifest, "domains");
  for (std::uint32_t i = 0; i < domains.size(); ++i)
    if (domains[i].is_object() && domains[i].contains("pack")) files.erase(domain_path(bundle, i));
  const auto objects = listed(manifest, "objects");
  for (std::uint32_t i = 0; i < objects.size(); ++i)
    if (objects[i].is_object() && objects[i].contains("quadric")) files.erase(object_path(bundle, i));
  return files;
}

}  // namespace vitrail
