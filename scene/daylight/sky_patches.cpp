// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_patches.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

constexpr std::size_t tregenza_rows[] = {30, 30, 24, 24, 18, 12, 6};

}  // namespace

SkyPatches::SkyPatches(int mf) : mf_(mf) {
  const double height_rad = pi / 2 / (std::size(tregenza_rows) * static_cast<double>(mf) + 0.5);
  const auto sine = [&](std::size_t row) { return portable_sin(static_cast<double>(row) * height_rad); };
  for (const std::size_t patches : tregenza_rows)
    for (int part = 0; part < mf; ++part) {
      rows_.push_back(
          {sine(rows_.size()), sine(rows_.size() + 1), count_, patches * static_cast<std::size_t>(mf)});
      count_ += rows_.back().patches;
    }
  rows_.push_back({sine(rows_.size()), 1, count_, 1});
  ++count_;
}

std::size_t SkyPatches::patch_of(Vector3d d) const {
  if (!(d.z >= 0)) return 0;
  const auto above =
      std::ranges::upper_bound(rows_, d.z, {}, [](const Row& row) { return row.low; }) - rows_.begin();
  const Row& row = rows_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - 1, 0))];
  const auto patches = static_cast<double>(row.patches);
  // Half a patch on either side of north is the first.
  const double place = portable_atan2(d.x, d.y) / (2 * pi) * patches + 0.5;
  const double whole = std::floor(place < 0 ? place + patches : place);
  return row.first + static_cast<std::size_t>(std::clamp(whole, 0.0, patches - 1));
}

const SkyPatches::Row& SkyPatches::row_of(std::size_t patch) const {
  return *(std::ranges::upper_bound(rows_, patch, {}, [](const Row& row) { return row.first; }) - 1);
}

double SkyPatches::solid_angle(std::size_t patch) const {
  if (patch == 0) return 2 * pi;
  const Row& row = row_of(patch);
  return 2 * pi * (row.high - row.low) / static_cast<double>(row.patches);
}

Vector3d SkyPatches::direction(std::size_t patch, double u, double v) const {
  double turn = u, z = v - 1;
  if (patch > 0) {
    const Row& row = row_of(patch);
    turn = (static_cast<double>(patch - row.first) + u - 0.5) / static_cast<double>(row.patches);
    z = row.low + (row.high - row.low) * v;
  }
  const double across = std::sqrt(std::max(0.0, 1 - z * z));
  return {across * sin_pi(2 * turn), across * sin_pi(2 * turn + 0.5), z};
}

}  // namespace vitrail
