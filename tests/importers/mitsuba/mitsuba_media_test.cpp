// SPDX-License-Identifier: Apache-2.0
// Media from Mitsuba's, by definition and back from what write_mitsuba writes; volume files.
#include <gmock/gmock.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "importers/mitsuba/read/subsurface.h"
#include "importers/mitsuba/read/volume_file.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "scene/models/measured_media.h"
#include "tests/importers/mitsuba/mitsuba_objects.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::mitsuba::mitsuba_media_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A volume file of zeros.
std::string volume(std::array<std::int32_t, 4> counts, std::size_t values, std::int32_t encoding = 1,
                   const std::string& magic = "VOL\3") {
  const std::array<float, 6> bounds{-1, -2, -3, 1, 2, 3};
  std::string bytes = magic;
  const auto append = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  append(&encoding, 4);
  append(counts.data(), sizeof counts);
  append(bounds.data(), sizeof bounds);
  return bytes + std::string(values * 4, '\0');
}

class MitsubaMedia : public testing::Test {
 protected:
  void read(const Object& root) {
    TestBuilder test;
    test.scene.files = {(folder_ / "scene.xml").string()};
    read_all(test.builder, root);
    scene_ = test.scene;
    diagnostics_ = test.report.take();
  }
  Medium medium(const std::string& properties, const std::string& type = "homogeneous") {
    read(load_objects_of_text("<medium type='" + type + "' id='m'>" + properties + "</medium>"));
    return scene_.media.at(0);
  }
  Scene written_and_read(const Scene& scene) {
    write_mitsuba(scene, folder_ / "scene.xml");
    read(load_objects(folder_ / "scene.xml"));
    return scene_;
  }
  std::string grid(const std::string& name, const std::string& more = "") {
    return "<volume type='gridvolume' name='" + name + "'><string name='filename' value='a.vol'/>" + more +
           "</volume>";
  }
  static auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

  TemporaryFolder folder_;
  Scene scene_;
  Diagnostics diagnostics_;
};

// Surfaces that cut through a grid show its mean.
TEST_F(MitsubaMedia, VolumeTexturesAreTheirMean) {
  std::string bytes = volume({2, 1, 1, 1}, 2);
  const std::array<float, 2> cells{0.25f, 1};
  bytes.replace(48, sizeof cells, reinterpret_cast<const char*>(cells.data()), sizeof cells);
  folder_.write("a.vol", bytes);
  const auto texture = [&](const std::string& inside) {
    read(load_objects_of_text("<bsdf type='diffuse' id='m'><texture type='volume' name='reflectance'>" +
                              inside + "</texture></bsdf>"));
    return std::get<ProductTexture>(scene_.textures.at(0).model).first;
  };
  EXPECT_EQ(texture(grid("volume")), (SpectrumParameter{ConstantSpectrum{0.625f}}));
  EXPECT_THAT(diagnostics_, SizeIs(1));
  EXPECT_THAT(diagnostics_, says("from 0.25 to 1"));
  texture("<volume type='constvolume' name='volume'><rgb name='value' value='.1,.2,.3'/></volume>");
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaMedia, WrittenMediaComeBack) {
  Scene original = empty_scene();
  folder_.write("a.vol", volume({2, 3, 4, 1}, 24));
  folder_.write("b.vol", volume({2, 2, 1, 3}, 12));
  Medium fog{"fog",
             ExtinctionAlbedo{Spectrum{ConstantSpectrum{3}}, Spectrum{reflectance_from_rgb({0.1, 0.8, 0.3})}},
             2.5f};
  fog.g = -0.4f;
  Medium dust{
      "", ExtinctionAlbedo{Spectrum{unbounded_from_rgb({0.5, 0.25, 1})}, Spectrum{ConstantSpectrum{0.5f}}}};
  Medium cloud{"cloud", {}};
  Grid a, b;
  a.filename = (folder_ / "a.vol").string();
  a.nx = 2, a.ny = 3, a.nz = 4;
  b.filename = (folder_ / "b.vol").string();
  b.nx = 2, b.ny = 2, b.nz = 1, b.channels = 3, b.edge = GridEdge::repeated;
  cloud.coefficients = ExtinctionAlbedo{a, b};
  cloud.medium_to_world = translate({1, 2, 3}) * rotate(0.3, {1, 2, 0}) * scale({2, 3, 4});
  original.media = {fog, dust, cloud};
  EXPECT_EQ(written_and_read(original).media, original.media);
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaMedia, Defaults) {
  const Medium m = medium("");
  EXPECT_EQ(m, (Medium{"m", ExtinctionAlbedo{}}));
  EXPECT_FLOAT_EQ(medium("<phase type='hg'/>").g, 0.8f);  // Mitsuba 3.9.1
  EXPECT_EQ(medium("<phase type='isotropic'/>").g, 0);
}

