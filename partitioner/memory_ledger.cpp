// SPDX-License-Identifier: Apache-2.0
#include "partitioner/memory_ledger.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "partitioner/placing/objects.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/quadric_places.h"

namespace vitrail {

namespace {

// A block of malloc's for each array of a small mesh.
constexpr std::uint64_t block = 48;

// A record and its copy in the bundle's manifest.
template <class T>
std::uint64_t twice(const std::vector<T>& records) {
  return 2 * records.size() * sizeof(T);
}

template <class T>
std::uint64_t with_names(const std::vector<T>& records) {
  std::uint64_t bytes = twice(records);
  for (const T& record : records)
    if (record.name.size() > 15) bytes += 2 * record.name.size();
  return bytes;
}

std::uint64_t bytes_of(const Grid& grid) { return 2 * grid.values.size() * sizeof(float); }

std::uint64_t values_of(const Medium& medium) {
  std::uint64_t bytes = 0;
  const auto add = [&](const VolumeParameter& volume) {
    if (const auto* grid = std::get_if<Grid>(&volume)) bytes += bytes_of(*grid);
  };
  if (const auto* c = std::get_if<AbsorptionScattering>(&medium.coefficients))
    add(c->sigma_a), add(c->sigma_s);
  if (const auto* c = std::get_if<ExtinctionAlbedo>(&medium.coefficients)) add(c->sigma_t), add(c->albedo);
  if (const auto* grid = std::get_if<Grid>(&medium.density)) bytes += bytes_of(*grid);
  for (const auto* grid : {&medium.emission_scale, &medium.temperature})
    if (*grid) bytes += bytes_of(**grid);
  return bytes;
}

}  // namespace

MemoryLedger ledger_of(const Scene& scene) {
  MemoryLedger ledger;
  for (const TriangleMesh& mesh : scene.meshes) {
    ledger.meshes += bytes_of(mesh) + 2 * block;
    if (mesh.places) ledger.meshes += mesh.places->bytes();
    if (mesh.deferred)
      ledger.meshes += sizeof(DeferredMesh) + mesh.deferred->sample.size() * sizeof(DeferredMesh::Sample);
  }
  // With its mesh's record, and its use: measured.
  constexpr std::uint64_t shape = 1024, instance = 480;
  std::uint64_t shapes = scene.shapes.size(), instances = scene.instances.size();
  for (const Prototype& prototype : scene.prototypes) {
    shapes += prototype.shapes.size();
    instances += prototype.instances.size();
  }
  ledger.shapes = shapes * shape;
  ledger.instances = instances * instance;
  for (const Motion& motion : scene.motions)  // here and, of its object, in the manifest
    ledger.instances += sizeof(Assembly) + sizeof(ObjectInfo) + 4 * block + 2 * motion.bytes();
  ledger.prototypes =
      scene.prototypes.size() * (sizeof(Prototype) + sizeof(Assembly) + sizeof(ObjectInfo) + 4 * block);
  ledger.materials = with_names(scene.materials);
  ledger.textures = with_names(scene.textures);
  ledger.lights = twice(scene.lights) + twice(scene.area_lights);
  ledger.media = twice(scene.media);
  for (const Medium& medium : scene.media) ledger.media += values_of(medium);
  return ledger;
}

std::string to_string(const MemoryLedger& l) {
  std::array<std::pair<std::uint64_t, const char*>, 8> kinds{{{l.meshes, "meshes"},
                                                              {l.shapes, "shapes"},
                                                              {l.instances, "instances"},
                                                              {l.prototypes, "prototypes"},
                                                              {l.materials, "materials"},
                                                              {l.textures, "textures"},
                                                              {l.lights, "lights"},
                                                              {l.media, "media"}}};
  std::ranges::sort(kinds, std::greater<>());
  std::string text;
  for (const auto& [bytes, kind] : kinds)
    if (bytes >= 1 << 20) text += fmt::format("{}{} {} MiB", text.empty() ? "" : ", ", kind, bytes >> 20);
  return text;
}

}  // namespace vitrail
