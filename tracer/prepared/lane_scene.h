// SPDX-License-Identifier: Apache-2.0
// A LaneScene is what the stages that take several paths at a time (transport/waves/lane_stages.h) read of a
// scene. It says which surfaces and lamps are of a kind that they know.
#pragma once

#include <cstdint>
#include <vector>

#include "bundle/interiors.h"
#include "bundle/manifest.h"
#include "tracer/lights/light_sampler.h"
#include "tracer/sampling/flat_spectrum.h"
#include "tracer/surfaces/surface_materials.h"

namespace vitrail {

enum class LaneKind : std::uint8_t {
  none,     // for one path at a time
  diffuse,  // LambertBsdf
  mirror,   // ConductorBsdf, smooth
  metal,    // and rough
  plastic,  // PlasticBsdf
  rough_plastic,
  principled,  // PrincipledBsdf
  finish,      // FinishBsdf
  coated_diffuse,
  coated_conductor,
  rough_glass,  // DielectricBsdf, rough, of one index
  glass,        // smooth, of one index
  sheet         // ThinDielectricBsdf, of one index
};
inline constexpr std::size_t lane_kinds = 13;

// It is an image that lanes look up: by (u,v), bilinear, the finest level.
struct LaneTexture {
  const BakedImage* image = nullptr;
  std::uint32_t id = 0;  // of Manifest::textures
  UvMapping mapping;
  Wrap wrap = Wrap::repeat;
};

// It holds the parameters of a BSDF at a point.
struct LaneBsdf {
  static constexpr std::size_t most_spectra = 3;
  // They depend on the kind: a reflectance; index η and κ and a factor; diffuse and specular reflectance; a
  // base colour; factors of reflected and of transmitted light.
  SampledSpectrum spectra[most_spectra];
  Microfacets microfacets;
  double eta = 1, internal_reflectance = 0;       // of plastics; eta of rough glass, too
  const float* external_transmittance = nullptr;  // of rough ones: RoughPlasticTables'
  bool is_nonlinear = false, is_perfect = false;
  double g = 0;  // of a medium: its phase function
  PrincipledBsdf principled;
  FinishBsdf finish;
};
// Returns the parameters of a BSDF that LaneKind knows.
LaneBsdf lane_bsdf(const Bsdf& bsdf);

// It is the part of a CoatedDiffuseBsdf or CoatedConductorBsdf above its base. A LaneBsdf has the base's
// spectra and facets.
struct LaneCoating {
  double eta = 1;
  Microfacets interface;
  LayerVolume volume;
  std::uint64_t event = 0;
};
LaneCoating lane_coating(const Bsdf& bsdf, std::uint64_t event);

struct LaneMaterial {
  LaneKind kind = LaneKind::none;
  bool two_sided = false;
  bool transmits = false;                        // as MaterialKind
  bool is_textured = false;                      // its parameters depend on the point
  bool is_tilted = false;                        // a map or a height turns its normal
  bool is_raised = false;                        // a height does
  bool along_surface = false;                    // as MaterialKind
  bool has_parameters = true;                    // a LaneBsdf a path; else they are these, at all points:
  FlatSpectrum spectra[LaneBsdf::most_spectra];  // those of `constants`
  LaneBsdf constants;
  LaneTexture texture;  // of `diffuse`, where it has an image: the reflectance
  // They are the indices of `glass` on its back and on its front, and whether its factors are not 1. A
  // `sheet` has its index over that of what is around it, and 1.
  float eta_behind = 1, eta_before = 1;
  bool is_tinted = false;

  bool is_coated() const { return kind == LaneKind::coated_diffuse || kind == LaneKind::coated_conductor; }
  bool is_diffuse() const { return kind == LaneKind::diffuse || kind == LaneKind::finish; }
  bool is_specular() const { return kind == LaneKind::mirror || kind >= LaneKind::glass; }
};

struct LaneSurface {
  bool is_for_lanes = false;  // its material, or one that may be chosen of it
  bool is_chosen = false;     // of several, by side, by chance, or nothing: Materials::choose
  bool emits = false;
  bool blocks = false;  // no connection passes it
};

// A lamp is there as a whole and shines to all sides, alike all over, or is an emitter of a plain shape.
// `other` lamps are taken lane by lane.
enum class LaneLamp : std::uint8_t { other, triangle, sphere, emitter };

struct LaneScene {
  // A connection may be other than a shadow ray: light may pass something straight on, or has nothing in its
  // way.
  bool has_connections = false;
  bool passes_light = false;            // light may: it goes by connections to all lights
  bool has_walks = false;               // connections to distant lights walk through panes
  bool divides_space = false;           // as Interiors
  bool has_textures = false;            // some material has a LaneTexture
  std::vector<LaneMaterial> materials;  // of all Manifest::materials
  std::vector<LaneSurface> surfaces;    // of all Manifest::surfaces
  std::vector<LaneLamp> lamps;          // of each slot of the lights' tree
  // They are the radiances of all Manifest::area_lights that have no texture.
  std::vector<FlatSpectrum> radiances;
  // They are of all LightSampler::distant: whether lanes know the light, which is then no sun, and its
  // irradiance.
  struct Distant {
    bool is_plain = false;
    FlatSpectrum irradiance;
  };
  std::vector<Distant> distant;
  // They stand for what a path does not have.
  PointEmitter no_emitter;
  LightSampler::Slot no_slot;
  LightSampler::Face no_face;
  PlacedQuadric no_sphere{{}, {}};

  LaneScene(const Manifest& manifest, const Textures& images, const Interiors& interiors,
            const Materials& all_materials, const LightSampler& lights);
};

}  // namespace vitrail
