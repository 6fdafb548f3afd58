// SPDX-License-Identifier: Apache-2.0
// A scene of a few bytes, or of one line that repeats, ends with an error and its place: no recursion of the
// reader, and of whoever walks what was read, has no end.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "importers/povray/read/levels.h"
#include "importers/povray/read/povray.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_nesting_test {
namespace {

class ReadNesting : public ::testing::Test {
 protected:
  std::string refusal(const std::string& text) {
    try {
      read_povray(folder_.write("scene.pov", text));
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  void expect_refused(const std::string& text, const std::string& reason) {
    EXPECT_NE(refusal(text).find(reason), std::string::npos) << text.substr(0, 200) << "\n" << refusal(text);
  }
  TemporaryFolder folder_;
};

std::string times(int count, const std::string& text) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// Casts of such numbers are undefined.
TEST_F(ReadNesting, WholeNumbersBeyondThoseThatThereAre) {
  for (const char* same : {"rand(seed(1e111)) = rand(seed(9e18))", "rand(seed(acosh(0))) = rand(seed(0))",
                           "strlen(vstr(1e30, <1,2,3,4,5>, \" \", 0, 0)) = 9", "bitwise_or(acosh(0), 4) = 4",
                           "strlen(str(1, acosh(0), 0)) = 1"})
    expect_refused(fmt::format("#if ({}) #error \"the same\" #end", same), "the same");
}

// The argument of a directive runs over the end of the loop that it stands in, and meets itself.
TEST_F(ReadNesting, ArgumentsBeyondTheirLoop) {
  for (const char* directive : {"#declare", "#local", "#undef", "#debug", "#include", "#default", "#version",
                                "#fopen", "#write(", "#read("})
    for (const char* loop : {"#while (1) {} #end", "#for (I, 1, 1000000) {} #end"})
      expect_refused(fmt::format(fmt::runtime(loop), directive), "too deep");
  expect_refused("#declare X = array[2] {1, 2}; #while (X[0] < 3) #declare #end sphere { 0, 1 }", "too deep");
}

TEST_F(ReadNesting, ExpressionsWithinEachOther) {
  constexpr int many = 200'000;
  for (const auto& [begin, end] : {std::pair{times(many, "-"), "1;"},
                                   {times(many, "+"), "1;"},
                                   {times(many, "!"), "1;"},
                                   {times(many, "1 ? "), "1;"},
                                   {times(many, "1 ? 1 : "), "1;"},
                                   {times(many, "concat("), ";"},
                                   {times(many, "strupr("), ";"},
                                   {times(many, "substr("), ";"},
                                   {times(many, "abs("), ";"},
                                   {times(many, "("), ";"},
                                   {times(many, "{"), ";"},
                                   {"array" + times(many, "[1]") + times(many, "{"), ";"}})
    expect_refused("#declare S = " + begin + end, "");
  for (const char* open :
       {"#declare A = ", "#declare A[", "#if (", "union {", "#declare F = function { pigment { "})
    EXPECT_FALSE(refusal("#declare A = array[1] {0};" + times(many, open)).empty()) << open;
}

// As long a chain as there may be is read, walked and freed; a longer one is refused.
TEST_F(ReadNesting, ThingsDeclaredOfEachOther) {
  for (const auto& [first, next, used] : {
           std::array<const char*, 3>{"sphere { 0, 1 }", "union { object { T } }", "object { T }"},
           {"sphere { 0, 1 }", "union { object { T } sphere { I, 1 } }", "object { T }"},
           {"array[1] {1}", "array[1] {T}", ""},
           {"light_source { 0 rgb 1 }", "light_source { 0 rgb 1 looks_like { union { object { T } } } }", ""},
           {"pigment { rgb 1 }", "pigment { pigment_pattern { T } }", ""},
           {"function { x }", "function { T(x, y, z) + 1 }", ""},
           {"pigment_map { [0 rgb 1] [1 rgb 0] }", "pigment_map { [0 bozo pigment_map { T }] [1 rgb 1] }",
            ""},
           {"texture { pigment { rgb 1 } }",
            "texture { checker texture { T } texture { pigment { rgb 0 } } }", ""},
           {"normal { bumps 1 }", "normal { checker normal { T } normal { bumps 1 } }", ""},
       }) {
    const auto chain = [&, f = first, n = next, u = used](int count) {
      return fmt::format(
          "#declare T = {}\n#declare I = 0;\n#while (I < {})\n#declare T = {}\n#declare I = I + 1;\n"
          "#end\n{}\n",
          f, count, n, u);
    };
    EXPECT_EQ(refusal(chain(100)), "") << next;
    expect_refused(chain(pov::most_levels + 1), "declared of each other");
    expect_refused(chain(200'000), "declared of each other");
  }
  // What is a copy lies no deeper.
  EXPECT_EQ(
      refusal(
          "#declare T = sphere { 0, 1 }\n#declare P = pigment { rgb 1 }\n#declare I = 0;\n#while (I < 5000)\n"
          "#declare T = object { T translate x }\n#declare P = pigment { P translate x }\n"
          "#declare I = I + 1;\n#end\nobject { T pigment { P } }"),
      "");
}

}  // namespace
}  // namespace vitrail::read_nesting_test
