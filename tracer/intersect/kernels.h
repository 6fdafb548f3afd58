// SPDX-License-Identifier: Apache-2.0
// The kernels' files define these. Each is kernel.inl compiled over eight lanes of another instruction set.
#pragma once

#include "tracer/intersect/intersector.h"

namespace vitrail {

extern const KernelFunctions portable_kernel;
#if defined(__x86_64__)
extern const KernelFunctions avx2_kernel;
extern const KernelFunctions avx512_kernel;
#endif

}  // namespace vitrail
