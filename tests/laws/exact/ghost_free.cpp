// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/ghost_free.h"

#include <set>

#include "bundle/census.h"
#include "tests/laws/exact/clipping.h"
#include "tests/laws/exact/edge_chain.h"

namespace vitrail::test {

std::vector<Face> DomainGeometry::faces() const {
  std::vector<Face> result;
  std::set<std::uint32_t> cut;
  for (const Piece& p : pieces) {
    const auto first = piece_vertices.begin() + p.first_vertex;
    result.push_back({p.triangle, {first, first + p.vertex_count}});
    cut.insert(p.triangle);
  }
  for (const Face& f : parents())
    if (!cut.contains(f.triangle)) result.push_back(f);
  return result;
}

std::vector<Face> DomainGeometry::parents() const {
  std::vector<Face> result;
  for (const Cluster& c : clusters)
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      if (c.id[lane] == no_triangle) continue;
      Face& f = result.emplace_back(Face{c.id[lane], {}});
      for (const auto& v : c.vertex) f.polygon.push_back({v[0][lane], v[1][lane], v[2][lane]});
    }
  return result;
}

void Problems::add(const std::string& what) {
  if (++count_[what] == 1) words_.push_back(what);
}

std::string Problems::text() const {
  std::string all;
  for (const std::string& w : words_) all += w + " (" + std::to_string(count_.at(w)) + "×)\n";
  return all;
}

namespace {

void find_sides(const Manifest& m, std::uint32_t child, std::vector<Side> sides, BundleGeometry& bundle) {
  if (child & KdNode::leaf_bit) {
    bundle.domains[child & ~KdNode::leaf_bit].sides = sides;
    return;
  }
  const KdNode& node = m.kd_nodes[child];
  sides.push_back({static_cast<int>(node.axis), node.split, false});
  find_sides(m, node.below, sides, bundle);
  sides.back().above = true;
  find_sides(m, node.above, sides, bundle);
}

}  // namespace

void find_sides(BundleGeometry& bundle) {
  if (!bundle.manifest.kd_nodes.empty()) find_sides(bundle.manifest, 0, {}, bundle);
}

BundleGeometry load_geometry(const std::filesystem::path& path) {
  BundleGeometry bundle{read_manifest(path), {}};
  for (std::uint32_t i = 0; i < bundle.manifest.domains.size(); ++i) {
    const MappedDomain mapped(domain_path(path, i));
    check_domain(bundle.manifest, i, mapped, domain_path(path, i));
    const auto clusters = mapped.view().clusters;
    auto [pieces, piece_vertices] = mapped.pieces();
    bundle.domains.push_back(
        {{clusters.begin(), clusters.end()}, std::move(pieces), std::move(piece_vertices), {}});
  }
  find_sides(bundle);
  return bundle;
}

double tolerance(const BundleGeometry& b) { return 1e-12 * double{b.manifest.scale}; }

namespace {

void check_census(const BundleGeometry& b, Problems& problems) {
  Census census(b.manifest.triangles);
  for (std::uint32_t i = 0; i < b.domains.size(); ++i) {
    const DomainGeometry& d = b.domains[i];
    census.add(i, {{}, d.clusters, {}}, d.pieces, d.piece_vertices);
  }
  const CensusResult r = census.result();
  if (r.duplicates != 0) problems.add("a triangle is stored twice");
  if (r.strays != 0) problems.add("a piece has no triangle in its order");
  if (r.lost != 0) problems.add("a triangle is lost");
  if (!(r.area_error < 1e-6)) problems.add("pieces and triangle differ in area");
  if (r.cut_triangles != b.manifest.cut_triangles) problems.add("the manifest counts other cut triangles");
}

// Everything in a domain lies in its cell, faces between its interfaces exactly.
void check_cells(const BundleGeometry& b, Problems& problems) {
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.faces())
      for (const Point3d& p : f.polygon)
        for (const Side& s : d.sides)
          if (s.above ? p[s.axis] < s.split : p[s.axis] > s.split)
            problems.add("a vertex is outside its domain");
}

using Key = std::array<double, 3>;
Key key(Point3d p) { return {p.x, p.y, p.z}; }

// A vertex that a cut made has the same bits on both sides of it: no domain has one alone.
void check_cut_vertices(const BundleGeometry& b, Problems& problems) {
  std::map<std::uint32_t, std::map<Key, int>> domains_with;
  for (const DomainGeometry& d : b.domains)
    for (const Piece& p : d.pieces) {
      std::set<Key> own;
      for (std::uint32_t i = 0; i < p.vertex_count; ++i)
        own.insert(key(d.piece_vertices[p.first_vertex + i]));
      for (const Key& k : own) ++domains_with[p.triangle][k];
    }
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.parents())
      if (const auto at = domains_with.find(f.triangle); at != domains_with.end())
        for (const Point3d& p : f.polygon) at->second.erase(key(p));
  for (const auto& [triangle, vertices] : domains_with)
    for (const auto& [vertex, count] : vertices)
      if (count < 2) problems.add("a cut vertex differs on the two sides");
}

// The boundaries of a triangle's pieces add up to its own.
void check_tiling(const BundleGeometry& b, Problems& problems) {
  std::map<std::uint32_t, EdgeChain> sums;
  for (const DomainGeometry& d : b.domains)
    for (const Piece& p : d.pieces)
      sums[p.triangle].add_polygon(std::span(d.piece_vertices).subspan(p.first_vertex, p.vertex_count));
  std::set<std::uint32_t> subtracted;
  for (const DomainGeometry& d : b.domains)
    for (const Face& f : d.parents())
      if (sums.contains(f.triangle) && subtracted.insert(f.triangle).second)
        sums[f.triangle].add_polygon(f.polygon, -1);
  for (const auto& [triangle, sum] : sums)
    if (!sum.refined(tolerance(b)).edges().empty()) problems.add("pieces do not tile their triangle");
}

// The boundary of all domains together is the input's: nothing gapes between them.
void check_boundary(const BundleGeometry& b, Problems& problems) {
  EdgeChain sum;
  std::set<std::uint32_t> subtracted;
  for (const DomainGeometry& d : b.domains) {
    for (const Face& f : d.faces()) sum.add_polygon(f.polygon);
    for (const Face& f : d.parents())
      if (subtracted.insert(f.triangle).second) sum.add_polygon(f.polygon, -1);
  }
  if (!sum.refined(tolerance(b)).edges().empty()) problems.add("a boundary that the input does not have");
}

}  // namespace

std::string problems_of_pieces(const BundleGeometry& b) {
  Problems problems;
  check_census(b, problems);
  check_cells(b, problems);
  check_cut_vertices(b, problems);
  check_clipping(b, problems);
  return problems.text();
}

std::string problems_of(const BundleGeometry& b) {
  Problems problems;
  check_tiling(b, problems);
  check_boundary(b, problems);
  return problems_of_pieces(b) + problems.text();
}

}  // namespace vitrail::test
