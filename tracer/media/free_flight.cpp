// SPDX-License-Identifier: Apache-2.0
#include "tracer/media/free_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/geometry/portable_math.h"
#include "tracer/media/blackbody.h"
#include "tracer/media/grid.h"

namespace vitrail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// A flight takes this many steps at most; what is left of it is given up. Reached only where the greatest
// density is far beyond what light passes.
constexpr int most_steps = 1 << 20;

using Values = std::array<double, hero_count>;

double exponential(double u) { return -portable_log(1 - u); }  // u < 1

Values at_wavelengths(const Spectrum& spectrum, const SampledWavelengths& w) {
  Values v;
  for (std::size_t i = 0; i < hero_count; ++i)
    v[i] = std::max(0.0, evaluate(spectrum, static_cast<double>(w.lambda_nm[i])));
  return v;
}

using Wavelengths = std::array<double, hero_count>;

// Of one channel: the same at all wavelengths.
Values at_point(const Grid& grid, const Wavelengths& lambda_nm, Point3d p) {
  Values v;
  if (has_colors(grid))
    look_up_colors(grid, p, lambda_nm, v);
  else
    v.fill(look_up(grid, p, 0));
  return v;
}

// The coefficients of a medium at the wavelengths of a path.
class Coefficients {
 public:
  Coefficients(const PreparedMedium& m, const SampledWavelengths& w) : m_(m) {
    const auto constant = [&](const VolumeParameter& v) {
      const auto* s = std::get_if<Spectrum>(&v);
      return s ? at_wavelengths(*s, w) : Values{};
    };
    if (const auto* k = std::get_if<AbsorptionScattering>(&m.medium->coefficients))
      first_volume_ = &k->sigma_a, second_volume_ = &k->sigma_s, is_sum_ = true;
    else if (const auto* e = std::get_if<ExtinctionAlbedo>(&m.medium->coefficients))
      first_volume_ = &e->sigma_t, second_volume_ = &e->albedo;
    first_ = constant(*first_volume_);
    second_ = constant(*second_volume_);
    for (std::size_t i = 0; i < hero_count; ++i) constants_[i] = is_sum_ ? first_[i] + second_[i] : first_[i];
    scale_ = static_cast<double>(m.medium->scale);
    std::copy(w.lambda_nm.begin(), w.lambda_nm.end(), lambda_nm_.begin());
  }

  // σ_t and σ_s at a point of the medium's space.
  void at(Point3d p, Values& sigma_t, Values& sigma_s) const {
    double density = scale_;
    if (const auto* grid = std::get_if<Grid>(&m_.medium->density)) density *= look_up(*grid, p, 0);
    const auto there = [&](const VolumeParameter& volume, const Values& everywhere) {
      const auto* grid = std::get_if<Grid>(&volume);
      return grid ? at_point(*grid, lambda_nm_, p) : everywhere;
    };
    const Values a = there(*first_volume_, first_), b = there(*second_volume_, second_);
    for (std::size_t i = 0; i < hero_count; ++i) {
      sigma_s[i] = density * (is_sum_ ? b[i] : a[i] * b[i]);
      sigma_t[i] = density * (is_sum_ ? a[i] + b[i] : a[i]);
    }
  }

  Values emission_scale(Point3d p) const {
    const Medium& medium = *m_.medium;
    Values scale;
    scale.fill(1);
    if (medium.emission_scale) scale = at_point(*medium.emission_scale, lambda_nm_, p);
    if (!medium.temperature) return scale;
    const double kelvin =
        (look_up(*medium.temperature, p, 0) - static_cast<double>(medium.temperature_offset)) *
        static_cast<double>(medium.temperature_scale);
    for (std::size_t i = 0; i < hero_count; ++i) scale[i] *= blackbody_radiance(kelvin, lambda_nm_[i]);
    return scale;
  }

  // k (ExtinctionRange) at each wavelength, and the greatest of them.
  double greatest_constant() const { return *std::ranges::max_element(constants_); }
  const Values& constants() const { return constants_; }

 private:
  const PreparedMedium& m_;
  const VolumeParameter* first_volume_ = nullptr;
  const VolumeParameter* second_volume_ = nullptr;
  Values first_{}, second_{}, constants_{};
  Wavelengths lambda_nm_{};
  double scale_ = 1;
  bool is_sum_ = false;
};

