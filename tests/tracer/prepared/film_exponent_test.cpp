// SPDX-License-Identifier: Apache-2.0
// The quantum that a film counts in follows the scene's lights, of every kind.
#include "tracer/prepared/film_exponent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "film/film.h"
#include "images/image_files.h"
#include "partitioner/partition.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::film_exponent_test {
namespace {

TEST(FilmExponent, LeavesRoomOnBothSides) {
  EXPECT_EQ(film_exponent({1, 1}, 1), default_exponent);
  for (const double dim : {1e-30, 1e-8, 1.0, 1e7, 1e30})
    for (double factor = 1; factor < 1e61; factor *= 10) {
      const int exponent = film_exponent({dim, dim * factor}, 1);
      const double above = std::ldexp(1, exponent + deposit_bits(false)) / (dim * factor);
      EXPECT_GE(above, 0x1p15) << dim << " " << factor;
      EXPECT_LE(above, 0x1p40) << dim << " " << factor;
      if (factor <= 0x1p27) {
        EXPECT_LE(std::ldexp(1, exponent), dim * 0x1p-39) << dim << " " << factor;
      }
    }
  EXPECT_EQ(film_exponent({1, 1}, 0x1p4), default_exponent + 4);
  EXPECT_EQ(film_exponent({1e-300, 1e-300}, 1), least_exponent);
}

std::optional<LightRange> range_of(const Scene& scene) {
  const test::TemporaryDirectory directory;
  partition(scene, directory / "a.vit", {});
  const RenderScene prepared(read_manifest(directory / "a.vit"), directory / "a.vit", 1 << 20, 0);
  return light_range(prepared);
}

ConstantSpectrum bright(int power) { return {std::ldexp(1.0f, power)}; }

Scene quad_with(const std::optional<AreaLight>& light) {
  Scene scene;
  test::add_shape(scene, test::add_quads(scene, {{{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}}}),
                  Material{DiffuseMaterial{}}, light);
  test::set_camera(scene, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, 4, 4);
  return scene;
}

Scene with(LightModel light) {
  Scene scene = quad_with(std::nullopt);
  scene.lights.push_back(Light{std::move(light)});
  return scene;
}

Scene textured(TextureModel texture) {
  Scene scene = quad_with(AreaLight{Id<Texture>{0}});
  scene.meshes[0].uvs = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  scene.textures.push_back(Texture{std::move(texture)});
  return scene;
}

// A scene whose lights are 2ᵏ times brighter is counted in quanta 2ᵏ times greater.
TEST(LightRange, GrowsWithEveryKindOfLight) {
  const std::map<std::string, std::function<Scene(int)>> kinds{
      {"area", [](int k) { return quad_with(AreaLight{bright(k)}); }},
      {"textured area",
       [](int k) {
         return textured(CheckerboardTexture{Spectrum{bright(k)}, Spectrum{bright(k)}});
       }},
      {"textured sphere",
       [](int k) {
         Scene scene = textured(CheckerboardTexture{Spectrum{bright(k)}, Spectrum{bright(k)}});
         scene.meshes.emplace_back().quadric = Quadric{};
         scene.shapes[0].mesh = {1};
         return scene;
       }},
      {"point",
       [](int k) {
         return with(PointLight{{0, 0, 1}, bright(k)});
       }},
      {"point outside",
       [](int k) {
         return with(PointLight{{0, 0, 500}, bright(k)});
       }},
      {"spot",
       [](int k) {
         return with(SpotLight{{}, bright(k)});
       }},
      {"distant",
       [](int k) {
         return with(DistantLight{{0, 0, 1}, bright(k)});
       }},
      {"infinite", [](int k) { return with(InfiniteLight{bright(k)}); }},
      {"glowing medium", [](int k) {
         Scene scene = quad_with(std::nullopt);
         Medium medium;
         medium.emission = bright(k);
         scene.media.push_back(medium);
         scene.camera_medium = Id<Medium>{0};
         return scene;
       }}};
  for (const auto& [kind, scene] : kinds) {
    const std::optional<LightRange> one = range_of(scene(0));
    ASSERT_TRUE(one) << kind;
    EXPECT_LE(one->dimmest, one->brightest) << kind;
    EXPECT_GT(one->dimmest, 1e-9) << kind;
    EXPECT_LT(one->brightest, 1e13) << kind;
    for (const int power : {-90, 90}) {
      const std::optional<LightRange> other = range_of(scene(power));
      ASSERT_TRUE(other) << kind;
      EXPECT_NEAR(std::ldexp(other->dimmest, -power) / one->dimmest, 1, 1e-5) << kind;
      EXPECT_NEAR(std::ldexp(other->brightest, -power) / one->brightest, 1, 1e-5) << kind;
    }
  }
}

// An image of which one texel in 4096 shines.
TEST(LightRange, KnowsALoneTexel) {
  const test::TemporaryDirectory directory;
  for (const std::size_t texel : {0u, 1234u, 4095u}) {
    Image image{64, 64, 3, std::vector<float>(64 * 64 * 3, 0.0f)};
    for (std::size_t c = 0; c < 3; ++c) image.values[3 * texel + c] = 4096;
    write_exr_image(directory / "lamp.exr", image);
    ImageTexture texture;
    texture.filename = (directory / "lamp.exr").string();
    texture.wrap = Wrap::clamp;
    const std::optional<LightRange> range = range_of(textured(texture));
    ASSERT_TRUE(range) << texel;
    EXPECT_NEAR(range->dimmest, 1, 0.2) << texel;
    EXPECT_GT(range->brightest, 4095) << texel;
  }
}

TEST(LightRange, SpansTheDimmestAndTheBrightest) {
  Scene scene = with(InfiniteLight{ConstantSpectrum{1e-8f}});
  EXPECT_FALSE(range_of(quad_with(std::nullopt)));
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{0}}});
  scene.lights.push_back(Light{InfiniteLight{ConstantSpectrum{1e9f}}});
  const std::optional<LightRange> range = range_of(scene);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->dimmest / 1e-8, 1, 1e-5);
  EXPECT_NEAR(range->brightest / 1e9, 1, 1e-5);
}

}  // namespace
}  // namespace vitrail::film_exponent_test
