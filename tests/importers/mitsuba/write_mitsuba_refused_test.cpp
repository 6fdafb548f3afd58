// SPDX-License-Identifier: Apache-2.0
// What Mitsuba 3.9.1 would refuse or cut is written otherwise.
#include "importers/mitsuba/write/write_spectra.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"

namespace vitrail {
namespace {

class RefusedByMitsuba : public WriteMitsuba {};

// Mitsuba joins meshes of one bsdf, and refuses those of which one is turned.
TEST_F(RefusedByMitsuba, MeshesOfOneMaterialAreTurnedAlikeWhereNobodySeesIt) {
  Material material;
  for (const bool two_sided : {true, false}) {
    material.two_sided = two_sided;
    Scene scene = square_scene(material);
    scene.shapes.push_back(scene.shapes[0]);
    scene.shapes[1].flip_orientation = true;
    const auto root = write(scene);
    if (two_sided) {
      for (const auto shape : root.children("shape")) EXPECT_NE(value(shape, "flip_normals"), "true");
    }
    scene.shapes.erase(scene.shapes.begin());
    EXPECT_EQ(value(write(scene).child("shape"), "flip_normals"), "true") << "alone";
  }
}

// Where it shows, those that are turned have a bsdf of their own.
TEST_F(RefusedByMitsuba, MeshesThatFaceTheOtherWayHaveABsdfOfTheirOwn) {
  Material front, back;
  back.model = DiffuseMaterial{.reflectance = ConstantSpectrum{0.2f}};
  Scene scene = square_scene(front);
  scene.materials.push_back(back);
  Material sided;
  sided.model = TwoSidedMaterial{Id<Material>{0}, Id<Material>{1}};
  sided.name = "sided";
  scene.materials.push_back(sided);
  scene.shapes[0].material = Id<Material>{2};
  scene.shapes.resize(4, scene.shapes[0]);
  scene.shapes[1].flip_orientation = scene.shapes[3].flip_orientation = true;
  const auto root = write(scene);
  std::vector<std::string> bsdfs, turned;
  for (const auto shape : root.children("shape")) {
    bsdfs.push_back(reference(shape, "bsdf"));
    turned.push_back(value(shape, "flip_normals"));
  }
  EXPECT_THAT(turned, testing::ElementsAre("false", "true", "false", "true"));
  EXPECT_THAT(bsdfs, testing::ElementsAre("sided", "sided-turned", "sided", "sided-turned"));
  const auto bsdf = [&](const char* id) { return root.find_child_by_attribute("bsdf", "id", id); };
  EXPECT_STREQ(bsdf("sided-turned").attribute("type").value(), "mask") << "of copies Mitsuba makes one";
  EXPECT_EQ(value(bsdf("sided-turned"), "opacity"), "1");
  EXPECT_STREQ(bsdf("sided-turned").child("ref").attribute("id").value(), "sided");
}

// Mitsuba 3.9.1 refuses rough interfaces between equal indices, and has no brass.
TEST_F(RefusedByMitsuba, WhatMitsubaRefusesIsWrittenOtherwise) {
  const Roughness rough{0.3f, 0.3f};
  const auto bsdf = [&](MaterialModel model) {
    Material material;
    material.model = std::move(model);
    auto written = write(square_scene(material)).child("bsdf");
    return written.child("bsdf") ? written.child("bsdf") : written;
  };
  const auto type = [&](MaterialModel model) {
    return std::string(bsdf(std::move(model)).attribute("type").value());
  };
  DielectricMaterial water{
      .eta = ConstantSpectrum{1.33f}, .exterior_eta = ConstantSpectrum{1.33f}, .roughness = rough};
  EXPECT_EQ(type(water), "thindielectric");
  water.exterior_eta = ConstantSpectrum{1.0f};
  EXPECT_EQ(type(water), "roughdielectric");
  PlasticMaterial plastic{.eta = 1.2f, .exterior_eta = 1.2f, .roughness = rough};
  EXPECT_EQ(type(plastic), "diffuse");
  plastic.exterior_eta = 1;
  EXPECT_EQ(type(plastic), "roughplastic");
  for (const std::string metal : {"Cu", "CuZn"}) {
    const ComplexIndex index{Spectrum{NamedSpectrum{"metal-" + metal + "-eta"}},
                             Spectrum{NamedSpectrum{"metal-" + metal + "-k"}}};
    EXPECT_EQ(value(bsdf(ConductorMaterial{.metal = index}), "material").empty(), metal == "CuZn") << metal;
  }
}

// Mitsuba's rgb variants cut spectra at 1.
TEST_F(RefusedByMitsuba, ExtinctionsAboveOneAreScaled) {
  Scene scene = square_scene({});
  Medium medium;
  medium.coefficients =
      ExtinctionAlbedo{Spectrum{mitsuba_writer::tabulated([](double lambda) { return lambda / 100; })}};
  medium.scale = 3;
  scene.media = {medium};
  scene.shapes[0].exterior = Id<Medium>{0};
  const auto written = write(scene).child("medium");
  EXPECT_NEAR(std::stod(value(written, "scale")), 3 * 8.3, 1e-5);
  const std::string values = value(written, "sigma_t");  // 360:0.4337…, … 830:1
  EXPECT_NEAR(std::stod(values.substr(values.rfind(':') + 1)), 1, 1e-6);
  EXPECT_NEAR(std::stod(values.substr(values.find(':') + 1)), 3.6 / 8.3, 1e-6);
}

// volpath samples one wavelength's free flights: of an extinction that ends within the visible it lost 4 %.
TEST_F(RefusedByMitsuba, ColouredExtinctionsHaveTheirIntegrator) {
  const auto integrator = [&](VolumeParameter sigma_t) {
    Scene scene = square_scene({});
    Medium medium;
    medium.coefficients = ExtinctionAlbedo{std::move(sigma_t)};
    scene.media = {medium};
    scene.shapes[0].exterior = Id<Medium>{0};
    return std::string(write(scene).child("integrator").attribute("type").value());
  };
  Grid grid{.nx = 1, .ny = 1, .nz = 1, .channels = 1, .values = {2}};
  EXPECT_EQ(integrator(Spectrum{ConstantSpectrum{3}}), "volpath");
  EXPECT_EQ(integrator(grid), "volpath");
  EXPECT_EQ(integrator(tabulate({{400, .5}, {600, .9}}, false)), "volpathmis");
  grid.channels = 3, grid.values = {1, 2, 3};
  EXPECT_EQ(integrator(grid), "volpathmis");
}

// A component of their colour may be above 1 where no sample is, and one below 0 is 0: no light scatters.
TEST_F(RefusedByMitsuba, ColoursOfExtinctionsInRgbVariants) {
  const auto medium_of = [&](std::vector<SpectrumSample> samples, float albedo = 0.5f) {
    Scene scene = square_scene({});
    Medium medium;
    medium.coefficients =
        ExtinctionAlbedo{Spectrum{tabulate(samples, true)}, Spectrum{ConstantSpectrum{albedo}}};
    scene.media = {medium};
    scene.shapes[0].exterior = Id<Medium>{0};
    return write(scene).child("medium");
  };
  EXPECT_EQ(value(medium_of({{360, .5}, {830, 1}}), "scale"), "1");
  EXPECT_THAT(diagnostics_, testing::IsEmpty());
  EXPECT_GT(std::stod(value(medium_of({{560, .1}, {580, 1}}), "scale")), 1.05);
  EXPECT_THAT(diagnostics_, testing::Not(approximates("outside of sRGB")));
  medium_of({{590, .01}, {600, 1}}, 0);
  EXPECT_THAT(diagnostics_, testing::Not(approximates("outside of sRGB"))) << "nothing is to scatter";
  medium_of({{590, .01}, {600, 1}});
  EXPECT_THAT(diagnostics_, approximates("outside of sRGB"));
}

// Mitsuba's spectral variants make NaN of an extinction that is 0 at some wavelengths.
TEST_F(RefusedByMitsuba, ExtinctionsOfLinesAreNowhereZero) {
  Scene scene = square_scene({});
  Medium medium;
  medium.coefficients = AbsorptionScattering{tabulate({{500, .1}}, false), ConstantSpectrum{0}};
  scene.media = {medium};
  scene.shapes[0].exterior = Id<Medium>{0};
  const std::string values = value(write(scene).child("medium"), "sigma_t");  // 360:1e-10, … 830:1e-10
  for (std::size_t at = values.find(':'); at != values.npos; at = values.find(':', at + 1)) {
    const double sigma_t = std::stod(values.substr(at + 1));
    EXPECT_GT(sigma_t, 0) << values;
    EXPECT_TRUE(sigma_t > .09 || sigma_t < 1e-9) << values;
  }
}

// Nor has it a number for a metal of index 0 + 0i, which is what lies outside of samples.
TEST_F(RefusedByMitsuba, IndicesOfMetalsAreNowhereNothing) {
  ConductorMaterial metal;
  metal.metal =
      ComplexIndex{tabulate({{400, 1.2}, {700, .2}}, false), tabulate({{400, 2}, {700, 3.5}}, false)};
  Material material{metal};
  material.two_sided = false;
  const std::string values = value(write(square_scene(material)).child("bsdf"), "eta");
  EXPECT_TRUE(values.starts_with("360:")) << values;
  for (std::size_t at = values.find(':'); at != values.npos; at = values.find(':', at + 1))
    EXPECT_GT(std::stod(values.substr(at + 1)), 0) << values;
}

// Mitsuba's rgb variants know no scale of a d65: said of lamps, which have none of their own.
TEST_F(RefusedByMitsuba, ScalesOfLampsImages) {
  Scene scene = square_scene({});
  ImageTexture image;
  image.filename = (folder_ / "none.png").string();
  const Id<Texture> slide = add_to(scene.textures, Texture{image, false, "", {}});
  for (const float scale : {1.0f, 2.5f}) {
    scene.area_lights = {AreaLight{slide, scale}};
    scene.shapes[0].area_light = Id<AreaLight>{0};
    write(scene);
    const auto said = approximates("there it is 1/2.5 as bright");
    if (scale == 1) {
      EXPECT_THAT(diagnostics_, testing::Not(said));
    } else {
      EXPECT_THAT(diagnostics_, said);
    }
  }
}

}  // namespace
}  // namespace vitrail
