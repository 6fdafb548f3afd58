// SPDX-License-Identifier: Apache-2.0
// Bad input stops with the place of the offender, its line, and what to do about it.
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_errors_test {
namespace {

struct Case {
  const char* name;
  std::string text;
  int line, column;
  const char* message;
};

const std::string start = "Film \"rgb\"\nWorldBegin\n";

std::vector<Case> cases() {
  return {
      {"UnknownDirective", start + "  Shpe \"sphere\"", 3, 3, "did you mean Shape?"},
      {"DirectiveInQuotes", start + "\"Shape\"", 3, 1, "expected a directive"},
      {"StrayBracket", start + "Translate 1 2 3 ]", 3, 17, "expected a directive, found ']'"},
      {"TooFewNumbers", start + "Translate 1 2 Shape", 3, 15, "expected 3 numbers, found 2 and then 'Shape'"},
      {"TooFewInBrackets", start + "Translate [1 2 ]", 3, 16, "expected 3 numbers, found 2 and then ']'"},
      {"TooManyInBrackets", start + "Translate [1 2 3 4]", 3, 18, "expected ']' after 3 numbers"},
      {"NotANumber", start + "Translate 1 nan 3", 3, 13, "not finite"},
      {"TruncatedMatrix", start + "Transform [1 0 0 0", 3, 19, "the end of the file"},
      {"TruncatedList", start + "Shape \"sphere\" \"float radius\" [1", 3, 33, "the end of the file"},
      {"TruncatedString", start + "Shape \"sph", 3, 7, "no closing quote"},
      {"NameMissing", start + "Shape 3", 3, 7, "expected a kind of shape in quotes, found '3'"},
      {"UnknownType", start + "Shape \"sphere\" \"flot radius\" 1", 3, 16, "did you mean \"float\"?"},
      {"WrongValue", start + "Shape \"sphere\" \"float radius\" \"big\"", 3, 31, "expected a number"},
      {"TwoValues", start + "Shape \"sphere\"\n \"float radius\" [1 2]", 4, 2, "needs 1 value, has 2"},
      {"SingularScale", start + "Translate 1 1 1\nScale 1 0 1", 4, 1, "singular"},
      {"ZeroAxis", start + "Rotate 90 0 0 0", 3, 1, "axis of the rotation is zero"},
      {"LookAtNowhere", start + "LookAt 1 1 1 1 1 1 0 1 0", 3, 1, "no direction"},
      {"LookAtAlongUp", start + "LookAt 0 0 0 0 5 0 0 1 0", 3, 1, "no direction"},
      {"UnopenedEnd", start + "AttributeEnd", 3, 1, "AttributeEnd without AttributeBegin"},
      {"CrossedBlocks", start + "AttributeBegin\nTransformBegin\nAttributeEnd", 5, 1,
       "in the block that begins at"},
      {"Unclosed", start + "AttributeBegin\n Shape \"sphere\"\n", 3, 1, "before this block is closed"},
      {"NestedObjects", start + "ObjectBegin \"a\" ObjectBegin \"b\"", 3, 17, "inside of another object"},
      {"UnknownObject", start + "ObjectBegin \"tree\" ObjectEnd\nObjectInstance \"tre\"", 4, 1,
       "did you mean \"tree\"?"},
      {"UnknownMaterial", start + "NamedMaterial \"wood\"", 3, 1, "material \"wood\" is not defined"},
      {"UnknownTexture", start + "Material \"diffuse\" \"texture reflectance\" \"wood\"", 3, 20,
       "texture \"wood\" is not"},
      {"MaterialWithoutType", start + "MakeNamedMaterial \"m\"", 3, 1, "string type"},
      {"UnknownColourSpace", start + "ColorSpace \"adobe\"", 3, 1, "adobe"},
      {"SecondWorld", start + "WorldBegin", 3, 1, "second time"},
      {"WorldEndAlone", "Film \"image\"\nWorldEnd", 2, 1, "without WorldBegin"},
      {"MissingInclude", start + "Include \"none.pbrt\"", 3, 1, "cannot find the included file"},
      {"IncludeOfItself", start + "\nInclude \"scene.pbrt\"", 4, 1, "includes itself"},
      {"MissingPly", start + "Shape \"plymesh\" \"string filename\" \"none.ply\"", 3, 17,
       "cannot find the file"},
      {"MissingSpectrum", start + "LightSource \"point\" \"spectrum I\" \"none.spd\"", 3, 21,
       "neither a spectrum"},
      {"NoPoints", start + "Shape \"trianglemesh\" \"integer indices\" [0 1 2]", 3, 1,
       "needs a parameter \"P\""},
      {"NoIndices", start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 1 1]", 3, 1,
       "needs a parameter \"indices\""},
      {"RaggedPoints", start + "Shape \"trianglemesh\" \"integer indices\" [0 0 0]\n\"point3 P\" [0 0 0 1]",
       4, 1, "has 4 numbers, which is not a multiple of 3"},
      {"RaggedIndices",
       start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1]", 3, 53,
       "not a multiple of 3"},
      {"IndexTooLarge",
       start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 3]", 3, 53,
       "is 3, but there are 3 vertices"},
      {"IndexNegative",
       start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 -1 2]", 3, 53,
       "is -1"},
      {"TooFewNormals",
       start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"normal N\" [0 0 1]", 3, 53,
       "values for 1 vertices, but there are 3"},
      {"NanVertex", start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 nan 0 0 1 0]", 3, 42, "not finite"},
      {"InfiniteFloat", start + "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e39 0 0 0 1 0]", 3, 22,
       "too large"},
      {"BadSphere", start + "Shape \"sphere\" \"float radius\" 0", 3, 1, "radius"},
      {"UnsortedSpectrum", start + "LightSource \"point\" \"spectrum I\" [500 1 400 1]", 3, 21, ""},
      {"OddSpectrum", start + "LightSource \"point\" \"spectrum I\" [500 1 600]", 3, 21,
       "pairs of wavelength and value"},
      {"TwoColours", start + "LightSource \"point\" \"rgb I\" [1 1]", 3, 21, "needs 3 values, has 2"},
      {"ColdBlackbody", start + "LightSource \"point\" \"blackbody I\" [0]", 3, 21, "above 0 K"},
      {"DistantNowhere", start + "LightSource \"distant\" \"point3 to\" [0 0 0]", 3, 1,
       "two different points"},
      {"WideCamera", "Film \"rgb\" Camera \"perspective\" \"float fov\" 180", 1, 12, "field of view"},
      {"NoPixels", "Film \"rgb\" \"integer xresolution\" 0", 1, 1, "\"xresolution\" is 0"},
      {"EmptyCrop", "Film \"rgb\" \"float cropwindow\" [.5 .5 0 1]", 1, 1, "leaves no pixels"},
      {"NoSamples", "Sampler \"zsobol\" \"integer pixelsamples\" 0", 1, 1, "0 samples"},
      {"MixOfItself",
       start + "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"]", 3, 1,
       "contains itself"},
      {"NotText",
       std::string("\x7f"
                   "ELF\x02\x01\x00\x00",
                   8),
       1, 1, "unknown directive"},
  };
}

