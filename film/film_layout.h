// SPDX-License-Identifier: Apache-2.0
// These are the bytes of a film file, for its reader and writer. docs/why/color-and-film.md has each of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/film.h"

namespace vitrail::film_layout {

inline constexpr char film_magic[8] = {'v', 'i', 't', 'f', 'i', 'l', 'm', '\n'};
// The last two have, behind the header, the photons that samples gathered, or the lights kept apart.
inline constexpr std::uint32_t film_version = 4, adaptive_version = 5, photon_version = 7, groups_version = 8;

// Header::options has these bits for what a film was rendered with.
inline constexpr std::uint32_t option_direct_only = 1, option_straight_counts = 2, option_camera_space = 4,
                               option_adaptive = 8, option_open_round = 16, option_splats = 32,
                               option_one_sequence = 64, option_hides_emitters = 128,
                               option_working_gamma = 256;
inline constexpr std::uint32_t threshold_bits = 0xffff0000;  // the upper half of a float
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

// A film that keeps groups of lights has a GroupsHeader, then their names, each with a zero behind it.
struct GroupsHeader {
  std::uint64_t lights;
  std::uint32_t groups, text_bytes;
};
inline constexpr std::uint32_t most_text_bytes = 1 << 20;
std::vector<char> text_of(const LightGroups& groups);
GroupsHeader header_of(const LightGroups& groups);

// Returns the checksum of the header without that field.
std::uint64_t checksum(const Header& h);

// Arrays holds the numbers of elements that a valid header says the arrays behind it have. The file has no
// arrays of mattes or of `more` where there are none.
struct Arrays {
  FilmLayers layers;
  std::uint64_t done, sums, counts, ids, mattes, more;
};
// `groups` is the number of groups of lights.
Arrays arrays_of(const Header& h, std::uint64_t groups);

// Returns the bytes of each array in the order of the file, those of light groups and photons first. The
// checksum that follows each is not counted. `groups` is 0 where the film has none.
std::vector<std::uint64_t> bytes_of_arrays(const Header& h, const GroupsHeader& groups);

}  // namespace vitrail::film_layout
