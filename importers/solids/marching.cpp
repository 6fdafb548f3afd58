// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/marching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace vitrail::solids {

namespace {

using Cell = std::array<int, 3>;

// Takes the points of a lattice to those of a container: a box as it is, a sphere from the cube around it, of
// which each point goes along its ray.
class Chart {
 public:
  Chart(const Container& container, int cells) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    cells = std::min(cells, 8);  // a quadric has 160: seconds under the sanitizers
#endif
    if (const auto* sphere = std::get_if<ContainingSphere>(&container)) {
      sphere_ = *sphere;
      is_sphere_ = true;
      box_ = {{-1, -1, -1}, {1, 1, 1}};
    } else {
      box_ = std::get<Bounds3d>(container);
    }
    const Vector3d size = extent(box_);
    const double greatest = std::max({size.x, size.y, size.z});
    for (int axis = 0; axis < 3; ++axis) {
      // Odd, so that no point of the lattice lies on the planes of symmetry that many functions have.
      const int count = std::max(static_cast<int>(std::ceil(cells * size[axis] / greatest)), 5) | 1;
      count_[static_cast<std::size_t>(axis)] = count;
      cell_ = std::max(cell_, size[axis] / count);
    }
    if (is_sphere_) cell_ *= sphere_.radius;
  }

  const Cell& count() const { return count_; }
  double cell() const { return cell_; }
  bool is_sphere() const { return is_sphere_; }

  Point3d lattice(const Cell& at) const {
    const auto along = [&](int axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double t = static_cast<double>(at[i]) / count_[i];
      return box_.lower[axis] * (1 - t) + box_.upper[axis] * t;
    };
    return {along(0), along(1), along(2)};
  }
  Point3d place(const Point3d& p) const {
    if (!is_sphere_) return p;
    const double most = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const Vector3d v = p - Point3d{};
    return most > 0 ? sphere_.center + v * (sphere_.radius * most / length(v)) : sphere_.center;
  }
  // No two points of the container are further apart than this many times their distance on the lattice.
  double stretch() const { return is_sphere_ ? 2 * sphere_.radius : 1; }

 private:
  bool is_sphere_ = false;
  ContainingSphere sphere_;
  Bounds3d box_;
  Cell count_{};
  double cell_ = 0;
};

struct Corner {
  std::uint64_t id = 0;
  Cell at{};
  Point3d lattice;
  double value = 0;
};

struct Pair {
  std::uint64_t a, b;
  bool operator==(const Pair&) const = default;
};
struct PairHash {
  std::size_t operator()(const Pair& p) const {
    std::size_t h = p.a * 0x9e3779b97f4a7c15ull ^ (p.b + 0x7f4a7c15) * 0xbf58476d1ce4e5b9ull;
    return h ^ h >> 31;
  }
};

class Marching {
 public:
  explicit Marching(const Implicit& implicit)
      : implicit_(implicit), chart_(implicit.container, implicit.cells) {
    made_.cell = chart_.cell();
  }

  March run() {
    int size = leaf;
    for (const int n : chart_.count())
      while (size < n) size *= 2;
    visit({0, 0, 0}, size);
    return std::move(made_);
  }

 private:
  static constexpr int leaf = 4;  // cells along the edge of the smallest blocks

  double value(const Point3d& lattice) const {
    const double v = implicit_.field(chart_.place(lattice));
    return std::isnan(v) ? std::numeric_limits<double>::infinity() : v;
  }

