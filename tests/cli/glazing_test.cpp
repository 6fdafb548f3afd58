// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/glazing/glazing_files.h"
#include "tests/support/command.h"

namespace vitrail::test::glazing_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Glazing, PrintsATableAndJson) {
  const TemporaryDirectory directory;
  const auto pane = write_text(directory / "pane.dat", optics_text);
  const std::string line =
      fmt::format("{} '{}' '{}' --theta 0 60", vitrail("glazing"), pane.string(), pane.string());
  const CommandResult table = run(line);
  EXPECT_EQ(table.status, 0) << table.output;
  EXPECT_THAT(table.output, HasSubstr("pane 2: Pane, clear"));
  EXPECT_THAT(table.output, HasSubstr("at 60°"));
  EXPECT_THAT(table.output, HasSubstr("dominant wavelength"));
  const CommandResult printed = run(line + " --json");
  const auto json = nlohmann::json::parse(printed.output);
  ASSERT_EQ(json.at("results").size(), 4u);
  EXPECT_LT(json["results"][1]["photopic"]["transmittance"], json["results"][0]["photopic"]["transmittance"]);
}

// The spectra are a product again, with the same numbers.
TEST(Glazing, ItsSpectraAreReadBack) {
  const TemporaryDirectory directory;
  const auto pane = write_text(directory / "pane.dat", optics_text);
  const std::string csv = (directory / "system.csv").string();
  const auto json_of = [&](const std::string& arguments) {
    const CommandResult result = run(fmt::format("{} --json {}", vitrail("glazing"), arguments));
    EXPECT_EQ(result.status, 0) << result.output;
    return nlohmann::json::parse(result.output).at("results").at(0);
  };
  const auto first = json_of(fmt::format("'{0}' '{0}' --flip 1 --csv '{1}'", pane.string(), csv));
  const auto again = json_of(fmt::format("'{}'", csv));
  for (const char* method : {"solar", "photopic", "tuv"})
    for (const char* value : {"transmittance", "reflectance_front", "reflectance_back"})
      EXPECT_NEAR(first.at(method).at(value).get<double>(), again.at(method).at(value).get<double>(), 1e-6);
}

TEST(Glazing, SaysWhatIsWrong) {
  const TemporaryDirectory directory;
  const std::string pane = write_text(directory / "pane.dat", optics_text).string();
  const std::string verb = vitrail("glazing");
  EXPECT_EQ(run(verb).status, 2);
  EXPECT_EQ(run(fmt::format("{} '{}' --theta 91", verb, pane)).status, 2);
  for (const char* option : {"--theta nan", "--state nan", "--temperature nan", "--temperature inf"}) {
    const CommandResult result = run(fmt::format("{} '{}' {}", verb, pane, option));
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.output, HasSubstr("finite")) << option;
  }
  EXPECT_EQ(run(fmt::format("{} '{}' --flip 2", verb, pane)).status, 2);
  EXPECT_EQ(run(fmt::format("{} '{}' --csv '{}'", verb, pane, pane)).status, 3);
  EXPECT_EQ(run(fmt::format("{} '{}' --csv '{}' --force", verb, pane, pane)).status, 2);
  EXPECT_EQ(run(fmt::format("{} '{}' --standard none.std", verb, pane)).status, 3);
  const CommandResult missing = run(fmt::format("{} '{}/none.dat'", verb, directory.path().string()));
  EXPECT_EQ(missing.status, 3);
  EXPECT_THAT(missing.output, HasSubstr("none.dat: there is no such file"));
}

TEST(Glazing, WritesADataSheet) {
  const TemporaryDirectory directory;
  std::string text = optics_text;
  text.replace(text.find("{ }"), 3, "{ Emissivity, front back } Emis= 0.84 0.84");
  text.replace(text.find("Product Name: Pane"), 18, "Product Name: <b>Pane");
  const std::string pane = write_text(directory / "pane.dat", text).string();
  const fs::path page = directory / "sheet.html", json = directory / "sheet.json";
  const std::string line = fmt::format("{} '{}' '{}'", vitrail("glazing"), pane, pane);
  const CommandResult first =
      run(fmt::format("{} --gap 12.7:argon=0.9,air=0.1 --report '{}'", line, page.string()));
  EXPECT_EQ(first.status, 0) << first.output;
  const std::string html = text_of(page);
  for (const char* part : {"<svg", "SHGC", "EN 673", "ISO 9050:2003", "12.7 mm argon 90 %, air 10 %",
                           "&lt;b&gt;Pane", "What the abbreviations mean", "</html>"})
    EXPECT_THAT(html, HasSubstr(part));
  for (const char* outside : {"<script", "src=", "href=", "<b>Pane"})
    EXPECT_THAT(html, ::testing::Not(HasSubstr(outside)));
  const fs::path idf = directory / "out.idf";
  EXPECT_EQ(
      run(fmt::format("{} --gap 12.7 --report '{}' --energyplus '{}'", line, json.string(), idf.string()))
          .status,
      0);
  EXPECT_THAT(text_of(idf), HasSubstr("WindowMaterial:Gas,\n  Glazing gap 1, Air, 0.0127;"));
  const auto sheet = read_json(json);
  const auto& state = sheet.at("states").at(0);
  EXPECT_NEAR(state.at("u_nfrc").get<double>(), 2.69, 0.03);  // two of 6 mm and 12.7 mm of air
  EXPECT_EQ(state.at("angles").size(), 11u);
  EXPECT_EQ(state.at("winter_celsius").size(), 2u);
}

