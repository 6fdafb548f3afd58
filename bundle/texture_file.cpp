// SPDX-License-Identifier: Apache-2.0
#include "bundle/texture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>

#include "bundle/checksum.h"
#include "bundle/features.h"
#include "bundle/light_code.h"
#include "bundle/texture_layout.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::uint32_t ceil_div(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file) : file_(file) {
    if (!file_.is_open())
      throw MachineError(fmt::format("cannot open {}: {}", file.string(), std::strerror(file_.reason())));
  }

  std::uint64_t size() const { return file_.size(); }
  // False where the file ends before.
  bool read(void* to, std::uint64_t bytes, std::uint64_t offset) const {
    return file_.read({static_cast<std::byte*>(to), bytes}, offset);
  }

 private:
  RegularFile file_;
};

// Of some files the descriptor stays open, so that a tile is one pread: those that were read last, one a
// place.
class OpenFiles {
 public:
  using Kept = std::shared_ptr<const OpenFile>;

  // The file with this name and content, opened if it is not kept.
  Kept get(const std::filesystem::path& file, std::uint64_t hash) {
    Place& place = place_of(file);
    {
      const std::lock_guard lock(place.mutex);
      if (place.open && place.hash == hash && place.file.native() == file.native()) return place.open;
    }
    Kept open = std::make_shared<const OpenFile>(file);
    keep(file, hash, open);
    return open;
  }
  void keep(const std::filesystem::path& file, std::uint64_t hash, Kept open) {
    Place& place = place_of(file);
    const std::lock_guard lock(place.mutex);
    place.file = file;
    place.hash = hash;
    place.open.swap(open);
  }

 private:
  struct Place {
    std::mutex mutex;
    std::filesystem::path file;
    std::uint64_t hash = 0;  // TextureFile's
    Kept open;
  };
  Place& place_of(const std::filesystem::path& file) {
    return places_[std::hash<std::string>()(file.native()) % places_.size()];
  }
  std::array<Place, 128> places_;
};

OpenFiles& open_files() {
  static OpenFiles files;
  return files;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error("damaged texture file: " + what, {file.string()});
}

}  // namespace

std::uint64_t header_checksum(TextureHeader header, std::span<const std::uint64_t> table,
                              std::span<const float> values) {
  header.checksum = 0;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&header, 1)));
  hasher.add(std::as_bytes(table));
  hasher.add(std::as_bytes(values));
  return hasher.digest();
}

TilePlace place_of(TexelFormat format, const TextureLevel& level, std::uint32_t tile_x,
                   std::uint32_t tile_y) {
  const std::uint32_t x = tile_x * tile_width(format), y = tile_y * tile_height(format);
  const std::uint32_t width = std::min(tile_width(format), level.width - x);
  const std::uint32_t height = std::min(tile_height(format), level.height - y);
  const std::uint64_t texels_before =
      static_cast<std::uint64_t>(y) * level.width + static_cast<std::uint64_t>(x) * height;
  const std::uint64_t each = bytes_per_texel(format);
  return {width, height, level.offset + texels_before * each, each * width * height};
}

std::uint32_t texture_level_count(std::uint32_t width, std::uint32_t height) {
  std::uint32_t levels = 1;
  for (std::uint32_t size = std::max(width, height); size > 1; size /= 2) ++levels;
  return levels;
}

TextureFileLayout texture_file_layout(const TextureFileInfo& info) {
  TextureFileLayout layout;
  std::uint64_t texels = 0;
  for (std::uint32_t l = 0; l < info.levels; ++l) {
    TextureLevel level{std::max(info.width >> l, 1u), std::max(info.height >> l, 1u)};
    level.tiles_x = ceil_div(level.width, tile_width(info.format));
    level.tiles_y = ceil_div(level.height, tile_height(info.format));
    level.first_tile = layout.tiles;
    level.offset = texels * bytes_per_texel(info.format);
    texels += static_cast<std::uint64_t>(level.width) * level.height;
    layout.tiles += static_cast<std::uint64_t>(level.tiles_x) * level.tiles_y;
    layout.levels.push_back(level);
  }
  const std::uint64_t start = sizeof(TextureHeader) + layout.tiles * sizeof(std::uint64_t) +
                              (is_coded(info.format) ? code_count * sizeof(float) : 0);
  for (TextureLevel& level : layout.levels) level.offset += start;
  layout.file_bytes = start + texels * bytes_per_texel(info.format);
  return layout;
}

