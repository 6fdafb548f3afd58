// SPDX-License-Identifier: Apache-2.0
#include "images/ptex_file.h"

// Its conversion is in the header then, and needs no library.
#define IMATH_HALF_NO_LOOKUP_TABLE
#include <Imath/half.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little, "as the file has it");

// As they stand in the file.
struct FaceInfo {
  std::uint8_t log2_width, log2_height, edges, flags;
  std::array<std::uint32_t, 4> neighbours;
};
static_assert(sizeof(FaceInfo) == 20);
struct LevelInfo {
  std::uint64_t bytes;
  std::uint32_t header_bytes, faces;
};
static_assert(sizeof(LevelInfo) == 16);

constexpr std::uint8_t constant_flag = 1;
constexpr int greatest_log2 = 14;
constexpr std::uint64_t most_values = 1u << 28;  // of a face that is not constant

// Of a block of texels: its size in the lower 30 bits of a word, and above them how it is encoded.
enum class Encoded : std::uint32_t { constant, zipped, differences, tiled };
std::uint32_t size_of(std::uint32_t block) { return block & 0x3fffffffu; }
Encoded encoding_of(std::uint32_t block) { return Encoded{block >> 30}; }

constexpr std::array<std::size_t, 4> bytes_of_type{1, 2, 2, 4};  // uint8, uint16, half, float

// What is not finite is not a number here, with its sign.
float value_of_half(std::uint16_t bits) {
  Imath::half value;
  value.setBits(bits);
  return value.isFinite() ? static_cast<float>(value) : std::copysign(NAN, value.isNegative() ? -1.0f : 1.0f);
}

template <class T>
T word(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

float number(const unsigned char* at, std::uint32_t type) {
  const double value = type == 0   ? *at / 255.0
                       : type == 1 ? word<std::uint16_t>(at) / 65535.0
                       : type == 2 ? static_cast<double>(value_of_half(word<std::uint16_t>(at)))
                                   : static_cast<double>(word<float>(at));
  return static_cast<float>(value);
}

// Each but the first is the difference from the one before it.
template <class T>
void add_up(std::vector<unsigned char>& bytes) {
  T sum = 0;
  for (std::size_t i = 0; i + sizeof(T) <= bytes.size(); i += sizeof(T)) {
    sum = static_cast<T>(sum + word<T>(&bytes[i]));
    std::memcpy(&bytes[i], &sum, sizeof sum);
  }
}

}  // namespace

// As it stands in the file.
struct PtexFile::Header {
  std::array<char, 4> magic;
  std::uint32_t version, mesh_type, data_type, alpha_channel;
  std::uint16_t channels, levels;
  std::uint32_t faces, extended_header_bytes, face_info_bytes, means_bytes, level_info_bytes, minor_version;
  std::uint64_t level_data_bytes;
  std::uint32_t meta_data_zip_bytes, meta_data_bytes;
};

void PtexFile::fail(const char* why) const {
  throw Error(fmt::format("cannot read {}: {}", file_.string(), why));
}

std::vector<unsigned char> PtexFile::bytes(std::uint64_t at, std::uint64_t count) {
  if (at > file_bytes_ || count > file_bytes_ - at) fail("it ends too early");
  std::vector<unsigned char> read(count);
  in_.seekg(static_cast<std::streamoff>(at));
  if (!in_.read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(count)))
    fail("it ends too early");
  return read;
}

std::vector<unsigned char> PtexFile::unzipped(std::uint64_t at, std::uint64_t zipped, std::uint64_t size) {
  constexpr std::uint64_t greatest_expansion = 1032;  // of zlib's deflate
  if (size > greatest_expansion * zipped) fail("its zipped parts are damaged");
  const std::vector<unsigned char> packed = bytes(at, zipped);
  std::vector<unsigned char> result(size);
  uLongf unpacked = static_cast<uLongf>(size);
  if (uncompress(result.data(), &unpacked, packed.data(), static_cast<uLong>(zipped)) != Z_OK ||
      unpacked != size)
    fail("its zipped parts are damaged");
  return result;
}

PtexFile::Header PtexFile::read_header() {
  static_assert(sizeof(Header) == 64);
  Header h;
  if (!in_.read(reinterpret_cast<char*>(&h), sizeof h) || std::string_view(h.magic.data(), 4) != "Ptex")
    fail("it is no Ptex file");
  if (h.version != 1) fail("its version is not 1");
  if (h.mesh_type > 1 || h.data_type > 3 || h.channels == 0 || h.faces == 0) fail("its header is damaged");
  return h;
}

void PtexFile::read_means(std::uint64_t at, const Header& h) {
  const std::size_t size = bytes_of_type[type_], count = h.faces * channels_;
  const std::vector<unsigned char> means = unzipped(at, h.means_bytes, count * size);
  for (std::size_t i = 0; i < count; ++i) means_.push_back(number(&means[i * size], type_));
}

