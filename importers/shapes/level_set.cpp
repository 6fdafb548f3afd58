// SPDX-License-Identifier: Apache-2.0
#include "importers/shapes/level_set.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace vitrail {

namespace {

double along(const Point3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

class Trilinear {
 public:
  explicit Trilinear(const SampledFunction& f) : f_(f), cells_{f.nx - 1, f.ny - 1, f.nz - 1} {}

  double at_corner(int x, int y, int z) const {
    const auto row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(f_.ny) + static_cast<std::size_t>(y);
    return static_cast<double>(
        f_.values[row * static_cast<std::size_t>(f_.nx) + static_cast<std::size_t>(x)]);
  }
  // At a point of [0,1]³, clamped to it.
  double operator()(const Point3d& p) const {
    std::array<int, 3> cell{};
    std::array<double, 3> t{};
    for (int axis = 0; axis < 3; ++axis) {
      const double at = std::clamp(along(p, axis), 0.0, 1.0) * cells_[static_cast<std::size_t>(axis)];
      const auto i = static_cast<std::size_t>(axis);
      cell[i] = std::min(static_cast<int>(at), cells_[i] - 1);
      t[i] = at - cell[i];
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
      sum += (dx ? t[0] : 1 - t[0]) * (dy ? t[1] : 1 - t[1]) * (dz ? t[2] : 1 - t[2]) *
             at_corner(cell[0] + dx, cell[1] + dy, cell[2] + dz);
    }
    return sum;
  }
  // Central differences over `cells` cells.
  Vector3d gradient(const Point3d& p, double cells) const {
    const auto difference = [&](int axis) {
      const double half = cells / 2 / cells_[static_cast<std::size_t>(axis)];
      Point3d low = p, high = p;
      (axis == 0 ? low.x : axis == 1 ? low.y : low.z) = std::max(along(p, axis) - half, 0.0);
      (axis == 0 ? high.x : axis == 1 ? high.y : high.z) = std::min(along(p, axis) + half, 1.0);
      return ((*this)(high) - (*this)(low)) / (along(high, axis) - along(low, axis));
    };
    return {difference(0), difference(1), difference(2)};
  }
  // Cells whose corners have both signs: only there it is 0.
  std::vector<std::array<int, 3>> crossed_cells() const {
    std::vector<std::array<int, 3>> crossed;
    for (int z = 0; z < cells_[2]; ++z)
      for (int y = 0; y < cells_[1]; ++y)
        for (int x = 0; x < cells_[0]; ++x) {
          int inside = 0;
          for (int corner = 0; corner < 8; ++corner)
            inside += at_corner(x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)) < 0;
          if (inside != 0 && inside != 8) crossed.push_back({x, y, z});
        }
    return crossed;
  }
  const std::array<int, 3>& cells() const { return cells_; }

 private:
  const SampledFunction& f_;
  std::array<int, 3> cells_;
};

// Builds the mesh over a grid that has `parts` steps along each side of a cell.
class Tetrahedra {
 public:
  Tetrahedra(const Trilinear& f, int parts) : f_(f), parts_(parts) {}

  void add_cell(const std::array<int, 3>& cell) {
    const std::size_t side = static_cast<std::size_t>(parts_) + 1;
    const auto [x, y, z] = cell;
    corners_.clear();
    for (std::int64_t k = 0; k <= parts_; ++k)
      for (std::int64_t j = 0; j <= parts_; ++j)
        for (std::int64_t i = 0; i <= parts_; ++i)
          corners_.push_back(corner({x * parts_ + i, y * parts_ + j, z * parts_ + k}));
    for (std::size_t k = 0; k + 1 < side; ++k)
      for (std::size_t j = 0; j + 1 < side; ++j)
        for (std::size_t i = 0; i + 1 < side; ++i) add_small_cell((k * side + j) * side + i, side);
  }

  LevelSet take() {
    for (const auto& t : result_.mesh.triangles) {
      const auto p = [&](std::size_t i) { return cast<double>(result_.mesh.positions[t[i]]); };
      const Point3d middle = p(0) + ((p(1) - p(0)) + (p(2) - p(0))) * (1.0 / 3);
      const double slope = length(f_.gradient(middle, 1e-3));
      if (slope > 0) result_.distance = std::max(result_.distance, std::abs(f_(middle)) / slope);
    }
    return std::move(result_);
  }