double attenuation(double sigma, double t) {
  const double depth = sigma * t;  // ∞·0 is no medium
  return sigma <= 0 ? 1 : depth > 700 ? 0 : portable_exp(-depth);
}

// A wavelength, index < active, with a probability in proportion to the throughput.
std::size_t choose_wavelength(const SampledSpectrum& throughput, std::size_t active, double u) {
  double sum = 0;
  for (std::size_t i = 0; i < active; ++i) sum += static_cast<double>(throughput.v[i]);
  double left = u * sum;
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < active; ++i) {
    if (!(throughput.v[i] > 0)) continue;
    chosen = i;
    left -= static_cast<double>(throughput.v[i]);
    if (left < 0) break;
  }
  return chosen;
}

FlightSample sample_homogeneous(const Coefficients& coefficients, double t_max, std::size_t active,
                                const SampledSpectrum& glow, const SampledSpectrum& throughput,
                                RandomStream& random) {
  Values sigma_t, sigma_s;
  coefficients.at({}, sigma_t, sigma_s);
  FlightSample s;
  // ∫₀^{t_max} e^{−σ_t x} σ_a L dx = (1 − e^{−σ_t t_max})·(1 − σ_s/σ_t)·L.
  if (!is_black(glow))
    for (std::size_t i = 0; i < active; ++i)
      if (sigma_t[i] > 0)
        s.emitted.v[i] = glow.v[i] * static_cast<float>((1 - attenuation(sigma_t[i], t_max)) *
                                                        (1 - sigma_s[i] / sigma_t[i]));
  // What only absorbs is no matter of chance: Beer and Lambert.
  if (std::all_of(sigma_s.begin(), sigma_s.end(), [](double x) { return x == 0; })) {
    for (std::size_t i = 0; i < active; ++i)
      s.weight.v[i] = static_cast<float>(attenuation(sigma_t[i], t_max));
    return s;
  }
  const std::size_t chosen = choose_wavelength(throughput, active, random.next());
  const double distance = exponential(random.next());
  const double t = sigma_t[chosen] > 0 ? distance / sigma_t[chosen] : infinity;
  const bool arrives = t >= t_max;
  if (!arrives) s.scattered_at = t;
  double pdf = 0, sum = 0;
  Values through;
  for (std::size_t i = 0; i < active; ++i) {
    const auto w = static_cast<double>(throughput.v[i]);
    through[i] = attenuation(sigma_t[i], arrives ? t_max : t);
    pdf += w * (arrives ? through[i] : through[i] * sigma_t[i]);
    sum += w;
  }
  pdf /= sum;
  // The chosen wavelength has a density above 0 here, unless it underflowed.
  for (std::size_t i = 0; i < active && pdf > 0; ++i)
    s.weight.v[i] = static_cast<float>((arrives ? through[i] : through[i] * sigma_s[i]) / pdf);
  return s;
}

// The part of a flight within the bounds of a medium, in the medium's space; t stays the flight's.
struct Inside {
  Point3d p;
  Vector3d d;
  double t0 = 0, t1 = 0;
};
Inside inside(const PreparedMedium& m, const Flight& f) {
  Inside in{transform_point(m.to_medium, f.p), transform_vector(m.to_medium, f.d), 0, f.t_max};
  const Bounds3d& bounds = m.extinction.bounds;
  if (bounds.empty()) return in;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = in.d[axis], lower = bounds.lower[axis] - in.p[axis],
                 upper = bounds.upper[axis] - in.p[axis];
    if (std::abs(d) < 1e-300) {
      if (lower > 0 || upper < 0) in.t1 = -1;
      continue;
    }
    in.t0 = std::max(in.t0, std::min(lower / d, upper / d));
    in.t1 = std::min(in.t1, std::max(lower / d, upper / d));
  }
  return in;
}

// Where a flight may collide: points with a density, per unit of length, that each cell of the medium has.
class Collisions {
 public:
  // The flight meets the medium.
  Collisions(const PreparedMedium& m, const Inside& in)
      : in_(in), walk_(m.extinction, in.p, in.d, in.t0, in.t1), t_(in.t0) {}

