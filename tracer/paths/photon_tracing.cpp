// SPDX-License-Identifier: Apache-2.0
#include "tracer/paths/photon_tracing.h"

#include <algorithm>
#include <cmath>

#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/photons/places.h"
#include "tracer/rays/connection_code.h"
#include "tracer/rays/rounding.h"
#include "tracer/surfaces/scattered_direction.h"

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

}  // namespace

void PathTracer::begin_photon(Path& path) const {
  path.key = photon_key(scene_.seed, photons_->iteration, path.pixel);
  path.seed = sample_seed(path.key);
  path.time_s = time_of(path.key);
  path.wavelengths = photons_->wavelengths;
  path.has_wavelengths = true;
}

void PathTracer::trace_photon(std::uint32_t number) {
  Path path;
  path.pixel = number;
  begin_photon(path);
  const EmittedPhoton photon = emission_of(path);
  ++counters_.photons_emitted;
  ++counters_.rays_indirect;
  ++counters_.born;
  if (is_black(photon.power)) {
    ++counters_.died;
    return;
  }
  path.throughput = photon.power * static_cast<float>(1 / photons_->emission->flux());
  path.inside = scene_.interiors.state_in(manifest_.camera_medium);
  Departure from{photon.p, cast<float>(photon.p), no_triangle, path.inside};
  if (dot(photon.normal, photon.normal) > 0) {
    Interaction at;
    at.p = photon.p;
    at.geometric = photon.normal;
    at.rounding = rounding_along(at.geometric, at.p);
    from.origin = offset_origin(at, photon.direction);
    from.exclude = photon.triangle;
  }
  if (traffic_) traffic_->begin({});
  depart(path, from, photon.direction);
  run(path, std::nullopt);
}

// False when it ends here.
bool PathTracer::shade_photon(Path& path) {
  if (path.met() == Met::nothing) return false;
  const Surface& surface = surface_at(path);
  Interaction at = interaction_at(path);
  widen_cone(path, path.hit.t);
  const MaterialKind& kind = scene_.materials.kind(surface.material);
  if (!is_there(path, surface, at) || kind.is_nothing(at)) {
    pass_straight(path, at, &surface);
    return true;
  }
  if ((at.front || !kind.smooth_dielectric) && !leave_pane(path)) return false;
  // Before chance decides what of the surface is met: it decides once more for the path that gathers.
  if (kind.diffuse && !is_connected_to(path)) land(path, at);
  if (misses(path, opacity_at(surface, at))) {
    pass_straight(path, at, nullptr);
    return true;
  }
  if (is_spent(path)) return end_photon(path, at, surface, kind);
  if (kind.smooth_dielectric) return scatter_dielectric(path, at, surface);
  return scatter_photon(path, at, surface, kind);
}

// One that scatters no more: whether it goes on behind the surface.
bool PathTracer::end_photon(Path& path, const Interaction& at, const Surface& surface,
                            const MaterialKind& kind) {
  if (kind.smooth_dielectric && sees_through(path, at)) return scatter_dielectric(path, at, surface);
  if (manifest_.settings.straight_counts || !manifest_.requirements.see_through) return false;
  path.throughput =
      path.throughput * scene_.materials.passes_straight(surface.material, at, path.wavelengths);
  if (is_black(path.throughput)) return false;
  if (kind.sheet) pass_sheet(path);
  pass_straight(path, at, &surface);
  return true;
}

