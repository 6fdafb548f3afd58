// SPDX-License-Identifier: Apache-2.0
// How trees of sets are built and moved.
#include <cmath>

#include "importers/solids/csg.h"
#include "importers/solids/primitives.h"
#include "scene/geometry/frame.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

Csg of(Csg::Kind kind, std::vector<Csg> operands) {
  Csg csg;
  csg.kind = kind;
  csg.operands = std::move(operands);
  return csg;
}

Unbounded with_surface(Unbounded within, std::uint32_t surface) {
  return [within = std::move(within), surface](const Bounds3d& box) {
    Solid made = within(box);
    set_surface(made, surface);
    return made;
  };
}

// The box beyond a plane as far as it is needed: it reaches past what is asked for by factors without a
// simple ratio, so that its sides meet no side of other boxes.
Solid slab(const HalfSpace& half_space, const Bounds3d& within) {
  const double size = length(half_space.normal);
  const Vector3d normal = half_space.normal * (1 / size);
  const Frame frame(normal);
  const double half = length(extent(within)) / 2 + 1e-300;
  const Vector3d middle = center(within) - Point3d{};
  const double above = dot(normal, middle) - half_space.distance;
  if (above > half) return {};
  const double u = dot(frame.tangent, middle), v = dot(frame.bitangent, middle);
  const double top = above < -half ? dot(normal, middle) + half * 1.1723 : half_space.distance;
  Solid made = box({u - half * 1.1937, v - half * 1.2113, dot(normal, middle) - half * 1.1531},
                   {u + half * 1.2019, v + half * 1.1871, top});
  for (Point3d& p : made.positions) p = Point3d{} + frame.to_world(p - Point3d{});
  for (auto& triangle : made.normals)
    for (Normal3f& n : triangle) n = cast<float>(to_normal(frame.to_world(to_vector(cast<double>(n)))));
  constexpr std::size_t first_of_top = 10;  // of a box's triangles: the two at the greatest z
  for (std::size_t t = 0; t < made.surfaces.size(); ++t)
    if (t < first_of_top || above < -half) made.surfaces[t] = unseen;
  return made;
}

Bounds3d transformed_box(const Bounds3d& box, const Transform& to) {
  Bounds3d moved;
  for (int i = 0; i < 8; ++i)
    extend(moved, transform_point(to, {i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                                       i & 4 ? box.upper.z : box.lower.z}));
  return moved;
}

}  // namespace

Csg solid(Solid solid, std::uint32_t surface) {
  Csg csg = of(Csg::Kind::solid, {});
  csg.solid = std::move(solid);
  set_surface(csg.solid, surface);
  return csg;
}

Csg unbounded(Unbounded within, std::uint32_t surface) {
  Csg csg = of(Csg::Kind::unbounded, {});
  csg.within = with_surface(std::move(within), surface);
  return csg;
}

Csg half_space(const HalfSpace& half_space, std::uint32_t surface) {
  const double size = length(half_space.normal);
  if (!std::isfinite(size) || size == 0 || !std::isfinite(half_space.distance))
    throw Error("a plane has no finite normal or distance");
  return unbounded([half_space](const Bounds3d& box) { return slab(half_space, box); }, surface);
}

Csg unite(std::vector<Csg> operands) { return of(Csg::Kind::unite, std::move(operands)); }
Csg merge(std::vector<Csg> operands) { return of(Csg::Kind::merge, std::move(operands)); }
Csg intersection(std::vector<Csg> operands) { return of(Csg::Kind::intersect, std::move(operands)); }

Csg difference(std::vector<Csg> operands) {
  for (std::size_t i = 1; i < operands.size(); ++i) operands[i] = complement(std::move(operands[i]));
  return intersection(std::move(operands));
}

Csg complement(Csg operand) {
  std::vector<Csg> operands;
  operands.push_back(std::move(operand));
  return of(Csg::Kind::complement, std::move(operands));
}

Csg cut_surfaces(Csg object, std::vector<Csg> by) {
  by.insert(by.begin(), std::move(object));
  return of(Csg::Kind::cut_surfaces, std::move(by));
}

Csg transformed(Csg csg, const Transform& to) {
  if (csg.kind == Csg::Kind::solid) csg.solid = transformed(std::move(csg.solid), to);
  if (csg.kind == Csg::Kind::unbounded) {
    if (!is_invertible(to)) throw Error("the transform of a solid has no inverse");
    csg.within = [within = std::move(csg.within), to, back = inverse(to)](const Bounds3d& box) {
      return transformed(within(transformed_box(box, back)), to);
    };
  }
  if (csg.bounds) csg.bounds = transformed_box(*csg.bounds, to);
  for (Csg& operand : csg.operands) operand = transformed(std::move(operand), to);
  return csg;
}

void set_surface(Csg& csg, std::uint32_t surface) {
  if (csg.kind == Csg::Kind::solid) set_surface(csg.solid, surface);
  if (csg.kind == Csg::Kind::unbounded) csg.within = with_surface(std::move(csg.within), surface);
  for (Csg& operand : csg.operands) set_surface(operand, surface);
}

}  // namespace vitrail::solids
