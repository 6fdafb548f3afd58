// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/glazed.h"

#include <algorithm>
#include <cmath>

#include "scene/geometry/portable_math.h"
#include "tracer/bsdf/local.h"

namespace vitrail {

namespace {

// What of light goes each way at an angle.
struct Ways {
  SampledSpectrum mirrored, through;
  Vector3d bent;                // where the latter goes
  double mirror = 0, pass = 0;  // how likely `sample` takes them; the rest is for what is lit
};

double greatest(const SampledSpectrum& s) {
  return std::max(0.0, static_cast<double>(*std::max_element(s.v.begin(), s.v.end())));
}

// POV-Ray's approximation of the Fresnel equations, by which metals lose their colour at grazing angles: a
// fit of the angle of incidence in units of a right angle.
double whiteness(double cosine) {
  const double x = 1.12 - portable_acos(cosine) * (2 / pi);
  return std::clamp(0.014567225 / (x * x) - 0.011612903, 0.0, 1.0);
}

// `out` in front.
Ways ways_of(const GlazedBsdf& b, Vector3d out, double eta) {
  Ways w;
  const double between =
      b.fresnel ? fresnel_dielectric(out.z, eta) : portable_pow(1 - std::min(out.z, 1.0), b.falloff);
  w.mirrored = b.mirror_min * static_cast<float>(1 - between) + b.mirror_max * static_cast<float>(between);
  w.through = b.through;
  if (b.conserves_energy)
    for (std::size_t i = 0; i < hero_count; ++i) w.through.v[i] *= std::max(0.0f, 1 - w.mirrored.v[i]);
  if (b.metallic > 0) {
    const auto colored = static_cast<float>(b.metallic * (1 - whiteness(out.z)));
    w.mirrored = w.mirrored * (filled(1 - colored) + b.tint * colored);
  }
  // All is mirrored, in no colour, whatever the finish mirrors and lets through.
  if (!refract(out, {0, 0, 1}, eta, w.bent) && greatest(w.through) > 0) {
    w.mirrored = filled(1);
    w.through = {};
  }
  // Highlights are for lamps alone, so that little of the paths goes on where light is spread.
  const double spread =
      greatest(b.finish.reflectance) * 0.5 + (b.finish.phong + b.finish.specular > 0 ? 0.05 : 0);
  const double mirror = greatest(w.mirrored), pass = greatest(w.through), all = mirror + pass + spread;
  if (all > 0) {
    w.mirror = spread + pass > 0 ? attainable(mirror / all) : 1;
    w.pass = spread > 0 ? attainable((mirror + pass) / all) - w.mirror : 1 - w.mirror;
  }
  return w;
}

Vector3d turned(Vector3d v, bool over) { return over ? Vector3d{v.x, v.y, -v.z} : v; }

}  // namespace

BsdfValue eval(const GlazedBsdf& b, Vector3d out, Vector3d in) {
  if (!(out.z * in.z > 0)) return {};
  const bool behind = out.z < 0;
  const Ways ways = ways_of(b, turned(out, behind), behind ? 1 / b.eta : b.eta);
  BsdfValue value = eval(b.finish, turned(out, behind), turned(in, behind));
  value.pdf *= 1 - ways.mirror - ways.pass;
  return value;
}

double pdf(const GlazedBsdf& b, Vector3d out, Vector3d in) { return eval(b, out, in).pdf; }

std::optional<BsdfSample> sample(const GlazedBsdf& b, Vector3d out, float u_lobe, Point2f u) {
  if (out.z == 0) return std::nullopt;
  const bool behind = out.z < 0;
  const Vector3d front = turned(out, behind);
  const Ways ways = ways_of(b, front, behind ? 1 / b.eta : b.eta);
  const double chosen = static_cast<double>(u_lobe);
  if (chosen < ways.mirror)
    return BsdfSample{.in = {-out.x, -out.y, out.z},
                      .weight = ways.mirrored * static_cast<float>(1 / ways.mirror),
                      .specular = true};
  if (chosen < ways.mirror + ways.pass)
    return BsdfSample{.in = b.eta == 1 ? -out : turned(ways.bent, behind),
                      .weight = ways.through * static_cast<float>(1 / ways.pass),
                      .specular = true};
  const double rest = 1 - ways.mirror - ways.pass;
  if (!(rest > 0)) return std::nullopt;
  const auto u_rest = static_cast<float>((chosen - ways.mirror - ways.pass) / rest);
  std::optional<BsdfSample> lit = sample(b.finish, front, std::min(u_rest, 0x1.fffffep-1f), u);
  if (!lit) return std::nullopt;
  lit->in = turned(lit->in, behind);
  lit->pdf *= rest;
  lit->weight = lit->weight * static_cast<float>(1 / rest);
  return lit;
}

}  // namespace vitrail