std::vector<std::uint32_t> PtexFile::read_blocks(std::uint64_t& at, const Header& h) {
  const std::vector<unsigned char> levels = bytes(at, h.level_info_bytes);
  at += h.level_info_bytes;
  const LevelInfo finest = levels.size() < sizeof(LevelInfo) ? LevelInfo{} : word<LevelInfo>(levels.data());
  if (finest.faces != 0 && finest.faces != h.faces) fail("its levels are damaged");
  std::vector<std::uint32_t> blocks(finest.faces);
  if (!blocks.empty()) {
    const std::vector<unsigned char> words = unzipped(at, finest.header_bytes, 4 * std::uint64_t{h.faces});
    std::memcpy(blocks.data(), words.data(), words.size());
  }
  at += finest.header_bytes;
  return blocks;
}

void PtexFile::place_faces(const std::vector<unsigned char>& infos, const std::vector<std::uint32_t>& blocks,
                           std::uint64_t at) {
  for (std::size_t i = 0; i < infos.size() / sizeof(FaceInfo); ++i) {
    const auto info = word<FaceInfo>(&infos[i * sizeof(FaceInfo)]);
    if (info.log2_width > greatest_log2 || info.log2_height > greatest_log2) fail("its faces are damaged");
    Face& face = faces_.emplace_back(Face{1u << info.log2_width, 1u << info.log2_height});
    face.constant = blocks.empty() || (info.flags & constant_flag) != 0;
    if (!face.constant && std::uint64_t{face.width} * face.height * channels_ > most_values)
      fail("a face is too large");
    face.at = at;
    if (!blocks.empty()) face.block = blocks[i];
    at += size_of(face.block);
  }
}

PtexFile::PtexFile(const std::filesystem::path& file) : file_(file), in_(open_input(file)) {
  std::error_code unknown;
  file_bytes_ = std::filesystem::file_size(file, unknown);
  if (!in_ || unknown) fail("there is no such file");
  const Header h = read_header();
  type_ = h.data_type, channels_ = h.channels, of_triangles_ = h.mesh_type == 0;
  std::uint64_t at = sizeof h + std::uint64_t{h.extended_header_bytes};
  const std::vector<unsigned char> infos =
      unzipped(at, h.face_info_bytes, sizeof(FaceInfo) * std::uint64_t{h.faces});
  at += h.face_info_bytes;
  read_means(at, h);
  at += h.means_bytes;
  const std::vector<std::uint32_t> blocks = read_blocks(at, h);
  place_faces(infos, blocks, at);
}

// [texel][channel]; the file has all of a channel together.
std::vector<float> PtexFile::block(std::uint64_t at, std::uint32_t block, std::size_t texels) {
  const std::size_t size = bytes_of_type[type_];
  const Encoded encoded = encoding_of(block);
  const bool one = encoded == Encoded::constant;
  if (encoded == Encoded::tiled || (one && size_of(block) != channels_ * size)) fail("its faces are damaged");
  std::vector<unsigned char> packed =
      one ? bytes(at, size_of(block)) : unzipped(at, size_of(block), texels * channels_ * size);
  if (encoded == Encoded::differences && type_ == 0) add_up<std::uint8_t>(packed);
  if (encoded == Encoded::differences && type_ == 1) add_up<std::uint16_t>(packed);
  std::vector<float> values(texels * channels_);
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t c = 0; c < channels_; ++c)
      values[i * channels_ + c] = number(&packed[(one ? c : c * texels + i) * size], type_);
  return values;
}

std::vector<float> PtexFile::tiles(const Face& face) {
  struct [[gnu::packed]] TileHeader {
    std::uint8_t log2_width, log2_height;
    std::uint32_t sizes_bytes;
  };
  const auto h = word<TileHeader>(bytes(face.at, sizeof(TileHeader)).data());
  const std::size_t width = face.width, height = face.height;
  if (h.log2_width > greatest_log2 || h.log2_height > greatest_log2 || width >> h.log2_width == 0 ||
      height >> h.log2_height == 0)
    fail("its tiles are damaged");
  const std::size_t tile_width = std::size_t{1} << h.log2_width,
                    tile_height = std::size_t{1} << h.log2_height, across = width / tile_width,
                    count = across * (height / tile_height);
  std::uint64_t at = face.at + sizeof h;
  const std::vector<unsigned char> sizes = unzipped(at, h.sizes_bytes, 4 * count);
  at += h.sizes_bytes;
  std::vector<float> values(width * height * channels_);
  for (std::size_t i = 0; i < count; ++i) {
    const auto tile_block = word<std::uint32_t>(&sizes[4 * i]);
    const std::vector<float> tile = block(at, tile_block, tile_width * tile_height);
    at += size_of(tile_block);
    const std::size_t x = i % across * tile_width, y = i / across * tile_height;
    for (std::size_t row = 0; row < tile_height; ++row)
      std::copy_n(&tile[row * tile_width * channels_], tile_width * channels_,
                  &values[((y + row) * width + x) * channels_]);
  }
  return values;
}

std::vector<float> PtexFile::texels(std::size_t i) {
  const Face& face = faces_.at(i);
  const std::size_t count = std::size_t{face.width} * face.height;
  if (!face.constant)
    return encoding_of(face.block) == Encoded::tiled ? tiles(face) : block(face.at, face.block, count);
  std::vector<float> values;
  values.reserve(count * channels_);
  for (std::size_t k = 0; k < count; ++k)
    values.insert(values.end(), &means_[i * channels_], &means_[i * channels_] + channels_);
  return values;
}

}  // namespace vitrail
