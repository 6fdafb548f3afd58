// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/dielectric.h"

#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

// The interface as seen with `out` above it.
struct Sighting {
  Vector3d out;
  double eta;   // index on the other side / on this one
  double side;  // −1 where the picture is upside down
  Vector3d turned(Vector3d v) const { return {v.x, v.y, v.z * side}; }
};

Sighting sight(const DielectricBsdf& bsdf, Vector3d out) {
  return out.z > 0 ? Sighting{out, bsdf.eta, 1} : Sighting{{out.x, out.y, -out.z}, 1 / bsdf.eta, -1};
}

// How likely `sample` is to reflect, and what it then multiplies the reflectance and the transmittance by.
struct Choice {
  double reflectance, transmittance, reflection_probability;
  float reflection_weight() const { return static_cast<float>(reflectance / reflection_probability); }
  float transmission_weight() const {
    return static_cast<float>(transmittance / (1 - reflection_probability));
  }
};

// Nothing where both factors are black.
std::optional<Choice> choose(const DielectricBsdf& bsdf, double cosine, double eta) {
  const double r = fresnel_dielectric(std::min(cosine, 1.0), eta);
  const double bright_r = r * static_cast<double>(max_value(bsdf.reflectance_factor));
  const double bright_t = (1 - r) * static_cast<double>(max_value(bsdf.transmittance_factor));
  if (!(bright_r + bright_t > 0)) return std::nullopt;
  return Choice{r, 1 - r, attainable(bright_r / (bright_r + bright_t))};
}

bool matched(double eta) { return std::abs(eta - 1) < 1e-6; }

bool scatters(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) {
  return out.z != 0 && in.z != 0 && !bsdf.microfacets.smooth() && !matched(bsdf.eta);
}

// One pair of directions, out.z > 0, joined by a facet of normal m.
struct Facet {
  Vector3d m;
  double out_m, in_m;  // cosines; in_m < 0 for transmission
  double jacobian;     // dm/d in
  bool valid;          // both directions see the sides of the facet that they see of the surface
};

Facet facet_of(Vector3d out, Vector3d in, Vector3d m, double eta) {
  const bool reflected = in.z > 0;
  const double out_m = dot(out, m), in_m = dot(in, m);
  const double sum = out_m + eta * in_m;  // ≠ 0 as eta ≠ 1
  const double jacobian = reflected ? 1 / (4 * out_m) : eta * eta * std::abs(in_m) / (sum * sum);
  return {m, out_m, in_m, jacobian, m.z > 0 && out_m > 0 && (reflected ? in_m > 0 : in_m < 0)};
}

Facet facet_between(Vector3d out, Vector3d in, double eta) {
  const Vector3d m = normalize(in.z > 0 ? out + in : out + in * eta);
  return facet_of(out, in, m.z < 0 ? -m : m, eta);
}

// area = σ(out).
double facet_pdf(const Microfacets& mf, double area, const Facet& facet) {
  return facet.out_m * normal_density(mf, facet.m) / area * facet.jacobian;
}

// G₂/G₁(out): what part of the light from a visible facet is seen by `in` too.
double seen(const Microfacets& mf, Vector3d out, double area, Vector3d in) {
  return shadowing_over_cosines(mf, out, area, in) * std::abs(in.z) * area;
}

}  // namespace

BsdfValue eval(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!scatters(bsdf, out, in)) return {};
  const Sighting s = sight(bsdf, out);
  const Vector3d to = s.turned(in);
  const Facet facet = facet_between(s.out, to, s.eta);
  if (!facet.valid) return {};
  const auto choice = choose(bsdf, facet.out_m, s.eta);
  const double area = visible_area(bsdf.microfacets, s.out);
  const double density = facet_pdf(bsdf.microfacets, area, facet);
  if (!choice || !(density > 0)) return {};
  const double share = density * seen(bsdf.microfacets, s.out, area, to);
  if (to.z > 0)
    return {bsdf.reflectance_factor * static_cast<float>(share * choice->reflectance),
            density * choice->reflection_probability};
  return {bsdf.transmittance_factor * static_cast<float>(share * choice->transmittance / (s.eta * s.eta)),
          density * (1 - choice->reflection_probability)};
}

