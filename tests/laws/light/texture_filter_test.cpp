// SPDX-License-Identifier: Apache-2.0
// Filtered textures cost no contrast that many samples would show.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "images/image_files.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::texture_filter_test {
namespace {

constexpr int size = 64, texels = 512;

// Pixels' standard deviation over their mean: a shining picture of black and white cells that fills the film,
// each one and a half pixels wide and twelve texels.
double contrast(TextureFilter filter, int samples, double tilt_rad) {
  const TemporaryDirectory folder;
  Image image{.width = texels, .height = texels, .channels = 3, .values = {}};
  for (int y = 0; y < texels; ++y)
    for (int x = 0; x < texels; ++x) {
      const float v = (x / 12 + y / 12) % 2 ? 1.0f : 0.0f;
      image.values.insert(image.values.end(), {v, v, v});
    }
  write_exr_image(folder / "cells.exr", image);
  Scene scene;
  ImageTexture texture;
  texture.filename = (folder / "cells.exr").string();
  texture.filter = filter;
  scene.textures.push_back({texture, false, "", {}});
  const auto mesh = add_quads(scene, {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}});
  scene.meshes[mesh.value].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  AreaLight light;
  light.radiance = Id<Texture>{0};
  add_shape(scene, mesh, Material{DiffuseMaterial{ConstantSpectrum{0}}}, light);
  set_camera(scene, Point3d{20 * std::sin(tilt_rad), 0, 20 * std::cos(tilt_rad)}, {0, 0, 0}, {0, 1, 0},
             2 * std::atan(0.04), size, size);
  scene.settings.max_depth = 0;
  const Film film = render(scene, samples).film;
  double sum = 0, squares = 0;
  constexpr double count = size * size;
  for (std::uint32_t i = 0; i < size * size; ++i) {
    sum += film.mean(i).y / count;
    squares += film.mean(i).y * film.mean(i).y / count;
  }
  return std::sqrt(squares - sum * sum) / sum;
}

TEST(TrilinearTextures, KeepTheContrastOfManySamples) {
  for (const double tilt : {0.0, 0.9}) {
    const double supersampled = contrast(TextureFilter::bilinear, 256, tilt);
    double before = 0;
    for (const int samples : {1, 4, 16, 64, 256}) {
      const double filtered = contrast(TextureFilter::trilinear, samples, tilt) / supersampled;
      fmt::print("tilted by {} rad, {} samples: {:.3f} of the contrast\n", tilt, samples, filtered);
      if (samples > 1) {
        EXPECT_GE(filtered, before - 0.05);
      }
      before = filtered;
    }
    EXPECT_GT(before, 0.97);
  }
}

}  // namespace
}  // namespace vitrail::test::texture_filter_test
