// SPDX-License-Identifier: Apache-2.0
// This file counts what a bundle's domains really hold: that every triangle is there once and every cut one
// is tiled.
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

// A greater error than this is more than rounding.
inline constexpr double most_area_error = 1e-6;

struct CensusResult {
  std::uint64_t duplicates = 0;  // uncut triangles held more than once, cut ones twice by one domain
  std::uint64_t strays = 0;  // triangles of instances, and pieces whose triangle is not next in their order
  std::uint64_t lost = 0;    // triangles that no domain holds
  std::uint64_t cut_triangles = 0;  // that are held as pieces
  std::uint64_t pieces = 0;
  // It is the greatest |A − Σ area of its pieces| / max(A, 10⁻⁹Lm) of a cut triangle of area A and longest
  // edge L. m is its greatest |coordinate|, or L if that is more. Below 10⁻⁹Lm the rounding of cut vertices
  // to double, 10⁻¹⁶m each, begins to show.
  double area_error = 0;

  bool ghost_free() const { return duplicates + strays + lost == 0 && area_error < most_area_error; }
};

// Returns the area of a planar polygon, from its vector area.
double polygon_area(std::span<const Point3d> polygon);

class Census {
 public:
  // The census is for global ids [0, triangles) without those of instances, `absent`, which ascend and do not
  // overlap.
  explicit Census(std::uint64_t triangles, std::vector<IdRange> absent = {});

  // Adds one domain; any thread may call it.
  void add(std::uint32_t domain, const DomainView& view, std::span<const Piece> pieces,
           std::span<const Point3d> piece_vertices);

  // Says that no more parts will come of the cut triangles so far, but of those that are `open`, ascending,
  // and only in higher domains. Triangles that are settled take no more memory, and each open one takes one
  // entry.
  void settle(std::span<const std::uint32_t> open);

  CensusResult result() const;

 private:
  struct CutPart {
    std::uint32_t triangle, domain;
    double triangle_area, least_area, area;  // the last: of several parts, where they are settled
  };
  static bool in_order(const CutPart& a, const CutPart& b);

  // Adds what the parts, in any order, say of their triangles.
  static void sum_up(std::vector<CutPart> parts, CensusResult& result);
  // Returns the place where an id is marked; none for an id that no domain should hold.
  std::optional<std::uint64_t> place_of(std::uint32_t id) const;
  std::uint32_t mark(std::uint64_t place, std::uint32_t bits);

  std::vector<IdRange> absent_;
  std::vector<std::uint64_t> absent_before_;  // each of them
  std::uint64_t ids_, triangles_;             // without the absent
  // Each word has sixteen triangles, of two bits each. Bit 0: it is held whole; bit 1: it is held as a piece.
  std::unique_ptr<std::atomic<std::uint32_t>[]> seen_;
  std::atomic<std::uint64_t> duplicates_{0}, strays_{0};
  std::mutex mutex_;
  std::vector<CutPart> parts_;  // of what is not settled
  std::size_t open_ = 0;        // of them, the first are open after `settle`
  CensusResult settled_;        // what pieces add to the result
};

}  // namespace vitrail
