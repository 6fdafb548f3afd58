// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "film/film.h"

namespace vitrail {

// PixelSums puts together what one thread adds to a pixel. It gives that to the film when the next
// pixel comes: the sums are the same with fewer operations that other threads share. The film has to
// be is_plain, and has to outlive it.
class PixelSums {
 public:
  // Returns whether the film has nothing but X, Y, Z and samples to add to, in one pixel for a sample.
  static bool is_plain(const Film& film);

  explicit PixelSums(Film& film) : film_(film) {}
  ~PixelSums() { give(); }
  PixelSums(const PixelSums&) = delete;
  PixelSums& operator=(const PixelSums&) = delete;

  // They do the same as those of Film.
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
