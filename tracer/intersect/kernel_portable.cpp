// SPDX-License-Identifier: Apache-2.0
#include "tracer/intersect/exact_test.h"
#include "tracer/intersect/instance_ray.h"
#include "tracer/intersect/kernels.h"
#include "tracer/simd/lanes.h"

namespace vitrail {
namespace {

#include "tracer/intersect/lanes_portable.h"

#include "tracer/intersect/kernel.inl"

}  // namespace

const KernelFunctions portable_kernel = functions;

}  // namespace vitrail