double pdf(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) {
  if (!scatters(bsdf, out, in)) return 0;
  const Sighting s = sight(bsdf, out);
  const Vector3d to = s.turned(in);
  const Facet facet = facet_between(s.out, to, s.eta);
  if (!facet.valid) return 0;
  const auto choice = choose(bsdf, facet.out_m, s.eta);
  if (!choice) return 0;
  const double lobe = to.z > 0 ? choice->reflection_probability : 1 - choice->reflection_probability;
  return lobe * facet_pdf(bsdf.microfacets, visible_area(bsdf.microfacets, s.out), facet);
}

std::optional<BsdfSample> sample(const DielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  const Microfacets& mf = bsdf.microfacets;
  const Sighting s = sight(bsdf, out);
  if (!(s.out.z > 0)) return std::nullopt;
  const bool specular = mf.smooth() || matched(bsdf.eta);
  if (specular && !mf.smooth())
    return BsdfSample{.in = -out, .weight = bsdf.transmittance_factor, .specular = true};

  const Vector3d m = specular ? Vector3d{0, 0, 1} : sample_visible_normal(mf, s.out, u);
  const double out_m = dot(s.out, m);
  const auto choice = choose(bsdf, out_m, s.eta);
  if (!choice || !(out_m > 0)) return std::nullopt;
  const bool reflected = static_cast<double>(u_lobe) < choice->reflection_probability;
  Vector3d in = mirror(s.out, m);
  if (!reflected && !refract(s.out, m, s.eta, in)) return std::nullopt;
  if (!(reflected ? in.z > 0 : in.z < 0)) return std::nullopt;

  BsdfSample result{.in = s.turned(in), .specular = specular};
  result.weight = reflected ? bsdf.reflectance_factor * choice->reflection_weight()
                            : bsdf.transmittance_factor *
                                  (choice->transmission_weight() / static_cast<float>(s.eta * s.eta));
  if (specular) return result;
  const double area = visible_area(mf, s.out);
  result.pdf = facet_pdf(mf, area, facet_of(s.out, in, m, s.eta)) *
               (reflected ? choice->reflection_probability : 1 - choice->reflection_probability);
  result.weight = result.weight * static_cast<float>(seen(mf, s.out, area, in));
  if (!(result.pdf > 0)) return std::nullopt;
  return result;
}

namespace {

// Of the sheet, at each wavelength, without its factor.
SampledSpectrum sheet_reflectance(const ThinDielectricBsdf& bsdf, double cosine) {
  SampledSpectrum result;
  for (int i = 0; i < hero_count; ++i) {
    const double r = fresnel_dielectric(std::min(cosine, 1.0), static_cast<double>(bsdf.eta[i]));
    result[i] = static_cast<float>(2 * r / (1 + r));
  }
  return result;
}

SampledSpectrum complement(const SampledSpectrum& s) { return filled(1) + s * -1.0f; }

}  // namespace

BsdfValue eval(const ThinDielectricBsdf&, Vector3d, Vector3d) { return {}; }

double pdf(const ThinDielectricBsdf&, Vector3d, Vector3d) { return 0; }

SampledSpectrum straight_transmittance(const ThinDielectricBsdf& bsdf, double cosine) {
  return bsdf.transmittance_factor * complement(sheet_reflectance(bsdf, cosine));
}

SampledSpectrum mirrored_share(const ThinDielectricBsdf& bsdf, double cosine) {
  return bsdf.reflectance_factor * sheet_reflectance(bsdf, cosine);
}

std::optional<BsdfSample> sample(const ThinDielectricBsdf& bsdf, Vector3d out, float u_lobe, Point2f) {
  const SampledSpectrum r = sheet_reflectance(bsdf, std::abs(out.z));
  const SampledSpectrum reflected = bsdf.reflectance_factor * r;
  const SampledSpectrum transmitted = bsdf.transmittance_factor * complement(r);
  const double bright_r = carried(bsdf.throughput, reflected),
               bright_t = carried(bsdf.throughput, transmitted);
  if (!(bright_r + bright_t > 0)) return std::nullopt;
  const auto probability = static_cast<float>(attainable(bright_r / (bright_r + bright_t)));
  if (u_lobe < probability)
    return BsdfSample{
        .in = {-out.x, -out.y, out.z}, .weight = reflected * (1 / probability), .specular = true};
  return BsdfSample{.in = -out, .weight = transmitted * (1 / (1 - probability)), .specular = true};
}

}  // namespace vitrail
