// SPDX-License-Identifier: Apache-2.0
#include "film/tone_map.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>

#include "scene/spectra/color.h"

namespace vitrail {

namespace {

namespace OCIO = OCIO_NAMESPACE;

// Rows and columns of red, green, blue and one more.
OCIO::TransformRcPtr srgb_to_xyz_matrix(OCIO::TransformDirection direction) {
  std::array<double, 16> m{};
  for (std::size_t column = 0; column < 3; ++column) {
    RGB unit;
    (column == 0 ? unit.r : column == 1 ? unit.g : unit.b) = 1;
    const XYZ xyz = srgb_to_xyz(unit);
    m[column] = xyz.x, m[4 + column] = xyz.y, m[8 + column] = xyz.z;
  }
  m[15] = 1;
  const auto transform = OCIO::MatrixTransform::Create();
  transform->setMatrix(m.data());
  transform->setDirection(direction);
  return transform;
}

OCIO::TransformRcPtr built_in(const char* style, OCIO::TransformDirection direction) {
  const auto transform = OCIO::BuiltinTransform::Create();
  transform->setStyle(style);
  transform->setDirection(direction);
  return transform;
}

}  // namespace

Image aces_tone_mapped(const Image& rgb) {
  const auto steps = OCIO::GroupTransform::Create();
  steps->appendTransform(srgb_to_xyz_matrix(OCIO::TRANSFORM_DIR_FORWARD));
  steps->appendTransform(built_in("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD", OCIO::TRANSFORM_DIR_INVERSE));
  steps->appendTransform(
      built_in("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", OCIO::TRANSFORM_DIR_FORWARD));
  steps->appendTransform(srgb_to_xyz_matrix(OCIO::TRANSFORM_DIR_INVERSE));
  Image mapped = rgb;
  OCIO::PackedImageDesc pixels(mapped.values.data(), mapped.width, mapped.height, 3);
  OCIO::Config::CreateRaw()->getProcessor(steps)->getDefaultCPUProcessor()->apply(pixels);
  for (float& v : mapped.values) v = std::clamp(v, 0.0f, 1.0f);
  return mapped;
}

}  // namespace vitrail
