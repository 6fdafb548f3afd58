// SPDX-License-Identifier: Apache-2.0
// Materials, textures and light of glTF.
#include <cmath>
#include <numbers>

#include "images/file_part.h"
#include "images/image_files.h"
#include "importers/gltf/units.h"
#include "importers/writing/export_colors.h"
#include "scene/models/normal_map.h"
#include "scene/spectra/spectrum.h"
#include "tests/importers/gltf/gltf_text.h"
#include "tests/support/png.h"

namespace vitrail::test::gltf_materials_test {
namespace {

const MaterialModel& model_of(const ImportedScene& imported) { return imported.scene.materials.at(0).model; }

TEST(GltfMaterials, MetallicRoughnessIsPrincipled) {
  const ImportedScene imported = square_of(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"metallicFactor":0.75,"roughnessFactor":0.5},"extensions":{"KHR_materials_ior":{"ior":1.25}}})");
  const auto& m = std::get<PrincipledMaterial>(model_of(imported));
  EXPECT_EQ(m.metallic, FloatParameter{0.75f});
  EXPECT_EQ(m.roughness, FloatParameter{0.5f});
  EXPECT_EQ(m.eta, 1.25f);
  EXPECT_TRUE(m.below);
  EXPECT_EQ(std::get<SigmoidSpectrum>(std::get<Spectrum>(m.base_color)).rgb,
            (std::array<float, 3>{1, 0.5f, 0.25f}));
}

TEST(GltfMaterials, WithoutReflectionTheyAreLambert) {
  const ImportedScene imported = square_of(
      R"({"pbrMetallicRoughness":{"metallicFactor":0},"extensions":{"KHR_materials_specular":{"specularFactor":0}}})");
  EXPECT_TRUE(std::holds_alternative<DiffuseMaterial>(model_of(imported)));
}

TEST(GltfMaterials, GlassIsASheetOrASolidThatAbsorbs) {
  const std::string transmission =
      R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1})";
  EXPECT_TRUE(std::holds_alternative<ThinDielectricMaterial>(model_of(square_of("{" + transmission + "}}"))));
  const ImportedScene solid = square_of(
      "{" + transmission +
      R"(,"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[0.25,0.25,0.25]}}})");
  EXPECT_TRUE(std::holds_alternative<DielectricMaterial>(model_of(solid)));
  ASSERT_TRUE(solid.scene.shapes.at(0).interior);
  const auto& c = std::get<AbsorptionScattering>(solid.scene.media.at(0).coefficients);
  EXPECT_NEAR(evaluate(std::get<Spectrum>(c.sigma_a), 550), std::log(4) / 2, 1e-6)
      << "a quarter is left of 2";
}

// attenuationColor is what is left at attenuationDistance, and its square at twice that.
TEST(GltfMaterials, AttenuationLeavesItsColourAtItsDistance) {
  const ImportedScene solid = square_of(
      R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},)"
      R"("KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[0.9,0.3,0.1]}}})");
  const Spectrum sigma =
      std::get<Spectrum>(std::get<AbsorptionScattering>(solid.scene.media.at(0).coefficients).sigma_a);
  std::vector<SpectrumSample> left;
  for (int i = 0; i < table_size; ++i) {
    const double nm = lambda_min_nm + i;
    EXPECT_GE(evaluate(sigma, nm), 0) << nm;
    left.push_back({nm, std::exp(-2 * evaluate(sigma, nm))});
  }
  const RGB color = factor_rgb(tabulate(left, true));
  EXPECT_NEAR(color.r, 0.9, 0.002);
  EXPECT_NEAR(color.g, 0.3, 0.002);
  EXPECT_NEAR(color.b, 0.1, 0.002);
}

TEST(GltfMaterials, RequiredVariantsAreToldAndLeftOut) {
  const ImportedScene imported = square_of(
      "{}", R"(,"extensionsUsed":["KHR_materials_variants"],"extensionsRequired":["KHR_materials_variants"],)"
            R"("extensions":{"KHR_materials_variants":{"variants":[{"name":"a"},{"name":"b"}]}})");
  EXPECT_EQ(imported.scene.shapes.size(), 1u);
  EXPECT_TRUE(mentions(imported.diagnostics, "2 variants"));
}

