// SPDX-License-Identifier: Apache-2.0
// These functions encode the pieces of a domain file. In a city 43 % of their vertices are the uncut
// triangle's own, which its cluster has already. Decoding gives every polygon as it was, bit by bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "bundle/domain_file.h"

namespace vitrail {

// A corner is one vertex of a polygon: that vertex of the uncut triangle (0 to 2), or the next of those that
// cuts made. The polygon ends with the corner that has last_corner added.
using PieceCorner = std::uint8_t;
inline constexpr PieceCorner next_cut_vertex = 3, last_corner = 4;

struct PieceCode {
  std::vector<std::uint32_t> triangles;
  std::vector<PieceCorner> corners;  // of one piece after the other
  std::vector<Point3d> cut_vertices;
};

PieceCode encode_pieces(std::span<const Cluster> clusters, std::span<const Piece> pieces,
                        std::span<const Point3d> piece_vertices);

// Throws Error where the input is not the code of any pieces of these clusters' triangles.
PieceList decode_pieces(std::span<const Cluster> clusters, std::span<const std::uint32_t> triangles,
                        std::span<const PieceCorner> corners, std::span<const Point3d> cut_vertices,
                        const std::filesystem::path& file);

}  // namespace vitrail
