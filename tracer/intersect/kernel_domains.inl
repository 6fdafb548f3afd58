// SPDX-License-Identifier: Apache-2.0
// The part of kernel.inl that goes through several domains: a tree, whose leaves are domains, leads into the
// trees of those at hand. The ray meets all boxes by the same slabs.
#include "tracer/intersect/kernel_instances.inl"

bool domains_closest(const BvhNode* tree, const DomainView* const* domains, const RayConstants& ray, Hit& hit,
                     std::uint32_t& holder) {
  const Slabs slabs(ray);
  bool complete = true;
  visit_nearest_first(tree, domains, slabs, zeta_limit(ray, hit.t), [&](std::uint32_t d, float limit) {
    if (!domains[d]) {
      complete = false;
      return limit;
    }
    const double t = hit.t;
    const std::uint32_t triangle = hit.triangle;
    closest_in_domain(*domains[d], slabs, ray, hit);
    if (hit.t == t && hit.triangle == triangle) return limit;
    holder = d;
    return zeta_limit(ray, hit.t);
  });
  return complete;
}

Passage domains_occluded(const BvhNode* tree, const DomainView* const* domains, const RayConstants& ray,
                         float tmax) {
  const Slabs slabs(ray);
  Passage passage = Passage::free;
  const bool blocked = any_entered(tree, domains, slabs, zeta_limit(ray, tmax), [&](std::uint32_t d) {
    if (domains[d]) return occluded_in_domain(*domains[d], slabs, ray, tmax);
    passage = Passage::unknown;
    return false;
  });
  return blocked ? Passage::blocked : passage;
}
