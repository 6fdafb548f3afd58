// SPDX-License-Identifier: Apache-2.0
// Words, strings, numbers and places; parameter lists; the version's tell-tale words.
#include "importers/pbrt/read/lexer.h"

#include <gmock/gmock.h>

#include "importers/pbrt/read/parameters.h"
#include "importers/pbrt/read/version.h"
#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt::pbrt_lexer_test {
namespace {

struct Text {
  explicit Text(std::string content)
      : text(std::move(content)), lexer(&name, text.data(), text.data() + text.size()) {}
  std::string name = "no such file", text;
  Lexer lexer;
};

std::vector<std::string> words(const std::string& content) {
  Text text(content);
  std::vector<std::string> result;
  for (Token token = text.lexer.next(); token.kind != TokenKind::end; token = text.lexer.next())
    result.emplace_back(token.text);
  return result;
}

using ::testing::ElementsAre;

TEST(PbrtLexer, SplitsWordsBracketsAndStrings) {
  EXPECT_THAT(words("Shape\"sphere\"[1 2]\tTranslate"),
              ElementsAre("Shape", "sphere", "[", "1", "2", "]", "Translate"));
  EXPECT_THAT(words(""), ElementsAre());
  EXPECT_THAT(words(" \r\n\t\v\f "), ElementsAre());
}

TEST(PbrtLexer, SkipsCommentsButNotInStrings) {
  EXPECT_THAT(words("A # \"x\" [\n#\n#B\nC#D\r\nE \"#F\" #"), ElementsAre("A", "C", "E", "#F"));
}

TEST(PbrtLexer, SkipsTheByteOrderMark) {
  Text text("\xEF\xBB\xBFWorldBegin");
  const Token token = text.lexer.next();
  EXPECT_EQ(token.text, "WorldBegin");
  EXPECT_EQ(token.place.column, 1);
}

TEST(PbrtLexer, ReplacesEscapes) {
  EXPECT_THAT(words(R"("a\"b\\c\td\ne\'" "z")"), ElementsAre("a\"b\\c\td\ne'", "z"));
}

TEST(PbrtLexer, CountsLinesOfEveryConvention) {
  Text text("a\nb\r\n  c\rd \"e\"");
  std::vector<std::pair<int, int>> places;
  for (Token token = text.lexer.next(); token.kind != TokenKind::end; token = text.lexer.next())
    places.emplace_back(token.place.line, token.place.column);
  EXPECT_THAT(places, ElementsAre(std::pair(1, 1), std::pair(2, 1), std::pair(3, 3), std::pair(4, 1),
                                  std::pair(4, 3)));
}

TEST(PbrtLexer, ReadsNumbers) {
  Text text("1 -2.5 +3 .5 1e-3 1.E2 7]x");
  std::vector<double> numbers;
  for (double number = 0; text.lexer.next_number(number);) numbers.push_back(number);
  EXPECT_THAT(numbers, ElementsAre(1, -2.5, 3, .5, 1e-3, 100, 7));
  EXPECT_EQ(text.lexer.next().kind, TokenKind::close);
  EXPECT_EQ(text.lexer.next().text, "x");
}

TEST(PbrtLexer, RefusesWhatIsNotAFiniteNumber) {
  for (const char* wrong : {"1.2.3", "1x", "nan", "inf", "-inf", "1e999", "-", "+-1", "0x10", "1,2", "--1"}) {
    Text text(std::string("\n ") + wrong + " 2");
    double number = 0;
    try {
      EXPECT_FALSE(text.lexer.next_number(number)) << wrong;
      ADD_FAILURE() << wrong << " passes";
    } catch (const Error& error) {
      EXPECT_EQ(error.location.line, 2) << wrong;
      EXPECT_EQ(error.location.column, 2) << wrong;
    }
  }
}

TEST(PbrtLexer, RefusesStringsThatDoNotEnd) {
  EXPECT_THROW(words("\"abc"), Error);
  EXPECT_THROW(words("\"abc\ndef\""), Error);
  EXPECT_THROW(words("\"abc\\\ndef\""), Error);
  EXPECT_THROW(words("\"abc\\"), Error);
}

// ---- Parameters
// -----------------------------------------------------------------------------------------------

struct Parameters {
  explicit Parameters(const std::string& text)
      : tokens(folder.write("parameters", text), 1 << 20), list(read_parameters(tokens, report)) {}
  TemporaryFolder folder;
  TokenStream tokens;
  Report report;
  std::vector<Parameter> list;
};

