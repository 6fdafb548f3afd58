// SPDX-License-Identifier: Apache-2.0
// Daylight coefficients are what a light of the sky gives to a sensor.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "film/film.h"

namespace vitrail {

// They are [sensor][light]: lx for 1 cd/m² of a patch, lx for 1 lx across the direction of a sun.
struct Coefficients {
  std::size_t sensors = 0, lights = 0;
  std::vector<float> mean, error;  // the standard error of each, by two halves of its samples
  std::vector<float> melanopic;    // as the mean, but lx of melanopic EDI

  std::span<const float> of(std::size_t sensor) const { return {&mean[sensor * lights], lights}; }
  std::span<const float> melanopic_of(std::size_t sensor) const {
    return {&melanopic[sensor * lights], lights};
  }
  std::span<const float> errors_of(std::size_t sensor) const { return {&error[sensor * lights], lights}; }
};

// Reads them off a film whose rows are lights (tracer/prepared/daylight_rows.h); `patches` are those of the
// sky, else suns. Throws Error if the film is saturated.
Coefficients coefficients_of(const Film& film, bool patches);

// Writes an array as NumPy's .npy has it: little-endian floats of 32 bits, [sensor][light].
void write_npy(const std::filesystem::path& file, const Coefficients& of, const std::vector<float>& values);

}  // namespace vitrail
