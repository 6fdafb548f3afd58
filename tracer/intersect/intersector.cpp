// SPDX-License-Identifier: Apache-2.0
#include "tracer/intersect/intersector.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>

#include "scene/system/diagnostics.h"
#include "tracer/intersect/kernels.h"

namespace vitrail {
namespace {

constexpr Kernel all_kernels[] = {Kernel::portable, Kernel::avx2, Kernel::avx512};

bool runs_here(Kernel kernel) {
#if defined(__x86_64__)
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (kernel == Kernel::avx2) return avx2;
  if (kernel == Kernel::avx512) {
    return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  }
#endif
  return kernel == Kernel::portable;
}

Kernel choose_kernel() {
  const std::vector<Kernel> available = available_kernels();
  const char* wanted = std::getenv("VITRAIL_KERNEL");
  if (!wanted) return available.back();
  std::string names;
  for (const Kernel kernel : available) {
    if (name(kernel) == wanted) return kernel;
    names += (names.empty() ? "" : ", ") + std::string(name(kernel));
  }
  throw Error("VITRAIL_KERNEL=" + std::string(wanted) +
              " is no kernel that runs here; choose one of: " + names);
}

}  // namespace

std::vector<Kernel> available_kernels() {
  std::vector<Kernel> available;
  std::copy_if(std::begin(all_kernels), std::end(all_kernels), std::back_inserter(available), runs_here);
  return available;
}

std::string_view name(Kernel kernel) {
  constexpr std::string_view names[] = {"portable", "avx2", "avx512"};
  return names[static_cast<std::size_t>(kernel)];
}

const KernelFunctions& kernel_functions(Kernel kernel) {
  if (!runs_here(kernel))
    throw Error("the kernel " + std::string(name(kernel)) + " does not run on this CPU");
#if defined(__x86_64__)
  if (kernel == Kernel::avx2) return avx2_kernel;
  if (kernel == Kernel::avx512) return avx512_kernel;
#endif
  return portable_kernel;
}

Kernel best_kernel_kind() {
  static const Kernel chosen = choose_kernel();
  return chosen;
}
const KernelFunctions& best_kernel() {
  static const KernelFunctions& chosen = kernel_functions(best_kernel_kind());
  return chosen;
}

}  // namespace vitrail
