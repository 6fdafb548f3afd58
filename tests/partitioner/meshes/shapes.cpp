// SPDX-License-Identifier: Apache-2.0
#include "tests/partitioner/meshes/shapes.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <map>
#include <numbers>

namespace vitrail::test {

namespace {

using Key = std::array<float, 3>;

Key key(const TriangleMesh& mesh, std::uint32_t v) {
  const Point3f p = mesh.positions[v];
  return {p.x + 0.f, p.y + 0.f, p.z + 0.f};
}

}  // namespace

TriangleMesh sphere(int levels, double radius, Point3d center) {
  std::vector<Vector3d> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (is_new) points.push_back(normalize(points[a] + points[b]));
      return found->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = finer;
  }
  TriangleMesh mesh;
  mesh.triangles = triangles;
  for (const Vector3d& p : points) mesh.positions.push_back(cast<float>(center + p * radius));
  return mesh;
}

TriangleMesh torus(int n, int m, double radius, double tube, bool with_uvs) {
  TriangleMesh mesh;
  const int columns = with_uvs ? m + 1 : m, rows = with_uvs ? n + 1 : n;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < columns; ++k) {
      const double u = 2 * std::numbers::pi * (i % n) / n, v = 2 * std::numbers::pi * (k % m) / m;
      const double r = radius + tube * std::cos(v);
      mesh.positions.push_back(cast<float>(Point3d{r * std::cos(u), r * std::sin(u), tube * std::sin(v)}));
      if (with_uvs)
        mesh.uvs.push_back(
            {static_cast<float>(i) / static_cast<float>(n), static_cast<float>(k) / static_cast<float>(m)});
    }
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>((i % rows) * columns + k % columns);
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < m; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

TriangleMesh grid(int n, const std::function<double(double, double)>& z) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(k) / n;
      mesh.positions.push_back(cast<float>(Point3d{x, y, z(x, y)}));
    }
  const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * (n + 1) + k); };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

void turn_at_random(TriangleMesh& mesh, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (auto& t : mesh.triangles)
    if (random() & 1) std::swap(t[1], t[2]);
}

TriangleMesh turned(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh as_soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) {
      soup.positions.push_back(mesh.positions[v]);
      if (!mesh.normals.empty()) soup.normals.push_back(mesh.normals[v]);
      if (!mesh.uvs.empty()) soup.uvs.push_back(mesh.uvs[v]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

double volume6(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return cast<double>(mesh.positions[t[k]]) - Point3d{}; };
    sum += dot(at(0), cross(at(1), at(2)));
  }
  return sum;
}

std::array<std::size_t, 4> edges_by_triangles(const TriangleMesh& mesh) {
  std::map<std::pair<Key, Key>, std::size_t> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(key(mesh, t[k]), key(mesh, t[(k + 1) % 3]))];
  std::array<std::size_t, 4> counts{};
  for (const auto& [edge, triangles] : edges) ++counts[std::min<std::size_t>(triangles, 3)];
  return counts;
}

double greatest_distance(const TriangleMesh& from, const TriangleMesh& to) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  Triangles triangles;
  const auto point = [](Point3d p) { return Kernel::Point_3(p.x, p.y, p.z); };
  const auto at = [](const TriangleMesh& mesh, std::uint32_t v) { return cast<double>(mesh.positions[v]); };
  for (const auto& [a, b, c] : to.triangles)
    triangles.emplace_back(point(at(to, a)), point(at(to, b)), point(at(to, c)));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.begin(), triangles.end());
  double greatest = 0;
  for (const auto& [a, b, c] : from.triangles)
    for (int i = 0; i <= 3; ++i)
      for (int k = 0; i + k <= 3; ++k) {
        const Point3d p = at(from, a);
        const Point3d q = p + (at(from, b) - p) * (i / 3.) + (at(from, c) - p) * (k / 3.);
        greatest = std::max(greatest, tree.squared_distance(point(q)));
      }
  return std::sqrt(greatest);
}

}  // namespace vitrail::test
