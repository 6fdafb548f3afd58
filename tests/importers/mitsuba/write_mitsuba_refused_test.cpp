// SPDX-License-Identifier: Apache-2.0
// What Mitsuba 3.9.1 would refuse or cut is written otherwise.
#include "images/image_files.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_spectra.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"

namespace vitrail::write_mitsuba_refused_test {
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

// A cube of OBJ with smooth edges.
TEST_F(RefusedByMitsuba, NormalsThatLeanFarAreReported) {
  Scene scene = square_scene({}, true);
  write(scene);
  EXPECT_THAT(diagnostics_, testing::Not(approximates("lean by more than 45°")));
  scene.meshes[0].normals[2] = {0, 1, 0.5f};
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("lean by more than 45°"));
}

// Light of one spectrum on a surface of another is no product of three numbers.
TEST_F(RefusedByMitsuba, ProductsOfSpectraInRgbVariantsAreReported) {
  Scene scene = square_scene({});
  std::get<DiffuseMaterial>(scene.materials[0].model).reflectance =
      Spectrum{tabulate({{360, .05}, {580, .05}, {600, .8}, {830, .8}}, true)};
  scene.lights = {Light{InfiniteLight{Spectrum{emission_from_rgb({1, 1, 1})}}}};
  write(scene);
  EXPECT_THAT(diagnostics_, testing::Not(approximates("multiply three numbers")));
  scene.lights = {
      Light{InfiniteLight{Spectrum{tabulate({{400, 0}, {500, 8}, {600, 15.6}, {700, 18.4}}, true)}}}};
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("multiply three numbers"));
}

// A ball of pbrt's rgb [.5 2 4] is up to 32 % too bright in scalar_rgb, which weakens three numbers.
TEST_F(RefusedByMitsuba, ColouredExtinctionsInRgbVariantsAreReported) {
  const auto notes = [&](const Spectrum& extinction) {
    Scene scene = square_scene({});
    scene.media = {Medium{}};
    scene.media[0].coefficients = ExtinctionAlbedo{extinction, ConstantSpectrum{0}};
    scene.shapes[0].interior = Id<Medium>{0};
    write(scene);
    return diagnostics_;
  };
  EXPECT_THAT(notes(unbounded_from_rgb({.5, 2, 4})),
              approximates("white light that comes to a tenth comes to"));
  EXPECT_THAT(notes(unbounded_from_rgb({2, 2, 2})), testing::Not(approximates("comes to a tenth")));
  EXPECT_THAT(notes(ConstantSpectrum{2}), testing::Not(approximates("comes to a tenth")));
}

// Mitsuba's rgb variants know no scale of a d65, and its spectral ones cut the colours of a bitmap at 1.
class LampsImages : public RefusedByMitsuba {
 protected:
  static constexpr float scale = 2.5f;
  Scene lamp(std::vector<float> values, int channels) {
    Image image = black_image(2, 1, channels);
    image.values = std::move(values);
    write_exr_image(folder_ / "slide.exr", image);
    Scene scene = square_scene({});
    ImageTexture texture;
    texture.filename = (folder_ / "slide.exr").string();
    scene.area_lights = {AreaLight{add_to(scene.textures, Texture{texture, false, "", {}}), scale}};
    scene.shapes[0].area_light = Id<AreaLight>{0};
    return scene;
  }
  pugi::xml_node radiance(const Scene& scene) {
    return write(scene).child("shape").child("emitter").child("texture");
  }
  std::vector<float> floats_of_grid(pugi::xml_node volume) {
    std::ifstream file(folder_ / value(volume, "filename"), std::ios::binary);
    file.seekg(48);
    std::vector<float> values(6);
    file.read(reinterpret_cast<char*>(values.data()), 24);
    return values;
  }
};

