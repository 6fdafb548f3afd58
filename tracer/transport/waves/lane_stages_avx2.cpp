// SPDX-License-Identifier: Apache-2.0
#include "tracer/bsdf/conductor_lanes.h"
#include "tracer/bsdf/dielectric_lanes.h"
#include "tracer/bsdf/diffuse_lanes.h"
#include "tracer/bsdf/finish_lanes.h"
#include "tracer/bsdf/layered_lanes.h"
#include "tracer/bsdf/plastic_lanes.h"
#include "tracer/bsdf/principled_lanes.h"
#include "tracer/lanes/interaction.h"
#include "tracer/lanes/lamps.h"
#include "tracer/lanes/light_tree.h"
#include "tracer/lanes/rays.h"
#include "tracer/lanes/spectra.h"
#include "tracer/lights/environment_lanes.h"
#include "tracer/lights/point_emitter_lanes.h"
#include "tracer/lights/sphere_light_lanes.h"
#include "tracer/media/phase_lanes.h"
#include "tracer/sampling/power_heuristic_lanes.h"
#include "tracer/transport/waves/lane_stages.h"

namespace vitrail {
namespace lanes {
namespace {

constexpr int W = 4;
#include "tracer/transport/waves/lane_stages.inl"

}  // namespace
}  // namespace lanes

const LaneStages avx2_stages = lanes::stages;

}  // namespace vitrail
