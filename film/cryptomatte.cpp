// SPDX-License-Identifier: Apache-2.0
#include "film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "film/develop.h"

namespace vitrail {

// Appleby, MurmurHash3, 2011: the variant of 32 bits.
std::uint32_t murmur_hash(std::string_view text) {
  constexpr std::uint32_t c1 = 0xcc9e2d51, c2 = 0x1b873593;
  const auto mixed = [](std::uint32_t k) { return std::rotl(k * c1, 15) * c2; };
  std::uint32_t hash = 0;
  const std::size_t blocks = text.size() / 4;
  for (std::size_t i = 0; i < blocks; ++i) {
    std::uint32_t block;
    std::memcpy(&block, text.data() + 4 * i, sizeof block);
    hash = std::rotl(hash ^ mixed(block), 13) * 5 + 0xe6546b64;
  }
  std::uint32_t tail = 0;
  for (std::size_t i = text.size(); i > 4 * blocks; --i)
    tail = tail << 8 | static_cast<unsigned char>(text[i - 1]);
  hash ^= mixed(tail);
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6b;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35;
  return hash ^ hash >> 16;
}

std::uint32_t matte_id(std::string_view name) {
  const std::uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 0xff;
  return exponent == 0 || exponent == 0xff ? hash ^ 1u << 23 : hash;
}

std::string matte_manifest(std::span<const std::string> names) {
  nlohmann::json manifest = nlohmann::json::object();
  for (const std::string& name : names) manifest[name] = fmt::format("{:08x}", matte_id(name));
  return manifest.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

struct Covered {
  std::uint32_t id = 0;
  std::int64_t sum = 0;
};

// The greatest first.
std::vector<Covered> ranked(const MattePixel& pixel) {
  std::vector<Covered> things;
  for (std::size_t i = 0; i < most_mattes && pixel.ids[i] != 0; ++i)
    if (pixel.sums[i] > 0) things.push_back({pixel.ids[i], pixel.sums[i]});
  std::ranges::stable_sort(things, std::greater{}, &Covered::sum);
  return things;
}

}  // namespace

std::size_t things_of(const MattePixel& pixel) { return ranked(pixel).size(); }

std::vector<PictureChannel> matte_channels(const Film& film, Layer layer, std::size_t most) {
  std::vector<PictureChannel> channels;
  for (std::size_t i = 0; i < 2 * ((most + 1) / 2); ++i)
    for (const char part : {"RB"[i % 2], "GA"[i % 2]})
      channels.push_back({fmt::format("{}{:02}.{}", kind_of(layer).channels[0], i / 2, part),
                          false,
                          std::vector<float>(film.pixels()),
                          {}});
  for (std::uint32_t p = 0; p < film.pixels(); ++p) {
    const std::vector<Covered> things = ranked(film.matte(p, layer));
    for (std::size_t i = 0; i < things.size(); ++i) {
      channels[2 * i].values[p] = std::bit_cast<float>(things[i].id);
      channels[2 * i + 1].values[p] = static_cast<float>(film.coverage(p, things[i].sum));
    }
  }
  return channels;
}

}  // namespace vitrail