  // Moves on to the next one. `density_of` gives the density for a cell's range, ≥ 0; `passed(range, length)`
  // is called for each stretch between. False where there is none before the end.
  template <class DensityOf, class Passed>
  bool advance(RandomStream& random, const DensityOf& density_of, const Passed& passed) {
    double depth = exponential(random.next());
    for (;;) {
      density_ = density_of(walk_.range());
      const double length = walk_.end() - t_;
      if (density_ > 0 && depth < density_ * length) {
        passed(walk_.range(), depth / density_);
        t_ += depth / density_;
        return true;
      }
      if (density_ > 0) depth -= density_ * length;
      passed(walk_.range(), length);
      t_ = walk_.end();
      if (!walk_.advance()) return false;
    }
  }

  double t() const { return t_; }
  Point3d p() const { return in_.p + in_.d * t_; }
  const ExtinctionRange& range() const { return walk_.range(); }
  double density() const { return density_; }  // > 0

 private:
  const Inside& in_;
  CellWalk walk_;
  double t_, density_ = 0;
};

// Collisions per unit of length at least, so that a grid that shines is met however thin it is: the more of
// them are null, the less chance is in what it adds.
double least_majorant(const PreparedMedium& m, const SampledSpectrum& glow) {
  constexpr double least_collisions = 8;  // along the diagonal
  if (is_black(glow)) return 0;
  const Bounds3d& bounds = m.extinction.bounds;
  const std::optional<Grid>& glow_grid =
      m.medium->emission_scale ? m.medium->emission_scale : m.medium->temperature;
  const Bounds3d& box = bounds.empty() && glow_grid ? glow_grid->bounds : bounds;
  if (box.empty()) return 0;
  return least_collisions / length(transform_vector(m.medium->medium_to_world, extent(box)));
}

SampledSpectrum glow_of(const PreparedMedium& m, const SampledWavelengths& w) {
  SampledSpectrum glow;
  if (!m.medium->emission) return glow;
  const Values v = at_wavelengths(*m.medium->emission, w);
  for (std::size_t i = 0; i < hero_count; ++i) glow.v[i] = static_cast<float>(v[i]);
  return glow;
}

}  // namespace

PreparedMedium prepare(const Medium& medium) {
  PreparedMedium m;
  m.medium = &medium;
  m.to_medium = inverse(medium.medium_to_world);
  m.g = static_cast<double>(medium.g);
  // Outside of a density and of a grid of extinction, or of what it is the sum of, there is nothing.
  Bounds3d bounds;
  if (const auto* e = std::get_if<ExtinctionAlbedo>(&medium.coefficients))
    if (const auto* grid = std::get_if<Grid>(&e->sigma_t)) bounds = grid->bounds;
  if (const auto* grid = std::get_if<Grid>(&medium.density)) {
    m.homogeneous = false;
    bounds = grid->bounds;
  }
  const auto varies = [](const auto& v) { return std::holds_alternative<Grid>(v); };
  if (const auto* k = std::get_if<AbsorptionScattering>(&medium.coefficients)) {
    m.homogeneous &= !varies(k->sigma_a) && !varies(k->sigma_s);
    for (const VolumeParameter* volume : {&k->sigma_a, &k->sigma_s})
      if (const auto* grid = std::get_if<Grid>(volume)) extend(bounds, grid->bounds);
  }
  if (const auto* k = std::get_if<ExtinctionAlbedo>(&medium.coefficients))
    m.homogeneous &= !varies(k->sigma_t) && !varies(k->albedo);
  m.homogeneous &= !medium.emission_scale && !medium.temperature;
  if (!m.homogeneous) m.extinction = bound_extinction(medium, bounds);
  return m;
}

std::vector<PreparedMedium> prepare(const std::vector<Medium>& media) {
  std::vector<PreparedMedium> prepared;
  for (const Medium& medium : media) prepared.push_back(prepare(medium));
  return prepared;
}

