// SPDX-License-Identifier: Apache-2.0
// Gives a fuzzer's bytes to a reader as a file. A reader may throw Error and MachineError, and nothing else;
// what it gives has to keep its promises.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "scene/records/scene.h"

namespace vitrail::fuzz {

// In memory; a folder of its own for each process, with nothing else in it.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path made = "/dev/shm/vitrail-fuzz-" + std::to_string(::getpid());
    std::filesystem::create_directories(made);
    return made;
  }();
  return path;
}

inline std::filesystem::path write(const char* name, const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = folder() / name;
  std::FILE* out = std::fopen(file.c_str(), "wb");
  if (!out || std::fwrite(data, 1, size, out) != size || std::fclose(out) != 0) std::abort();
  return file;
}

inline std::filesystem::path write(const char* name, const std::string& text) {
  return write(name, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

inline void require(bool condition) {
  if (!condition) __builtin_trap();
}

inline void check(const Scene& scene) {
  for (const TriangleMesh& mesh : scene.meshes) {
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) require(index < mesh.positions.size());
    for (const Point3f& p : mesh.positions) require(is_finite(p));
    require(mesh.normals.empty() || mesh.normals.size() == mesh.positions.size());
    require(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
  }
  const auto check_shape = [&](const Shape& shape) {
    require(shape.mesh.value < scene.meshes.size() && shape.material.value < scene.materials.size());
    require(!shape.area_light || shape.area_light->value < scene.area_lights.size());
  };
  for (const Shape& shape : scene.shapes) check_shape(shape);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) check_shape(shape);
  for (std::size_t i = 0; i < scene.prototypes.size(); ++i)
    for (const Instance& instance : scene.prototypes[i].instances) require(instance.prototype.value < i);
  for (const Instance& instance : scene.instances)
    require(instance.prototype.value < scene.prototypes.size());
  const PixelRect& crop = scene.film.crop;
  require(0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= scene.film.width);
  require(0 <= crop.y0 && crop.y0 < crop.y1 && crop.y1 <= scene.film.height);
}

template <class Read>
int run(Read&& read) {
  try {
    read();
  } catch (const Error&) {
  } catch (const MachineError&) {
  }
  return 0;
}

}  // namespace vitrail::fuzz
