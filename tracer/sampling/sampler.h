// SPDX-License-Identifier: Apache-2.0
// This file has stateless random numbers: Owen-scrambled Sobol' points, padded in sets of four dimensions
// (Burley, "Practical Hash-based Owen Scrambling", JCGT 2020). Every number is a pure function of (seed,
// pixel, sample, set).
#pragma once

#include <array>
#include <cstdint>
#include <utility>

namespace vitrail {

// It is what all samples of a picture have in common. A number alone is a seed whose samples know their
// error.
struct PictureSeed {
  std::uint64_t value = 0;
  // A pixel's samples are then one sequence, stratified together: there is less noise, and nothing tells how
  // much. Otherwise they are two (film/sample_groups.h).
  bool one_sequence = false;
  constexpr PictureSeed(std::uint64_t seed = 0, bool one = false) : value(seed), one_sequence(one) {}
  constexpr operator std::uint64_t() const { return value; }
};

struct SampleKey {
  PictureSeed seed;
  std::uint32_t pixel = 0;  // of the whole film, so that a crop samples as the full picture does
  std::uint32_t sample = 0;
};

// It is SplitMix64's finaliser (Steele, Lea & Flood 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

// Returns four numbers in [0,1), the coordinates of a point of a scrambled Sobol' sequence. Each (seed,
// pixel, set, group of samples) has a sequence of its own. The samples of a group (film/sample_groups.h) are
// its points in turn; with one sequence, all samples are one group. Sets and groups are statistically
// independent of each other. A caller that needs only the first numbers saves the others, which are then 0.
enum class Wanted : std::uint8_t { two, three, four };
std::array<float, 4> sample_4d(const SampleKey& key, std::uint32_t set, Wanted wanted = Wanted::four);

// It gives any number of numbers in [0,1) (SplitMix64, Steele et al. 2014), from a seed of `stream_seed`.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}
  double next() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15ull); }

 private:
  std::uint64_t state_;
};
// Returns four numbers in [0,1), a function of the seed.
std::array<float, 4> hashed_4d(std::uint64_t seed);
// Returns a function of the key, which all streams of a sample begin with.
constexpr std::uint64_t sample_seed(const SampleKey& key) {
  const std::uint64_t sample = static_cast<std::uint64_t>(key.pixel) << 32 | key.sample;
  return mix(mix(key.seed + 0x9e3779b97f4a7c15ull) ^ sample);
}
// Returns a function of (sample_seed, a, b).
constexpr std::uint64_t stream_seed(std::uint64_t sample_seed, std::uint64_t a, std::uint64_t b) {
  return mix(sample_seed + mix(a + 0x632be59bd9b4e019ull) * 3 + b);
}
constexpr std::uint64_t stream_seed(const SampleKey& key, std::uint64_t a, std::uint64_t b) {
  return stream_seed(sample_seed(key), a, b);
}

// These sets are for the camera, its lens and its time, one each, and two for a bounce.
namespace sample_set {
inline constexpr std::uint32_t camera =
    0;  // film x, film y, wavelengths, whose is the hero and choice of a light
constexpr std::uint32_t scatter(std::uint32_t depth) {
  return 1 + 2 * depth;
}  // direction u, v, lobe, roulette
constexpr std::uint32_t light(std::uint32_t depth) {
  return 2 + 2 * depth;
}  // point u, v, which light, which kind
inline constexpr std::uint32_t lens = 0xffffffffu;          // point u, v; point u, v of the sun's disc
inline constexpr std::uint32_t time = 0xfffffffeu;          // of the shutter, where anything moves
inline constexpr std::uint32_t material = 0xfffffffdu;      // which of a blend, at the first surface
inline constexpr std::uint32_t polarization = 0xfffffffcu;  // of connections through panes
}  // namespace sample_set

// They are numbers in [0,1) for the choice of a material. The first one for a path's first surface is
// stratified over the samples of a pixel; all others are of a stream.
class MaterialNumbers {
 public:
  explicit MaterialNumbers(std::uint64_t stream) : stream_(stream) {}
  MaterialNumbers(std::uint64_t stream, const SampleKey& first) : stream_(stream), first_(&first) {}
  double next() {
    const SampleKey* const key = std::exchange(first_, nullptr);
    return key ? static_cast<double>(sample_4d(*key, sample_set::material, Wanted::two)[0]) : stream_.next();
  }

 private:
  RandomStream stream_;
  const SampleKey* first_ = nullptr;
};

}  // namespace vitrail
