// SPDX-License-Identifier: Apache-2.0
// povray_mask SCENE.pov WIDTH HEIGHT SAMPLES OUT.pgm [INCLUDE_FOLDER]...: what objects cover in the picture
// of a POV-Ray scene, whatever their textures let through. Fog and media are no objects. For
// povray_pictures.py.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "film/alpha.h"
#include "film/develop.h"
#include "importers/povray/read/povray.h"
#include "scene/records/film_layers.h"
#include "tests/support/render.h"

namespace {

using namespace vitrail;

// A face between layers of fog: a disk of nothing that is larger than all objects are.
bool is_fog(const Scene& scene, const Shape& shape) {
  if (!std::holds_alternative<InterfaceMaterial>(scene.materials[shape.material.value].model)) return false;
  const auto named = [&](const std::optional<Id<Medium>>& medium) {
    return medium && scene.media[medium->value].name == "fog";
  };
  constexpr double large = 100;
  return (named(shape.interior) || named(shape.exterior)) &&
         length(transform_vector(shape.object_to_world, Vector3d{1, 0, 0})) > large;
}

void flatten(Scene& scene) {
  std::erase_if(scene.shapes, [&](const Shape& shape) { return is_fog(scene, shape); });
  scene.materials = {Material{DiffuseMaterial{ConstantSpectrum{0}}}};
  const auto flat = [](std::vector<Shape>& shapes) {
    for (Shape& shape : shapes) {
      shape.material = {0};
      shape.opacity = 1.0f;
      shape.area_light.reset(), shape.interior.reset(), shape.exterior.reset();
    }
  };
  flat(scene.shapes);
  for (Prototype& prototype : scene.prototypes) flat(prototype.shapes);
  scene.area_lights.clear(), scene.lights.clear(), scene.textures.clear(), scene.media.clear();
  scene.camera_medium.reset();
}

int mask(int count, char** words) {
  ImportOptions import;
  import.replace_missing = true;
  for (int i = 6; i < count; ++i) import.include_folders.push_back(words[i]);
  Scene scene = read_povray(words[1], MeshMemory{}, import).scene;
  flatten(scene);
  const int width = std::stoi(words[2]), height = std::stoi(words[3]);
  scene.film.width = width, scene.film.height = height, scene.film.crop = {0, width, 0, height};
  RenderOptions options;
  options.picture.samples_per_pixel = std::stoi(words[4]);
  options.picture.max_depth = 0;
  FilmLayers layers;
  layers.add(Layer::alpha);
  options.picture.more_layers = layers.bits;
  const Picture picture = develop(test::render(scene, std::move(options)).film);
  const PictureChannel* const alpha = alpha_of(picture);
  std::ofstream out(words[5], std::ios::binary);
  out << fmt::format("P5\n{} {}\n255\n", width, height);
  for (const float a : alpha->values) out.put(static_cast<char>(std::lround(255 * a)));
  return out ? 0 : 4;
}

}  // namespace

int main(int count, char** words) {
  if (count < 6)
    return std::fputs("povray_mask SCENE.pov WIDTH HEIGHT SAMPLES OUT.pgm [INCLUDE_FOLDER]...\n", stderr), 2;
  try {
    return mask(count, words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