FlightSample sample_flight(const PreparedMedium& m, const Flight& flight,
                           const SampledWavelengths& wavelengths, std::size_t active,
                           const SampledSpectrum& throughput, RandomStream& random) {
  const Coefficients coefficients(m, wavelengths);
  const SampledSpectrum glow = glow_of(m, wavelengths);
  if (m.homogeneous) return sample_homogeneous(coefficients, flight.t_max, active, glow, throughput, random);

  FlightSample s{std::nullopt, filled(1), {}};
  const Inside in = inside(m, flight);
  if (!(in.t0 < in.t1)) return s;
  const double least = least_majorant(m, glow), constant = coefficients.greatest_constant();
  const auto majorant_of = [&](const ExtinctionRange& r) {
    return std::max(static_cast<double>(r.constants_high) * constant + static_cast<double>(r.grids_high),
                    least);
  };
  Collisions collisions(m, in);
  for (int step = 0; step < most_steps; ++step) {
    if (!collisions.advance(random, majorant_of, [](const ExtinctionRange&, double) {})) return s;
    const double majorant = collisions.density();
    Values sigma_t, sigma_s;
    coefficients.at(collisions.p(), sigma_t, sigma_s);
    double real = 0, sum = 0;
    for (std::size_t i = 0; i < active; ++i) {
      const double w = static_cast<double>(throughput.v[i]) * static_cast<double>(s.weight.v[i]);
      real += w * sigma_t[i] / majorant;
      sum += w;
    }
    if (!(sum > 0)) return s;
    const double p_real = std::clamp(real / sum, 0.0, 1.0);
    if (!is_black(glow)) {
      const Values scale = coefficients.emission_scale(collisions.p());
      for (std::size_t i = 0; i < active; ++i)
        s.emitted.v[i] +=
            s.weight.v[i] * glow.v[i] * static_cast<float>(scale[i] * (sigma_t[i] - sigma_s[i]) / majorant);
    }
    const bool is_real = random.next() < p_real;  // so that p of what happens is above 0
    for (std::size_t i = 0; i < active; ++i)
      s.weight.v[i] *= static_cast<float>(is_real ? sigma_s[i] / (majorant * p_real)
                                                  : std::max(0.0, 1 - sigma_t[i] / majorant) / (1 - p_real));
    if (is_real) {
      s.scattered_at = collisions.t();
      return s;
    }
  }
  s.weight = {};
  return s;
}

SampledSpectrum transmittance(const PreparedMedium& m, const Flight& flight,
                              const SampledWavelengths& wavelengths, RandomStream& random) {
  const Coefficients coefficients(m, wavelengths);
  SampledSpectrum through = filled(1);
  Values sigma_t, sigma_s;
  if (m.homogeneous) {
    coefficients.at({}, sigma_t, sigma_s);
    for (std::size_t i = 0; i < hero_count; ++i)
      through.v[i] = static_cast<float>(attenuation(sigma_t[i], flight.t_max));
    return through;
  }
  const Inside in = inside(m, flight);
  if (!(in.t0 < in.t1)) return through;
  const Values& constants = coefficients.constants();
  const double greatest = coefficients.greatest_constant();
  const auto residual_of = [&](const ExtinctionRange& r) {
    return (static_cast<double>(r.constants_high) - static_cast<double>(r.constants_low)) * greatest +
           (static_cast<double>(r.grids_high) - static_cast<double>(r.grids_low));
  };
  // ∫ of the least extinction since the last collision, as an ExtinctionRange has it.
  double constant_depth = 0, grid_depth = 0;
  const auto pass = [&](const ExtinctionRange& r, double length) {
    if (r.constants_low > 0) constant_depth += static_cast<double>(r.constants_low) * length;
    if (r.grids_low > 0) grid_depth += static_cast<double>(r.grids_low) * length;
  };
  const auto fade = [&] {
    for (std::size_t i = 0; i < hero_count; ++i)
      through.v[i] *= static_cast<float>(attenuation(constant_depth * constants[i] + grid_depth, 1));
    constant_depth = grid_depth = 0;
  };
  Collisions collisions(m, in);
  for (int step = 0; step < most_steps; ++step) {
    const bool collides = collisions.advance(random, residual_of, pass);
    fade();
    if (!collides) return through;
    coefficients.at(collisions.p(), sigma_t, sigma_s);
    const ExtinctionRange& r = collisions.range();
    for (std::size_t i = 0; i < hero_count; ++i) {
      const double low =
          static_cast<double>(r.constants_low) * constants[i] + static_cast<double>(r.grids_low);
      through.v[i] *= static_cast<float>(std::clamp(1 - (sigma_t[i] - low) / collisions.density(), 0.0, 1.0));
    }
    // Little light left: go on with it rarely, but then with more.
    constexpr float little = 0.1f;
    const float most = max_value(through);
    if (most < little) {
      if (random.next() >= 0.5) return {};
      through = through * 2;
    }
    if (is_black(through)) return {};
  }
  return {};
}

}  // namespace vitrail
