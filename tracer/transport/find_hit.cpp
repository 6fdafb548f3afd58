// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/find_hit.h"

namespace vitrail {

namespace {

void intersect(Tracing& tracing, Traveller& t, const RayConstants& constants, std::uint32_t domain) {
  tracing.count_visit(domain);
  const double distance = t.hit.t;
  const std::uint32_t triangle = t.hit.triangle;
  tracing.kernel.closest(*tracing.resident[domain], constants, t.hit);
  if (t.hit.t != distance || t.hit.triangle != triangle) t.hit_domain = domain;
}

}  // namespace

bool goes_by_tree(const Tracing& tracing, const Ray& ray) {
  return !tracing.scene.domain_tree.empty() && !tracing.traffic && !DomainWalk::is_sampled(ray);
}

std::optional<Elsewhere> find_hit(Tracing& tracing, Traveller& t, const std::optional<Arrival>& at) {
  bool located = true;  // hit.cluster, lane and chain are known
  const RayConstants constants = prepare(t.ray, t.time_s);
  if (!at && goes_by_tree(tracing, t.ray)) {
    if (!DomainWalk::starts_near(t.ray.origin)) return std::nullopt;
    Hit hit = t.hit;
    if (tracing.kernel.domains_closest(tracing.scene.domain_tree.data(), tracing.resident.data(), constants,
                                       hit, t.hit_domain)) {
      t.hit = hit;
      return std::nullopt;
    }
  }
  if (at && at->resolved) {
    located = false;
  } else {
    const bool counts = DomainWalk::is_sampled(t.ray);
    DomainWalk walk(tracing.manifest(), t.ray, tracing.resident);
    if (at) {
      const std::uint32_t carried = t.hit.triangle;
      intersect(tracing, t, constants, at->domain);
      located = carried == no_triangle || t.hit.triangle != carried || t.hit_domain == at->domain;
      walk.skip_past(at->domain, tracing.scene.cell_ways);
    }
    bool first = !at;
    for (DomainWalk::Visit visit; walk.next(t.hit.t, visit);) {
      if (!first && counts) tracing.counters.crossings += DomainWalk::sampled_one_in;
      first = false;
      if (!tracing.resident[visit.domain]) return Elsewhere{visit.domain, false};
      const std::uint32_t holder = t.hit_domain;
      intersect(tracing, t, constants, visit.domain);
      if (t.hit_domain != holder) located = true;
    }
  }
  if (!t.meets_surface()) return std::nullopt;
  if (located) {
    // Where not all domains are at hand, the ray goes back to that of its hit.
    if (tracing.traffic && t.hit_domain != tracing.traffic->place().domain) tracing.count_visit(t.hit_domain);
    return std::nullopt;
  }
  if (!tracing.resident[t.hit_domain]) return Elsewhere{t.hit_domain, true};
  t.hit = {};
  intersect(tracing, t, constants, t.hit_domain);
  return std::nullopt;
}

RayRecordHead head_of(const Traveller& t, RayRecordKind kind, bool resolved) {
  RayRecordHead head;
  head.hit_t = t.hit.t;
  head.hit_triangle = t.hit.triangle;
  head.hit_domain = static_cast<std::uint16_t>(t.hit_domain);
  head.direction = t.direction;
  head.origin[0] = t.ray.origin.x;
  head.origin[1] = t.ray.origin.y;
  head.origin[2] = t.ray.origin.z;
  head.exclude = t.ray.exclude;
  pack_throughput(t.throughput, head.throughput);
  head.inside = t.inside;
  head.kind_and_flags = static_cast<std::uint8_t>(kind);
  if (resolved) head.kind_and_flags |= ray_resolved;
  if (t.dispersed) head.kind_and_flags |= ray_dispersed;
  return head;
}

void unpack_head(const RayRecordHead& head, Traveller& t) {
  t.dispersed = head.is(ray_dispersed);
  t.throughput = unpack_throughput(head.throughput);
  t.inside = head.inside;
  t.direction = head.direction;
  t.ray = {{head.origin[0], head.origin[1], head.origin[2]}, decode_direction(head.direction), head.exclude};
  t.hit.t = head.hit_t;
  t.hit.triangle = head.hit_triangle;
  t.hit_domain = head.hit_domain;
  t.random = hash_of_ray(t);
}

}  // namespace vitrail
