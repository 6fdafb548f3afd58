// SPDX-License-Identifier: Apache-2.0
// Spellings, plugins and meanings of Mitsuba 0.5 to 2.
#include <fmt/format.h>

#include "scene/spectra/color.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/mitsuba/mitsuba_load.h"

namespace vitrail::mitsuba_old_files_test {
namespace {

TEST_F(MitsubaLoad, OldSpellings) {
  const std::string old =
      "<scene version=\"0.5.0\"><bsdf type=\"diffuse\" id=\"m\"><texture type=\"checkerboard\" "
      "name=\"diffuseReflectance\">"
      "<float name=\"uscale\" value=\"2\"/><float name=\"voffset\" value=\"0.5\"/></texture></bsdf>"
      "<shape type=\"rectangle\"><transform name=\"toWorld\"><translate x=\"3\"/></transform><ref "
      "id=\"m\"/></shape></scene>";
  const ImportedScene imported = read_mitsuba(folder_.write("scene.xml", old));
  EXPECT_EQ(transform_point(imported.scene.shapes.at(0).object_to_world, {0, 0, 0}), (Point3d{3, 0, 0}));
  const auto& board = std::get<CheckerboardTexture>(imported.scene.textures.at(0).model);
  EXPECT_EQ(board.mapping, (TextureMapping{UvMapping{4, 0, 0, 0, 2, 1}})) << "cells are half a unit";
  for (const Diagnostic& d : imported.diagnostics)
    EXPECT_EQ(d.message.find("scale"), std::string::npos) << d.message;
}

// What bounds a medium there has no surface unless it is given one; since version 2 it has the usual one.
TEST_F(MitsubaLoad, OldMediaHaveNoSurface) {
  const auto materials = [&](const char* version, const char* more) {
    const std::string scene = fmt::format(
        "<scene version=\"{}\"><medium type=\"homogeneous\" id=\"smoke\"/><shape type=\"cube\"><ref "
        "name=\"interior\" "
        "id=\"smoke\"/>{}</shape><shape type=\"sphere\"/></scene>",
        version, more);
    const ImportedScene imported = read_mitsuba(folder_.write("scene.xml", scene));
    std::vector<bool> is_nothing;
    for (const Shape& shape : imported.scene.shapes)
      is_nothing.push_back(
          std::holds_alternative<InterfaceMaterial>(imported.scene.materials.at(shape.material.value).model));
    for (const Diagnostic& d : imported.diagnostics) EXPECT_EQ(d.message.find("surface"), std::string::npos);
    return is_nothing;
  };
  EXPECT_EQ(materials("0.6.0", ""), (std::vector<bool>{true, false}));
  EXPECT_EQ(materials("0.5.0", "<bsdf type=\"diffuse\"/>"), (std::vector<bool>{false, false}));
  EXPECT_EQ(materials("3.0.0", ""), (std::vector<bool>{false, false}));
}

// As Mitsuba 3.9 translates them: a run of capitals is one word.
TEST_F(MitsubaLoad, OldAcronyms) {
  const std::string old =
      "<scene version=\"0.6.0\"><bsdf type=\"dielectric\" id=\"m\"><float name=\"intIOR\" value=\"1.33\"/>"
      "<float name=\"extIOR\" value=\"1.1\"/></bsdf>" +
      floor + tail;
  const ImportedScene imported = read_mitsuba(folder_.write("scene.xml", old));
  const auto& glass = std::get<DielectricMaterial>(imported.scene.materials.at(0).model);
  EXPECT_EQ(glass.eta, Spectrum{ConstantSpectrum{1.33f}});
  EXPECT_EQ(glass.exterior_eta, Spectrum{ConstantSpectrum{1.1f}});
  for (const Diagnostic& d : imported.diagnostics) EXPECT_EQ(d.message.find("ior"), std::string::npos);
}

// 0.6 gives the faces of each usemtl the bsdf of that name.
TEST_F(MitsubaLoad, OldBsdfsByName) {
  folder_.write("two.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl leftWall\nf 1 2 3\nusemtl other\nf 2 4 3\n"
                "usemtl Red\nf 1 2 4\n");
  const auto bsdf = [](const std::string& name, double r) {
    return fmt::format(
        "<bsdf name=\"{}\" type=\"diffuse\"><spectrum name=\"reflectance\" value=\"{}\"/></bsdf>", name, r);
  };
  const ImportedScene imported = read_mitsuba(folder_.write(
      "scene.xml",
      "<scene version=\"0.6.0\"><shape type=\"obj\"><string name=\"filename\" value=\"two.obj\"/>" +
          bsdf("Red", .25) + bsdf("leftWall", .75) + bsdf("unknown", .1) + "</shape>" + tail));
  std::vector<SpectrumParameter> reflectances;
  for (const Shape& shape : imported.scene.shapes) {
    EXPECT_EQ(imported.scene.meshes.at(shape.mesh.value).triangles.size(), 1u);
    reflectances.push_back(
        std::get<DiffuseMaterial>(imported.scene.materials.at(shape.material.value).model).reflectance);
  }
  EXPECT_THAT(reflectances,
              ::testing::ElementsAre(ConstantSpectrum{.75f}, ConstantSpectrum{.5f}, ConstantSpectrum{.25f}));
  std::string said;
  for (const Diagnostic& d : imported.diagnostics) said += d.message + "\n";
  EXPECT_THAT(said, ::testing::HasSubstr("\"other\""));
  EXPECT_THAT(said, ::testing::HasSubstr("\"unknown\""));
}

// Of two walls at a right angle: smooth at 100°, creased at 30°.
TEST_F(MitsubaLoad, OldSmoothAngle) {
  folder_.write("roof.obj", "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 -1\nf 1 3 2\nf 1 2 4\n");
  const auto mesh = [&](const std::string& angle) {
    return read_mitsuba(
               folder_.write("scene.xml",
                             "<scene version=\"0.6.0\"><shape type=\"obj\"><string name=\"filename\" "
                             "value=\"roof.obj\"/><float name=\"maxSmoothAngle\" value=\"" +
                                 angle + "\"/></shape>" + tail))
        .scene.meshes.at(0);
  };
  const TriangleMesh smooth = mesh("100"), creased = mesh("30");
  EXPECT_EQ(smooth.positions.size(), 4u);
  EXPECT_NEAR(smooth.normals.at(smooth.triangles[0][0]).z, std::sqrt(.5), 1e-6);
  EXPECT_EQ(creased.positions.size(), 6u);
  EXPECT_NEAR(creased.normals.at(creased.triangles[0][0]).z, 1, 1e-6);
  EXPECT_NEAR(creased.normals.at(creased.triangles[1][0]).x, -1, 1e-6);
  EXPECT_THROW(mesh("-1"), Error);
}

// 0.6 was built for three channels.
TEST_F(MitsubaLoad, OldSpectraAreLinearRgb) {
  const std::string old =
      "<scene version=\"0.6.0\"><bsdf type=\"diffuse\" id=\"m\">"
      "<spectrum name=\"reflectance\" value=\"0.1, 0.4 .9\"/></bsdf>"
      "<emitter type=\"point\"><spectrum name=\"intensity\" value=\" 190, 254, 254 \"/></emitter>"
      "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"2\"/></emitter>" +
      floor + tail;
  const Scene scene = read_mitsuba(folder_.write("scene.xml", old)).scene;
  EXPECT_EQ(std::get<DiffuseMaterial>(scene.materials.at(0).model).reflectance,
            SpectrumParameter{reflectance_from_rgb({0.1, 0.4, 0.9})});
  EXPECT_EQ(std::get<PointLight>(scene.lights.at(0).model).intensity,
            Spectrum{emission_from_rgb({190, 254, 254})});
  EXPECT_EQ(std::get<InfiniteLight>(scene.lights.at(1).model).radiance,
            Spectrum{emission_from_rgb({2, 2, 2})});
  EXPECT_THAT(
      error_inside("<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"1 2 3\"/></emitter>"),
      ::testing::HasSubstr("number"));
  EXPECT_THAT(error("<scene version=\"0.6.0\"><emitter type=\"constant\"><spectrum name=\"radiance\" "
                    "value=\"1 2\"/></emitter></scene>"),
              ::testing::HasSubstr("3 numbers, has 2"));
}

// 0.6 decodes a PNG file by the gAMA chunk that it has, version 3 none.
TEST_F(MitsubaLoad, OldPngFilesHaveAGammaOfTheirOwn) {
  const auto bytes = [](std::string_view text) { return std::string(text); };
  using namespace std::string_view_literals;
  const std::string signature = bytes("\x89PNG\r\n\x1a\n"sv),
                    header = bytes("\0\0\0\x0dIHDR\0\0\0\1\0\0\0\1\x08\2\0\0\0????"sv),
                    gamma = bytes("\0\0\0\4gAMA\0\0\xc3\x50????"sv),  // 50000: 1/2
      srgb = bytes("\0\0\0\1sRGB\0????"sv), end = bytes("\0\0\0\0IEND????"sv);
  const auto image = [&](const char* version, const std::string& chunks, const std::string& parameters) {
    folder_.write("a.png", signature + header + chunks + end);
    const std::string text = std::string("<scene version=\"") + version +
                             "\"><bsdf type=\"diffuse\" id=\"m\"><texture type=\"bitmap\" "
                             "name=\"reflectance\"><string name=\"filename\" value=\"a.png\"/>" +
                             parameters + "</texture></bsdf>" + floor + tail;
    return std::get<ImageTexture>(read_mitsuba(folder_.write("scene.xml", text)).scene.textures.at(0).model);
  };
  EXPECT_EQ(image("0.6.0", gamma, "").encoding, Encoding::gamma);
  EXPECT_EQ(image("0.6.0", gamma, "").gamma, 2);
  EXPECT_EQ(image("0.6.0", gamma + srgb, "").encoding, Encoding::automatic);
  EXPECT_EQ(image("0.6.0", "", "").encoding, Encoding::automatic);
  EXPECT_EQ(image("0.6.0", gamma, "<float name=\"gamma\" value=\"1.8\"/>").gamma, 1.8f);
  EXPECT_EQ(image("3.0.0", gamma, "").encoding, Encoding::automatic);
}

// The parts of a mixture count by their weights, and what lacks to 1 is black.
TEST_F(MitsubaLoad, OldMixtures) {
  const auto mixture = [&](const std::string& weights) {
    return material("<bsdf type=\"mixturebsdf\" id=\"m\"><string name=\"weights\" value=\"" + weights +
                    "\"/><bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"b\"/></bsdf>");
  };
  const auto share = [&](const Material& whole, const std::string& name) {
    double found = 0;
    const auto walk = [&](const auto& self, const Material& at, double weight) -> void {
      if (const auto* blend = std::get_if<BlendMaterial>(&at.model)) {
        const auto amount = static_cast<double>(std::get<float>(blend->amount));
        self(self, imported_.scene.materials.at(blend->first.value), weight * (1 - amount));
        self(self, imported_.scene.materials.at(blend->second.value), weight * amount);
      } else if (at.name == name) {
        found += weight;
      }
    };
    walk(walk, whole, 1);
    return found;
  };
  for (const auto& [weights, a, b] :
       {std::tuple{"0.3, 0.7", 0.3, 0.7}, {"0.25 0.5", 0.25, 0.5}, {"3 1", 0.75, 0.25}, {"0, 1", 0.0, 1.0}}) {
    const Material whole = mixture(weights);
    EXPECT_NEAR(share(whole, "a"), a, 1e-6) << weights;
    EXPECT_NEAR(share(whole, "b"), b, 1e-6) << weights;
  }
  EXPECT_THROW(mixture("0.5"), Error);
}

// (1 − r)·ρ/(1 − r) is ρ: no light goes back and forth below 0.6's coat.
TEST_F(MitsubaLoad, OldCoatings) {
  const Material coat = material(
      "<bsdf type=\"coating\" id=\"m\"><float name=\"int_ior\" value=\"1.5\"/>"
      "<float name=\"ext_ior\" value=\"1\"/><bsdf type=\"diffuse\"/></bsdf>");
  const auto& plastic = std::get<PlasticMaterial>(coat.model);
  constexpr double internal = 0.5963;  // of index 1.5 (Jacquez and Kuppenheim 1955)
  EXPECT_NEAR(luminance(std::get<Spectrum>(plastic.diffuse_reflectance)), 0.5 * (1 - internal), 1e-4);
  EXPECT_EQ(plastic.eta, 1.5f);
  EXPECT_FALSE(plastic.nonlinear);
  EXPECT_FALSE(coat.two_sided);

  // Of index 1 light goes on as it comes: (2∫exp(−τ/μ)μ dμ)² = (2E₃(τ))², E₃(0.1) = 0.4163.
  const Material dark = material(
      "<bsdf type=\"coating\" id=\"m\"><float name=\"int_ior\" value=\"1.000001\"/><float name=\"ext_ior\" "
      "value=\"1\"/>"
      "<float name=\"thickness\" value=\"2\"/><float name=\"sigma_a\" value=\"0.05\"/>"
      "<bsdf type=\"conductor\"/></bsdf>");
  const auto& factor = std::get<ConductorMaterial>(dark.model).reflectance_factor;
  EXPECT_NEAR(luminance(std::get<Spectrum>(factor)), 0.8326 * 0.8326, 2e-3);
  EXPECT_TRUE(mentions("0.69"));
}

// Sums of a Lambertian part and a gloss without Fresnel's factor.
TEST_F(MitsubaLoad, OldPhongAndWard) {
  for (const char* kind : {"phong", "ward"}) {
    const Material whole = material(fmt::format("<bsdf type=\"{}\" id=\"m\"/>", kind));
    const auto& blend = std::get<BlendMaterial>(whole.model);
    const auto amount = static_cast<double>(std::get<float>(blend.amount));
    const auto& base = std::get<DiffuseMaterial>(imported_.scene.materials.at(blend.first.value).model);
    const auto& gloss = std::get<ConductorMaterial>(imported_.scene.materials.at(blend.second.value).model);
    EXPECT_NEAR(luminance(std::get<Spectrum>(base.reflectance)) * (1 - amount), 0.5, 1e-5);
    EXPECT_NEAR(luminance(std::get<Spectrum>(gloss.reflectance_factor)) * amount, 0.2, 1e-5);
    EXPECT_EQ(gloss.metal, Metal{PerfectReflector{}});
  }
}

// How its integrators sample is no loss, and what nobody knows is said once.
TEST_F(MitsubaLoad, OldIntegratorsAndFilms) {
  const std::string old =
      "<scene version=\"0.6.0\"><integrator type=\"sppm\"><integer name=\"maxDepth\" value=\"6\"/>"
      "<integer name=\"photonCount\" value=\"9\"/><integer name=\"kNN\" value=\"9\"/></integrator>"
      "<sensor type=\"perspective\"><film type=\"hdrfilm\"><boolean name=\"banner\" value=\"false\"/>"
      "<float name=\"madeUp\" value=\"1\"/><float name=\"widthh\" value=\"1\"/></film></sensor></scene>";
  const ImportedScene imported = read_mitsuba(folder_.write("scene.xml", old));
  EXPECT_EQ(imported.scene.settings.max_depth, 5);
  ASSERT_EQ(imported.diagnostics.size(), 1u);
  EXPECT_EQ(imported.diagnostics[0].message,
            "film \"hdrfilm\": \"made_up\", \"widthh\" (did you mean \"width\"?) are not used");
}

// Colours of vertices are decoded in 0.6, and numbers as they are in 3.
TEST_F(MitsubaLoad, OldColoursOfVertices) {
  folder_.write(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 255 128 0\n1 0 0 255 128 0\n0 1 0 255 128 0\n3 0 1 2\n");
  const auto values = [&](const std::string& version, const std::string& texture) {
    const ImportedScene imported = read_mitsuba(folder_.write(
        "scene.xml", "<scene version=\"" + version +
                         "\"><shape type=\"ply\"><string name=\"filename\" "
                         "value=\"m.ply\"/><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"" +
                         texture + "</texture></bsdf></shape></scene>"));
    EXPECT_EQ(std::get<MeshAttributeTexture>(imported.scene.textures.at(0).model).name, "vertex_color");
    return imported.scene.meshes.at(0).attributes.at(0).values;
  };
  EXPECT_FLOAT_EQ(values("0.6.0", "vertexcolors\">").at(1), static_cast<float>(srgb_decode(128 / 255.0)));
  EXPECT_EQ(values("3.0.0", "mesh_attribute\"><string name=\"name\" value=\"vertex_color\"/>").at(1), 128);
}

TEST_F(MitsubaLoad, OldTexturesOfLines) {
  const auto share = [&](const std::string& texture) {
    imported_ = read_mitsuba(folder_.write(
        "scene.xml",
        "<scene version=\"0.6.0\"><bsdf type=\"diffuse\" id=\"m\"><texture name=\"reflectance\" type=\"" +
            texture + "</texture></bsdf>" + floor + "</scene>"));
    return std::get<float>(std::get<MixTexture>(imported_.scene.textures.at(0).model).amount);
  };
  EXPECT_FLOAT_EQ(share("gridtexture\"><float name=\"lineWidth\" value=\".1\"/>"), 0.36f);
  EXPECT_TRUE(mentions("0.36 are lines"));
  EXPECT_EQ(share("wireframe\">"), 0);
}

TEST_F(MitsubaLoad, OldLuminairesAndPinholes) {
  imported_ = read_mitsuba(folder_.write(
      "scene.xml",
      "<scene version=\"0.3.0\"><camera type=\"perspective\"><float name=\"focusDistance\" "
      "value=\"3\"/></camera>"
      "<luminaire type=\"constant\"><rgb name=\"intensity\" value=\"1 2 3\"/></luminaire></scene>"));
  EXPECT_EQ(std::get<InfiniteLight>(imported_.scene.lights.at(0).model).radiance,
            Spectrum{emission_from_rgb({1, 2, 3})});
  EXPECT_TRUE(imported_.diagnostics.empty());
}

// Since version 2 they make lights without extent brighter.
TEST_F(MitsubaLoad, SamplesOfLightsChangeNothingInOldFiles) {
  imported_ = read_mitsuba(folder_.write(
      "scene.xml",
      "<scene version=\"0.6.0\"><integrator type=\"direct\"><integer name=\"emitterSamples\" value=\"4\"/>"
      "</integrator><emitter type=\"point\"><rgb name=\"intensity\" value=\"1 1 1\"/></emitter></scene>"));
  EXPECT_EQ(std::get<PointLight>(imported_.scene.lights.at(0).model).intensity,
            Spectrum{emission_from_rgb({1, 1, 1})});
  EXPECT_FALSE(mentions("times as bright"));
}

}  // namespace
}  // namespace vitrail::mitsuba_old_files_test
