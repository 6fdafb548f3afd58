// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_model.h"

#include <algorithm>
#include <cmath>

#include "scene/daylight/daylight_illuminant.h"
#include "scene/daylight/photometry.h"
#include "scene/daylight/sky_tables.h"
#include "scene/geometry/pi.h"
#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// What the sun's data are of.
constexpr double model_sun_radius_rad = 0.5358 / 2 * radian;
// Of the sky's curves: so many that the rounding of floats is the greater part of what they are off by.
constexpr int gradient_segments = 64, scattering_segments = 128;

// Where x lies between whole numbers from 0 to `last`.
struct Between {
  std::size_t low = 0;
  double part = 0;  // of the next one
  Between(double x, int last) {
    const double held = std::clamp(x, 0.0, static_cast<double>(last));
    low = std::min(static_cast<std::size_t>(held), static_cast<std::size_t>(last - 1));
    part = held - static_cast<double>(low);
  }
};

double mix(double a, double b, double part) { return a + (b - a) * part; }

double band_nm(std::size_t band) { return first_sky_band_nm + sky_band_step_nm * static_cast<double>(band); }

double place_among_bands(double lambda_nm) { return (lambda_nm - first_sky_band_nm) / sky_band_step_nm; }

// Weights of the Bézier points, of degree 5.
std::array<double, 6> bezier(double t) {
  const double s = 1 - t, s2 = s * s, t2 = t * t;
  return {s2 * s2 * s, 5 * s2 * s2 * t, 10 * s2 * s * t2, 10 * s2 * t2 * t, 5 * s * t2 * t2, t2 * t2 * t};
}

double segment_begin_rad(std::size_t segment) {
  const double x = static_cast<double>(segment) / SkyTables::sun_segments;
  return pi / 2 * x * x * x;
}

std::size_t segment_of(double elevation_rad) {
  std::size_t low = 0, high = SkyTables::sun_segments;
  while (low + 1 < high) {
    const std::size_t middle = (low + high) / 2;
    (elevation_rad < segment_begin_rad(middle) ? high : low) = middle;
  }
  return low;
}

// Of an angle by its cosine, in [0, 1]: smooth but in its middle at 90°, and as the angle near both ends,
// where the glow and the exponential have no slope or one of the angle.
double place_of_angle(double cosine) {
  const double near = std::sqrt(1 - std::abs(cosine)) / 2;
  return cosine < 0 ? 1 - near : near;
}

double cosine_of_place(double place) {
  const double near = std::min(place, 1 - place), cosine = 1 - 4 * near * near;
  return place > 0.5 ? -cosine : cosine;
}

}  // namespace

SkyModel::SkyModel(const SkyLight& light)
    : to_sun_(light.to_sun),
      is_day_(light.to_sun.z >= 0),
      limb_darkening_(light.limb_darkening),
      sky_scale_(static_cast<double>(light.sky_scale)) {
  const double radius = static_cast<double>(light.sun_diameter_deg) / 2 * radian;
  sun_cosine_ = portable_cos(radius);
  sun_sine2_ = portable_sin(radius) * portable_sin(radius);
  const double half = portable_sin(model_sun_radius_rad / 2) / portable_sin(radius / 2);
  sun_scale_ = static_cast<double>(light.sun_scale) * half * half;  // 1 − cos x = 2 sin²(x/2)

  const std::optional<SkyDistribution>& given = *light.distribution;
  given ? set_given(*given, static_cast<double>(light.color_temperature_k)) : set_clear(light);
  if (has_sky()) make_curves();
  if (given && has_sky()) {  // what was relative till now
    const double lx = photometric(to_xyz(spectrum_of_bands(sky_irradiance())).y);
    for (double& radiance : radiance_) radiance *= lx > 0 ? sky_scale_ * given->diffuse_lx / lx : 0;
  }
  set_sun(light);
  set_ground(static_cast<double>(light.ground));
}

SkyModel SkyModel::without_sun() const {
  SkyModel sky = *this;
  sky.sun_scale_ = 0;
  return sky;
}

