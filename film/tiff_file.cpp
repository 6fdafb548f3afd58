// SPDX-License-Identifier: Apache-2.0
#include "film/tiff_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "film/fixed_date.h"
#include "film/png_file.h"
#include "film/srgb_integers.h"
#include "film/tiff_directory.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr int strip_rows = 32, channels = 3;

struct Strips {
  std::vector<std::uint64_t> offsets, bytes;
};

// What comes before the strips. With strips of any place and size it is as long.
TiffBytes head_of(const Picture& picture, int bits, const Strips& strips, bool large) {
  using enum TiffDirectory::Type;
  constexpr std::uint64_t deflate = 8, rgb = 2, top_left = 1, together = 1, differences = 2, unsigned_ = 1;
  const auto number = [](int value) { return static_cast<std::uint64_t>(value); };
  const TiffDirectory::Type place = large ? of_64_bits : of_32_bits;
  const std::vector<std::uint64_t> bits_of_each(channels, number(bits)), formats(channels, unsigned_);
  TiffDirectory directory(large);
  directory.number(256, of_32_bits, number(picture.rgb.width));
  directory.number(257, of_32_bits, number(picture.rgb.height));
  directory.numbers(258, of_16_bits, bits_of_each);
  directory.number(259, of_16_bits, deflate);
  directory.number(262, of_16_bits, rgb);
  directory.text(270, comment_on(picture.origin));
  directory.numbers(273, place, strips.offsets);
  directory.number(274, of_16_bits, top_left);
  directory.number(277, of_16_bits, channels);
  directory.number(278, of_16_bits, strip_rows);
  directory.numbers(279, place, strips.bytes);
  directory.number(284, of_16_bits, together);
  const bool is_part = picture.window.x0 > 0 || picture.window.y0 > 0;
  if (is_part) {
    directory.whole(286, static_cast<std::uint32_t>(picture.window.x0));
    directory.whole(287, static_cast<std::uint32_t>(picture.window.y0));
  }
  directory.text(305, picture.origin.software);
  directory.text(306, fixed_date_text());
  directory.number(317, of_16_bits, differences);
  directory.numbers(339, of_16_bits, formats);
  // Of Pixar: the size of the whole.
  if (picture.full_width > picture.rgb.width || picture.full_height > picture.rgb.height) {
    directory.number(33300, of_32_bits, number(picture.full_width));
    directory.number(33301, of_32_bits, number(picture.full_height));
  }
  constexpr std::uint64_t header = 8, large_header = 16;
  TiffBytes head{'I', 'I', static_cast<std::uint8_t>(large ? 43 : 42), 0};
  if (large) put_number(head, 8, 4);  // bytes of a place
  put_number(head, large ? large_header : header, large ? 8 : 4);
  directory.append_to(head, head.size());
  return head;
}

// Each value less that of the pixel before it in the row, byte by byte as the file has them.
template <class Integer>
void append_differences(std::span<const Integer> row, TiffBytes& bytes) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto before = i < channels ? 0 : row[i - channels];
    put_number(bytes, static_cast<Integer>(row[i] - before), sizeof(Integer));
  }
}

std::span<const std::byte> deflated(const TiffBytes& bytes, TiffBytes& room,
                                    const std::filesystem::path& file) {
  uLongf size = ::compressBound(bytes.size());
  room.resize(size);
  if (::compress2(room.data(), &size, bytes.data(), bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw MachineError(fmt::format("cannot write {}: out of memory", file.string()));
  return std::as_bytes(std::span(room).first(size));
}

template <class Integer>
void write_strips(const std::filesystem::path& file, const Picture& picture, std::uint64_t most_bytes) {
  constexpr int bits = 8 * sizeof(Integer);
  const std::size_t values = channels * static_cast<std::size_t>(picture.rgb.width);
  const bool large = picture.rgb.values.size() * sizeof(Integer) > most_bytes;
  const auto count = static_cast<std::size_t>((picture.rgb.height + strip_rows - 1) / strip_rows);
  Strips strips{std::vector<std::uint64_t>(count), std::vector<std::uint64_t>(count)};
  AtomicFile target(file);
  target.write(std::as_bytes(std::span<const std::uint8_t>(head_of(picture, bits, strips, large))));
  const std::span<const float> all(picture.rgb.values);
  std::vector<Integer> row(values);
  TiffBytes strip, room;
  for (std::size_t s = 0; s < count; ++s) {
    const std::size_t first = s * strip_rows * values,
                      end = std::min(first + strip_rows * values, all.size());
    strip.clear();
    for (std::size_t at = first; at < end; at += values) {
      to_srgb_integers<Integer>(all.subspan(at, values), row.data());
      append_differences<Integer>(row, strip);
    }
    const auto bytes = deflated(strip, room, file);
    strips.offsets[s] = target.size(), strips.bytes[s] = bytes.size();
    target.write(bytes);
  }
  target.write_at(0, std::as_bytes(std::span<const std::uint8_t>(head_of(picture, bits, strips, large))));
  target.commit();
}

}  // namespace

void write_tiff(const std::filesystem::path& file, const Picture& picture, int bits,
                std::uint64_t most_bytes) {
  if (bits == 8) return write_strips<std::uint8_t>(file, picture, most_bytes);
  write_strips<std::uint16_t>(file, picture, most_bytes);
}

}  // namespace vitrail
