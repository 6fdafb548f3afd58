// SPDX-License-Identifier: Apache-2.0
// Files as the Ptex File Format Specification 1.3 says; nothing here comes from Ptex's own library.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vitrail::test {

enum class PtexType : std::uint32_t { uint8, uint16, half, single };
enum class PtexEncoding : std::uint32_t { constant, zipped, differences, tiled };

// `bytes`: of a constant face its pixel, of others what its texels are encoded to. All of a channel stand
// together.
struct PtexFace {
  std::uint8_t log2_width = 0, log2_height = 0;
  std::string mean;
  PtexEncoding encoding = PtexEncoding::constant;
  std::string bytes = {};
};

inline std::string zipped(const std::string& bytes) {
  std::string packed(compressBound(bytes.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  packed.resize(size);
  return packed;
}

template <class T>
void put(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A word of a block's size and encoding.
inline std::uint32_t block_word(const std::string& block, PtexEncoding encoding) {
  return static_cast<std::uint32_t>(block.size()) | static_cast<std::uint32_t>(encoding) << 30;
}

inline std::string ptex_bytes(PtexType type, int channels, const std::vector<PtexFace>& faces) {
  std::string infos, means, blocks, data;
  for (const PtexFace& face : faces) {
    const bool constant = face.encoding == PtexEncoding::constant;
    put(infos, face.log2_width), put(infos, face.log2_height), put(infos, std::uint8_t{0});
    put(infos, static_cast<std::uint8_t>(constant));
    for (int i = 0; i < 4; ++i) put(infos, std::uint32_t{0xffffffff});
    means += face.mean, data += face.bytes;
    put(blocks, block_word(face.bytes, face.encoding));
  }
  infos = zipped(infos), means = zipped(means), blocks = zipped(blocks);
  const std::string extended(40, '\0');
  std::string level;
  put(level, std::uint64_t{blocks.size() + data.size()}),
      put(level, static_cast<std::uint32_t>(blocks.size()));
  put(level, static_cast<std::uint32_t>(faces.size()));
  std::string file = "Ptex";
  put(file, std::uint32_t{1}), put(file, std::uint32_t{1}), put(file, type),
      put(file, std::uint32_t{0xffffffff});
  put(file, static_cast<std::uint16_t>(channels)), put(file, std::uint16_t{1});
  put(file, static_cast<std::uint32_t>(faces.size()));
  for (const std::size_t size : {extended.size(), infos.size(), means.size(), level.size()})
    put(file, static_cast<std::uint32_t>(size));
  put(file, std::uint32_t{4}), put(file, std::uint64_t{blocks.size() + data.size()}),
      put(file, std::uint64_t{0});
  return file + extended + infos + means + level + blocks + data;
}

}  // namespace vitrail::test
