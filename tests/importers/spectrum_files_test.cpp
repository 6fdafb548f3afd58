// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "importers/mitsuba/read/mitsuba.h"
#include "importers/pbrt/read/pbrt.h"
#include "importers/spectra/spectrum_file.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::spectrum_files_test {
namespace {

using testing::HasSubstr;

class SpectrumFiles : public testing::Test {
 protected:
  SpectrumFile read(const std::string& text) { return read_spectrum_file(folder_.write("x.spd", text)); }
  double value(const std::string& text, double nm, SpectrumPart part = SpectrumPart::n) {
    return evaluate(spectrum_of(read(text), part, false), nm);
  }
  std::string error(const std::string& text) {
    try {
      spectrum_of(read(text), SpectrumPart::n, false);
    } catch (const Error& e) {
      return to_string(e.location) + ": " + e.what();
    }
    return "";
  }
  TemporaryFolder folder_;
};

TEST_F(SpectrumFiles, TextIsZeroOutsideOfItsSamples) {
  const std::string text = "# nm value\n400 1\r\n\n  0500,\t3 # comment\n";
  EXPECT_NEAR(value(text, 450), 2, 1e-6);
  EXPECT_EQ(value(text, 399), 0);
  EXPECT_NEAR(evaluate(spectrum_of(read(text), SpectrumPart::n, true), 700), 3, 1e-6);
  EXPECT_TRUE(read(text).repairs.empty());
}

TEST_F(SpectrumFiles, UnsortedAndDuplicateWavelengthsAreRepaired) {
  const SpectrumFile file = read("500 3\n400 1\n400 2\n600 3\n");
  ASSERT_EQ(file.rows.size(), 3u);
  EXPECT_EQ(file.rows[0].v[0], 1.5);
  ASSERT_EQ(file.repairs.size(), 2u);
  EXPECT_THAT(file.repairs[0], HasSubstr("ascending"));
  EXPECT_THAT(file.repairs[1], HasSubstr("mean"));
}

TEST_F(SpectrumFiles, XmlHoldsItsEndsAndForgivesItsEncoding) {
  const std::string text =
      "\xef\xbb\xbf<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- mesur\xe9 -->\n<spectrum>\n"
      "<entry wavelength=\" 0400 \" value=\" +00.5\"/><entry wavelength='500.0' value='1'/></spectrum>";
  EXPECT_NEAR(value(text, 450), .75, 1e-6);
  EXPECT_NEAR(value(text, 380), .5, 1e-6);
  EXPECT_NEAR(value(text, 800), 1, 1e-6);
}

TEST_F(SpectrumFiles, IndicesHaveTwoParts) {
  const std::string kappa = "<m><entry wavelength='400' n='2' kappa='1.5'/></m>",
                    k = "<m><entry wavelength='400' n='2' k='1.5'/></m>",
                    glass = "<m><entry wavelength='400' n='1.5'/></m>";
  EXPECT_EQ(value(kappa, 500), 2);
  EXPECT_EQ(value(kappa, 500, SpectrumPart::k), 3);
  EXPECT_EQ(value(k, 500, SpectrumPart::k), 1.5);
  EXPECT_EQ(value(glass, 500), 1.5);
  EXPECT_EQ(value(glass, 500, SpectrumPart::k), 0);
}

// Duncan 1940: K/S = (1 − R)²/(2R).
TEST_F(SpectrumFiles, PigmentsReflectAsAnOpaqueLayer) {
  for (const double r : {.05, .3, .8}) {
    const std::string k = std::to_string((1 - r) * (1 - r) / r);  // s = 2
    EXPECT_NEAR(value("<p><entry wavelength='400' k='" + k + "' s='2'/></p>", 600), r, 1e-5);
  }
  EXPECT_EQ(value("<p><entry wavelength='400' k='0' s='0'/></p>", 600), 1);
  EXPECT_EQ(value("<p><entry wavelength='400' k='1' s='0'/></p>", 600), 0);
}

TEST_F(SpectrumFiles, ObserversHaveThreeFunctions) {
  const std::string text = "<o><entry wavelength='400' x='1' y='2' z='3'/></o>";
  EXPECT_EQ(read(text).kind, SpectrumFile::Kind::observer);
  EXPECT_EQ(read(text).rows[0].v[2], 3);
  EXPECT_THAT(error(text), HasSubstr("observer"));
}

TEST_F(SpectrumFiles, ALastWavelengthWithoutValueIsLeftOut) {
  const SpectrumFile file = read("400 1 500 3 600");
  ASSERT_EQ(file.rows.size(), 2u);
  EXPECT_THAT(file.repairs, testing::ElementsAre(HasSubstr("has no value")));
  EXPECT_THAT(error("400"), HasSubstr("no samples"));
}

TEST_F(SpectrumFiles, ErrorsSayWhere) {
  EXPECT_THAT(error("400 1\n500 one\n"), HasSubstr("x.spd:2:5: expected a number"));
  EXPECT_THAT(error("400 nan"), HasSubstr("expected a number"));
  EXPECT_THAT(error("# nothing"), HasSubstr("no samples"));
  EXPECT_THAT(error("<s/>"), HasSubstr("no samples"));
  EXPECT_THAT(error("<s>\n<entry wavelength='400'/></s>"), HasSubstr("x.spd:2:1: an entry"));
  EXPECT_THAT(error("<s>\n<entry wavelength='4OO' value='1'/></s>"), HasSubstr("\"4OO\""));
  EXPECT_THAT(error("<s><entry wavelength='400' value='1'/>\n<entry wavelength='500' n='1'/></s>"),
              HasSubstr("x.spd:2:1: the entries"));
  EXPECT_THAT(error("<s><entry wavelength='400' k='-1' s='1'/></s>"), HasSubstr("negative"));
  EXPECT_THAT(error("<s>\n<entry"), HasSubstr("x.spd"));
}

const ConductorMaterial& metal_of(const ImportedScene& imported) {
  for (const Material& m : imported.scene.materials)
    if (const auto* metal = std::get_if<ConductorMaterial>(&m.model)) return *metal;
  throw Error("no metal");
}

void expect_index(const ConductorMaterial& material) {
  const auto& index = std::get<ComplexIndex>(material.metal);
  EXPECT_EQ(evaluate(std::get<Spectrum>(index.eta), 500), 2);
  EXPECT_EQ(evaluate(std::get<Spectrum>(index.k), 500), 3);
}

bool mentions(const Diagnostics& diagnostics, const std::string& text) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [&](const Diagnostic& d) { return d.message.find(text) != std::string::npos; });
}

const char* const metal_file =
    "<m><entry wavelength='600' n='2' kappa='1.5'/><entry wavelength='400' n='2' kappa='1.5'/></m>";

TEST_F(SpectrumFiles, AreReadByPbrtScenes) {
  folder_.write("m.xml", metal_file);
  const ImportedScene scene = read_pbrt(
      folder_.write("s.pbrt",
                    "WorldBegin Material \"conductor\" \"spectrum eta\" \"m.xml\" \"spectrum k\" \"m.xml\"\n"
                    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]"));
  expect_index(metal_of(scene));
  EXPECT_TRUE(mentions(scene.diagnostics, "ascending"));
}

TEST_F(SpectrumFiles, AreReadByMitsubaScenes) {
  folder_.write("m.xml", metal_file);
  const ImportedScene scene = read_mitsuba(folder_.write(
      "s.xml",
      "<scene version='3.0.0'><shape type='rectangle'><bsdf type='conductor'><spectrum name='eta' "
      "filename='m.xml'/><spectrum name='k' filename='m.xml'/></bsdf></shape></scene>"));
  expect_index(metal_of(scene));
  EXPECT_TRUE(mentions(scene.diagnostics, "ascending"));
}

}  // namespace
}  // namespace vitrail::spectrum_files_test