TEST(GltfMaterials, DispersionHasItsAbbeNumber) {
  const ImportedScene imported = square_of(
      R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},)"
      R"("KHR_materials_volume":{"thicknessFactor":1},"KHR_materials_ior":{"ior":1.5},"KHR_materials_dispersion":{"dispersion":0.4}}})");
  const Spectrum& eta = std::get<DielectricMaterial>(model_of(imported)).eta;
  const double abbe = (evaluate(eta, 587.6) - 1) / (evaluate(eta, 486.1) - evaluate(eta, 656.3));
  EXPECT_NEAR(evaluate(eta, 587.6), 1.5, 1e-4);
  EXPECT_NEAR(abbe, 50, 0.2);
}

TEST(GltfMaterials, AlphaIsOpacity) {
  const auto opacity = [](const std::string& material) {
    return square_of(material).scene.shapes.at(0).opacity;
  };
  EXPECT_EQ(opacity(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}})"), FloatParameter{1.0f})
      << "OPAQUE";
  EXPECT_EQ(opacity(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}})"),
            FloatParameter{0.25f});
  EXPECT_EQ(opacity(R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}})"),
            FloatParameter{0.0f});
  EXPECT_EQ(
      opacity(
          R"({"alphaMode":"MASK","alphaCutoff":0.25,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]}})"),
      FloatParameter{1.0f});
}

class GltfImages : public ::testing::Test {
 protected:
  GltfImages() {
    write_png(folder_ / "a b.png", 2, 1, 4, {255, 0, 0, 255, 0, 0, 255, 0});
    std::ifstream in(folder_ / "a b.png", std::ios::binary);
    png_.assign(std::istreambuf_iterator<char>(in), {});
  }
  ImportedScene read(const std::string& image, const std::string& material, const std::string& more = "") {
    GltfText file;
    file.add_square();
    const int view = file.view("xx" + png_);  // at no multiple of three
    file.views.replace(
        file.views.rfind("\"byteOffset\""), std::string::npos,
        fmt::format("\"byteOffset\":{},\"byteLength\":{}}}", file.bytes.size() - png_.size(), png_.size()));
    std::string where = image;
    if (const std::size_t at = where.find("VIEW"); at != std::string::npos)
      where.replace(at, 4, std::to_string(view));
    return read_gltf(
        folder_.write("scene.gltf", file.text(square_mesh + "," + one_node + ",\"materials\":[" + material +
                                              "],\"images\":[" + where + "]" + more)));
  }
  TemporaryFolder folder_;
  std::string png_;
};

constexpr const char* textured =
    R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";
constexpr const char* one_texture = R"(,"textures":[{"source":0}])";

TEST_F(GltfImages, AreReadFromFilesBuffersAndText) {
  for (const std::string& image :
       {std::string(R"({"uri":"a%20b.png"})"), std::string(R"({"bufferView":VIEW,"mimeType":"image/png"})"),
        R"({"uri":"data:image/png;base64,)" + base64(png_) + "\"}"}) {
    const ImportedScene imported = read(image, textured, one_texture);
    const auto& texture = std::get<ImageTexture>(imported.scene.textures.at(0).model);
    EXPECT_EQ(texture.encoding, Encoding::srgb);
    const StoredImage stored = read_stored_image(texture.filename);
    ASSERT_EQ(stored.image.width, 2) << texture.filename;
    EXPECT_EQ(stored.image.values, (std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0})) << texture.filename;
  }
}

TEST_F(GltfImages, NamesMayComeFromWindows) {
  for (const char* uri : {"A%20B.PNG", "textures\\\\a%20b.png", "C:%5Cmodels%5Ca%20b.png"}) {
    const ImportedScene imported = read(fmt::format("{{\"uri\":\"{}\"}}", uri), textured, one_texture);
    EXPECT_EQ(std::get<ImageTexture>(imported.scene.textures.at(0).model).filename,
              (folder_.path() / "a b.png").string());
  }
}

NormalMap map_of(const Scene& scene, const Shape& shape) {
  return normal_map_of(scene.textures, *scene.materials.at(shape.material.value).normal_map).value();
}

constexpr const char* bumpy = R"({"normalTexture":{"index":0,"scale":2}})";

