// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/shadow_ray.h"

#include <algorithm>
#include <new>
#include <optional>

#include "tracer/rays/walk.h"
#include "tracer/transport/find_hit.h"

namespace vitrail {

namespace {

LitBy lit_by(const ShadowRay& s) { return {s.light_group, s.ray.direction}; }

void send(Tracing& tracing, const ShadowRay& s, std::uint32_t domain) {
  ShadowRecord r;
  r.origin[0] = s.ray.origin.x;
  r.origin[1] = s.ray.origin.y;
  r.origin[2] = s.ray.origin.z;
  r.direction = s.direction;
  r.exclude = s.ray.exclude;
  r.tmax = s.tmax;
  for (std::size_t i = 0; i < hero_count; ++i) pack_radiance(s.radiance.v[i], r.radiance[i]);
  r.pixel = s.pixel;
  r.sample_group = ShadowRecord::with_group(s.sample, s.light_group);
  tracing.outbox.shadows.push_back({domain, r});
  if (tracing.traffic) tracing.traffic->leave_for(domain);
}

enum class Way { free, blocked, elsewhere };

// `at` is given for a ray that was born elsewhere or earlier.
Way follow(Tracing& tracing, const ShadowRay& s, std::optional<std::uint32_t> at) {
  const RayConstants constants = prepare(s.ray, s.time_s);
  const auto is_blocked_in = [&](std::uint32_t domain) {
    tracing.count_visit(domain);
    return tracing.kernel.occluded(*tracing.resident[domain], constants, s.tmax);
  };
  if (!at && goes_by_tree(tracing, s.ray)) {
    if (!DomainWalk::starts_near(s.ray.origin)) return Way::free;
    const Passage passage = tracing.kernel.domains_occluded(tracing.scene.domain_tree.data(),
                                                            tracing.resident.data(), constants, s.tmax);
    if (passage != Passage::unknown) return passage == Passage::free ? Way::free : Way::blocked;
  }
  const bool counts = DomainWalk::is_sampled(s.ray);
  DomainWalk walk(tracing.manifest(), s.ray, tracing.resident);
  if (at) {
    if (is_blocked_in(*at)) return Way::blocked;
    walk.skip_past(*at, tracing.scene.cell_ways);
  }
  bool first = !at;
  for (DomainWalk::Visit visit; walk.next(static_cast<double>(s.tmax), visit);) {
    if (!first && counts) tracing.counters.crossings += DomainWalk::sampled_one_in;
    first = false;
    if (!tracing.resident[visit.domain]) {
      send(tracing, s, visit.domain);
      return Way::elsewhere;
    }
    if (is_blocked_in(visit.domain)) return Way::blocked;
  }
  return Way::free;
}

// The scene's only domain is resident.
void trace_in_one(Tracing& tracing, ShadowRays& waiting) {
  constexpr std::size_t most_at_once = 32;  // what the kernel reads of them stays in the first cache
  RayConstants rays[most_at_once] = {};
  float ends[most_at_once];
  bool blocked[most_at_once];
  for (std::size_t first = 0; first < waiting.count; first += most_at_once) {
    const std::size_t count = std::min(waiting.count - first, most_at_once);
    for (std::size_t i = 0; i < count; ++i) {
      const ShadowRay& s = waiting.rays[first + i];
      new (rays + i) RayConstants(prepare(s.ray, s.time_s));  // in place, as a copy costs much
      // What starts too far away meets nothing.
      ends[i] = DomainWalk::starts_near(s.ray.origin) ? s.tmax : 0;
    }
    tracing.kernel.occluded_of_many(*tracing.resident[0], rays, ends, blocked, count);
    for (std::size_t i = 0; i < count; ++i) {
      const ShadowRay& s = waiting.rays[first + i];
      if (!blocked[i]) deposit(tracing, s.pixel, s.sample, *s.sensor, s.radiance, lit_by(s));
    }
  }
  waiting.count = 0;
}

}  // namespace

void trace(Tracing& tracing, ShadowRays& rays) {
  trace(tracing, rays.connections);
  if (DomainWalk::has_one(tracing.manifest(), tracing.resident) && !tracing.traffic)
    return trace_in_one(tracing, rays);
  for (std::size_t i = 0; i < rays.count; ++i) {
    const ShadowRay& s = rays.rays[i];
    const RayTraffic::Place here = tracing.traffic ? tracing.traffic->place() : RayTraffic::Place{};
    const Way way = follow(tracing, s, std::nullopt);
    if (tracing.traffic) tracing.traffic->set(here);
    if (way == Way::elsewhere) ++tracing.counters.born;
    if (way == Way::free) deposit(tracing, s.pixel, s.sample, *s.sensor, s.radiance, lit_by(s));
  }
  rays.count = 0;
}

void resume(Tracing& tracing, const ShadowRecord& record, std::uint32_t domain) {
  ShadowRay s{{{record.origin[0], record.origin[1], record.origin[2]},
               decode_direction(record.direction),
               record.exclude},
              record.direction,
              record.tmax,
              {},
              record.pixel,
              record.sample(),
              record.light_group()};
  for (std::size_t i = 0; i < hero_count; ++i) s.radiance.v[i] = unpack_radiance(record.radiance[i]);
  const SampleKey key = key_of(tracing, s.pixel, s.sample);
  s.time_s = time_of(tracing, key);
  if (tracing.traffic) tracing.traffic->begin({domain, true});
  const Way way = follow(tracing, s, domain);
  if (way == Way::elsewhere) return;
  ++tracing.counters.died;
  if (way == Way::blocked) return;
  const std::array<float, 4> u = camera_numbers(tracing, key);
  deposit(tracing, s.pixel, s.sample, sensor_of(tracing, u, sample_wavelengths(u[2])), s.radiance, lit_by(s));
}

}  // namespace vitrail
