// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/bodies.h"

#include <algorithm>
#include <numeric>

namespace vitrail::solids {

namespace {

// Of each vertex, the number of its part.
std::vector<std::uint32_t> parts(const Solid& solid, std::uint32_t& count) {
  std::vector<std::uint32_t> parent(solid.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : solid.triangles) {
    parent[root(b)] = root(a);
    parent[root(c)] = root(a);
  }
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> number(parent.size(), none), part(parent.size(), none);
  for (const auto& t : solid.triangles)
    for (const std::uint32_t v : t) {
      std::uint32_t& n = number[root(v)];
      if (n == none) n = count++;
      part[v] = n;
    }
  return part;
}

}  // namespace

std::vector<Solid> bodies_of(const Solid& solid) {
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> part = parts(solid, count);
  if (count == 0) return {};
  if (count == 1) return {solid};
  std::vector<Solid> bodies(count);
  std::vector<std::uint32_t> moved(part.size());
  for (std::size_t v = 0; v < part.size(); ++v) {
    if (part[v] >= count) continue;  // no triangle has it
    auto& positions = bodies[part[v]].positions;
    moved[v] = static_cast<std::uint32_t>(positions.size());
    positions.push_back(solid.positions[v]);
  }
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    Solid& body = bodies[part[a]];
    body.triangles.push_back({moved[a], moved[b], moved[c]});
    body.normals.push_back(solid.normals[t]);
    body.surfaces.push_back(solid.surfaces[t]);
  }
  std::vector<Bounds3d> bounds;
  for (Solid& body : bodies) {
    body.closed = solid.closed;
    if (!(volume(body) > 0)) return {solid};
    bounds.push_back(bounds_of(body));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (boxes_meet(bounds[i], bounds[k])) return bodies;
  return {solid};
}

std::vector<Solid> grouped(const std::vector<Solid>& bodies) {
  std::vector<Solid> groups;
  std::vector<std::vector<Bounds3d>> boxes;
  for (const Solid& body : bodies) {
    if (body.empty()) continue;
    const Bounds3d box = bounds_of(body);
    std::size_t g = 0;
    while (g < groups.size() &&
           std::ranges::any_of(boxes[g], [&](const Bounds3d& b) { return boxes_meet(b, box); }))
      ++g;
    if (g == groups.size()) {
      groups.emplace_back();
      boxes.emplace_back();
    }
    append(groups[g], body);
    boxes[g].push_back(box);
  }
  return groups;
}

}  // namespace vitrail::solids
