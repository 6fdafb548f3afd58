// SPDX-License-Identifier: Apache-2.0
// A film has integer sums that merge in any order, so that no picture depends on who added what when.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "film/film_key.h"
#include "film/film_scratch.h"
#include "film/footprint.h"
#include "film/light_groups.h"
#include "film/mattes.h"
#include "film/sample_groups.h"
#include "film/untouched.h"
#include "film/wide_sum.h"
#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail {

// They count deposits that were refused.
struct Refused {
  std::uint64_t nonfinite = 0;
  std::uint64_t too_large = 0;  // the picture lacks light: the film is saturated
  bool operator==(const Refused&) const = default;
};

// The pixels of an iteration of photon mapping share photons, and so a part of their error, which the scatter
// within a pixel does not show. So such a film also keeps the sums of Y and the samples of all pixels in
// batches. A batch has successive iterations and is well stratified: iteration i is in batch ⌊i/8⌋ mod 32.
inline constexpr std::uint32_t photon_batches = 32, iterations_a_batch = 8;
constexpr std::uint32_t batch_of(std::uint32_t iteration) {
  return iteration / iterations_a_batch % photon_batches;
}
// Returns how many sums a film has beside its planes.
constexpr std::size_t single_sums(const FilmKey& key) {
  return (key.photons.photons > 0 ? 2 * photon_batches : 0) + (key.clamp > 0 ? 1 : 0);
}

// A sum counts in 2^exponent. A deposit has to be below 2^(exponent + deposit_bits(…)), so that a sum holds
// 2⁴² deposits, 2¹⁰ of each of 2³² samples, whatever they are. Where samples add to several pixels a sum
// counts in 2^(exponent − weight_bits), as a deposit of whole quanta times a weight does.
constexpr int deposit_bits(bool splats) { return splats ? 85 - weight_bits : 85; }
inline constexpr int default_exponent = -45;                          // for radiances about 1
inline constexpr int least_exponent = -900, greatest_exponent = 900;  // so that all are doubles

// Returns the memory of a film's sums, counts and ids, before there is one. Throws Error where there cannot
// be such a film: of more than 2³² − 1 pixels, or of a picture that is too large.
std::uint64_t film_bytes(const FilmSettings& settings, const FilmKey& key = {});

// A GroupLight is what the lights of one group add to a deposit.
struct GroupLight {
  std::size_t group = 0;
  XYZ value;
};

// A Film has width × height pixels of the crop. Its planes are row-major from the top left.
class Film {
 public:
  Film() = default;
  // `length_exponent` is that of lengths in layers, see tracer/prepared/film_exponent.h. `scratch` is where
  // the film's sums lie if not in memory.
  Film(const FilmSettings& settings, const FilmKey& key, int exponent = default_exponent,
       int length_exponent = default_exponent, std::shared_ptr<FilmScratch> scratch = nullptr);

  // Returns what the film is of. Its filter is not kept.
  const FilmSettings& settings() const { return settings_; }
  const PixelRect& crop() const { return settings_.crop; }
  int width() const { return crop().x1 - crop().x0; }   // of the crop
  int height() const { return crop().y1 - crop().y0; }  // of the crop
  // Returns the pixels of the crop: width() · height().
  std::uint32_t pixels() const { return static_cast<std::uint32_t>(counts_.size() / sample_groups); }
  // They return the size of the whole picture.
  int full_width() const { return settings_.width; }
  int full_height() const { return settings_.height; }
  // They return the rest of its settings, and what it was rendered with.
  double imaging_ratio() const { return settings_.imaging_ratio; }
  const SpectralBins& bins() const { return settings_.spectrum; }
  const FilmLayers& layers() const { return settings_.layers; }
  const FilmKey& key() const { return key_; }
  // Sums count in 2^exponent, those of lengths in 2^length_exponent.
  int exponent() const { return exponent_; }
  int length_exponent() const { return length_exponent_; }

