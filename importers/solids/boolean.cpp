// SPDX-License-Identifier: Apache-2.0
#include "importers/solids/boolean.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

#include "importers/solids/operand_mesh.inl"
#include "scene/geometry/frame.h"

namespace vitrail::solids {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

// Without the triangles of no area that the rounding of earlier cuts leaves. Faces that fill their places
// come from where a neighbour does.
void clean(OperandMesh<Mesh>& operand) {
  Mesh& mesh = operand.mesh;
  pmp::remove_degenerate_faces(mesh);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face f : mesh.faces()) {
      if (operand.from[f] != nowhere) continue;
      for (const auto edge : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const Face other = mesh.face(mesh.opposite(edge));
        if (other == Mesh::null_face() || operand.from[other] == nowhere) continue;
        operand.from[f] = operand.from[other];
        changed = true;
        break;
      }
    }
  }
}

// Larger, and away along a direction without a simple ratio, so that what touched no longer does.
Solid moved(Solid solid, double by) {
  const Bounds3d bounds = bounds_of(solid);
  const Point3d middle = center(bounds);
  const Vector3d size = extent(bounds);
  const double greatest = std::max({size.x, size.y, size.z});
  const Vector3d shift = Vector3d{0.5421, 0.3307, 0.7725} * (by * greatest * 0.3);
  for (Point3d& p : solid.positions) p = middle + (p - middle) * (1 + by) + shift;
  return solid;
}

constexpr const char* not_manifold = "an operand's triangles do not form a manifold";
constexpr const char* touches_itself = "the result touches itself along an edge or at a vertex";
constexpr const char* intersects_itself = "an operand intersects itself";

// Carries out `compute(mesh a, mesh b, output, visitor)`, which says whether there is a result.
template <class Compute>
BooleanResult attempt_once(const Solid& a, const Solid& b, bool turn_second, bool closed, bool cleaned,
                           Compute&& compute) {
  auto first = operand_mesh<Mesh>(a, 0, 2), second = operand_mesh<Mesh>(b, 1, 2);
  if (!first || !second) return {{}, not_manifold};
  Mesh out;
  std::map<const Mesh*, Origins<Mesh>> known{{&first->mesh, first->from}, {&second->mesh, second->from}};
  try {
    if (cleaned) clean(*first), clean(*second);
    const Mesh* result = compute(first->mesh, second->mesh, out, PassOrigins<Mesh>(known));
    if (!result) return {{}, touches_itself};
    if (result->number_of_faces() == 0) return {Solid{}, {}};
    return {solid_of<Mesh>(*result, known.at(result), std::array{&a, &b}, turn_second, closed), {}};
  } catch (const pmp::Corefinement::Self_intersection_exception&) {
    return {{}, intersects_itself};
  } catch (const std::exception& error) {
    return {{}, std::string("CGAL refuses: ") + error.what()};
  }
}

template <class Compute>
BooleanResult attempt(const Solid& a, const Solid& b, bool turn_second, bool closed, Compute&& compute) {
  BooleanResult result = attempt_once(a, b, turn_second, closed, false, compute);
  if (result.reason == intersects_itself) result = attempt_once(a, b, turn_second, closed, true, compute);
  return result;
}

// Without and then with a tiny shift of the second operand.
template <class Once>
BooleanResult with_shifts(const Solid& b, Once&& once) {
  BooleanResult result = once(b);
  if (result.solid || result.reason == not_manifold) return result;
  for (const double by : {1e-6, 1e-5, -1e-5}) {
    BooleanResult again = once(moved(b, by));
    again.moved = std::abs(by);
    if (again.solid) return again;
  }
  return result;
}

// Whether `inner` keeps to `outer`, but for a rounding.
bool lies_in(const Bounds3d& inner, const Bounds3d& outer) {
  const double margin = 1e-4 * length(extent(outer));
  for (int axis = 0; axis < 3; ++axis)
    if (inner.lower[axis] < outer.lower[axis] - margin || inner.upper[axis] > outer.upper[axis] + margin)
      return false;
  return true;
}

// An operand whose front is inside counts as all the rest: its intersection would be nearly all of the other.
bool is_possible(Operation operation, const Solid& a, const Solid& b, const Solid& result) {
  if (result.empty() || operation == Operation::unite) return true;
  const Bounds3d made = bounds_of(result);
  return lies_in(made, bounds_of(a)) && (operation == Operation::subtract || lies_in(made, bounds_of(b)));
}

}  // namespace

BooleanResult boolean(Operation operation, const Solid& a, const Solid& b) {
  if (!boxes_meet(bounds_of(a), bounds_of(b))) {
    if (operation == Operation::intersect) return {Solid{}, {}};
    BooleanResult apart{a, {}};
    if (operation == Operation::unite) append(*apart.solid, b);
    return apart;
  }
  const auto compute = [operation](Mesh& first, Mesh& second, Mesh& out, const PassOrigins<Mesh>& visitor) {
    const auto how = CGAL::parameters::visitor(visitor).throw_on_self_intersection(true);
    bool done = false;
    if (operation == Operation::unite) done = pmp::corefine_and_compute_union(first, second, out, how);
    if (operation == Operation::intersect)
      done = pmp::corefine_and_compute_intersection(first, second, out, how);
    if (operation == Operation::subtract)
      done = pmp::corefine_and_compute_difference(first, second, out, how);
    return done ? &out : nullptr;
  };
  BooleanResult made = with_shifts(b, [&](const Solid& second) {
    return attempt(a, second, operation == Operation::subtract, true, compute);
  });
  if (made.solid && !is_possible(operation, a, b, *made.solid)) return {{}, intersects_itself};
  return made;
}

BooleanResult cut_surface(const Solid& surface, const Solid& by, bool keep_inside) {
  if (!boxes_meet(bounds_of(surface), bounds_of(by))) {
    if (keep_inside) return {Solid{}, {}};
    BooleanResult apart{surface, {}};
    apart.solid->closed = false;
    return apart;
  }
  const auto compute = [](Mesh& first, Mesh& second, Mesh&, const PassOrigins<Mesh>& visitor) {
    const bool done =
        pmp::clip(first, second,
                  CGAL::parameters::visitor(visitor).throw_on_self_intersection(true).clip_volume(false));
    return done ? &first : nullptr;
  };
  const Solid knife = keep_inside ? by : inverted(by);
  return with_shifts(knife,
                     [&](const Solid& second) { return attempt(surface, second, false, false, compute); });
}

}  // namespace vitrail::solids
