// SPDX-License-Identifier: Apache-2.0
// What scene/records/material_traits.h says of a material, against what its model of scattering does.
#include "scene/records/material_traits.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "scene/records/kinds.h"
#include "tracer/sampling/sampler.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/surfaces/surface_materials.h"

namespace vitrail::material_traits_test {
namespace {

MeasuredSheet clear_sheet() {
  return {{400, 700}, {0.1f, 1}, {0.3f, 0.1f, 0.3f, 0.1f}, {0.6f, 0.8f, 0.6f, 0.8f}};
}

// Every kind that is rendered by itself, from a kind's defaults on.
std::vector<MaterialModel> models() {
  PrincipledMaterial glassy, sheet;
  glassy.spec_trans = 0.5f, sheet.thin = true, sheet.diff_trans = 1.0f;
  HairMaterial hair;
  hair.sigma_a = SpectrumParameter{ConstantSpectrum{1}};
  SlabMaterial slab;
  slab.sigma_s = ConstantSpectrum{1};
  const Roughness rough{.alpha_u = 0.3f, .alpha_v = 0.3f};
  const NormalReflectance silver{ConstantSpectrum{0.9f}};
  PlasticMaterial rough_plastic;
  rough_plastic.roughness = rough;
  PlasticMaterial odd_plastic;  // isotropic, whatever its record says across
  odd_plastic.roughness = {.alpha_u = 0.0f, .alpha_v = 0.2f};
  CoatedDiffuseMaterial rough_coat;
  rough_coat.roughness = rough;
  return {DiffuseMaterial{},
          DielectricMaterial{},
          DielectricMaterial{.roughness = rough},
          ThinDielectricMaterial{},
          ConductorMaterial{.metal = silver},
          ConductorMaterial{.metal = silver, .roughness = rough},
          PlasticMaterial{},
          rough_plastic,
          odd_plastic,
          CoatedDiffuseMaterial{},
          rough_coat,
          CoatedConductorMaterial{.metal = silver},
          CoatedConductorMaterial{.metal = silver, .conductor_roughness = rough},
          CoatedConductorMaterial{.metal = silver, .interface_roughness = rough},
          DiffuseTransmissionMaterial{},
          PrincipledMaterial{},
          glassy,
          sheet,
          hair,
          MeasuredMaterial{"", clear_sheet()},
          slab};
}

struct Seen {
  bool through = false, straight = false, specular = false, spread = false;
};

Seen seen_of(const MaterialModel& model) {
  Manifest manifest;
  manifest.materials = {Material{model}};
  const Textures textures(manifest.textures, std::filesystem::temp_directory_path(), 1 << 20);
  const Materials materials(manifest, textures);
  Interaction at;
  at.geometric = at.shading = {0, 0, 1};
  at.dpdu = {1, 0, 0}, at.dpdv = {0, 1, 0};
  at.out = normalize(Vector3d{0.3, 0.2, 1});
  at.front = true;
  const SampledWavelengths wavelengths = sample_wavelengths(0.3f);
  RandomStream random(5);
  Seen seen;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const Scattering scattering =
        materials.scattering_at(manifest.materials[0], at, wavelengths, filled(1), i);
    const auto number = [&] { return std::min(static_cast<float>(random.next()), 0x1.fffffep-1f); };
    const Vector3d out = scattering.frame.to_local(at.out);
    const auto s = sample(scattering.bsdf, out, number(), {number(), number()});
    if (!s) continue;
    const bool straight = length(s->in + out) < 1e-6;
    seen.through |= s->in.z * out.z < 0;
    seen.straight |= straight;
    seen.specular |= s->specular && !straight;
    seen.spread |= !s->specular;
  }
  return seen;
}

TEST(MaterialTraits, AreWhatTheModelDoes) {
  for (const MaterialModel& model : models()) {
    const MaterialTraits traits = traits_of(model);
    const Seen seen = seen_of(model);
    EXPECT_EQ(traits.transmits, seen.through) << kind_of(model);
    EXPECT_EQ(traits.straight, seen.straight) << kind_of(model);
    EXPECT_EQ(traits.lobes.smooth, seen.specular) << kind_of(model);
    EXPECT_EQ(traits.lobes.spread, seen.spread) << kind_of(model);
  }
}

TEST(MaterialTraits, OfWhatIsMadeOfOthers) {
  const auto blend = [](std::uint32_t a, std::uint32_t b) {
    return Material{BlendMaterial{Id<Material>{a}, Id<Material>{b}}};
  };
  const std::vector<Material> materials{Material{DiffuseMaterial{}},                    // 0
                                        Material{InterfaceMaterial{}},                  // 1
                                        Material{HairMaterial{}},                       // 2
                                        Material{MeasuredMaterial{"", clear_sheet()}},  // 3
                                        Material{MeasuredMaterial{"/a.table"}},  // 4: another program's
                                        blend(0, 1),                             // 5
                                        blend(2, 2),                             // 6
                                        blend(0, 2),                             // 7
                                        Material{MaskMaterial{0.5f, Id<Material>{2}}},                 // 8
                                        Material{TwoSidedMaterial{Id<Material>{3}, Id<Material>{0}}},  // 9
                                        Material{ConductorMaterial{}},                                 // 10
                                        blend(0, 10)};                                                 // 11
  const std::vector<MaterialTraits> traits = traits_of(materials);
  EXPECT_TRUE(traits[3].transmits && traits[3].straight && traits[3].mirrors && traits[3].counts);
  EXPECT_FALSE(traits[4].transmits || traits[4].straight);
  EXPECT_TRUE(traits[5].counts && traits[5].straight && traits[5].gathers) << "half of it is nothing";
  EXPECT_FALSE(traits[5].nothing);
  EXPECT_TRUE(traits[6].fibre);
  EXPECT_FALSE(traits[7].fibre) << "from behind there is the other half";
  EXPECT_TRUE(traits[8].fibre && traits[8].counts);
  EXPECT_TRUE(traits[9].transmits && traits[9].gathers);
  EXPECT_FALSE(traits[9].counts) << "it is its parts that count";
  EXPECT_TRUE(blends_mirror_with_spread(materials[11], traits));
  EXPECT_FALSE(blends_mirror_with_spread(materials[7], traits));
  EXPECT_FALSE(has_sides(materials[1], traits[1], {}));
  EXPECT_TRUE(has_sides(materials[3], traits[3], {}));
}

}  // namespace
}  // namespace vitrail::material_traits_test
