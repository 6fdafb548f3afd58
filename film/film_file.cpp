// SPDX-License-Identifier: Apache-2.0
// The film file, little-endian: a header with the checksum of what comes before it, then six arrays, each
// followed by its xxh3: FilmProgress's earlier_ends, about and done, the sums, the counts, the ids; of a film
// that keeps mattes a seventh, these; and of a film within an adaptive round a last one, `more`. Before them
// come, of a film that has it, what photons it gathered, its light groups, and its working gamma.
// docs/why/color-and-film.md has the header byte by byte.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <utility>

#include "film/array_checksum.h"
#include "film/film_layout.h"
#include "film/film_progress.h"
#include "scene/records/film_extent.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/underway.h"

namespace vitrail {

using namespace film_layout;

static_assert(std::endian::native == std::endian::little, "files are written as they lie in memory");

namespace {

bool in_range(std::int32_t exponent) { return least_exponent <= exponent && exponent <= greatest_exponent; }

template <class T>
void write_array(AtomicFile& out, const T& array, FilmScratch* scratch = nullptr) {
  const std::uint64_t sum = checksum_of(std::span<const typename T::value_type>(array), scratch,
                                        [&](auto part) { out.write(std::as_bytes(part)); });
  out.write(std::as_bytes(std::span(&sum, 1)));
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file)
      : file_(file.string()), path_(file), in_(open_regular(file)) {
    std::error_code unreadable;
    size_ = std::filesystem::file_size(file, unreadable);
    if (!in_ || unreadable) throw Error("cannot open the film", {file_});
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(what, {file_}); }
  std::uint64_t size() const { return size_; }

  void read(void* to, std::uint64_t bytes) {
    if (!in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes)))
      fail("the film file is truncated");
  }

  template <class Array>
  void read_array(Array& array, std::uint64_t count, const char* what, FilmScratch* scratch = nullptr) {
    array.resize(count);
    const std::uint64_t sum =
        checksum_of(std::span(array), scratch, [&](auto part) { read(part.data(), part.size_bytes()); });
    std::uint64_t expected;
    read(&expected, sizeof expected);
    if (sum != expected) fail(fmt::format("the film file is corrupt: the checksum of its {} is wrong", what));
  }

 private:
  std::string file_;
  std::filesystem::path path_;
  Underway underway_{"reading", path_};
  std::ifstream in_;
  std::uint64_t size_ = 0;
};

// Whether what a header says can be.
bool has_sizes(const Header& h) {
  return 0 <= h.x0 && h.x0 < h.x1 && h.x1 <= h.full_width && h.full_width <= max_film_extent && 0 <= h.y0 &&
         h.y0 < h.y1 && h.y1 <= h.full_height && h.full_height <= max_film_extent &&
         std::isfinite(h.imaging_ratio);
}
bool has_bins(const Header& h) {
  return 0 <= h.bins && h.bins <= max_spectral_bins && h.bins_min_nm < h.bins_max_nm &&
         std::isfinite(h.bins_max_nm - h.bins_min_nm);
}
bool has_key(const Header& h) {
  const auto threshold = std::bit_cast<float>(h.options & threshold_bits);
  return std::memchr(h.renderer, 0, sizeof h.renderer) != nullptr && h.max_depth >= 0 &&
         (h.options & ~options_of(h.version)) == 0 && (h.layers & ~all_layers) == 0 && in_range(h.exponent) &&
         in_range(h.length_exponent) && h.clamp >= 0 && std::isfinite(h.clamp) && 0 <= threshold &&
         threshold < 1;
}

Header read_header(Reader& in) {
  Header h;
  if (in.size() < sizeof h) in.fail("this is not a film file: it is too short");
  in.read(&h, sizeof h);
  if (std::memcmp(h.magic, film_magic, sizeof film_magic) != 0) in.fail("this is not a film file");
  if (h.version != film_version && h.version != adaptive_version && h.version != photon_version &&
      h.version != groups_version)
    in.fail(
        fmt::format("film file of version {}, but this program ({}) reads version {}: only the program that "
                    "made the film can develop it",
                    h.version, to_string(this_renderer()), film_version));
  if (h.checksum != checksum(h)) in.fail("the film file is corrupt: the checksum of its header is wrong");
  if (!has_sizes(h) || !has_bins(h) || !has_key(h) ||
      !(h.render_time_s >= 0 && std::isfinite(h.render_time_s)))
    in.fail("the film file is corrupt: its header makes no sense");
  return h;
}

