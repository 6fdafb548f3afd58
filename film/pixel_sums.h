// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "film/film.h"

namespace vitrail {

// What one thread adds to a pixel is put together here until the next pixel comes, and goes to the film then:
// the same sums with fewer operations that other threads share. Of a film that is_plain. Outlived by the
// film.
class PixelSums {
 public:
  // Whether the film has nothing but X, Y, Z and samples to add to, in one pixel for a sample.
  static bool is_plain(const Film& film);

  explicit PixelSums(Film& film) : film_(film) {}
  ~PixelSums() { give(); }
  PixelSums(const PixelSums&) = delete;
  PixelSums& operator=(const PixelSums&) = delete;

  // As of Film.
  bool deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value);
  void count_sample(std::uint32_t pixel, std::uint32_t sample);

 private:
  void turn_to(std::uint32_t pixel);
  void give();  // to the film

  Film& film_;
  std::uint32_t pixel_ = 0, place_ = 0;
  bool holds_any_ = false;
  WideSum x_, z_;
  std::array<WideSum, sample_groups> y_{};
  std::array<std::uint32_t, sample_groups> counts_{};
};

}  // namespace vitrail