// 0.6 looks at no capitals, and takes a hundred times what is measured per mm.
TEST_F(MitsubaMedia, MeasuredMediaOf06) {
  for (const auto& [word, name] : {std::pair{"skin1", "Skin1"}, {"Budweiser Beder", "Budweiser Beer"}}) {
    const auto coefficients =
        medium("<string name='material' value='" + std::string(word) + "'/>").coefficients;
    const auto &given = std::get<AbsorptionScattering>(coefficients), known = measured_medium(name).value();
    for (const double lambda : {450.0, 550.0, 650.0}) {
      const auto at = [&](const VolumeParameter& v) { return evaluate(std::get<Spectrum>(v), lambda); };
      EXPECT_NEAR(at(given.sigma_s), 100 * at(known.sigma_s), 1e-4 * at(given.sigma_s)) << word;
      EXPECT_NEAR(at(given.sigma_a), 100 * at(known.sigma_a), 1e-4 * at(given.sigma_a)) << word;
    }
  }
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_THROW(medium("<string name='material' value='skin3'/>"), Error);
}

TEST_F(MitsubaMedia, DiffusionBelowSurfacesOf06) {
  const auto read_dipole = [&](const std::string& inside, const std::string& plastic) {
    const Object root = load_objects_of_text("<shape type='sphere'><subsurface type='dipole'>" + inside +
                                             "<integer name='irr_samples' value='64'/></subsurface>"
                                             "<bsdf type='roughplastic'><float name='alpha' value='.2'/>" +
                                             plastic + "</bsdf></shape>");
    TestBuilder test;
    test.scene.files = {"scene.xml"};
    const Object& shape = *root.child("shape");
    const Id<Material> made =
        subsurface_material(test.builder, shape, add_material(test.builder, *shape.child("bsdf"))).value();
    diagnostics_ = test.report.take();
    return std::get<SubsurfaceMaterial>(test.scene.materials.at(made.value).model);
  };
  const std::string black = "<spectrum name='diffuse_reflectance' value='0'/>";
  const SubsurfaceMaterial given = read_dipole(
      "<float name='sigma_s' value='3'/><float name='sigma_a' value='.5'/><float name='g' value='.75'/>"
      "<float name='scale' value='7'/><float name='int_ior' value='1.5'/><float name='ext_ior' "
      "value='1.25'/>",
      black);
  EXPECT_EQ(given.interior, (decltype(SubsurfaceMaterial::interior){SubsurfaceMaterial::Coefficients{
                                Spectrum{ConstantSpectrum{.5f}}, Spectrum{ConstantSpectrum{.75f}}}}));
  EXPECT_EQ(given.eta, Spectrum{ConstantSpectrum{1.2f}});
  EXPECT_EQ(given.roughness.alpha_u, FloatParameter{.2f});
  EXPECT_EQ(given.scale, 7);
  EXPECT_THAT(diagnostics_, SizeIs(1));
  EXPECT_THAT(diagnostics_, says("every order of scattering"));
  const SubsurfaceMaterial marble = read_dipole("<string name='material' value='marble'/>", "");
  EXPECT_EQ(marble.eta, Spectrum{ConstantSpectrum{1.5f}});
  EXPECT_THAT(diagnostics_, says("becomes a dielectric boundary"));
  const SubsurfaceMaterial thick =
      read_dipole("<float name='sigma_t' value='4'/><float name='albedo' value='.25'/>", black);
  EXPECT_EQ(thick.interior, (decltype(SubsurfaceMaterial::interior){SubsurfaceMaterial::Coefficients{
                                Spectrum{ConstantSpectrum{3}}, Spectrum{ConstantSpectrum{1}}}}));
}

