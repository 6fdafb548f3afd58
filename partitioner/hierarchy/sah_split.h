// SPDX-License-Identifier: Apache-2.0
// This file decides where to divide boxes, by the surface area heuristic over bins of their centres.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scene/geometry/bounds.h"

namespace vitrail {

using Float4 = float __attribute__((vector_size(16)));
using Float4InMemory = float __attribute__((vector_size(16), aligned(4), may_alias));

inline Float4 min(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max(Float4 a, Float4 b) { return a > b ? a : b; }

// It is a box and its number. Corners are read as four floats; the fourth means nothing, but is finite.
struct alignas(32) BoxRecord {
  float corners[7];  // lower, upper, 0
  std::uint32_t reference;

  Float4 lower() const { return *reinterpret_cast<const Float4InMemory*>(corners); }
  Float4 upper() const { return *reinterpret_cast<const Float4InMemory*>(corners + 3); }
  Float4 centre() const { return lower() * 0.5f + upper() * 0.5f; }
};

// Returns the area of three of the six faces.
inline float half_area(Float4 extent) {
  return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
}

struct WideBounds {
  Float4 lower = Float4{} + std::numeric_limits<float>::infinity();
  Float4 upper = Float4{} - std::numeric_limits<float>::infinity();

  void extend(Float4 l, Float4 u) { lower = min(lower, l), upper = max(upper, u); }
  void extend(const WideBounds& b) { extend(b.lower, b.upper); }
};

// Boxes whose centre is less than `at` on this axis go below.
struct SahSplit {
  int axis = 0;
  float at = 0;
  bool below(const BoxRecord& r) const { return 0.5f * r.corners[axis] + 0.5f * r.corners[axis + 3] < at; }
};

// Returns the split of least area · ⌈number / block⌉, summed over both sides. `centres` bounds the centres.
// Returns none where no plane parts them.
std::optional<SahSplit> choose_split(std::span<const BoxRecord> boxes, const WideBounds& centres,
                                     unsigned block, bool weighted = false);

}  // namespace vitrail
