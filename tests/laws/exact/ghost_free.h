// SPDX-License-Identifier: Apache-2.0
// The second law: every triangle is stored once, and one that straddles an interface is cut into pieces that
// tile it and meet exactly.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail::test {

struct Side {
  int axis;
  double split;
  bool above;
};

struct Face {
  std::uint32_t triangle;
  std::vector<Point3d> polygon;
};

// What the files say of one domain, and the interfaces around it.
struct DomainGeometry {
  std::vector<Cluster> clusters;
  std::vector<Piece> pieces;
  std::vector<Point3d> piece_vertices;
  std::vector<Side> sides;

  // Pieces as they are and triangles without one.
  std::vector<Face> faces() const;
  // The uncut triangles of all lanes.
  std::vector<Face> parents() const;
};

struct BundleGeometry {
  Manifest manifest;
  std::vector<DomainGeometry> domains;
};

// Sets the domains' sides.
void find_sides(BundleGeometry& bundle);
BundleGeometry load_geometry(const std::filesystem::path& bundle);

// What is wrong, in words; at most a few of each kind.
class Problems {
 public:
  void add(const std::string& what);
  std::string text() const;

 private:
  std::map<std::string, int> count_;
  std::vector<std::string> words_;
};

// Vertices of the bundle are the same within this.
double tolerance(const BundleGeometry& bundle);

// Empty where the law is kept. The first leaves out what only says something of triangles that are not
// thinner than the tolerance: that edges cancel.
std::string problems_of_pieces(const BundleGeometry& bundle);
std::string problems_of(const BundleGeometry& bundle);

}  // namespace vitrail::test
