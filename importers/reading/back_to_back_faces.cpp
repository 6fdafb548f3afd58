// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/back_to_back_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "scene/records/curve_uses.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/deferred_mesh.h"
#include "scene/shapes/mesh_parts.h"
#include "scene/shapes/triangle_overlaps.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

constexpr std::uint64_t most_triangles = 1 << 18;

struct Face {
  std::uint32_t shape, triangle;
  Vector3d front;  // unit
};

// Of a face, while those with a back are sought: its corners in order, too.
constexpr std::uint64_t bytes_of_face = sizeof(Face) + sizeof(FlatTriangle) + 3 * sizeof(std::uint32_t);

class FacesOfSpace {
 public:
  FacesOfSpace(ImportedScene& imported, std::vector<Shape>& shapes, const std::vector<MaterialTraits>& traits)
      : scene_(imported.scene), diagnostics_(imported.diagnostics), shapes_(shapes), traits_(traits) {}

  void run() {
    std::uint64_t count = 0, candidates = 0;
    for (const Shape& shape : shapes_)
      if (is_candidate(shape)) ++candidates, count += triangles_of(scene_.meshes[shape.mesh.value]);
    if (candidates < 2 || count > most_triangles) return;
    ask_memory(count * bytes_of_face);
    flat_.reserve(count);
    faces_.reserve(count);
    gather();
    keep_those_with_a_back();
    join(partners());
  }

 private:
  bool is_candidate(const Shape& shape) const {
    const std::uint32_t material = shape.material.value;
    const TriangleMesh& mesh = scene_.meshes[shape.mesh.value];
    return !shape.area_light && shape.opacity == FloatParameter{1.0f} && !shape.interior && !shape.exterior &&
           !mesh.quadric && !is_of_curves(scene_, shape) && material < traits_.size() &&
           !traits_[material].transmits && !traits_[material].nothing && !traits_[material].fibre &&
           !is_made_of_others(scene_.materials[material]);
  }

