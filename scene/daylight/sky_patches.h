// SPDX-License-Identifier: Apache-2.0
// This file divides the sky into patches, over which daylight coefficients are kept.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/geometry/vec.h"

namespace vitrail {

// These are the 145 patches of Tregenza ("Subdivision of the sky hemisphere for luminance measurements",
// Lighting Research and Technology 19, 1987), each cut into MF × MF as Reinhart has it, and the ground as one
// more. Their numbers are those of Radiance's gendaymtx -m MF: 0 is the ground, then rows from the horizon
// up, in each from north to east. All rows are equally high; the zenith is a cap half as high.
//
// Directions are unit: +x is east, +y north, +z up.
class SkyPatches {
 public:
  // It requires `mf` ≥ 1.
  explicit SkyPatches(int mf);

  int mf() const { return mf_; }
  // Returns the number of patches, with the ground.
  std::size_t count() const { return count_; }
  // Returns the number of the patch that a direction lies in; 0 below the horizon.
  std::size_t patch_of(Vector3d direction) const;
  // Returns the patch's solid angle, sr.
  double solid_angle(std::size_t patch) const;
  // Maps u, v in [0,1) to a direction of the patch, uniform over its solid angle.
  Vector3d direction(std::size_t patch, double u, double v) const;

 private:
  struct Row {
    double low = 0, high = 1;  // sines of the elevation
    std::size_t first = 0, patches = 1;
  };
  const Row& row_of(std::size_t patch) const;

  int mf_;
  std::vector<Row> rows_;  // from the horizon up
  std::size_t count_ = 1;
};

}  // namespace vitrail
