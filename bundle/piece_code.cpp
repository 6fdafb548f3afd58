// SPDX-License-Identifier: Apache-2.0
#include "bundle/piece_code.h"

#include <fmt/format.h>

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
  PieceList list;
  list.pieces.reserve(triangles.size());
  list.vertices.reserve(corners.size());
  std::uint32_t first = 0;
  auto next_cut = cut_vertices.begin();
  for (const PieceCorner code : corners) {
    const PieceCorner corner = code & ~last_corner;
    const std::size_t i = list.pieces.size();
    if (corner > next_cut_vertex || i == triangles.size() ||
        (corner == next_cut_vertex && next_cut == cut_vertices.end()))
      reject_domain(file, "the corners of its pieces are wrong");
    list.vertices.push_back(corner == next_cut_vertex ? *next_cut++ : parents[i][corner]);
    if (!(code & last_corner)) continue;
    const auto end = static_cast<std::uint32_t>(list.vertices.size());
    if (end - first < 3)
      reject_domain(file, fmt::format("a piece of triangle {} is no polygon", triangles[i]));
    list.pieces.push_back({triangles[i], first, end - first});
    first = end;
  }
  if (list.pieces.size() < triangles.size() || next_cut != cut_vertices.end())
    reject_domain(file, "its pieces do not end where they should");
  return list;
}

}  // namespace vitrail
