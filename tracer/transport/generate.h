// SPDX-License-Identifier: Apache-2.0
// These functions start paths: at the camera, and where they come from another domain.
#pragma once

#include "tracer/transport/find_hit.h"
#include "tracer/transport/scatterer.h"

namespace vitrail {

// Returns the camera ray of a path's sample through the pixel (x, y) of the whole film.
CameraRay camera_ray(const Tracing& tracing, const CameraPath& path, int x, int y);
// Makes the path that of sample `sample` of the pixel (x, y) of the whole film, which lies in the crop.
void set_sample(const Tracing& tracing, CameraPath& path, int x, int y, std::uint32_t sample);
// It says what LaneStages::begin has given a path: its numbers, wavelengths and sensor (`numbers`), and its
// ray besides (`ray`).
enum class Given : std::uint8_t { nothing, numbers, ray };
// Begins a path. Returns false where it is dark: the lens stops it.
bool begin(Tracing& tracing, CameraPath& path, Given given);
// They return the column of its pixel in the whole film, and the row.
int column_of(const Tracing& tracing, const FilmSample& film);
int row_of(const Tracing& tracing, const FilmSample& film);

void pack(const Tracing& tracing, const CameraPath& path, bool resolved, RayRecord& record);
void unpack(const Tracing& tracing, const PathRecord& record, CameraPath& path);

}  // namespace vitrail
