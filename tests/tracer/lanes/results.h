// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "tracer/rays/direction.h"

namespace vitrail::lane_tests {

// Writes results one after the other.
struct Results {
  double* next;
  Results& operator<<(double x) {
    *next++ = x;
    return *this;
  }
  template <class V>
  requires requires(V v) { v.z; }
  Results& operator<<(const V& v) {
    return *this << static_cast<double>(v.x) << static_cast<double>(v.y) << static_cast<double>(v.z);
  }
  Results& operator<<(const std::array<float, 4>& v) {
    for (const float x : v) *this << static_cast<double>(x);
    return *this;
  }
  Results& operator<<(DirectionCode code) { return *this << code.first() << code.second(); }
};

}  // namespace vitrail::lane_tests