TEST_F(GltfImages, NormalMapsHaveAScale) {
  const ImportedScene imported = read(R"({"uri":"a%20b.png"})", bumpy, one_texture);
  EXPECT_EQ(map_of(imported.scene, imported.scene.shapes.at(0)).factors, (std::array<float, 3>{2, 2, 1}));
}

TEST(GltfMaterials, SheenIsToldByTheNameOfItsMaterial) {
  const ImportedScene imported = square_of(
      R"({"name":"velvet","extensions":{"KHR_materials_sheen":{"sheenColorFactor":[0.9,0.1,0.2]}}})",
      R"(,"extensionsUsed":["KHR_materials_sheen"])");
  EXPECT_TRUE(mentions(imported.diagnostics, "sheen of material \"velvet\": Burley's"));
  EXPECT_TRUE(mentions(imported.diagnostics, "white, 0.9 for its colour 0.9 0.1 0.2"));
}

// TANGENT against u, and w of either sign.
TEST_F(GltfImages, NormalMapsFollowTheirTangents) {
  const auto factors = [&](float along, float w) {
    GltfText file;
    file.add_square();
    file.floats({along, 0, 0, w, along, 0, 0, w, along, 0, 0, w, along, 0, 0, w}, 4);
    const ImportedScene imported = read_gltf(folder_.write(
        "scene.gltf",
        file.text(
            R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":2,"TANGENT":3},"indices":1,"material":0}]}],)" +
            one_node + R"(,"materials":[{"normalTexture":{"index":0}}],"images":[{"uri":"a%20b.png"}])" +
            one_texture)));
    EXPECT_FALSE(mentions(imported.diagnostics, "degrees"));
    const auto all = map_of(imported.scene, imported.scene.shapes.at(0)).factors;
    return std::array{all[0], all[1]};
  };
  // B = (N × T)·w: its second axis is N × ∂p/∂u for T along u and w of 1, and for both turned round.
  EXPECT_EQ(factors(1, 1), (std::array{1.f, 1.f}));
  EXPECT_EQ(factors(1, -1), (std::array{1.f, -1.f}));
  EXPECT_EQ(factors(-1, 1), (std::array{-1.f, -1.f}));
  EXPECT_EQ(factors(-1, -1), (std::array{-1.f, 1.f}));
}

// A square whose second half has its (u,v) mirrored: that half is a shape of its own, whose map is turned
// over.
TEST_F(GltfImages, NormalMapsTurnOverWhereUvAreMirrored) {
  const auto factors = [&](const std::vector<float>& uv, const std::string& place) {
    GltfText file;
    file.add_square();
    file.floats(uv, 2);
    const std::string mesh =
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":3},"indices":1,"material":0}]}])";
    const ImportedScene imported = read_gltf(folder_.write(
        "scene.gltf",
        file.text(mesh + R"(,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + place + R"(}],"materials":[)" +
                  R"({"normalTexture":{"index":0}}],"images":[{"uri":"a%20b.png"}])" + one_texture)));
    std::vector<float> along_v;
    for (const Shape& shape : imported.scene.shapes)
      along_v.push_back(map_of(imported.scene, shape).factors[1]);
    return along_v;
  };
  const std::vector<float> straight{0, 1, 1, 1, 1, 0, 0, 0}, mirrored{1, 1, 0, 1, 0, 0, 1, 0},
      both{0, 1, 1, 1, 1, 0, 2, 1};
  EXPECT_EQ(factors(straight, ""), (std::vector<float>{1}));
  EXPECT_EQ(factors(mirrored, ""), (std::vector<float>{-1}));
  EXPECT_EQ(factors(both, ""), (std::vector<float>{1, -1}));
  EXPECT_EQ(factors(straight, R"(,"scale":[-1,1,1])"), (std::vector<float>{-1})) << "a node that mirrors";
  EXPECT_EQ(factors(mirrored, R"(,"scale":[-1,1,1])"), (std::vector<float>{1}));
}

TEST_F(GltfImages, CutoffsAreSteps) {
  const ImportedScene imported = read(R"({"uri":"a%20b.png"})", textured, one_texture);
  const Texture& step =
      imported.scene.textures.at(std::get<Id<Texture>>(imported.scene.shapes.at(0).opacity).value);
  const auto& mix = std::get<MixTexture>(step.model);
  const auto value = [](const SpectrumParameter& p) {
    return static_cast<double>(std::get<ConstantSpectrum>(std::get<Spectrum>(p)).value);
  };
  const auto at = [&](double alpha) { return (1 - alpha) * value(mix.first) + alpha * value(mix.second); };
  EXPECT_GE(at(0.5), 1);
  EXPECT_LE(at(0.499), 0);
}

