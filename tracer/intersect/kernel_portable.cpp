// SPDX-License-Identifier: Apache-2.0
#if defined(__SSE__)
#include <immintrin.h>
#endif

#include "tracer/intersect/exact_test.h"
#include "tracer/intersect/kernels.h"

namespace vitrail {
namespace {

#include "tracer/intersect/lanes_portable.h"

#include "tracer/intersect/kernel.inl"

}  // namespace

const KernelFunctions portable_kernel{tree_closest, tree_occluded, cluster_closest, cluster_occluded};

}  // namespace vitrail
