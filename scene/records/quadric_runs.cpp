// SPDX-License-Identifier: Apache-2.0
#include "scene/records/quadric_runs.h"

#include <cmath>

#include "scene/shapes/curve.h"

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

bool look_alike(const Shape& a, const Shape& b) {
  return a.material == b.material && a.opacity == b.opacity && a.interior == b.interior &&
         a.exterior == b.exterior && a.flip_orientation == b.flip_orientation;
}

}  // namespace

bool QuadricRuns::continues(const Scene& scene, const Shape& shape) const {
  return count_ > 0 && first_ < scene.shapes.size() && shape.mesh == quadric_ &&
         look_alike(shape, scene.shapes[first_]);
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

void QuadricRuns::add_curve(Scene& scene, std::vector<Shape>& shapes, Shape shape) {
  TriangleMesh& mesh = scene.meshes[shape.mesh.value];
  // What places a curve is in its record, where that can have it.
  const bool joins = !shape.area_light && shape.name.empty() && shape.object_to_world.m[3][3] == 1 &&
                     is_similarity(shape.object_to_world) && &mesh == &scene.meshes.back();
  const TriangleMesh* before =
      joins && curves_ && !shapes.empty() ? &scene.meshes[shapes.back().mesh.value] : nullptr;
  const bool continues = before && before->places == curves_ && before->quadric == mesh.quadric &&
                         look_alike(shape, shapes.back());
  if (joins) {
    if (!continues) curves_ = std::make_shared<QuadricPlaces>(*mesh.quadric, memory_bytes_);
    for (std::size_t i = 0; i < mesh.places->size(); ++i) {
      Transform place;
      mesh.places->read(i, {&place, 1});
      curves_->add(packed(transformed(shape.object_to_world, unpacked_curve(place))));
    }
    if (continues) return scene.meshes.pop_back();
    mesh.places = curves_;
    shape.object_to_world = {};
  }
  shapes.push_back(std::move(shape));
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
