// SPDX-License-Identifier: Apache-2.0
// Sensor readings are what the sensors of a film measured (scene/records/camera.h, SensorCamera).
#pragma once

#include <vector>

#include "film/film.h"

namespace vitrail {

// A Measured is a mean over a sensor's rows and its standard error, by how the rows differ; 0 of one row.
struct Measured {
  double mean = 0, standard_error = 0;
};

struct SensorReading {
  Measured illuminance_lx;
  Measured melanopic_edi_lx;  // scene/daylight/photometry.h
  Measured irradiance_w_m2;   // over the film's bins: 360 to 830 nm
  std::uint64_t samples = 0;
  // This is how much of the scatter of the illuminance one half of a row makes alone:
  // the greatest share of its squared difference from the mean. Of 32 normal numbers
  // it is .17, and above .5 once in 10⁴ times. If it is greater, light is found
  // seldom and is strong when it is, and the error is as uncertain as the mean.
  double greatest_share = 0;
};

// Returns one reading a column of the film. Throws Error if it is saturated, clamped or without a spectrum.
std::vector<SensorReading> sensor_readings(const Film& film);

}  // namespace vitrail
