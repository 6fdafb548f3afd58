// SPDX-License-Identifier: Apache-2.0
// The language and the gamma that a scene begins and ends with. Expected are pixels of povray 3.7.0.10 for
// `rgb .4` that glows, of 1, and what it has for `version`.
#include <gtest/gtest.h>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/world.h"
#include "scene/spectra/color.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_versions_test {
namespace {

constexpr double as_said = .4, encoded = .6652;  // by sRGB's curve

struct Row {
  const char* head;
  double version;
  double pixel;  // without assumed_gamma; with 1 it is `encoded`, with 2.2 .4005, with srgb .4
};

const Row rows[] = {
    {"", 3.7, as_said},
    {"#version 3.1;", 3.1, as_said},
    {"#version 3.5;", 3.5, as_said},
    {"#version 3.6;", 3.6, as_said},
    {"#version 3.7;", 3.7, encoded},
    {"#declare X_ = 1;\n#version 3.5;", 3.5, as_said},
    {"#declare X_ = 1;\n#version 3.7;", 3.7, encoded},
    {"#version 3.7;\n#version 3.6;", 3.6, as_said},
    {"#version 3.6;\n#version 3.7;", 3.7, encoded},
    {"sphere { 9, 1 }\n#version 3.6;", 3.6, as_said},
    {"sphere { 9, 1 }\n#version 3.7;", 3.7, encoded},
    {"#declare V = version;\n#version 3.1;\n#version V;", 3.7, encoded},
    {"#declare V = version; #version V;", 3.7, encoded},
    {"#include \"plain.inc\"\n", 3.7, as_said},
    {"#include \"saves.inc\"\n", 3.7, encoded},
    {"#include \"is37.inc\"\n", 3.7, encoded},
    {"#include \"is36.inc\"\n", 3.6, as_said},
    {"#include \"saves.inc\"\n#version 3.6;", 3.6, as_said},
    {"#include \"plain.inc\"\n#version 3.6;", 3.6, as_said},
    {"#version 3.6;\n#include \"saves.inc\"\n", 3.6, as_said},
    {"#version 3.1;\n#include \"saves.inc\"\n", 3.1, as_said},
    {"#version 3.7;\n#include \"saves.inc\"\n", 3.7, encoded},
};

class ReadVersions : public ::testing::Test {
 protected:
  // Reads all of it. What a pixel has for `rgb .4`.
  double pixel(const std::string& text, double* version = nullptr) {
    folder_.write("plain.inc", "#declare A_ = 1;\n");
    folder_.write("saves.inc",
                  "#declare Saved_ = version;\n#version 3.5;\n#declare B_ = 1;\n#version Saved_;\n");
    folder_.write("is36.inc", "#version 3.6;\n#declare C_ = 1;\n");
    folder_.write("is37.inc", "#version 3.7;\n#declare C_ = 1;\n");
    folder_.write("scene.pov", text + "\n#declare Version_ = version;\n");
    pov::Reader reader(folder_ / "scene.pov", {{folder_.path()}}, {});
    reader.for_export = true;  // numbers become light one by one
    pov::read_world(reader);
    if (version) *version = std::get<pov::Numbers>(*reader.symbols().find("Version_")->value()).v[0];
    return srgb_encode(reader.linear(.4));
  }
  TemporaryFolder folder_;
};

TEST_F(ReadVersions, WordAndGamma) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.head);
    double version = 0;
    EXPECT_NEAR(pixel(row.head, &version), row.pixel, 5e-4);
    EXPECT_DOUBLE_EQ(version, row.version);
  }
}

TEST_F(ReadVersions, AssumedGammaGoesFirstWhereverItStands) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.head);
    const std::string head = row.head, begin = "\nglobal_settings { assumed_gamma ";
    EXPECT_NEAR(pixel(head + begin + "1 }"), encoded, 5e-4);
    EXPECT_NEAR(pixel(head + begin + "2.2 }"), .4005, 5e-4);
    EXPECT_NEAR(pixel(head + begin + "srgb }"), .4, 5e-4);
    EXPECT_NEAR(pixel(begin + "1 }\n" + head), encoded, 5e-4);
    EXPECT_NEAR(pixel(begin + "2.2 }\n" + head), .4005, 5e-4);
  }
}

// What is said last holds for all that was read.
TEST_F(ReadVersions, AtTheEnd) {
  for (const Row& row : rows) {
    SCOPED_TRACE(row.head);
    EXPECT_NEAR(pixel(row.head + std::string("\nsphere { 0, 1 }\n#version 3.6;")), as_said, 5e-4);
    EXPECT_NEAR(pixel(row.head + std::string("\nsphere { 0, 1 }\n#version 3.7;")), encoded, 5e-4);
  }
}

}  // namespace
}  // namespace vitrail::read_versions_test
