// SPDX-License-Identifier: Apache-2.0
// A plane curve makes these solids: prisms, lathes, surfaces of revolution, letters. Parameters are those of
// POV-Ray's documentation. Too few points and numbers that are not finite throw Error.
#pragma once

#include <string>

#include "importers/solids/solid.h"
#include "importers/solids/spline.h"

namespace vitrail::solids {

// It has contours in the xz plane, swept along y. A point is inside where an odd number of contours enclose
// it.
struct Prism {
  SplineKind spline = SplineKind::linear;
  bool conic = false;  // scaled by y: full size at y = 1, a point at y = 0
  double height1 = 0, height2 = 1;
  std::vector<Point2d> points;  // (x, z)
  bool open = false;            // caps are `unseen`
};
Solid prism(const Prism& prism, const Tessellation& tessellation = {});

// It is a curve of (radius, y), turned about the y axis. A curve whose ends are not on the axis is closed by
// `unseen` discs.
struct Lathe {
  SplineKind spline = SplineKind::linear;
  std::vector<Point2d> points;
};
Solid lathe(const Lathe& lathe, const Tessellation& tessellation = {});

// It has points (radius, y) with ascending y, the first and the last for slopes alone. Between them radius²
// is a cubic of y.
struct SurfaceOfRevolution {
  std::vector<Point2d> points;
  bool open = false;  // caps are `unseen`
};
Solid surface_of_revolution(const SurfaceOfRevolution& sor, const Tessellation& tessellation = {});

// It has letters from z = 0 to z = thickness, on the line y = 0, an em being 1 high. The first begins at x =
// 0, without the space that its font has before it. `offset` is added after each letter. Letters that the
// font has not are left out. Throws Error where the file is no font that FreeType reads.
struct Text {
  std::string font_file;
  std::string utf8;
  double thickness = 1;
  Vector3d offset;
};
Solid text(const Text& text, const Tessellation& tessellation = {});

}  // namespace vitrail::solids
