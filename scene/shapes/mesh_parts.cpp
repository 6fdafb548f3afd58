// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/mesh_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace vitrail {

namespace {

constexpr std::uint32_t none = 0xffffffff;

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

using Corners = std::array<std::uint32_t, 3>;  // by number of a position

Corners sorted(Corners c) {
  std::ranges::sort(c);
  return c;
}

struct Edge {
  std::uint32_t low, high, triangle;
  bool ascends;
  auto key() const { return std::pair{low, high}; }
};

class Parter {
 public:
  explicit Parter(std::span<const PlacedMesh> meshes) {
    number_positions(meshes);
    find_doubles();
  }

  std::vector<MeshPart> parts() {
    join_by_edges();
    gather();
    for (std::size_t i = 0; i < parts_.size(); ++i) measure(parts_[i], rims_[i]);
    pair_faces();
    return std::move(parts_);
  }

 private:
  // Equal positions have one number. Triangles without three of them are left out.
  void number_positions(std::span<const PlacedMesh> meshes) {
    std::vector<Point3d> all;
    for (const auto& [mesh, to_space] : meshes)
      for (const Point3f& p : mesh->positions) all.push_back(transform_point(to_space, cast<double>(p)));
    std::vector<std::uint32_t> order(all.size()), number(all.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
      const Point3d &p = all[a], &q = all[b];
      return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::ranges::sort(order, less);
    for (const std::uint32_t i : order) {
      if (positions_.empty() || positions_.back() != all[i]) positions_.push_back(all[i]);
      number[i] = static_cast<std::uint32_t>(positions_.size() - 1);
    }
    std::uint32_t first = 0;
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
      const TriangleMesh& mesh = *meshes[m].mesh;
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Corners corners{number[first + a], number[first + b], number[first + c]};
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
        triangles_.push_back({m, t});
        corners_.push_back(corners);
      }
      first += static_cast<std::uint32_t>(mesh.positions.size());
    }
  }

