// SPDX-License-Identifier: Apache-2.0
// Exact intersection with one domain. Traversal only culls; a double-precision watertight test on the uncut triangle
// decides (Woop, Benthin & Wald, JCGT 2013), so every kernel and every decomposition gives the same bits.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "tracer/intersect/ray.h"

namespace vitrail {

enum class Kernel { portable, avx2, avx512 };

// Kernels this CPU can run, slowest first. `portable` is always there.
std::vector<Kernel> available_kernels();
std::string_view name(Kernel kernel);

// The functions of one kernel; the fastest available unless VITRAIL_KERNEL names another.
struct KernelFunctions {
  // Lowers `hit` to the least (t, triangle) among it and the domain's triangles; t in (0, hit.t].
  void (*closest)(const DomainView& domain, const Ray& ray, Hit& hit);
  // Whether any triangle is hit at t in (0, tmax).
  bool (*occluded)(const DomainView& domain, const Ray& ray, float tmax);
};
const KernelFunctions& kernel_functions(Kernel kernel);
const KernelFunctions& best_kernel();

// The same through Embree over user geometry: the portable reference, built when the domain is loaded.
class EmbreeDomain {
 public:
  explicit EmbreeDomain(const DomainView& domain);
  ~EmbreeDomain();
  EmbreeDomain(const EmbreeDomain&) = delete;
  EmbreeDomain& operator=(const EmbreeDomain&) = delete;
  void closest(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray, float tmax) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace vitrail
