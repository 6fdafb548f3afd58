// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/gathering.h"

#include "tracer/photons/places.h"

namespace vitrail {

void gather(Tracing& tracing, const CameraPath& path, const Interaction& at, const Scattering& scattering,
            Vector3d out) {
  // Of the side where the path is, and of the other, where light comes through.
  const Vector3d surface = dot(at.out, at.geometric) > 0 ? at.geometric : -at.geometric,
                 shading = out.z > 0 ? scattering.frame.normal : -scattering.frame.normal;
  Gather question{};
  const Point3f p = cast<float>(at.p);
  question.p[0] = p.x, question.p[1] = p.y, question.p[2] = p.z;
  question.out = encode_direction(at.out);
  question.pixel = path.film.pixel;
  question.depth = Photon::code_of(path.depth, path.dispersed);
  const auto ask = [&](const SampledSpectrum& share, double side) {
    if (is_black(share)) return;
    question.geometric = encode_direction(surface * side);
    question.shading = encode_direction(shading * side);
    for (std::size_t i = 0; i < hero_count; ++i) question.weight[i] = path.throughput.v[i] * share.v[i];
    const bool here = tracing.photons->answers->empty();
    const std::uint32_t domain = here ? 0 : domain_of(tracing.manifest(), question.p);
    if (here || (*tracing.photons->answers)[domain]) {
      ++tracing.counters.born;
      answer(tracing, question);
    } else {
      tracing.outbox.questions.push_back({domain, question});
      ++tracing.counters.born;
    }
  };
  if (const auto* lambert = std::get_if<LambertBsdf>(&scattering.bsdf)) {
    ask(lambert->reflectance, 1);
  } else if (const auto* sheet = std::get_if<DiffuseTransmissionBsdf>(&scattering.bsdf)) {
    ask(sheet->reflectance, 1);
    ask(sheet->transmittance, -1);
  } else if (const auto* grooves = std::get_if<OrenNayarBsdf>(&scattering.bsdf)) {
    // Its reflectance as it is limited, by what goes back along the normal.
    constexpr Vector3d up{0, 0, 1};
    question.shape = static_cast<float>(grooves->sigma_rad);
    const OrenNayarBsdf half{filled(0.5f), static_cast<double>(question.shape)};
    ask(eval(*grooves, up, up).value * (0.5f / eval(half, up, up).value[0]), 1);
  } else if (const auto* coated = std::get_if<PlasticBsdf>(&scattering.bsdf); coated && out.z > 0) {
    question.shape = -static_cast<float>(coated->eta);
    ask(base_of(*coated, out.z), 1);
  }
}

void answer(Tracing& tracing, const Gather& question) {
  const auto max_depth = static_cast<std::uint32_t>(tracing.settings().max_depth);
  ++tracing.counters.gathers;
  const SampledSpectrum radiance =
      tracing.photons->map->gather(question, max_depth, tracing.counters.photons_gathered) *
      static_cast<float>(tracing.photons->power_w_nm);
  ++tracing.counters.died;
  if (is_black(radiance)) return;
  const std::array<float, 4> u =
      camera_numbers(tracing, key_of(tracing, question.pixel, tracing.photons->iteration));
  deposit(tracing, question.pixel, tracing.photons->iteration,
          sensor_of(tracing, u, tracing.photons->wavelengths), radiance, {});
}

}  // namespace vitrail
