// SPDX-License-Identifier: Apache-2.0
// Seconds a million triangles of what is done to meshes, on one core:
//   bench_meshes FILE...          without files: a torus of 2·10⁵ triangles
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <fmt/format.h>

#include <ctime>
#include <functional>

#include "importers/import.h"
#include "importers/shapes/shapes.h"
#include "partitioner/meshes/decimate.h"
#include "partitioner/meshes/orient.h"
#include "partitioner/meshes/repair.h"
#include "partitioner/meshes/subdivide.h"
#include "scene/system/resource_usage.h"
#include "tests/support/test_scenes.h"

namespace vitrail {
namespace {

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(const char* what, std::size_t triangles, const std::function<std::size_t()>& work) {
  const double start = processor_s();
  const std::size_t result = work();
  const double seconds = processor_s() - start;
  fmt::print("  {:22} {:9.2f} s a million triangles, {} became {}; peak {} MB\n", what,
             seconds * 1e6 / static_cast<double>(triangles), triangles, result, peak_resident_bytes() >> 20);
}

std::size_t repair_by_cgal(const TriangleMesh& mesh) {
  std::vector<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const Point3f p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) polygons.push_back({a, b, c});
  CGAL::Polygon_mesh_processing::repair_polygon_soup(points, polygons);
  return polygons.size();
}

void measure_all(const TriangleMesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  const Subdivision loop = [](const TriangleMesh& cage, int levels, auto& corners) {
    return loop_subdivide(cage, levels, &corners);
  };
  measure("repair", n, [&] { return repair(mesh, false).mesh.triangles.size(); });
  measure("decimate 0.5", n, [&] { return decimate(mesh, 0.5).mesh.triangles.size(); });
  measure("decimate 0.1", n, [&] { return decimate(mesh, 0.1).mesh.triangles.size(); });
  measure("subdivide 1", n, [&] { return subdivide(mesh, 1, loop).mesh.triangles.size(); });
  measure("orient", n, [&] { return orient(mesh, Facing::outward).mesh.triangles.size(); });
  measure("CGAL's soup repair", n, [&] { return repair_by_cgal(mesh); });
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  if (argc == 1) measure_all(test::bumpy_torus(316));
  for (int i = 1; i < argc; ++i)
    for (const TriangleMesh& mesh : import_scene(argv[i]).scene.meshes) {
      fmt::print("{}\n", argv[i]);
      measure_all(mesh);
    }
}