  // Adds to a pixel; safe from many threads. `pixel` is y·width + x within the crop. Each component is
  // rounded once to a whole number of quanta, up or down by a hash of pixel, sample and value. The
  // probabilities make the mean exact: light below the quantum is not lost. If the value is not finite or too
  // large, returns false, adds nothing and counts it in `refused`. `spread` is given where the film splats,
  // and nowhere else: the sample's pixels, of which those outside the crop get nothing. `parts` is given
  // where the film keeps groups of lights, and nowhere else: the part of `value` that each group has. The
  // last gets what is left of the deposit's quanta.
  bool deposit(std::uint32_t pixel, std::uint32_t sample, const XYZ& value, const Footprint* spread = nullptr,
               std::span<const GroupLight> parts = {});
  // Adds to a bin of a pixel's spectrum, as above: radiance over (pdf of its wavelength · width of the bin).
  bool deposit_bin(std::uint32_t pixel, std::uint32_t sample, std::size_t bin, double value,
                   const Footprint* spread = nullptr);
  // Returns the part of a deposit's light that the key's clamp leaves, in (0,1]; counts what it takes.
  double clamp(std::uint32_t pixel, std::uint32_t sample, const XYZ& value);
  // Adds to a layer of sums that the film keeps, as above; `values` has one a plane of the layer. A value
  // that is too large counts as one that is not finite: it is no light.
  void deposit_layer(std::uint32_t pixel, std::uint32_t sample, Layer layer, std::span<const double> values,
                     const Footprint* spread = nullptr);
  // Puts an id < 2³² − 1 into a layer of ids that the film keeps. A pixel has the id of its first sample, by
  // number, that has one; of films of several seeds, the least of the first ones.
  void put_id(std::uint32_t pixel, std::uint32_t sample, Layer layer, std::uint32_t id);
  // Adds to a layer of mattes that the film keeps: `id` is a thing that the sample sees, not 0. `weight` is
  // the sample's by its filter, where the film does not splat.
  void put_matte(std::uint32_t pixel, Layer layer, std::uint32_t id, double weight,
                 const Footprint* spread = nullptr);
  // Counts one sample of a pixel, whatever it deposits.
  void count_sample(std::uint32_t pixel, std::uint32_t sample, const Footprint* spread = nullptr);

  // Adds the sums of another film of the same size. Exact in any order. Throws Error where they do not fit.
  void merge(const Film& other);

  // Returns the mean of the samples, imaging ratio applied. It is Σ over their number, or over the sum of
  // their weights if the film splats; black where that is not above 0.
  XYZ mean(std::uint32_t pixel) const;
  // Returns the mean radiance of a bin, W·m⁻²·sr⁻¹·nm⁻¹, imaging ratio applied.
  double mean_of_bin(std::uint32_t pixel, std::size_t bin) const;
  // Returns the mean of a layer of sums, in one of its planes, over all samples of a pixel.
  // A sample that sees nothing has 0.
  double mean_of_layer(std::uint32_t pixel, Layer layer, std::size_t plane) const;
  // Returns the mean of the light of a group, as `mean`.
  XYZ mean_of_group(std::uint32_t pixel, std::size_t group) const;
  // Returns 1 + the id of a layer of ids; 0 where no sample has one.
  std::uint32_t id(std::uint32_t pixel, Layer layer) const;
  const MattePixel& matte(std::uint32_t pixel, Layer layer) const;
  // Returns the part of the pixel that a matte's sum is.
  double coverage(std::uint32_t pixel, std::int64_t sum) const;
  // Returns the variance of the mean's Y, from the scatter of the groups. It is 0 where one group
  // has no samples, or all are one sequence. The estimate has one degree of freedom: it is of use
  // where many are put together.
  double variance_of_mean(std::uint32_t pixel) const;
  // Returns the standard error of the picture's mean Y in photon mapping, relative to it, by the batches'
  // scatter. It is 0 where unknown: of fewer than two batches, and of paths, whose pixels are independent.
  double shared_error() const;
  std::uint64_t samples(std::uint32_t pixel) const;
  std::uint64_t samples() const;  // of all pixels

  // Returns the part of all deposits' Y that the clamp took: how much darker the picture is on the average.
  double clamped_share() const;

