// SPDX-License-Identifier: Apache-2.0
// A material says how surfaces scatter light, as the scene files say it: the union of what pbrt and Mitsuba
// can express, in the terms of the model that each comes from. Materials refer to others only by a smaller
// id.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "scene/records/measured_sheet.h"
#include "scene/records/scattering_table.h"
#include "scene/records/texture.h"

namespace vitrail {

struct Material;

// It says how masking of one direction and shadowing of the other combine: as if independent (Walter et al.
// 2007, Eq. 23: Mitsuba), or as functions of one height (Heitz 2014, Eq. 99: pbrt). They differ by a third at
// grazing directions of a rough surface.
enum class Masking : std::uint8_t { separable, correlated };

// It describes microfacets. α is the width of the distribution along the two tangents (0: a smooth surface),
// whatever the file calls roughness.
struct Roughness {
  enum class Distribution : std::uint8_t { ggx, beckmann };
  FloatParameter alpha_u = 0.0f, alpha_v = 0.0f;
  Distribution distribution = Distribution::ggx;
  bool square_root = false;  // α is the square root of what a texture gives (pbrt's remapped roughness)
  Masking masking = Masking::separable;
  bool operator==(const Roughness&) const = default;
};

// It is Lambert's where sigma is 0, else Oren and Nayar's (1994) with facets of slope deviation `sigma_deg`,
// in degrees.
struct DiffuseMaterial {
  SpectrumParameter reflectance = ConstantSpectrum{0.5f};
  FloatParameter sigma_deg = 0.0f;
  bool operator==(const DiffuseMaterial&) const = default;
};

// It is the interface between a medium of index `exterior_eta` (on the front side) and one of index `eta`
// behind. The two factors stray from physics where they are not 1.
struct DielectricMaterial {
  Spectrum eta = ConstantSpectrum{1.5f};
  Spectrum exterior_eta = ConstantSpectrum{1};
  Roughness roughness;
  SpectrumParameter reflectance_factor = ConstantSpectrum{1}, transmittance_factor = ConstantSpectrum{1};
  // It orders dielectrics whose insides overlap: the greatest is there, and faces of the others in it are
  // not; exterior_eta then counts where nothing else is in front. One of 0 takes no part.
  int priority = 0;
  bool operator==(const DielectricMaterial&) const = default;
};

// It is a thin sheet of a dielectric: light leaves in the direction in which it came.
struct ThinDielectricMaterial {
  Spectrum eta = ConstantSpectrum{1.5f};
  Spectrum exterior_eta = ConstantSpectrum{1};
  SpectrumParameter reflectance_factor = ConstantSpectrum{1}, transmittance_factor = ConstantSpectrum{1};
  bool operator==(const ThinDielectricMaterial&) const = default;
};

// It gives a metal's reflectance by its index of refraction eta + i·k.
struct ComplexIndex {
  SpectrumParameter eta = NamedSpectrum{"metal-Cu-eta"}, k = NamedSpectrum{"metal-Cu-k"};
  bool operator==(const ComplexIndex&) const = default;
};
// It gives a metal's reflectance by `reflectance`, r, at normal incidence: eta = 1, k = 2√r/√(1−r).
struct NormalReflectance {
  SpectrumParameter reflectance;
  bool operator==(const NormalReflectance&) const = default;
};
// It reflects all of the light, at every angle.
struct PerfectReflector {
  bool operator==(const PerfectReflector&) const = default;
};
using Metal = std::variant<ComplexIndex, NormalReflectance, PerfectReflector>;

// It is a metal, smooth or rough.
struct ConductorMaterial {
  Metal metal;
  Roughness roughness;
  SpectrumParameter reflectance_factor = ConstantSpectrum{1};
  bool operator==(const ConductorMaterial&) const = default;
};

// It is Mitsuba's plastic: a dielectric boundary over a diffuse base; light scattered between the two is
// accounted for, with its shift of colour if `nonlinear`.
struct PlasticMaterial {
  SpectrumParameter diffuse_reflectance = ConstantSpectrum{0.5f}, specular_reflectance = ConstantSpectrum{1};
  float eta = 1.49f, exterior_eta = 1.000277f;
  Roughness roughness;  // isotropic
  bool nonlinear = false;
  bool operator==(const PlasticMaterial&) const = default;
};

// It is the volume of pbrt's layers, between a coating and its base, and says how many random walks sample
// them.
struct CoatingVolume {
  FloatParameter thickness = 0.01f;
  FloatParameter g = 0.0f;  // of Henyey and Greenstein
  SpectrumParameter albedo = ConstantSpectrum{0};
  int max_depth = 10, samples = 1;
  bool operator==(const CoatingVolume&) const = default;
};
// The facets of such layers mask as pbrt's do, whatever their roughness says.

struct CoatedDiffuseMaterial {
  SpectrumParameter reflectance = ConstantSpectrum{0.5f};
  Spectrum eta = ConstantSpectrum{1.5f};
  Roughness roughness;
  CoatingVolume volume;
  bool operator==(const CoatedDiffuseMaterial&) const = default;
};

// It is a metal below a clear coat.
struct CoatedConductorMaterial {
  Metal metal;
  Roughness conductor_roughness;
  Spectrum interface_eta = ConstantSpectrum{1.5f};
  Roughness interface_roughness;
  CoatingVolume volume;
  bool operator==(const CoatedConductorMaterial&) const = default;
};

// It reflects and transmits light as Lambert's law says.
struct DiffuseTransmissionMaterial {
  SpectrumParameter reflectance = ConstantSpectrum{0.25f}, transmittance = ConstantSpectrum{0.25f};
  float scale = 1;
  bool operator==(const DiffuseTransmissionMaterial&) const = default;
};

// It is Disney's (Burley 2012, 2015) as Mitsuba has it. If `thin`, it is a sheet, with `diff_trans` and
// without an interior. If `below`, its diffuse part is Lambert's, as in glTF, of the light that the surface
// above it does not reflect.
struct PrincipledMaterial {
  SpectrumParameter base_color = ConstantSpectrum{0.5f};
  FloatParameter roughness = 0.5f, anisotropic = 0.0f, metallic = 0.0f, spec_trans = 0.0f, spec_tint = 0.0f,
                 sheen = 0.0f, sheen_tint = 0.0f, flatness = 0.0f, clearcoat = 0.0f, clearcoat_gloss = 0.0f,
                 diff_trans = 0.0f;
  float eta = 1.5f;
  bool thin = false, below = false;
  bool operator==(const PrincipledMaterial&) const = default;
};

// It is a dielectric boundary with a scattering interior; coefficients are per unit of length, times `scale`.
struct SubsurfaceMaterial {
  // They are what the medium absorbs and scatters, 1/scene unit.
  struct Coefficients {
    SpectrumParameter sigma_a, sigma_s;
    bool operator==(const Coefficients&) const = default;
  };
  // They are the diffuse reflectance and the mean free path that lead to the coefficients.
  struct Effective {
    SpectrumParameter reflectance, mean_free_path;
    bool operator==(const Effective&) const = default;
  };
  // It is a name of pbrt's list of measured media: "Skin1".
  struct Named {
    std::string name;
    bool operator==(const Named&) const = default;
  };
  std::variant<Coefficients, Effective, Named> interior;
  float scale = 1, g = 0;
  Spectrum eta = ConstantSpectrum{1.33f};
  Roughness roughness;
  bool operator==(const SubsurfaceMaterial&) const = default;
};

// It is a fibre (Chiang et al. 2016): a cylinder seen from outside, of which nothing is met from within. Its
// absorption, over the radius, comes from the first of these that is given.
struct HairMaterial {
  std::optional<SpectrumParameter> sigma_a, color;
  std::optional<FloatParameter> eumelanin, pheomelanin;
  float eta = 1.55f, exterior_eta = 1;
  FloatParameter beta_m = 0.3f, beta_n = 0.3f, alpha_deg = 2.0f;
  bool along_v = false;  // it runs along v, as in Mitsuba, not along u, as in pbrt
  bool operator==(const HairMaterial&) const = default;
};

// It is a sheet of glass by its table (docs/why/measured-glass.md). Without a sheet it is a material that
// only Mitsuba can show: its polarised measurements.
struct MeasuredMaterial {
  std::string filename;  // absolute; of the table
  std::optional<MeasuredSheet> sheet{};
  bool operator==(const MeasuredMaterial&) const = default;
};

// It is a surface by the table of a file: Dupuy and Jakob's (pbrt-v4's and Mitsuba 3's "measured"), which
// reflects, or pbrt-v3's "fourier", which is asked from either side.
struct TabulatedMaterial {
  enum class Format : std::uint8_t { adaptive, fourier };
  Format format = Format::adaptive;
  std::string filename;            // absolute
  Id<ScatteringTable> table = {};  // of the bundle
  bool operator==(const TabulatedMaterial&) const = default;
};

// It is a slab of a medium without boundaries, in which light scatters once or goes straight through
// (Hanrahan and Krueger 1993, as Mitsuba 0.6 has it). Coefficients are per unit of length.
struct SlabMaterial {
  SpectrumParameter sigma_a = ConstantSpectrum{0}, sigma_s = ConstantSpectrum{0};
  float thickness = 1;
  float g = 0;  // of Henyey and Greenstein
  bool operator==(const SlabMaterial&) const = default;
};

// It is POV-Ray's finish: highlights of no normalised energy add to a diffuse part. With the mirrored
// direction r and the half vector h,
//
//   f·cos θ_in = (reflectance·cos θ_in^brilliance
//                 + highlight·(phong·(r·in)^phong_size + specular·(n·h)^(1/roughness)))/π.
struct FinishMaterial {
  SpectrumParameter reflectance = ConstantSpectrum{0.5f}, highlight = ConstantSpectrum{1};
  float brilliance = 1, phong = 0, phong_size = 40, specular = 0, roughness = 0.05f;
  bool operator==(const FinishMaterial&) const = default;
};

// It is POV-Ray's finish of a surface that also mirrors, or lets light through. At an angle θ light adds up
// as
//
//   lit by `finish` + R·metal·mirrored + T·behind,     R = mirror_min + (mirror_max − mirror_min)·k,
//   k = (1 − cos θ)^falloff, or Fresnel's reflectance of `eta`,
//
// T = through, ·(1 − R) with `conserves_energy`; metal goes from 1 to `tint` by `metallic`, and back at
// grazing angles. Energy may be made. Light from behind is bent by `eta`; shadows go straight on. The laws
// are measured, by POV-Ray 3.7 (docs/why/converting.md).
struct GlazedMaterial {
  FinishMaterial finish;  // its reflectance is of the share that is solid
  SpectrumParameter mirror_min = ConstantSpectrum{0}, mirror_max = ConstantSpectrum{0};
  SpectrumParameter tint = ConstantSpectrum{1};
  float falloff = 1, metallic = 0;
  bool fresnel = false, conserves_energy = false;
  SpectrumParameter through = ConstantSpectrum{0};
  float eta = 1;  // index behind / in front
  bool operator==(const GlazedMaterial&) const = default;
};

// It is no interface at all: rays go through unchanged.
struct InterfaceMaterial {
  bool operator==(const InterfaceMaterial&) const = default;
};

// It is (1 − amount)·first + amount·second.
struct BlendMaterial {
  Id<Material> first, second;
  FloatParameter amount = 0.5f;
  bool operator==(const BlendMaterial&) const = default;
};

// It is `material` where there is something: of all light, 1 − opacity goes through unchanged.
struct MaskMaterial {
  FloatParameter opacity = 1.0f;
  Id<Material> material;
  bool operator==(const MaskMaterial&) const = default;
};

// It has different sides. (A material that reflects only to its front has `two_sided` false instead.)
struct TwoSidedMaterial {
  Id<Material> front, back;
  bool operator==(const TwoSidedMaterial&) const = default;
};

using MaterialVariant =
    std::variant<DiffuseMaterial, DielectricMaterial, ThinDielectricMaterial, ConductorMaterial,
                 PlasticMaterial, CoatedDiffuseMaterial, CoatedConductorMaterial, DiffuseTransmissionMaterial,
                 PrincipledMaterial, SubsurfaceMaterial, HairMaterial, MeasuredMaterial, InterfaceMaterial,
                 BlendMaterial, MaskMaterial, TwoSidedMaterial, TabulatedMaterial, SlabMaterial,
                 FinishMaterial, GlazedMaterial>;
// It is copied, moved, destroyed and compared in scene/records/special_members.cpp alone: in every file that
// handles a scene, that took up to two thirds of its compiling.
struct MaterialModel : MaterialVariant {
  using MaterialVariant::MaterialVariant;
  MaterialModel();
  MaterialModel(const MaterialModel&);
  MaterialModel(MaterialModel&&) noexcept;
  MaterialModel& operator=(const MaterialModel&);
  MaterialModel& operator=(MaterialModel&&) noexcept;
  ~MaterialModel();
  bool operator==(const MaterialModel&) const;
};

// It is a material with its name and what holds for all kinds.
struct Material {
  MaterialModel model;
  // It says whether an opaque surface scatters on its back as on its front (pbrt), or is black there
  // (Mitsuba's bare ones). It means nothing for models that transmit.
  bool two_sided = true;
  bool casts_shadow = true;  // false: connections to lights pass what is of it (but not as a part of others)
  std::optional<FloatParameter> displacement;  // bump map: a height in scene units that only tilts normals
  std::optional<Id<Texture>> normal_map;       // tangent-space normals, (rgb·2 − 1)
  bool bump_shadowing = false;                 // the two darken what they turn from the surface's normal
  std::string name;                            // "" where the file gives none
  Origin origin;
  bool operator==(const Material&) const = default;
};

}  // namespace vitrail
