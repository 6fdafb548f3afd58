// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/render_scenes.h"

#include <cmath>

#include "images/image_files.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/render.h"

namespace vitrail::test {

namespace {

Material grey(float reflectance) { return {DiffuseMaterial{ConstantSpectrum{reflectance}}}; }

// A sphere whose radius ripples, seen as rough by bounced rays.
void add_bumpy_sphere(Scene& scene, Point3f centre, float radius, std::uint32_t rings,
                      const Material& material) {
  TriangleMesh mesh;
  const std::uint32_t sectors = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const double theta = 3.14159265358979 * i / rings, phi = 6.28318530717959 * j / sectors;
      const double r = radius * (1 + 0.04 * std::sin(23 * theta) * std::sin(31 * phi));
      mesh.positions.push_back({centre.x + static_cast<float>(r * std::sin(theta) * std::cos(phi)),
                                centre.y + static_cast<float>(r * std::sin(theta) * std::sin(phi)),
                                centre.z + static_cast<float>(r * std::cos(theta))});
    }
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sectors; ++j) {
      const std::uint32_t a = i * sectors + j, b = i * sectors + (j + 1) % sectors;
      if (i > 0) mesh.triangles.push_back({a, a + sectors, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, a + sectors, b + sectors});
    }
  scene.meshes.push_back(std::move(mesh));
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, material);
}

void add_ball(Scene& scene, Vector3d centre, double radius, const Material& material,
              const std::optional<AreaLight>& light = std::nullopt) {
  scene.meshes.emplace_back().quadric = Quadric{.kind = QuadricKind::sphere};
  add_shape(scene, {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, material, light);
  scene.shapes.back().object_to_world = translate(centre) * scale({radius, radius, radius});
}

void add_block(Scene& scene, Point3f lower, Point3f upper, const Material& material) {
  add_shape(scene, add_quads(scene, box_faces(lower, upper)), material);
}

void add_ground(Scene& scene, float half, float y) {
  add_shape(scene,
            add_quads(scene, {{{{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}}}}),
            grey(0.5f));
}

Material glass() { return {DielectricMaterial{ConstantSpectrum{1.5f}}}; }

Material gold(float alpha) {
  ConductorMaterial m{ComplexIndex{*named_spectrum("metal-Au-eta"), *named_spectrum("metal-Au-k")}};
  m.roughness.alpha_u = m.roughness.alpha_v = alpha;
  return {m};
}

Material rough_plastic() {
  PlasticMaterial m;
  m.diffuse_reflectance = Spectrum{reflectance_from_rgb({0.4, 0.2, 0.1})};
  m.roughness.alpha_u = m.roughness.alpha_v = 0.15f;
  return {m};
}

constexpr int side = 128;  // of pictures, in pixels

// The room's walls are diffuse.
Scene blocks() {
  Scene scene = lit_box(side);
  add_block(scene, {-0.7f, -1, -0.6f}, {-0.1f, 0.3f, 0}, grey(0.7f));
  add_block(scene, {0.1f, -1, 0}, {0.7f, -0.4f, 0.6f},
            {DiffuseMaterial{reflectance_from_rgb({0.6, 0.1, 0.1})}});
  return scene;
}

Scene balls_in_a_box() {
  Scene scene = lit_box(side);
  add_ball(scene, {0.45, -0.65, 0.3}, 0.35, glass());
  add_ball(scene, {-0.4, -0.65, -0.3}, 0.35, gold(0));
  return scene;
}

// As killeroo-simple: fine meshes of a glossy material, lamps that are spheres.
Scene glossy_meshes() {
  Scene scene;
  add_ground(scene, 8, -1.1f);
  add_bumpy_sphere(scene, {-1.2f, 0, 0}, 1, 64, rough_plastic());
  add_bumpy_sphere(scene, {1.2f, 0, 0}, 1, 64, gold(0.1f));
  add_ball(scene, {-3, 4, 3}, 0.5, grey(0), AreaLight{ConstantSpectrum{20}});
  add_ball(scene, {4, 5, 2}, 0.2, grey(0), AreaLight{ConstantSpectrum{90}});
  set_camera(scene, {0, 1, 6}, {0, 0, 0}, {0, 1, 0}, 0.7, side, side);
  return scene;
}

Scene under_a_sky() {
  Scene scene;
  add_ground(scene, 20, -1.1f);
  add_bumpy_sphere(scene, {-1.2f, 0, 0}, 1, 64, grey(0.7f));
  add_bumpy_sphere(scene, {1.2f, 0, 0}, 1, 64, rough_plastic());
  SkyLight sky;
  sky.light_to_world = rotate(-pi / 2, {1, 0, 0});
  sky.to_sun = unit(Vector3d{0.3, 0.2, 0.8});
  scene.lights.push_back(Light{sky});
  set_camera(scene, {0, 1, 6}, {0, 0, 0}, {0, 1, 0}, 0.7, side, side);
  return scene;
}

// Bands of colour and one bright spot.
Scene under_an_image(const std::filesystem::path& file) {
  Image image = black_image(256, 128, 3);
  for (std::size_t y = 0; y < 128; ++y)
    for (std::size_t x = 0; x < 256; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        image.values[(y * 256 + x) * 3 + c] =
            x / 8 == 20 && y / 8 == 4 ? 40
                                      : 0.2f + 0.1f * static_cast<float>((x / 16 + (c + 1) * (y / 16)) % 5);
  write_exr_image(file, image);
  Scene scene;
  add_ground(scene, 20, -1.1f);
  add_ball(scene, {-2.2, 0, 0}, 1, rough_plastic());
  add_ball(scene, {0, 0, 0}, 1, gold(0.1f));
  add_ball(scene, {2.2, 0, 0}, 1, glass());
  EnvironmentLight light;
  light.filename = file.string();
  light.light_to_world = rotate(-pi / 2, {1, 0, 0});
  light.projection = EnvironmentLight::Projection::latitude_longitude;
  scene.lights.push_back(Light{light});
  set_camera(scene, {0, 1, 8}, {0, 0, 0}, {0, 1, 0}, 0.7, side, side);
  return scene;
}

}  // namespace

Scene million_room() {
  Scene scene;
  for (int i = 0; i < 8; ++i)
    add_bumpy_sphere(scene, {i & 1 ? 1.2f : -1.2f, i & 2 ? 1.2f : -1.2f, i & 4 ? 1.2f : -1.2f}, 1.05f, 182,
                     grey(0.7f));
  auto walls = box_faces({-3, -3, -3}, {3, 3, 3});
  for (auto& face : walls) std::swap(face[1], face[3]);
  add_shape(scene, add_quads(scene, walls), grey(0.6f));
  add_shape(scene, add_quads(scene, {{{{-1, 2.95f, -1}, {1, 2.95f, -1}, {1, 2.95f, 1}, {-1, 2.95f, 1}}}}),
            grey(0), AreaLight{ConstantSpectrum{10}, true});
  set_camera(scene, {0, 0, -2.9}, {0, 0, 0}, {0, 1, 0}, 1.4, 256, 256);
  return scene;
}

std::vector<NamedScene> render_scenes(const std::filesystem::path& folder) {
  return {{"box", blocks()},
          {"spheres", balls_in_a_box()},
          {"glossy meshes", glossy_meshes()},
          {"sky", under_a_sky()},
          {"image around", under_an_image(folder / "around.exr")}};
}

}  // namespace vitrail::test