void SkyModel::set_clear(const SkyLight& light) {
  const SkyTables& tables = sky_tables();
  const double elevation = pi / 2 - portable_acos(to_sun_.z);
  const Between turbidity(static_cast<double>(light.turbidity) - 1, SkyTables::turbidities - 1);
  const auto weights = bezier(portable_pow(std::max(0.0, elevation) / (pi / 2), 1.0 / 3));
  // `value(turbidity, albedo, point)`
  const auto interpolated = [&](double albedo, auto&& value) {
    double sum = 0;
    for (std::size_t point = 0; point < weights.size(); ++point) {
      const auto at = [&](std::size_t t) {
        return mix(static_cast<double>(value(t, 0u, point)), static_cast<double>(value(t, 1u, point)),
                   albedo);
      };
      sum += weights[point] * mix(at(turbidity.low), at(turbidity.low + 1), turbidity.part);
    }
    return sum;
  };
  for (std::size_t b = 0; b < sky_bands; ++b) {
    const double albedo = std::clamp(evaluate(light.albedo, band_nm(b)), 0.0, 1.0);
    for (std::size_t i = 0; i < bands_[b].shape.size(); ++i)
      bands_[b].shape[i] = interpolated(albedo, [&](std::size_t t, std::size_t a, std::size_t point) {
        return tables.shape[t][a][point][b][i];
      });
    radiance_[b] = sky_scale_ * interpolated(albedo, [&](std::size_t t, std::size_t a, std::size_t point) {
                     return tables.radiance[t][a][point][b];
                   });
    horizon_[b] = static_cast<float>(bands_[b].shape[7]);
  }
}

// The same equation without its glow and its horizon.
void SkyModel::set_given(const SkyDistribution& sky, double color_temperature_k) {
  for (std::size_t b = 0; b < sky_bands; ++b) {
    bands_[b] = {{sky.a, sky.b, sky.base, sky.c, sky.d, sky.e, 0, 0, 0}, 0};
    radiance_[b] = color_temperature_k > 0
                       ? cie_daylight(band_nm(b), color_temperature_k)
                       : static_cast<double>(cie_d65()[static_cast<std::size_t>(band_nm(b) - lambda_min_nm)]);
  }
}

void SkyModel::make_curves() {
  gradient_ = BandCurves(gradient_segments,
                         [&](double root, std::size_t b) { return bands_[b].gradient(root * root); });
  scattering_ = BandCurves(scattering_segments, [&](double place, std::size_t b) {
    return bands_[b].scattering(cosine_of_place(place));
  });
}

void SkyModel::set_sun(const SkyLight& light) {
  const SkyTables& tables = sky_tables();
  const Between turbidity(static_cast<double>(light.turbidity) - 1, SkyTables::turbidities - 1);
  for (std::size_t s = 0; s < SkyTables::sun_segments; ++s)
    for (std::size_t b = 0; b < sky_bands; ++b)
      for (std::size_t k = 0; k < SkyTables::sun_powers; ++k)
        sun_.push_back(mix(static_cast<double>(tables.sun[turbidity.low][s][b][k]),
                           static_cast<double>(tables.sun[turbidity.low + 1][s][b][k]), turbidity.part));
  for (const auto& band : tables.limb)
    for (const float value : band) sun_.push_back(static_cast<double>(value));
  // Without limb darkening the disc has its mean, that of cosʲψ being 2/(j + 2), at its centre's elevation.
  SunDirection centre = sun_direction(to_sun_);
  for (std::size_t b = 0; b < sky_bands; ++b) {
    double mean = 0;
    for (std::size_t j = 0; j < SkyTables::limb_powers; ++j)
      mean += static_cast<double>(tables.limb[b][j]) * 2 / static_cast<double>(j + 2);
    centre.cos_psi = 1;
    double full = 0;
    for (std::size_t j = 0; j < SkyTables::limb_powers; ++j) full += static_cast<double>(tables.limb[b][j]);
    uniform_sun_[b] = sun(centre, b) * mean / full;
  }
}

// A white sheet on the ground would have 1/π of its irradiance as radiance.
void SkyModel::set_ground(double share) {
  const Vector3d up{0, 0, 1};
  has_ground_ = is_day_ && share > 0 && (has_sky() || has_sun());
  if (!has_ground_) return;
  const std::array<double, sky_bands> sun = sun_irradiance(up), sky = sky_irradiance(up);
  for (std::size_t b = 0; b < sky_bands; ++b) ground_[b] = share / pi * (sun[b] + sky[b]);
}

