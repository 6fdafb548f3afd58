// SPDX-License-Identifier: Apache-2.0
// What products say, whatever the format, and what is said of files that are wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "glazing/band_spectrum.h"
#include "glazing/evaluation.h"
#include "glazing/product.h"
#include "scene/system/diagnostics.h"
#include "tests/glazing/glazing_files.h"

namespace vitrail::test::products_test {
namespace {

using ::testing::HasSubstr;

std::vector<Product> products_of(const std::string& text) {
  const TemporaryDirectory directory;
  return read_products(write_text(directory / "glazing.txt", text));
}

void expect_pane(const Product& pane) {
  ASSERT_EQ(pane.rows.size(), 3u);
  EXPECT_NEAR(pane.rows[0].nm, 300, 1e-9);
  EXPECT_NEAR(pane.rows[2].nm, 2500, 1e-9);
  EXPECT_EQ(pane.rows[0].at, (PaneValues{0.1, 0.05, 0.06}));
  EXPECT_EQ(pane.rows[1].at, (PaneValues{0.8, 0.08, 0.08}));
}

TEST(Products, SayTheSameInEveryFormat) {
  for (const std::string& text : {igsdb_text, optics_text, table_text, idf_text, epjson_text}) {
    const auto products = products_of(text);
    const auto pane = std::ranges::find(products, "Pane", &Product::name);
    expect_pane(pane == products.end() ? products.at(0) : *pane);
    for (const Product& product : products)
      EXPECT_THAT(product.notes, ::testing::Not(::testing::Contains(HasSubstr("##include")))) << product.name;
  }
}

TEST(Products, KnowThicknessAndKind) {
  for (const std::string& text : {igsdb_text, optics_text}) {
    const Product pane = products_of(text).at(0);
    EXPECT_EQ(pane.name, "Pane");
    EXPECT_EQ(pane.manufacturer, "Maker");
    EXPECT_EQ(pane.thickness_mm, 6);
    EXPECT_EQ(pane.kind, PaneKind::clear);
  }
  std::string film = igsdb_text;
  film.replace(film.find("6.0"), 3, "0.1");
  EXPECT_EQ(products_of(film).at(0).thickness_mm, 0.1);
  std::string coated = igsdb_text;
  coated.replace(coated.find("monolithic"), 10, "coated-glass");
  EXPECT_EQ(products_of(coated).at(0).kind, PaneKind::coated);
}

TEST(Products, KnowWhatHeatNeeds) {
  std::string igsdb = igsdb_text;
  igsdb.replace(
      igsdb.find("\"thickness\": 6.0"), 16,
      "\"thickness\": 6.0, \"emissivity_front\": 0.84, \"emissivity_back\": 0.04, \"conductivity\": 0.9, "
      "\"tir_front\": 0.01");
  const PaneHeat expected{0.9, 0.84, 0.04, 0.01};
  EXPECT_EQ(products_of(igsdb).at(0).heat, expected);
  std::string optics = optics_text;
  optics.replace(
      optics.find("{ }"), 3,
      "{ Conductivity } 0.9\n{ IR Transmittance } TIR=0.01\n{ Emissivity, front back } Emis= 0.84 0.04");
  EXPECT_EQ(products_of(optics).at(0).heat, expected);
  EXPECT_FALSE(products_of(optics_text).at(0).heat.emissivity_front);
  EXPECT_EQ(products_of(idf_text).at(0).heat, (PaneHeat{1.0, 0.84, 0.84, 0}));
  EXPECT_EQ(products_of(epjson_text).at(0).heat.emissivity_back, 0.84);
  for (const char* wrong : {"Emis= 1.2 0.84", "Emis= 0.84 x"}) {
    std::string bad = optics;
    bad.replace(bad.find("Emis= 0.84 0.04"), 15, wrong);
    EXPECT_THROW(products_of(bad), Error) << wrong;
  }
}

// LBNL's IGSDB record 5051 declares 0.84 and 0.068; its spectrum gives WinCalc 0.8448 and 0.0685. A flat
// coating of R 0.95 has a normal emissivity of 0.05: 0.05·(1.3217 − 0.09383 + 0.01165 − 0.00073 + 0.00002) =
// 0.06194.
TEST(Products, TakeEmissivitiesFromInfraredSpectra) {
  const OpticalRows rows{
      {300, {0.1, 0.1, 0.1}}, {5000, {0, 0.95, 0.1}}, {10000, {0, 0.95, 0.1}}, {25000, {0, 0.95, 0.1}}};
  PaneHeat heat;
  add_emissivities(heat, rows);
  EXPECT_NEAR(*heat.emissivity_front, 0.06194, 1e-5);
  // 0.9·(0.1569 + 3.39021 − 4.40624 + 1.80304), of glass.
  EXPECT_NEAR(*heat.emissivity_back, 0.84952, 1e-4);
  // 0.5·(1.3217 − 0.9383 + 1.16465 − 0.72936 + 0.17129).
  PaneHeat half;
  add_emissivities(half, {{5000, {0, 0.5, 0.5}}, {25000, {0, 0.5, 0.5}}});
  EXPECT_NEAR(*half.emissivity_front, 0.49499, 1e-5);
  PaneHeat declared{1, 0.84, {}, 0};
  add_emissivities(declared, rows);
  EXPECT_EQ(declared.emissivity_front, 0.84);
  PaneHeat none;
  add_emissivities(none, {{300, {}}, {2500, {}}});
  EXPECT_FALSE(none.emissivity_front);
}

TEST(Products, TellMicrometresFromNanometres) {
  std::string text = optics_text;
  text.replace(text.find("Microns"), 7, "Nanometers");
  for (const auto& [um, nm] : {std::pair{"0.300", "300.0"}, {"0.500", "500.0"}, {"2.500", "2500."}})
    text.replace(text.find(um), 5, nm);
  expect_pane(products_of(text).at(0));
}

TEST(Products, OfEllipsometryHaveAnIndex) {
  const Product glass = products_of(index_text).at(0);
  ASSERT_EQ(glass.index.size(), 3u);
  EXPECT_EQ(glass.index[1].nm, 500);
  EXPECT_EQ(glass.index[1].n, 1.52);
  EXPECT_EQ(glass.index[1].k, 2e-7);
}

TEST(Products, OfAThermochromicGroupComeByTemperature) {
  for (const std::string& text : {idf_text, epjson_text}) {
    const auto products = products_of(text);
    const auto group = std::ranges::find(products, "Warm", &Product::name);
    ASSERT_NE(group, products.end());
    ASSERT_EQ(group->states.size(), 2u);
    EXPECT_EQ(group->states[0].temperature_c, 25);
    expect_pane({.rows = group->states[0].rows});
    EXPECT_EQ(group->states[1].temperature_c, 45);
  }
}

// Whichever temperature is asked for: the curve of clear glass is for groups of clear glass.
TEST(Products, OfAThermochromicGroupAreCoatedWhereAStateIs) {
  const auto group_of = [](const std::string& text) {
    auto products = products_of(text);
    return *std::ranges::find(products, "Warm", &Product::name);
  };
  std::string clear = idf_text;  // the front of its coldest state is now as its back
  clear.replace(clear.find("0.05, 0.06"), 10, "0.06, 0.06");
  EXPECT_EQ(group_of(clear).kind, PaneKind::clear);
  EXPECT_THAT(group_of(clear).notes, ::testing::Contains(HasSubstr("\"Dark\": has averages")));
  std::string warm_coated = clear;
  warm_coated.replace(warm_coated.find("0.179, 0.179"), 12, "0.179, 0.279");
  EXPECT_EQ(group_of(warm_coated).kind, PaneKind::coated);
}

// The two fields of WindowMaterial:Glazing behind those of heat that are about light.
TEST(Products, OfEnergyPlusHaveTheirDirtAndDoNotScatter) {
  const std::string dirt_json = "\"dirt_correction_factor_for_solar_and_visible_transmittance\": ";
  const auto idf = [](const std::string& dirt, const std::string& diffusing) {
    std::string text = idf_text;
    return text.replace(text.find("1.0;"), 4, "1.0, " + dirt + ", " + diffusing + ";");
  };
  const auto epjson = [&](const std::string& dirt, const std::string& diffusing) {
    std::string text = epjson_text;
    return text.replace(text.find("\"optical_data_type\""), 0,
                        dirt_json + dirt + ", \"solar_diffusing\": \"" + diffusing + "\", ");
  };
  const auto pane_of = [](const std::string& text) {
    const TemporaryDirectory directory;
    return read_product(write_text(directory / "windows.txt", text), "Pane");
  };
  for (const std::string& text : {idf("0.85", "No"), epjson("0.85", "No")}) {
    const Product pane = pane_of(text);
    EXPECT_NEAR(pane.rows.at(1).at.t, 0.85 * 0.8, 1e-12);
    EXPECT_THAT(pane.notes, ::testing::Contains(HasSubstr("dirt correction factor 0.85")));
  }
  expect_pane(pane_of(idf("1", "no")));
  for (const std::string& text : {idf("1", "Yes"), epjson("1", "Yes"), idf("0", "No"), idf("1.5", "No")})
    EXPECT_THROW(pane_of(text), Error) << text;
}

// T_vis and T_sol of EnergyPlus' electrochromic and reflective panes, as published.
TEST(Products, OfAveragesGetASpectrumThatHasThem) {
  struct Published {
    double solar_t, visible_t, solar_r, visible_r;
  };
  for (const Published p : {Published{0.814, 0.847, 0.086, 0.099},
                            {0.111, 0.128, 0.179, 0.081},
                            {0.694, 0.818, 0.168, 0.110},
                            {0.099, 0.155, 0.219, 0.073}}) {
    std::vector<std::string> notes;
    const OpticalRows rows =
        band_spectrum({{p.solar_t, p.solar_r, p.solar_r}, {p.visible_t, p.visible_r, p.visible_r}}, notes);
    EXPECT_TRUE(notes.empty());
    SystemSpectrum spectrum;
    for (const OpticalRow& row : rows) {
      spectrum.nm.push_back(row.nm);
      spectrum.values.push_back(row.at);
    }
    const PaneValues sun = average(spectrum, *find_method(nfrc_2003(), "SOLAR"));
    const PaneValues eye = average(spectrum, *find_method(nfrc_2003(), "PHOTOPIC"));
    EXPECT_NEAR(sun.t, p.solar_t, 1e-9);
    EXPECT_NEAR(sun.rf, p.solar_r, 1e-9);
    EXPECT_NEAR(eye.t, p.visible_t, 1e-9);
    EXPECT_NEAR(eye.rb, p.visible_r, 1e-9);
  }
}

TEST(Products, AreBroughtIntoRange) {
  const Product pane =
      products_of("wavelength_nm T Rf Rb\n500 0.5 0.7 -0.01\n400 0 1.5 0.2\n500 0.5 0.7 -0.01\n").at(0);
  ASSERT_EQ(pane.rows.size(), 2u);
  EXPECT_EQ(pane.rows[0].at, (PaneValues{0, 1, 0.2}));
  EXPECT_EQ(pane.rows[1].at, (PaneValues{0.5, 0.5, 0}));
  EXPECT_EQ(pane.notes.size(), 3u);
  EXPECT_NO_THROW(products_of("wavelength_nm T Rf Rb\n500 0.5 0.7 -0.49\n"));
  EXPECT_THROW(products_of("wavelength_nm T Rf Rb\n500 0.5 0.7 -0.5\n"), Error);
  EXPECT_THROW(products_of("wavelength_nm T Rf Rb\n500 0.5 2 0\n"), Error);
}

TEST(Products, AreFoundByName) {
  const TemporaryDirectory directory;
  const auto file = write_text(directory / "windows.idf", idf_text);
  EXPECT_EQ(read_named_product(file.string() + "#dark").name, "Dark");
  EXPECT_THROW(read_named_product(file.string()), Error);
  EXPECT_THROW(read_named_product(file.string() + "#Nothing"), Error);
}

// Twenty names are shown at most.
TEST(Products, AreListedWhereNoneIsNamedSo) {
  const TemporaryDirectory directory;
  std::string text;
  const auto said = [&](int count) {
    for (int i = 0; i < count; ++i)
      text += fmt::format(
          "WindowMaterial:Glazing, Pane {}, SpectralAverage, , 0.006, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1;\n", i);
    try {
      read_named_product(write_text(directory / "windows.idf", text).string() + "#Nothing");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("it was found");
  };
  EXPECT_THAT(said(20),
              AllOf(HasSubstr("\"Pane 0\", \"Pane 1\""), HasSubstr("\"Pane 19\""), Not(HasSubstr("…"))));
  EXPECT_THAT(said(1), HasSubstr("\"Pane 19\", …"));
}

// A building has many panes, of which one is asked for.
TEST(Products, AreReadBesideSomeThatCannotBe) {
  const TemporaryDirectory directory;
  const auto file =
      write_text(directory / "building.idf", "##include more.idf\n" + idf_text +
                                                 "WindowMaterial:Glazing, Bad, BSDF;\n"
                                                 "WindowMaterial:Glazing, Worse, Spectral, x, abc;\n");
  const Product pane = read_product(file, "Pane");
  expect_pane(pane);
  EXPECT_THAT(pane.notes, ::testing::Contains(HasSubstr("##include")));
  try {
    read_product(file, "Bad");
    ADD_FAILURE() << "a BSDF was read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("optical data type \"BSDF\""));
    EXPECT_GT(error.location.line, 1);
  }
  std::string json = epjson_text;
  json.replace(json.find("\"Dark\": {"), 9, "\"Bad\": {\"thickness\": []}, \"Dark\": {");
  const auto epjson = write_text(directory / "building.epJSON", json);
  expect_pane(read_product(epjson, "Pane"));
  EXPECT_THROW(read_product(epjson, "Bad"), Error);
}

struct Wrong {
  std::string text, message;
  int line;
};

// The IGSDB's text, of another type.
std::string with_type(const std::string& type) {
  const std::string end = "\"monolithic\"";
  std::string text = igsdb_text;
  const std::size_t begin = text.find("\"type\"");
  return text.replace(begin, text.find(end) + end.size() - begin, type);
}

TEST(Products, SayWhereAFileIsWrong) {
  std::string bad_row = optics_text, bad_number = igsdb_text, scattering = igsdb_text, percent = table_text;
  bad_row.replace(bad_row.find("0.500 0.8"), 9, "0.500 x.8");
  bad_number.replace(bad_number.find("0.08"), 4, "\"no\"");
  scattering.replace(scattering.find("true"), 4, "false");
  percent.replace(percent.find("0.8"), 3, "80");
  const std::vector<Wrong> wrong{
      {bad_row, "expected wavelength, T, Rf, Rb", 9},
      {bad_number, "/spectral_data/spectral_data/1/Rf: has to be a number", 0},
      {scattering, "scatters", 0},
      {percent, "fractions", 0},
      {"wavelength_nm T Rf Rb\n500 0.5\n", "expected 4 numbers", 2},
      {"500 0.5 0.1 0.1\n", "names of its columns", 1},
      {"", "names of its columns", 0},
      {"{\"spectral_data\": [\n{]}", "is not JSON", 2},
      {"{\"what\": 1}", "neither a product of the IGSDB", 0},
      {"{ Units, Wavelength Units } SI Inches\n", "Microns or Nanometers", 1},
      {"WindowMaterial:Glazing, A, BSDF;\n", "optical data type \"BSDF\"", 1},
      {"\nWindowMaterial:Glazing, A, Spectral, Nowhere;\n", "there is no materialproperty", 2},
      {"WindowMaterial:Glazing, A, Spectral", "has to end with a comma", 1},
      {"IESNA:LM-63-2002\nTILT=NONE\n", "this is the light of a lamp by direction (IES LM-63)", 0},
      {"LOCATION,Own,-,-,own,0,48.86,2.35,1.0,40\n", "this is a weather file (EPW)", 0},
      {"<?xml version=\"1.0\"?>\n<WindowElement>\n", "this is a BSDF as XML", 0},
      {with_type("\"type\": \"shading\", \"subtype\": \"venetian-blind\""),
       "is of the type \"shading\" (\"venetian-blind\"): only glazing is read", 0},
      {with_type("\"type\": \"material\""), "is of the type \"material\": only glazing", 0},
      {with_type("\"type\": \"glazing\", \"subtype\": \"perforated-screen\""), "(\"perforated-screen\")", 0},
  };
  for (const Wrong& w : wrong) {
    try {
      products_of(w.text);
      ADD_FAILURE() << w.text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(w.message));
      EXPECT_EQ(error.location.line, w.line) << error.what();
      EXPECT_THAT(error.location.file, HasSubstr("glazing.txt")) << error.what();
    }
  }
}

}  // namespace
}  // namespace vitrail::test::products_test
