// SPDX-License-Identifier: Apache-2.0
// It holds the way from the kd-tree's root to the cell of each domain.
#pragma once

#include <cstdint>
#include <vector>

#include "bundle/manifest.h"

namespace vitrail {

class CellWays {
 public:
  explicit CellWays(const Manifest& manifest);

  // Returns a leaf, or the first node of the cell that the domain shares with others.
  std::uint32_t cell_of(std::uint32_t domain) const { return cells_[domain].reference; }
  // They return the node above a domain's cell, and above a node; it is `none` above the root.
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t above_cell(std::uint32_t domain) const { return cells_[domain].above; }
  std::uint32_t above(std::uint32_t node) const { return above_[node]; }

 private:
  struct Cell {
    std::uint32_t reference, above;
  };
  std::vector<Cell> cells_;           // by domain
  std::vector<std::uint32_t> above_;  // by node
};

}  // namespace vitrail
