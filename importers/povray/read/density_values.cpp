// SPDX-License-Identifier: Apache-2.0
// DF3: three sizes of two bytes, then the values of one, two or four bytes each, all with the highest byte
// first.
#include "importers/povray/read/density_values.h"

#include <cmath>

#include "importers/bytes/input_bytes.h"
#include "scene/system/diagnostics.h"

namespace vitrail::pov {

namespace {

std::uint32_t number(const char* bytes, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

DensityValues::DensityValues(const std::filesystem::path& file, bool smooth) : smooth_(smooth) {
  const InputBytes bytes(file);
  constexpr std::size_t head = 6;
  if (bytes.size() < head) throw Error("a density_file is too short", {file.string()});
  for (std::size_t i = 0; i < 3; ++i) count_[i] = number(bytes.begin() + 2 * i, 2);
  const std::size_t cells = count_[0] * count_[1] * count_[2];
  const std::size_t each = cells > 0 ? (bytes.size() - head) / cells : 0;
  if ((each != 1 && each != 2 && each != 4) || each * cells + head != bytes.size())
    throw Error("the size of a density_file does not fit its head", {file.string()});
  const double most = std::exp2(8.0 * static_cast<double>(each)) - 1;
  values_.reserve(cells);
  for (std::size_t i = 0; i < cells; ++i)
    values_.push_back(static_cast<float>(number(bytes.begin() + head + each * i, each) / most));
}

double DensityValues::at(Point3d p) const {
  const std::array<double, 3> at{p.x, p.y, p.z};
  std::array<std::array<std::size_t, 2>, 3> index;
  std::array<double, 3> share;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(at[i] >= 0 && at[i] < 1)) return 0;
    const double cells = at[i] * static_cast<double>(count_[i]);
    index[i][0] = std::min(static_cast<std::size_t>(cells), count_[i] - 1);
    index[i][1] = (index[i][0] + 1) % count_[i];
    share[i] = smooth_ ? cells - static_cast<double>(index[i][0]) : 0;
  }
  double sum = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    double weight = 1;
    for (std::size_t i = 0; i < 3; ++i) weight *= k >> i & 1 ? share[i] : 1 - share[i];
    if (weight > 0) sum += weight * cell(index[0][k & 1], index[1][k >> 1 & 1], index[2][k >> 2 & 1]);
  }
  return sum;
}

}  // namespace vitrail::pov