// Equation 8 of 2012, with √cos θ as the authors' program has it. Given skies end at cos θ = 0.01, as
// Radiance's do: below it Perez's exponential may rise without bound.
double SkyModel::Band::gradient(double cosine) const {
  return 1 + shape[0] * portable_exp(shape[1] / std::max(cosine + above_horizon, 0.01));
}

double SkyModel::Band::scattering(double cos_gamma) const {
  const double c2 = cos_gamma * cos_gamma;
  const double base = 1 + shape[8] * shape[8] - 2 * shape[8] * cos_gamma;
  const double glow = (1 + c2) / (base * safe_sqrt(base));
  return shape[2] + shape[3] * portable_exp(shape[4] * portable_acos(cos_gamma)) + shape[5] * c2 +
         shape[6] * glow;
}

std::array<double, sky_bands> SkyModel::sky_by_formula(Vector3d d) const {
  std::array<double, sky_bands> result{};
  if (!has_sky() || d.z < 0) return result;
  const double cos_gamma = std::clamp(dot(d, to_sun_), -1.0, 1.0);
  for (std::size_t b = 0; b < sky_bands; ++b) {
    const Band& band = bands_[b];
    const double scattering = band.scattering(cos_gamma) + band.shape[7] * std::sqrt(d.z);
    result[b] = std::max(0.0, band.gradient(d.z) * scattering * radiance_[b]);
  }
  return result;
}

BandValues SkyModel::relative_sky(Vector3d d) const {
  const double root_cosine = std::sqrt(std::max(0.0, d.z));
  const BandValues gradient = gradient_.at(root_cosine);
  const BandValues scattering = scattering_.at(place_of_angle(std::clamp(dot(d, to_sun_), -1.0, 1.0)));
  const auto root = static_cast<float>(root_cosine);
  BandValues values;
  for (std::size_t b = 0; b < band_lanes; ++b) {
    const float value = gradient[b] * (scattering[b] + horizon_[b] * root);
    values[b] = value > 0 ? value : 0;
  }
  return values;
}

SkyModel::Curves SkyModel::curves() const {
  return {gradient_.table(), scattering_.table(), horizon_.data(), radiance_.data()};
}

SkyModel::SunDirection SkyModel::sun_direction(Vector3d d) const {
  const double elevation = pi / 2 - portable_acos(std::max(0.0, d.z));
  const std::size_t segment = segment_of(elevation);
  const Vector3d across = cross(d, to_sun_);  // sin γ, exact also where the cosine is nearly 1
  return {segment, elevation - segment_begin_rad(segment), safe_sqrt(1 - dot(across, across) / sun_sine2_)};
}

double SkyModel::sun(const SunDirection& at, std::size_t band) const {
  const double* c = &sun_[(at.segment * sky_bands + band) * SkyTables::sun_powers];
  const double x = at.above_rad, clear = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
  const double* limb =
      &sun_[SkyTables::sun_segments * sky_bands * SkyTables::sun_powers + band * SkyTables::limb_powers];
  double dark = 0;
  for (std::size_t j = SkyTables::limb_powers; j-- > 0;) dark = dark * at.cos_psi + limb[j];
  return std::max(0.0, clear * dark * sun_scale_);
}

namespace {

// Of what `value(band)` gives, at the wavelengths.
template <class F>
SampledSpectrum sampled(const SampledWavelengths& wavelengths, F&& value) {
  // Side by side, without branches that no one can foretell.
  std::array<int, hero_count> low;
  std::array<double, hero_count> part;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double x = place_among_bands(static_cast<double>(wavelengths.lambda_nm[i]));
    const double above = x > 0 ? x : 0, held = above < sky_bands - 1 ? above : sky_bands - 1;
    const int below = static_cast<int>(held);
    low[i] = below < sky_bands - 2 ? below : sky_bands - 2;
    part[i] = held - low[i];
  }
  SampledSpectrum result;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const auto b = static_cast<std::size_t>(low[i]);
    result.v[i] = static_cast<float>(mix(value(b), value(b + 1), part[i]));
  }
  return result;
}

template <class F>
std::array<double, sky_bands> each_band(F&& value) {
  std::array<double, sky_bands> result;
  for (std::size_t b = 0; b < sky_bands; ++b) result[b] = value(b);
  return result;
}

void add(std::array<double, sky_bands>& sum, const std::array<double, sky_bands>& values, double weight) {
  for (std::size_t b = 0; b < sky_bands; ++b) sum[b] += values[b] * weight;
}

}  // namespace

