// SPDX-License-Identifier: Apache-2.0
// They are what an .exr says of itself beside its pixels, by the names of OpenEXR and pbrt where they have
// one. Only image_io.cpp and picture_reading.cpp use them.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "film/develop.h"

namespace vitrail {

struct OriginText {
  const char* name;
  std::string PictureOrigin::*text;
};
inline constexpr OriginText origin_texts[] = {
    {"Software", &PictureOrigin::software},    {"scene", &PictureOrigin::scene},
    {"sceneHash", &PictureOrigin::scene_hash}, {"glazing", &PictureOrigin::glazing},
    {"sampling", &PictureOrigin::sampling},    {"seed", &PictureOrigin::seeds},
    {"filmHash", &PictureOrigin::film_hash},   {"denoiser", &PictureOrigin::denoiser},
    {"lightGroups", &PictureOrigin::groups}};

struct OriginMatrix {
  const char* name;
  std::vector<float> PictureOrigin::*matrix;
};
inline constexpr OriginMatrix origin_matrices[] = {{"worldToCamera", &PictureOrigin::world_to_camera},
                                                   {"worldToNDC", &PictureOrigin::world_to_ndc}};

inline constexpr const char *samples_name = "samplesPerPixel", *least_name = "samplesPerPixelLeast",
                            *time_name = "renderTimeSeconds", *of_mean_name = "neighboursOfMean",
                            *of_variances_name = "neighboursOfVariances";

// OpenEXR's matrices take rows, those of a picture's origin columns: this turns either into the other.
constexpr std::array<float, 16> transposed(std::span<const float, 16> m) {
  std::array<float, 16> t{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) t[4 * j + i] = m[4 * i + j];
  return t;
}

}  // namespace vitrail
