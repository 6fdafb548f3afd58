// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

using S = SceneParts;

Transform tilted() { return rotate(-0.35, {1, 0, 0}) * rotate(0.45, {0, 1, 0}); }

MeshAttribute colors_of(const TriangleMesh& mesh) {
  MeshAttribute colors{"vertex_color", false, 3, {}};
  for (const Point3f& p : mesh.positions)
    colors.values.insert(colors.values.end(), {0.5f + 0.4f * p.x, 0.5f + 0.3f * p.y, 0.3f});
  return colors;
}

bool reads_attributes(const Scene& scene) {
  for (const Texture& texture : scene.textures)
    if (std::holds_alternative<MeshAttributeTexture>(texture.model)) return true;
  return false;
}

// The square (±1, ±1, 0) that faces +z.
TriangleMesh square(bool uvs) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (uvs) mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return mesh;
}

TriangleMesh with_normals(TriangleMesh mesh, float bend) {
  for (const Point3f& p : mesh.positions) mesh.normals.push_back({bend * p.x, bend * p.y, 1});
  return mesh;
}

// By latitude and longitude, wound outwards.
TriangleMesh ball(bool uvs) {
  constexpr int rings = 12, sides = 20;
  TriangleMesh mesh;
  for (int r = 0; r <= rings; ++r)
    for (int i = 0; i <= sides; ++i) {
      const double theta = std::numbers::pi * r / rings, phi = 2 * std::numbers::pi * i / sides;
      const Vector3d n{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)};
      mesh.positions.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      mesh.normals.push_back({static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
      if (uvs) mesh.uvs.push_back({static_cast<float>(i) / sides, 1 - static_cast<float>(r) / rings});
    }
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = r * (sides + 1) + i, b = a + sides + 1;
      if (r > 0) mesh.triangles.push_back({a, b, a + 1});
      if (r + 1 < rings) mesh.triangles.push_back({a + 1, b, b + 1});
    }
  return mesh;
}

Shape shape_of(S& s, TriangleMesh mesh, Id<Material> material, const Transform& to_world) {
  if (reads_attributes(s.scene)) mesh.attributes.push_back(colors_of(mesh));
  Shape shape;
  shape.mesh = s.add(std::move(mesh));
  shape.material = material;
  shape.object_to_world = to_world;
  // A light that no shape has yet is the object's own.
  const bool taken = !s.scene.shapes.empty() && s.scene.shapes.back().area_light;
  if (!s.scene.area_lights.empty() && !taken) shape.area_light = Id<AreaLight>{0};
  return shape;
}

void add(S& s, TriangleMesh mesh, Id<Material> material, const Transform& to_world, bool flip = false) {
  Shape shape = shape_of(s, std::move(mesh), material, to_world);
  shape.flip_orientation = flip;
  s.scene.shapes.push_back(std::move(shape));
}

void add_instances(S& s, TriangleMesh mesh, Id<Material> material) {
  Prototype prototype;
  prototype.shapes = {shape_of(s, std::move(mesh), material, scale({0.6, 0.6, 0.6}))};
  s.scene.prototypes.push_back(std::move(prototype));
  const Id<Prototype> id{static_cast<std::uint32_t>(s.scene.prototypes.size() - 1)};
  s.scene.instances.push_back({id, translate({0.3, 0.6, 0}) * tilted(), {}});
  s.scene.instances.push_back({id, translate({-0.2, -0.5, 0.3}) * scale({-1, 1, 1}) * tilted(), {}});
}

constexpr std::array shapes{
    ShapeValue{"square", [](S& s, Id<Material> m) { add(s, square(true), m, tilted()); }},
    ShapeValue{"square without uv", [](S& s, Id<Material> m) { add(s, square(false), m, tilted()); }},
    ShapeValue{"square with normals",
               [](S& s, Id<Material> m) { add(s, with_normals(square(true), 0.4f), m, tilted()); }},
    ShapeValue{"back of a square",
               [](S& s, Id<Material> m) {
                 add(s, square(true), m, tilted() * rotate(std::numbers::pi, {0, 1, 0}));
               }},
    ShapeValue{"flipped square", [](S& s, Id<Material> m) { add(s, square(true), m, tilted(), true); }},
    ShapeValue{"mirrored square",
               [](S& s, Id<Material> m) {
                 add(s, square(true), m, tilted() * scale({-1, 0.9, 1}));
               }},
    ShapeValue{"flipped square with normals",
               [](S& s, Id<Material> m) { add(s, with_normals(square(true), 0.4f), m, tilted(), true); }},
    ShapeValue{"ball", [](S& s, Id<Material> m) { add(s, ball(true), m, tilted()); }},
    ShapeValue{"ball without uv",
               [](S& s, Id<Material> m) {
                 add(s, ball(false), m, scale({1, 0.8, 0.9}));
               }},
    ShapeValue{"mirrored ball",
               [](S& s, Id<Material> m) {
                 add(s, ball(true), m, scale({0.9, 1, -1}));
               }},
    ShapeValue{"instances", [](S& s, Id<Material> m) { add_instances(s, square(true), m); }},
    ShapeValue{"instances of a ball", [](S& s, Id<Material> m) { add_instances(s, ball(true), m); }},
};

}  // namespace

std::span<const ShapeValue> shape_values() { return shapes; }

}  // namespace vitrail::test
