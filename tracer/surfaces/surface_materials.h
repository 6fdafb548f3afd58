// SPDX-License-Identifier: Apache-2.0
// Materials are those of a bundle: they give, for a record and a point, what scatters there.
#pragma once

#include <optional>
#include <vector>

#include "bundle/manifest.h"
#include "tracer/sampling/sampler.h"
#include "tracer/surfaces/bsdf_of.h"
#include "tracer/surfaces/interaction.h"
#include "tracer/surfaces/scattering.h"

namespace vitrail {

// It is what a path has to know of a surface's material before anything is looked up.
struct MaterialKind {
  bool is_interface = false;       // nothing is there
  bool is_fibre = false;           // nothing is there from behind
  bool transmits = false;          // light gets to the other side: asked from either
  bool smooth_dielectric = false;  // bends light as it is: of panes and connections through them
  bool dispersive = false;         // its index depends on λ
  bool diffuse = false;            // it, or a part of it, may be one that gathers photons
  bool opaque = false;             // stops all connections
  bool sheet = false;              // lets light straight through, and mirrors some
  bool along_surface = false;      // has a direction along the surface: frames follow (u,v)

  bool is_nothing(const Interaction& at) const { return is_interface || (is_fibre && !at.front); }
};

class Materials {
 public:
  // Both have to outlive it.
  Materials(const Manifest& manifest, const Textures& textures);

  const MaterialKind& kind(std::uint32_t material) const { return kinds_[material]; }
  // Returns whether some smooth interface or sheet may stand parallel to another.
  bool have_panes() const { return have_panes_; }

  // Returns the material that a path meets: of two sides the one that it sees, of a blend one by chance. A
  // mask gives its material or null: nothing is there, and light goes straight through.
  const Material* choose(std::uint32_t material, const Interaction& at, MaterialNumbers& numbers) const;
  // Returns the share of the light that goes straight through, by no chance. It is of light of that Q/I
  // (tracer/panes/polarization.h), which matters to thin glass.
  SampledSpectrum passes_straight(std::uint32_t material, const Interaction& at,
                                  const SampledWavelengths& wavelengths, double q = 0) const;
  // Returns the share that sheets and smooth metal mirror.
  SampledSpectrum mirrors(std::uint32_t material, const Interaction& at,
                          const SampledWavelengths& wavelengths, double q = 0) const;

  // Returns whether a chosen material turns wavelengths into different directions.
  bool disperses(const Material& material, const Interaction& at) const {
    return kind(index_of(material)).dispersive || (at.exterior_eta && !is_constant(*at.exterior_eta));
  }
  // Returns whether a chosen material scatters: the back of a one-sided surface is black.
  bool scatters(const Material& material, const Interaction& at) const;
  // Returns the scattering of a material that scatters. `throughput` of the path guides choices between
  // wavelengths; walks in layers are a function of `event`.
  Scattering scattering_at(const Material& material, const Interaction& at,
                           const SampledWavelengths& wavelengths, const SampledSpectrum& throughput,
                           std::uint64_t event) const;
  // Returns the BSDF at a point of a chosen material that depends on nothing but the point: it is one of
  // those that LaneKind knows.
  Bsdf bsdf_at(const Material& material, const TexturePoint& at, const SampledWavelengths& wavelengths) const;
  // Returns the normal as bump and normal maps turn it, on the same side as at.geometric. `any_normal` is
  // takes_any_normal of the BSDF there.
  Vector3d shading_normal(const Material& material, const Interaction& at, bool any_normal = false) const;
  // Returns the direction that the tangent of the frame follows. A map turns the frame of the smooth normal,
  // whose tangent is perpendicular to that, as in pbrt and Mitsuba.
  Vector3d tangent(const Material& material, const Interaction& at) const;

 private:
  std::uint32_t index_of(const Material& material) const {
    return static_cast<std::uint32_t>(&material - manifest_.materials.data());
  }
  template <class OfPart>
  SampledSpectrum mixed(std::uint32_t material, const Interaction& at, float of_nothing,
                        const OfPart& of_part) const;
  BsdfMaker maker_at(const TexturePoint& at, const SampledWavelengths& wavelengths) const;
  const Manifest& manifest_;
  const Textures& textures_;
  std::vector<MaterialKind> kinds_;
  bool have_panes_ = false;
  std::vector<RoughPlasticTables> plastic_tables_;
  std::vector<std::uint32_t> plastic_table_;  // of a material: index into plastic_tables_
  std::vector<LoadedTable> tables_;
  std::vector<double> luminance_;  // of a material: of the constant colour that it has a tint of
};

// Returns the index behind over the index in front at the four wavelengths, seen from where the ray came.
SampledSpectrum relative_index(const DielectricMaterial& material, const Interaction& at,
                               const SampledWavelengths& wavelengths);
// Returns the index in front, at the hero wavelength.
double near_index(const DielectricMaterial& material, const Interaction& at,
                  const SampledWavelengths& wavelengths);

}  // namespace vitrail
