// SPDX-License-Identifier: Apache-2.0
// What the sensors of a film measured (scene/records/camera.h, SensorCamera).
#pragma once

#include <vector>

#include "film/film.h"

namespace vitrail {

// A mean over the rows of a sensor and its standard error, by how the rows differ; 0 of a single row.
struct Measured {
  double mean = 0, standard_error = 0;
};

struct SensorReading {
  Measured illuminance_lx;
  Measured melanopic_edi_lx;  // scene/daylight/photometry.h
  Measured irradiance_w_m2;   // over the film's bins: 360 to 830 nm
  std::uint64_t samples = 0;
};

// One a column of the film. Throws Error if it is saturated, keeps no spectrum or was clamped.
std::vector<SensorReading> sensor_readings(const Film& film);

}  // namespace vitrail
