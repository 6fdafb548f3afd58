// SPDX-License-Identifier: Apache-2.0
// Glazing named by a scene: in pbrt's and in Mitsuba's words, and what is said of it.
#include "importers/reading/glazing_material.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "importers/export.h"
#include "importers/import.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::glazing_material_test {
namespace {

const std::string electrochromic = R"({"layers": [{"states": [{"state": 0, "pane": "pane.dat"},
  {"state": 1, "tinted": {"visible_transmittance": 0.1, "solar_transmittance": 0.08}}]}]})";

const std::string square_pbrt =
    "\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\n";

// T at 550 nm and normal incidence of the front of the only shape of a scene.
float transmittance_of(const Scene& scene) {
  const Material& whole = scene.materials.at(scene.shapes.at(0).material.value);
  const auto& sided = std::get<TwoSidedMaterial>(whole.model);
  EXPECT_LT(sided.front.value, scene.shapes[0].material.value) << "parts come before what is made of them";
  const auto& measured = std::get<MeasuredMaterial>(scene.materials.at(sided.front.value).model);
  const MeasuredSheet& s = measured.sheet.value();
  const auto row = std::ranges::lower_bound(s.wavelengths_nm, 550.0f) - s.wavelengths_nm.begin();
  return s.transmittance.at(static_cast<std::size_t>(row) * s.cosines.size() + s.cosines.size() - 1);
}

class GlazingMaterial : public ::testing::Test {
 protected:
  void SetUp() override {
    write_text(directory / "pane.dat", optics_text);
    write_text(directory / "unit.json", electrochromic);
  }
  Scene scene_of(const char* name, const std::string& text) {
    return import_scene(write_text(directory / name, text)).scene;
  }
  TemporaryDirectory directory;
};

TEST_F(GlazingMaterial, IsNamedByPbrtAndByMitsuba) {
  const auto pbrt = [&](const std::string& material) {
    return transmittance_of(scene_of("a.pbrt", "WorldBegin\nMaterial " + material + square_pbrt));
  };
  const auto mitsuba = [&](const std::string& bsdf) {
    return transmittance_of(
        scene_of("a.xml", "<scene version=\"3.0.0\"><shape type=\"rectangle\">" + bsdf + "</shape></scene>"));
  };
  const float clear = pbrt("\"thindielectric\" \"string glazing\" \"unit.json\"");
  EXPECT_GT(clear, 0.75f);
  EXPECT_EQ(pbrt("\"measured\" \"string filename\" \"unit.json\""), clear);
  EXPECT_EQ(mitsuba("<bsdf type=\"thindielectric\"><string name=\"glazing\" value=\"unit.json\"/></bsdf>"),
            clear);
  EXPECT_EQ(mitsuba("<bsdf type=\"measured\"><string name=\"filename\" value=\"unit.json\"/></bsdf>"), clear);
  const float dark = pbrt("\"thindielectric\" \"string glazing\" \"unit.json\" \"float state\" 1");
  EXPECT_LT(dark, 0.2f);
  EXPECT_EQ(
      mitsuba(
          "<bsdf type=\"thindielectric\"><string name=\"glazing\" value=\"unit.json\"/><float name=\"state\" "
          "value=\"1\"/></bsdf>"),
      dark);
}

TEST_F(GlazingMaterial, HasTwoSidesWhereTheyDiffer) {
  Scene scene;
  const auto add = [&](Material m) {
    scene.materials.push_back(std::move(m));
    return Id<Material>{static_cast<std::uint32_t>(scene.materials.size() - 1)};
  };
  const auto even = write_text(directory / "even.txt", "wavelength_nm T R\n400 0.5 0.2\n700 0.6 0.1\n");
  EXPECT_TRUE(is_glazing((directory / "unit.json#state=0.5").string()));
  EXPECT_TRUE(
      std::holds_alternative<TwoSidedMaterial>(glazing_model((directory / "pane.dat").string(), add).model));
  EXPECT_EQ(scene.materials.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<MeasuredMaterial>(glazing_model(even.string(), add).model));
}

