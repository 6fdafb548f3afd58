// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/deferred_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "scene/shapes/quadric_places.h"
#include "scene/shapes/tessellate.h"
#include "scene/system/diagnostics.h"
#include "scene/system/temporary_file.h"

namespace vitrail {

namespace {

constexpr std::uint64_t most_samples = 1u << 18;  // of all deferred meshes

bool is_sampled(std::uint64_t mesh, std::uint64_t triangle, int shift) {
  return (mixed(mesh, triangle) & ((std::uint64_t{1} << shift) - 1)) == 0;
}

void take_samples(const TriangleMesh& mesh, std::uint64_t number, int shift, DeferredMesh& deferred) {
  deferred.sample_shift = shift;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!is_sampled(number, i, shift)) continue;
    auto& sample = deferred.sample.emplace_back();
    sample.triangle = static_cast<std::uint32_t>(i);
    for (std::size_t k = 0; k < 3; ++k) sample.vertices[k] = mesh.positions[mesh.triangles[i][k]];
  }
  deferred.sample.shrink_to_fit();
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double greatest(Vector3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

template <class T>
std::uint64_t size_bytes(const std::vector<T>& v) {
  return v.size() * sizeof(T);
}

template <class F>
void each_array(auto& mesh, const F& f) {
  f(mesh.positions), f(mesh.triangles), f(mesh.normals), f(mesh.uvs);
  for (auto& attribute : mesh.attributes) f(attribute.values);
}

// Reads the mesh back from one file that all such meshes go to, one after the other.
MeshLoader spilled(const TriangleMesh& mesh) {
  static constexpr const char* kept = "meshes";
  static const std::shared_ptr<std::FILE> file(open_temporary(kept), [](std::FILE* f) { std::fclose(f); });
  static std::atomic<std::uint64_t> end{0};
  const std::uint64_t first = end.fetch_add(bytes_of(mesh));
  std::uint64_t at = first;
  std::vector<std::size_t> counts;
  each_array(mesh, [&](const auto& values) {
    write_at(file.get(), at, std::as_bytes(std::span(values)), kept);
    at += size_bytes(values);
    counts.push_back(values.size());
  });
  TriangleMesh frame;
  frame.missing_uv = mesh.missing_uv;
  for (const MeshAttribute& a : mesh.attributes)
    frame.attributes.push_back({a.name, a.per_face, a.channels, {}});
  return [frame, counts, first, in = file] {
    TriangleMesh read = frame;
    std::uint64_t from = first;
    auto count = counts.begin();
    each_array(read, [&](auto& values) {
      values.resize(*count++);
      read_at(in.get(), from, std::as_writable_bytes(std::span(values)), kept);
      from += size_bytes(values);
    });
    return read;
  };
}

}  // namespace

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {  // the finaliser of SplitMix64 (Steele et al. 2014)
  std::uint64_t x = a * 0x9e3779b97f4a7c15u + b;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::uint64_t bytes_of(const TriangleMesh& mesh) {
  std::uint64_t bytes = size_bytes(mesh.positions) + size_bytes(mesh.triangles) + size_bytes(mesh.normals) +
                        size_bytes(mesh.uvs);
  for (const MeshAttribute& attribute : mesh.attributes) bytes += size_bytes(attribute.values);
  return bytes;
}

std::uint64_t triangles_of(const TriangleMesh& mesh) {
  if (mesh.quadric) return mesh.places ? mesh.places->size() : 1;
  return mesh.deferred ? mesh.deferred->triangles : mesh.triangles.size();
}

bool has_normals(const TriangleMesh& mesh) {
  return mesh.deferred ? mesh.deferred->has_normals : !mesh.normals.empty();
}

Bounds3f bounds_of(const TriangleMesh& mesh) {
  if (mesh.deferred) return mesh.deferred->bounds;
  if (mesh.quadric) {
    const Bounds3d box = mesh.places ? mesh.places->bounds() : bounds_of(*mesh.quadric, {});
    return {cast<float>(box.lower), cast<float>(box.upper)};
  }
  Bounds3f bounds;
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) extend(bounds, mesh.positions[corner]);
  return bounds;
}

MeshFocus focus_of(const TriangleMesh& mesh) {
  constexpr std::size_t most = 1024;
  if (mesh.deferred) return mesh.deferred->focus;
  if (mesh.quadric) {
    if (mesh.places) return {mesh.places->centre(), mesh.places->radius(), mesh.places->bounds()};
    const Bounds3d box = bounds_of(*mesh.quadric, {});
    return {center(box), greatest(extent(box)) / 2, box};
  }
  const std::size_t count = mesh.triangles.size(), chosen = std::min(count, most);
  if (count == 0) return {};
  std::vector<Bounds3d> boxes;
  for (std::size_t i = 0; i < chosen; ++i) {
    Bounds3d& box = boxes.emplace_back();
    for (const std::uint32_t corner : mesh.triangles[i * count / chosen])
      extend(box, cast<double>(mesh.positions[corner]));
  }
  MeshFocus focus;
  std::vector<double> values(chosen);
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(boxes, values.begin(), [&](const Bounds3d& b) { return center(b)[axis]; });
    focus.centre[axis] = median(values);
  }
  std::ranges::transform(boxes, values.begin(), [&](const Bounds3d& b) {
    return std::max(greatest(b.lower - focus.centre), greatest(b.upper - focus.centre));
  });
  std::vector<double> distances = values;
  focus.radius = median(distances);
  for (std::size_t i = 0; i < chosen; ++i)
    if (values[i] <= near_radii * focus.radius) extend(focus.box, boxes[i]);
  return focus;
}

const TriangleMesh& loaded(const TriangleMesh& mesh, TriangleMesh& storage) {
  if (mesh.places) return storage = tessellate(*mesh.quadric, *mesh.places);
  if (mesh.quadric) return storage = tessellate(*mesh.quadric);
  if (!mesh.deferred) return mesh;
  storage = mesh.deferred->load();
  if (storage.triangles.size() != mesh.deferred->triangles || bounds_of(storage) != mesh.deferred->bounds)
    throw Error("a file of a mesh has changed while the scene was read; start again");
  return storage;
}

TriangleMesh MeshMemory::keep(TriangleMesh mesh, MeshLoader load) {
  const std::uint64_t bytes = bytes_of(mesh);
  if (bytes <= left_) {
    left_ -= bytes;
    return mesh;
  }
  const auto deferred = std::make_shared<DeferredMesh>();
  deferred->load = load ? std::move(load) : spilled(mesh);
  deferred->triangles = mesh.triangles.size();
  deferred->bytes = bytes;
  deferred->has_normals = !mesh.normals.empty();
  deferred->bounds = bounds_of(mesh);
  deferred->focus = focus_of(mesh);
  triangles_ += deferred->triangles;
  deferred_.push_back(deferred);
  const int before = shift_;
  while ((triangles_ >> shift_) > most_samples) ++shift_;
  take_samples(mesh, deferred_.size() - 1, shift_, *deferred);
  for (std::size_t i = 0; shift_ != before && i + 1 < deferred_.size(); ++i) {
    std::erase_if(deferred_[i]->sample,
                  [&](const auto& sample) { return !is_sampled(i, sample.triangle, shift_); });
    deferred_[i]->sample.shrink_to_fit();
    deferred_[i]->sample_shift = shift_;
  }
  TriangleMesh stub;
  stub.missing_uv = mesh.missing_uv;
  stub.deferred = deferred;
  return stub;
}

}  // namespace vitrail
