// SPDX-License-Identifier: Apache-2.0
#include "scene/quadric_runs.h"

#include <cmath>

namespace vitrail {

namespace {

constexpr std::size_t least_run = 1024;

bool may_be_one_of_many(const Scene& scene, const Shape& shape) {
  const Transform& t = shape.object_to_world;
  if (!scene.meshes[shape.mesh.value].quadric || shape.area_light || !shape.name.empty()) return false;
  if (t.m[3] != std::array<double, 4>{0, 0, 0, 1} || !is_invertible(t) || swaps_handedness(t)) return false;
  // Nearly a similarity: rays can be taken to its space.
  const auto column = [&](std::size_t j) { return std::hypot(t.m[0][j], t.m[1][j], t.m[2][j]); };
  const double x = column(0), y = column(1), z = column(2);
  return determinant3(t) > 1e-6 * x * y * z && std::max({x, y, z}) < 1e5 * std::min({x, y, z});
}

}  // namespace

bool QuadricRuns::continues(const Scene& scene, const Shape& shape) const {
  if (count_ == 0 || first_ >= scene.shapes.size()) return false;
  const Shape& first = scene.shapes[first_];
  return shape.mesh == quadric_ && shape.material == first.material && shape.opacity == first.opacity &&
         shape.interior == first.interior && shape.exterior == first.exterior &&
         shape.flip_orientation == first.flip_orientation;
}

void QuadricRuns::add(Scene& scene, Shape shape) {
  const bool may = may_be_one_of_many(scene, shape);
  if (may && continues(scene, shape)) {
    if (places_) return places_->add(shape.object_to_world);
    ++count_;
  } else {
    first_ = scene.shapes.size();
    count_ = may ? 1 : 0;
    quadric_ = shape.mesh;
    places_ = nullptr;
  }
  scene.shapes.push_back(std::move(shape));
  if (count_ == least_run) gather(scene);
}

void QuadricRuns::gather(Scene& scene) {
  TriangleMesh mesh;
  mesh.quadric = scene.meshes[quadric_.value].quadric;
  places_ = std::make_shared<QuadricPlaces>(*mesh.quadric, memory_bytes_);
  for (std::size_t i = first_; i < scene.shapes.size(); ++i) places_->add(scene.shapes[i].object_to_world);
  mesh.places = places_;
  scene.shapes.resize(first_ + 1);
  Shape& all = scene.shapes.back();
  all.object_to_world = {};
  all.mesh = {static_cast<std::uint32_t>(scene.meshes.size())};
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace vitrail
