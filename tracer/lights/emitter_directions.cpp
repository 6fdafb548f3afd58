// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/emitter_directions.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/frame.h"
#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"
#include "tracer/lights/projected_flux.h"

namespace vitrail {

EmitterDirections::EmitterDirections(const EmitterShape& shape, const LightScene& scene) {
  // Sheared or stretched, what is uniform for the light is not so in the world.
  if (!shape.is_rigid) return;
  if (is_invertible(shape.world_to_light)) light_to_world_ = inverse(shape.world_to_light);
  if (const auto* spot = std::get_if<SpotShape>(&shape.kind))
    how_ = Cone{normalize(shape.axis), std::max(spot->cos_cutoff, -1.0)};
  else if (const auto* projection = std::get_if<ProjectionShape>(&shape.kind))
    tabulate(*projection, scene);
  else if (const auto* goniometric = std::get_if<GoniometricShape>(&shape.kind))
    tabulate(*goniometric);
}

void EmitterDirections::tabulate(const ProjectionShape& projection, const LightScene& scene) {
  constexpr double alike = 0.1;  // of all directions that may shine
  const std::vector<FrameFlux> parts =
      parts_of_frame(projection.image, projection.half, projection.irradiance, Cells::side, scene.textures,
                     scene.texture_records);
  double total = 0, shining = 0;
  for (const FrameFlux& part : parts) total += part.mean, shining += part.most > 0;
  Cells cells{projection.half, {0}, {}};
  for (const FrameFlux& part : parts)
    cells.cumulative.push_back(cells.cumulative.back() + (total > 0 ? (1 - alike) * part.mean / total : 0) +
                               (part.most > 0 ? alike / shining : 0));
  const double sum = cells.cumulative.back();
  for (double& c : cells.cumulative) c = sum > 0 ? c / sum : 0;
  cells.guide = GuideTable(cells.cumulative, parts.size());
  how_ = std::move(cells);
}

void EmitterDirections::tabulate(const GoniometricShape& goniometric) {
  how_ = tabulate_image(*goniometric.image, goniometric.projection(), false).table;
}

EmitterDirections::Way EmitterDirections::in_cells(const Cells& cells, float u, float v, float choice) const {
  const std::size_t cell = cells.guide.bin(cells.cumulative, static_cast<double>(choice));
  const double share = cells.cumulative[cell + 1] - cells.cumulative[cell];
  if (!(share > 0)) return {};
  const auto i = static_cast<int>(cell);
  const double s = (i % Cells::side + static_cast<double>(u)) / Cells::side,
               t = (i / Cells::side + static_cast<double>(v)) / Cells::side;
  const Vector3d at{(2 * s - 1) * cells.half.x, (2 * t - 1) * cells.half.y, 1};
  const double area = 4 * cells.half.x * cells.half.y / (Cells::side * Cells::side);
  const double distance2 = dot(at, at);
  return {normalize(transform_vector(light_to_world_, at)), share / area * distance2 * std::sqrt(distance2)};
}

EmitterDirections::Way EmitterDirections::sample(float u, float v, float choice) const {
  if (const auto* cells = std::get_if<Cells>(&how_)) return in_cells(*cells, u, v, choice);
  if (const auto* table = std::get_if<DirectionTable>(&how_)) {
    // The map's +z is the light's +y (pbrt).
    const Vector3d d = table->sample(static_cast<double>(u), static_cast<double>(v));
    return {normalize(transform_vector(light_to_world_, {d.x, d.z, d.y})), table->pdf(d)};
  }
  const Cone& cone = std::get<Cone>(how_);
  const double z = 1 - static_cast<double>(u) * (1 - cone.least_z), r = safe_sqrt(1 - z * z);
  const double phi = 2 * pi * static_cast<double>(v);
  return {Frame(cone.axis).to_world({r * portable_cos(phi), r * portable_sin(phi), z}),
          1 / (2 * pi * (1 - cone.least_z))};
}

}  // namespace vitrail
