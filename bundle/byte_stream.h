// SPDX-License-Identifier: Apache-2.0
// This file writes and reads little-endian bytes, one value after the other without gaps.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "scene/system/diagnostics.h"

namespace vitrail {

static_assert(std::endian::native == std::endian::little);

template <class T>
concept Number = std::integral<T> || std::floating_point<T>;

// A ByteSink takes bytes, one part after the other.
using ByteSink = std::function<void(std::span<const std::byte>)>;

// A ByteWriter holds a part of the bytes at a time. `flush` sends what is left to the sink.
class ByteWriter {
 public:
  explicit ByteWriter(const ByteSink& sink) : sink_(sink) { bytes_.reserve(part_bytes); }
  template <Number T>
  void put(T value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes_.insert(bytes_.end(), first, first + sizeof value);
    if (bytes_.size() > part_bytes - sizeof(std::uint64_t)) flush();
  }
  void flush() {
    sink_(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t part_bytes = 64 << 10;
  const ByteSink& sink_;
  std::vector<std::byte> bytes_;
};

// A ByteReader throws Error with the file's name where a read goes past the end, or where something is left
// over.
class ByteReader {
 public:
  ByteReader(std::vector<std::byte> bytes, std::filesystem::path file)
      : bytes_(std::move(bytes)), file_(std::move(file)) {}

  template <Number T>
  T get() {
    T value;
    if (sizeof value > bytes_.size() - at_) fail("it ends in the middle of a record");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  // Returns a number of records of at least `least_bytes` bytes each, checked against what is left of the
  // file.
  std::size_t get_count(std::size_t least_bytes) {
    const auto count = get<std::uint64_t>();
    if (count > (bytes_.size() - at_) / least_bytes) fail("it counts more records than it holds");
    return static_cast<std::size_t>(count);
  }
  bool at_end() const { return at_ == bytes_.size(); }
  void expect_end() const {
    if (!at_end()) fail("something follows its last record");
  }
  [[noreturn]] void fail(const char* what) const {
    throw Error(std::string("damaged file: ") + what, {file_.string()});
  }

 private:
  std::vector<std::byte> bytes_;
  std::filesystem::path file_;
  std::size_t at_ = 0;
};

}  // namespace vitrail
