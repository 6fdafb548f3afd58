// SPDX-License-Identifier: Apache-2.0
// What a film keeps of mattes.
#include <cassert>
#include <cmath>

#include "film/film.h"

namespace vitrail {

namespace {

constexpr double quanta_of_a_sample = 1 << weight_bits;

}  // namespace

std::size_t Film::place_of_matte(std::uint32_t pixel, Layer layer) const {
  return matte_planes(settings_.layers, static_cast<std::size_t>(layer)) * pixels() + pixel;
}

void Film::put_matte(std::uint32_t pixel, Layer layer, std::uint32_t id, double weight,
                     const Footprint* spread) {
  assert((spread != nullptr) == key_.splats);
  // They are read before they are written.
  const auto filling = [&](MattePixel& at) -> MattePixel& { return reading(at), at; };
  MattePixel* const plane = mattes_.data() + place_of_matte(0, layer);
  if (!spread)
    return add_shared(filling(plane[pixel]), id,
                      static_cast<std::int64_t>(std::llround(quanta_of_a_sample * weight)));
  for_each_pixel(*spread, pixel, width(), height(),
                 [&](std::size_t at, std::int32_t landed) { add_shared(filling(plane[at]), id, landed); });
}

const MattePixel& Film::matte(std::uint32_t pixel, Layer layer) const {
  return reading(mattes_[place_of_matte(pixel, layer)]);
}

// Weights of samples that splat are in the same quanta as the sums.
double Film::coverage(std::uint32_t pixel, std::int64_t sum) const {
  const double n = weight(pixel);
  return n > 0 ? static_cast<double>(sum) / (key_.splats ? n : quanta_of_a_sample * n) : 0;
}

}  // namespace vitrail
