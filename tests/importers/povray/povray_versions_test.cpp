// SPDX-License-Identifier: Apache-2.0
// What #version decides, as povray shows it: whether there is one, where it stands, and includes that change
// it.
#include "tests/importers/povray/povray_pictures.h"

namespace vitrail::povray_versions_test {
namespace {

using PovrayVersions = PovrayPictures;

const std::string lit =
    raised_camera + two_lamps +
    "plane { y, 0 pigment { checker rgb <.8, .7, .6>, rgb <.3, .4, .2> } finish { ambient .15 diffuse .7 } "
    "}\n"
    "sphere { <-.6, .7, 0>, .7 pigment { rgb <.9, .4, .2> } finish { ambient .2 diffuse .6 } }\n";

TEST_F(PovrayVersions, LightOfScenesThatSayItSomewhere) {
  folder_.write("plain.inc", "#declare A_ = 1;\n");
  folder_.write("old.inc", "#version 3.5;\n#declare A_ = 1;\n");
  for (const char* head : {"", "#include \"plain.inc\"\n", "#include \"colors.inc\"\n",
                           "#include \"old.inc\"\n", "#include \"colors.inc\"\n#version 3.6;\n",
                           "#version 3.6;\n#include \"colors.inc\"\n", "#declare V = version; #version V;\n",
                           "#include \"colors.inc\"\nglobal_settings { assumed_gamma 2.2 }\n"})
    expect_alike(head + lit, 0.02);
}

// Before 3.7 a colour with a filter shows more of itself.
TEST_F(PovrayVersions, WhatFiltersShowOfThemselves) {
  for (const char* version : {"", "#version 3.5;", "#version 3.6;", "#version 3.7;"})
    for (const char* color : {"rgbf <.8, .4, .2, .5>", "rgbf <.8, .4, .2, 1>", "rgbft <.8, .4, .2, .3, .4>",
                              "rgbt <.8, .4, .2, .5>"})
      expect_alike(std::string(version) + "\nglobal_settings { assumed_gamma 1 }\n" + lit +
                       "box { <-1.5, 0, -1.01>, <1.5, 1.5, -1> pigment { " + color +
                       " } finish { ambient .5 diffuse .3 } }",
                   0.04);
}

}  // namespace
}  // namespace vitrail::povray_versions_test
