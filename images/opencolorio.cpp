// SPDX-License-Identifier: Apache-2.0
#include <OpenColorIO/OpenColorIO.h>

#include "images/codec_parts.h"

namespace vitrail {

namespace {

namespace OCIO = OCIO_NAMESPACE;

OCIO::TransformRcPtr xyz_matrix(const std::array<double, 9>& to_xyz, OCIO::TransformDirection direction) {
  std::array<double, 16> m{};  // rows and columns of red, green, blue and one more
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) m[4 * row + column] = to_xyz[3 * row + column];
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

std::string map_tones(Image& rgb, const std::array<double, 9>& to_xyz) try {
  const auto steps = OCIO::GroupTransform::Create();
  steps->appendTransform(xyz_matrix(to_xyz, OCIO::TRANSFORM_DIR_FORWARD));
  steps->appendTransform(built_in("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD", OCIO::TRANSFORM_DIR_INVERSE));
  steps->appendTransform(
      built_in("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", OCIO::TRANSFORM_DIR_FORWARD));
  steps->appendTransform(xyz_matrix(to_xyz, OCIO::TRANSFORM_DIR_INVERSE));
  OCIO::PackedImageDesc pixels(rgb.values.data(), rgb.width, rgb.height, 3);
  OCIO::Config::CreateRaw()->getProcessor(steps)->getDefaultCPUProcessor()->apply(pixels);
  return {};
} catch (const OCIO::Exception& error) {
  return error.what();
}

}  // namespace vitrail
