// SPDX-License-Identifier: Apache-2.0
#include "film/tiff_directory.h"

namespace vitrail {

namespace {

std::size_t even(std::size_t bytes) { return bytes + bytes % 2; }

}  // namespace

void put_number(TiffBytes& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

void TiffDirectory::text(std::uint16_t tag, const std::string& value) {
  if (value.empty()) return;
  TiffBytes bytes(value.begin(), value.end());
  bytes.push_back(0);
  entries_.push_back({tag, static_cast<std::uint16_t>(Type::text), bytes.size(), bytes});
}

void TiffDirectory::numbers(std::uint16_t tag, Type type, std::span<const std::uint64_t> values) {
  const int bytes_of_each = type == Type::of_16_bits ? 2 : type == Type::of_32_bits ? 4 : 8;
  Entry entry{tag, static_cast<std::uint16_t>(type), values.size(), {}};
  for (const std::uint64_t value : values) put_number(entry.value, value, bytes_of_each);
  entries_.push_back(std::move(entry));
}

void TiffDirectory::whole(std::uint16_t tag, std::uint32_t value) {
  constexpr std::uint16_t ratio = 5;
  Entry entry{tag, ratio, 1, {}};
  put_number(entry.value, value, 4), put_number(entry.value, 1, 4);
  entries_.push_back(std::move(entry));
}

std::size_t TiffDirectory::entries_size() const {
  const std::size_t entry = large_ ? 20 : 12, count_and_next = large_ ? 8 + 8 : 2 + 4;
  return entry * entries_.size() + count_and_next;
}

std::size_t TiffDirectory::size() const {
  std::size_t bytes = even(entries_size());
  for (const Entry& e : entries_) bytes += is_apart(e) ? even(e.value.size()) : 0;
  return bytes;
}

void TiffDirectory::append_to(TiffBytes& bytes, std::size_t at) const {
  std::size_t behind = at + even(entries_size());
  put_number(bytes, entries_.size(), large_ ? 8 : 2);
  for (const Entry& e : entries_) {
    put_number(bytes, e.tag, 2), put_number(bytes, e.type, 2);
    put_number(bytes, e.count, place_bytes());
    if (is_apart(e)) {
      put_number(bytes, behind, place_bytes());
      behind += even(e.value.size());
    } else {
      bytes.insert(bytes.end(), e.value.begin(), e.value.end());
      put_number(bytes, 0, place_bytes() - static_cast<int>(e.value.size()));
    }
  }
  put_number(bytes, 0, place_bytes());  // no next directory
  const auto pad = [&](std::size_t length) { put_number(bytes, 0, static_cast<int>(length % 2)); };
  pad(entries_size());
  for (const Entry& e : entries_)
    if (is_apart(e)) {
      bytes.insert(bytes.end(), e.value.begin(), e.value.end());
      pad(e.value.size());
    }
}

}  // namespace vitrail
