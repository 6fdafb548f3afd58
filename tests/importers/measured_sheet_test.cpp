// SPDX-License-Identifier: Apache-2.0
#include "importers/spectra/sheet_file.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "importers/export.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/pbrt/read/pbrt.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::measured_sheet_test {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;

const std::string pane =
    "# clear float glass\nwavelength_nm angle_deg R T\n700 60 .15 .77\n700 0 .08 .86 # the last\n"
    "400,0,0.09,0.88\n400\t60\t0.16\t0.79\n";

class MeasuredSheets : public testing::Test {
 protected:
  MeasuredSheetFile read(const std::string& text) {
    return read_measured_sheet(folder_.write("pane.txt", text));
  }
  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const Error& e) {
      return to_string(e.location) + ": " + e.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(MeasuredSheets, AreSortedByWavelengthAndCosineAndReflectAllAtGrazing) {
  const MeasuredSheetFile file = read(pane);
  EXPECT_TRUE(file.repairs.empty());
  EXPECT_THAT(file.sheet.wavelengths_nm, ElementsAre(400, 700));
  EXPECT_THAT(file.sheet.cosines, ElementsAre(0, FloatNear(.5f, 1e-6f), 1));
  EXPECT_THAT(file.sheet.reflectance, ElementsAre(1, .16f, .09f, 1, .15f, .08f));
  EXPECT_THAT(file.sheet.transmittance, ElementsAre(0, .79f, .88f, 0, .77f, .86f));
}

TEST_F(MeasuredSheets, RepeatedAndTooBrightRowsAreRepaired) {
  const MeasuredSheetFile file =
      read("wavelength_nm angle_deg R T\n500 0 .1 .4\n500 0 .3 .2\n600 0 .5 .75\n");
  EXPECT_THAT(file.sheet.reflectance, ElementsAre(1, .2f, 1, .4f));
  EXPECT_THAT(file.sheet.transmittance, ElementsAre(0, .3f, 0, .6f));
  EXPECT_EQ(file.repairs.size(), 2u);
}

TEST_F(MeasuredSheets, ErrorsSayWhere) {
  const std::string header = "wavelength_nm angle_deg R T\n";
  EXPECT_THAT(error("400 0 .1 .9\n"), HasSubstr("begins with"));
  EXPECT_THAT(error(header), HasSubstr("no rows"));
  EXPECT_THAT(error(header + "400 0 .1 .9\n500 0 .1"), HasSubstr("not complete"));
  EXPECT_THAT(error(header + "400 0 .1 x\n"), HasSubstr("pane.txt:2:0: expected a number"));
  EXPECT_THAT(error(header + "400 0 .1 .9\n500 91 .1 .9\n"), HasSubstr("pane.txt:3:0: an angle"));
  EXPECT_THAT(error(header + "400 0 1.1 0\n"), HasSubstr("in [0, 1]"));
  EXPECT_THAT(error(header + "400 0 .1 .9\n500 10 .1 .9\n"), HasSubstr("angles at 500 nm"));
}

TEST_F(MeasuredSheets, AreNamedByScenes) {
  folder_.write("pane.txt", pane);
  folder_.write("metal.bsdf", "tensor_file");
  const auto sheet_of = [](const ImportedScene& imported) -> std::optional<MeasuredSheet> {
    for (const Material& m : imported.scene.materials) {
      if (std::holds_alternative<TabulatedMaterial>(m.model)) return std::nullopt;
      if (const auto* measured = std::get_if<MeasuredMaterial>(&m.model)) return measured->sheet;
    }
    throw Error("no measured material");
  };
  const auto pbrt = [&](const std::string& name) {
    return sheet_of(read_pbrt(folder_.write(
        "s.pbrt",
        "WorldBegin Material \"measured\" \"string filename\" \"" + name +
            "\"\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]")));
  };
  EXPECT_EQ(pbrt("pane.txt"), read(pane).sheet);
  EXPECT_FALSE(pbrt("metal.bsdf"));
  EXPECT_EQ(
      sheet_of(read_mitsuba(folder_.write(
          "s.xml",
          "<scene version='3.0.0'><shape type='rectangle'><bsdf type='measured'><string name='filename' "
          "value='pane.txt'/></bsdf></shape></scene>"))),
      read(pane).sheet);
}

// Light goes through it from either side: no writer makes its back black, or closes it.
TEST_F(MeasuredSheets, AreOpenToBothSidesInEveryFormat) {
  folder_.write("pane.txt", pane);
  const ImportedScene scene =
      read_mitsuba(folder_.write("s.xml",
                                 "<scene version='3.0.0'><sensor type='perspective'/><shape "
                                 "type='rectangle'><bsdf type='measured'><string "
                                 "name='filename' value='pane.txt'/></bsdf></shape></scene>"));
  const auto written = [&](const std::string& name) {
    const std::filesystem::path file = folder_ / name;
    for (const Diagnostic& d : export_scene(scene.scene, file))
      EXPECT_THAT(d.message, testing::Not(HasSubstr("black back"))) << name;
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  written("out.pbrt");
  const std::string povray = written("out.pov");
  EXPECT_THAT(povray, testing::Not(HasSubstr("interior_texture")));
  EXPECT_THAT(povray, HasSubstr("filter 1"));
  EXPECT_THAT(written("out.xml"), testing::Not(HasSubstr("twosided")));
}

}  // namespace
}  // namespace vitrail::measured_sheet_test