 private:
  struct Corner {
    std::uint64_t id = 0;
    Point3d place;
    double value = 0;
  };

  Corner corner(const std::array<std::int64_t, 3>& at) const {
    const auto size = [&](std::size_t axis) { return static_cast<std::int64_t>(f_.cells()[axis]) * parts_; };
    const auto place = [&](std::size_t axis) {
      return static_cast<double>(at[axis]) / static_cast<double>(size(axis));
    };
    const Point3d p{place(0), place(1), place(2)};
    const std::int64_t id = (at[2] * (size(1) + 1) + at[1]) * (size(0) + 1) + at[0];
    return {static_cast<std::uint64_t>(id), p, f_(p)};
  }

  // The six around its diagonal, each a way from its lowest corner to its highest.
  void add_small_cell(std::size_t low, std::size_t side) {
    static constexpr std::array<std::array<int, 3>, 6> ways{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    std::array<const Corner*, 8> corners{};  // bit i: the higher along axis i
    std::size_t inside = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      corners[i] = &corners_[low + (i & 1) + ((i >> 1 & 1) + (i >> 2) * side) * side];
      inside += corners[i]->value < 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& way : ways) {
      std::array<const Corner*, 4> tetrahedron{corners[0]};
      for (std::size_t i = 0, at = 0; i < 3; ++i)
        tetrahedron[i + 1] = corners[at |= std::size_t{1} << way[i]];
      add_tetrahedron(tetrahedron);
    }
  }

  void add_tetrahedron(const std::array<const Corner*, 4>& corners) {
    std::array<const Corner*, 4> in{}, out{};
    std::size_t ins = 0, outs = 0;
    for (const Corner* c : corners) (c->value < 0 ? in[ins++] : out[outs++]) = c;
    if (ins == 0 || outs == 0) return;
    const Vector3d outwards = out[0]->place - in[0]->place;
    const auto v = [&](std::size_t i, std::size_t o) { return vertex(*in[i], *out[o]); };
    if (ins == 1) {
      add({v(0, 0), v(0, 1), v(0, 2)}, outwards);
    } else if (ins == 3) {
      add({v(0, 0), v(1, 0), v(2, 0)}, outwards);
    } else {
      const std::uint32_t a = v(0, 0), b = v(0, 1), c = v(1, 1), d = v(1, 0);
      add({a, b, c}, outwards);
      add({a, c, d}, outwards);
    }
  }

  std::uint32_t vertex(const Corner& in, const Corner& out) {
    const auto [known, is_new] = vertices_[std::min(in.id, out.id)].try_emplace(
        std::max(in.id, out.id), static_cast<std::uint32_t>(result_.mesh.positions.size()));
    if (!is_new) return known->second;
    const Point3d p = in.place + (out.place - in.place) * (in.value / (in.value - out.value));
    result_.mesh.positions.push_back(cast<float>(p));
    const Vector3d n = unit(f_.gradient(p, 1));
    result_.mesh.normals.push_back(
        {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)});
    return known->second;
  }

  // Wound so that its front looks `outwards`, which is on that side of it.
  void add(std::array<std::uint32_t, 3> t, const Vector3d& outwards) {
    const auto p = [&](std::size_t i) { return cast<double>(result_.mesh.positions[t[i]]); };
    if (dot(cross(p(1) - p(0), p(2) - p(0)), outwards) < 0) std::swap(t[1], t[2]);
    result_.mesh.triangles.push_back(t);
  }

  const Trilinear& f_;
  std::int64_t parts_;
  std::vector<Corner> corners_;  // of the small cells of one cell
  std::unordered_map<std::uint64_t, std::unordered_map<std::uint64_t, std::uint32_t>> vertices_;
  LevelSet result_;
};

}  // namespace

LevelSet level_set(const SampledFunction& function) {
  const Trilinear f(function);
  const auto crossed = f.crossed_cells();
  // Some six triangles a small cell that it goes through.
  constexpr double wanted_triangles = 5e5, most_parts = 6;
  const double parts =
      std::sqrt(wanted_triangles / 6 / static_cast<double>(std::max<std::size_t>(crossed.size(), 1)));
  const int n = static_cast<int>(std::clamp(parts, 1.0, most_parts));
  Tetrahedra made(f, n);
  for (const auto& cell : crossed) made.add_cell(cell);
  return made.take();
}

}  // namespace vitrail
