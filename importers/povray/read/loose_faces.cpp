// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/loose_faces.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "scene/geometry/transform.h"

namespace vitrail::pov {

namespace {

bool refracts(const Material& material) {
  if (const auto* glazed = std::get_if<GlazedMaterial>(&material.model)) return glazed->eta != 1;
  return std::holds_alternative<DielectricMaterial>(material.model);
}

using GlassCorners = std::array<std::uint32_t, 3>;
using GlassEdge = std::pair<std::uint32_t, std::uint32_t>;  // the smaller vertex first
using GlassSide = std::pair<GlassEdge, std::uint32_t>;      // of a face
using Coordinates = std::array<float, 3>;

struct GlassFace {
  std::uint32_t shape, triangle;
  GlassCorners corners;  // of the vertices of all shapes, which places tell apart
  bool turned = false, known = false;
};

class GlassSurface {
 public:
  GlassSurface(const Scene& scene, const std::vector<Shape>& shapes, const std::vector<std::uint32_t>& of) {
    const auto place = [&](std::uint32_t shape, std::uint32_t vertex) {
      const Shape& s = shapes[shape];
      const auto p = cast<float>(
          transform_point(s.object_to_world, cast<double>(scene.meshes[s.mesh.value].positions[vertex])));
      return Coordinates{p.x, p.y, p.z};
    };
    for (const std::uint32_t s : of)
      for (std::uint32_t v = 0; v < scene.meshes[shapes[s].mesh.value].positions.size(); ++v)
        places_.push_back(place(s, v));
    std::ranges::sort(places_);
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
    for (const std::uint32_t s : of) {
      const TriangleMesh& mesh = scene.meshes[shapes[s].mesh.value];
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        GlassCorners corners{};
        for (std::size_t i = 0; i < 3; ++i)
          corners[i] = static_cast<std::uint32_t>(
              std::ranges::lower_bound(places_, place(s, mesh.triangles[t][i])) - places_.begin());
        for (std::size_t i = 0; i < 3; ++i)
          sides_.emplace_back(edge(corners, i), static_cast<std::uint32_t>(faces_.size()));
        faces_.push_back({s, t, corners});
      }
    }
    std::ranges::sort(sides_);
  }

  // Returns the faces that have to be turned.
  std::vector<GlassFace> turned() {
    std::vector<GlassFace> result;
    for (std::size_t first = 0; first < faces_.size(); ++first) {
      if (faces_[first].known) continue;
      const std::vector<std::size_t> part = part_around(first);
      const auto is_turned = [&](std::size_t f) { return faces_[f].turned; };
      if (std::ranges::none_of(part, is_turned)) continue;  // wound alike: it may be a hollow's
      const bool inward = volume(part) < 0;
      for (const std::size_t f : part)
        if (faces_[f].turned != inward) result.push_back(faces_[f]);
    }
    return result;
  }

 private:
  static GlassEdge edge(const GlassCorners& c, std::size_t i) { return std::minmax(c[i], c[(i + 1) % 3]); }
  static bool runs_up(const GlassCorners& c, std::size_t i) { return c[i] < c[(i + 1) % 3]; }

  // The faces that edges of two join to the first, wound as that is; none where they do not close.
  std::vector<std::size_t> part_around(std::size_t first) {
    std::vector<std::size_t> part{first};
    faces_[first].known = true;
    bool closes = true;
    for (std::size_t at = 0; at < part.size(); ++at) {
      const std::size_t from = part[at];
      for (std::size_t i = 0; i < 3; ++i) {
        const auto there =
            std::ranges::equal_range(sides_, edge(faces_[from].corners, i), {}, &GlassSide::first);
        closes = closes && there.size() == 2;
        for (const auto& [_, f] : there) {
          if (faces_[f].known) continue;
          faces_[f].known = true;
          const std::size_t j = side_at(faces_[f].corners, edge(faces_[from].corners, i));
          const bool alike = runs_up(faces_[from].corners, i) != runs_up(faces_[f].corners, j);
          faces_[f].turned = faces_[from].turned == alike;
          part.push_back(f);
        }
      }
    }
    return closes ? part : std::vector<std::size_t>();
  }
  static std::size_t side_at(const GlassCorners& c, const GlassEdge& wanted) {
    std::size_t i = 0;
    while (i < 2 && edge(c, i) != wanted) ++i;
    return i;
  }

  // Six times that which the part encloses, as its faces are turned.
  double volume(const std::vector<std::size_t>& part) const {
    const auto vector = [&](std::uint32_t vertex) {
      const Coordinates& p = places_[vertex];
      return Vector3d{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
    };
    const Vector3d from = vector(faces_[part.front()].corners[0]);
    double sum = 0;
    for (const std::size_t f : part) {
      const auto at = [&](std::size_t i) { return vector(faces_[f].corners[i]) - from; };
      sum += (faces_[f].turned ? -1 : 1) * dot(at(0), cross(at(1), at(2)));
    }
    return sum;
  }

  std::vector<GlassFace> faces_;
  std::vector<Coordinates> places_;  // of the vertices, in ascending order
  std::vector<GlassSide> sides_;     // of the faces, by their edges
};

// With its normals, but for those that faces on both sides share.
void turn(TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles) {
  std::vector<int> uses(mesh.normals.empty() ? 0 : mesh.positions.size());
  if (!uses.empty())
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) ++uses[v];
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t v : mesh.triangles[t])
      if (!uses.empty() && --uses[v] == 0)
        mesh.normals[v] = {-mesh.normals[v].x, -mesh.normals[v].y, -mesh.normals[v].z};
    std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
}

}  // namespace

void turn_glass_out(Scene& scene, const std::vector<Shape>& shapes) {
  std::unordered_map<std::uint32_t, int> uses;
  for (const Shape& shape : shapes) ++uses[shape.mesh.value];
  std::map<std::pair<std::uint32_t, std::int64_t>, std::vector<std::uint32_t>> groups;
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    const bool is_plain = !mesh.quadric && !mesh.deferred && uses[shape.mesh.value] == 1 &&
                          !shape.flip_orientation && !swaps_handedness(shape.object_to_world);
    if (is_plain && refracts(scene.materials[shape.material.value]))
      groups[{shape.material.value, shape.interior ? std::int64_t{shape.interior->value} : -1}].push_back(i);
  }
  for (const auto& [key, members] : groups) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> triangles;  // of each shape
    for (const GlassFace& face : GlassSurface(scene, shapes, members).turned())
      triangles[face.shape].push_back(face.triangle);
    for (const auto& [shape, of] : triangles) turn(scene.meshes[shapes[shape].mesh.value], of);
  }
}

}  // namespace vitrail::pov