TEST(PbrtParameters, TakeBareAndBracketedValues) {
  const Parameters p(R"("float a" 1 "float b" [2] "point3 P" [1 2 3 4 5 6] "string s" "x" "string t" ["y" "z"]
                        "bool c" true "bool d" ["false"] "bool e" "true" "integer i" [] "color k" [1 2 3])");
  ASSERT_EQ(p.list.size(), 10u);
  EXPECT_THAT(p.list[0].numbers, ElementsAre(1));
  EXPECT_THAT(p.list[1].numbers, ElementsAre(2));
  EXPECT_THAT(p.list[2].numbers, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(p.list[3].strings, ElementsAre("x"));
  EXPECT_THAT(p.list[4].strings, ElementsAre("y", "z"));
  EXPECT_THAT(p.list[5].numbers, ElementsAre(1));
  EXPECT_THAT(p.list[6].numbers, ElementsAre(0));
  EXPECT_THAT(p.list[7].numbers, ElementsAre(1));
  EXPECT_TRUE(p.list[8].numbers.empty());
  EXPECT_EQ(p.list[9].type, ParameterType::rgb);
  EXPECT_EQ(p.list[9].place.line, 2);
}

TEST(PbrtParameters, DeclarationsMayHaveBlanksAroundTheirWords) {
  const Parameters p("\"  float \t radius \" 3");
  ASSERT_EQ(p.list.size(), 1u);
  EXPECT_EQ(p.list[0].name, "radius");
}

TEST(PbrtParameters, FractionsOfIntegersAreCutOffAndReported) {
  Parameters p("\"integer i\" [1.75 -2.5 1e3]");
  EXPECT_THAT(p.list[0].numbers, ElementsAre(1, -2, 1000));
  EXPECT_EQ(p.report.take().size(), 1u);
}

TEST(PbrtParameters, RefuseValuesOfTheWrongKind) {
  for (const char* wrong :
       {"\"float a\" true", "\"float a\" [1 \"b\"]", "\"string s\" 1", "\"bool b\" 1", "\"float a\" [1",
        "\"float a\"", "\"float a\" [[1]]", "\"flaot a\" 1", "\"float\" 1", "\"\" 1", "\"integer i\" 1e10",
        "\"spectrum s\" [1 2 \"x\"]", "\"bool b\" \"yes\""})
    EXPECT_THROW(Parameters{wrong}, Error) << wrong;
}

TEST(PbrtParameters, SuggestTypesThatAreSpelledWrongly) {
  try {
    const Parameters parameters{"\"flot radius\" 1"};
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean \"float\""));
  }
}

TEST(PbrtParameters, TheLastOfANameCountsAndUnusedOnesAreReported) {
  Parameters p(
      "\"float radius\" 1 \"float radius\" 2 \"float radios\" 3 \"string height\" \"x\" \"integer n\" 4");
  ParameterSet set("Shape \"disk\"", {}, p.list);
  EXPECT_EQ(set.number("radius", 0), 2);
  EXPECT_EQ(set.number("height", 7), 7);
  set.ignore({"n"});
  set.report_unused(p.report);
  const Diagnostics diagnostics = p.report.take();
  ASSERT_EQ(diagnostics.size(), 3u);
  EXPECT_THAT(diagnostics[0].message,
              ::testing::HasSubstr("\"radius\" of Shape \"disk\" is given more than once"));
  EXPECT_THAT(diagnostics[1].message, ::testing::HasSubstr("did you mean \"radius\"?"));
  EXPECT_THAT(diagnostics[2].message, ::testing::HasSubstr("has a type that is not read here"));
  for (const Diagnostic& d : diagnostics) EXPECT_EQ(d.fidelity, Fidelity::dropped);
}

TEST(PbrtReport, SaysWhichDirectiveItIsAbout) {
  const std::string file = "scene.pbrt";
  Report report;
  report.begin_item({&file, 7, 2});
  report.dropped("curves", {&file, 8, 1});
  const Diagnostics diagnostics = report.take();
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(to_string(diagnostics[0].location), "scene.pbrt:8:1");
  EXPECT_EQ(to_string(diagnostics[0].item), "scene.pbrt:7:2");
}

// ---- Versions
// -------------------------------------------------------------------------------------------------

TEST(PbrtVersion, FollowsTheFirstTellTaleWord) {
  const auto detected = [](const std::string& text) {
    const TemporaryFolder folder;
    const DetectedVersion found = detect_version(folder.write("scene.pbrt", text));
    return !found.certain ? "?" : found.version == Version::v3 ? "v3" : "v4";
  };
  EXPECT_STREQ(detected("Film \"image\""), "v3");
  EXPECT_STREQ(detected("Film \"rgb\" WorldEnd"), "v4");
  EXPECT_STREQ(detected("WorldBegin Shape \"sphere\" WorldEnd"), "v3");
  EXPECT_STREQ(detected("Shape \"trianglemesh\" \"point P\" [0 0 0]"), "v3");
  EXPECT_STREQ(detected("Shape \"trianglemesh\" \"point3 P\" [0 0 0] Material \"diffuse\""), "v4");
  EXPECT_STREQ(detected("MakeNamedMaterial \"image\" \"string type\" [\"matte\"]"), "v3");
  EXPECT_STREQ(detected("MakeNamedMaterial \"matte\" \"string type\" \"diffuse\""), "v4");
  EXPECT_STREQ(detected("Translate .5 -1 2 Material \"glass\""), "v3");
  EXPECT_STREQ(detected("Shape \"x\" \"integer i\" [1 # ] WorldEnd\n 2] ColorSpace \"srgb\""), "v4");
  EXPECT_STREQ(detected("# WorldEnd\nShape \"sphere\" \"string s\" \"WorldEnd\""), "?");
}

}  // namespace
}  // namespace vitrail::pbrt::pbrt_lexer_test