TEST_F(GltfImages, ChannelsAreRoughnessAndMetal) {
  const ImportedScene imported =
      read(R"({"uri":"a%20b.png"})",
           R"({"pbrMetallicRoughness":{"roughnessFactor":0.5,"metallicRoughnessTexture":{"index":0}}})",
           one_texture);
  const auto& m = std::get<PrincipledMaterial>(model_of(imported));
  const auto image = [&](const FloatParameter& p) {
    return std::get<ImageTexture>(imported.scene.textures.at(std::get<Id<Texture>>(p).value).model);
  };
  EXPECT_EQ(image(m.roughness).number, ImageNumber::green);
  EXPECT_EQ(image(m.roughness).scale, 0.5f);
  EXPECT_EQ(image(m.metallic).number, ImageNumber::blue);
  EXPECT_EQ(image(m.metallic).encoding, Encoding::linear);
}

TEST_F(GltfImages, TransformsTurnAboutTheUpperLeftCorner) {
  const ImportedScene imported = read(
      R"({"uri":"a%20b.png"})",
      R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0.25],"rotation":1.5707963267948966,"scale":[2,3]}}}}})",
      one_texture);
  const auto& m = std::get<UvMapping>(std::get<ImageTexture>(imported.scene.textures.at(0).model).mapping);
  // (u,v) = (1,0) → scaled (2,0) → turned by 90°, from u towards −v: (0,−2) → (0.5,−1.75), from above.
  EXPECT_NEAR(m.a + m.c, 0.5f, 1e-6f);
  EXPECT_NEAR(m.d + m.f, 1 + 1.75f, 1e-6f);
  // (0,1) → (0,3) → (3,0) → (3.5,0.25).
  EXPECT_NEAR(m.b + m.c, 3.5f, 1e-6f);
  EXPECT_NEAR(m.e + m.f, 1 - 0.25f, 1e-6f);
}

TEST(GltfLight, IsInPhotometricUnits) {
  GltfText file;
  const ImportedScene imported = read_text(file.text(
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":100},)"
      R"({"type":"directional","intensity":7,"color":[1,0,0]},{"type":"spot","spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}}]}},)"
      R"("scenes":[{"nodes":[0,1,2]}],"nodes":[{"translation":[0,2,0],"extensions":{"KHR_lights_punctual":{"light":0}}},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}}])"));
  const auto& lights = imported.scene.lights;
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_NEAR(photometric(luminance(std::get<PointLight>(lights[0].model).intensity)), 100, 0.1) << "cd";
  EXPECT_NEAR(photometric(emission_rgb(std::get<DistantLight>(lights[1].model).irradiance).r), 7, 0.01)
      << "lx";
  EXPECT_NEAR(std::get<DistantLight>(lights[1].model).direction.z, -1, 1e-12);
  const auto& spot = std::get<SpotLight>(lights[2].model);
  EXPECT_NEAR(spot.cutoff_deg, 0.5f * 180 / std::numbers::pi_v<float>, 1e-4f);
  EXPECT_NEAR(transform_vector(spot.light_to_world, {0, 0, 1}).z, -1, 1e-12);
  EXPECT_NEAR(imported.scene.film.imaging_ratio, photometric(1), 1e-9) << "pictures show cd/m²";
}

TEST(GltfLight, EmissionShinesOnTheFrontUnlessDoubleSided) {
  const ImportedScene imported = square_of(
      R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5}}})");
  const AreaLight& light = imported.scene.area_lights.at(0);
  EXPECT_FALSE(light.two_sided);
  EXPECT_NEAR(photometric(luminance(std::get<Spectrum>(light.radiance))), 5, 0.005) << "cd/m²";
  EXPECT_TRUE(
      square_of(R"({"emissiveFactor":[1,1,1],"doubleSided":true})").scene.area_lights.at(0).two_sided);
}

}  // namespace
}  // namespace vitrail::test::gltf_materials_test
