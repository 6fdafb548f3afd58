// SPDX-License-Identifier: Apache-2.0
#include "importers/stl/read/stl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
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

// As programs write them: a facet a line, all on one, capitals, a mark before UTF-8.
TEST(Stl, TextHasAnyLines) {
  const TemporaryFolder folder;
  const std::string usual = text_of(facet("0 0 0", "1 0 0", "0 1 0") + facet("1 0 0", "1 1 .5", "0 1 0"));
  const TriangleMesh mesh = read_stl(folder.write("a.stl", usual));
  std::string one_line = usual, capitals = usual, no_normals;
  std::ranges::replace(one_line, '\n', ' ');
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  no_normals = "solid\n";
  for (const char* corners :
       {"vertex 0 0 0 vertex 1 0 0 vertex 0 1 0", "vertex 1 0 0 vertex 1 1 .5 vertex 0 1 0"})
    no_normals += std::string("facet outer loop ") + corners + " endloop endfacet\n";
  for (const std::string& text : {one_line, capitals, no_normals, "\xef\xbb\xbf" + usual})
    EXPECT_EQ(read_stl(folder.write("b.stl", text)), mesh) << text;
}

TEST(Stl, BytesMayFollowTheFacets) {
  const TemporaryFolder folder;
  std::string bytes = binary_of({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const TriangleMesh mesh = read_stl(folder.write("a.stl", bytes));
  EXPECT_EQ(read_stl(folder.write("b.stl", bytes + "trailing")), mesh);
}

TEST(Stl, NoFacetsAreNoPicture) {
  EXPECT_EQ(error_of("solid a\nendsolid a\n"), "0: it has no facets that enclose an area");
  EXPECT_EQ(error_of(binary_of({})), "0: it has no facets that enclose an area");
}

TEST(Stl, FacetsHaveColours) {
  const TemporaryFolder folder;
  const std::vector<float> two{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const auto colors = [&](std::string bytes, unsigned first, unsigned second) {
    bytes[84 + 48] = static_cast<char>(first & 255), bytes[84 + 49] = static_cast<char>(first >> 8);
    bytes[134 + 48] = static_cast<char>(second & 255), bytes[134 + 49] = static_cast<char>(second >> 8);
    const TriangleMesh mesh = read_stl(folder.write("a.stl", bytes));
    return mesh.attributes.empty() ? std::vector<float>{} : mesh.attributes[0].values;
  };
  const std::string plain = binary_of(two);
  std::string with_default = plain;
  with_default.replace(0, 10, std::string("COLOR=\x00\xff\x00\xff", 10));
  EXPECT_EQ(colors(plain, 0, 0), std::vector<float>{});
  EXPECT_EQ(colors(plain, 0xfc00, 0x801f), (std::vector<float>{1, 0, 0, 0, 0, 1})) << "VisCAM";
  EXPECT_EQ(colors(plain, 0xfc00, 0), (std::vector<float>{1, 0, 0, .5f, .5f, .5f}));
  EXPECT_EQ(colors(with_default, 0x8000, 0x001f), (std::vector<float>{0, 1, 0, 1, 0, 0})) << "Materialise";
  std::string text = text_of(facet("0 0 0", "1 0 0", "0 1 0"));
  text.replace(text.find("endfacet"), 8, "endfacet color 31744");
  EXPECT_EQ(read_stl(folder.write("c.stl", text)).attributes.at(0).values, (std::vector<float>{1, 0, 0}));
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
