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
#include <map>

#include "scene/geometry/frame.h"

namespace vitrail::solids {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Face = Mesh::Face_index;

// Where a triangle came from: `2 · triangle + operand` of the two. 0xffffffff: from nowhere.
using Origins = Mesh::Property_map<Face, std::uint32_t>;
constexpr const char* origins = "f:origin";

struct OperandMesh {
  Mesh mesh;
  Origins from;
};

// Nothing where the triangles are no manifold even if vertices are doubled.
std::optional<OperandMesh> operand_mesh(const Solid& solid, std::uint32_t operand) {
  std::vector<Kernel::Point_3> points;
  points.reserve(solid.positions.size());
  for (const Point3d& p : solid.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> faces;
  faces.reserve(solid.triangles.size());
  for (const auto& [a, b, c] : solid.triangles) faces.push_back({a, b, c});
  if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) {
    pmp::orient_polygon_soup(points, faces);
    if (!pmp::is_polygon_soup_a_polygon_mesh(faces)) return std::nullopt;
  }
  OperandMesh made;
  pmp::polygon_soup_to_polygon_mesh(points, faces, made.mesh);
  made.from = made.mesh.add_property_map<Face, std::uint32_t>(origins, 0xffffffff).first;
  std::uint32_t triangle = 0;
  for (const Face f : made.mesh.faces()) made.from[f] = 2 * triangle++ + operand;
  return made;
}

// Without the triangles of no area that the rounding of earlier cuts leaves. Faces that fill their places
// come from where a neighbour does.
void clean(OperandMesh& operand) {
  Mesh& mesh = operand.mesh;
  pmp::remove_degenerate_faces(mesh);
  constexpr std::uint32_t nowhere = 0xffffffff;
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

// Passes origins on to the parts and copies of faces.
struct PassOrigins : pmp::Corefinement::Default_visitor<Mesh> {
  std::map<const Mesh*, Origins>* of;
  std::uint32_t split = 0xffffffff;

  explicit PassOrigins(std::map<const Mesh*, Origins>& known) : of(&known) {}
  Origins& origins_of(Mesh& mesh) {
    const auto known = of->find(&mesh);
    if (known != of->end()) return known->second;
    return of->emplace(&mesh, mesh.add_property_map<Face, std::uint32_t>(origins, 0xffffffff).first)
        .first->second;
  }
  void before_subface_creations(Face face, Mesh& mesh) { split = origins_of(mesh)[face]; }
  void after_subface_created(Face face, Mesh& mesh) { origins_of(mesh)[face] = split; }
  void after_face_copy(Face from, Mesh& source, Face to, Mesh& target) {
    const std::uint32_t origin = origins_of(source)[from];
    origins_of(target)[to] = origin;
  }
};

Vector3d to_vector3(const Normal3f& n) { return to_vector(cast<double>(n)); }

// The normals of `from` at a point in its triangle: barycentric on the greatest projection.
Normal3f normal_at(const Solid& from, std::size_t triangle, Point3d p, bool turned) {
  const auto [a, b, c] = from.triangles[triangle];
  const Point3d origin = from.positions[a];
  const Vector3d e1 = from.positions[b] - origin, e2 = from.positions[c] - origin, d = p - origin;
  const Vector3d n = cross(e1, e2);
  const double area = dot(n, n);
  double v = area > 0 ? dot(cross(d, e2), n) / area : 0, w = area > 0 ? dot(cross(e1, d), n) / area : 0;
  v = std::clamp(v, 0.0, 1.0);
  w = std::clamp(w, 0.0, 1.0 - v);
  const auto& [na, nb, nc] = from.normals[triangle];
  // A corner keeps its normal bit for bit, so that neighbours go on sharing it.
  if (v == 0 && w == 0) return turned ? Normal3f{-na.x, -na.y, -na.z} : na;
  const Vector3d sum = to_vector3(na) * (1 - v - w) + to_vector3(nb) * v + to_vector3(nc) * w;
  return cast<float>(to_normal(normalize(turned ? -sum : sum)));
}

Normal3f corner_normal(const Solid& from, std::size_t triangle, Point3d p, bool turned) {
  for (std::size_t i = 0; i < 3; ++i)
    if (from.positions[from.triangles[triangle][i]] == p) {
      const Normal3f n = from.normals[triangle][i];
      return turned ? Normal3f{-n.x, -n.y, -n.z} : n;
    }
  return normal_at(from, triangle, p, turned);
}

Solid solid_of(const Mesh& mesh, const Origins& from, const std::array<const Solid*, 2>& operands,
               bool turn_second, bool closed) {
  Solid solid;
  solid.closed = closed;
  std::vector<std::uint32_t> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<std::uint32_t>(solid.positions.size());
    const auto& p = mesh.point(v);
    solid.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const Face f : mesh.faces()) {
    std::array<std::uint32_t, 3> t{};
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = number[v];
    const std::uint32_t origin = from[f];
    const bool second = origin & 1;
    const Solid& operand = *operands[second];
    const std::size_t triangle = origin / 2;
    if (triangle >= operand.triangles.size()) continue;  // cannot be: CGAL reports each face
    std::array<Normal3f, 3> normals;
    for (i = 0; i < 3; ++i)
      normals[i] = corner_normal(operand, triangle, solid.positions[t[i]], second && turn_second);
    solid.triangles.push_back(t);
    solid.normals.push_back(normals);
    solid.surfaces.push_back(operand.surfaces[triangle]);
  }
  return solid;
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
  auto first = operand_mesh(a, 0), second = operand_mesh(b, 1);
  if (!first || !second) return {{}, not_manifold};
  Mesh out;
  std::map<const Mesh*, Origins> known{{&first->mesh, first->from}, {&second->mesh, second->from}};
  try {
    if (cleaned) clean(*first), clean(*second);
    const Mesh* result = compute(first->mesh, second->mesh, out, PassOrigins(known));
    if (!result) return {{}, touches_itself};
    if (result->number_of_faces() == 0) return {Solid{}, {}};
    return {solid_of(*result, known.at(result), {&a, &b}, turn_second, closed), {}};
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
  const auto compute = [operation](Mesh& first, Mesh& second, Mesh& out, const PassOrigins& visitor) {
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
  const auto compute = [](Mesh& first, Mesh& second, Mesh&, const PassOrigins& visitor) {
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
