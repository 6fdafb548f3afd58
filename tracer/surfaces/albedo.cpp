// SPDX-License-Identifier: Apache-2.0
#include "tracer/surfaces/albedo.h"

#include <cmath>

#include "tracer/sampling/sampler.h"

namespace vitrail {

namespace {

constexpr int sample_count = 16;

// Index where light comes from over index where it goes to, squared: of models that refract.
template <class Model>
float decompression(const Model&, Vector3d, Vector3d) {
  return 1;
}
float decompressed(double eta, Vector3d out) {
  return static_cast<float>(out.z > 0 ? eta * eta : 1 / (eta * eta));
}
float decompression(const DielectricBsdf& bsdf, Vector3d out, Vector3d in) {
  return out.z * in.z < 0 && in != -out ? decompressed(bsdf.eta, out) : 1;
}
float decompression(const PrincipledBsdf& bsdf, Vector3d out, Vector3d in) {
  return out.z * in.z < 0 ? decompressed(bsdf.eta, out) : 1;
}
float decompression(const FourierBsdf& bsdf, Vector3d out, Vector3d in) {
  return out.z * in.z < 0 ? decompressed(static_cast<double>(bsdf.table->eta), out) : 1;
}

// Point i of a sequence that is evenly spread over the cube (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences"), shifted.
float coordinate(int i, double step, double shift) {
  const double x = i * step + shift;
  return std::min(static_cast<float>(x - std::floor(x)), 0x1.fffffep-1f);
}

template <class Model>
SampledSpectrum mean_of_samples(const Model& bsdf, Vector3d out, std::uint64_t seed) {
  RandomStream random(seed);
  const double lobe = random.next(), u = random.next(), v = random.next();
  SampledSpectrum sum{};
  for (int i = 0; i < sample_count; ++i) {
    const Point2f at{coordinate(i, 0.6710436067037893, u), coordinate(i, 0.5497004779019703, v)};
    if (const auto s = sample(bsdf, out, coordinate(i, 0.8191725133961645, lobe), at))
      sum = sum + s->weight * decompression(bsdf, out, s->in);
  }
  return sum * (1.0f / sample_count);
}

SampledSpectrum albedo_of(const LambertBsdf& bsdf, Vector3d, std::uint64_t) { return bsdf.reflectance; }
SampledSpectrum albedo_of(const DiffuseTransmissionBsdf& bsdf, Vector3d, std::uint64_t) {
  return bsdf.reflectance + bsdf.transmittance;
}
template <class Model>
SampledSpectrum albedo_of(const Model& bsdf, Vector3d out, std::uint64_t seed) {
  return mean_of_samples(bsdf, out, seed);
}

}  // namespace

SampledSpectrum albedo(const Bsdf& bsdf, Vector3d out, std::uint64_t random) {
  return std::visit([&](const auto& b) { return albedo_of(b, out, random); }, bsdf);
}

}  // namespace vitrail
