// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/write/volume_files.h"

#include <array>
#include <cstdint>
#include <span>

#include "scene/system/atomic_file.h"

namespace vitrail::mitsuba_writer {

namespace {

struct VolumeHeader {
  std::array<char, 4> magic{'V', 'O', 'L', 3};
  std::int32_t encoding = 1;  // float32
  std::int32_t nx = 0, ny = 0, nz = 0, channels = 0;
  std::array<float, 6> bounds{};
};
static_assert(sizeof(VolumeHeader) == 48);

}  // namespace

void write_volume_file(const std::filesystem::path& path, const Grid& grid) {
  const Point3f lower = cast<float>(grid.bounds.lower), upper = cast<float>(grid.bounds.upper);
  VolumeHeader header;
  header.nx = grid.nx;
  header.ny = grid.ny;
  header.nz = grid.nz;
  header.channels = grid.channels;
  header.bounds = {lower.x, lower.y, lower.z, upper.x, upper.y, upper.z};
  AtomicFile file(path);
  file.write(std::as_bytes(std::span(&header, 1)));
  file.write(std::as_bytes(std::span(grid.values)));
  file.commit_part();
}

}  // namespace vitrail::mitsuba_writer