  // Returns null where all is in memory. Code that reads or writes the planes itself does so by in_parts.
  const std::shared_ptr<FilmScratch>& scratch() const { return scratch_; }

  // Returns the deposits that the film did not take.
  const Refused& refused() const { return refused_; }
  // Returns true when a deposit was too large: the picture is then not to be trusted.
  bool saturated() const { return refused_.too_large > 0; }

  // Returns xxh3 over all sums, counts, ids and mattes.
  std::uint64_t hash() const;

  // They return the raw planes, for exchange between ranks, each width·height. These are X, Z, Y of
  // each group; one a spectral bin; those of layers; X, Y, Z of each group of lights; the weights
  // of each group, if the film splats. Numbers for all pixels follow: the Y, then the samples, of
  // each batch of photon mapping; the Y that a clamp took. The spans below have the samples of each
  // group, and the refused deposits.
  std::span<WideSum> sums() { return sums_; }
  std::span<const WideSum> sums() const { return sums_; }
  std::span<std::uint32_t> counts() { return counts_; }
  std::span<const std::uint32_t> counts() const { return counts_; }
  Refused& refused() { return refused_; }
  // Returns the ids of layers, each width·height; 0: none. Where films are merged, the greater id is kept.
  std::span<std::int64_t> ids() { return ids_; }
  // Returns the mattes of layers, each width·height.
  std::span<MattePixel> mattes() { return mattes_; }

 private:
  friend Film read_film(const std::filesystem::path& file, struct FilmProgress* progress,
                        std::shared_ptr<FilmScratch> scratch);
  friend void write_film(const std::filesystem::path& file, const Film& film,
                         const struct FilmProgress& progress);
  explicit Film(std::shared_ptr<FilmScratch> scratch);
  // Returns what is read or written, once there is room for its page.
  template <class T>
  const T& reading(const T& at) const {
    if (scratch_) [[unlikely]]
      scratch_->reads(&at, sizeof at);
    return at;
  }
  // Call it after writing `at`, whose page is then in memory: so films in memory pay least.
  template <class T>
  void written(const T& at) {
    if (scratch_) [[unlikely]]
      written_in_scratch(&at, sizeof at);
  }
  [[gnu::cold, gnu::noinline]] void written_in_scratch(const void* at, std::size_t bytes);
  // Returns `at`, to be written to at once.
  template <class T>
  T& writing(T& at) {
    written(at);
    return at;
  }
  void add_single(std::size_t sum, const WideSum& quanta);
  std::size_t group(std::uint32_t sample) const;
  std::uint32_t place(std::uint32_t pixel) const;
  bool accepts(double size, double largest);
  void add(std::size_t plane, std::uint32_t pixel, const WideSum& quanta, const Footprint* spread);
  void add_to_groups(std::uint32_t pixel, std::uint32_t sample, std::array<WideSum, 3> quanta,
                     std::span<const GroupLight> parts, const Footprint* spread);
  double weight(std::size_t group, std::uint32_t pixel) const;  // of its samples
  double weight(std::uint32_t pixel) const;
  std::size_t first_group() const;
  std::size_t first_weights() const;
  double value(std::size_t plane, std::uint32_t pixel) const;
  std::size_t first_plane(Layer layer) const;
  int exponent_of(Layer layer) const;
  std::size_t place_of_id(std::uint32_t pixel, Layer layer) const;
  std::size_t place_of_matte(std::uint32_t pixel, Layer layer) const;
  std::size_t first_batch() const { return sums_.size() - single_sums(key_); }

  FilmSettings settings_{.width = 0, .height = 0, .crop = {}};
  FilmKey key_{};
  int exponent_ = default_exponent, length_exponent_ = default_exponent;
  std::shared_ptr<FilmScratch> scratch_;
  UntouchedVector<WideSum> sums_;
  UntouchedVector<std::uint32_t> counts_;
  UntouchedVector<std::int64_t> ids_;
  Refused refused_;
  UntouchedVector<MattePixel> mattes_;
};

// Returns in words what keeps two films from being samples of one picture; "" where nothing does.
// Seeds and sample counts may differ.
std::string difference(const Film& a, const Film& b);

}  // namespace vitrail
