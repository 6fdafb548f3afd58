// SPDX-License-Identifier: Apache-2.0
#include "film/film_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "scene/records/film_extent.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

using namespace film_layout;

FilmReader::FilmReader(const std::filesystem::path& file) : path_(file), in_(file) {
  if (!in_.is_open()) fail(fmt::format("cannot open the film: {}", std::strerror(in_.reason())));
}

void FilmReader::fail(const std::string& what) const { throw Error(what, {path_.string()}); }

void FilmReader::read(void* to, std::uint64_t bytes) {
  if (!in_.read(std::span(static_cast<std::byte*>(to), bytes), place_)) fail("the film file is truncated");
  place_ += bytes;
}

void FilmReader::require_checksum(std::uint64_t sum, const char* what) {
  std::uint64_t expected;
  read(&expected, sizeof expected);
  if (sum != expected) fail(fmt::format("the film file is corrupt: the checksum of its {} is wrong", what));
}

namespace {

bool in_range(std::int32_t exponent) { return least_exponent <= exponent && exponent <= greatest_exponent; }

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

Header read_header(FilmReader& in) {
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
LightGroups read_groups(FilmReader& in, const Header& h) {
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

// Throws unless the file has as many bytes as its header says.
void check_size(const FilmReader& in, const Header& h, const LightGroups& groups) {
  std::uint64_t bytes = sizeof h;
  for (const std::uint64_t array : bytes_of_arrays(h, header_of(groups))) bytes += array + sizeof h.checksum;
  if (in.size() != bytes)
    in.fail(fmt::format("the film file is truncated or has bytes too many: {} bytes", in.size()));
}

// Without photons where the film has none.
PhotonKey read_photons(FilmReader& in, const Header& h) {
  if (h.version != photon_version) return {};
  std::vector<PhotonKey> photons;
  in.read_array(photons, 1, "photons");
  if (photons[0].photons == 0 || !(photons[0].first_radius > 0) || !std::isfinite(photons[0].first_radius) ||
      !(photons[0].alpha > 0) || !std::isfinite(photons[0].alpha))
    in.fail("the film file is corrupt: its photons make no sense");
  return photons[0];
}

double read_working_gamma(FilmReader& in, const Header& h) {
  if ((h.options & option_working_gamma) == 0) return 1;
  std::vector<double> gamma;
  in.read_array(gamma, 1, "working gamma");
  if (!(gamma[0] >= 0) || !std::isfinite(gamma[0]))
    in.fail("the film file is corrupt: its working gamma makes no sense");
  return gamma[0];
}

// All but `more`, which comes last.
FilmProgress read_progress(FilmReader& in, const Header& h, const Arrays& arrays) {
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

FilmHead read_head(FilmReader& in) {
  const Header h = read_header(in);
  const LightGroups groups = read_groups(in, h);
  check_size(in, h, groups);
  const PhotonKey photons = read_photons(in, h);
  FilmHead head{
      .settings = {.width = h.full_width, .height = h.full_height, .crop = {h.x0, h.x1, h.y0, h.y1}},
      .key = key_of(h, photons, groups),
      .exponent = h.exponent,
      .length_exponent = h.length_exponent,
      .refused = {h.nonfinite, h.too_large},
      .arrays = arrays_of(h, groups.names.size()),
      .progress = {}};
  head.settings.imaging_ratio = h.imaging_ratio;
  head.settings.spectrum = {h.bins, h.bins_min_nm, h.bins_max_nm};
  head.settings.layers = head.arrays.layers;
  head.settings.working_gamma = read_working_gamma(in, h);
  head.progress = read_progress(in, h, head.arrays);
  return head;
}

}  // namespace vitrail
