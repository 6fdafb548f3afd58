// SPDX-License-Identifier: Apache-2.0
// How a domain file keeps its pieces: 43 % of their vertices in a city are the uncut triangle's own, which
// its cluster has already. Decoding gives every polygon as it was, bit by bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "bundle/domain_file.h"

namespace vitrail {

// One vertex of a polygon, that vertex of the uncut triangle (0 to 2) or the next of those that cuts made;
// with last_corner the polygon ends.
using PieceCorner = std::uint8_t;
inline constexpr PieceCorner next_cut_vertex = 3, last_corner = 4;

struct PieceCode {
  std::vector<std::uint32_t> triangles;
  std::vector<PieceCorner> corners;  // of one piece after the other
  std::vector<Point3d> cut_vertices;
};

PieceCode encode_pieces(std::span<const Cluster> clusters, std::span<const Piece> pieces,
                        std::span<const Point3d> piece_vertices);

// Throws Error where it is not the code of any pieces of these clusters' triangles.
PieceList decode_pieces(std::span<const Cluster> clusters, std::span<const std::uint32_t> triangles,
                        std::span<const PieceCorner> corners, std::span<const Point3d> cut_vertices,
                        const std::filesystem::path& file);

}  // namespace vitrail
