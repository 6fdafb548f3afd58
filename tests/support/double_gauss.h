// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/records/camera.h"

namespace vitrail::test {

// A double Gauss of f/2, 22 degrees half field: A. W. Tronnier, US patent 2,673,491, as W. J. Smith, "Modern
// Lens Design", 1992, p. 312, has it; scaled to 50 mm. Radius, thickness, index, diameter in mm.
inline constexpr double double_gauss_mm[][4] = {
    {29.475, 3.76, 1.67, 25.2}, {84.83, 0.12, 1, 25.2},    {19.275, 4.025, 1.67, 23},
    {40.77, 3.275, 1.699, 23},  {12.75, 5.705, 1, 18},     {0, 4.5, 1, 17.1},
    {-14.495, 1.18, 1.603, 17}, {40.77, 6.065, 1.658, 20}, {-20.385, 0.19, 1, 20},
    {437.065, 3.22, 1.717, 20}, {-39.73, 0, 1, 20}};

inline std::vector<LensSurface> double_gauss() {
  std::vector<LensSurface> lens;
  for (const auto& [radius, thickness, index, diameter] : double_gauss_mm)
    lens.push_back({radius / 1000, thickness / 1000, index, diameter / 2000});
  return lens;
}

// As a file of pbrt's realistic camera.
inline std::string double_gauss_file() {
  std::string text = "# radius thickness index diameter\n";
  for (const auto& numbers : double_gauss_mm) {
    for (const double number : numbers) text += std::to_string(number) + " ";
    text += "\n";
  }
  return text;
}

}  // namespace vitrail::test
