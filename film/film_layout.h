// SPDX-License-Identifier: Apache-2.0
// The bytes of a film file, for those who read and write it. docs/why/color-and-film.md has them one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/film.h"

namespace vitrail::film_layout {

inline constexpr char film_magic[8] = {'v', 'i', 't', 'f', 'i', 'l', 'm', '\n'};
// Of the last two, what photons its samples gathered, or which lights it keeps apart, follows the header.
inline constexpr std::uint32_t film_version = 4, adaptive_version = 5, photon_version = 7, groups_version = 8;

// What a film was rendered with, in Header::options.
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

// Of a film that keeps groups of lights: followed by their names, each with a zero behind it.
struct GroupsHeader {
  std::uint64_t lights;
  std::uint32_t groups, text_bytes;
};
inline constexpr std::uint32_t most_text_bytes = 1 << 20;
std::vector<char> text_of(const LightGroups& groups);
GroupsHeader header_of(const LightGroups& groups);

// Of the header, without that field.
std::uint64_t checksum(const Header& h);

// What a header that makes sense says of the arrays behind it: their elements. Of the last two there is no
// array where there are none.
struct Arrays {
  FilmLayers layers;
  std::uint64_t done, sums, counts, ids, mattes, more;
};
// `groups`: of lights.
Arrays arrays_of(const Header& h, std::uint64_t groups);

// Bytes of each array in the order of the file, the light groups' and the photons' first. The checksum that
// follows each is not counted. `groups` is 0 where the film has none.
std::vector<std::uint64_t> bytes_of_arrays(const Header& h, const GroupsHeader& groups);

}  // namespace vitrail::film_layout
