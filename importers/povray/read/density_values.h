// SPDX-License-Identifier: Apache-2.0
// It has the values of a density_file: POV-Ray's DF3, a grid over the unit cube.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail::pov {

class DensityValues {
 public:
  // Values are linear between the corners of cells that repeat beyond the cube if `smooth`, as povray shows
  // them; else of the cell. Throws Error where the file is not read, or its size does not fit its head.
  DensityValues(const std::filesystem::path& file, bool smooth);

  // Returns 0 … 1; 0 outside of the cube.
  double at(Point3d p) const;

 private:
  double cell(std::size_t x, std::size_t y, std::size_t z) const {
    return static_cast<double>(values_[(z * count_[1] + y) * count_[0] + x]);
  }
  bool smooth_;
  std::array<std::size_t, 3> count_{};
  std::vector<float> values_;  // x fastest
};

}  // namespace vitrail::pov
