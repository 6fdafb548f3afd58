// SPDX-License-Identifier: Apache-2.0
// Small Scenes in memory for the tests of writers.
#pragma once

#include "scene/records/scene.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

template <class T>
Id<T> add_to(std::vector<T>& records, T record) {
  records.push_back(std::move(record));
  return Id<T>{static_cast<std::uint32_t>(records.size() - 1)};
}

// The square (±1, ±1, 0) with uv from (0,0) to (1,1); faces +z.
inline TriangleMesh square_mesh(bool with_normals = false) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (with_normals) mesh.normals.assign(4, {0, 0, 1});
  return mesh;
}

// A camera at (0,0,5) that looks at the square from the front, with +x on the right of the picture.
inline Scene empty_scene() {
  Scene scene;
  scene.film.width = 8;
  scene.film.height = 4;
  scene.film.crop = {0, 8, 0, 4};
  scene.film.filter = BoxFilter{};
  PerspectiveCamera camera;
  camera.camera_to_world = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  camera.screen = {-0.5, 0.5, -0.25, 0.25};
  scene.camera = camera;
  return scene;
}

// The square with a material.
inline Scene square_scene(Material material, bool with_normals = false) {
  Scene scene = empty_scene();
  Shape shape;
  shape.mesh = add_to(scene.meshes, square_mesh(with_normals));
  shape.material = add_to(scene.materials, std::move(material));
  scene.shapes.push_back(shape);
  return scene;
}

inline SpectrumParameter rgb_reflectance(double r, double g, double b) {
  return Spectrum{reflectance_from_rgb({r, g, b})};
}

}  // namespace vitrail