// None where the film has none.
LightGroups read_groups(Reader& in, const Header& h) {
  if (h.version != groups_version) return {};
  std::vector<GroupsHeader> header;
  in.read_array(header, 1, "light groups");
  const auto& [lights, groups, text_bytes] = header[0];
  if (groups == 0 || groups > most_light_groups || text_bytes > most_text_bytes)
    in.fail("the film file is corrupt: its light groups make no sense");
  std::vector<char> text;
  in.read_array(text, text_bytes, "light groups");
  LightGroups read{{}, lights};
  for (auto at = text.begin(); at != text.end();) {
    const auto end = std::find(at, text.end(), '\0');
    if (end == text.end()) break;
    read.names.emplace_back(at, end);
    at = end + 1;
  }
  if (read.names.size() != groups) in.fail("the film file is corrupt: its light groups make no sense");
  return read;
}

std::vector<char> text_of(const LightGroups& groups) {
  std::vector<char> text;
  for (const std::string& name : groups.names)
    text.insert(text.end(), name.c_str(), name.c_str() + name.size() + 1);
  return text;
}

GroupsHeader header_of(const LightGroups& groups) {
  return {groups.lights, static_cast<std::uint32_t>(groups.names.size()),
          static_cast<std::uint32_t>(text_of(groups).size())};
}

// Throws unless the file has as many bytes as its header says.
void check_size(const Reader& in, const Header& h, const LightGroups& groups) {
  std::uint64_t bytes = sizeof h;
  for (const std::uint64_t array : bytes_of_arrays(h, header_of(groups))) bytes += array + sizeof h.checksum;
  if (in.size() != bytes)
    in.fail(fmt::format("the film file is truncated or has bytes too many: {} bytes", in.size()));
}

// Without photons where the film has none.
PhotonKey read_photons(Reader& in, const Header& h) {
  if (h.version != photon_version) return {};
  std::vector<PhotonKey> photons;
  in.read_array(photons, 1, "photons");
  if (photons[0].photons == 0 || !(photons[0].first_radius > 0) || !std::isfinite(photons[0].first_radius) ||
      !(photons[0].alpha > 0) || !std::isfinite(photons[0].alpha))
    in.fail("the film file is corrupt: its photons make no sense");
  return photons[0];
}

double read_working_gamma(Reader& in, const Header& h) {
  if ((h.options & option_working_gamma) == 0) return 1;
  std::vector<double> gamma;
  in.read_array(gamma, 1, "working gamma");
  if (!(gamma[0] >= 0) || !std::isfinite(gamma[0]))
    in.fail("the film file is corrupt: its working gamma makes no sense");
  return gamma[0];
}

// All but `more`, which comes last.
FilmProgress read_progress(Reader& in, const Header& h, const Arrays& arrays) {
  FilmProgress read{
      h.items, h.samples_per_pixel, {}, h.render_time_s, {}, {}, (h.options & option_adaptive) != 0, {}};
  in.read_array(read.earlier_ends, h.earlier_ends, "earlier ends");
  const auto not_ascending = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
  if (std::ranges::adjacent_find(read.earlier_ends, not_ascending) != read.earlier_ends.end() ||
      (!read.earlier_ends.empty() && read.earlier_ends.back() >= h.samples_per_pixel))
    in.fail("the film file is corrupt: it continues from more samples than it has");
  in.read_array(read.about, h.about_bytes, "description");
  in.read_array(read.done, arrays.done, "progress");
  if (h.items % 64 != 0 && read.done.back() >> (h.items % 64) != 0)
    in.fail("the film file is corrupt: it has work done beyond its work items");
  return read;
}

FilmKey key_of(const Header& h, const PhotonKey& photons, const LightGroups& groups) {
  return {h.scene_hash,
          h.seed,
          h.max_depth,
          (h.options & option_direct_only) != 0,
          (h.options & option_straight_counts) != 0,
          h.clamp,
          {h.renderer, h.picture_revision},
          std::bit_cast<float>(h.options & threshold_bits),
          photons,
          (h.options & option_splats) != 0,
          (h.options & option_one_sequence) != 0,
          (h.options & option_hides_emitters) != 0,
          groups};
}

}  // namespace

bool FilmProgress::complete() const {
  std::uint64_t finished = 0;
  for (const std::uint64_t word : done) finished += static_cast<std::uint64_t>(std::popcount(word));
  return finished == items;
}

