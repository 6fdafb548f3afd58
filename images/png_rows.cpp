// SPDX-License-Identifier: Apache-2.0
#include "images/png_rows.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>
#include <vector>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

constexpr std::array<std::uint8_t, 8> png_signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};

std::uint32_t big_endian(const std::uint8_t* b) {
  return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
}

struct PngChunk {
  std::uint32_t bytes = 0;
  std::array<std::uint8_t, 4> type{};
  bool is(std::string_view name) const { return std::equal(type.begin(), type.end(), name.begin()); }
};

// The chunks of a file, one after the other.
class PngChunks {
 public:
  explicit PngChunks(const std::filesystem::path& file) : in_(open_input(file)) {}

  bool read(void* to, std::size_t bytes) {
    in_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    return in_.good();
  }
  std::optional<PngChunk> next() {
    std::array<std::uint8_t, 8> head;
    if (!read(head.data(), head.size())) return {};
    PngChunk chunk{big_endian(head.data()), {}};
    std::copy_n(head.begin() + 4, 4, chunk.type.begin());
    return chunk.bytes >> 31 ? std::nullopt : std::optional(chunk);
  }
  // With its checksum.
  void skip(const PngChunk& chunk) { in_.seekg(std::streamoff{chunk.bytes} + 4, std::ios::cur); }

 private:
  std::ifstream in_;
};

struct PngHeader {
  int width = 0, height = 0, channels = 0;
};

int channels_of_type(std::uint8_t type) {
  switch (type) {
    case 0:
      return 1;
    case 2:
      return 3;
    case 4:
      return 2;
    case 6:
      return 4;
    default:
      return 0;  // a palette
  }
}

// Reads to the first chunk of pixels.
std::optional<PngHeader> plain_header(PngChunks& chunks, PngChunk& first) {
  std::array<std::uint8_t, 8> start;
  if (!chunks.read(start.data(), start.size()) || start != png_signature) return {};
  std::array<std::uint8_t, 17> ihdr;  // with its checksum
  const auto chunk = chunks.next();
  if (!chunk || !chunk->is("IHDR") || chunk->bytes != 13 || !chunks.read(ihdr.data(), ihdr.size())) return {};
  const std::uint32_t width = big_endian(&ihdr[0]), height = big_endian(&ihdr[4]);
  const int channels = channels_of_type(ihdr[9]);
  const bool plain = ihdr[8] == 8 && channels > 0 && ihdr[10] == 0 && ihdr[11] == 0 && ihdr[12] == 0;
  const bool sized = width >= 1 && height >= 1 && width <= max_image_extent && height <= max_image_extent &&
                     std::uint64_t{width} * height <= most_image_pixels;
  if (!plain || !sized) return {};
  while (const auto next = chunks.next()) {
    if (next->is("tRNS")) return {};
    if (next->is("IDAT")) {
      first = *next;
      return PngHeader{static_cast<int>(width), static_cast<int>(height), channels};
    }
    chunks.skip(*next);
  }
  return {};
}

