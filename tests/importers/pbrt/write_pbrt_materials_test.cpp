// SPDX-License-Identifier: Apache-2.0
// Materials and textures, there and back.
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_round_trip.h"

namespace vitrail::write_pbrt_materials_test {
namespace {

TEST(WritePbrt, Materials) {
  for (const char* material :
       {"Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]",
        "Material \"diffuse\" \"spectrum reflectance\" [400 .2 700 .8]",
        "Material \"diffuse\" \"float reflectance\" .3",
        "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"",
        "Material \"dielectric\" \"float eta\" 1.31 \"float uroughness\" .2 \"float vroughness\" .3",
        "Material \"thindielectric\" \"float eta\" 1.31", "Material \"conductor\" \"float roughness\" .1",
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"",
        "Material \"conductor\" \"rgb reflectance\" [.9 .8 .7]",
        "Material \"coateddiffuse\" \"rgb reflectance\" [.9 .8 .7] \"float thickness\" .3 \"rgb albedo\" [.1 "
        ".2 .3]",
        "Material \"coatedconductor\" \"float conductor.roughness\" .3 \"float interface.roughness\" .1",
        "Material \"diffusetransmission\" \"rgb transmittance\" [.1 .4 .3] \"float scale\" .7",
        "Material \"subsurface\" \"string name\" \"Skin1\"",
        "Material \"subsurface\" \"rgb sigma_a\" [.1 2 3]",
        "Material \"subsurface\" \"rgb mfp\" [1 2 3] \"rgb reflectance\" [.1 .2 .3]",
        "Material \"measured\" \"string filename\" \"paper.bsdf\"", "Material \"interface\"",
        "MakeNamedMaterial \"a \\\"b\\\"\" \"string type\" \"diffuse\" MakeNamedMaterial \"c\" \"string "
        "type\" \"conductor\" "
        "Material \"mix\" \"string materials\" [\"a \\\"b\\\"\" \"c\"] \"float amount\" .3",
        "Material \"diffuse\" \"string normalmap\" \"n.png\""})
    expect_exact_material(material);
}

// The rest of what it reflects is black.
TEST(WritePbrt, MetalsTimesAFactor) {
  const TemporaryFolder folder;
  Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + triangle)).scene;
  ConductorMaterial metal;
  metal.metal = ComplexIndex{NamedSpectrum{"metal-Au-eta"}, NamedSpectrum{"metal-Au-k"}};
  metal.roughness = {.alpha_u = 0.2f, .alpha_v = 0.2f, .masking = Masking::correlated};
  metal.reflectance_factor = reflectance_from_rgb({0.25, 0.25, 0.25});
  scene.materials = {{metal}};
  scene.materials[0].name = "gold";
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::IsEmpty());
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  const auto& blend = std::get<BlendMaterial>(again.materials[again.shapes[0].material.value].model);
  EXPECT_NEAR(std::get<float>(blend.amount), 0.25, 1e-6);
  EXPECT_EQ(again.materials[blend.first.value].model,
            MaterialModel(DiffuseMaterial{.reflectance = ConstantSpectrum{0}}));
  metal.reflectance_factor = ConstantSpectrum{1};
  EXPECT_EQ(again.materials[blend.second.value].model, MaterialModel(metal));
  metal.reflectance_factor = reflectance_from_rgb({0.25, 0.5, 0.25});
  scene.materials[0].model = metal;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "becomes grey"));
}