void write_film(const std::filesystem::path& file, const Film& film, const FilmProgress& progress) {
  Header h{};
  std::memcpy(h.magic, film_magic, sizeof film_magic);
  const bool photons = film.key_.photons.photons > 0;
  const LightGroups& groups = film.key_.groups;
  h.version = groups.any()        ? groups_version
              : progress.adaptive ? adaptive_version
              : photons           ? photon_version
                                  : film_version;
  h.full_width = film.settings_.width, h.full_height = film.settings_.height;
  h.x0 = film.settings_.crop.x0, h.x1 = film.settings_.crop.x1, h.y0 = film.settings_.crop.y0,
  h.y1 = film.settings_.crop.y1;
  h.imaging_ratio = film.settings_.imaging_ratio;
  h.bins = film.settings_.spectrum.count, h.bins_min_nm = film.settings_.spectrum.min_nm,
  h.bins_max_nm = film.settings_.spectrum.max_nm;
  const FilmKey& key = film.key_;
  h.scene_hash = key.scene_hash, h.seed = key.seed;
  key.renderer.number.copy(h.renderer, sizeof h.renderer - 1);
  h.picture_revision = key.renderer.revision;
  h.max_depth = key.max_depth;
  h.options =
      (key.direct_only ? option_direct_only : 0) | (key.straight_counts ? option_straight_counts : 0) |
      (film.settings_.layers.in_camera_space ? option_camera_space : 0) | (key.splats ? option_splats : 0) |
      (key.one_sequence ? option_one_sequence : 0) | (key.hides_emitters ? option_hides_emitters : 0) |
      (film.settings_.working_gamma != 1 ? option_working_gamma : 0) |
      (std::bit_cast<std::uint32_t>(key.threshold) & threshold_bits) |
      (progress.adaptive ? option_adaptive : 0) | (progress.more.empty() ? 0 : option_open_round);
  h.exponent = film.exponent_, h.length_exponent = film.length_exponent_;
  h.clamp = key.clamp;
  h.layers = film.settings_.layers.bits;
  h.nonfinite = film.refused_.nonfinite, h.too_large = film.refused_.too_large;
  h.items = progress.items, h.samples_per_pixel = progress.samples_per_pixel;
  h.render_time_s = progress.render_time_s;
  h.earlier_ends = static_cast<std::uint32_t>(progress.earlier_ends.size());
  h.about_bytes = static_cast<std::uint32_t>(progress.about.size());
  h.checksum = checksum(h);
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(&h, 1)));
  if (photons) write_array(out, std::array{key.photons});
  if (groups.any()) {
    write_array(out, std::array{header_of(groups)});
    write_array(out, text_of(groups));
  }
  if (film.settings_.working_gamma != 1) write_array(out, std::array{film.settings_.working_gamma});
  write_array(out, progress.earlier_ends);
  write_array(out, progress.about);
  write_array(out, progress.done);
  FilmScratch* const scratch = film.scratch_.get();
  write_array(out, film.sums_, scratch);
  write_array(out, film.counts_, scratch);
  write_array(out, film.ids_, scratch);
  if (!film.mattes_.empty()) write_array(out, film.mattes_, scratch);
  if (!progress.more.empty()) write_array(out, progress.more);
  out.commit();
}

Film read_film(const std::filesystem::path& file, FilmProgress* progress,
               std::shared_ptr<FilmScratch> scratch) {
  Reader in(file);
  const Header h = read_header(in);
  const LightGroups groups = read_groups(in, h);
  check_size(in, h, groups);
  const Arrays arrays = arrays_of(h, groups.names.size());
  const PhotonKey photons = read_photons(in, h);
  const double working_gamma = read_working_gamma(in, h);
  FilmProgress read = read_progress(in, h, arrays);
  Film film(std::move(scratch));
  film.settings_.crop = {h.x0, h.x1, h.y0, h.y1};
  film.settings_.width = h.full_width, film.settings_.height = h.full_height;
  film.settings_.imaging_ratio = h.imaging_ratio;
  film.settings_.spectrum = {h.bins, h.bins_min_nm, h.bins_max_nm};
  film.settings_.layers = arrays.layers;
  film.settings_.working_gamma = working_gamma;
  film.key_ = key_of(h, photons, groups);
  film.exponent_ = h.exponent, film.length_exponent_ = h.length_exponent;
  film.refused_ = {h.nonfinite, h.too_large};
  in.read_array(film.sums_, arrays.sums, "sums", film.scratch_.get());
  in.read_array(film.counts_, arrays.counts, "counts", film.scratch_.get());
  in.read_array(film.ids_, arrays.ids, "ids", film.scratch_.get());
  if (arrays.mattes > 0) in.read_array(film.mattes_, arrays.mattes, "mattes", film.scratch_.get());
  in_parts(std::span(std::as_const(film.mattes_)), film.scratch_.get(), [&](auto part) {
    if (!std::ranges::all_of(part, makes_sense))
      in.fail("the film file is corrupt: its mattes make no sense");
  });
  if (arrays.more > 0) in.read_array(read.more, arrays.more, "open round");
  if (progress) *progress = std::move(read);
  return film;
}

}  // namespace vitrail
