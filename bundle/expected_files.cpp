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

// How many textures the manifest lists; none where it is no JSON.
std::uint32_t textures_listed(const fs::path& bundle) {
  std::ifstream in = open_regular(bundle / "manifest.json");
  const auto manifest = nlohmann::json::parse(in, nullptr, false);
  const bool lists =
      manifest.is_object() && manifest.contains("texture_files") && manifest["texture_files"].is_array();
  return lists ? static_cast<std::uint32_t>(manifest["texture_files"].size()) : 0;
}

// Without domains where their records are damaged.
Manifest domains_listed(const fs::path& bundle) try {
  return read_domains(bundle);
} catch (const std::exception&) {
  return {};
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
  const Manifest listed = domains_listed(bundle);
  at_least("domains", static_cast<std::uint32_t>(listed.domains.size()));
  at_least("objects", static_cast<std::uint32_t>(listed.objects.size()));
  at_least("textures", textures_listed(bundle));
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
  for (std::uint32_t i = 0; i < listed.domains.size(); ++i)
    if (listed.domains[i].pack) files.erase(domain_path(bundle, i));
  for (std::uint32_t i = 0; i < listed.objects.size(); ++i)
    if (listed.objects[i].quadric) files.erase(object_path(bundle, i));
  return files;
}

}  // namespace vitrail
