// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/missing_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "images/file_part.h"
#include "importers/bytes/text_cursor.h"
#include "scene/records/texture_inputs.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

constexpr std::size_t longest_name = 400;  // of a file, in messages

bool is_missing(const std::string& file) {
  std::error_code ignored;
  return !std::filesystem::is_regular_file(whole_file(file), ignored);
}

// The image or the Ptex file of a texture, if it has one.
const std::string* file_of(const Texture& texture) {
  if (const auto* image = std::get_if<ImageTexture>(&texture.model)) return &image->filename;
  if (const auto* ptex = std::get_if<PtexTexture>(&texture.model)) return &ptex->filename;
  return nullptr;
}

// The first file where the origin has no line.
SourceLocation place_of(const Scene& scene, const Origin& origin) {
  const SourceLocation place = location(scene, origin);
  return place.file.empty() && !scene.files.empty() ? SourceLocation{scene.files.front()} : place;
}

// The first of its grids whose file is missing.
const Grid* lost_grid_of(const Medium& medium) {
  const auto lost = [](const auto& value) -> const Grid* {
    const auto* grid = std::get_if<Grid>(&value);
    return grid && !grid->filename.empty() && is_missing(grid->filename) ? grid : nullptr;
  };
  if (const Grid* density = lost(medium.density)) return density;
  if (const auto* m = std::get_if<AbsorptionScattering>(&medium.coefficients))
    return lost(m->sigma_a) ? lost(m->sigma_a) : lost(m->sigma_s);
  if (const auto* m = std::get_if<ExtinctionAlbedo>(&medium.coefficients))
    return lost(m->sigma_t) ? lost(m->sigma_t) : lost(m->albedo);
  return nullptr;
}

class Replacer {
 public:
  explicit Replacer(ImportedScene& imported) : scene_(imported.scene), diagnostics_(imported.diagnostics) {}

  void textures() {
    for (std::size_t i = 0; i < scene_.textures.size(); ++i) {
      Texture& texture = scene_.textures[i];
      const std::string* file = file_of(texture);
      if (!file || !is_missing(*file)) continue;
      say(*file, "grey 0.5 stands for it", texture.origin, RecordKind::texture);
      texture.model = ProductTexture{ConstantSpectrum{0.5f}, ConstantSpectrum{1}};
      missing_.insert(static_cast<std::uint32_t>(i));
    }
  }

  // 0.5 would be a normal without a length.
  void normal_maps() {
    const auto is_missing_map = [&](Id<Texture> map) {
      bool missing = missing_.contains(map.value);
      for_texture_inputs(scene_.textures[map.value].model,
                         [&](Id<Texture> input) { missing = missing || missing_.contains(input.value); });
      return missing;
    };
    for (Material& material : scene_.materials)
      if (material.normal_map && is_missing_map(*material.normal_map)) material.normal_map.reset();
  }

  void tables() {
    for (Material& material : scene_.materials)
      if (const auto* table = std::get_if<TabulatedMaterial>(&material.model);
          table && is_missing(table->filename)) {
        say(table->filename, "a diffuse reflectance of 0.5 stands for it", material.origin,
            RecordKind::material);
        material.model = DiffuseMaterial{};
      }
  }

  void media() {
    for (const Medium& medium : scene_.media)
      if (const Grid* grid = lost_grid_of(medium))
        say(grid->filename, "light passes the medium unchanged", medium.origin, RecordKind::medium);
  }

  void lights() {
    for (Light& light : scene_.lights) {
      if (auto* sky = std::get_if<EnvironmentLight>(&light.model); sky && is_missing(sky->filename)) {
        say(sky->filename, "grey 0.5 from all around stands for it", light.origin, RecordKind::light);
        light.model = InfiniteLight{product(emission_from_rgb({0.5, 0.5, 0.5}), sky->scale)};
      } else if (auto* lamp = std::get_if<GoniometricLight>(&light.model);
                 lamp && is_missing(lamp->filename)) {
        say(lamp->filename, "a light of half its intensity in all directions stands for it", light.origin,
            RecordKind::light);
        light.model =
            PointLight{transform_point(lamp->light_to_world, {0, 0, 0}), scaled(lamp->intensity, 0.5)};
      }
    }
  }

 private:
  void say(const std::string& file, const char* what, const Origin& origin, RecordKind kind) {
    const SourceLocation place = place_of(scene_, origin);
    diagnostics_.push_back(
        {Fidelity::dropped,
         fmt::format("cannot find the file \"{}\": {}", printable(file, longest_name), what), place, place,
         kind});
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::set<std::uint32_t> missing_;
};

}  // namespace

void require_images(const Scene& scene) {
  constexpr std::size_t most_named = 8;
  std::vector<std::pair<std::string, Origin>> missing;  // each once
  std::set<std::string> asked;
  const auto ask = [&](const std::string& file, const Origin& origin) {
    if (asked.insert(file).second && is_missing(file)) missing.emplace_back(file, origin);
  };
  const auto look_at = [&](const auto* model, const Origin& origin) {
    if (model) ask(model->filename, origin);
  };
  for (const Texture& texture : scene.textures)
    if (const std::string* file = file_of(texture)) ask(*file, texture.origin);
  for (const Material& material : scene.materials)
    look_at(std::get_if<TabulatedMaterial>(&material.model), material.origin);
  for (const Light& light : scene.lights) {
    look_at(std::get_if<EnvironmentLight>(&light.model), light.origin);
    look_at(std::get_if<GoniometricLight>(&light.model), light.origin);
  }
  for (const Medium& medium : scene.media) look_at(lost_grid_of(medium), medium.origin);
  if (missing.empty()) return;
  const auto& [file, origin] = missing.front();
  std::error_code ignored;
  std::string message = std::filesystem::exists(file, ignored)
                            ? fmt::format("\"{}\" is not a file", printable(file, longest_name))
                            : fmt::format("cannot find the file \"{}\"", printable(file, longest_name));
  for (std::size_t i = 1; i < std::min(missing.size(), most_named); ++i)
    message += fmt::format(", nor \"{}\" of {}", printable(missing[i].first, longest_name),
                           to_string(place_of(scene, missing[i].second)));
  if (missing.size() > most_named) message += fmt::format(", nor {} others", missing.size() - most_named);
  throw Error(message + how_to_replace_missing, place_of(scene, origin));
}

void replace_missing_images(ImportedScene& imported) {
  Replacer replacer(imported);
  replacer.textures();
  replacer.normal_maps();
  replacer.tables();
  replacer.lights();
  replacer.media();
}

}  // namespace vitrail
