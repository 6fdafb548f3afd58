// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/shapes/curve.h"

namespace vitrail::mitsuba {

struct CurveFile {
  std::vector<CurvePoint> points;
  std::vector<std::size_t> ends;  // of each curve, in points
};

// Reads a file of Mitsuba 3: a line "x y z radius" a control point, an empty line between curves, each of at
// least so many points. Throws Error with its place.
CurveFile read_curve_file(const std::filesystem::path& path, std::size_t least);

// Reads a file of Mitsuba 0.6's hair, of one radius. As text it has a line "x y z" a point, an empty line or
// one that begins with # between hairs. As binary it has "BINARY_HAIR", the number of points (32 bits), x, y
// and z of each as floats, before the first of a hair a float more, which is infinite; little-endian. A point
// alone is no hair. Throws Error with its place.
CurveFile read_hair_file(const std::filesystem::path& path, double radius);

}  // namespace vitrail::mitsuba
