// SPDX-License-Identifier: Apache-2.0
// A RenderScene is what every rank holds of the scene besides domains, prepared for tracing.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "bundle/interiors.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/media/free_flight.h"
#include "tracer/prepared/daylight_rows.h"
#include "tracer/prepared/grouped_lights.h"
#include "tracer/prepared/lane_scene.h"
#include "tracer/prepared/matte_ids.h"
#include "tracer/prepared/sampling_choices.h"
#include "tracer/rays/cell_ways.h"
#include "tracer/sampling/sampler.h"
#include "tracer/surfaces/surface_materials.h"
#include "tracer/view/camera_rays.h"
#include "tracer/view/pixel_filter.h"

namespace vitrail {

struct RenderScene {
  // `texture_bytes` is the memory for tiles of images. Throws Error for texture files that are damaged.
  RenderScene(Manifest manifest, const std::filesystem::path& bundle, std::uint64_t texture_bytes,
              std::uint64_t seed, const SamplingChoices& sampling = {});
  RenderScene(const RenderScene&) = delete;  // its parts refer to each other
  RenderScene& operator=(const RenderScene&) = delete;

  Manifest manifest;
  std::vector<BvhNode> domain_tree;
  CellWays cell_ways;
  Interiors interiors;
  CameraSampler camera;
  FilterSampler filter;
  Textures textures;
  Materials materials;
  std::vector<PreparedMedium> media;
  LightSampler lights;
  LaneScene lanes;
  Transform bundle_to_camera;
  // It is the place of the camera that sensors stand in for. What is known to be around it tells what is
  // around all sensors. None: the camera's medium is around all of them.
  std::optional<Point3d> replaced_camera;
  double pixel_angle = 0;  // between neighbouring camera rays in the middle of the picture, rad
  // A pixel is width + angle · distance wide at a distance. 0: it sees no edges.
  struct Pixel {
    double width = 0, angle_rad = 0;
  } pixel;
  PictureSeed seed;
  SamplingChoices sampling;
  GroupedLights groups;
  DaylightRows daylight;
  bool uvs_show = true;  // some texture or a layer of the film may read (u,v)
  MatteIds mattes;
};

// Returns the surface that the hit's triangle belongs to; `domain` holds the hit.
const Surface& surface_of(const Manifest& manifest, const DomainView& domain, const Hit& hit);

}  // namespace vitrail
