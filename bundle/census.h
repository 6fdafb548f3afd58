// SPDX-License-Identifier: Apache-2.0
// Counts what a bundle's domains really hold: that every triangle is there once and every cut one is tiled.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "bundle/domain_file.h"

namespace vitrail {

struct IdRange {
  std::uint64_t first = 0, count = 0;
};

// More than rounding.
inline constexpr double most_area_error = 1e-6;

struct CensusResult {
  std::uint64_t duplicates = 0;  // uncut triangles held more than once, cut ones twice by one domain
  std::uint64_t strays = 0;  // triangles of instances, and pieces whose triangle is not next in their order
  std::uint64_t lost = 0;    // triangles that no domain holds
  std::uint64_t cut_triangles = 0;  // that are held as pieces
  std::uint64_t pieces = 0;
  // Greatest |A − Σ area of its pieces| / max(A, 10⁻⁹Lm) of a cut triangle of area A, longest edge L and
  // greatest |coordinate| m, or L if that is more. Below 10⁻⁹Lm the rounding of cut vertices to double,
  // 10⁻¹⁶m each, begins to show.
  double area_error = 0;

  bool ghost_free() const { return duplicates + strays + lost == 0 && area_error < most_area_error; }
};

// Area of a planar polygon, from its vector area.
double polygon_area(std::span<const Point3d> polygon);

class Census {
 public:
  // For global ids [0, triangles), but for those of instances: `absent`, ascending and apart.
  explicit Census(std::uint64_t triangles, std::vector<IdRange> absent = {});

  // Adds one domain; from any thread.
  void add(std::uint32_t domain, const DomainView& view, std::span<const Piece> pieces,
           std::span<const Point3d> piece_vertices);

  // Of the cut triangles that came since the last call no more parts will come, but of these, ascending, and
  // those of higher domains alone: what is known of the others takes no more memory, and one line each of
  // these.
  void settle(std::span<const std::uint32_t> open);

  CensusResult result() const;

 private:
  struct CutPart {
    std::uint32_t triangle, domain;
    double triangle_area, least_area, area;  // the last: of several parts, where they are settled
  };
  static bool in_order(const CutPart& a, const CutPart& b);

  // Adds what the parts, of any order, say of their triangles.
  static void sum_up(std::vector<CutPart> parts, CensusResult& result);
  // Where an id is marked; none for one that no domain should hold.
  std::optional<std::uint64_t> place_of(std::uint32_t id) const;
  std::uint32_t mark(std::uint64_t place, std::uint32_t bits);

  std::vector<IdRange> absent_;
  std::vector<std::uint64_t> absent_before_;  // each of them
  std::uint64_t ids_, triangles_;             // without the absent
  // Sixteen triangles each; of a triangle bit 0: whole, bit 1: as a piece.
  std::unique_ptr<std::atomic<std::uint32_t>[]> seen_;
  std::atomic<std::uint64_t> duplicates_{0}, strays_{0};
  std::mutex mutex_;
  std::vector<CutPart> parts_;  // of what is not settled
  std::size_t open_ = 0;        // of them, the first are open after `settle`
  CensusResult settled_;        // what pieces add to the result
};

}  // namespace vitrail
