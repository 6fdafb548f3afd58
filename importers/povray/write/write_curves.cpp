// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "importers/povray/write/write_meshes.h"
#include "importers/writing/text_sink.h"
#include "scene/shapes/curve_meshes.h"
#include "scene/shapes/curve_strands.h"

namespace vitrail::povray {

namespace {

// Balls along a strand, so many that the hulls of neighbours are as near to it as those that rays meet here.
std::vector<CurvePoint> balls_along(std::span<const CurveSegment> segments, bool straight, double widest) {
  constexpr int most_steps = 64;
  const int steps = straight ? 1 : steps_within(segments, widest / 8, most_steps);
  std::vector<CurvePoint> balls;
  for (const CurveSegment& s : segments)
    for (int k = balls.empty() ? 0 : 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps, u = 1 - t;
      const double w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
      CurvePoint ball{s[0].position, 0};
      for (std::size_t i = 0; i < 4; ++i) {
        ball.position = ball.position + (s[i].position - s[0].position) * w[i];
        ball.radius += s[i].radius * w[i];
      }
      ball.radius = std::max(ball.radius, 1e-4 * widest);  // POV-Ray has no cone to a point here
      if (balls.empty() || length(ball.position - balls.back().position) > 1e-6 * widest)
        balls.push_back(ball);
    }
  return balls;
}

}  // namespace

bool has_sweeps(const MeshText& text) {
  return is_curve(*text.mesh.quadric) && !text.with_uvs && is_similarity(text.to_pov);
}

bool put_sweeps(const MeshText& text, TextSink& out) {
  bool all_round = true;
  for_each_strand(*text.mesh.places, [&](std::span<const PlacedCurve> strand) {
    const PlacedCurve& first = strand.front();
    std::vector<CurveSegment> segments;
    double widest = 0;
    for (const PlacedCurve& c : strand) {
      segments.push_back(segment_of(transformed(text.to_pov, c)));
      for (const CurvePoint& p : segments.back()) widest = std::max(widest, p.radius);
    }
    if (!(widest > 0)) return;
    all_round = all_round && first.straight && first.to[0] == Vector3f{};
    const std::vector<CurvePoint> balls = balls_along(segments, first.straight, widest);
    if (balls.size() > 1)
      out.put(FMT_COMPILE("sphere_sweep {{ linear_spline {}"), balls.size());
    else
      out.put(FMT_COMPILE("sphere {{"));
    for (const CurvePoint& b : balls)
      out.put(FMT_COMPILE("{}<{:.9g},{:.9g},{:.9g}>,{:.7g}"), balls.size() == 1 ? " " : ", ", b.position.x,
              b.position.y, b.position.z, b.radius);
    const bool inside = (first.mirrored != swaps_handedness(text.to_pov)) != text.flip;
    out.put(FMT_COMPILE("{} }}\n"), inside ? " inverse" : "");
  });
  return all_round;
}

}  // namespace vitrail::povray
