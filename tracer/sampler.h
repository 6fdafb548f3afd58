// SPDX-License-Identifier: Apache-2.0
// Stateless random numbers: Owen-scrambled Sobol' points, padded in sets of four dimensions (Burley,
// "Practical Hash-based Owen Scrambling", JCGT 2020). Every number is a pure function of (seed, pixel,
// sample, set).
#pragma once

#include <array>
#include <cstdint>

namespace vitrail {

struct SampleKey {
  std::uint64_t seed = 0;
  std::uint32_t pixel = 0;  // of the whole film, so that a crop samples as the full picture does
  std::uint32_t sample = 0;
};

// Four numbers in [0,1), the coordinates of a point of a scrambled Sobol' sequence of its own for each (seed,
// pixel, set, group of samples): the samples of a group (film/sample_groups.h) are its points in turn. Sets
// and groups are statistically independent of each other.
std::array<float, 4> sample_4d(const SampleKey& key, std::uint32_t set);

// As many numbers in [0,1) as it takes (SplitMix64, Steele et al. 2014), from a seed of `stream_seed`.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}
  double next();
  std::uint64_t bits();

 private:
  std::uint64_t state_;
};
// Four numbers in [0,1), a function of the seed.
std::array<float, 4> hashed_4d(std::uint64_t seed);
// A function of (key, a, b).
std::uint64_t stream_seed(const SampleKey& key, std::uint64_t a, std::uint64_t b);

// Which set is for what: one for the camera and one for its lens, two a bounce.
namespace sample_set {
inline constexpr std::uint32_t camera = 0;  // film x, film y, wavelength, unused
constexpr std::uint32_t scatter(std::uint32_t depth) {
  return 1 + 2 * depth;
}  // direction u, v, lobe, roulette
constexpr std::uint32_t light(std::uint32_t depth) {
  return 2 + 2 * depth;
}  // point u, v, which light, which kind
inline constexpr std::uint32_t lens = 0xffffffffu;  // point u, v, unused, unused
}  // namespace sample_set

}  // namespace vitrail