TextureFile::TextureFile(std::filesystem::path file) : file_(std::move(file)) {
  const auto open = std::make_shared<const OpenFile>(file_);
  const OpenFile& in = *open;
  TextureHeader header;
  if (!in.read(&header, sizeof header, 0)) fail(file_, "it is shorter than its header");
  if (header.magic != texture_magic) fail(file_, "it does not begin as one");
  if (header.version != texture_version)
    fail(file_, fmt::format("version {} is not known, only {}", header.version, texture_version));
  info_ = header.info;
  const bool known = static_cast<std::uint32_t>(info_.format) < texel_format_count;
  const bool sized = info_.width >= 1 && info_.width <= max_texture_size && info_.height >= 1 &&
                     info_.height <= max_texture_size;
  if (!known || !sized || info_.levels < 1 || info_.levels > texture_level_count(info_.width, info_.height))
    fail(file_, "its header makes no sense");
  layout_ = texture_file_layout(info_);
  if (header.tiles != layout_.tiles || header.file_bytes != layout_.file_bytes ||
      in.size() != layout_.file_bytes)
    fail(file_, "its size is not what its header says");
  checksums_.resize(layout_.tiles);
  if (!in.read(checksums_.data(), layout_.tiles * sizeof(std::uint64_t), sizeof header))
    fail(file_, "it ends in its table");
  values_.resize(is_coded(info_.format) ? code_count : 0);
  if (!in.read(values_.data(), values_.size() * sizeof(float),
               sizeof header + layout_.tiles * sizeof(std::uint64_t)))
    fail(file_, "it ends in its values");
  hash_ = header_checksum(header, checksums_, values_);
  if (hash_ != header.checksum) fail(file_, "wrong checksum of the header");
  features_ = header.features;
  refuse_unknown(features_.required, required_feature::codes, file_);
  if (!std::ranges::all_of(values_, [](float v) { return std::isfinite(v); }))
    fail(file_, "a value is not finite");
  open_files().keep(file_, hash_, open);
}

TextureFile::Tile TextureFile::read_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y,
                                         std::span<std::uint32_t, max_tile_words> words) const {
  const TextureLevel& of = layout_.levels.at(level);
  const TilePlace place = place_of(info_.format, of, tile_x, tile_y);
  const auto in = open_files().get(file_, hash_);
  const Underway underway("reading", file_);
  // What is shorter in the file is read to the end of the words, and comes to stand before it.
  const std::size_t texels = std::size_t{place.width} * place.height;
  const std::span<std::uint32_t> used = words.first(texels * words_per_texel(info_.format));
  const std::span<std::byte> bytes = std::as_writable_bytes(used).last(place.bytes);
  if (!in->read(bytes.data(), place.bytes, place.offset)) fail(file_, "it has become shorter");
  const std::uint64_t tile = of.first_tile + static_cast<std::uint64_t>(tile_y) * of.tiles_x + tile_x;
  if (checksum(bytes) != checksums_.at(tile))
    fail(file_, fmt::format("wrong checksum of tile {}, {} of level {} (bytes {} to {})", tile_x, tile_y,
                            level, place.offset, place.offset + place.bytes));
  expand(bytes, used);
  return {place.width, place.height, used.size()};
}

// From the first on: a texel is written where none is left to read, or itself.
void TextureFile::expand(std::span<const std::byte> codes, std::span<std::uint32_t> words) const {
  const auto* const c = reinterpret_cast<const unsigned char*>(codes.data());
  if (info_.format == TexelFormat::number_code || info_.format == TexelFormat::band_code)
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = std::bit_cast<std::uint32_t>(values_[c[i]]);
  if (info_.format == TexelFormat::color_code)
    for (std::size_t i = 0; i < words.size() / 2; ++i) {
      const std::uint32_t word = color_code_word(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
      words[2 * i] = 0;
      words[2 * i + 1] = word;
    }
  if (info_.format == TexelFormat::light_code)
    for (std::size_t i = 0; i < words.size() / 3; ++i) {
      const std::uint32_t word = color_code_word(c[3 * i], c[3 * i + 1], c[3 * i + 2]);
      words[3 * i] = words[3 * i + 1] = 0;
      words[3 * i + 2] = word;
    }
  if (info_.format == TexelFormat::light_code_16)
    for (std::size_t i = 0; i < words.size() / 3; ++i) {
      LightCodes of{};
      for (std::size_t k = 0; k < 3; ++k) of[k] = c[6 * i + 2 * k] | c[6 * i + 2 * k + 1] << 8;
      std::ranges::copy(words_of_codes(of), &words[3 * i]);
    }
}

void TextureFile::check_tiles() const {
  std::uint64_t wrong = 0;
  std::string first;
  std::array<std::uint32_t, max_tile_words> words;
  for (std::uint32_t l = 0; l < info_.levels; ++l)
    for (std::uint32_t y = 0; y < layout_.levels[l].tiles_y; ++y)
      for (std::uint32_t x = 0; x < layout_.levels[l].tiles_x; ++x) try {
          read_tile(l, x, y, words);
        } catch (const Error& e) {
          if (wrong++ == 0) first = e.what();
        }
  if (wrong > 0)
    throw Error(wrong == 1 ? first : fmt::format("{}, and {} more", first, wrong - 1), {file_.string()});
}

}  // namespace vitrail
