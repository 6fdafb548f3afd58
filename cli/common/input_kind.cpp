// SPDX-License-Identifier: Apache-2.0
#include "cli/common/input_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <system_error>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::string_view scenes[] = {".pbrt", ".xml", ".gltf", ".glb", ".pov", ".obj",
                                       ".ply",  ".stl", ".fbx",  ".dae", ".3ds"};
constexpr std::string_view films[] = {".film", ".partial", ".work"};
constexpr std::string_view pictures[] = {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".hdr"};

std::string lower(std::string word) {
  std::ranges::transform(word, word.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return word;
}

const char* name_of(InputKind kind) {
  switch (kind) {
    case InputKind::bundle:
      return "bundle";
    case InputKind::film:
      return "film";
    case InputKind::picture:
      return "picture";
    case InputKind::scene:
      return "scene";
    case InputKind::other:
      break;
  }
  return "file";
}

// What to do with a file of this kind.
const char* advice(InputKind kind, bool scene_is_wanted, bool bundle_is_wanted) {
  if (kind == InputKind::bundle)
    return scene_is_wanted ? "give the scene that it was made of, which vitrail inspect names"
                           : "vitrail render makes a film or picture of it";
  if (kind == InputKind::film) return "vitrail develop makes a picture of it, vitrail inspect its summary";
  if (kind == InputKind::picture) return "vitrail compare and vitrail develop take pictures";
  return bundle_is_wanted ? "vitrail partition makes a bundle of it"
                          : "vitrail render makes a film or picture of it";
}

}  // namespace

InputKind kind_of_input(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown))
    return std::filesystem::exists(file / "manifest.json", unknown) ? InputKind::bundle : InputKind::other;
  if (!std::filesystem::exists(file, unknown)) return InputKind::other;
  std::string suffix = lower(file.extension().string());
  if (suffix == ".gz") suffix = lower(file.stem().extension().string());
  const auto is_one_of = [&](const auto& suffixes) { return std::ranges::count(suffixes, suffix) > 0; };
  if (is_one_of(scenes)) return InputKind::scene;
  if (is_one_of(films)) return InputKind::film;
  return is_one_of(pictures) ? InputKind::picture : InputKind::other;
}

void require_input(const std::filesystem::path& file, std::initializer_list<InputKind> wanted) {
  const InputKind kind = kind_of_input(file);
  const auto is_wanted = [&](InputKind k) { return std::ranges::count(wanted, k) > 0; };
  if (kind == InputKind::other || is_wanted(kind)) return;
  std::string names;
  for (const InputKind k : wanted) names += (names.empty() ? "" : " or ") + std::string(name_of(k));
  throw Error(fmt::format("this is a {}, not a {}: {}", name_of(kind), names,
                          advice(kind, is_wanted(InputKind::scene), is_wanted(InputKind::bundle))),
              {file.string()});
}

}  // namespace vitrail