// The bytes that all chunks of pixels together hold.
class PngInflater {
 public:
  PngInflater(PngChunks& chunks, const PngChunk& first)
      : chunks_(chunks), left_(first.bytes), input_(1 << 16) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
    sum_ = crc_of_type(first);
  }
  ~PngInflater() { inflateEnd(&stream_); }
  PngInflater(const PngInflater&) = delete;
  PngInflater& operator=(const PngInflater&) = delete;

  // What is wrong, or null.
  const char* read(std::span<std::uint8_t> to) {
    stream_.next_out = to.data();
    stream_.avail_out = static_cast<uInt>(to.size());
    while (stream_.avail_out > 0) {
      if (stream_.avail_in == 0)
        if (const char* problem = more()) return problem;
      const int result = inflate(&stream_, Z_NO_FLUSH);
      ended_ = result == Z_STREAM_END;
      if (ended_ && stream_.avail_out > 0) return "it has too few pixels";
      if (result != Z_OK && result != Z_STREAM_END) return "its pixels are damaged";
    }
    return nullptr;
  }

  // After the last pixel: the checksum of all of them, and that of their last chunk. More pixels are not
  // looked at.
  const char* finish() {
    std::uint8_t more_than_all = 0;
    stream_.next_out = &more_than_all, stream_.avail_out = 1;
    int result = ended_ ? Z_STREAM_END : Z_OK;
    while (result == Z_OK && stream_.avail_out > 0) {
      if (stream_.avail_in == 0)
        if (const char* problem = more()) return problem;
      result = inflate(&stream_, Z_NO_FLUSH);
    }
    if (result != Z_OK && result != Z_STREAM_END) return "its pixels are damaged";
    while (left_ > 0)
      if (const char* problem = more()) return problem;
    std::array<std::uint8_t, 4> stated;
    if (!chunks_.read(stated.data(), stated.size())) return "it ends too early";
    return big_endian(stated.data()) == sum_ ? nullptr : "a checksum of its pixels is wrong";
  }

 private:
  static uLong crc_of_type(const PngChunk& chunk) { return crc32(0, chunk.type.data(), 4); }

  const char* more() {
    while (left_ == 0) {
      std::array<std::uint8_t, 4> stated;
      if (!chunks_.read(stated.data(), stated.size())) return "it ends too early";
      if (big_endian(stated.data()) != sum_) return "a checksum of its pixels is wrong";
      const auto chunk = chunks_.next();
      if (!chunk || !chunk->is("IDAT")) return "it has too few pixels";
      left_ = chunk->bytes, sum_ = crc_of_type(*chunk);
    }
    const std::size_t now = std::min<std::size_t>(left_, input_.size());
    if (!chunks_.read(input_.data(), now)) return "it ends too early";
    sum_ = crc32(sum_, input_.data(), static_cast<uInt>(now));
    left_ -= static_cast<std::uint32_t>(now);
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(now);
    return nullptr;
  }

  PngChunks& chunks_;
  std::uint32_t left_;  // of the chunk
  uLong sum_ = 0;
  std::vector<std::uint8_t> input_;
  z_stream stream_{};
  bool ended_ = false;
};

// Clause 9.4 of the standard.
std::uint8_t paeth(int a, int b, int c) {
  const int pa = std::abs(b - c), pb = std::abs(a - c), pc = std::abs(a + b - 2 * c);
  const int least = pa <= pb ? a : b;
  return static_cast<std::uint8_t>(std::min(pa, pb) <= pc ? least : c);
}

// Takes the filter from a row of pixels of `step` bytes; `above` is the row before it, or zeros. False for a
// filter that is none.
bool unfilter(std::uint8_t filter, std::span<std::uint8_t> row, const std::uint8_t* above, std::size_t step) {
  const std::size_t n = row.size();
  std::uint8_t* const r = row.data();
  const auto sum = [](int a, int b) { return static_cast<std::uint8_t>(a + b); };
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (std::size_t i = step; i < n; ++i) r[i] = sum(r[i], r[i - step]);
      return true;
    case 2:
      for (std::size_t i = 0; i < n; ++i) r[i] = sum(r[i], above[i]);
      return true;
    case 3:
      for (std::size_t i = 0; i < n; ++i) r[i] = sum(r[i], ((i < step ? 0 : r[i - step]) + above[i]) / 2);
      return true;
    case 4:
      for (std::size_t i = 0; i < std::min(step, n); ++i) r[i] = sum(r[i], above[i]);
      for (std::size_t i = step; i < n; ++i) r[i] = sum(r[i], paeth(r[i - step], above[i], above[i - step]));
      return true;
    default:
      return false;
  }
}

void read_png(const std::filesystem::path& file,
              const std::function<void(std::span<const std::uint8_t>)>& visit) {
  const auto fail = [&](const char* problem) {
    throw Error(fmt::format("cannot read the image: {}", problem), {file.string()});
  };
  PngChunks chunks(file);
  PngChunk first;
  const auto header = plain_header(chunks, first);
  if (!header) fail("it has changed");
  const auto step = static_cast<std::size_t>(header->channels);
  const std::size_t bytes = step * static_cast<std::size_t>(header->width);
  PngInflater pixels(chunks, first);
  std::vector<std::uint8_t> row(1 + bytes), above(1 + bytes);
  for (int y = 0; y < header->height; ++y) {
    if (const char* problem = pixels.read(row)) fail(problem);
    const std::span<std::uint8_t> values = std::span(row).subspan(1);
    if (!unfilter(row[0], values, above.data() + 1, step)) fail("its pixels are damaged");
    visit(values);
    std::swap(row, above);
  }
  if (const char* problem = pixels.finish()) fail(problem);
}

}  // namespace

std::optional<ByteRows> png_rows(const std::filesystem::path& file) {
  PngChunks chunks(file);
  PngChunk first;
  const auto header = plain_header(chunks, first);
  if (!header) return {};
  return ByteRows{header->width, header->height, header->channels,
                  [file](const auto& visit) { read_png(file, visit); }};
}

}  // namespace vitrail
