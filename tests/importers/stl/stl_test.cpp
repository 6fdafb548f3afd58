// SPDX-License-Identifier: Apache-2.0
#include "importers/stl/read/stl.h"

#include <gtest/gtest.h>

#include <cstring>

#include "scene/system/diagnostics.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::stl_test {
namespace {

std::string text_of(const std::string& facets) {
  return "solid a name of words\n" + facets + "endsolid a name of words\n";
}

std::string facet(const char* a, const char* b, const char* c) {
  return std::string("facet normal nan 0 1\n outer loop\n  vertex ") + a + "\n  vertex " + b + "\n  vertex " +
         c + "\n endloop\nendfacet\n";
}

std::string binary_of(const std::vector<float>& corners) {
  std::string bytes = "solid, but binary";
  bytes.resize(80);
  const auto count = static_cast<std::uint32_t>(corners.size() / 9);
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t i = 0; i < corners.size(); i += 9) {
    bytes.append(12, '\0');
    bytes.append(reinterpret_cast<const char*>(&corners[i]), 36);
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string error_of(const std::string& content) {
  const TemporaryFolder folder;
  try {
    read_stl(folder.write("a.stl", content));
  } catch (const Error& error) {
    return std::to_string(error.location.line) + ": " + error.what();
  }
  return "";
}

TEST(Stl, TextAndBinaryAreTheSameWeldedMesh) {
  const TemporaryFolder folder;
  const TriangleMesh text = read_stl(folder.write(
      "a.stl", text_of(facet("0 0 0", "1 0 0", "0 +1.0e0 0") + facet("1 0 0", "1 1 .5", "-0 1 0"))));
  const TriangleMesh binary = read_stl(
      folder.write("b.stl", binary_of({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, .5f, -0.0f, 1, 0})));
  EXPECT_EQ(text.positions.size(), 4u);
  EXPECT_EQ(text.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}}));
  EXPECT_EQ(text, binary);
}

TEST(Stl, MistakesHaveTheirPlace) {
  EXPECT_EQ(error_of("v 0 0 0\n").substr(0, 2), "1:");
  EXPECT_EQ(error_of(text_of(facet("0 0 0", "1 x 0", "0 1 0"))), "5: y is not a number: 'x'");
  EXPECT_EQ(error_of(text_of(facet("0 0 0", "1 inf 0", "0 1 0"))).substr(0, 2), "5:");
  EXPECT_EQ(error_of("solid\nfacet\nvertex 0 0 0\n"), "4: the file ends within a facet");
  EXPECT_EQ(error_of("solid\nfacet\nvertex 0 0 0\nendfacet\n"), "4: a facet of fewer than three corners");
  EXPECT_NE(error_of(binary_of({0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::infinity(), 0})), "");
  EXPECT_NE(error_of(binary_of({0, 0, 0, 1, 0, 0, 0, 1, 0}).substr(0, 100)), "") << "cut off";
}

}  // namespace
}  // namespace vitrail::stl_test
