// SPDX-License-Identifier: Apache-2.0
// A GuideTable says where the search in a cumulative distribution begins, so that it takes about one step
// (Chen and Asau 1974).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vitrail {

// Its bins have bounds c₀ = 0 ≤ c₁ ≤ … ≤ cₙ = 1, n ≥ 1, which the caller keeps.
class GuideTable {
 public:
  GuideTable() = default;
  GuideTable(std::span<const double> cumulative, std::size_t cells)
      : first_(cells), cells_(static_cast<double>(cells)) {
    std::size_t bin = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      bin = search(cumulative, bin, static_cast<double>(cell) / cells_);
      first_[cell] = static_cast<std::uint32_t>(bin);
    }
  }

  // Returns the bin with cᵢ ≤ u < cᵢ₊₁, u in [0,1); the last one where there is none.
  std::size_t bin(std::span<const double> cumulative, double u) const {
    const auto cell = static_cast<std::int32_t>(u * cells_);  // int32: one instruction
    return search(cumulative, first_[static_cast<std::size_t>(cell)], u);
  }
  std::span<const std::uint32_t> first() const { return first_; }  // where the search begins, of each cell

 private:
  static std::size_t search(std::span<const double> cumulative, std::size_t bin, double u) {
    while (bin + 2 < cumulative.size() && cumulative[bin + 1] <= u) ++bin;
    return bin;
  }
  std::vector<std::uint32_t> first_;
  double cells_ = 0;
};

}  // namespace vitrail