TEST_F(MitsubaMedia, OlderForms) {
  EXPECT_EQ(medium("<float name='sigma_a' value='2'/><float name='sigma_s' value='3'/>").coefficients,
            (decltype(Medium::coefficients){
                AbsorptionScattering{Spectrum{ConstantSpectrum{2}}, Spectrum{ConstantSpectrum{3}}}}));
  EXPECT_EQ(medium("<float name='sigma_a' value='2'/>").coefficients,
            (decltype(Medium::coefficients){
                AbsorptionScattering{Spectrum{ConstantSpectrum{2}}, Spectrum{ConstantSpectrum{1}}}}));
  EXPECT_EQ(medium("<volume type='constvolume' name='density'><float name='value' value='7'/></volume>",
                   "heterogeneous")
                .coefficients,
            (decltype(Medium::coefficients){ExtinctionAlbedo{Spectrum{ConstantSpectrum{7}}}}));
  EXPECT_THAT(diagnostics_, IsEmpty());
}

// As Mitsuba 3.9.1 shows them.
TEST_F(MitsubaMedia, WhatIsConstantInAHeterogeneousOneFillsTheUnitCube) {
  for (const char* extinction : {"", "<float name='sigma_t' value='2'/>"}) {
    const Medium filled = medium(extinction, "heterogeneous");
    EXPECT_EQ(std::get<Grid>(filled.density).bounds, (Bounds3d{{0, 0, 0}, {1, 1, 1}})) << extinction;
    EXPECT_EQ(filled.medium_to_world, Transform{});
  }
  EXPECT_FALSE(std::holds_alternative<Grid>(medium("", "homogeneous").density));
}

