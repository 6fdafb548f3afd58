// SPDX-License-Identifier: Apache-2.0
// A source gives the values of a PLY body in their order, from bytes or from text. Both kinds have the same
// members.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "importers/ply/read/ply_header.h"

namespace vitrail::ply {

static_assert(std::endian::native == std::endian::little);

template <class T, bool swapped>
T load(const char* from) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof(T));
  if constexpr (swapped) std::reverse(bytes, bytes + sizeof(T));
  return std::bit_cast<T>(bytes);
}

// Calls visitor(T{}) with the C++ type that stores `type`.
template <class Visitor>
auto with_type(Type type, Visitor&& visitor) {
  switch (type) {
    case Type::int8:
      return visitor(std::int8_t{});
    case Type::uint8:
      return visitor(std::uint8_t{});
    case Type::int16:
      return visitor(std::int16_t{});
    case Type::uint16:
      return visitor(std::uint16_t{});
    case Type::int32:
      return visitor(std::int32_t{});
    case Type::uint32:
      return visitor(std::uint32_t{});
    case Type::float32:
      return visitor(float{});
    default:
      return visitor(double{});
  }
}

template <bool big_endian>
class BinarySource {
 public:
  static constexpr bool binary = true, swapped = big_endian;

  BinarySource(const InputBytes& bytes, const TextCursor& cursor)
      : bytes_(&bytes), at_(cursor.at()), end_(cursor.end()), last_(at_), released_(at_) {}

  double number(const Element& element, const Property& property) { return next(element, property.type); }

  // Returns the length of a list whose items the file has room for.
  std::uint64_t list_length(const Element& element, const Property& property) {
    const double length = next(element, *property.count_type);
    if (length < 0 || length * static_cast<double>(size_of(property.type)) > static_cast<double>(left())) {
      fail(element,
           fmt::format("list {} of {} items, but only {} bytes are left", property.name, length, left()));
    }
    return static_cast<std::uint64_t>(length);
  }

  bool has_room(const Element& element) const {
    const std::size_t size = element.row_size();
    return size == 0 || element.count <= left() / size;
  }
  // Checks the room before memory is claimed for the rows of an element.
  void require_room(const Element& element) const {
    if (!has_room(element)) {
      fail(element,
           fmt::format("element {} announces {} rows of {} bytes or more, but only {} bytes are left",
                       element.name, element.count, element.row_size(), left()),
           at_);
    }
  }

  const char* at() const { return at_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  void skip(std::size_t size) { at_ += size; }
  void release_read() { bytes_->release(released_, at_); }

  [[noreturn]] void fail(const Element& element, const std::string& message, const char* position) const {
    throw Error(fmt::format("{} (byte {} of the file)", message, position - bytes_->begin()),
                element.location, element.excerpt);
  }
  // Fails at the value that was read last.
  [[noreturn]] void fail(const Element& element, const std::string& message) const {
    fail(element, message, last_);
  }

 private:
  double next(const Element& element, Type type) {
    last_ = at_;
    if (left() < size_of(type)) fail(element, fmt::format("the file ends within element {}", element.name));
    at_ += size_of(type);
    return with_type(type, [&](auto t) { return static_cast<double>(load<decltype(t), big_endian>(last_)); });
  }

  const InputBytes* bytes_;
  const char* at_;
  const char* end_;
  const char* last_;
  const char* released_;
};

class AsciiSource {
 public:
  static constexpr bool binary = false;

  AsciiSource(const InputBytes& bytes, const TextCursor& cursor)
      : bytes_(&bytes), cursor_(cursor), last_(cursor.at()), released_(last_) {}

  double number(const Element& element, const Property& property) {
    double value = 0;
    if (cursor_.next_plain_number(value, last_)) return value;
    if (!cursor_.skip_to_text()) cursor_.fail(fmt::format("the file ends within element {}", element.name));
    last_ = cursor_.at();
    return cursor_.number(property.name.c_str());
  }

  std::uint64_t list_length(const Element& element, const Property& property) {
    const double length = number(element, property);
    // Every item takes a digit and a blank.
    if (!(length >= 0) || length != std::floor(length) || length > static_cast<double>(left() + 2) / 2) {
      fail(element,
           fmt::format("list {} of {} items, but only {} bytes are left", property.name, length, left()));
    }
    return static_cast<std::uint64_t>(length);
  }

  void require_room(const Element& element) const {
    const std::size_t size = 2 * element.properties.size();
    if (size > 0 && element.count > (left() + 1) / size) {
      throw Error(fmt::format("element {} announces {} rows of {} values or more, but only {} bytes are left",
                              element.name, element.count, element.properties.size(), left()),
                  element.location, element.excerpt);
    }
  }

  std::size_t left() const { return static_cast<std::size_t>(cursor_.end() - cursor_.at()); }
  void release_read() { bytes_->release(released_, cursor_.at()); }

  [[noreturn]] void fail(const Element&, const std::string& message) const { cursor_.fail(message, last_); }

 private:
  const InputBytes* bytes_;
  TextCursor cursor_;
  const char* last_;  // the value that was read last: in the cursor's line
  const char* released_;
};

}  // namespace vitrail::ply
