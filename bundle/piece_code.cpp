// SPDX-License-Identifier: Apache-2.0
#include "bundle/piece_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "bundle/domain_structure.h"

namespace vitrail {

namespace {

using UncutTriangle = std::array<Point3d, 3>;

// Of triangles in the order of the lanes; of fewer where one is not there, or not in this order.
std::vector<UncutTriangle> uncut(std::span<const Cluster> clusters,
                                 std::span<const std::uint32_t> triangles) {
  std::vector<UncutTriangle> found;
  found.reserve(triangles.size());
  for (const Cluster& c : clusters)
    for (std::size_t lane = 0; lane < cluster_width; ++lane) {
      if (found.size() == triangles.size()) return found;
      if (c.id[lane] != no_triangle && c.id[lane] == triangles[found.size()])
        found.push_back(triangle_in(c, lane));
    }
  return found;
}

bool same_bits(Point3d a, Point3d b) {
  using Bits = std::array<std::uint64_t, 3>;
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

}  // namespace

PieceCode encode_pieces(std::span<const Cluster> clusters, std::span<const Piece> pieces,
                        std::span<const Point3d> piece_vertices) {
  PieceCode code;
  for (const Piece& p : pieces) code.triangles.push_back(p.triangle);
  const std::vector<UncutTriangle> triangles = uncut(clusters, code.triangles);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Point3d& p : piece_vertices.subspan(pieces[i].first_vertex, pieces[i].vertex_count)) {
      PieceCorner corner = i < triangles.size() ? 0 : next_cut_vertex;
      while (corner < next_cut_vertex && !same_bits(p, triangles[i][corner])) ++corner;
      code.corners.push_back(corner);
      if (corner == next_cut_vertex) code.cut_vertices.push_back(p);
    }
    code.corners.back() |= last_corner;
  }
  return code;
}

PieceList decode_pieces(std::span<const Cluster> clusters, std::span<const std::uint32_t> triangles,
                        std::span<const PieceCorner> corners, std::span<const Point3d> cut_vertices,
                        const std::filesystem::path& file) {
  const std::vector<UncutTriangle> parents = uncut(clusters, triangles);
  if (parents.size() < triangles.size())
    reject_domain(file, fmt::format("it has a piece of triangle {}, which is not there or not in this order",
                                    triangles[parents.size()]));
  const auto corners_with = [&](unsigned bits, unsigned value) {
    return static_cast<std::size_t>(
        std::ranges::count_if(corners, [&](PieceCorner c) { return (c & bits) == value; }));
  };
  if (corners_with(~(last_corner | 3u), 0) != corners.size() ||
      corners_with(3, next_cut_vertex) != cut_vertices.size() ||
      corners_with(last_corner, last_corner) != triangles.size() ||
      (!corners.empty() && !(corners.back() & last_corner)))
    reject_domain(file, "the corners of its pieces are wrong");
  PieceList list;
  list.pieces.reserve(triangles.size());
  list.vertices.reserve(corners.size());
  std::uint32_t first = 0;
  auto cut_vertex = cut_vertices.begin();
  for (const PieceCorner corner : corners) {
    const std::size_t i = list.pieces.size(), vertex = corner & 3;
    list.vertices.push_back(vertex == next_cut_vertex ? *cut_vertex++ : parents[i][vertex]);
    if (!(corner & last_corner)) continue;
    const auto end = static_cast<std::uint32_t>(list.vertices.size());
    if (end - first < 3)
      reject_domain(file, fmt::format("a piece of triangle {} is no polygon", triangles[i]));
    list.pieces.push_back({triangles[i], first, end - first});
    first = end;
  }
  return list;
}

}  // namespace vitrail
