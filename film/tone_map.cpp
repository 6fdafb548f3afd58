// SPDX-License-Identifier: Apache-2.0
#include "film/tone_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "images/image_codec.h"
#include "scene/spectra/color.h"
#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

std::array<double, 9> srgb_to_xyz_matrix() {
  std::array<double, 9> m{};
  for (std::size_t column = 0; column < 3; ++column) {
    RGB unit;
    (column == 0 ? unit.r : column == 1 ? unit.g : unit.b) = 1;
    const XYZ xyz = srgb_to_xyz(unit);
    m[column] = xyz.x, m[3 + column] = xyz.y, m[6 + column] = xyz.z;
  }
  return m;
}

}  // namespace

Image aces_tone_mapped(const Image& rgb) {
  Image mapped = rgb;
  const ImageCodec& codec = image_codec();
  const GrantedMemory mapping(2 * mapped.values.size() * sizeof(float));
  if (const std::string problem = codec.map_tones(mapped, srgb_to_xyz_matrix()); !problem.empty())
    throw MachineError(fmt::format("cannot map tones: {}", problem));
  for (float& v : mapped.values) v = std::clamp(v, 0.0f, 1.0f);
  return mapped;
}

}  // namespace vitrail
