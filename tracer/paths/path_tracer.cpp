// SPDX-License-Identifier: Apache-2.0
#include "tracer/paths/path_tracer.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/geometry/portable_math.h"
#include "scene/records/pixel_place.h"
#include "tracer/paths/path_state.h"
#include "tracer/rays/walk.h"

namespace vitrail {

namespace {

void pack(const Ray& ray, DirectionCode direction, auto& record) {
  record.origin[0] = ray.origin.x;
  record.origin[1] = ray.origin.y;
  record.origin[2] = ray.origin.z;
  record.direction = direction;
  record.exclude = ray.exclude;
}

Ray unpacked(const auto& record) {
  return {{record.origin[0], record.origin[1], record.origin[2]},
          decode_direction(record.direction),
          record.exclude};
}

}  // namespace

TraceCounters& operator+=(TraceCounters& a, const TraceCounters& b) {
  a.rays_camera += b.rays_camera;
  a.rays_indirect += b.rays_indirect;
  a.rays_shadow += b.rays_shadow;
  a.crossings += b.crossings;
  a.born += b.born;
  a.died += b.died;
  a.photons_emitted += b.photons_emitted;
  a.gathers += b.gathers;
  a.photons_gathered += b.photons_gathered;
  a.connections_in_glass += b.connections_in_glass;
  a.connections_in_wedges += b.connections_in_wedges;
  a.widest_wedge_nrad = std::max(a.widest_wedge_nrad, b.widest_wedge_nrad);
  return a;
}

PathTracer::PathTracer(const RenderScene& scene, ResidentViews resident, Film& film, Outbox& outbox,
                       TraceCounters& counters, RayTraffic* traffic, const PhotonPass* photons,
                       const KernelFunctions& kernel)
    : scene_(scene),
      manifest_(scene.manifest),
      resident_(resident),
      kernel_(kernel),
      film_(film),
      outbox_(outbox),
      counters_(counters),
      traffic_(traffic),
      photons_(photons) {}

SampleKey PathTracer::key_of(std::uint32_t pixel, std::uint32_t sample) const {
  const auto width = static_cast<std::uint32_t>(film_.width());
  const auto x = static_cast<std::uint32_t>(film_.crop().x0) + pixel % width;
  const auto y = static_cast<std::uint32_t>(film_.crop().y0) + pixel / width;
  return {scene_.seed, y * static_cast<std::uint32_t>(film_.full_width()) + x, sample};
}

// Among photons all paths of an iteration have its wavelengths.
std::array<float, 4> PathTracer::camera_numbers(const SampleKey& key) const {
  std::array<float, 4> numbers = sample_4d(key, sample_set::camera);
  if (photons_) numbers[2] = photons_->wavelength_number;
  return numbers;
}

// When a sample sees the scene. Among photons all paths of an iteration see it at once.
double PathTracer::time_of(const SampleKey& key) const {
  if (!manifest_.requirements.motion) return 0;
  const float number = photons_ ? photons_->time_number : sample_4d(key, sample_set::time, Wanted::two)[0];
  const Shutter& shutter = manifest_.shutter;
  return shutter.open_s + static_cast<double>(number) * (shutter.close_s - shutter.open_s);
}

// Of a path whose pixel and sample are known.
void PathTracer::begin(Path& path) const {
  if (flies()) {
    begin_photon(path);
    return;
  }
  path.key = key_of(path.pixel, path.sample);
  path.seed = sample_seed(path.key);
  path.camera = camera_numbers(path.key);
  path.time_s = time_of(path.key);
}

// Where the film splats, the pixels of a sample; else null.
const Footprint* PathTracer::footprint_of(std::uint32_t pixel, std::uint32_t sample) {
  if (!scene_.sampling.splat) return nullptr;
  if (const std::uint64_t of = std::uint64_t{pixel} << 32 | sample; of != landed_.of) {
    const std::array<float, 4> u = camera_numbers(key_of(pixel, sample));
    landed_ = {of, scene_.filter.footprint(u[0], u[1])};
  }
  return &landed_.footprint;
}

// The first event at a depth has a stratified set; those that follow where going straight on counts for no
// depth have numbers of their ray.
std::array<float, 4> PathTracer::numbers_for_scattering(const Path& path, Wanted wanted) const {
  if (path.is(path_passed) || (path.is(path_in_pane) && path.owes))
    return hashed_4d(stream_of(path, RayRandom::scattering));
  return sample_4d(path.key, sample_set::scatter(path.depth), wanted);
}
std::array<float, 4> PathTracer::numbers_for_light(const Path& path) const {
  if (path.is(path_passed)) return hashed_4d(stream_of(path, RayRandom::light));
  return sample_4d(path.key, sample_set::light(path.depth),
                   scene_.lights.three_numbers ? Wanted::three : Wanted::four);
}

// The point of the sun's disc that all of a sample's connections go to, so that one which glass has turned
// can tell whether it has come there.
std::array<float, 2> PathTracer::numbers_for_far_lights(const Path& path) const {
  if (!scene_.lights.has_discs) return {};
  const std::array<float, 4> u = sample_4d(path.key, sample_set::lens);
  return {u[2], u[3]};
}

void PathTracer::find_wavelengths(Path& path) const {
  if (path.has_wavelengths) return;
  path.has_wavelengths = true;
  path.wavelengths = sample_wavelengths(path.camera[2]);
  path.sensor = sensor_of(path.camera, path.wavelengths);
}

// Of a sample whose numbers for the camera are `camera`.
SensorWeights PathTracer::sensor_of(const std::array<float, 4>& camera,
                                    const SampledWavelengths& wavelengths) const {
  return sensor_weights(wavelengths, scene_.filter.weight(camera[0], camera[1]), film_.bins());
}

CameraRay PathTracer::camera_ray(int x, int y, const Path& path) const {
  const Point2d offset = scene_.filter.sample(path.camera[0], path.camera[1]).offset;
  Point2d lens;
  if (scene_.camera.has_lens()) {
    const std::array<float, 4> point = sample_4d(path.key, sample_set::lens);
    lens = {static_cast<double>(point[0]), static_cast<double>(point[1])};
  }
  return scene_.camera.ray({x + 0.5 + offset.x, y + 0.5 + offset.y}, lens, path.time_s);
}

void PathTracer::trace_camera(int x, int y, std::uint32_t sample) {
  Path path;
  path.pixel =
      static_cast<std::uint32_t>(pixel_place(x - film_.crop().x0, y - film_.crop().y0, film_.width()));
  path.sample = sample;
  begin(path);
  const CameraRay ray = camera_ray(x, y, path);
  if (film_.layers().any()) path.set(path_unrecorded);
  path.throughput = filled(static_cast<float>(ray.weight));
  if (scene_.sampling.one_wavelength) path.disperse();
  path.inside = scene_.interiors.state_in(manifest_.camera_medium);
  path.direction = ray.direction;
  path.ray = {ray.origin, decode_direction(ray.direction), no_triangle};
  path.random = hash_of_ray(path);
  film_.count_sample(path.pixel, sample, footprint_of(path.pixel, sample));
  ++counters_.rays_camera;
  if (!(ray.weight > 0)) return;  // dark: the lens holds it up
  if (traffic_) traffic_->begin({});
  ++counters_.born;
  if (const auto sensor = scene_.camera.sensor(x); sensor && !begin_at(path, *sensor)) {
    ++counters_.died;
    return;
  }
  run(path, std::nullopt);
}

void PathTracer::resume(const PathRecord& record, std::uint32_t domain) {
  Path path;
  path.pixel = record.pixel;
  path.sample = record.sample_depth >> 9;
  begin(path);
  path.depth = (record.sample_depth & 0x1ff) << 8 | record.depth;
  path.flags = record.flags & (record.flags & (path_in_pane | path_connection) ? 0xf : 0xff);
  if (path.is(path_in_pane))
    path.entered_by = {static_cast<std::uint32_t>(record.flags >> 4) << 16 | record.pdf};
  else
    path.pdf = pdf_value(record.pdf);
  path.throughput = unpack_throughput(record.throughput);
  std::array<std::uint8_t, 3> travelled = std::to_array(record.travelled);
  if (has_cone(path)) path.cone = std::exchange(travelled[0], std::uint8_t{0});
  path.travelled = static_cast<double>(unpack_radiance(travelled.data()));
  if (path.is(path_connection)) {
    unpack_connection(record, path);
  } else if (path.is(path_in_pane)) {
    path.parts = travelled[2] & pane_parts;
    path.owes = travelled[2] & pane_owes;
    if (travelled[2] & pane_connected) path.set(path_connected);
    path.travelled = 0;
  }
  path.inside = record.inside;
  path.direction = record.direction;
  path.ray = unpacked(record);
  path.random = hash_of_ray(path);
  path.hit.t = record.hit_t;
  path.hit.triangle = record.hit_triangle;
  path.hit_domain = record.hit_domain;
  if (traffic_) traffic_->begin({domain, true});
  run(path, domain);
}

bool PathTracer::has_cone(const Path& path) const {
  return manifest_.requirements.filtering && !path.is(path_connection);
}

void PathTracer::run(Path& path, std::optional<std::uint32_t> at) {
  while (find_hit(path, at)) {
    at.reset();
    if (!(flies() ? shade_photon(path) : shade(path))) {
      ++counters_.died;
      return;
    }
    ++counters_.rays_indirect;
  }
}

void PathTracer::intersect(Path& path, const RayConstants& constants, std::uint32_t domain) {
  count_visit(domain);
  const double t = path.hit.t;
  const std::uint32_t triangle = path.hit.triangle;
  kernel_.closest(*resident_[domain], constants, path.hit);
  if (path.hit.t != t || path.hit.triangle != triangle) path.hit_domain = domain;
}

// True when the hit, or that there is none, is certain and its domain at hand; false when the path went on
// elsewhere.
bool PathTracer::find_hit(Path& path, std::optional<std::uint32_t> at) {
  bool located = true;  // hit.cluster, lane and chain are known
  const RayConstants constants = prepare(path.ray, path.time_s);
  if (at && path.is(path_resolved)) {
    path.clear(path_resolved);
    located = false;
  } else {
    DomainWalk walk(manifest_, path.ray, resident_);
    if (at) {
      const std::uint32_t carried = path.hit.triangle;
      intersect(path, constants, *at);
      located = carried == no_triangle || path.hit.triangle != carried || path.hit_domain == *at;
      walk.skip_past(*at);
    }
    bool first = !at;
    for (DomainWalk::Visit visit; walk.next(path.hit.t, visit);) {
      if (!first) ++counters_.crossings;
      first = false;
      if (!resident_[visit.domain]) return forward(path, visit.domain, false);
      const std::uint32_t holder = path.hit_domain;
      intersect(path, constants, visit.domain);
      if (path.hit_domain != holder) located = true;
    }
  }
  if (path.hit.triangle == no_triangle || located) return true;
  if (!resident_[path.hit_domain]) return forward(path, path.hit_domain, true);
  path.hit = {};
  intersect(path, constants, path.hit_domain);
  return true;
}

bool PathTracer::forward(const Path& path, std::uint32_t domain, bool resolved) {
  PathRecord r;
  r.hit_t = path.hit.t;
  r.hit_triangle = path.hit.triangle;
  r.hit_domain = static_cast<std::uint16_t>(path.hit_domain);
  pack(path.ray, path.direction, r);
  pack_throughput(path.throughput, r.throughput);
  pack_radiance(static_cast<float>(path.travelled), r.travelled);
  if (has_cone(path)) r.travelled[0] = path.cone;
  r.inside = path.inside;
  r.pixel = path.pixel;
  r.sample_depth = path.sample << 9 | path.depth >> 8;
  r.depth = static_cast<std::uint8_t>(path.depth);
  const bool in_pane = path.is(path_in_pane);
  const std::uint32_t face = in_pane ? path.entered_by.bits : 0;
  r.pdf = in_pane ? static_cast<std::uint16_t>(face) : pdf_code(path.pdf);
  r.flags = static_cast<std::uint8_t>((in_pane ? path.flags & 0xf : path.flags) |
                                      (resolved ? path_resolved : 0) | face >> 16 << 4);
  if (path.is(path_connection))
    pack_connection(path, r);
  else if (in_pane)
    r.travelled[2] = static_cast<std::uint8_t>((path.parts ? pane_parts : 0) | (path.owes ? pane_owes : 0) |
                                               (path.is(path_connected) ? pane_connected : 0));
  outbox_.paths.push_back({domain, r});
  if (traffic_) traffic_->leave_for(domain);
  return false;
}

void PathTracer::resume(const ShadowRecord& record, std::uint32_t domain) {
  Shadow shadow{unpacked(record), record.direction, record.tmax, {}, record.pixel, record.sample};
  for (std::size_t i = 0; i < hero_count; ++i) shadow.radiance.v[i] = unpack_radiance(record.radiance[i]);
  shadow.time_s = time_of(key_of(shadow.pixel, shadow.sample));
  if (traffic_) traffic_->begin({domain, true});
  trace_shadow(shadow, nullptr, domain);
}

void PathTracer::forward(const Shadow& shadow, std::uint32_t domain) {
  ShadowRecord r;
  pack(shadow.ray, shadow.direction, r);
  r.tmax = shadow.tmax;
  for (std::size_t i = 0; i < hero_count; ++i) pack_radiance(shadow.radiance.v[i], r.radiance[i]);
  r.pixel = shadow.pixel;
  r.sample = shadow.sample;
  outbox_.shadows.push_back({domain, r});
  if (traffic_) traffic_->leave_for(domain);
}

// `at` is given for a ray that was born elsewhere or earlier, whose end is counted.
void PathTracer::trace_shadow(const Shadow& shadow, const SensorWeights* weights,
                              std::optional<std::uint32_t> at) {
  const RayTraffic::Place here = traffic_ ? traffic_->place() : RayTraffic::Place{};
  const bool occluded = is_occluded(shadow, at);
  if (traffic_) traffic_->set(here);
  if (occluded) return;
  if (weights) {
    deposit(shadow.pixel, shadow.sample, *weights, shadow.radiance);
  } else {
    const std::array<float, 4> u = camera_numbers(key_of(shadow.pixel, shadow.sample));
    deposit(shadow.pixel, shadow.sample, sensor_of(u, sample_wavelengths(u[2])), shadow.radiance);
  }
  if (at) ++counters_.died;
}

// Also where it went on elsewhere.
bool PathTracer::is_occluded(const Shadow& shadow, std::optional<std::uint32_t> at) {
  const RayConstants constants = prepare(shadow.ray, shadow.time_s);
  DomainWalk walk(manifest_, shadow.ray, resident_);
  if (at) {
    count_visit(*at);
    if (kernel_.occluded(*resident_[*at], constants, shadow.tmax)) {
      ++counters_.died;
      return true;
    }
    walk.skip_past(*at);
  }
  bool first = !at;
  for (DomainWalk::Visit visit; walk.next(static_cast<double>(shadow.tmax), visit);) {
    if (!first) ++counters_.crossings;
    first = false;
    if (!resident_[visit.domain]) {
      forward(shadow, visit.domain);
      if (!at) ++counters_.born;
      return true;
    }
    count_visit(visit.domain);
    if (kernel_.occluded(*resident_[visit.domain], constants, shadow.tmax)) {
      if (at) ++counters_.died;
      return true;
    }
  }
  return false;
}

void PathTracer::deposit(std::uint32_t pixel, std::uint32_t sample, const SensorWeights& weights,
                         const SampledSpectrum& radiance) {
  const XYZ light = sense(weights, radiance);
  const double left = film_.clamp(pixel, sample, light);
  const Footprint* const spread = footprint_of(pixel, sample);
  if (!film_.deposit(pixel, sample, {left * light.x, left * light.y, left * light.z}, spread) ||
      film_.bins().count == 0)
    return;
  for (std::size_t i = 0; i < hero_count; ++i) {
    const double value = left * static_cast<double>(radiance.v[i]) * static_cast<double>(weights.spectral[i]);
    if (value != 0) film_.deposit_bin(pixel, sample, weights.bin[i], value, spread);
  }
}

}  // namespace vitrail
