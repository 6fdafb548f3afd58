// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/film_exponent.h"

#include <algorithm>
#include <cmath>

#include "film/film.h"
#include "scene/geometry/portable_math.h"
#include "scene/spectra/spectrum.h"
#include "tracer/media/grid.h"
#include "tracer/sampling/wavelengths.h"

namespace vitrail {

namespace {

// Of texels, over the mean of an image: so many could share the light of all.
constexpr double brighter_texel = 0x1p20;
// A light of no extent counts as one seen under 2⁻²⁰ sr: a smooth surface shows it so bright.
constexpr double brighter_point = 0x1p20;
// Square of how near a light of no extent comes to a surface, to the farthest that it lights.
constexpr double nearest2 = 0x1p-30;
// A surface that is lit by E across it has the radiance E/π; a grazed or dark one less.
constexpr double dimmer_surface = 0.25;

double greatest(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum))
    return static_cast<double>(*std::max_element(table->values.begin(), table->values.end()));
  constexpr double step_nm = 1;
  double most = 0;
  for (double nm = lambda_min_nm; nm <= lambda_max_nm; nm += step_nm)
    most = std::max(most, evaluate(spectrum, nm));
  return most;
}

class Tally {
 public:
  void add(double dim, double bright) {
    if (!(dim > 0) || !std::isfinite(dim) || !(bright > 0) || !std::isfinite(bright)) return;
    if (!range_) range_ = {dim, bright};
    range_->dimmest = std::min(range_->dimmest, dim);
    range_->brightest = std::max({range_->brightest, dim, bright});
  }
  void add(const Spectrum& radiance, double factor) {
    add(factor * luminance(radiance), factor * greatest(radiance));
  }
  const std::optional<LightRange>& range() const { return range_; }

 private:
  std::optional<LightRange> range_;
};

void add_surfaces(const LightSampler& s, Tally& tally) {
  for (const AreaLight& light : s.scene.area_lights)
    if (const auto* radiance = std::get_if<Spectrum>(&light.radiance))
      tally.add(*radiance, static_cast<double>(light.scale));
  for (std::size_t i = 0; i < s.glows.size(); ++i)
    if (const Glow& glow = s.glows[i]; !std::holds_alternative<Spectrum>(s.scene.area_lights[i].radiance))
      tally.add(glow.mean, std::max(glow.most, glow.mean * brighter_texel));
}

// By the irradiance that they give the nearest and the farthest corner of the scene.
void add_points(const LightSampler& s, Tally& tally) {
  const Bounds3f& box = s.scene.bounds;
  const double diagonal = box.empty() ? 1 : length(cast<double>(extent(box)));
  for (const PointEmitter& e : s.emitters) {
    double far = diagonal, near2 = 0;
    for (int axis = 0; axis < 3 && !box.empty(); ++axis) {
      const double below = static_cast<double>(box.lower[axis]) - e.position[axis],
                   above = e.position[axis] - static_cast<double>(box.upper[axis]);
      const double outside = std::max({below, above, 0.0});
      near2 += outside * outside;
      far = std::max({far, std::abs(below), std::abs(above)});
    }
    if (e.fading) {
      const double at_once = luminance(*e.intensity) * static_cast<double>(e.shape->factor);
      tally.add(at_once * weakened(e, far) * dimmer_surface,
                at_once * weakened(e, std::sqrt(near2)) * brighter_point);
      continue;
    }
    const double intensity = e.flux / (4 * pi);
    tally.add(intensity / (far * far) * dimmer_surface,
              intensity / std::max(near2, far * far * nearest2) * brighter_point);
  }
}

void add_far_lights(const LightSampler& s, Tally& tally) {
  for (const LightSampler::Distant& d : s.distant) {
    tally.add(luminance(d.irradiance) * dimmer_surface, greatest(d.irradiance) * brighter_point);
  }
  for (const std::uint32_t light : s.infinite)
    tally.add(std::get<InfiniteLight>(s.scene.lights[light].model).radiance, 1);
  for (const Environment& e : s.environments)
    tally.add(e.mean_luminance, std::max(e.mean_luminance * brighter_texel, e.sun_luminance));
}

// A thin medium glows by a part of its emission.
void add_media(const Manifest& m, Tally& tally) {
  constexpr double thin = 0x1p-10;
  for (const Medium& medium : m.media) {
    if (!medium.emission) continue;
    double scale = 1;
    if (medium.emission_scale) scale = greatest_value(*medium.emission_scale);
    tally.add(luminance(*medium.emission) * thin, greatest(*medium.emission) * scale);
  }
}

}  // namespace

std::optional<LightRange> light_range(const RenderScene& scene) {
  Tally tally;
  add_surfaces(scene.lights, tally);
  add_points(scene.lights, tally);
  add_far_lights(scene.lights, tally);
  add_media(scene.manifest, tally);
  return tally.range();
}

int film_exponent(const LightRange& range, double brighter, bool splats) {
  constexpr int below = 40, above = 40, least_above = 16;
  const int dim = std::ilogb(range.dimmest), bright = std::ilogb(range.brightest * std::max(brighter, 1.0));
  const int top = bright - deposit_bits(splats);
  const int exponent = std::clamp(dim - below, top + least_above, top + above);
  return std::clamp(exponent, least_exponent, greatest_exponent);
}

int film_exponent(const RenderScene& scene) {
  double brighter = std::abs(scene.filter.weight(0, 0));
  const SpectralBins& bins = scene.manifest.film.spectrum;
  if (bins.count > 0) brighter *= std::max(1.0, greatest_bin_weight(bins));
  return film_exponent(light_range(scene).value_or(LightRange{1, 1}), brighter, scene.sampling.splat);
}

int length_exponent(const RenderScene& scene) {
  const Manifest& m = scene.manifest;
  const Transform& camera =
      std::visit([](const auto& c) -> const Transform& { return c.camera_to_world; }, m.camera);
  double reach = static_cast<double>(m.scale);
  const auto extend = [&](const Transform& t) {
    for (std::size_t axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(t.m[axis][3]));
  };
  for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(m.offset[axis]));
  extend(camera);
  for (const Keyframe& key : m.camera_motion.keys()) extend(key.transform);
  if (!(reach > 0)) return default_exponent;
  return std::clamp(std::ilogb(reach) + default_exponent, least_exponent, greatest_exponent);
}

}  // namespace vitrail