bool PathTracer::scatter_photon(Path& path, const Interaction& at, const Surface& surface,
                                const MaterialKind& kind) {
  bool goes_on = false;
  const Material* material = material_at(path, at, surface, kind, goes_on);
  if (!material) return goes_on;
  const Scattering scattering = scattering_at(path, at, *material);
  const Vector3d out = scattering.frame.to_local(at.out);
  const std::array<float, 4> u = numbers_for_scattering(path);
  const std::optional<BsdfSample> chosen = sample(scattering.bsdf, out, u[2], {u[0], u[1]});
  if (!chosen) return false;
  if (chosen->specular && chosen->in == -out) {
    path.throughput = path.throughput * chosen->weight;
    if (is_black(path.throughput)) return false;
    if (kind.sheet) pass_sheet(path);
    scatter_straight(path, at, surface);
    return true;
  }
  const Vector3d sampled = scattering.frame.to_world(chosen->in);
  const auto kept = kept_on_its_side(scattering, at, out, *chosen, sampled);
  if (!kept) return false;
  const bool symmetric = kept->by_surface || std::holds_alternative<HairBsdf>(scattering.bsdf);
  const float adjoint = symmetric ? 1 : adjoint_of_shading(at, scattering.frame.normal, sampled);
  path.throughput = path.throughput * power_weight(scattering.bsdf, out, *chosen) *
                    static_cast<float>(scattering.bump_shadowing(dot(at.out, at.shading))) * adjoint;
  if (is_black(path.throughput)) return false;
  Vector3d direction = kept->world;
  if (kind.sheet && chosen->specular && is_mirror(scattering.bsdf) && out.z * chosen->in.z > 0)
    turn_at_face(path, at, surface, {at.shading * at.side()}, direction);
  else
    path.sample |= photon_scattered;
  path.pdf = chosen->specular ? 0 : density_beside(chosen->pdf, 1);  // as its record says
  if (!go_on(path, u[3], chosen->specular)) return false;
  continue_from(path, at, surface, direction);
  return true;
}

namespace {

PhotonWalk walk_of(std::uint32_t sample) { return PhotonWalk::of(sample >> photon_walk_shift); }
FaceDoubt doubt_of(std::uint32_t sample) {
  return {sample >> photon_doubt_shift & ((1u << (photon_walk_shift - photon_doubt_shift)) - 1)};
}
std::uint32_t with(std::uint32_t sample, const PhotonWalk& walk, const FaceDoubt& doubt) {
  const std::uint32_t history = sample & ((1u << photon_doubt_shift) - 1);
  return history | doubt.code << photon_doubt_shift | walk.bits() << photon_walk_shift;
}

}  // namespace

EmittedPhoton PathTracer::emission_of(const Path& path) const {
  return photons_->emission->sample(sample_4d(path.key, sample_set::camera),
                                    sample_4d(path.key, sample_set::lens), path.wavelengths);
}

// Whether paths find the photon's light by a connection to it, or by a sample of a BSDF that sees it: light
// that came straight, and that of a distant light behind panes, which goes on as it came.
bool PathTracer::is_connected_to(const Path& path) const {
  if (!(path.sample & (photon_refracted | photon_scattered))) return true;
  if ((path.sample & photon_scattered) || scene_.lights.distant.empty()) return false;
  if (walk_of(path.sample).before > 0) return false;
  const EmittedPhoton photon = emission_of(path);
  return photon.is_distant && encode_direction(photon.direction) == path.direction;
}

// How a photon stands to a face, as a connection would; empty where none finds its light anyway.
std::optional<ParallelWay> PathTracer::parallel_way_of(const Path& path, const Interaction& at,
                                                       const MetFace& face, double doubt_rad) const {
  if ((path.sample & photon_scattered) || scene_.lights.distant.empty()) return std::nullopt;
  const EmittedPhoton photon = emission_of(path);
  if (!photon.is_distant) return std::nullopt;
  return parallel_way(-at.out, walk_of(path.sample).back, photon.direction, face, doubt_rad);
}

void PathTracer::pass_sheet(Path& path) const {
  PhotonWalk walk = walk_of(path.sample);
  if (!walk.has_way_back()) path.sample |= photon_scattered;
  if (path.sample & photon_scattered) return;
  walk.pass();
  path.sample = with(path.sample, walk, doubt_of(path.sample));
}

