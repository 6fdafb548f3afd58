// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <unordered_map>

#include "importers/solids/grids.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

class Relief {
 public:
  explicit Relief(const HeightField& field)
      : field_(field),
        columns_(static_cast<std::size_t>(field.columns)),
        rows_(static_cast<std::size_t>(field.rows)) {}

  Solid top() {
    for (std::size_t k = 0; k < rows_; ++k)
      for (std::size_t i = 0; i < columns_; ++i)
        solid_.positions.push_back({along(i, columns_), height(i, k), along(k, rows_)});
    for (std::size_t k = 0; k + 1 < rows_; ++k)
      for (std::size_t i = 0; i + 1 < columns_; ++i) {
        const std::uint32_t a = number(i, k), b = number(i, k + 1), c = number(i + 1, k),
                            d = number(i + 1, k + 1);
        add({a, b, c});
        add({c, b, d});
      }
    solid_.closed = false;
    return std::move(solid_);
  }

 private:
  static double along(std::size_t i, std::size_t count) {
    return static_cast<double>(i) / static_cast<double>(count - 1);
  }
  std::uint32_t number(std::size_t i, std::size_t k) const {
    return static_cast<std::uint32_t>(k * columns_ + i);
  }

  // What is just at the water's level is put as much above it as keeps triangles from having no area.
  double height(std::size_t i, std::size_t k) const {
    const double h = field_.heights[k * columns_ + i], water = field_.water_level;
    return water > 0 && std::abs(h - water) < 1e-7 ? water + 1e-7 : h;
  }

  Vector3d smooth_normal(std::uint32_t vertex) const {
    const std::size_t i = vertex % columns_, k = vertex / columns_;
    const auto slope = [](double low, double high, std::size_t from, std::size_t to, std::size_t count) {
      return (high - low) / (along(to, count) - along(from, count));
    };
    const std::size_t west = i > 0 ? i - 1 : 0, east = std::min(i + 1, columns_ - 1);
    const std::size_t south = k > 0 ? k - 1 : 0, north = std::min(k + 1, rows_ - 1);
    return normalize(Vector3d{-slope(height(west, k), height(east, k), west, east, columns_), 1,
                              -slope(height(i, south), height(i, north), south, north, rows_)});
  }

  // The part that is not under water.
  void add(const std::array<std::uint32_t, 3>& t) {
    std::array<std::uint32_t, 4> polygon{};
    std::array<Vector3d, 4> normals{};
    std::size_t size = 0;
    const auto wet = [&](std::uint32_t v) { return solid_.positions[v].y < field_.water_level; };
    const auto normal = [&](std::uint32_t v) { return field_.smooth ? smooth_normal(v) : Vector3d{}; };
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (!wet(a)) {
        normals[size] = normal(a);
        polygon[size++] = a;
      }
      if (wet(a) != wet(b)) {
        const auto [shore, share] = shore_of(std::min(a, b), std::max(a, b));
        const Vector3d low = normal(std::min(a, b)), high = normal(std::max(a, b));
        normals[size] = normalize(low + (high - low) * share);
        polygon[size++] = shore;
      }
    }
    for (std::size_t i = 2; i < size; ++i) {
      const std::array part{polygon[0], polygon[i - 1], polygon[i]};
      std::array n{normals[0], normals[i - 1], normals[i]};
      if (!field_.smooth) {
        const Point3d a = solid_.positions[part[0]];
        n.fill(normalize(cross(solid_.positions[part[1]] - a, solid_.positions[part[2]] - a)));
      }
      solid_.triangles.push_back(part);
      solid_.normals.push_back(
          {cast<float>(to_normal(n[0])), cast<float>(to_normal(n[1])), cast<float>(to_normal(n[2]))});
      solid_.surfaces.push_back(0);
    }
  }

  // Where an edge goes under water, and how far from its first end.
  std::pair<std::uint32_t, double> shore_of(std::uint32_t a, std::uint32_t b) {
    const Point3d p = solid_.positions[a], q = solid_.positions[b];
    const double share = (field_.water_level - p.y) / (q.y - p.y);
    const auto [known, is_new] =
        shores_.try_emplace(std::uint64_t{a} << 32 | b, static_cast<std::uint32_t>(solid_.positions.size()));
    if (is_new) {
      Point3d at = p + (q - p) * share;
      at.y = field_.water_level;
      solid_.positions.push_back(at);
    }
    return {known->second, share};
  }

  const HeightField& field_;
  std::size_t columns_, rows_;
  std::unordered_map<std::uint64_t, std::uint32_t> shores_;
  Solid solid_;
};

// Adds the bottom and the sides.
void close_below(Solid& solid, double bottom) {
  const std::size_t triangles = solid.triangles.size();
  std::vector<std::uint32_t> below(solid.positions.size(), unseen);
  std::unordered_map<std::uint64_t, int> edges;
  const auto key = [](std::uint64_t a, std::uint64_t b) { return a << 32 | b; };
  for (const auto& t : solid.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges[key(t[i], t[(i + 1) % 3])] = 1;
  const auto down = [&](std::uint32_t v) {
    if (below[v] == unseen) {
      below[v] = static_cast<std::uint32_t>(solid.positions.size());
      solid.positions.push_back({solid.positions[v].x, bottom, solid.positions[v].z});
    }
    return below[v];
  };
  const auto add = [&](std::array<std::uint32_t, 3> t) {
    const Point3d a = solid.positions[t[0]];
    const Normal3f n =
        cast<float>(to_normal(normalize(cross(solid.positions[t[1]] - a, solid.positions[t[2]] - a))));
    solid.triangles.push_back(t);
    solid.normals.push_back({n, n, n});
    solid.surfaces.push_back(unseen);
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = solid.triangles[t];
    add({down(a), down(c), down(b)});
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
      if (edges.contains(key(to, from))) continue;
      add({from, down(from), down(to)});
      add({from, down(to), to});
    }
  }
  solid.closed = true;
}

}  // namespace

Solid height_field(const HeightField& field) {
  if (field.columns < 2 || field.rows < 2 ||
      field.heights.size() != static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows))
    throw Error("a height field has not two columns and two rows of heights");
  for (const double h : field.heights)
    if (!std::isfinite(h)) throw Error("a height is not finite");
  Solid made = Relief(field).top();
  // The bottom is a little deeper, so that what lies at the water's level has a thickness.
  if (field.closed && !made.empty()) close_below(made, field.water_level - 1e-3);
  return made;
}

}  // namespace vitrail::solids
