// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/default_view.h"

#include <cmath>
#include <numbers>

#include "importers/reading/lamp_power.h"
#include "scene/geometry/bounds.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/quadric_places.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

void extend_by_corners(Bounds3d& bounds, const Transform& to_world, const Bounds3d& box) {
  for (int corner = 0; corner < 8 && !box.empty(); ++corner)
    extend(bounds, transform_point(to_world, {(corner & 1 ? box.upper : box.lower).x,
                                              (corner & 2 ? box.upper : box.lower).y,
                                              (corner & 4 ? box.upper : box.lower).z}));
}

// Of quadrics without making triangles of them.
void extend_by(Bounds3d& bounds, const Scene& scene, const std::vector<Shape>& shapes) {
  for (const Shape& shape : shapes) {
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    if (mesh.places) {
      extend_by_corners(bounds, shape.object_to_world, mesh.places->bounds());
    } else if (mesh.quadric) {
      extend(bounds, bounds_of(*mesh.quadric, shape.object_to_world));
    } else {
      TriangleMesh storage;
      for (const Point3f& p : loaded(mesh, storage).positions)
        extend(bounds, transform_point(shape.object_to_world, cast<double>(p)));
    }
  }
}

// Instances count by the boxes of their prototypes.
void extend_by(Bounds3d& bounds, const std::vector<Instance>& instances,
               const std::vector<Bounds3d>& prototypes) {
  for (const Instance& instance : instances)
    extend_by_corners(bounds, instance.prototype_to_world, prototypes.at(instance.prototype.value));
}

Bounds3d world_bounds(const Scene& scene) {
  std::vector<Bounds3d> prototypes;
  for (const Prototype& prototype : scene.prototypes) {
    Bounds3d box;
    extend_by(box, scene, prototype.shapes);
    extend_by(box, prototype.instances, prototypes);
    prototypes.push_back(box);
  }
  Bounds3d bounds;
  extend_by(bounds, scene, scene.shapes);
  extend_by(bounds, scene.instances, prototypes);
  return bounds;
}

}  // namespace

void add_default_view(ImportedScene& imported, const std::filesystem::path& file) {
  constexpr double half_angle_rad = 0.35;
  Scene& scene = imported.scene;
  const Bounds3d bounds = world_bounds(scene);
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
  add_default_light(imported, file);
}

void add_default_light(ImportedScene& imported, const std::filesystem::path& file) {
  // What lights less shows as black: 16 of 255 or less.
  constexpr double least = 0.005;
  Scene& scene = imported.scene;
  const bool has_lamps = !scene.lights.empty() || !scene.area_lights.empty();
  if (has_lamps && brightness_of_lamps(scene, world_bounds(scene)) >= least) return;
  // A white surface that faces the sun shows 1. The sky alone would show no shape, and before it no white
  // one: what turns to the camera gets more than the sky has.
  constexpr double sky = 0.1, lamp = 0.1, sun = 1 - sky - lamp;
  const double white = 1 / scene.film.imaging_ratio;
  const auto grey = [&](double value) {
    return emission_from_rgb({value * white, value * white, value * white});
  };
  const Transform to_world = std::visit([](const auto& c) { return c.camera_to_world; }, scene.camera);
  scene.lights.push_back({InfiniteLight{grey(sky)}});
  scene.lights.push_back({DistantLight{normalize(Vector3d{0.5, -1, -0.7}), grey(sun * std::numbers::pi)}});
  scene.lights.push_back(
      {DistantLight{normalize(transform_vector(to_world, {0, 0, 1})), grey(lamp * std::numbers::pi)}});
  imported.diagnostics.push_back(
      {Fidelity::approximated, has_lamps ? sky_is_added_to_lamps : sky_is_added, {file.string()}});
}

}  // namespace vitrail