// Refracted into `direction`: what a connection through the face would have is given to the photon.
void PathTracer::pass_interface(Path& path, const Interaction& at, const Surface& surface,
                                const MetFace& face, Vector3d& direction) const {
  path.sample |= photon_refracted;
  const double face_rad = face_doubt(path, at, surface, face.normal);
  FaceDoubt alone, doubt = doubt_of(path.sample);
  alone.cross(face_rad), doubt.cross(face_rad);
  const std::optional<ParallelWay> way = parallel_way_of(path, at, face, doubt.allowed_rad());
  if (!way) return;
  const PhotonWalk walk = walk_of(path.sample);
  if ((way->is_in || way->is_out) && way->passes) {
    direction = way->passed;
    doubt = way->is_out && !walk.back && !at.front ? FaceDoubt{} : alone;
  }
  path.sample = with(path.sample, walk, doubt);
  pass_sheet(path);
}

// Reflected into `direction`: as connections are where the face is parallel to those that the photon has
// passed, else it has scattered.
void PathTracer::turn_at_face(Path& path, const Interaction& at, const Surface& surface, const MetFace& face,
                              Vector3d& direction) const {
  const double face_rad = face_doubt(path, at, surface, face.normal);
  FaceDoubt alone, doubt = doubt_of(path.sample);
  alone.cross(face_rad), doubt.cross(face_rad);
  const std::optional<ParallelWay> way = parallel_way_of(path, at, face, doubt.allowed_rad());
  if (!way || !way->holds()) {
    path.sample |= photon_scattered;
    return;
  }
  PhotonWalk walk = walk_of(path.sample);
  walk.turn();
  direction = way->turned;
  path.sample = with(path.sample | photon_refracted, walk, way->is_in || way->is_out ? alone : doubt);
}

void PathTracer::land(const Path& path, const Interaction& at) {
  Photon photon;
  const Point3f p = cast<float>(at.p);
  photon.p[0] = p.x, photon.p[1] = p.y, photon.p[2] = p.z;
  photon.direction = path.direction;
  for (std::size_t i = 0; i < hero_count; ++i) photon.power[i] = path.throughput.v[i];
  photon.number = path.pixel;
  photon.depth = static_cast<std::uint16_t>(std::min<std::uint32_t>(path.depth, Photon::most_depth) |
                                            (path.is(path_dispersed) ? Photon::dispersed : 0u));
  outbox_.photons.push_back(photon);
}

void PathTracer::gather(const Path& path, const Interaction& at, const Scattering& scattering, Vector3d out) {
  // Of the side where the path is, and of the other, where light comes through.
  const Vector3d surface = dot(at.out, at.geometric) > 0 ? at.geometric : -at.geometric,
                 shading = out.z > 0 ? scattering.frame.normal : -scattering.frame.normal;
  Gather question{};
  const Point3f p = cast<float>(at.p);
  question.p[0] = p.x, question.p[1] = p.y, question.p[2] = p.z;
  question.out = encode_direction(at.out);
  question.pixel = path.pixel;
  question.depth = static_cast<std::uint16_t>(std::min<std::uint32_t>(path.depth, Photon::most_depth) |
                                              (path.is(path_dispersed) ? Photon::dispersed : 0u));
  const auto ask = [&](const SampledSpectrum& share, double side) {
    if (is_black(share)) return;
    question.geometric = encode_direction(surface * side);
    question.shading = encode_direction(shading * side);
    for (std::size_t i = 0; i < hero_count; ++i) question.weight[i] = path.throughput.v[i] * share.v[i];
    const bool here = photons_->answers->empty();
    const std::uint32_t domain = here ? 0 : domain_of(manifest_, question.p);
    if (here || (*photons_->answers)[domain]) {
      ++counters_.born;
      answer(question);
    } else {
      outbox_.questions.push_back({domain, question});
      ++counters_.born;
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

void PathTracer::answer(const Gather& question) {
  const auto max_depth = static_cast<std::uint32_t>(manifest_.settings.max_depth);
  ++counters_.gathers;
  const SampledSpectrum radiance = photons_->map->gather(question, max_depth, counters_.photons_gathered) *
                                   static_cast<float>(photons_->power_w_nm);
  ++counters_.died;
  if (is_black(radiance)) return;
  const std::array<float, 4> u = camera_numbers(key_of(question.pixel, photons_->iteration));
  deposit(question.pixel, photons_->iteration, sensor_of(u, photons_->wavelengths), radiance);
}

}  // namespace vitrail
