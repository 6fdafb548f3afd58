// SPDX-License-Identifier: Apache-2.0
// This file intersects through a tree that Embree builds and walks: a second opinion on the trees of the
// bundle. The leaves are the domain's clusters, as user geometry, and the kernel's exact test decides in
// them, so that every hit has the same bits.
#pragma once

#include <memory>

#include "tracer/intersect/intersector.h"

namespace vitrail {

// An EmbreeDomain is a domain with Embree's tree over its clusters, built here. It refers to what the view
// shows, which outlives it. The constructor throws MachineError when Embree fails.
class EmbreeDomain : public DomainView {
 public:
  // The kernel meets instances by their own trees; or, in tests, Embree does, which tries every cluster of
  // each.
  enum class Instances { by_kernel, one_by_one };
  explicit EmbreeDomain(const DomainView& domain, Instances instances = Instances::one_by_one);
  ~EmbreeDomain();
  EmbreeDomain(const EmbreeDomain&) = delete;
  EmbreeDomain& operator=(const EmbreeDomain&) = delete;

  // Both do what KernelFunctions::closest and occluded do.
  void closest(const RayConstants& ray, Hit& hit) const;
  bool occluded(const RayConstants& ray, float tmax) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// Returns the fastest kernel's functions for domains that are all EmbreeDomains: rays go from one into the
// next.
const KernelFunctions& embree_kernel();

// Returns the most bytes that Embree's trees take for domains of so many bytes.
std::uint64_t embree_bytes(std::uint64_t domain_bytes);

}  // namespace vitrail
