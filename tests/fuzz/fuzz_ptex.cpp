// SPDX-License-Identifier: Apache-2.0
#include "images/ptex_file.h"
#include "tests/fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    PtexFile file(fuzz::write("a.ptx", data, size));
    for (std::size_t i = 0; i < file.faces().size(); ++i) {
      const PtexFile::Face& face = file.faces()[i];
      if (face.width * face.height * file.channels() > 1 << 16) continue;
      fuzz::require(file.texels(i).size() == face.width * face.height * file.channels());
    }
  });
}
