// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <variant>

#include "importers/bytes/growing_array.h"

namespace vitrail::pbrt {

// They are numbers that were counted alone (skim_pbrt in pbrt.h).
class SkippedNumbers {
 public:
  std::size_t size() const { return size_; }
  void push_back(double /*value*/) { ++size_; }
  template <class Visit>
  void consume(Visit&& /*visit*/, std::size_t /*group*/ = 1) {
    size_ = 0;
  }

 private:
  std::size_t size_ = 0;
};

// It has the numbers of a parameter that has very many, as narrow as their use allows: whole numbers, floats,
// or doubles where positions are still to be moved to the origin.
using LongList =
    std::variant<GrowingArray<double>, GrowingArray<float>, GrowingArray<std::int32_t>, SkippedNumbers>;

}  // namespace vitrail::pbrt
