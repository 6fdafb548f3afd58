// SPDX-License-Identifier: Apache-2.0
// A batch holds rays of one kind that wait for one domain: it is a queue entry, and a message as it travels.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "tracer/photons/photon_records.h"
#include "tracer/rays/ray_records.h"

namespace vitrail {

// The last three kinds travel as rays do and wait for no domain: photons that landed, questions of paths to
// photons, and items of work by number.
enum class RayKind : std::uint32_t { path, shadow, landed, question, item };

template <class Record>
constexpr RayKind kind_of() {
  return std::is_same_v<Record, RayRecord>      ? RayKind::path
         : std::is_same_v<Record, ShadowRecord> ? RayKind::shadow
         : std::is_same_v<Record, Photon>       ? RayKind::landed
         : std::is_same_v<Record, Gather>       ? RayKind::question
                                                : RayKind::item;
}
constexpr bool is_ray(RayKind kind) { return kind == RayKind::path || kind == RayKind::shadow; }

// It has a header of 8 bytes, then records without gaps.
class RayBatch {
 public:
  static constexpr std::size_t header_bytes = 8;
  static constexpr std::size_t full_bytes = 1 << 16;

  RayBatch() = default;
  RayBatch(std::uint32_t domain, RayKind kind) : bytes_(header_bytes) {
    std::memcpy(bytes_.data(), &domain, 4);
    std::memcpy(bytes_.data() + 4, &kind, 4);
  }
  explicit RayBatch(std::vector<std::byte> received) : bytes_(std::move(received)) {}

  std::uint32_t domain() const { return read<std::uint32_t>(0); }
  RayKind kind() const { return read<RayKind>(4); }
  std::size_t count() const { return bytes_.empty() ? 0 : (bytes_.size() - header_bytes) / record_bytes(); }
  // Returns whether what was received is a batch for one of `domains`.
  bool is_whole(std::size_t domains) const {
    return bytes_.size() > header_bytes && domain() < domains && kind() <= RayKind::item &&
           (bytes_.size() - header_bytes) % record_bytes() == 0;
  }
  bool full() const { return bytes_.size() + sizeof(RayRecord) > full_bytes; }

  template <class Record>
  void append(const Record& record) {
    const std::size_t needed = bytes_.size() + sizeof(Record);
    if (needed > bytes_.capacity())
      bytes_.reserve(needed > full_bytes / 2 ? std::max(needed, full_bytes) : 2 * needed);
    const auto* raw = reinterpret_cast<const std::byte*>(&record);
    bytes_.insert(bytes_.end(), raw, raw + sizeof(Record));
  }
  template <class Record>
  std::span<Record> records() {
    return {reinterpret_cast<Record*>(bytes_.data() + header_bytes), count()};
  }
  const std::vector<std::byte>& bytes() const { return bytes_; }
  // Returns the bytes of memory, with room to grow: a full batch has none.
  std::size_t held_bytes() const { return bytes_.capacity(); }

 private:
  std::size_t record_bytes() const {
    switch (kind()) {
      case RayKind::path:
        return sizeof(RayRecord);
      case RayKind::shadow:
        return sizeof(ShadowRecord);
      case RayKind::landed:
        return sizeof(Photon);
      case RayKind::question:
        return sizeof(Gather);
      default:
        return sizeof(std::uint64_t);
    }
  }
  template <class T>
  T read(std::size_t at) const {
    T value;
    std::memcpy(&value, bytes_.data() + at, sizeof(T));
    return value;
  }
  std::vector<std::byte> bytes_;
};

}  // namespace vitrail
