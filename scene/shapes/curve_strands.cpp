// SPDX-License-Identifier: Apache-2.0
#include "scene/shapes/curve_strands.h"

namespace vitrail {

namespace {

Point3d end_of(const PlacedCurve& c) { return c.origin + cast<double>(c.to[2]); }

bool follows(const PlacedCurve& next, const PlacedCurve& last) {
  const double gap = length(end_of(last) - next.origin), size = length(cast<double>(last.to[2]));
  return next.along_first == last.along_last && next.straight == last.straight &&
         next.mirrored == last.mirrored && gap <= 1e-5 * size;
}

}  // namespace

void for_each_strand(const QuadricPlaces& curves,
                     const std::function<void(std::span<const PlacedCurve>)>& use) {
  std::vector<PlacedCurve> strand;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    Transform place;
    curves.read(i, {&place, 1});
    const PlacedCurve next = unpacked_curve(place);
    if (!strand.empty() && !follows(next, strand.back())) {
      use(strand);
      strand.clear();
    }
    strand.push_back(next);
  }
  if (!strand.empty()) use(strand);
}

}  // namespace vitrail