// What pbrt and Mitsuba themselves do not stop at.
TEST_F(GlazingMaterial, IsNamedInFormsThatOthersPassOver) {
  const float dark = transmittance_of(scene_of("a.pbrt",
                                               "WorldBegin\nMaterial \"thindielectric\" \"string glazing\" "
                                               "\"unit.json\" \"float state\" 1" +
                                                   square_pbrt));
  EXPECT_LT(dark, 0.2f);
  EXPECT_EQ(transmittance_of(scene_of(
                "b.pbrt",
                "WorldBegin\nAttributeBegin\nAttribute \"material\" \"string glazing\" \"unit.json\" "
                "\"float state\" 1\nMaterial \"thindielectric\"" +
                    square_pbrt + "AttributeEnd\n")),
            dark);
  EXPECT_EQ(
      transmittance_of(scene_of(
          "b.xml",
          "<scene version=\"3.0.0\"><shape type=\"rectangle\"><bsdf type=\"thindielectric\" "
          "id=\"window\"/></shape><default name=\"glazing:window\" value=\"unit.json#state=1\"/></scene>")),
      dark);
}

// Each way there and back gives the same materials, however often.
TEST_F(GlazingMaterial, RoundTripsAddNoMaterials) {
  write_text(directory / "a.pbrt",
             "WorldBegin\nMakeNamedMaterial \"window\" \"string type\" \"thindielectric\" "
             "\"string glazing\" \"unit.json\" \"float state\" 0.5\nNamedMaterial \"window\"" +
                 square_pbrt + "Material \"thindielectric\" \"string glazing\" \"pane.dat\"" + square_pbrt);
  Scene first = import_scene(directory / "a.pbrt").scene;
  ASSERT_EQ(first.materials.size(), 6u);
  std::filesystem::path from = directory / "a.pbrt";
  for (const char* to : {"b.pbrt", "c.xml", "d.xml", "e.pbrt"}) {
    export_scene(import_scene(from).scene, directory / to);
    from = directory / to;
    const Scene again = import_scene(from).scene;
    ASSERT_EQ(again.materials.size(), first.materials.size()) << to;
    for (std::size_t i = 0; i < first.materials.size(); ++i)
      EXPECT_EQ(again.materials[i].model, first.materials[i].model) << to << i;
    EXPECT_EQ(again.materials.at(again.shapes.at(0).material.value).name, "window") << to;
  }
}

TEST_F(GlazingMaterial, RefusesWhatIsWrong) {
  EXPECT_THROW(scene_of("a.pbrt", "WorldBegin\nMaterial \"thindielectric\" \"string glazing\" \"none.json\"" +
                                      square_pbrt),
               Error);
  EXPECT_THROW(
      scene_of("a.pbrt",
               "WorldBegin\nMaterial \"thindielectric\" \"string glazing\" \"unit.json\" \"float state\" 2" +
                   square_pbrt),
      Error);
  EXPECT_THROW(
      scene_of("a.pbrt",
               "WorldBegin\nMaterial \"thindielectric\" \"string glazing\" \"pane.dat\" \"float state\" 1" +
                   square_pbrt),
      Error);
}

// An OBJ has no words for panes: they are given to the material by its name.
TEST_F(GlazingMaterial, IsGivenByName) {
  write_text(directory / "a.mtl", "newmtl Wall\nKd 1 0 0\nnewmtl Window\nKd .5 .5 .5\n");
  const auto obj =
      write_text(directory / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Window\nf 1 2 3\n");
  ImportOptions options;
  options.glazing = {"Window=" + (directory / "unit.json").string()};
  const Scene scene = import_scene(obj, MeshMemory{}, {}, options).scene;
  EXPECT_GT(transmittance_of(scene), 0.75f);
  EXPECT_EQ(scene.materials.at(scene.shapes.at(0).material.value).name, "Window");
  EXPECT_EQ(std::ranges::count(scene.materials, std::string("Window"), &Material::name), 1);
  options.glazing = {"Windw=" + (directory / "unit.json").string()};
  try {
    import_scene(obj, MeshMemory{}, {}, options);
    ADD_FAILURE() << "no material has this name";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean \"Window\"?"));
  }
}

}  // namespace
}  // namespace vitrail::test::glazing_material_test
