// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/records/image.h"

namespace vitrail {

// A ComparisonPage holds what a page shows. Both images are linear sRGB of the same size.
struct ComparisonPage {
  std::string image_name, reference_name;
  const Image* image = nullptr;
  const Image* reference = nullptr;
  int x0 = 0, y0 = 0;  // of the first pixel in the whole picture
  double pixels_per_degree = 0;
  double neighbours_of_mean = 1;  // film/neighbours.h
  bool low_range = false;         // FLIP is that of images for screens
};

// Returns one HTML file that a browser shows without a network. It shows both images and the maps
// of their errors, flipped between or split, at any exposure and size. Beside them are the values
// of the pixel under the pointer, histograms and all metrics. Pixels are kept as half floats, of
// 11 bits, in units of the greatest.
std::string comparison_page(const ComparisonPage& page);

}  // namespace vitrail
