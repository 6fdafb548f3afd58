// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/scene_search.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

// In pieces: files of scenes may be large.
bool has_any_of(const fs::path& file, const std::vector<std::string>& words) {
  constexpr std::size_t piece = 1 << 16, longest = 16;
  std::ifstream in(file, std::ios::binary);
  std::string text;
  while (in) {
    text.erase(0, text.size() - std::min(text.size(), longest));  // a word may lie across two pieces
    const std::size_t kept = text.size();
    text.resize(kept + piece);
    in.read(text.data() + kept, piece);
    text.resize(kept + static_cast<std::size_t>(in.gcount()));
    if (std::ranges::any_of(words, [&](const auto& w) { return text.find(w) != std::string::npos; }))
      return true;
  }
  return false;
}

bool is_whole_scene(const fs::path& file) {
  if (file.extension() == ".pbrt") return has_any_of(file, {"WorldBegin"});
  if (file.extension() == ".glb" || file.extension() == ".gltf") return has_any_of(file, {"\"asset\""});
  return file.extension() == ".xml" && has_any_of(file, {"<sensor", "<camera"});
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path from_there = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return !from_there.empty() && *from_there.begin() != "..";
}

}  // namespace

std::vector<FoundScene> find_scenes(const std::vector<fs::path>& inputs, const fs::path& results) {
  std::vector<FoundScene> scenes;
  for (const fs::path& input : inputs) {
    if (!fs::exists(input)) throw UsageError("there is no " + input.string());
    if (!fs::is_directory(input)) {
      scenes.push_back({input, input.filename()});
      continue;
    }
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(input, fs::directory_options::skip_permission_denied))
      if (entry.is_regular_file() && !lies_in(entry.path(), results) && is_whole_scene(entry.path()))
        files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) scenes.push_back({file, file.lexically_relative(input)});
  }
  return scenes;
}

std::vector<fs::path> converted_names(const std::vector<FoundScene>& scenes, const std::string& format) {
  const auto plain = [&](const fs::path& name) { return fs::path(name).replace_extension(format); };
  std::map<fs::path, int> plain_names;
  for (const FoundScene& scene : scenes) ++plain_names[plain(scene.name)];
  std::vector<fs::path> names;
  std::map<fs::path, fs::path> owners;
  for (const FoundScene& scene : scenes) {
    fs::path name = plain(scene.name);
    if (plain_names[name] > 1) name = scene.name.string() + "." + format;
    const auto [owner, is_new] = owners.emplace(name, scene.input);
    if (!is_new)
      throw UsageError(owner->second.string() + " and " + scene.input.string() + " would both become " +
                       name.string() + ": convert them into different folders");
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace vitrail
