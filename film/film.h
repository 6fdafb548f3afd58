// SPDX-License-Identifier: Apache-2.0
// The film: integer sums that merge in any order, so that a picture does not depend on who added what when.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/color.h"
#include "scene/scene.h"

namespace vitrail {

// Samples of a pixel are dealt into this many groups (sample index modulo it) whose luminance sums are kept
// apart: their scatter estimates the variance of the pixel, which single deposits, being parts of samples,
// cannot.
inline constexpr int luminance_groups = 8;

// Identifies what a film is of. Films of the same key but different seeds merge; a resume needs all equal.
struct FilmKey {
  std::uint64_t scene_hash = 0;
  std::uint64_t settings_hash = 0;  // of all that changes the picture besides scene, seed and sample count
  std::uint64_t seed = 0;
  bool operator==(const FilmKey&) const = default;
};

// Width × height of the crop; planes row-major from the top left.
class Film {
 public:
  Film() = default;
  Film(const FilmSettings& settings, const FilmKey& key);

  const PixelRect& crop() const { return crop_; }
  int width() const { return crop_.x1 - crop_.x0; }   // of the crop
  int height() const { return crop_.y1 - crop_.y0; }  // of the crop
  int full_width() const { return full_width_; }
  int full_height() const { return full_height_; }
  double imaging_ratio() const { return imaging_ratio_; }
  const SpectralBins& bins() const { return bins_; }
  const FilmKey& key() const { return key_; }

  // Adds to a pixel, each component rounded once to 2⁻³². Safe from many threads. `pixel` = y·width + x
  // within the crop. Returns false, and adds nothing, if the value is not finite or too large for the fixed
  // point.
  bool deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value);
  // Adds to a bin of a pixel's spectrum, as above: radiance over (pdf of its wavelength · width of the bin).
  bool deposit_bin(std::uint32_t pixel, std::size_t bin, double value);
  // Counts one sample of a pixel, whatever it deposits.
  void count_sample(std::uint32_t pixel);

  // Sums of another film of the same size. Exact in any order. Throws Error where they do not fit together.
  void merge(const Film& other);

  // Mean of the samples: Σ/count, imaging ratio applied; black where the count is 0.
  XYZ mean(std::uint32_t pixel) const;
  // Mean radiance of a bin, W·m⁻²·sr⁻¹·nm⁻¹, imaging ratio applied.
  double mean_of_bin(std::uint32_t pixel, std::size_t bin) const;
  // Variance of that mean's Y, from the scatter of the groups; 0 where fewer than two groups have samples.
  double variance_of_mean(std::uint32_t pixel) const;
  std::uint64_t samples(std::uint32_t pixel) const;
  // True when a sum came near overflow: the picture is then not to be trusted.
  bool saturated() const;

  // xxh3 over all sums and counts.
  std::uint64_t hash() const;

  // The raw planes, for exchange between ranks: X, Z, Y₀…Y₇, then one a spectral bin,
  // each width·height.
  std::span<std::int64_t> sums() { return sums_; }
  std::span<const std::int64_t> sums() const { return sums_; }
  std::span<std::uint32_t> counts() { return counts_; }
  std::span<const std::uint32_t> counts() const { return counts_; }
  std::uint64_t bytes() const { return sums_.size() * 8 + counts_.size() * 4; }

 private:
  friend Film read_film(const std::filesystem::path& file, struct FilmProgress* progress);
  friend void write_film(const std::filesystem::path& file, const Film& film,
                         const struct FilmProgress& progress);
  PixelRect crop_{};
  int full_width_ = 0, full_height_ = 0;
  double imaging_ratio_ = 1;
  SpectralBins bins_;
  FilmKey key_{};
  std::vector<std::int64_t> sums_;
  std::vector<std::uint32_t> counts_;
};

// Which samples a film holds: bit i of `done` is work item i of `items` (see farm/work.h). A finished film
// has all.
struct FilmProgress {
  std::uint64_t items = 0;
  std::uint64_t samples_per_pixel = 0;
  std::vector<std::uint64_t> done;  // ⌈items/64⌉ words
  double render_time_s = 0;
  bool complete() const;
};

// Writes under a temporary name, syncs and renames. Throws MachineError.
void write_film(const std::filesystem::path& file, const Film& film, const FilmProgress& progress);
// Throws Error for anything but a whole, checksummed film of this version. `progress` may be null.
Film read_film(const std::filesystem::path& file, FilmProgress* progress);

}  // namespace vitrail
