// SPDX-License-Identifier: Apache-2.0
// This file intersects rays exactly with one domain. Traversal only culls. A double-precision watertight test
// on the uncut triangle decides (Woop, Benthin & Wald, JCGT 2013), so every kernel and every decomposition
// gives the same bits.
#pragma once

#include <string_view>
#include <vector>

#include "tracer/rays/ray.h"

namespace vitrail {

enum class Kernel { portable, avx2, avx512 };

// Returns the kernels that this CPU can run, slowest first. `portable` is always there.
std::vector<Kernel> available_kernels();
std::string_view name(Kernel kernel);

// It says what a ray comes to on its way; `unknown`: to a domain that is not at hand.
enum class Passage { free, blocked, unknown };

// It holds the functions of one kernel. All kernels give the same bits.
struct KernelFunctions {
  // Lowers `hit` to the least (t, triangle) among it and the domain's triangles; t is in (0, hit.t]. Among
  // equals the present hit stays.
  void closest(const DomainView& domain, const RayConstants& ray, Hit& hit) const {
    if (by_domain || !domain.instance_nodes.empty()) return domain_closest(domain, ray, hit);
    if (!domain.nodes.empty()) tree_closest(domain.nodes.data(), domain.clusters.data(), ray, hit);
  }
  // Returns whether any triangle is hit at t in (0, tmax).
  bool occluded(const DomainView& domain, const RayConstants& ray, float tmax) const {
    if (by_domain || !domain.instance_nodes.empty()) return domain_occluded(domain, ray, tmax);
    return !domain.nodes.empty() && tree_occluded(domain.nodes.data(), domain.clusters.data(), ray, tmax);
  }

  // Does the same for many rays, each with its hit.
  void closest_of_many(const DomainView& domain, const RayConstants* rays, Hit* const* hits,
                       std::size_t count) const {
    if (by_domain || domain.nodes.size() != 1) {
      for (std::size_t i = 0; i < count; ++i) closest(domain, rays[i], *hits[i]);
      return;
    }
    node_closest(domain.nodes.front(), domain.clusters.data(), rays, hits, count);
    if (domain.instance_nodes.empty()) return;
    for (std::size_t i = 0; i < count; ++i) instances_closest(domain, rays[i], *hits[i]);
  }
  // Tells for each ray whether it is blocked.
  void occluded_of_many(const DomainView& domain, const RayConstants* rays, const float* tmax, bool* blocked,
                        std::size_t count) const {
    if (by_domain || domain.nodes.size() != 1) {
      for (std::size_t i = 0; i < count; ++i) blocked[i] = occluded(domain, rays[i], tmax[i]);
      return;
    }
    node_occluded(domain.nodes.front(), domain.clusters.data(), rays, tmax, blocked, count);
    if (domain.instance_nodes.empty()) return;
    for (std::size_t i = 0; i < count; ++i)
      if (!blocked[i]) blocked[i] = instances_occluded(domain, rays[i], tmax[i]);
  }

  void (*tree_closest)(const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, Hit& hit);
  bool (*tree_occluded)(const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, float tmax);
  // They do the same in a domain that has instances, with these and those within their objects.
  void (*domain_closest)(const DomainView& domain, const RayConstants& ray, Hit& hit);
  bool (*domain_occluded)(const DomainView& domain, const RayConstants& ray, float tmax);
  // They do the same with the instances alone.
  void (*instances_closest)(const DomainView& domain, const RayConstants& ray, Hit& hit);
  bool (*instances_occluded)(const DomainView& domain, const RayConstants& ray, float tmax);
  // They do the same with one cluster alone, whose index the hit is to have.
  void (*cluster_closest)(const Cluster& cluster, std::uint32_t index, const RayConstants& ray, Hit& hit);
  bool (*cluster_occluded)(const Cluster& cluster, const RayConstants& ray, float tmax);
  // They take many rays and the clusters of one node, whose children are all clusters.
  void (*node_closest)(const BvhNode& node, const Cluster* clusters, const RayConstants* rays,
                       Hit* const* hits, std::size_t count);
  void (*node_occluded)(const BvhNode& node, const Cluster* clusters, const RayConstants* rays,
                        const float* tmax, bool* blocked, std::size_t count);
  // They go through all domains that are at hand, by a tree of them (rays/domain_tree.h). `domains` is by
  // number, null where a domain is not at hand. `holder` becomes the domain of the hit, if the hit is
  // lowered. The first returns false where the ray may enter, before the hit, domains that are not at hand.
  bool (*domains_closest)(const BvhNode* tree, const DomainView* const* domains, const RayConstants& ray,
                          Hit& hit, std::uint32_t& holder);
  Passage (*domains_occluded)(const BvhNode* tree, const DomainView* const* domains, const RayConstants& ray,
                              float tmax);
  // A set flag sends domains without instances through the functions of domains, too: their trees are not the
  // bundle's.
  bool by_domain = false;
};

// Throws Error when this CPU cannot run the kernel.
const KernelFunctions& kernel_functions(Kernel kernel);
// Returns the fastest kernel available, unless the environment's VITRAIL_KERNEL names another. A name that is
// unknown or cannot be run here throws Error.
const KernelFunctions& best_kernel();
Kernel best_kernel_kind();

}  // namespace vitrail
