// SPDX-License-Identifier: Apache-2.0
// A bundle as one input of a fuzzer: what its manifest, its records, its domain 0 and its image have, each
// after its length in four bytes. What else it has is the sample's.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace vitrail::fuzz {

enum Part : std::size_t { manifest, materials, lights, domains, domain, image, part_count };
using BundleParts = std::array<std::string, part_count>;
inline constexpr std::size_t records_header_bytes = 32;  // before what the records hold (bundle/manifest.cpp)

inline std::string pack(const BundleParts& parts) {
  std::string packed;
  for (const std::string& part : parts) {
    const auto bytes = static_cast<std::uint32_t>(part.size());
    packed.append(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    packed += part;
  }
  return packed;
}

// Of any bytes.
inline BundleParts unpack(std::string_view packed) {
  BundleParts parts;
  for (std::string& part : parts) {
    std::uint32_t bytes = 0;
    if (packed.size() < sizeof bytes) break;
    std::memcpy(&bytes, packed.data(), sizeof bytes);
    packed.remove_prefix(sizeof bytes);
    part = packed.substr(0, bytes);
    packed.remove_prefix(part.size());
  }
  return parts;
}

}  // namespace vitrail::fuzz
