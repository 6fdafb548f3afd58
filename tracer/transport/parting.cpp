// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/parting.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

// How wide what a pixel sees about p is.
double pixel_width(const Tracing& tracing, const Traveller& t, Point3d p) {
  const Point3d seen = transform_point(bundle_to_camera(tracing, t), p);
  return tracing.scene.pixel.width + tracing.scene.pixel.angle_rad * length(seen - Point3d{});
}

}  // namespace

bool parts_aside(const Tracing& tracing, const Traveller& t, Point3d p, const SampledSpectrum& eta,
                 double thickness, double outside) {
  constexpr double visible = 1.0 / 8;
  const auto [least, most] = std::minmax_element(eta.v.begin(), eta.v.end());
  const double sine2 = 1 - outside * outside;
  const auto tangent = [&](float relative) {
    const double n = 1 / static_cast<double>(relative);
    return std::sqrt(sine2 / std::max(n * n - sine2, 1e-12));
  };
  const double aside = thickness * (tangent(*most) - tangent(*least)) * outside;
  const double width = pixel_width(tracing, t, p);
  return width > 0 && aside > visible * width;
}

}  // namespace vitrail
