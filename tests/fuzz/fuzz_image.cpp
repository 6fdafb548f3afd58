// SPDX-License-Identifier: Apache-2.0
// The image library, asked as images/ does: the first byte chooses the format by its name.
#include <array>

#include "images/image_files.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  constexpr std::array names{"a.hdr", "a.jpg", "a.gif", "a.pfm", "a.png", "a.tga", "a.bmp"};
  if (size < 1) return 0;
  const char* const name = names.at(data[0] % names.size());
  return fuzz::run([&] {
    const auto file = fuzz::write(name, data + 1, size - 1);
    const ImageLayout layout = read_image_layout(file);
    const auto pixels = static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height);
    if (pixels > 1 << 16) return;
    const StoredImage whole = read_stored_image(file);
    fuzz::require(whole.image.pixels() == pixels);
    std::size_t rows = 0;
    read_stored_rows(file, [&](const StoredImage& part) { rows += part.image.pixels(); });
    fuzz::require(rows == pixels);
  });
}
