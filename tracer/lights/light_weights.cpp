// SPDX-License-Identifier: Apache-2.0
#include "tracer/lights/light_weights_lanes.h"

namespace vitrail {

namespace {

void weigh_portable(const LightNode& node, Point3f p, LightWeights& result) { lanes::weigh(node, p, result); }

// The same bits.
#if defined(__x86_64__)
[[gnu::target("avx2")]] void weigh_avx2(const LightNode& node, Point3f p, LightWeights& result) {
  lanes::weigh(node, p, result);
}
const auto chosen = __builtin_cpu_supports("avx2") ? weigh_avx2 : weigh_portable;
#else
constexpr auto chosen = weigh_portable;
#endif

}  // namespace

void weigh(const LightNode& node, Point3f p, LightWeights& result) { chosen(node, p, result); }

}  // namespace vitrail