TEST_F(LampsImages, OfColoursAboveOneAreGridsOfOneLayer) {
  Scene scene = lamp({.8f, .4f, .2f, .1f, .4f, 1}, 3);
  scene.shapes[0].object_to_world = translate({1, 2, 3}) * vitrail::scale({2, 2, 2});
  const pugi::xml_node d65 = radiance(scene), volume = d65.child("texture").child("volume");
  EXPECT_STREQ(d65.attribute("type").value(), "d65");
  EXPECT_EQ(value(d65, "scale"), "");
  EXPECT_THAT(floats_of_grid(volume),
              testing::Pointwise(testing::FloatNear(1e-6f), {2.f, 1.f, .5f, .25f, 1.f, 2.5f}));
  // The square's corner (−1, −1), u = v = 0, is at (−1, 0, 3), and the opposite one at (3, 4, 3).
  std::array<double, 16> m{};
  std::istringstream numbers(volume.child("transform").child("matrix").attribute("value").value());
  for (double& x : m) numbers >> x;
  EXPECT_NEAR(m[0], 4, 1e-6);
  EXPECT_NEAR(m[5], 4, 1e-6);
  EXPECT_NEAR(m[3], -1, 1e-6);
  EXPECT_NEAR(m[7], 0, 1e-6);
  EXPECT_THAT(diagnostics_, testing::ElementsAre(testing::Field(
                                &Diagnostic::message, testing::HasSubstr("other spectra of the same"))));
  const Scene again = read_mitsuba(folder_ / "scene.xml").scene;
  const auto& texture = again.textures.at(std::get<Id<Texture>>(again.area_lights.at(0).radiance).value);
  const auto& picture = std::get<ImageTexture>(texture.model);
  const auto& plane = std::get<PlanarMapping>(picture.mapping);
  EXPECT_NEAR(transform_point(inverse(plane.texture_to_world), {1, 3, 3}).x, .5, 1e-6);
  EXPECT_NEAR(transform_point(inverse(plane.texture_to_world), {1, 3, 3}).y, .75, 1e-6);
  EXPECT_EQ(read_stored_image(picture.filename).image.values.at(0), 2);
  write_mitsuba(again, folder_ / "again.xml");
  std::ifstream file(folder_ / "again.xml");
  EXPECT_THAT(std::string(std::istreambuf_iterator<char>(file), {}), testing::HasSubstr("gridvolume"));
}

TEST_F(LampsImages, OfGreysOrBelowOneAreImagesTimesTheScale) {
  const auto values = [&](const Scene& scene) {
    const pugi::xml_node d65 = radiance(scene);
    EXPECT_EQ(value(d65, "scale"), "") << text_;
    return read_stored_image(folder_ / value(d65.child("texture"), "filename")).image.values;
  };
  EXPECT_EQ(values(lamp({.5f, 2}, 1)), (std::vector<float>{1.25f, 5}));
  Scene dim = lamp({.5f, .25f, 0, .125f, 0, .25f}, 3);
  dim.area_lights[0].scale = .5f;
  EXPECT_EQ(values(dim), (std::vector<float>{.25f, .125f, 0, .0625f, 0, .125f}));
}

// As the two sides of a lamp are, and shapes of one material.
TEST_F(LampsImages, OfSeveralShapesAreWrittenOnce) {
  for (const bool coloured : {true, false}) {
    Scene scene = coloured ? lamp({.8f, .4f, .2f, .1f, .4f, 1}, 3) : lamp({.5f, 2}, 1);
    scene.area_lights[0].two_sided = true;
    scene.shapes.push_back(scene.shapes[0]);
    scene.shapes[1].object_to_world = translate({0, 0, 5});
    write(scene);
    const auto files_in = [&](const char* folder) {
      return std::filesystem::exists(folder_ / folder)
                 ? std::ranges::distance(std::filesystem::directory_iterator(folder_ / folder))
                 : 0;
    };
    EXPECT_EQ(files_in("scene-images"), 1) << text_;
    EXPECT_EQ(files_in("scene-volumes"), coloured ? 1 : 0) << text_;
    std::filesystem::remove_all(folder_ / "scene-images");
    std::filesystem::remove_all(folder_ / "scene-volumes");
  }
}

TEST_F(LampsImages, OnWhatIsNotFlatAreReported) {
  Scene scene = lamp({.8f, .4f, .2f, .1f, .4f, 1}, 3);
  scene.meshes[0].uvs[2] = {0.5f, 1};
  radiance(scene);
  EXPECT_THAT(diagnostics_, approximates("there it is 1/2.5 as bright"));
}

}  // namespace
}  // namespace vitrail::write_mitsuba_refused_test
