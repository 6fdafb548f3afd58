// SPDX-License-Identifier: Apache-2.0
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <memory>

#include "importers/solids/boolean.h"
#include "importers/solids/operand_mesh.inl"

namespace vitrail::solids {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_exact_constructions_kernel::Point_3>;

}  // namespace

BooleanResult subtract_exactly(const Solid& a, std::span<const Solid> others) {
  std::vector<const Solid*> operands{&a};
  for (const Solid& other : others)
    if (boxes_meet(bounds_of(a), bounds_of(other))) operands.push_back(&other);
  const auto count = static_cast<std::uint32_t>(operands.size());
  auto left = operand_mesh<Mesh>(a, 0, count);
  for (std::uint32_t i = 1; i < count && left; ++i) {
    auto cut = operand_mesh<Mesh>(*operands[i], i, count);
    if (!cut) return {{}, "an operand's triangles do not form a manifold"};
    OperandMesh<Mesh> rest;
    std::map<const Mesh*, Origins<Mesh>> known{{&left->mesh, left->from}, {&cut->mesh, cut->from}};
    try {
      if (!pmp::corefine_and_compute_difference(
              left->mesh, cut->mesh, rest.mesh,
              CGAL::parameters::visitor(PassOrigins<Mesh>(known)).throw_on_self_intersection(true)))
        return {{}, "the result touches itself along an edge or at a vertex"};
    } catch (const std::exception& error) {
      return {{}, std::string("CGAL refuses: ") + error.what()};
    }
    rest.from = PassOrigins<Mesh>(known).origins_of(rest.mesh);
    left.emplace(std::move(rest));
  }
  if (!left) return {{}, "an operand's triangles do not form a manifold"};
  return {solid_of<Mesh>(left->mesh, left->from, operands, true, true), {}};
}

}  // namespace vitrail::solids
