// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/soup_bundle.h"

#include <numeric>

#include "partitioner/cutting/kd_plan.h"
#include "partitioner/divide_cell.h"
#include "tests/support/test_scenes.h"

namespace vitrail::test {

namespace {

// Cuts the one cell at planes that are given.
void divide_at(std::span<const KdNode> planes, const NumberedTriangles& triangles, const DomainWriter& w) {
  std::ranges::copy(planes, w.manifest.kd_nodes.begin());
  std::vector<CellContent> cells(w.manifest.domains.size());
  route(triangles.triangles, 0, static_cast<std::uint32_t>(triangles.triangles.size()), {}, planes, cells);
  for (std::uint32_t i = 0; i < cells.size(); ++i)
    w.manifest.domains[i] = write_domain(w.manifest, triangles, cells[i], {}, w.store, i, w.census);
}

TriangleMesh mesh_of(std::span<const Triangle> triangles) {
  TriangleMesh mesh;
  for (const Triangle& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace

SoupBundle cut_in_memory(const Soup& soup, std::uint32_t domains) {
  SoupBundle bundle;
  Manifest& m = bundle.manifest;
  NumberedTriangles triangles{{soup.triangles, {}, {}, {}},
                              std::vector<std::uint32_t>(soup.triangles.size())};
  std::iota(triangles.ids.begin(), triangles.ids.end(), 0u);
  m.triangles = soup.triangles.size();
  for (const Triangle& t : soup.triangles)
    for (const Point3f& v : t) extend(m.bounds, v);
  m.scale = greatest_coordinate(soup.triangles);
  m.domains.resize(domains);
  m.kd_nodes.resize(domains - 1);
  bundle.contents.resize(domains);
  Census census(m.triangles);
  const InstanceDealer none({}, m.bounds);
  const WorkEstimate equal;
  SharedCells shared;
  const auto store = [&](std::uint32_t domain, DomainContent content, DomainInfo&) {
    bundle.contents[domain] = std::move(content);
  };
  const DomainWriter writer{.store = store,
                            .manifest = m,
                            .census = census,
                            .instances = none,
                            .shared = shared,
                            .work = equal,
                            .items = m.triangles,
                            .wrote = [](std::uint64_t) {}};
  if (soup.any_planes && domains > 1)
    divide_at(any_planes(soup, m.bounds), triangles, writer);
  else
    divide_cell(triangles, {}, {m.bounds, 0, 0, domains}, writer);
  const std::vector<std::uint32_t> kept = number_domains(m, {});
  for (std::uint32_t i = 0; i < kept.size(); ++i)
    if (kept[i] != i) bundle.contents[i] = std::move(bundle.contents[kept[i]]);
  bundle.contents.resize(kept.size());
  for (const DomainContent& content : bundle.contents) bundle.views.push_back(view_of(content));
  bundle.census = census.result();
  m.cut_triangles = bundle.census.cut_triangles;
  return bundle;
}

BundleGeometry geometry_of(const SoupBundle& bundle) {
  BundleGeometry geometry{bundle.manifest, {}};
  for (const DomainContent& c : bundle.contents)
    geometry.domains.push_back({c.clusters, c.pieces, c.piece_vertices, {}});
  find_sides(geometry);
  return geometry;
}

LoadedBundle::LoadedBundle(const std::filesystem::path& directory) : manifest(read_manifest(directory)) {
  for (std::uint32_t i = 0; i < manifest.domains.size(); ++i) {
    domains.push_back(load_domain(manifest, directory, i));
    views.push_back(domains.back()->view());
  }
}

Scene scene_of(const Soup& soup) { return scene_of(mesh_of(soup.triangles)); }

Scene scene_with_instances(const Soup& soup) {
  SoupRandom random(soup.seed ^ 0x1257a);
  const std::size_t parts = 1 + random.below(3);
  Scene scene = scene_of(TriangleMesh{});
  scene.shapes.clear();
  const auto shape_of = [&](std::size_t part) {
    const std::size_t n = soup.triangles.size(), begin = part * n / (parts + 1);
    scene.meshes.push_back(
        mesh_of(std::span(soup.triangles).subspan(begin, (part + 1) * n / (parts + 1) - begin)));
    return Shape{.mesh = {static_cast<std::uint32_t>(scene.meshes.size() - 1)}, .material = {0}};
  };
  const auto placed_at_random = [&] {
    const Vector3d reach = random.vector(soup.reach * random.log_uniform(0.01, 10)), axis = random.vector(1);
    Transform t = translate(reach);
    if (random.chance(0.7)) t = t * rotate(random.uniform(-180, 180), axis);
    const double size = random.log_uniform(1e-3, 100);
    if (random.chance(0.7)) t = t * scale({size, size * random.log_uniform(0.05, 20), -random.sign() * size});
    return t;
  };
  for (std::uint32_t i = 0; i < parts; ++i) {
    Prototype prototype;
    prototype.shapes.push_back(shape_of(i));
    for (std::size_t k = i > 0 ? random.below(3) : 0; k > 0; --k)
      prototype.instances.push_back(
          {Id<Prototype>{static_cast<std::uint32_t>(random.below(i))}, placed_at_random()});
    scene.prototypes.push_back(std::move(prototype));
    // Enough of them that references are less than copies.
    for (std::size_t k = 2 + random.below(6); k > 0; --k)
      scene.instances.push_back({Id<Prototype>{i}, placed_at_random()});
  }
  scene.shapes.push_back(shape_of(parts));
  return scene;
}

}  // namespace vitrail::test
