// SPDX-License-Identifier: Apache-2.0
// The first byte says whether the others are the file (and which mesh of it is read) or what it deflates:
// mutations of deflated bytes hardly reach what is behind them.
#include <zlib.h>

#include <cstring>

#include "importers/mitsuba/read/serialized.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

// A file of one mesh. As stored blocks: to find good ones takes longer than to read them.
std::string serialized(std::uint16_t version, const std::uint8_t* data, std::size_t size) {
  uLongf bytes = compressBound(size);
  std::string stream(bytes, '\0');
  if (compress2(reinterpret_cast<Bytef*>(stream.data()), &bytes, data, size, 0) != Z_OK) std::abort();
  stream.resize(bytes);
  const auto put = [](auto value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const std::string offset = version == 3 ? put(std::uint32_t{0}) : put(std::uint64_t{0});
  return put(std::uint16_t{0x041C}) + put(version) + stream + offset + put(std::uint32_t{1});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  if (size == 0) return 0;
  const std::uint8_t kind = *data++;
  --size;
  const bool deflated = kind == 3 || kind == 4;
  const std::filesystem::path file = deflated ? fuzz::write("mesh.serialized", serialized(kind, data, size))
                                              : fuzz::write("mesh.serialized", data, size);
  return fuzz::run([&] {
    Scene scene;
    scene.meshes.push_back(mitsuba::read_serialized(file, deflated ? 0 : kind & 1));
    fuzz::check(scene);
  });
}