TEST_F(MitsubaMedia, GridsLieInTheUnitCubeOrTheirBox) {
  folder_.write("a.vol", volume({2, 3, 4, 1}, 24));
  const auto bounds = [&](const Medium& m) {
    return std::get<Grid>(std::get<ExtinctionAlbedo>(m.coefficients).sigma_t).bounds;
  };
  EXPECT_EQ(bounds(medium(grid("sigma_t"), "heterogeneous")), (Bounds3d{{0, 0, 0}, {1, 1, 1}}));
  const std::string box = "<boolean name='use_grid_bbox' value='true'/>";
  EXPECT_EQ(bounds(medium(grid("sigma_t", box), "heterogeneous")), (Bounds3d{{-1, -2, -3}, {1, 2, 3}}));
  medium(grid("sigma_t", "<boolean name='raw' value='true'/><boolean name='accel' value='false'/>"),
         "heterogeneous");
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(MitsubaMedia, TheSecondGridIsInTheFrameOfTheFirst) {
  folder_.write("a.vol", volume({2, 3, 4, 1}, 24));
  const auto frame = [](const std::string& matrix) {
    return "<transform name='to_world'><matrix value='" + matrix + "'/></transform>";
  };
  const Medium m = medium(grid("sigma_t", frame("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1")) +
                              grid("albedo", frame("4 0 0 2 0 4 0 4 0 0 4 0 0 0 0 1")),
                          "heterogeneous");
  const auto& c = std::get<ExtinctionAlbedo>(m.coefficients);
  EXPECT_EQ(std::get<Grid>(c.albedo).bounds, (Bounds3d{{1, 2, 0}, {3, 4, 2}}));
  EXPECT_EQ(m.medium_to_world, scale({2, 2, 2}));
  EXPECT_THAT(diagnostics_, IsEmpty());
  medium(grid("sigma_t") + grid("albedo", frame("0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1")), "heterogeneous");
  EXPECT_THAT(diagnostics_, says("turned against each other"));
}

TEST_F(MitsubaMedia, WhatIsNotExactIsSaid) {
  folder_.write("a.vol", volume({2, 3, 4, 1}, 24));
  medium("<phase type='rayleigh'/>");
  EXPECT_THAT(diagnostics_, says("\"rayleigh\" becomes isotropic"));
  const std::string lobes =
      "<phase type='hg'><float name='g' value='0.6'/></phase><phase type='hg'><float name='g' "
      "value='-0.4'/></phase>";
  EXPECT_NEAR(medium("<phase type='blendphase'><float name='weight' value='0.25'/>" + lobes + "</phase>").g,
              0.35, 1e-6);
  EXPECT_THAT(diagnostics_, says("of the same mean cosine, 0.35"));
  EXPECT_NEAR(
      medium("<phase type='mixturephase'><string name='weights' value='1, 3'/>" + lobes + "</phase>").g,
      -0.15, 1e-6);
  EXPECT_EQ(medium("<phase type='mixturephase'><string name='weights' value='0, 0'/>" + lobes + "</phase>").g,
            0);
  // 1 + μ: ∫μ(1 + μ) ÷ ∫(1 + μ) = 1/3
  EXPECT_NEAR(medium("<phase type='tabphase'><string name='values' value='0, 1, 2'/></phase>").g, 1.0 / 3,
              1e-6);
  medium("<phase type='isotropc'/>");
  EXPECT_THAT(diagnostics_, says("did you mean \"isotropic\""));
  medium("", "homogenous");
  EXPECT_THAT(diagnostics_, says("did you mean \"homogeneous\""));
  medium("<volume type='hgrid' name='sigma_t'/>", "heterogeneous");
  EXPECT_THAT(diagnostics_, says("volume \"hgrid\""));
  medium(grid("sigma_t",
              "<string name='wrap_mode' value='mirror'/><string name='filter_type' value='nearest'/>"),
         "heterogeneous");
  EXPECT_THAT(diagnostics_, SizeIs(2));
  EXPECT_THROW(medium("<phase type='hg'><float name='g' value='1'/></phase>"), Error);
  EXPECT_THROW(medium(grid("sigma_t", "<transform name='to_world'><scale x='0' y='1' z='1'/></transform>")),
               Error);
}

TEST_F(MitsubaMedia, WrongVolumeFilesAreErrors) {
  const std::string good = volume({2, 3, 4, 1}, 24);
  const std::int32_t most = std::numeric_limits<std::int32_t>::max();
  EXPECT_NO_THROW(read_volume_header(folder_.write("a.vol", good)));
  for (const std::string& bytes :
       {std::string(), good.substr(0, 47), volume({2, 3, 4, 1}, 23), volume({2, 3, 4, 1}, 24, 2),
        volume({2, 3, 4, 1}, 24, 1, "VOL\4"), volume({2, 3, 4, 1}, 24, 1, "vol\3"), volume({0, 3, 4, 1}, 24),
        volume({2, -3, -4, 1}, 24), volume({most, most, most, most}, 24),
        volume({most, most, most, 1}, 24)}) {
    folder_.write("a.vol", bytes);
    try {
      medium(grid("sigma_t"), "heterogeneous");
      ADD_FAILURE() << bytes.size();
    } catch (const Error& error) {
      EXPECT_GT(error.location.column, 0);
      EXPECT_THAT(error.what(), HasSubstr("a.vol"));
    }
  }
  std::string infinite = good;
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(infinite.data() + 24, &infinity, 4);
  EXPECT_THROW(read_volume_header(folder_.write("a.vol", infinite)), std::runtime_error);
}

}  // namespace
}  // namespace vitrail::mitsuba::mitsuba_media_test
