// SPDX-License-Identifier: Apache-2.0
// A TiffDirectory is a directory of tags, as TIFF 6.0 and EXIF (CIPA DC-008) have them: little-endian, long
// values behind the entries at even places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vitrail {

using TiffBytes = std::vector<std::uint8_t>;

void put_number(TiffBytes& bytes, std::uint64_t value, int count);

// Tags are given in rising order. A `large` directory has places of 64 bits (BigTIFF).
class TiffDirectory {
 public:
  enum class Type : std::uint16_t { text = 2, of_16_bits = 3, of_32_bits = 4, of_64_bits = 16 };

  explicit TiffDirectory(bool large = false) : large_(large) {}
  // Adds a text; an empty one is left out.
  void text(std::uint16_t tag, const std::string& value);
  void numbers(std::uint16_t tag, Type type, std::span<const std::uint64_t> values);
  void number(std::uint16_t tag, Type type, std::uint64_t value) { numbers(tag, type, {&value, 1}); }
  // Adds a ratio whose denominator is 1.
  void whole(std::uint16_t tag, std::uint32_t value);

  std::size_t size() const;
  // `at` is where it begins, from the beginning of the TIFF header.
  void append_to(TiffBytes& bytes, std::size_t at) const;

 private:
  struct Entry {
    std::uint16_t tag, type;
    std::uint64_t count;
    TiffBytes value;
  };
  std::size_t entries_size() const;
  int place_bytes() const { return large_ ? 8 : 4; }
  bool is_apart(const Entry& e) const { return e.value.size() > static_cast<std::size_t>(place_bytes()); }

  bool large_;
  std::vector<Entry> entries_;
};

}  // namespace vitrail