SampledSpectrum SkyModel::ground(const SampledWavelengths& wavelengths) const {
  return sampled(wavelengths, [&](std::size_t b) { return ground_[b]; });
}

SampledSpectrum SkyModel::sky(Vector3d d, const SampledWavelengths& wavelengths) const {
  if (d.z < 0) return has_ground() ? ground(wavelengths) : filled(0);
  if (!has_sky()) return filled(0);
  const BandValues values = relative_sky(d);
  return sampled(wavelengths, [&](std::size_t b) { return static_cast<double>(values[b]) * radiance_[b]; });
}

std::array<double, sky_bands> SkyModel::sky(Vector3d d) const {
  if (d.z < 0) return ground_;
  if (!has_sky()) return {};
  const BandValues values = relative_sky(d);
  return each_band([&](std::size_t b) { return static_cast<double>(values[b]) * radiance_[b]; });
}

SampledSpectrum SkyModel::sun(Vector3d d, const SampledWavelengths& wavelengths) const {
  if (!meets_sun(d)) return filled(0);
  if (!limb_darkening_) return sampled(wavelengths, [&](std::size_t b) { return uniform_sun_[b]; });
  const SunDirection at = sun_direction(d);
  return sampled(wavelengths, [&](std::size_t b) { return sun(at, b); });
}

std::array<double, sky_bands> SkyModel::sun(Vector3d d) const {
  if (!meets_sun(d)) return {};
  if (!limb_darkening_) return uniform_sun_;
  const SunDirection at = sun_direction(d);
  return each_band([&](std::size_t b) { return sun(at, b); });
}

std::array<double, sky_bands> SkyModel::sun_irradiance(Vector3d normal) const {
  std::array<double, sky_bands> sum{};
  if (!has_sun()) return sum;
  // Midpoints in w, the cosine ψ that limb darkening is smooth in: 1 − cos γ = (1 − w²)(1 − cos of the
  // radius).
  constexpr int rings = 48, spokes = 64;
  const Vector3d u = normalize(
                     cross(std::abs(to_sun_.x) < 0.5 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0}, to_sun_)),
                 v = cross(to_sun_, u);
  const double whole = sun_sine2_ / (1 + sun_cosine_);  // 1 − cos of the radius
  for (int ring = 0; ring < rings; ++ring) {
    const double w = (ring + 0.5) / rings, below = whole * (1 - w * w);
    const double cosine = 1 - below, sine = safe_sqrt(below * (2 - below));
    const double cell = 2 * pi * whole * 2 * w / (rings * spokes);
    for (int spoke = 0; spoke < spokes; ++spoke) {
      const double phi = 2 * pi * (spoke + 0.5) / spokes;
      const Vector3d d = to_sun_ * cosine + (u * portable_cos(phi) + v * portable_sin(phi)) * sine;
      add(sum, sun(d), cell * std::max(0.0, dot(d, normal)));
    }
  }
  return sum;
}

std::array<double, sky_bands> SkyModel::sky_irradiance(Vector3d normal) const {
  std::array<double, sky_bands> sum{};
  // A plane has the part (1 − z)/2 of what it would have from all around.
  if (has_ground()) add(sum, ground_, pi * (1 - normal.z) / 2);
  if (!has_sky()) return sum;
  constexpr int rows = 128, columns = 256;  // uniform in θ, where the model bends at the horizon
  const double step = pi / 2 / rows;
  for (int row = 0; row < rows; ++row) {
    const double theta = (row + 0.5) * step, cosine = portable_cos(theta), sine = portable_sin(theta);
    for (int column = 0; column < columns; ++column) {
      const double phi = 2 * pi * (column + 0.5) / columns;
      const Vector3d d{sine * portable_cos(phi), sine * portable_sin(phi), cosine};
      const double facing = dot(d, normal);
      if (facing > 0) add(sum, sky(d), facing * sine * step * (2 * pi / columns));
    }
  }
  return sum;
}

TabulatedSpectrum spectrum_of_bands(const std::array<double, sky_bands>& values) {
  TabulatedSpectrum spectrum;
  for (int i = 0; i < table_size; ++i) {
    const Between at(place_among_bands(lambda_min_nm + i), sky_bands - 1);
    spectrum.values.push_back(static_cast<float>(mix(values[at.low], values[at.low + 1], at.part)));
  }
  return spectrum;
}

}  // namespace vitrail
