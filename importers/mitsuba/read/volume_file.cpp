// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "scene/system/input_files.h"

namespace vitrail::mitsuba {

namespace {

struct Header {
  std::array<char, 3> magic{};
  std::uint8_t version = 0;
  std::int32_t encoding = 0;
  std::int32_t nx = 0, ny = 0, nz = 0, channels = 0;
  std::array<float, 6> bounds{};
};
static_assert(sizeof(Header) == volume_header_bytes);

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

Header read_header(const std::filesystem::path& path) {
  std::ifstream file = open_input(path);
  std::array<char, sizeof(Header)> bytes{};
  if (!file.read(bytes.data(), bytes.size())) fail(path, "not a volume file: it ends within its header");
  Header header;
  std::memcpy(&header, bytes.data(), bytes.size());
  return header;
}

// nx·ny·nz·channels values of 4 bytes follow the header; the counts are checked before they are multiplied.
void check_counts(const std::filesystem::path& path, const Header& h) {
  constexpr int most_channels = 1 << 16;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const std::uintmax_t values =
      error || bytes < sizeof(Header) ? 0 : (bytes - sizeof(Header)) / sizeof(float);
  if (h.nx < 1 || h.ny < 1 || h.nz < 1 || h.channels < 1 || h.channels > most_channels)
    fail(path, fmt::format("a grid of {} × {} × {} with {} channels", h.nx, h.ny, h.nz, h.channels));
  std::uintmax_t left = values;
  for (const std::int32_t count : {h.nx, h.ny, h.nz, h.channels}) left /= static_cast<std::uintmax_t>(count);
  if (left < 1)
    fail(path,
         fmt::format("a grid of {} × {} × {} with {} channels needs more than the {} values in the file",
                     h.nx, h.ny, h.nz, h.channels, values));
}

}  // namespace

Grid read_volume_header(const std::filesystem::path& path) {
  const Header h = read_header(path);
  if (h.magic != std::array{'V', 'O', 'L'}) fail(path, "not a volume file: it does not start with VOL");
  if (h.version != 3) fail(path, fmt::format("a volume file of version {}: 3 can be read", h.version));
  if (h.encoding != 1)
    fail(path, fmt::format("a volume file of encoding {}: 1 (32-bit floats) can be read", h.encoding));
  check_counts(path, h);
  for (const float bound : h.bounds)
    if (!std::isfinite(bound)) fail(path, "the bounds of the grid are not finite");
  Grid grid;
  grid.filename = path.string();
  grid.nx = h.nx;
  grid.ny = h.ny;
  grid.nz = h.nz;
  grid.channels = h.channels;
  const auto b = [&](std::size_t i) { return static_cast<double>(h.bounds[i]); };
  grid.bounds = {{b(0), b(1), b(2)}, {b(3), b(4), b(5)}};
  return grid;
}

std::vector<VolumeValues> values_of_volume(const Grid& grid) {
  const auto channels = static_cast<std::size_t>(grid.channels);
  const std::size_t cells = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                            static_cast<std::size_t>(grid.nz);
  std::ifstream file = open_input(grid.filename);
  file.seekg(volume_header_bytes);
  std::vector<float> cell(channels);
  std::vector<VolumeValues> values(channels, {HUGE_VAL, 0, -HUGE_VAL});
  for (std::size_t i = 0; i < cells; ++i) {
    if (!file.read(reinterpret_cast<char*>(cell.data()),
                   static_cast<std::streamsize>(channels * sizeof(float))))
      fail(grid.filename, "it is too short");
    for (std::size_t c = 0; c < channels; ++c) {
      const double value = static_cast<double>(cell[c]);
      values[c].least = std::min(values[c].least, value);
      values[c].mean += value / static_cast<double>(cells);
      values[c].greatest = std::max(values[c].greatest, value);
    }
  }
  return values;
}

}  // namespace vitrail::mitsuba