  // A block of cells from `low` on: left out where the gradient's bound keeps zero away.
  void visit(const Cell& low, int size) {
    Cell high = low;
    bool at_side = false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (low[i] >= chart_.count()[i]) return;
      high[i] = std::min(low[i] + size, chart_.count()[i]);
      at_side = at_side || low[i] == 0 || high[i] == chart_.count()[i];
    }
    if (implicit_.max_gradient > 0) {
      const Point3d a = chart_.lattice(low), b = chart_.lattice(high);
      const double v = value(a + (b - a) * 0.5);
      const double reach = implicit_.max_gradient * length(b - a) / 2 * chart_.stretch();
      if (v > reach || (v < -reach && !at_side)) return;
    }
    if (implicit_.is_outside && std::holds_alternative<Bounds3d>(implicit_.container)) {
      Bounds3d cells;
      extend(cells, chart_.lattice(low));
      extend(cells, chart_.lattice(high));
      if (implicit_.is_outside(cells)) return;
    }
    if (size == leaf) return cut(low, high);
    for (int i = 0; i < 8; ++i) {
      const int half = size / 2;
      visit({low[0] + (i & 1 ? half : 0), low[1] + (i & 2 ? half : 0), low[2] + (i & 4 ? half : 0)}, half);
    }
  }

  void cut(const Cell& low, const Cell& high) {
    std::array<Corner, std::size_t{leaf + 1} * (leaf + 1) * (leaf + 1)> corners;
    const auto index = [](int x, int y, int z) {
      const int place = (z * (leaf + 1) + y) * (leaf + 1) + x;
      return static_cast<std::size_t>(place);
    };
    const Cell size{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    for (int z = 0; z <= size[2]; ++z)
      for (int y = 0; y <= size[1]; ++y)
        for (int x = 0; x <= size[0]; ++x)
          corners[index(x, y, z)] = corner({low[0] + x, low[1] + y, low[2] + z});
    for (int z = 0; z < size[2]; ++z)
      for (int y = 0; y < size[1]; ++y)
        for (int x = 0; x < size[0]; ++x) {
          std::array<const Corner*, 8> of{};  // bit i: the higher along axis i
          for (int i = 0; i < 8; ++i)
            of[static_cast<std::size_t>(i)] = &corners[index(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2))];
          add_cell(of);
        }
  }

  Corner corner(const Cell& at) const {
    const auto& n = chart_.count();
    const auto u = [](int i) { return static_cast<std::uint64_t>(i); };
    const Point3d p = chart_.lattice(at);
    return {(u(at[2]) * (u(n[1]) + 1) + u(at[1])) * (u(n[0]) + 1) + u(at[0]), at, p, value(p)};
  }

  // Six tetrahedra around its diagonal, each a way from its lowest corner to its highest.
  void add_cell(const std::array<const Corner*, 8>& of) {
    static constexpr std::array<std::array<int, 3>, 6> ways{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    if (std::ranges::none_of(of, [](const Corner* c) { return c->value < 0; })) return;
    for (const auto& way : ways) {
      std::array<const Corner*, 4> tetrahedron{of[0]};
      for (std::size_t i = 0, at = 0; i < 3; ++i) tetrahedron[i + 1] = of[at |= std::size_t{1} << way[i]];
      add_zero(tetrahedron);
      for (std::size_t left_out = 0; left_out < 4; ++left_out) add_cap(tetrahedron, left_out);
    }
  }

  void add_zero(const std::array<const Corner*, 4>& corners) {
    std::array<const Corner*, 4> in{}, out{};
    std::size_t ins = 0, outs = 0;
    for (const Corner* c : corners) (c->value < 0 ? in[ins++] : out[outs++]) = c;
    if (ins == 0 || outs == 0) return;
    const Vector3d outwards = out[0]->lattice - in[0]->lattice;
    const auto v = [&](std::size_t i, std::size_t o) { return crossing(*in[i], *out[o]); };
    if (ins == 1) {
      add({v(0, 0), v(0, 1), v(0, 2)}, outwards, on_zero);
    } else if (ins == 3) {
      add({v(0, 0), v(1, 0), v(2, 0)}, outwards, on_zero);
    } else {
      const std::uint32_t a = v(0, 0), b = v(0, 1), c = v(1, 1), d = v(1, 0);
      add({a, b, c}, outwards, on_zero);
      add({a, c, d}, outwards, on_zero);
    }
  }

  // What is inside of a tetrahedron's side that lies in a side of the lattice.
  void add_cap(const std::array<const Corner*, 4>& corners, std::size_t left_out) {
    std::array<const Corner*, 3> c{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 4; ++i)
      if (i != left_out) c[count++] = corners[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int at = c[0]->at[axis];
      if (c[1]->at[axis] != at || c[2]->at[axis] != at) continue;
      if (at != 0 && at != chart_.count()[axis]) continue;
      Vector3d outwards;
      outwards[static_cast<int>(axis)] = at == 0 ? -1 : 1;
      const Lies lies = chart_.is_sphere() ? on_sphere : on_first_side << (2 * axis + (at == 0 ? 0 : 1));
      std::array<std::uint32_t, 4> polygon{};
      std::size_t size = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Corner &a = *c[i], &b = *c[(i + 1) % 3];
        if (a.value < 0) polygon[size++] = vertex({a.id, a.id}, a.lattice);
        if ((a.value < 0) != (b.value < 0)) polygon[size++] = a.value < 0 ? crossing(a, b) : crossing(b, a);
      }
      for (std::size_t i = 2; i < size; ++i) add({polygon[0], polygon[i - 1], polygon[i]}, outwards, lies);
    }
  }

  // Where the sign changes between two corners, by the Illinois method (Dowell and Jarratt 1971), and where
  // that does not help by halves; not so near to a corner that triangles lose their area.
  std::uint32_t crossing(const Corner& in, const Corner& out) {
    const Pair key{std::min(in.id, out.id), std::max(in.id, out.id)};
    if (const auto known = vertices_.find(key); known != vertices_.end()) return known->second;
    double a = 0, b = 1, fa = in.value, fb = out.value;
    const Vector3d way = out.lattice - in.lattice;
    for (int i = 0; i < 12 && b - a > 1e-3; ++i) {
      double t = (a + b) / 2;
      if (std::isfinite(fa) && std::isfinite(fb) && i % 3 != 2) t = a + (b - a) * (fa / (fa - fb));
      if (!(t > a && t < b)) break;
      const double f = value(in.lattice + way * t);
      if (f < 0) {
        a = t, fa = f, fb = i % 3 == 2 ? fb : fb / 2;
      } else {
        b = t, fb = f, fa = i % 3 == 2 ? fa : fa / 2;
      }
      if (f == 0) break;
    }
    const double t = std::clamp(std::abs(fa) < std::abs(fb) ? a : b, 0.03, 0.97);
    return vertex(key, in.lattice + way * t);
  }

  std::uint32_t vertex(const Pair& key, const Point3d& lattice) {
    const auto [known, is_new] =
        vertices_.try_emplace(key, static_cast<std::uint32_t>(made_.positions.size()));
    if (is_new) {
      made_.positions.push_back(chart_.place(lattice));
      lattice_.push_back(lattice);
    }
    return known->second;
  }

  // Wound so that its front looks `outwards`, which is on that side of it.
  void add(std::array<std::uint32_t, 3> t, const Vector3d& outwards, Lies lies) {
    const Point3d a = lattice_[t[0]];
    if (dot(cross(lattice_[t[1]] - a, lattice_[t[2]] - a), outwards) < 0) std::swap(t[1], t[2]);
    made_.triangles.push_back(t);
    made_.lies.push_back(lies);
  }

  const Implicit& implicit_;
  Chart chart_;
  std::unordered_map<Pair, std::uint32_t, PairHash> vertices_;
  std::vector<Point3d> lattice_;
  March made_;
};

}  // namespace

March march(const Implicit& implicit) { return Marching(implicit).run(); }

}  // namespace vitrail::solids