  void gather() {
    for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
      const Shape& shape = shapes_[i];
      if (!is_candidate(shape)) continue;
      TriangleMesh storage;
      const TriangleMesh& mesh = loaded(scene_.meshes[shape.mesh.value], storage);
      const double side = shape.flip_orientation != swaps_handedness(shape.object_to_world) ? -1 : 1;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Point3d, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
          p[k] = transform_point(shape.object_to_world, cast<double>(mesh.positions[mesh.triangles[t][k]]));
        const FlatTriangle flat = flat_triangle(p);
        if (!(flat.area > 0)) continue;
        flat_.push_back(flat);
        faces_.push_back({i, t, flat.normal * side});
      }
    }
  }

  // Only those with a face of another shape at each corner that looks the other way: few, in most scenes
  // none.
  void keep_those_with_a_back() {
    const auto place = [&](std::uint32_t corner) {
      const Point3d& p = flat_[corner / 3].p[corner % 3];
      return std::tie(p.x, p.y, p.z);
    };
    std::vector<std::uint32_t> corners(3 * faces_.size());
    std::iota(corners.begin(), corners.end(), 0u);
    std::ranges::sort(corners, {}, place);
    std::vector<bool> has_back(corners.size());
    for (auto first = corners.begin(), end = first; first != corners.end(); first = end) {
      end = std::find_if(first, corners.end(), [&](std::uint32_t c) { return place(c) != place(*first); });
      for (auto c = first; c != end; ++c)
        has_back[*c] = std::any_of(first, end, [&](std::uint32_t d) { return are_two_sides(*c / 3, d / 3); });
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (has_back[3 * i] && has_back[3 * i + 1] && has_back[3 * i + 2])
        faces_[kept] = faces_[i], flat_[kept++] = flat_[i];
    faces_.resize(kept), flat_.resize(kept);
  }

  bool are_two_sides(std::uint32_t i, std::uint32_t j) const {
    const Shape &a = shapes_[faces_[i].shape], &b = shapes_[faces_[j].shape];
    const bool alike = a.material == b.material && scene_.materials[a.material.value].two_sided;
    return faces_[i].shape != faces_[j].shape && !alike && dot(faces_[i].front, faces_[j].front) < -0.999999;
  }

  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // shapes, the first one before the second
  struct Sides {
    std::vector<std::uint32_t> first, second;  // triangles, in order
    double first_area = 0, second_area = 0;
  };

  // Pairs of shapes, and of each the triangles that the other one covers.
  std::map<Pair, Sides> partners() const {
    bool complete = true;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> covered;  // face, shape
    for (const Overlap& o : overlaps_of(flat_, complete))
      if (are_two_sides(o.first, o.second)) {
        covered[{o.first, faces_[o.second].shape}] += o.area;
        covered[{o.second, faces_[o.first].shape}] += o.area;
      }
    std::map<Pair, Sides> pairs;
    std::vector<bool> used(faces_.size());
    for (const auto& [of, area] : covered) {
      const auto [face, other] = of;
      if (used[face] || area < (1 - 1e-5) * flat_[face].area) continue;
      used[face] = true;
      const std::uint32_t shape = faces_[face].shape;
      Sides& sides = pairs[{std::min(shape, other), std::max(shape, other)}];
      (shape < other ? sides.first : sides.second).push_back(faces_[face].triangle);
      (shape < other ? sides.first_area : sides.second_area) += flat_[face].area;
    }
    std::erase_if(pairs, [](const auto& pair) {
      const Sides& s = pair.second;
      return std::abs(s.first_area - s.second_area) > 1e-4 * s.first_area;
    });
    return pairs;
  }

  void join(const std::map<Pair, Sides>& pairs) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> taken;  // of each shape
    std::vector<Shape> joined;
    for (const auto& [pair, sides] : pairs) {
      const auto [first, second] = pair;
      Shape shape = shapes_[first];
      shape.mesh = part_of(shape, sides.first);
      shape.material = two_sided(shapes_[first].material, shapes_[second].material);
      joined.push_back(std::move(shape));
      for (const auto& [of, triangles] : {std::pair{first, &sides.first}, {second, &sides.second}})
        taken[of].insert(taken[of].end(), triangles->begin(), triangles->end());
      const SourceLocation place = location(scene_, shapes_[first].origin);
      diagnostics_.push_back(
          {Fidelity::approximated,
           fmt::format("{} triangles of this shape have those of {} on their back, in one place: "
                       "one surface with a material for each side",
                       sides.first.size(), to_string(location(scene_, shapes_[second].origin))),
           place, place, RecordKind::shape});
    }
    std::vector<bool> gone(shapes_.size());
    for (auto& [index, triangles] : taken) {
      std::ranges::sort(triangles);
      std::vector<std::uint32_t> kept;
      for (std::uint32_t t = 0; t < triangles_of(scene_.meshes[shapes_[index].mesh.value]); ++t)
        if (!std::ranges::binary_search(triangles, t)) kept.push_back(t);
      gone[index] = kept.empty();
      if (!kept.empty()) shapes_[index].mesh = part_of(shapes_[index], kept);
    }
    std::size_t index = 0;
    std::erase_if(shapes_, [&](const Shape&) { return gone[index++]; });
    shapes_.insert(shapes_.end(), joined.begin(), joined.end());
  }

  Id<TriangleMesh> part_of(const Shape& shape, const std::vector<std::uint32_t>& triangles) {
    TriangleMesh storage;
    TriangleMesh part = only_triangles(loaded(scene_.meshes[shape.mesh.value], storage), triangles);
    scene_.meshes.push_back(std::move(part));
    return {static_cast<std::uint32_t>(scene_.meshes.size() - 1)};
  }

  Id<Material> two_sided(Id<Material> front, Id<Material> back) {
    const auto known =
        std::ranges::find(scene_.materials, MaterialModel{TwoSidedMaterial{front, back}}, &Material::model);
    if (known != scene_.materials.end())
      return {static_cast<std::uint32_t>(known - scene_.materials.begin())};
    Material material{TwoSidedMaterial{front, back}};
    material.origin = scene_.materials[front.value].origin;
    scene_.materials.push_back(std::move(material));
    return {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  }

  Scene& scene_;
  Diagnostics& diagnostics_;
  std::vector<Shape>& shapes_;
  const std::vector<MaterialTraits>& traits_;  // of the scene's own materials
  std::vector<Face> faces_;
  std::vector<FlatTriangle> flat_;  // of these
};

}  // namespace

void join_faces_back_to_back(ImportedScene& imported) {
  const std::vector<MaterialTraits> traits = traits_of(imported.scene.materials);
  FacesOfSpace(imported, imported.scene.shapes, traits).run();
  for (Prototype& prototype : imported.scene.prototypes)
    FacesOfSpace(imported, prototype.shapes, traits).run();
}

}  // namespace vitrail
