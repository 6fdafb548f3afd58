// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/photons.h"

#include <cmath>

#include "tracer/rays/rounding.h"
#include "tracer/surfaces/scattered_direction.h"
#include "tracer/transport/glass.h"
#include "tracer/transport/photon_history.h"

namespace vitrail {

namespace {

// What a photon keeps of its power by a sample whose weight is that of radiance. Through a surface f(out, in)
// is not f(in, out): light that is refracted is not compressed as radiance is. Of a fibre, which is not
// reciprocal, they are taken as one, and cosines mean nothing.
SampledSpectrum power_weight(const Bsdf& bsdf, Vector3d out, const BsdfSample& chosen) {
  const bool through = !std::holds_alternative<HairBsdf>(bsdf) && out.z * chosen.in.z < 0;
  if (!through) return chosen.weight;
  if (!chosen.specular)
    return eval(bsdf, chosen.in, out).value * static_cast<float>(std::abs(chosen.in.z / out.z) / chosen.pdf);
  const auto* glass = std::get_if<DielectricBsdf>(&bsdf);
  if (!glass) return chosen.weight;
  const double eta2 = glass->eta * glass->eta;
  return chosen.weight * static_cast<float>(out.z > 0 ? eta2 : 1 / eta2);
}

void begin(const Tracing& tracing, PhotonPath& photon) {
  const PhotonPass& pass = *tracing.photons;
  photon.key = photon_key(tracing.scene.seed, pass.iteration, photon.number);
  photon.seed = sample_seed(photon.key);
  const PhotonPass::Part& part = pass.parts[pass.part_of_photon(photon.number)];
  photon.time_s = tracing.requirements().motion ? time_at(tracing, part.time_number) : 0;
  photon.wavelengths = part.wavelengths;
}

void land(Tracing& tracing, const PhotonPath& photon, Point3f p, DirectionCode direction) {
  Photon landed;
  landed.p[0] = p.x, landed.p[1] = p.y, landed.p[2] = p.z;
  landed.direction = direction;
  for (std::size_t i = 0; i < hero_count; ++i) landed.power[i] = photon.throughput.v[i];
  landed.number = photon.number;
  landed.depth = Photon::code_of(photon.depth, photon.dispersed);
  tracing.outbox.photons.push_back(landed);
}

// At the sensors whose discs it crosses on its way to what it has met.
void land_at_sensors(Tracing& tracing, const PhotonPath& photon) {
  const PhotonPass& pass = *tracing.photons;
  pass.sensors->for_each_crossed(cast<double>(photon.ray.origin), cast<double>(photon.ray.direction),
                                 photon.hit.t, pass.radius, [&](const SensorDiscs::Disc& disc) {
                                   PhotonPath there = photon;
                                   if (leave_pane(there) && !is_connected_to(tracing, there))
                                     land(tracing, there, disc.name.p, disc.name.facing);
                                 });
}

// One that scatters no more: whether it goes on behind the surface.
bool end_at_surface(const Tracing& tracing, PhotonPath& photon, const Event& event) {
  if (event.kind.smooth_dielectric && sees_through(tracing, photon, event.at))
    return scatter_dielectric(tracing, photon, event);
  if (tracing.settings().straight_counts || !tracing.requirements().see_through) return false;
  photon.throughput = photon.throughput * tracing.scene.materials.passes_straight(
                                              event.surface.material, event.at, photon.wavelengths);
  if (is_black(photon.throughput)) return false;
  if (event.kind.sheet) pass_sheet(photon);
  pass_straight(tracing, photon, event.at, &event.surface);
  return true;
}

bool scatter(const Tracing& tracing, PhotonPath& photon, const Event& event) {
  const auto [material, passes] = material_at(tracing, photon, event);
  if (!material) return passes;
  const Interaction& at = event.at;
  const Scattering scattering = scattering_at(tracing, photon, at, *material);
  const Vector3d out = scattering.frame.to_local(at.out);
  const std::array<float, 4> u = numbers_for_scattering(photon);
  const std::optional<BsdfSample> chosen = sample(scattering.bsdf, out, u[2], {u[0], u[1]});
  if (!chosen) return false;
  if (chosen->specular && chosen->in == -out) {
    photon.throughput = photon.throughput * chosen->weight;
    if (is_black(photon.throughput)) return false;
    if (event.kind.sheet) pass_sheet(photon);
    scatter_straight(tracing, photon, event);
    return true;
  }
  const Vector3d sampled = scattering.frame.to_world(chosen->in);
  const auto kept = kept_on_its_side(scattering, at, out, *chosen, sampled);
  if (!kept) return false;
  const bool symmetric = kept->by_surface || std::holds_alternative<HairBsdf>(scattering.bsdf);
  const float adjoint = symmetric ? 1 : adjoint_of_shading(at, scattering.frame.normal, sampled);
  photon.throughput = photon.throughput * power_weight(scattering.bsdf, out, *chosen) *
                      static_cast<float>(scattering.bump_shadowing(dot(at.out, at.shading))) * adjoint;
  if (is_black(photon.throughput)) return false;
  Vector3d direction = kept->world;
  const bool by_a_mirror = chosen->specular && is_mirror(scattering.bsdf) && out.z * chosen->in.z > 0;
  if (event.kind.sheet && by_a_mirror)
    turn_at_face(tracing, photon, event, {at.shading * at.side()}, direction);
  else
    photon.scattered = true;
  photon.pdf = chosen->specular ? 0 : density_beside(chosen->pdf, 1);  // as its record says
  if (!go_on(tracing, photon, u[3], chosen->specular)) return false;
  continue_from(tracing, photon, at, event.surface, direction);
  return true;
}

// Light that fades has no energy, but where it first meets what scatters it, it is as bright there as
// connections would have it. From there on it travels as all photons do.
float share_at_first_surface(const Tracing& tracing, const PhotonPath& photon, Point3d p) {
  const EmittedPhoton emitted = emission_of(tracing, photon);
  if (!emitted.fading) return 1;
  const Vector3d way = p - emitted.p;
  return static_cast<float>(weakened(*emitted.fading, length(way)) * dot(way, way));
}

// False when it ends here.
bool shade_event(Tracing& tracing, PhotonPath& photon, const Event& event) {
  const Interaction& at = event.at;
  if (!event.is_there || event.kind.is_nothing(at)) {
    pass_straight(tracing, photon, at, &event.surface);
    return true;
  }
  if (!come_to(photon, event)) return false;
  // Before chance decides what of the surface is met: it decides once more for the path that gathers.
  if (event.kind.diffuse && !tracing.photons->sensors && !is_connected_to(tracing, photon))
    land(tracing, photon, cast<float>(at.p), photon.direction);
  if (misses(photon, opacity_at(tracing, event.surface, at))) {
    pass_straight(tracing, photon, at, nullptr);
    return true;
  }
  if (is_spent(tracing, photon)) return end_at_surface(tracing, photon, event);
  if (event.kind.smooth_dielectric) return scatter_dielectric(tracing, photon, event);
  return scatter(tracing, photon, event);
}

bool shade(Tracing& tracing, PhotonPath& photon) {
  if (!photon.meets_surface()) return false;
  const Event event = event_of(tracing, photon);
  const auto is_straight = [&] { return !photon.refracted && !photon.scattered; };
  const bool fades = tracing.scene.lights.fades && is_straight();
  if (!shade_event(tracing, photon, event)) return false;
  if (fades && !is_straight()) {
    photon.throughput = photon.throughput * share_at_first_surface(tracing, photon, event.at.p);
    RandomStream random(stream_of(photon, RayRandom::throughput));
    random.bits();  // of its departure
    round_throughput(photon, random.bits());
  }
  return true;
}

void follow(Tracing& tracing, PhotonPath& photon, std::optional<Arrival> at) {
  for (;; at.reset()) {
    if (const auto elsewhere = find_hit(tracing, photon, at)) {
      send(tracing, photon, *elsewhere);
      return;
    }
    if (tracing.photons->sensors) land_at_sensors(tracing, photon);
    if (!shade(tracing, photon)) {
      ++tracing.counters.died;
      return;
    }
    ++tracing.counters.rays_indirect;
  }
}

}  // namespace

void trace_photon(Tracing& tracing, std::uint32_t number) {
  PhotonPath photon;
  photon.number = number;
  begin(tracing, photon);
  const EmittedPhoton emitted = emission_of(tracing, photon);
  ++tracing.counters.photons_emitted;
  ++tracing.counters.rays_indirect;
  ++tracing.counters.born;
  if (is_black(emitted.power)) {
    ++tracing.counters.died;
    return;
  }
  photon.throughput = emitted.power * static_cast<float>(1 / tracing.photons->emission->flux());
  photon.inside = tracing.scene.interiors.state_in(tracing.manifest().camera_medium);
  Departure from{emitted.p, cast<float>(emitted.p), no_triangle, photon.inside};
  if (dot(emitted.normal, emitted.normal) > 0) {
    Interaction at;
    at.p = emitted.p;
    at.geometric = emitted.normal;
    at.rounding = rounding_along(at.geometric, at.p);
    from.origin = offset_origin(tracing, at, emitted.direction);
    from.exclude = emitted.triangle;
  }
  if (tracing.traffic) tracing.traffic->begin({});
  depart(photon, from, emitted.direction);
  follow(tracing, photon, std::nullopt);
}

void pack(const Tracing&, const PhotonPath& photon, bool resolved, RayRecord& record) {
  PhotonRecord& r = record.photon;
  static_cast<RayRecordHead&>(r) = head_of(photon, RayRecordKind::photon, resolved);
  if (photon.passed) r.kind_and_flags |= ray_passed;
  r.number = photon.number;
  for (int i = 0; i < 3; ++i) r.depth[i] = static_cast<std::uint8_t>(photon.depth >> 8 * i);
  r.cone = photon.cone;
  r.history = static_cast<std::uint8_t>(
      (photon.refracted ? photon_refracted : 0) | (photon.scattered ? photon_scattered : 0) |
      (photon.counted ? photon_counted : 0) | photon.doubt.code << photon_doubt_shift);
  r.walk = static_cast<std::uint8_t>(photon.walk.bits());
  if (photon.pane.is_known()) {  // then its density is 0
    r.kind_and_flags |= ray_in_pane;
    r.pane = photon.pane.record();
  } else {
    r.pdf = pdf_code(photon.pdf);
  }
}

void resume(Tracing& tracing, const PhotonRecord& record, const Arrival& at) {
  PhotonPath photon;
  photon.number = record.number;
  begin(tracing, photon);
  unpack_head(record, photon);
  photon.passed = record.is(ray_passed);
  photon.depth = record.depth[0] | std::uint32_t{record.depth[1]} << 8 | std::uint32_t{record.depth[2]} << 16;
  photon.cone = record.cone;
  photon.refracted = (record.history & photon_refracted) != 0;
  photon.scattered = (record.history & photon_scattered) != 0;
  photon.counted = (record.history & photon_counted) != 0;
  photon.doubt = {static_cast<std::uint32_t>(record.history >> photon_doubt_shift)};
  photon.walk = PhotonWalk::of(record.walk);
  if (record.is(ray_in_pane))
    photon.pane = PaneState::of(record.pane);
  else
    photon.pdf = pdf_value(record.pdf);
  if (tracing.traffic) tracing.traffic->begin({at.domain, true});
  follow(tracing, photon, at);
}

}  // namespace vitrail
