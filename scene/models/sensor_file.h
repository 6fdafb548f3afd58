// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "scene/records/camera.h"
#include "scene/records/film_settings.h"

namespace vitrail {

inline constexpr std::size_t max_sensors = 1 << 16;

// Reads sensors from a text: `x y z nx ny nz` a line, as Radiance has them, or a grid of them, `plane ox oy
// oz ux uy uz vx vy vz NXxNY`: at the middles of NX × NY cells of the parallelogram from o along u and v, u
// first, facing u × v. Blank lines and what follows a # are left out. Normals need not be of length 1. Throws
// Error with the line.
std::vector<Sensor> read_sensors(const std::filesystem::path& file);

// Returns the settings of the film that holds them: a column a sensor, `sensor_rows` rows of samples of their
// own, the spectrum in bins of 10 nm.
inline constexpr int sensor_rows = 16;
FilmSettings sensor_film(std::size_t sensors);

}  // namespace vitrail
