// SPDX-License-Identifier: Apache-2.0
// The film file, little-endian: a header with the checksum of what comes before it, then six arrays, each
// followed by its xxh3: FilmProgress's earlier_ends, about and done, the sums, the counts, the ids; of a film
// that keeps mattes a seventh, these; and of a film within an adaptive round a last one, `more`. Before them
// come, of a film that has it, what photons it gathered, its light groups, and its working gamma.
// docs/why/color-and-film.md has the header byte by byte.
#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>

#include "film/film_progress.h"
#include "scene/records/film_extent.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/underway.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little, "files are written as they lie in memory");

namespace {

constexpr char film_magic[8] = {'v', 'i', 't', 'f', 'i', 'l', 'm', '\n'};
// Of the last two, what photons its samples gathered, or which lights it keeps apart, follows the header.
constexpr std::uint32_t film_version = 4, adaptive_version = 5, photon_version = 7, groups_version = 8;

// What a film was rendered with, in Header::options.
constexpr std::uint32_t option_direct_only = 1, option_straight_counts = 2, option_camera_space = 4,
                        option_adaptive = 8, option_open_round = 16, option_splats = 32,
                        option_one_sequence = 64, option_hides_emitters = 128, option_working_gamma = 256;
constexpr std::uint32_t threshold_bits = 0xffff0000;  // the upper half of a float
constexpr std::uint32_t options_of(std::uint32_t version) {
  const bool may_be_adaptive = version == adaptive_version || version == groups_version;
  return threshold_bits | option_splats | option_one_sequence | option_hides_emitters | option_working_gamma |
         (may_be_adaptive ? 31 : 7);
}

struct Header {
  char magic[8];
  std::uint32_t version;
  std::int32_t full_width, full_height;
  std::int32_t x0, x1, y0, y1;
  std::int32_t bins;
  double imaging_ratio;
  double bins_min_nm, bins_max_nm;
  std::uint64_t scene_hash, seed;
  std::uint64_t items, samples_per_pixel;
  double render_time_s;
  char renderer[16];  // ends with a zero
  std::uint32_t picture_revision;
  std::int32_t max_depth;
  std::uint32_t options;
  std::int32_t exponent;
  double clamp;
  std::uint64_t nonfinite, too_large;  // deposits
  std::uint32_t earlier_ends, about_bytes;
  std::uint32_t layers;
  std::int32_t length_exponent;
  std::uint64_t checksum;  // of all before it
};
static_assert(sizeof(Header) == 184);

// Of a film that keeps groups of lights: followed by their names, each with a zero behind it.
struct GroupsHeader {
  std::uint64_t lights;
  std::uint32_t groups, text_bytes;
};
constexpr std::uint32_t most_text_bytes = 1 << 20;

std::uint64_t checksum(const Header& h) { return XXH3_64bits(&h, offsetof(Header, checksum)); }

bool in_range(std::int32_t exponent) { return least_exponent <= exponent && exponent <= greatest_exponent; }

std::uint64_t words_of(std::uint64_t items) { return items / 64 + (items % 64 != 0 ? 1 : 0); }

template <class T>
void write_array(AtomicFile& out, const T& array) {
  const auto bytes = std::as_bytes(std::span(array));
  const std::uint64_t sum = XXH3_64bits(bytes.data(), bytes.size());
  out.write(bytes);
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
  void read_array(Array& array, std::uint64_t count, const char* what) {
    array.resize(count);
    const std::uint64_t bytes = count * sizeof(typename Array::value_type);
    read(array.data(), bytes);
    std::uint64_t expected;
    read(&expected, sizeof expected);
    if (XXH3_64bits(array.data(), bytes) != expected)
      fail(fmt::format("the film file is corrupt: the checksum of its {} is wrong", what));
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
  return std::memchr(h.renderer, 0, sizeof h.renderer) != nullptr && h.max_depth >= 0 &&
         (h.options & ~options_of(h.version)) == 0 && (h.layers & ~all_layers) == 0 && in_range(h.exponent) &&
         in_range(h.length_exponent) && h.clamp >= 0 && std::bit_cast<float>(h.options & threshold_bits) >= 0;
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
  if (!has_sizes(h) || !has_bins(h) || !has_key(h) || !(h.render_time_s >= 0))
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

std::uint64_t bytes_in_file(const LightGroups& groups) {
  return groups.any() ? sizeof(GroupsHeader) + text_of(groups).size() + 2 * 8 : 0;
}

// What a header says of the arrays behind it.
struct Arrays {
  Arrays(const Header& h, const LightGroups& groups)
      : pixels(static_cast<std::uint64_t>(h.x1 - h.x0) * static_cast<std::uint64_t>(h.y1 - h.y0)),
        layers{h.layers, (h.options & option_camera_space) != 0},
        open_round((h.options & option_open_round) != 0),
        group_bytes(bytes_in_file(groups)),
        planes(2 + sample_groups + static_cast<std::uint64_t>(h.bins) + sum_planes(layers) +
               planes_a_group * groups.names.size() +
               ((h.options & option_splats) != 0 ? sample_groups : 0)) {}

  std::uint64_t pixels;
  FilmLayers layers;
  bool open_round;
  std::uint64_t group_bytes;  // of the light groups' names
  std::uint64_t planes;       // of sums
};

// Throws unless the file has as many bytes as its header says.
void check_size(const Reader& in, const Header& h, const Arrays& arrays) {
  const std::uint64_t but_for_done =
      arrays.pixels * (arrays.planes * sizeof(WideSum) + sample_groups * sizeof(std::uint32_t) +
                       id_planes(arrays.layers) * sizeof(std::int64_t) +
                       matte_planes(arrays.layers) * sizeof(MattePixel)) +
      (matte_planes(arrays.layers) > 0 ? 8 : 0) + h.earlier_ends * std::uint64_t{sizeof(std::uint32_t)} +
      h.about_bytes + 6 * 8 + (h.clamp > 0 ? sizeof(WideSum) : 0) + arrays.group_bytes +
      ((h.options & option_working_gamma) != 0 ? sizeof(double) + 8 : 0) +
      (h.version == photon_version ? sizeof(PhotonKey) + 8 + 2 * photon_batches * sizeof(WideSum) : 0) +
      (arrays.open_round ? arrays.pixels * sizeof(std::uint32_t) + 8 : 0);
  const std::uint64_t bytes = in.size() - sizeof h;
  if (bytes < but_for_done || (bytes - but_for_done) % 8 != 0 ||
      (bytes - but_for_done) / 8 != words_of(h.items))
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
FilmProgress read_progress(Reader& in, const Header& h) {
  FilmProgress read{
      h.items, h.samples_per_pixel, {}, h.render_time_s, {}, {}, (h.options & option_adaptive) != 0, {}};
  in.read_array(read.earlier_ends, h.earlier_ends, "earlier ends");
  const auto not_ascending = [](std::uint32_t a, std::uint32_t b) { return a >= b; };
  if (std::ranges::adjacent_find(read.earlier_ends, not_ascending) != read.earlier_ends.end() ||
      (!read.earlier_ends.empty() && read.earlier_ends.back() >= h.samples_per_pixel))
    in.fail("the film file is corrupt: it continues from more samples than it has");
  in.read_array(read.about, h.about_bytes, "description");
  in.read_array(read.done, words_of(h.items), "progress");
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
    const std::vector<char> text = text_of(groups);
    write_array(out, std::array{GroupsHeader{groups.lights, static_cast<std::uint32_t>(groups.names.size()),
                                             static_cast<std::uint32_t>(text.size())}});
    write_array(out, text);
  }
  if (film.settings_.working_gamma != 1) write_array(out, std::array{film.settings_.working_gamma});
  write_array(out, progress.earlier_ends);
  write_array(out, progress.about);
  write_array(out, progress.done);
  write_array(out, film.sums_);
  write_array(out, film.counts_);
  write_array(out, film.ids_);
  if (!film.mattes_.empty()) write_array(out, film.mattes_);
  if (!progress.more.empty()) write_array(out, progress.more);
  out.commit();
}

Film read_film(const std::filesystem::path& file, FilmProgress* progress) {
  Reader in(file);
  const Header h = read_header(in);
  const LightGroups groups = read_groups(in, h);
  const Arrays arrays(h, groups);
  check_size(in, h, arrays);
  const PhotonKey photons = read_photons(in, h);
  const double working_gamma = read_working_gamma(in, h);
  FilmProgress read = read_progress(in, h);
  Film film;
  film.settings_.crop = {h.x0, h.x1, h.y0, h.y1};
  film.settings_.width = h.full_width, film.settings_.height = h.full_height;
  film.settings_.imaging_ratio = h.imaging_ratio;
  film.settings_.spectrum = {h.bins, h.bins_min_nm, h.bins_max_nm};
  film.settings_.layers = arrays.layers;
  film.settings_.working_gamma = working_gamma;
  film.key_ = key_of(h, photons, groups);
  film.exponent_ = h.exponent, film.length_exponent_ = h.length_exponent;
  film.refused_ = {h.nonfinite, h.too_large};
  in.read_array(film.sums_, arrays.planes * arrays.pixels + single_sums(film.key_), "sums");
  in.read_array(film.counts_, sample_groups * arrays.pixels, "counts");
  in.read_array(film.ids_, id_planes(arrays.layers) * arrays.pixels, "ids");
  if (matte_planes(arrays.layers) > 0)
    in.read_array(film.mattes_, matte_planes(arrays.layers) * arrays.pixels, "mattes");
  if (!std::ranges::all_of(film.mattes_, makes_sense))
    in.fail("the film file is corrupt: its mattes make no sense");
  if (arrays.open_round) in.read_array(read.more, arrays.pixels, "open round");
  if (progress) *progress = std::move(read);
  return film;
}

}  // namespace vitrail
