// SPDX-License-Identifier: Apache-2.0
// Environments are images of radiance around the scene.
#pragma once

#include <memory>

#include "scene/daylight/sky_model.h"
#include "scene/records/light.h"
#include "tracer/lights/direction_table.h"
#include "tracer/lights/light_image.h"

namespace vitrail {

// A DirectionFrame rotates directions, perhaps with a mirror. It is the transform's frame, made orthonormal
// from its z axis on.
struct DirectionFrame {
  Vector3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // of the light, in the world
  explicit DirectionFrame(const Transform& light_to_world);
  DirectionFrame() = default;
  Vector3d to_light(Vector3d d) const { return {dot(d, x), dot(d, y), dot(d, z)}; }
  Vector3d to_world(Vector3d d) const { return x * d.x + y * d.y + z * d.z; }
};

// An Environment is an image, or a sky with its sun.
struct Environment {
  std::shared_ptr<const LightImage> image;
  std::shared_ptr<const SkyModel> sky;  // where there is no image
  double sun_share = 0;                 // of the samples, uniform over the sun's disc
  SphereProjection projection = SphereProjection::equal_area;
  DirectionFrame frame;
  Spectrum scale = ConstantSpectrum{1};
  float factor = 1;  // beside `scale`
  DirectionTable table;
  double mean_luminance = 0;  // over all directions, all factors included
  double sun_luminance = 0;   // of its disc's middle
  std::uint32_t light = 0;    // index into LightScene::lights
};

Environment make_environment(const EnvironmentLight& light, std::shared_ptr<const LightImage> image);
// `sun` says whether the disc is seen; the ground has its light in either case.
Environment make_environment(const SkyLight& light, bool sun = true);

struct EnvironmentValue {
  SampledSpectrum radiance;
  double pdf = 0;  // of sample_direction, solid angle
};
// `direction` is unit, in the world.
EnvironmentValue value_towards(const Environment& environment, Vector3d direction,
                               const SampledWavelengths& wavelengths);
// Samples a direction over the sun's disc, uniform per solid angle, in the sky's own frame. u and v are in
// [0,1).
Vector3d sample_sun(const SkyModel& sky, double u, double v);
// u and v are in [0,1).
Vector3d sample_direction(const Environment& environment, double u, double v);

// Looks up the image at a point of the sphere's picture. An equal-area map gives the nearest texel, as in
// pbrt-v4. A map by latitude and longitude is bilinear as in Mitsuba: its first and last row lie on the
// poles.
SampledSpectrum look_up(const LightImage& image, SphereProjection projection, Point2d at,
                        const SampledWavelengths& wavelengths);

// Returns the radiance of an environment's image, all factors included.
SampledSpectrum radiance_of_image(const Environment& environment, Point2d at,
                                  const SampledWavelengths& wavelengths);
SampledSpectrum scale_of(const Environment& environment, const SampledWavelengths& wavelengths);
// They return the scale where it is a constant, else null, and the image where it is a baked one, else null.
const float* constant_scale_of(const Environment& environment);
const BakedImage* baked_image_of(const Environment& environment);

// It is a density for sampling that image, with a floor. It is about the image's luminance. With
// `beside_bsdf` it is about the luminance above the mean: samples of the BSDF find the rest (Karlík et al.,
// "MIS Compensation", 2019). `flux` is ∫ Y dω within about 1 %.
struct ImageTable {
  DirectionTable table;
  double flux = 0;
};
ImageTable tabulate_image(const LightImage& image, SphereProjection projection, bool beside_bsdf);

// Returns ∫ Y dω, or with `upward` that of max(0,z)·Y, over all texels.
double flux_of(const LightImage& image, SphereProjection projection, bool upward);

}  // namespace vitrail
