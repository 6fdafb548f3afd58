// SPDX-License-Identifier: Apache-2.0
// A baked image whose checksums are put right: its header and all of its tiles.
#include "bundle/texture_file.h"
#include "tests/fuzz/fuzz_reader.h"
#include "tests/fuzz/repair.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    const auto* first = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(first, first + size);
    fuzz::repair_texture(bytes);
    const auto* repaired = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const TextureFile texture(fuzz::write("a.tex", repaired, bytes.size()));
    fuzz::require(texture.layout().levels.size() == texture.info().levels);
    texture.check_tiles();
  });
}