TEST(Glazing, ADataSheetWithoutHeatSaysWhatIsMissing) {
  const TemporaryDirectory directory;
  const std::string pane = write_text(directory / "pane.dat", optics_text).string();
  const fs::path page = directory / "sheet.html";
  const std::string verb = vitrail("glazing");
  const CommandResult result = run(fmt::format("{} '{}' --report '{}'", verb, pane, page.string()));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.output, HasSubstr("no figures of heat: pane 1 (\"Pane\") does not say its emissivity"));
  EXPECT_THAT(text_of(page), HasSubstr("There are no figures of heat"));
  EXPECT_EQ(run(fmt::format("{} '{}' --report '{}.txt'", verb, pane, page.string())).status, 2);
  for (const char* gap : {"--gap 12.7", "--gap 0 --gap 1", "--gap 12:helium --gap 12", "--gap x --gap 2"})
    EXPECT_EQ(run(fmt::format("{0} '{1}' '{1}' '{1}' {2}", verb, pane, gap)).status, 2) << gap;
}

TEST(Glazing, FlipsEachPaneThatIsNamed) {
  const TemporaryDirectory directory;
  const std::string pane = write_text(directory / "pane.dat", optics_text).string();
  const CommandResult result =
      run(fmt::format("{0} '{1}' '{1}' --flip 1 --flip 2", vitrail("glazing"), pane));
  EXPECT_THAT(result.output, HasSubstr("pane 1: Pane, clear, flipped"));
  EXPECT_THAT(result.output, HasSubstr("pane 2: Pane, clear, flipped"));
}

TEST(Glazing, ReflectsAllAtGrazingIncidence) {
  const TemporaryDirectory directory;
  std::string dull = optics_text;  // without reflection Fresnel's equations are 0/0 there
  const auto pane =
      write_text(directory / "pane.dat", dull.replace(dull.find("0.8 0.08 0.08"), 13, "0.8 0.00 0.00"));
  const CommandResult printed =
      run(fmt::format("{} '{}' --theta 90 --json", vitrail("glazing"), pane.string()));
  const auto photopic = nlohmann::json::parse(printed.output).at("results").at(0).at("photopic");
  EXPECT_EQ(photopic.at("transmittance"), 0.0);
  EXPECT_EQ(photopic.at("reflectance_front"), 1.0);
}

// A product takes its file's name, whatever bytes that has.
TEST(Glazing, PrintsJsonOfNamesThatAreNotUtf8) {
  const TemporaryDirectory directory;
  const auto pane = write_text(directory / "pane\xff.txt", table_text);
  const CommandResult printed = run(fmt::format("{} '{}' --json", vitrail("glazing"), pane.string()));
  EXPECT_EQ(printed.status, 0) << printed.output;
  EXPECT_EQ(nlohmann::json::parse(printed.output).at("panes").at(0).at("name"), "pane\ufffd");
}

// Of light alone, as rays have it: infrared is not missed.
TEST(Glazing, OfASceneIsSaidToBeHeldBeyondItsData) {
  const TemporaryDirectory directory;
  write_text(directory / "narrow.txt", "wavelength_nm T R\n400 0.5 0.2\n700 0.6 0.1\n");
  write_text(directory / "light.txt", "wavelength_nm T R\n360 0.5 0.2\n830 0.6 0.1\n");
  const auto said_of = [&](const std::string& pane) {
    const auto scene = write_text(directory / "scene.pbrt",
                                  "WorldBegin\nMaterial \"thindielectric\" \"string glazing\" \"" + pane +
                                      "\"\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] "
                                      "\"integer indices\" [0 1 2]\n");
    return run(fmt::format("{} '{}' -o '{}'", vitrail("convert"), scene.string(),
                           (directory / "scene.xml").string()))
        .output;
  };
  EXPECT_THAT(said_of("narrow.txt"), HasSubstr("values are held beyond 400 to 700 nm"));
  EXPECT_THAT(said_of("light.txt"), ::testing::Not(HasSubstr("held")));
}

}  // namespace
}  // namespace vitrail::test::glazing_test
