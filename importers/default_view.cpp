// SPDX-License-Identifier: Apache-2.0
#include "importers/default_view.h"

#include <cmath>
#include <numbers>

#include "scene/bounds.h"
#include "scene/deferred_mesh.h"
#include "scene/nesting.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail {

namespace {

void extend_by(Bounds3d& bounds, const Scene& scene, const Shape& shape, const Transform& to_world) {
  const Transform transform = to_world * shape.object_to_world;
  TriangleMesh storage;
  for (const Point3f& p : loaded(scene.meshes[shape.mesh.value], storage).positions)
    extend(bounds, transform_point(transform, cast<double>(p)));
}

Bounds3d world_bounds(const Scene& scene) {
  Bounds3d bounds;
  for (const Shape& shape : scene.shapes) extend_by(bounds, scene, shape, {});
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes[instance.prototype.value].shapes)
      extend_by(bounds, scene, shape, instance.prototype_to_world);
  return bounds;
}

}  // namespace

void add_default_view(ImportedScene& imported, const std::filesystem::path& file) {
  constexpr double half_angle_rad = 0.35;
  Scene& scene = imported.scene;
  const Bounds3d bounds = world_bounds(has_nested_instances(scene) ? without_nested_instances(scene) : scene);
  const Point3d target = bounds.empty() ? Point3d{} : center(bounds);
  const double radius = std::max(length(extent(bounds)) / 2, 1e-6);
  const Vector3d from = normalize(Vector3d{0.4, 0.35, 1});
  PerspectiveCamera camera;
  // look_at puts +x left of who looks along −z with +y up: turned, so that right-handed geometry is not
  // mirrored.
  camera.camera_to_world =
      look_at(target + from * (radius / std::sin(half_angle_rad)), target, {0, 1, 0}) * scale({-1, 1, 1});
  const double half = std::tan(half_angle_rad),
               aspect = static_cast<double>(scene.film.width) / scene.film.height;
  const double wide = std::max(aspect, 1.0), tall = std::max(1 / aspect, 1.0);
  camera.screen = {-half * wide, half * wide, -half * tall, half * tall};
  scene.camera = camera;
  const SourceLocation place{file.string()};
  imported.diagnostics.push_back(
      {Fidelity::approximated, "there is no camera: one that sees everything is added", place});
  if (!scene.lights.empty() || !scene.area_lights.empty()) return;
  // A white surface that faces the sun has radiance 1; the sky alone would show no shape.
  constexpr double sky = 0.4, sun = (1 - sky) * std::numbers::pi;
  scene.lights.push_back({InfiniteLight{emission_from_rgb({sky, sky, sky})}});
  scene.lights.push_back(
      {DistantLight{normalize(Vector3d{0.5, -1, -0.7}), emission_from_rgb({sun, sun, sun})}});
  imported.diagnostics.push_back(
      {Fidelity::approximated, "there is no light: a white sky and a sun are added", place});
}

}  // namespace vitrail
