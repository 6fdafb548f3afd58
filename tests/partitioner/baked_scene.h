// SPDX-License-Identifier: Apache-2.0
// Textures, baked into a directory of their own and looked up there.
#pragma once

#include <gtest/gtest.h>

#include "images/image_files.h"
#include "partitioner/appearance/bake_textures.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/png.h"
#include "tests/support/temporary_directory.h"
#include "tracer/textures/textures.h"

namespace vitrail::test {

constexpr SampledWavelengths some_wavelengths{{430, 512.5f, 601, 700}, {1, 1, 1, 1}};

struct BakedScene {
  TemporaryDirectory directory;
  Scene scene;
  Diagnostics diagnostics;
  std::optional<TextureBaker> baker;
  std::vector<Texture> baked;

  Id<Texture> add(TextureModel model, bool is_float = false) {
    scene.textures.push_back({std::move(model), is_float, "", {}});
    return {static_cast<std::uint32_t>(scene.textures.size() - 1)};
  }
  ImageTexture image(const std::string& name) const {
    ImageTexture t;
    t.filename = (directory / name).string();
    t.filter = TextureFilter::nearest;
    return t;
  }
  TextureBaker& bake() { return baker.emplace(scene, directory / "b.vit", diagnostics); }
  Textures look_up(std::uint64_t budget = 1 << 20) {
    baker->files();
    baked = baker->take_textures();
    return Textures(baked, directory / "b.vit", budget, scene.settings.rgb);
  }
};

inline TexturePoint at_uv(double u, double v) {
  TexturePoint p;
  p.uv = {u, v};
  return p;
}

inline void expect_near(const SampledSpectrum& value, const Spectrum& expected, double tolerance) {
  for (std::size_t i = 0; i < hero_count; ++i)
    EXPECT_NEAR(static_cast<double>(value.v[i]),
                evaluate(expected, static_cast<double>(some_wavelengths.lambda_nm[i])), tolerance);
}

}  // namespace vitrail::test