class PbrtErrors : public ::testing::TestWithParam<Case> {};

TEST_P(PbrtErrors, HaveTheirPlace) {
  const Case& c = GetParam();
  try {
    import_text(c.text);
    FAIL() << "nothing is thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.location.line, c.line);
    EXPECT_EQ(error.location.column, c.column);
    EXPECT_THAT(error.location.file, ::testing::EndsWith("scene.pbrt"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr(c.message));
  }
}

INSTANTIATE_TEST_SUITE_P(All, PbrtErrors, ::testing::ValuesIn(cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(PbrtErrorExcerpts, AreTheLineOfTheOffender) {
  try {
    import_text(start + "# before\nTranslate 1 2 x # here\n# after");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.excerpt, "Translate 1 2 x # here");
  }
}

TEST(PbrtErrorExcerpts, AreCutFromLongLines) {
  const std::string filler(5000, ' ');
  try {
    import_text(start + filler + "Shpe" + filler);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.excerpt, ::testing::HasSubstr("Shpe"));
    EXPECT_LE(error.excerpt.size(), 100u);
  }
}

TEST(PbrtErrorPlaces, AreThoseOfIncludedFiles) {
  const TemporaryFolder folder;
  folder.write("part.pbrt", "\n Scale 0 0 0");
  try {
    read_pbrt(folder.write("scene.pbrt", "WorldBegin Include \"part.pbrt\""));
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(to_string(error.location), ::testing::EndsWith("part.pbrt:2:2"));
  }
}

TEST(PbrtErrorPlaces, IncludesAreNotFollowedForever) {
  const TemporaryFolder folder;
  for (int i = 0; i < 70; ++i)
    folder.write(std::to_string(i) + ".pbrt", "Include \"" + std::to_string(i + 1) + ".pbrt\"");
  EXPECT_THROW(read_pbrt(folder.path() / "0.pbrt"), Error);
  folder.write("a.pbrt", "Include \"b.pbrt\"");
  folder.write("b.pbrt", "Import \"a.pbrt\"");
  EXPECT_THROW(read_pbrt(folder.path() / "a.pbrt"), Error);
}

TEST(PbrtErrorPlaces, ImportsCloseTheirBlocks) {
  const TemporaryFolder folder;
  folder.write("open.pbrt", "AttributeBegin");
  folder.write("closed.pbrt", "AttributeEnd");
  EXPECT_THROW(read_pbrt(folder.write("1.pbrt", "Import \"open.pbrt\"")), Error);
  EXPECT_THROW(read_pbrt(folder.write("2.pbrt", "AttributeBegin Import \"closed.pbrt\"")), Error);
  EXPECT_NO_THROW(read_pbrt(folder.write("3.pbrt", "Include \"open.pbrt\" Include \"closed.pbrt\"")));
}

// Whatever is cut off or changed, the reader ends with a scene or an Error.
TEST(PbrtErrorPlaces, DamagedFilesNeverCrash) {
  const std::string good =
      "Film \"rgb\" \"integer xresolution\" [8] \"float cropwindow\" [0 1 0 1]\nLookAt 0 0 5 0 0 0 0 1 0\n"
      "Camera \"perspective\" \"float fov\" 40\nWorldBegin # world\nLightSource \"point\" \"blackbody I\" "
      "[3000]\n"
      "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 0 0]\nMakeNamedMaterial \"m\" \"string "
      "type\" \"mix\" "
      "\"string materials\" [\"a\" \"a\"] MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"texture "
      "reflectance\" "
      "\"t\"\nObjectBegin \"o\" NamedMaterial \"m\" " +
      triangle +
      "ObjectEnd AttributeBegin Translate 1 2 3 "
      "ObjectInstance \"o\" AttributeEnd\n";
  const std::string letters = "[]\"# \n-9e.\\a";
  int imported = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string text = good;
    if (i % 3 == 0) text.resize(i);
    if (i % 3 == 1) text[i] = letters[i % letters.size()];
    if (i % 3 == 2) text.erase(i, 1);
    try {
      import_text(text);
      ++imported;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(imported, 50);
  EXPECT_NO_THROW(import_text(good));
}

}  // namespace
}  // namespace vitrail::pbrt_errors_test
