// SPDX-License-Identifier: Apache-2.0
// These functions turn a material's record into its model of scattering at one point: every parameter is
// looked up.
#pragma once

#include <span>

#include "scene/records/material.h"
#include "tracer/surfaces/scattering.h"
#include "tracer/textures/textures.h"

namespace vitrail {

bool has_tint(const PrincipledMaterial& m);

// It is a table of the bundle and what is made of it when it is loaded.
struct LoadedFourier {
  const FourierTable* table;  // outlives it
  FourierIntegrals integrals;
};
struct LoadedAdaptive {
  const AdaptiveTable* table;  // outlives it
  AdaptiveWarps warps;
};
using LoadedTable = std::variant<LoadedFourier, LoadedAdaptive>;
LoadedTable loaded_table(const ScatteringTable& table);

struct BsdfMaker {
  const Textures& textures;
  TexturePoint at;
  const SampledWavelengths& wavelengths;
  const Spectrum* exterior_eta;              // as of an Interaction
  const RoughPlasticTables* plastic_tables;  // of the material, where it is a plastic
  SampledSpectrum throughput;                // of the path
  std::uint64_t event;                       // what walks in layers are a function of
  double luminance;                          // of a constant colour, where the material has a tint of it
  std::span<const LoadedTable> tables;       // the bundle's

  Bsdf operator()(const DiffuseMaterial& m) const;
  Bsdf operator()(const DielectricMaterial& m) const;
  Bsdf operator()(const ThinDielectricMaterial& m) const { return thin(m); }
  Bsdf operator()(const ConductorMaterial& m) const;
  Bsdf operator()(const PlasticMaterial& m) const;
  Bsdf operator()(const CoatedDiffuseMaterial& m) const;
  Bsdf operator()(const CoatedConductorMaterial& m) const;
  Bsdf operator()(const DiffuseTransmissionMaterial& m) const;
  Bsdf operator()(const PrincipledMaterial& m) const;
  Bsdf operator()(const HairMaterial& m) const;
  Bsdf operator()(const MeasuredMaterial& m) const {
    return MeasuredSheetBsdf{&*m.sheet, wavelengths, throughput};
  }
  Bsdf operator()(const TabulatedMaterial& m) const;
  Bsdf operator()(const SlabMaterial& m) const { return slab(m); }
  Bsdf operator()(const FinishMaterial& m) const { return finish(m); }
  Bsdf operator()(const GlazedMaterial& m) const;
  // These are never called: parts are chosen, nothing is gone through, and bundles have no subsurface
  // materials.
  Bsdf operator()(const BlendMaterial&) const { return LambertBsdf{}; }
  Bsdf operator()(const MaskMaterial&) const { return LambertBsdf{}; }
  Bsdf operator()(const TwoSidedMaterial&) const { return LambertBsdf{}; }
  Bsdf operator()(const InterfaceMaterial&) const { return LambertBsdf{}; }
  Bsdf operator()(const SubsurfaceMaterial&) const { return LambertBsdf{}; }

  ThinDielectricBsdf thin(const ThinDielectricMaterial& m) const;
  SlabBsdf slab(const SlabMaterial& m) const;

 private:
  SampledSpectrum spectrum(const SpectrumParameter& p) const;
  double number(const FloatParameter& p) const;
  Microfacets microfacets(const Roughness& r) const;
  Microfacets microfacets(const Roughness& r, Masking masking) const;
  ConductorBsdf metal(const Metal& metal) const;
  FinishBsdf finish(const FinishMaterial& m) const;
  LayerVolume coating(const CoatingVolume& v) const;
  double luminance_of(const PrincipledMaterial& m) const;
  SampledSpectrum absorption(const HairMaterial& m) const;
};

}  // namespace vitrail
