// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "importers/solids/outlines.h"
#include "importers/solids/region.h"
#include "importers/solids/sweeps.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

namespace {

// Where a letter begins, to the right of the pen; 0: it is empty.
double left_of(const Glyph& glyph) {
  double left = std::numeric_limits<double>::infinity();
  for (const auto& contour : glyph.contours)
    for (const Point2d& p : contour) left = std::min(left, p.x);
  return std::isfinite(left) ? left : 0;
}

}  // namespace

Solid text(const Text& text, const Tessellation& tessellation) {
  if (!std::isfinite(text.thickness) || text.thickness == 0) throw Error("a text has no finite thickness");
  const double low = std::min(0.0, text.thickness), high = std::max(0.0, text.thickness);
  Solid solid;
  const std::vector<Glyph> glyphs = outlines(text.font_file, text.utf8);
  Vector3d at;  // the first letter begins at 0, as POV-Ray has it (measured)
  if (!glyphs.empty()) at.x = -left_of(glyphs.front());
  for (const Glyph& glyph : glyphs) {
    std::vector<PlaneCurve> curves;
    for (const auto& contour :
         glyph.contours)  // of an em, so that large letters are no coarser than small ones
      for (PlaneCurve& curve : contours(SplineKind::bezier, contour, tessellation.deviation))
        curves.push_back(std::move(curve));
    const Region region = region_of(curves, FillRule::non_zero);
    if (!region.triangles.empty())
      append(solid, transformed(swept(region, low, 1, high, 1, 0), translate(at)));
    at = at + text.offset + Vector3d{glyph.advance, 0, 0};
  }
  return solid;
}

}  // namespace vitrail::solids
