// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/gathering.h"

#include "scene/geometry/portable_math.h"
#include "tracer/photons/places.h"

namespace vitrail {

namespace {

// Of the map here, or of the rank that knows of the photons there.
void ask(Tracing& tracing, const Gather& question) {
  const bool here = tracing.photons->answers->empty();
  const std::uint32_t domain = here ? 0 : domain_of(tracing.manifest(), question.p);
  ++tracing.counters.born;
  if (here || (*tracing.photons->answers)[domain])
    answer(tracing, question);
  else
    tracing.outbox.questions.push_back({domain, question});
}

SampledSpectrum found_for(Tracing& tracing, const Gather& question, std::uint32_t part) {
  const auto max_depth = static_cast<std::uint32_t>(tracing.settings().max_depth);
  const PhotonPass& pass = *tracing.photons;
  std::uint64_t& found = tracing.counters.photons_gathered;
  if (!pass.sensors) return pass.map->gather(question, max_depth, found);
  return pass.map->at_sensor(question, max_depth, found,
                             [&](std::uint32_t number) { return pass.part_of_photon(number) == part; });
}

}  // namespace

void gather_at_sensor(Tracing& tracing, const CameraPath& path, const Sensor& sensor) {
  const PhotonPass& pass = *tracing.photons;
  const SensorName name = SensorName::of(sensor);
  Gather question{};
  question.p[0] = name.p.x, question.p[1] = name.p.y, question.p[2] = name.p.z;
  question.out = name.facing;
  question.pixel = path.film.pixel;
  // Each part has its share of the photons, and is to bring the light of all.
  const auto density = static_cast<double>(pass.parts.size()) / (pi * pi * pass.radius * pass.radius);
  for (std::size_t i = 0; i < hero_count; ++i)
    question.weight[i] = path.throughput.v[i] * static_cast<float>(density);
  ask(tracing, question);
}

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
  const auto ask_for = [&](const SampledSpectrum& share, double side) {
    if (is_black(share)) return;
    question.geometric = encode_direction(surface * side);
    question.shading = encode_direction(shading * side);
    for (std::size_t i = 0; i < hero_count; ++i) question.weight[i] = path.throughput.v[i] * share.v[i];
    ask(tracing, question);
  };
  if (const auto* lambert = std::get_if<LambertBsdf>(&scattering.bsdf)) {
    ask_for(lambert->reflectance, 1);
  } else if (const auto* sheet = std::get_if<DiffuseTransmissionBsdf>(&scattering.bsdf)) {
    ask_for(sheet->reflectance, 1);
    ask_for(sheet->transmittance, -1);
  } else if (const auto* grooves = std::get_if<OrenNayarBsdf>(&scattering.bsdf)) {
    // Its reflectance as it is limited, by what goes back along the normal.
    constexpr Vector3d up{0, 0, 1};
    question.shape = static_cast<float>(grooves->sigma_rad);
    const OrenNayarBsdf half{filled(0.5f), static_cast<double>(question.shape)};
    ask_for(eval(*grooves, up, up).value * (0.5f / eval(half, up, up).value[0]), 1);
  } else if (const auto* coated = std::get_if<PlasticBsdf>(&scattering.bsdf); coated && out.z > 0) {
    question.shape = -static_cast<float>(coated->eta);
    ask_for(base_of(*coated, out.z), 1);
  }
}

void answer(Tracing& tracing, const Gather& question) {
  const PhotonPass& pass = *tracing.photons;
  const int row = static_cast<int>(question.pixel / static_cast<std::uint32_t>(tracing.film.width()));
  const std::uint32_t part = pass.part_of_row(row);
  ++tracing.counters.gathers;
  const SampledSpectrum radiance = found_for(tracing, question, part) * static_cast<float>(pass.power_w_nm);
  ++tracing.counters.died;
  if (is_black(radiance)) return;
  const std::array<float, 4> u = camera_numbers(tracing, key_of(tracing, question.pixel, pass.iteration));
  deposit(tracing, question.pixel, pass.iteration, sensor_of(tracing, u, pass.parts[part].wavelengths),
          radiance, {});
}

}  // namespace vitrail