// e^{−σ · way} is what two faces leave, for the mean way of diffuse light through a ball, or across a plate.
// A single triangle encloses nothing.
TEST(WritePbrt, ColouredGlassAbsorbs) {
  const TemporaryFolder folder;
  const auto written = [&](const std::string& shape, const Spectrum& tint) {
    Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + shape)).scene;
    scene.materials = {{DielectricMaterial{.transmittance_factor = tint}}};
    scene.materials[0].name = "glass";
    Diagnostics said = write_pbrt(scene, folder / "out.pbrt");
    EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
    return std::pair{std::move(said), read_pbrt(folder / "out.pbrt").scene};
  };
  // From −1 to 1.
  const std::string cube =
      "Shape \"trianglemesh\" \"point3 P\" [-1 -1 -1 1 -1 -1 -1 1 -1 1 1 -1 -1 -1 1 1 -1 1 -1 1 1 1 1 1] "
      "\"integer indices\" [0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 3 5 3 7 5]";
  const std::string ball = "Shape \"sphere\" \"float radius\" 3";
  const Spectrum half = ConstantSpectrum{0.5f};
  const auto [said, scene] = written(ball, half);
  ASSERT_TRUE(scene.shapes.at(0).interior);
  const Medium& medium = scene.media.at(scene.shapes[0].interior->value);
  const auto& both = std::get<AbsorptionScattering>(medium.coefficients);
  double ball_way = 0, plate_way = 0;
  for (int i = 0; i < 1000; ++i) {
    const double cosine = std::sqrt(1 - (i + 0.5) / 1000 / (1.5 * 1.5));  // behind the surface
    ball_way += 2 * 3 * cosine / 1000;
    plate_way += 0.02 / cosine / 1000;
  }
  EXPECT_NEAR(std::exp(-ball_way * evaluate(std::get<Spectrum>(both.sigma_a), 550)), 0.25, 0.005);
  EXPECT_EQ(evaluate(std::get<Spectrum>(both.sigma_s), 550), 0);
  EXPECT_TRUE(mentions(said, "becomes absorption"));
  EXPECT_FALSE(mentions(said, "brighter"));
  const Scene plate = written("Scale 1 1 .01 " + cube, half).second;
  const Medium& thin = plate.media.at(plate.shapes.at(0).interior->value);
  const double sigma =
      evaluate(std::get<Spectrum>(std::get<AbsorptionScattering>(thin.coefficients).sigma_a), 550);
  EXPECT_NEAR(std::exp(-plate_way * sigma), 0.25, 0.01) << "but for its rim";
  const Scene inwards = written("ReverseOrientation Scale 1 1 .01 " + cube, half).second;
  EXPECT_FALSE(inwards.shapes.at(0).interior);
  const auto [open, plain] = written(triangle, half);
  EXPECT_FALSE(plain.shapes.at(0).interior);
  EXPECT_TRUE(mentions(open, "brighter by about 300 %"));
  EXPECT_THAT(written(ball, ConstantSpectrum{1}).first, testing::IsEmpty());
}

// Mitsuba's facets are darker.
TEST(WritePbrt, MaskingThatPbrtDoesNotHaveIsSaid) {
  const TemporaryFolder folder;
  Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + triangle)).scene;
  DielectricMaterial glass;
  scene.materials = {{glass}};
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::IsEmpty()) << "smooth";
  glass.roughness = {0.2f, 0.2f};
  scene.materials = {{glass}};
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "masking of its facets"));
}

TEST(WritePbrt, NamesOfMaterialsSurvive) {
  const RoundTrip trip = round_trip(
      "Film \"rgb\" WorldBegin MakeNamedMaterial \"brick wall\" \"string type\" \"diffuse\" "
      "NamedMaterial \"brick wall\" " +
      triangle + "Material \"diffuse\" " + triangle);
  const Scene& scene = trip.second.scene;
  EXPECT_EQ(scene.materials.at(scene.shapes.at(0).material.value).name, "brick wall");
  EXPECT_NE(scene.materials.at(scene.shapes.at(1).material.value).name, "brick wall");
}

TEST(WritePbrt, Textures) {
  const std::string use = " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle;
  for (const char* texture :
       {"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"tex/a b.png\" \"float uscale\" 3.3 "
        "\"string "
        "encoding\" \"gamma 1.9\"",
        "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3] \"float vdelta\" .1",
        "Rotate 30 1 2 3 Texture \"t\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3",
        "Translate 1 2 3 Texture \"t\" \"spectrum\" \"marble\" \"float variation\" .3 Identity",
        "Scale 3 3 3 Texture \"t\" \"spectrum\" \"bilerp\" \"string mapping\" \"spherical\" \"rgb v00\" [1 0 "
        "0]",
        "Texture \"t\" \"spectrum\" \"dots\" \"string mapping\" \"planar\" \"vector3 v1\" [1 2 3] \"float "
        "udelta\" .7",
        "Texture \"f\" \"float\" \"fbm\" Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [.3 .2 .1] "
        "\"texture "
        "amount\" \"f\"",
        "Texture \"f\" \"float\" \"wrinkled\" Texture \"f\" \"float\" \"scale\" \"texture tex\" \"f\" "
        "\"float scale\" 2 "
        "Texture \"t\" \"spectrum\" \"scale\" \"rgb tex\" [.3 .2 .1] \"texture scale\" \"f\"",
        "Texture \"t\" \"spectrum\" \"directionmix\" \"vector3 dir\" [1 2 3]",
        "Texture \"t\" \"spectrum\" \"ptex\" \"string filename\" \"a.ptx\""})
    expect_exact_world(texture + use);
  expect_exact_material(
      "Texture \"r\" \"float\" \"imagemap\" \"string filename\" \"r.png\" Material \"conductor\" \"texture "
      "uroughness\" \"r\" \"float vroughness\" .25 \"texture displacement\" \"r\"");
}

