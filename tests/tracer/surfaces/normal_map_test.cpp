// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <bit>

#include "bundle/texture_file.h"
#include "tests/support/temporary_directory.h"
#include "tracer/surfaces/surface_materials.h"

namespace vitrail::normal_map_test {

namespace {

Vector3d orthogonal(Vector3d n, Vector3d d) { return normalize(d - n * dot(n, d)); }

// Where the smooth normal leans, ∂p/∂u has a part along it, which is no part of what the map turns: measured
// in Mitsuba 3.9.1's `normalmap`, whose tangent is that of the smooth frame made perpendicular to the mapped
// normal.
TEST(NormalMap, TurnsTheTangentOfTheSmoothFrame) {
  const test::TemporaryDirectory folder;
  const std::array<float, 3> texel{0.7f, 0.35f, 0.9f};
  std::filesystem::create_directories(folder.path() / "textures");
  write_texture_file(folder.path() / "textures/000000.tex", {TexelFormat::vector_float, 1, 1, 1},
                     [&](std::uint32_t, std::uint32_t, std::uint32_t) {
                       TexelWords words{};
                       for (std::size_t i = 0; i < 3; ++i) words[i] = std::bit_cast<std::uint32_t>(texel[i]);
                       return words;
                     });
  ImageTexture map;
  map.filename = "textures/000000.tex";
  map.filter = TextureFilter::nearest;
  Manifest manifest;
  manifest.textures = {Texture{map, false, "", {}}};
  Material brushed{ConductorMaterial{.roughness = {0.05f, 0.3f}}};
  brushed.normal_map = Id<Texture>{0};
  manifest.materials = {brushed};
  const Textures textures(manifest.textures, folder.path(), 1 << 20);
  const Materials materials(manifest, textures);

  Interaction at;
  at.geometric = {0, 0, 1};
  at.shading = normalize(Vector3d{0.4, -0.3, 1});
  at.dpdu = {2, 0.5, 0}, at.dpdv = {0, 3, 0};
  at.out = normalize(Vector3d{0.1, 0.2, 1});
  at.front = true;
  ASSERT_TRUE(materials.scatters(manifest.materials[0], at));
  const Scattering scattering = materials.scattering_at(manifest.materials[0], at, {}, {}, 0);

  const Vector3d s = orthogonal(at.shading, at.dpdu), t = cross(at.shading, s);
  const Vector3d local = normalize(Vector3d{0.4, -0.3, 0.8});
  const Vector3d normal = s * local.x + t * local.y + at.shading * local.z;
  const ShadingFrame& frame = scattering.frame;
  EXPECT_NEAR(dot(frame.normal, normal), 1, 1e-6);
  EXPECT_NEAR(dot(frame.tangent, orthogonal(normal, s)), 1, 1e-6);
  EXPECT_LT(dot(frame.tangent, orthogonal(normal, at.dpdu)), 0.999);  // what it is not
}

}  // namespace

}  // namespace vitrail::normal_map_test
