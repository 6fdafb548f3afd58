// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "film/footprint.h"
#include "film/neighbours.h"
#include "scene/geometry/vec.h"
#include "scene/records/film_settings.h"
#include "tracer/sampling/guide_table.h"

namespace vitrail {

struct FilterSample {
  Point2d offset;     // from the pixel's centre, in pixels
  double weight = 1;  // of what the sample deposits: f/pdf, its mean is 1
};

// It samples by a separable reconstruction filter f, so that a sample lands in one pixel (Ernst, Stamminger &
// Greiner 2006). Offsets are distributed as |f|, with weight ∫|f|/∫f, negative in f's negative lobes; it is 1
// where f has none. Offsets of samples that splat are even over the pixel, and the filter is in their
// footprint.
class FilterSampler {
 public:
  explicit FilterSampler(const Filter& filter, bool splats = false);
  bool splats() const { return splats_; }
  FilterSample sample(float u, float v) const;  // u, v in [0,1)
  // Returns how far in x and y samples lie evenly about the pixel's centre, with the weight 1. It is empty
  // for other filters.
  std::optional<Point2d> even_radius() const;
  double weight(float u, float v) const { return has_lobes() ? sample(u, v).weight : 1; }  // of that sample
  Footprint footprint(float u, float v) const;  // of that sample; radii ≤ greatest_splat_radius
  Neighbours neighbours() const;                // none where samples do not splat

 private:
  static constexpr std::size_t resolution = 256;
  struct Axis {
    double radius = 0;
    double total_weight = 1;         // ∫|f|/∫f
    std::vector<double> cumulative;  // of |f|: resolution + 1 values from 0 to 1; empty: uniform
    GuideTable guide;
    std::vector<bool> negative;  // f of each bin is; empty: nowhere
    void tabulate(auto&& f);
    FilterSample sample(double u) const;  // along this axis, as offset.x
    double value(double x) const;         // of f/∫f at a distance from its centre
    Neighbours neighbours() const;
  };
  bool has_lobes() const { return !splats_ && (!x_.negative.empty() || !y_.negative.empty()); }
  Axis x_, y_;
  bool splats_;
};

}  // namespace vitrail