// What masks take away is the alpha of the shape, wherever they stand.
class WrittenMasks : public testing::Test {
 protected:
  Id<Material> add(MaterialModel model) {
    scene_.materials.push_back(Material{std::move(model)});
    return {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  }
  Id<Texture> add_board() {
    scene_.textures.push_back({CheckerboardTexture{ConstantSpectrum{1}, ConstantSpectrum{0}}, true, "", {}});
    return {static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  }
  // As it is read again.
  Shape written(Id<Material> material) {
    scene_.shapes[0].material = material;
    diagnostics_ = write_pbrt(scene_, folder_ / "out.pbrt");
    std::ifstream file(folder_ / "out.pbrt");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    again_ = read_pbrt(folder_ / "out.pbrt").scene;
    return again_.shapes.at(0);
  }
  template <class Model>
  Model model_of(const Shape& shape) {
    return std::get<Model>(again_.materials.at(shape.material.value).model);
  }
  int mixes() const {
    int count = 0;
    for (auto at = text_.find("\"mix\""); at != std::string::npos; at = text_.find("\"mix\"", at + 1))
      ++count;
    return count;
  }
  float constant_opacity(const Shape& shape) { return std::get<float>(shape.opacity); }

  TemporaryFolder folder_;
  Scene scene_ = import_v4(triangle).scene, again_;
  Diagnostics diagnostics_;
  std::string text_;
  const Id<Material> dark_ = add(DiffuseMaterial{ConstantSpectrum{0.25f}}),
                     bright_ = add(DiffuseMaterial{ConstantSpectrum{0.75f}}),
                     half_ = add(MaskMaterial{0.5f, dark_});
};

TEST_F(WrittenMasks, WithinBlends) {
  scene_.settings.straight_counts = false;
  const Shape half = written(half_);
  EXPECT_EQ(constant_opacity(half), 0.5f);
  EXPECT_EQ(model_of<DiffuseMaterial>(half).reflectance, SpectrumParameter{ConstantSpectrum{0.25f}});
  EXPECT_TRUE(diagnostics_.empty());

  // ¾·½ of the dark one and ¼ of the bright one are there: 5/8, of which 2/5 are bright.
  const Shape blend = written(add(BlendMaterial{half_, bright_, 0.25f}));
  EXPECT_FLOAT_EQ(constant_opacity(blend), 0.625f);
  EXPECT_FLOAT_EQ(std::get<float>(model_of<BlendMaterial>(blend).amount), 0.4f);
  EXPECT_TRUE(diagnostics_.empty());

  // A texture that chooses between something and nothing is an alpha.
  const Id<Texture> board = add_board();
  const Id<Material> nothing = add(InterfaceMaterial{});
  const Shape cut = written(add(BlendMaterial{nothing, dark_, board}));
  EXPECT_EQ(model_of<DiffuseMaterial>(cut).reflectance, SpectrumParameter{ConstantSpectrum{0.25f}});
  EXPECT_EQ(cut.opacity, FloatParameter{board});
  EXPECT_TRUE(diagnostics_.empty());
  EXPECT_EQ(mixes(), 1) << "that of the first blend: pbrt refuses a mix with an interface";

  written(add(BlendMaterial{half_, bright_, board}));
  EXPECT_TRUE(mentions(diagnostics_, "masks within a blend by textures"));
}

TEST_F(WrittenMasks, TimesTheShapesOwnOpacity) {
  scene_.shapes[0].opacity = 0.5f;
  EXPECT_EQ(constant_opacity(written(half_)), 0.25f);
  scene_.shapes[0].opacity = add_board();
  const Shape both = written(half_);
  const auto& product =
      std::get<ProductTexture>(again_.textures.at(std::get<Id<Texture>>(both.opacity).value).model);
  EXPECT_EQ(product.second, SpectrumParameter{ConstantSpectrum{0.5f}});
}

TEST_F(WrittenMasks, CountForNoDepthInPbrt) {
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "the depth"));
  scene_.settings.max_depth = unlimited_depth;
  written(half_);
  EXPECT_FALSE(mentions(diagnostics_, "the depth"));
  scene_.settings.max_depth = 5;
  scene_.settings.straight_counts = false;
  written(half_);
  EXPECT_FALSE(mentions(diagnostics_, "the depth"));
  add(ThinDielectricMaterial{});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "going straight through thin sheets"));
  EXPECT_FALSE(mentions(diagnostics_, "without extent"));
  scene_.lights.push_back({PointLight{}, {}});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "lights without extent do not shine through thin sheets"));
}

TEST_F(WrittenMasks, BlendsWithNothingCountForNoDepthInPbrt) {
  scene_.materials.at(half_.value).model = DiffuseMaterial{};
  const Id<Material> nothing = add(InterfaceMaterial{});
  const Shape blend = written(add(BlendMaterial{nothing, dark_, 0.5f}));
  EXPECT_EQ(constant_opacity(blend), 0.5f);
  EXPECT_TRUE(mentions(diagnostics_, "the depth"));
}

