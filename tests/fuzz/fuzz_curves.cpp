// SPDX-License-Identifier: Apache-2.0
// Files of curves and of hair: the first byte says which.
#include "importers/mitsuba/read/curve_files.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

void check(const vitrail::mitsuba::CurveFile& file, std::size_t least) {
  using vitrail::fuzz::require;
  std::size_t begin = 0;
  for (const std::size_t end : file.ends) {
    require(end >= begin + least);
    begin = end;
  }
  require(begin == file.points.size());
  for (const vitrail::CurvePoint& point : file.points) require(is_finite(point.position));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  if (size == 0) return 0;
  const std::filesystem::path file = fuzz::write("curves", data + 1, size - 1);
  return fuzz::run([&] {
    if (data[0] == 'h')
      check(mitsuba::read_hair_file(file, 1), 2);
    else
      check(mitsuba::read_curve_file(file, 4), 4);
  });
}
