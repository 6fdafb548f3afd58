// SPDX-License-Identifier: Apache-2.0
// ImageValues has the colours of an image_map at points.
#pragma once

#include <memory>
#include <optional>

#include "importers/povray/read/surface.h"
#include "scene/records/image.h"

namespace vitrail::pov {

// Returns whether the numbers of its file are the scene's as they are: before 3.7, and for files that state
// nothing (PPM, PGM, TIFF), where no gamma stands with it. Measured with povray 3.7.0.10.
bool keeps_numbers(const Reader& reader, const ImageMap& map);

// It is an image with its place: the unit square of x and y, or around a sphere, cylinder or torus.
class ImageValues {
 public:
  // Throws Error at `place` where the file is not read.
  ImageValues(Reader& reader, const ImageMap& map, const Place& place);

  // Returns numbers of the scene; clear beyond an image that is there once.
  Numbers color(Point3d p) const;
  // Returns the grey of the numbers as the file has them: image_pattern.
  double grey(Point3d p) const;
  int width() const { return image_.width; }
  int height() const { return image_.height; }

 private:
  std::optional<Point2d> square_of(Point3d p) const;
  Numbers looked_up(Point2d at, bool as_light) const;
  Numbers decoded(Numbers c) const;
  Numbers pixel(int column, int row) const;

  ImageMap map_;
  Image image_;
  bool decoded_ = false;         // the file's numbers are of the screen, and the scene's linear
  std::optional<double> gamma_;  // of the scene
};

}  // namespace vitrail::pov