// A mask leaves the light of a surface alone, an alpha does not; and pbrt drops the lights of interfaces.
TEST_F(WrittenMasks, OfWhatShines) {
  scene_.settings.max_depth = unlimited_depth;
  scene_.settings.straight_counts = false;
  scene_.area_lights.push_back({ConstantSpectrum{1}});
  scene_.shapes[0].area_light = Id<AreaLight>{0};
  const Shape nothing = written(add(InterfaceMaterial{}));
  EXPECT_EQ(constant_opacity(nothing), 1);
  EXPECT_TRUE(nothing.area_light);
  EXPECT_EQ(model_of<ThinDielectricMaterial>(nothing).eta, Spectrum{ConstantSpectrum{1}});
  const Shape half = written(half_);
  EXPECT_EQ(constant_opacity(half), 1);
  const auto mix = model_of<BlendMaterial>(half);
  EXPECT_EQ(mix.amount, FloatParameter{0.5f});
  EXPECT_TRUE(std::holds_alternative<ThinDielectricMaterial>(again_.materials.at(mix.first.value).model));
  EXPECT_TRUE(diagnostics_.empty());
  scene_.settings.max_depth = 5;
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "counts for the depth"));
  scene_.lights.push_back({PointLight{}, {}});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "lights without extent"));
}

TEST_F(WrittenMasks, BumpsOfWhatIsMadeOfOthersAreReported) {
  const Id<Material> blend = add(BlendMaterial{dark_, bright_, 0.25f});
  scene_.materials[blend.value].displacement = Id<Texture>{add_board()};
  written(blend);
  EXPECT_TRUE(mentions(diagnostics_, "bumps"));
  EXPECT_EQ(text_.find("displacement"), std::string::npos) << "pbrt refuses a mix with one";
}

TEST(WritePbrt, MaterialsHaveOnlyWhatPbrtTakesOfThem) {
  expect_reported(
      "Texture \"h\" \"float\" \"windy\" Material \"hair\" \"texture displacement\" \"h\" " + triangle,
      "bumps of hair");
  const RoundTrip wax =
      expect_reported("Material \"subsurface\" \"spectrum eta\" \"glass-BK7\" " + triangle, "dispersion");
  EXPECT_NEAR(evaluate(std::get<SubsurfaceMaterial>(wax.second.scene.materials.at(0).model).eta, 500), 1.5168,
              1e-3);
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
  PrincipledMaterial sheet;
  sheet.thin = true, sheet.spec_trans = 1.0f;
  scene.materials.at(0).model = sheet;
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "thin glass"));
  EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
}

// pbrt has noise of numbers and marble of colours: a colour by noise is a mix of black and white.
TEST(WritePbrt, NoiseIsOfTheKindThatPbrtHas) {
  expect_exact_material(
      "Texture \"w\" \"float\" \"windy\" Material \"conductor\" \"texture roughness\" \"w\"");
  for (const char* kind : {"fbm", "wrinkled", "windy"}) {
    const RoundTrip trip =
        round_trip("Film \"rgb\"\nWorldBegin\nTranslate 1 2 3 Texture \"t\" \"spectrum\" \"" +
                   std::string(kind) + "\" Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle);
    EXPECT_THAT(trip.written, testing::IsEmpty());
    EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
    const std::vector<Texture>& textures = trip.second.scene.textures;
    ASSERT_EQ(textures.size(), 2u);
    EXPECT_EQ(textures[0].model, trip.first.scene.textures.at(0).model) << kind;
    EXPECT_EQ(std::get<MixTexture>(textures[1].model).amount, FloatParameter{Id<Texture>{0}});
  }
  expect_reported(
      "Texture \"m\" \"float\" \"marble\" Material \"conductor\" \"texture roughness\" \"m\" " + triangle,
      "marble of numbers");
}

TEST(WritePbrt, TexturesHaveOnlyWhatPbrtTakesOfThem) {
  const std::string use = " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle;
  const RoundTrip bright =
      expect_reported("Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [3 2 1]" + use, "colours above 1");
  const auto& mix = std::get<MixTexture>(bright.second.scene.textures.at(0).model);
  EXPECT_NEAR(
      luminance(std::get<Spectrum>(mix.first)),
      luminance(std::get<Spectrum>(std::get<MixTexture>(bright.first.scene.textures.at(0).model).first)),
      1e-4);
  expect_reported(
      "Texture \"f\" \"spectrum\" \"dots\" Texture \"t\" \"spectrum\" \"bilerp\" \"texture v00\" \"f\"" + use,
      "corner");
}

}  // namespace
}  // namespace vitrail::write_pbrt_materials_test
