// SPDX-License-Identifier: Apache-2.0
// It is the clear sky of Hošek and Wilkie ("An analytic model for full spectral sky-dome radiance", 2012) and
// their sun ("Adding a solar-radiance function to the Hošek-Wilkie skylight model", 2013): ten bands from 360
// to 720 nm, linear in between, held beyond; linear in turbidity and albedo, as Mitsuba 3 has them. A sky
// with a distribution of its own (sky_distribution.h) is the CIE's daylight in these bands, under the same
// sun. All numbers have the same bits on every machine.
#pragma once

#include <array>
#include <vector>

#include "scene/daylight/band_curves.h"
#include "scene/geometry/vec.h"
#include "scene/records/light.h"
#include "scene/spectra/sampled_spectrum.h"

namespace vitrail {

inline constexpr double first_sky_band_nm = 360, sky_band_step_nm = 40;

// It holds the model with all that does not depend on the direction worked out. Directions are unit and of
// the light's frame, +z up; radiances W·m⁻²·sr⁻¹·nm⁻¹, the light's scales included.
class SkyModel {
 public:
  explicit SkyModel(const SkyLight& light);
  // Returns the same sky and ground without the sun's disc.
  SkyModel without_sun() const;

  // Returns false at night, when all is 0. There is no twilight in the model.
  bool is_day() const { return is_day_; }
  bool has_sky() const { return is_day_ && sky_scale_ > 0; }
  bool has_sun() const { return is_day_ && sun_scale_ > 0; }
  bool has_ground() const { return has_ground_; }
  Vector3d to_sun() const { return to_sun_; }
  double sun_cosine() const { return sun_cosine_; }  // of the disc's angular radius
  bool meets_sun(Vector3d d) const { return has_sun() && d.z >= 0 && dot(d, to_sun_) >= sun_cosine_; }

  // Returns the radiance of the sky or the ground, and of the sun alone where the direction meets it.
  SampledSpectrum sky(Vector3d d, const SampledWavelengths& wavelengths) const;
  SampledSpectrum sun(Vector3d d, const SampledWavelengths& wavelengths) const;
  std::array<double, sky_bands> sky(Vector3d d) const;
  std::array<double, sky_bands> sun(Vector3d d) const;
  // Returns the radiance of all that is below the horizon.
  SampledSpectrum ground(const SampledWavelengths& wavelengths) const;
  std::array<double, sky_bands> ground() const { return ground_; }
  // Returns the paper's formula, from which the sky's curves are made. sky() is off by no more than 5·10⁻⁶ of
  // this and a hundredth of the band's mean.
  std::array<double, sky_bands> sky_by_formula(Vector3d d) const;

  // Returns ∫ L cos θ dω over the part of the sun's disc above the horizon and before a plane with this unit
  // normal, W·m⁻²·nm⁻¹. Along to_sun() it is the irradiance of parallel light in its place.
  std::array<double, sky_bands> sun_irradiance(Vector3d normal) const;
  // Returns ∫ L cos θ dω over the part of the sky and the ground before a plane with this unit normal. For a
  // plane that faces up it is exact within 10⁻⁴.
  std::array<double, sky_bands> sky_irradiance(Vector3d normal = {0, 0, 1}) const;

  // These are the tables that the sky alone is computed from, as BandCurves and sky() have them. They serve
  // to compute several directions at a time.
  struct Curves {
    BandCurves::Table gradient, scattering;  // of √cos θ; of the place of the angle to the sun
    const float* horizon;                    // [band_lanes]: H of the paper's equation 8
    const double* radiance;                  // [sky_bands]: the sky's mean; the scale included
  };
  Curves curves() const;

 private:
  struct Band {
    std::array<double, 9> shape{};  // A … I of the paper's equation 8
    double above_horizon = 0.01;    // added to cos θ there
    double gradient(double cosine) const;
    double scattering(double cos_gamma) const;  // without what depends on θ
  };
  struct SunDirection {
    std::size_t segment;
    double above_rad;  // the segment's beginning
    double cos_psi;    // between the line of sight and the sun's normal
  };
  void set_clear(const SkyLight& light);  // the bands
  void set_given(const SkyDistribution& sky, double color_temperature_k);
  void set_sun(const SkyLight& light);
  void set_ground(double share);
  void make_curves();
  BandValues relative_sky(Vector3d d) const;  // of each band's `radiance`
  SunDirection sun_direction(Vector3d d) const;
  double sun(const SunDirection& at, std::size_t band) const;

  Vector3d to_sun_;
  bool is_day_ = false, limb_darkening_ = true, has_ground_ = false;
  double sky_scale_ = 1, sun_scale_ = 1;  // the latter times what another diameter makes of it
  double sun_cosine_ = 1, sun_sine2_ = 0;
  std::array<Band, sky_bands> bands_;
  BandCurves gradient_, scattering_;
  BandValues horizon_{};
  std::array<double, sky_bands> radiance_{};
  std::array<double, sky_bands> uniform_sun_{};  // radiance of a disc without limb darkening
  std::array<double, sky_bands> ground_{};
  std::vector<double> sun_;  // [segment][band][power of the elevation], then limb [band][power of cos ψ]
};

// Returns the bands' values as a spectrum.
TabulatedSpectrum spectrum_of_bands(const std::array<double, sky_bands>& values);

}  // namespace vitrail