  // The first triangle with the same corners, in any order.
  void find_doubles() {
    std::vector<std::uint32_t> order(corners_.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::pair{sorted(corners_[i]), i}; };
    std::ranges::sort(order, {}, key);
    first_.assign(corners_.size(), none);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool again = i > 0 && sorted(corners_[order[i]]) == sorted(corners_[order[i - 1]]);
      first_[order[i]] = again ? first_[order[i - 1]] : order[i];
    }
  }

  void join_by_edges() {
    std::vector<Edge> edges;
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      for (std::size_t k = 0; k < 3 && first_[t] == t; ++k) {
        const std::uint32_t a = corners_[t][k], b = corners_[t][(k + 1) % 3];
        edges.push_back({std::min(a, b), std::max(a, b), t, a < b});
      }
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair{e.key(), e.triangle}; });
    sets_ = Sets(corners_.size());
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
      for (end = i + 1; end < edges.size() && edges[end].key() == edges[i].key(); ++end)
        sets_.join(edges[i].triangle, edges[end].triangle);
      if (end == i + 1) rim_.push_back(edges[i]);
    }
  }

  void gather() {
    std::vector<std::uint32_t> part(corners_.size(), none);
    for (std::uint32_t t = 0; t < corners_.size(); ++t) {
      std::uint32_t& index = part[sets_.of(first_[t])];
      if (index == none) {
        index = static_cast<std::uint32_t>(parts_.size());
        parts_.emplace_back();
      }
      (first_[t] == t ? parts_[index].triangles : parts_[index].doubles).push_back(triangles_[t]);
      if (first_[t] == t) members_.resize(parts_.size()), members_[index].push_back(t);
    }
    rims_.resize(parts_.size());
    for (const Edge& edge : rim_) rims_[part[sets_.of(edge.triangle)]].push_back(edge);
  }

  void measure(MeshPart& part, const std::vector<Edge>& rim) {
    const auto& members = members_[static_cast<std::size_t>(&part - parts_.data())];
    const Point3d o = positions_[corners_[members.front()][0]];
    Vector3d middle;
    double volume = 0, reach = 0;
    for (const std::uint32_t t : members) {
      const Vector3d a = positions_[corners_[t][0]] - o, b = positions_[corners_[t][1]] - o,
                     c = positions_[corners_[t][2]] - o;
      const Vector3d n = cross(b - a, c - a) * 0.5;
      part.area += length(n);
      part.facing = part.facing + n;
      middle = middle + (a + b + c) * (length(n) / 3);
      volume += dot(a, n) / 3;
      for (const std::uint32_t i : corners_[t])
        reach = std::max(
            {reach, std::abs(positions_[i].x), std::abs(positions_[i].y), std::abs(positions_[i].z)});
    }
    if (part.area > 0) part.centre = o + middle * (1 / part.area);
    part.open_area = area_of_holes(rim);
    if (part.open_area > 1e-3 * part.area)
      part.kind = MeshPart::Kind::open;
    else if (std::abs(volume) <= 1e-6 * reach * part.area)
      part.kind = MeshPart::Kind::folded;
  }

  // Of each ring of the rim, as far as it is flat: ½ Σ a × b over its edges.
  double area_of_holes(const std::vector<Edge>& rim) {
    std::vector<std::uint32_t> ends;
    for (const Edge& e : rim) ends.push_back(e.low), ends.push_back(e.high);
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto local = [&](std::uint32_t i) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(ends, i) - ends.begin());
    };
    Sets rings(ends.size());
    for (const Edge& e : rim) rings.join(local(e.low), local(e.high));
    std::vector<Vector3d> sums(ends.size());
    for (const Edge& e : rim) {
      const std::uint32_t ring = rings.of(local(e.low));
      const Point3d o = positions_[ends[ring]];
      const Vector3d across = cross(positions_[e.low] - o, positions_[e.high] - o) * 0.5;
      sums[ring] = e.ascends ? sums[ring] + across : sums[ring] - across;
    }
    double area = 0;
    for (const Vector3d& sum : sums) area += length(sum);
    return area;
  }

  // Two open sheets of one size that turn their backs to each other, near and right behind, are a pane whose
  // rim is not there: light is inside between them, and nowhere else.
  void pair_faces() {
    std::vector<MeshPart*> open;
    for (MeshPart& part : parts_)
      if (part.kind == MeshPart::Kind::open && length(part.facing) > 0.5 * part.area) open.push_back(&part);
    std::ranges::sort(open, {}, [](const MeshPart* part) { return part->centre.x; });
    for (std::size_t i = 0; i < open.size(); ++i) {
      const double near = 0.1 * std::sqrt(open[i]->area);
      for (std::size_t k = i + 1; k < open.size() && open[k]->centre.x - open[i]->centre.x <= near; ++k)
        if (are_two_faces(*open[i], *open[k], near)) open[i]->kind = open[k]->kind = MeshPart::Kind::rimless;
    }
  }

  static bool are_two_faces(const MeshPart& a, const MeshPart& b, double near) {
    const Vector3d between = b.centre - a.centre;
    if (length(a.facing + b.facing) > 0.02 * length(a.facing) || length(between) > near) return false;
    const double behind = -dot(between, normalize(a.facing));
    return behind > 0 && length(between + normalize(a.facing) * behind) <= 0.1 * near;
  }

  std::vector<Point3d> positions_;  // all different
  std::vector<MeshTriangle> triangles_;
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> first_;
  Sets sets_{0};
  std::vector<Edge> rim_;  // edges of one triangle
  std::vector<MeshPart> parts_;
  std::vector<std::vector<std::uint32_t>> members_;
  std::vector<std::vector<Edge>> rims_;
};

template <class T>
std::vector<T> gathered(const std::vector<T>& values, std::span<const std::uint32_t> indices,
                        std::size_t width = 1) {
  std::vector<T> result;
  if (values.empty()) return result;
  for (const std::uint32_t i : indices)
    for (std::size_t k = 0; k < width; ++k) result.push_back(values[i * width + k]);
  return result;
}

}  // namespace

std::vector<MeshPart> parts_of(std::span<const PlacedMesh> meshes) { return Parter(meshes).parts(); }

TriangleMesh only_triangles(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : triangles)
    vertices.insert(vertices.end(), mesh.triangles[t].begin(), mesh.triangles[t].end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  TriangleMesh part;
  part.missing_uv = mesh.missing_uv;
  part.positions = gathered(mesh.positions, vertices);
  part.normals = gathered(mesh.normals, vertices);
  part.uvs = gathered(mesh.uvs, vertices);
  part.triangles = gathered(mesh.triangles, triangles);
  for (auto& triangle : part.triangles)
    for (std::uint32_t& i : triangle)
      i = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, i) - vertices.begin());
  for (const MeshAttribute& a : mesh.attributes) {
    const auto width = static_cast<std::size_t>(a.channels);
    part.attributes.push_back(
        {a.name, a.per_face, a.channels,
         gathered(a.values, a.per_face ? triangles : std::span<const std::uint32_t>(vertices), width)});
  }
  return part;
}

}  // namespace vitrail
