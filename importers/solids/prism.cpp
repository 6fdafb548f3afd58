// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "importers/solids/region.h"
#include "importers/solids/sweeps.h"
#include "scene/system/diagnostics.h"

namespace vitrail::solids {

Solid prism(const Prism& prism, const Tessellation& tessellation) {
  const double low = std::min(prism.height1, prism.height2), high = std::max(prism.height1, prism.height2);
  if (!std::isfinite(low) || !std::isfinite(high) || low == high) throw Error("a prism has no finite height");
  // The tolerance is that of the larger end.
  const double larger = prism.conic ? std::max(std::abs(low), std::abs(high)) : 1;
  const double edge = std::max(greatest_edge(prism.points), (high - low) / larger);
  const std::vector<PlaneCurve> curves = contours(prism.spline, prism.points, tessellation.deviation * edge);
  const Region region = region_of(curves, FillRule::even_odd);
  const std::uint32_t cap = prism.open ? unseen : 0;
  Solid made;
  if (!prism.conic) {
    made = swept(region, low, 1, high, 1, cap);
  } else if (low < 0 && high > 0) {
    made = swept(region, low, low, 0, 0, cap);
    append(made, swept(region, 0, 0, high, high, cap));
  } else {
    made = swept(region, low, low, high, high, cap);
  }
  const Transform y_up{{{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}}};
  return transformed(std::move(made), y_up);
}

}  // namespace vitrail::solids
