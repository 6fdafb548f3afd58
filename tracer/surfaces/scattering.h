// SPDX-License-Identifier: Apache-2.0
// It is scattering at one point of a surface: a model with its parameters looked up, and the frame that it is
// meant in.
#pragma once

#include <variant>

#include "tracer/bsdf/adaptive.h"
#include "tracer/bsdf/conductor.h"
#include "tracer/bsdf/dielectric.h"
#include "tracer/bsdf/diffuse.h"
#include "tracer/bsdf/finish.h"
#include "tracer/bsdf/fourier.h"
#include "tracer/bsdf/glazed.h"
#include "tracer/bsdf/hair.h"
#include "tracer/bsdf/layered.h"
#include "tracer/bsdf/measured.h"
#include "tracer/bsdf/plastic.h"
#include "tracer/bsdf/principled.h"
#include "tracer/bsdf/slab.h"
#include "tracer/surfaces/interaction.h"

namespace vitrail {

using Bsdf = std::variant<LambertBsdf, OrenNayarBsdf, DiffuseTransmissionBsdf, ConductorBsdf, DielectricBsdf,
                          ThinDielectricBsdf, PlasticBsdf, RoughPlasticBsdf, PrincipledBsdf,
                          PrincipledThinBsdf, CoatedDiffuseBsdf, CoatedConductorBsdf, MeasuredSheetBsdf,
                          FourierBsdf, AdaptiveBsdf, SlabBsdf, HairBsdf, FinishBsdf, GlazedBsdf>;

inline BsdfValue eval(const Bsdf& bsdf, Vector3d out, Vector3d in) {
  return std::visit([&](const auto& b) { return eval(b, out, in); }, bsdf);
}
inline std::optional<BsdfSample> sample(const Bsdf& bsdf, Vector3d out, float u_lobe, Point2f u) {
  return std::visit([&](const auto& b) { return sample(b, out, u_lobe, u); }, bsdf);
}

// Returns the BSDF as a lamp shows it that makes no highlights of POV-Ray's.
inline Bsdf without_highlights(Bsdf bsdf) {
  auto* const glazed = std::get_if<GlazedBsdf>(&bsdf);
  FinishBsdf* const finish = glazed ? &glazed->finish : std::get_if<FinishBsdf>(&bsdf);
  if (finish) finish->phong = finish->specular = 0;
  return bsdf;
}

// Returns whether it scatters into single directions alone: eval and pdf are 0 everywhere.
inline bool is_specular(const Bsdf& bsdf) {
  if (const auto* metal = std::get_if<ConductorBsdf>(&bsdf)) return metal->microfacets.smooth();
  if (const auto* glass = std::get_if<DielectricBsdf>(&bsdf)) return glass->microfacets.smooth();
  return std::holds_alternative<ThinDielectricBsdf>(bsdf) || std::holds_alternative<MeasuredSheetBsdf>(bsdf);
}

// Returns whether Materials::mirrors counts a specular sample, unless it goes straight on.
inline bool is_mirror(const Bsdf& bsdf) {
  return std::holds_alternative<ConductorBsdf>(bsdf) || std::holds_alternative<ThinDielectricBsdf>(bsdf) ||
         std::holds_alternative<MeasuredSheetBsdf>(bsdf);
}

// Returns whether `sample` does not need u_lobe, and is never specular.
inline bool has_one_lobe(const Bsdf& bsdf) {
  return std::holds_alternative<LambertBsdf>(bsdf) || std::holds_alternative<OrenNayarBsdf>(bsdf);
}

// Returns whether patterns may turn its normal away from the ray, as POV-Ray's do.
inline bool takes_any_normal(const Bsdf& bsdf) {
  return has_one_lobe(bsdf) || std::holds_alternative<FinishBsdf>(bsdf) ||
         std::holds_alternative<GlazedBsdf>(bsdf);
}

// Returns whether light from everywhere counts about alike.
inline bool is_diffuse(const Bsdf& bsdf) {
  return std::holds_alternative<LambertBsdf>(bsdf) || std::holds_alternative<OrenNayarBsdf>(bsdf) ||
         std::holds_alternative<DiffuseTransmissionBsdf>(bsdf) || std::holds_alternative<FinishBsdf>(bsdf);
}

// The frame is orthonormal. On the back of a surface that scatters there as in front, the normal is turned
// over and the tangents stay: it is left-handed.
struct ShadingFrame {
  Vector3d tangent, bitangent, normal;
  Vector3d to_world(Vector3d v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
  Vector3d to_local(Vector3d v) const { return {dot(v, tangent), dot(v, bitangent), dot(v, normal)}; }
};

// Returns a frame around a unit normal: the tangent follows `along` where that has a part across n. `side` is
// −1 on such a back, else 1.
ShadingFrame frame_around(Vector3d n, Vector3d along, double side);

struct Scattering {
  Bsdf bsdf;
  ShadingFrame frame;
  bool transmits = false;
  double bump_alpha2 = 0;  // of bump_shadowing

  // Returns the share that is left of light from a direction that makes this cosine with the surface's smooth
  // normal.
  double bump_shadowing(double cosine) const;
};

// Returns whether the shading normal would let the sampled `direction` through the surface, or reflect it
// into it; `out` is in the scattering's frame.
inline bool leaves_its_side(const Scattering& scattering, const Interaction& at, Vector3d out,
                            const BsdfSample& chosen, Vector3d direction) {
  return !scattering.transmits &&
         (dot(direction, at.geometric) > 0) != (dot(at.out, at.geometric) * out.z * chosen.in.z > 0);
}

// Returns the direction of a mirror then: it goes by the surface's own normal.
inline Vector3d mirrored(const Interaction& at) {
  return at.geometric * (2 * dot(at.out, at.geometric)) - at.out;
}

// Returns α² of microfacets among which a normal that a bump has turned, at this cosine to the smooth one,
// would be usual. It follows Conty Estevez, Lecocq and Stein, "A Microfacet-Based Shadowing Function to Solve
// the Bump Terminator Problem" (2019). Such facets shadow light by Smith's function: bump_shadowing.
double bump_alpha2(double cosine);

}  // namespace vitrail
