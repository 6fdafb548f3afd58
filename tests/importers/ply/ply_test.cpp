// SPDX-License-Identifier: Apache-2.0
#include "importers/ply/read/ply.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <sstream>

#include "importers/ply/read/ply_scene.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::ply_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Triangle = std::array<std::uint32_t, 3>;

class Ply : public testing::Test {
 protected:
  TriangleMesh read(const std::string& content, Diagnostics* diagnostics = nullptr) {
    return read_ply(folder_.write("mesh.ply", content), diagnostics);
  }

  // Of a file that has to be refused.
  Error error_of(const std::string& content) {
    try {
      read(content);
    } catch (const Error& error) {
      return error;
    }
    ADD_FAILURE() << "accepted";
    return Error("");
  }

  TemporaryFolder folder_;
};

template <class T>
std::string bytes_of(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string header(const std::string& format, const std::string& rest) {
  return "ply\nformat " + format + " 1.0\n" + rest + "end_header\n";
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string corner_list = "property list uchar int vertex_indices\n";

// A binary triangle with the common layout.
std::string binary_triangle(bool big, std::int32_t last_index = 2, float last_z = 0) {
  std::string s = header(big ? "binary_big_endian" : "binary_little_endian",
                         "element vertex 3\n" + xyz + "element face 1\n" + corner_list);
  for (const float f : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, last_z}) s += bytes_of(f, big);
  s += '\3';
  for (const std::int32_t i : {0, 1, last_index}) s += bytes_of(i, big);
  return s;
}

const std::string ascii_square =
    header("ascii", "element vertex 4\n" + xyz + "element face 1\n" + corner_list) +
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

TEST_F(Ply, BothByteOrdersGiveTheSameMesh) {
  const TriangleMesh little = read(binary_triangle(false));
  EXPECT_THAT(little.positions, ElementsAre(Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{0, 1, 0}));
  EXPECT_THAT(little.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(little, read(binary_triangle(true)));
}

TEST_F(Ply, AsciiQuadBecomesAFan) {
  const TriangleMesh mesh = read(ascii_square);
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

TEST_F(Ply, LineEndsOfOtherSystems) {
  const TriangleMesh expected = read(ascii_square);
  std::string dos, mac = ascii_square;
  for (const char c : ascii_square) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  std::ranges::replace(mac, '\n', '\r');
  EXPECT_EQ(read(dos), expected);
  EXPECT_EQ(read(mac), expected);
}

// The body may begin with any byte, a line feed among them.
TEST_F(Ply, BodyAfterAHeaderOfCarriageReturns) {
  std::string head = header("binary_little_endian",
                            "element vertex 1\nproperty uchar x\nproperty uchar y\n"
                            "property uchar z\nelement face 0\n" +
                                corner_list);
  std::ranges::replace(head, '\n', '\r');
  EXPECT_THAT(read(head + "\n\1\2").positions, ElementsAre(Point3f{10, 1, 2}));
}

TEST_F(Ply, AnyOrderAndTypes) {
  const std::string declared =
      "comment mixed\nobj_info anything\nelement vertex 3\n"
      "property double z\nproperty uchar red\nproperty short x\nproperty float32 nx\nproperty float ny\n"
      "property int8 y\nproperty float nz\nproperty float texture_v\nproperty double texture_u\n"
      "element face 1\nproperty ushort flags\nproperty list uint uint16 vertex_index\nproperty float area\n";
  for (const bool big : {false, true}) {
    std::string s = header(big ? "binary_big_endian" : "binary_little_endian", declared);
    for (const std::int16_t x : std::initializer_list<std::int16_t>{-300, 7, 9}) {
      s += bytes_of(0.5, big) + '\xff' + bytes_of(x, big) + bytes_of(0.f, big) + bytes_of(0.f, big);
      s += '\xfe' + bytes_of(1.f, big) + bytes_of(0.25f, big) + bytes_of(0.75, big);
    }
    s += bytes_of(std::uint16_t{9}, big) + bytes_of(3u, big);
    for (const std::uint16_t i : std::initializer_list<std::uint16_t>{2, 1, 0}) s += bytes_of(i, big);
    s += bytes_of(1.f, big);
    Diagnostics diagnostics;
    const TriangleMesh mesh = read(s, &diagnostics);
    EXPECT_THAT(mesh.positions,
                ElementsAre(Point3f{-300, -2, 0.5f}, Point3f{7, -2, 0.5f}, Point3f{9, -2, 0.5f}));
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 1, 0}));
    EXPECT_THAT(mesh.normals, testing::Each(Normal3f{0, 0, 1}));
    EXPECT_THAT(mesh.uvs, testing::Each(Point2f{0.75f, 0.25f}));
    ASSERT_EQ(diagnostics.size(), 3u);  // red, flags, area
    EXPECT_THAT(diagnostics[0].message, HasSubstr("red"));
    EXPECT_EQ(diagnostics[0].location.line, 7);
  }
}

TEST_F(Ply, NamesOfTextureCoordinates) {
  for (const auto& [u, v] :
       {std::pair{"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}) {
    const std::string declared = "element vertex 1\n" + xyz + "property float " + u + "\nproperty float " +
                                 v + "\nelement face 0\n" + corner_list;
    EXPECT_THAT(read(header("ascii", declared) + "0 0 0 .25 +.5").uvs, ElementsAre(Point2f{0.25f, 0.5f}))
        << u;
  }
}

TEST_F(Ply, OtherElementsAndListsAreSkipped) {
  const std::string declared =
      "element extra 2\nproperty list uchar float values\nproperty int id\nelement vertex 3\n" + xyz +
      "property list uchar uchar tags\nelement empty 7\nelement face 1\n" + corner_list +
      "property list uchar float texcoord\nelement edge 1\nproperty int a\n";
  const std::string ascii =
      header("ascii", declared) + "1 2.5 3\n0 4\n0 0 0 0\n1 0 0 2 8 9\n0 1 0 0\n3 0 1 2 2 .5 .5\n5\n";
  std::string binary = header("binary_little_endian", declared);
  binary += '\1' + bytes_of(2.5f) + bytes_of(3) + '\0' + bytes_of(4);
  binary += bytes_of(0.f) + bytes_of(0.f) + bytes_of(0.f) + '\0';
  binary += bytes_of(1.f) + bytes_of(0.f) + bytes_of(0.f) + "\2\10\11";
  binary += bytes_of(0.f) + bytes_of(1.f) + bytes_of(0.f) + '\0';
  binary +=
      '\3' + bytes_of(0) + bytes_of(1) + bytes_of(2) + '\2' + bytes_of(.5f) + bytes_of(.5f) + bytes_of(5);
  Diagnostics diagnostics;
  const TriangleMesh mesh = read(ascii, &diagnostics);
  EXPECT_THAT(mesh.positions, ElementsAre(Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{0, 1, 0}));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(diagnostics.size(), 5u);  // extra, tags, empty, texcoord, edge
  EXPECT_EQ(read(binary), mesh);
}

TEST_F(Ply, FacesBeforeVertices) {
  std::string s =
      header("binary_little_endian", "element face 1\n" + corner_list + "element vertex 3\n" + xyz);
  s += '\3' + bytes_of(2) + bytes_of(1) + bytes_of(0) + std::string(36, '\0');
  EXPECT_THAT(read(s).triangles, ElementsAre(Triangle{2, 1, 0}));
}

// More rows than a chunk, so that chunks join.
TEST_F(Ply, ManyVertices) {
  constexpr int count = 5000;
  std::string s =
      header("binary_little_endian", "element vertex 5000\n" + xyz +
                                         "property float nx\nproperty float ny\nproperty float nz\n"
                                         "element face 1\n" +
                                         corner_list);
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 6; ++k) s += bytes_of(static_cast<float>(10 * i + k));
  }
  s += '\3' + bytes_of(0) + bytes_of(count / 2) + bytes_of(count - 1);
  const TriangleMesh mesh = read(s);
  ASSERT_EQ(mesh.positions.size(), std::size_t{count});
  for (int i = 0; i < count; ++i) {
    const auto f = static_cast<float>(10 * i);
    ASSERT_EQ(mesh.positions[static_cast<std::size_t>(i)], (Point3f{f, f + 1, f + 2}));
    ASSERT_EQ(mesh.normals[static_cast<std::size_t>(i)], (Normal3f{f + 3, f + 4, f + 5}));
  }
}

// Large files are read by two threads, in chunks of rows that hold triangles alone, and row by row elsewhere.
class LargePly : public Ply {
 protected:
  static constexpr int vertices = 100'000, faces = 30'000;

  // Of a face: others follow it. The vertices lie on a parabola, on which floats are exact as far as faces
  // go.
  static int first(int face) { return face % 3000; }

  // Most faces are triangles, those of some stretches have up to `most_corners`.
  static std::string large(bool big, int most_corners, std::int32_t last_index = 0, float last_z = 0) {
    std::string s = header(big ? "binary_big_endian" : "binary_little_endian",
                           fmt::format("element vertex {}\n{}element face {}\nproperty uchar flags\n{}",
                                       vertices, xyz, faces, corner_list));
    for (int i = 0; i < vertices; ++i) {
      const auto f = static_cast<float>(i);
      s += bytes_of(f, big) + bytes_of(f * f, big) + bytes_of(i + 1 == vertices ? last_z : 0.f, big);
    }
    for (int i = 0; i < faces; ++i) {
      const int corners = i % 7000 < 5000 ? 3 : 3 + i % (most_corners - 2);
      s += '\7';
      s += static_cast<char>(corners);
      for (int k = 0; k + 1 < corners; ++k) s += bytes_of(first(i) + k, big);
      s += bytes_of(i + 1 == faces ? last_index : first(i) + corners - 1, big);
    }
    return s;
  }
};

TEST_F(LargePly, TrianglesAmongPolygons) {
  for (const bool big : {false, true}) {
    for (const int most : {3, 6}) {
      const TriangleMesh mesh = read(large(big, most, first(faces - 1) + 2));
      ASSERT_EQ(mesh.positions.size(), std::size_t{vertices});
      EXPECT_EQ(mesh.positions[777], (Point3f{777, 777 * 777, 0}));
      std::size_t at = 0;
      for (int i = 0; i < faces; ++i) {
        const int corners = i % 7000 < 5000 ? 3 : 3 + i % (most - 2);
        for (int k = 1; k + 1 < corners; ++k, ++at) {
          const auto a = static_cast<std::uint32_t>(first(i)), next = a + static_cast<std::uint32_t>(k);
          ASSERT_EQ(mesh.triangles.at(at), (Triangle{a, next, next + 1})) << i;
        }
      }
      EXPECT_EQ(mesh.triangles.size(), at);
    }
  }
}

TEST_F(LargePly, WhatIsWrongIsFoundInItsTurn) {
  for (const bool big : {false, true}) {
    EXPECT_THAT(error_of(large(big, 3, vertices)).what(), HasSubstr("vertex index 100000"));
    EXPECT_THAT(error_of(large(big, 6, -1)).what(), HasSubstr("vertex index -1"));
    for (int i = 0; i < 20; ++i) {
      EXPECT_THAT(error_of(large(big, 3, -1, std::numeric_limits<float>::infinity())).what(),
                  HasSubstr("z of vertex 99999"));
    }
    const std::string whole = large(big, 3);
    EXPECT_THROW(read(whole.substr(0, whole.size() - 1)), Error);
  }
}

TEST_F(Ply, StripsOfTriangles) {
  const std::string declared =
      "element vertex 6\n" + xyz + "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  const std::string head = header("ascii", declared) + vertices;
  const auto triangles = [&](const std::string& strip) { return read(head + strip).triangles; };
  EXPECT_THAT(triangles("5 0 2 1 3 5\n"),
              ElementsAre(Triangle{0, 2, 1}, Triangle{1, 2, 3}, Triangle{1, 3, 5}));
  EXPECT_THAT(triangles("9 0 2 1 -1 2 4 3 5 -1\n"),
              ElementsAre(Triangle{0, 2, 1}, Triangle{2, 4, 3}, Triangle{3, 4, 5}));
  // Corners that come twice lead on; they turn the next triangle all the same.
  EXPECT_THAT(triangles("7 0 2 1 1 3 3 5\n"), ElementsAre(Triangle{0, 2, 1}));
  EXPECT_THAT(triangles("2 0 1\n"), testing::IsEmpty());
  EXPECT_THAT(error_of(head + "3 0 1 6\n").what(), HasSubstr("vertex index 6"));
  EXPECT_THAT(error_of(head + "4 0 1\n").what(), HasSubstr("bytes are left"));
  const std::string both =
      header("ascii", "element tristrips 1\nproperty list int int vertex_indices\nelement vertex 6\n" + xyz +
                          "element face 1\n" + corner_list);
  EXPECT_THAT(read(both + "4 0 2 1 3\n" + vertices + "3 2 4 3\n").triangles,
              ElementsAre(Triangle{2, 4, 3}, Triangle{0, 2, 1}, Triangle{1, 2, 3}));
  Diagnostics diagnostics;
  read(both + "4 0 2 1 3\n" + vertices + "3 2 4 3\n", &diagnostics);
  EXPECT_THAT(diagnostics, testing::IsEmpty());
}

TEST_F(Ply, BombsOfGzipAreRefused) {
  const std::filesystem::path file = folder_.path() / "bomb.ply.gz";
  const gzFile out = gzopen(file.c_str(), "wb9");
  const std::vector<char> zeros(1 << 20);
  gzwrite(out, ascii_square.data(), static_cast<unsigned>(ascii_square.size()));
  for (int i = 0; i < 70; ++i) gzwrite(out, zeros.data(), static_cast<unsigned>(zeros.size()));
  gzclose(out);
  try {
    read_ply(file);
    ADD_FAILURE() << "inflated 70 MiB from " << std::filesystem::file_size(file);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("inflates to more than"));
  }
}

TEST_F(Ply, ConcavePolygonStaysInside) {
  // An L: the fan about its first corner would leave it.
  const std::string s = header("ascii", "element vertex 6\n" + xyz + "element face 2\n" + corner_list) +
                        "0 2 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n6 0 1 2 3 4 5\n2 0 1\n";
  Diagnostics diagnostics;
  const TriangleMesh mesh = read(s, &diagnostics);
  ASSERT_EQ(mesh.triangles.size(), 4u);
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const double z = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]).z;
    EXPECT_GT(z, 0);
    area += z / 2;
  }
  EXPECT_DOUBLE_EQ(area, 3);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(diagnostics[0].message, HasSubstr("1 faces with fewer than three corners"));
}

TEST_F(Ply, GzippedIsTheSame) {
  const std::filesystem::path file = folder_.path() / "mesh.ply.gz";
  const std::string content = binary_triangle(false);
  const gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, content.data(), static_cast<unsigned>(content.size()));
  gzclose(out);
  EXPECT_EQ(read_ply(file), read(content));

  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);
  EXPECT_THROW(read_ply(file), Error);
}

TEST_F(Ply, Deterministic) { EXPECT_EQ(read(ascii_square), read(ascii_square)); }

// ---- What has to be refused ---------------------------------------------------------------------

TEST_F(Ply, EveryTruncationIsAnError) {
  for (const std::string& whole : {binary_triangle(false), binary_triangle(true), ascii_square}) {
    const bool has_final_newline = whole.back() == '\n';
    for (std::size_t size = 0; size + (has_final_newline ? 1 : 0) < whole.size(); ++size) {
      EXPECT_THROW(read(whole.substr(0, size)), Error) << size << " of " << whole.size();
    }
  }
}

TEST_F(Ply, IndexOutOfRange) {
  for (const bool big : {false, true}) {
    for (const int index : {3, -1, std::numeric_limits<int>::min()}) {
      const Error error = error_of(binary_triangle(big, index));
      EXPECT_THAT(error.what(), HasSubstr("vertex index"));
      EXPECT_THAT(error.what(), HasSubstr("byte"));
      EXPECT_EQ(error.location.line, 7);  // element face
      EXPECT_THAT(error.excerpt, HasSubstr("element face 1"));
    }
  }
  const Error error = error_of(
      header("ascii", "element vertex 1\n" + xyz + "element face 1\n" + corner_list) + "0 0 0\n3 0 0 1\n");
  EXPECT_EQ(error.location.line, 11);
  EXPECT_EQ(error.location.column, 7);
  EXPECT_EQ(error.excerpt, "3 0 0 1");
}

TEST_F(Ply, NonFiniteVertices) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Error error = error_of(binary_triangle(false, 2, bad));
    EXPECT_THAT(error.what(), HasSubstr("z of vertex 2"));
    EXPECT_EQ(error.location.line, 3);
  }
  for (const std::string bad : {"nan", "-inf", "1e39", "x", "1,5"}) {
    const Error error = error_of(
        header("ascii", "element vertex 1\n" + xyz + "element face 0\n" + corner_list) + "0 0 " + bad + "\n");
    EXPECT_EQ(error.location.line, 10);
    EXPECT_EQ(error.location.column, 5);
  }
}

// ---- Courtesies: docs/reference/tolerated-deviations.md ---------------------------------------------------

TEST_F(Ply, AttributesThatAreNotFiniteAreLostAlone) {
  const std::string columns = "element vertex 3\n" + xyz +
                              "property float nx\nproperty float ny\nproperty float nz\nproperty float u\n"
                              "property float v\nproperty float foo_x\nproperty float foo_y\nproperty float "
                              "foo_z\nelement face 1\n" +
                              corner_list;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string binary = header("binary_little_endian", columns);
  for (const float f : {0.f, 0.f, 0.f, nan, 0.f, 1.f, .5f, nan, 1.f, 2.f, 3.f,  //
                        1.f, 0.f, 0.f, 0.f, 0.f, 1.f, .5f, .5f, 1.f, nan, 3.f,  //
                        0.f, 1.f, 0.f, 0.f, 0.f, 1.f, .5f, .5f, 1.f, 2.f, 3.f})
    binary += bytes_of(f);
  binary += bytes_of(std::uint8_t{3}) + bytes_of(0) + bytes_of(1) + bytes_of(2);
  const std::string ascii = header("ascii", columns) +
                            "0 0 0 nan 0 1 .5 nan 1 2 3\n1 0 0 0 0 1 .5 .5 1 nan 3\n"
                            "0 1 0 0 0 1 .5 .5 1 2 3\n3 0 1 2\n";
  for (const std::string& content : {binary, ascii}) {
    Diagnostics diagnostics;
    const TriangleMesh mesh = read_ply(folder_.write("mesh.ply", content), &diagnostics, PlyAttributes::read);
    EXPECT_EQ(mesh.normals.at(0), (Normal3f{0, 0, 1}));
    EXPECT_EQ(mesh.uvs.at(0), (Point2f{.5f, 0}));
    EXPECT_THAT(mesh.attributes.at(0).values, ElementsAre(1, 2, 3, 1, 0, 3, 1, 2, 3));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_THAT(diagnostics[0].message, HasSubstr("3 numbers"));
  }
}

TEST_F(Ply, AlphaOfColorsIsLeftOut) {
  const std::vector<std::string> names{"r g b a", "red green blue alpha", "tint_r tint_g tint_b tint_a"};
  for (const std::string& of : names) {
    std::istringstream words(of);
    std::string columns = "element vertex 3\n" + xyz;
    for (std::string name; words >> name;) columns += "property float " + name + "\n";
    const std::string rows = "0 0 0 1 2 3 4\n1 0 0 5 6 7 8\n0 1 0 9 10 11 12\n3 0 1 2\n";
    const std::string content = header("ascii", columns + "element face 1\n" + corner_list) + rows;
    const TriangleMesh mesh = read_ply(folder_.write("mesh.ply", content), nullptr, PlyAttributes::read);
    if (of.starts_with("tint")) {
      EXPECT_TRUE(mesh.attributes.empty()) << "four channels of another name are no colour";
      continue;
    }
    ASSERT_EQ(mesh.attributes.size(), 1u) << of;
    EXPECT_EQ(mesh.attributes[0].name, "vertex_color");
    EXPECT_EQ(mesh.attributes[0].channels, 3);
    EXPECT_THAT(mesh.attributes[0].values, ElementsAre(1, 2, 3, 5, 6, 7, 9, 10, 11));
  }
}

TEST_F(Ply, MarkOfUtf8) {
  EXPECT_EQ(read("\xef\xbb\xbf" + ascii_square), read(ascii_square));
  EXPECT_EQ(read("\xef\xbb\xbf" + binary_triangle(false)), read(binary_triangle(false)));
}

// As MeshLab writes them: (u,v) of corners. The square's diagonal belongs to both triangles with different
// ones.
TEST_F(Ply, TextureOfCorners) {
  const std::string square =
      "element vertex 4\n" + xyz + "element face 2\n" + corner_list + "property list uchar float texcoord\n";
  const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 .5 0 .5 1\n3 0 2 3 6 0 0 1 1 0 1\n";
  folder_.write("Wood.png", "x");
  const std::string named = "comment TextureFile wood.png\n" + square;
  const ImportedScene imported =
      read_ply_scene(folder_.write("mesh.ply", header("ascii", named) + rows), MeshMemory());
  const auto& image = std::get<ImageTexture>(imported.scene.textures.at(0).model);
  EXPECT_THAT(image.filename, testing::EndsWith("/Wood.png"));
  EXPECT_EQ(std::get<DiffuseMaterial>(imported.scene.materials.at(0).model).reflectance,
            SpectrumParameter{Id<Texture>{0}});
  const TriangleMesh& mesh = imported.scene.meshes.at(0);
  ASSERT_EQ(mesh.positions.size(), 5u) << "vertex 2 has two";
  const auto corner = [&](std::size_t triangle, std::size_t k) {
    return mesh.uvs.at(mesh.triangles.at(triangle).at(k));
  };
  EXPECT_EQ(corner(0, 2), (Point2f{.5f, 1}));
  EXPECT_EQ(corner(1, 1), (Point2f{1, 1}));
  EXPECT_EQ(mesh.positions.at(mesh.triangles[1][1]), (Point3f{1, 1, 0}));
  EXPECT_TRUE(imported.diagnostics.empty());
  // Without (u,v) the report says so; an image that is not there is refused, or replaced, by import_scene.
  const std::string lost = "ply\ncomment TextureFile wood.png\n" + ascii_square.substr(4);
  const ImportedScene grey = read_ply_scene(folder_.write("mesh.ply", lost), MeshMemory());
  EXPECT_TRUE(grey.scene.textures.empty());
  ASSERT_FALSE(grey.diagnostics.empty());
  EXPECT_THAT(grey.diagnostics.back().message, HasSubstr("TextureFile"));
}

// Sizes that the file cannot hold must not claim memory.
TEST_F(Ply, AbsurdCounts) {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const std::string count : {"4294967295", "9223372036854775807", "99999999999999999999", "-1"}) {
      EXPECT_THAT(
          error_of(header(format, "element vertex " + count + "\n" + xyz + "element face 0\n" + corner_list))
              .what(),
          testing::AnyOf(HasSubstr("bytes are left"), HasSubstr("negative"), HasSubstr("64 bits")));
      EXPECT_THROW(
          read(header(format, "element vertex 0\n" + xyz + "element face " + count + "\n" + corner_list)),
          Error);
      EXPECT_THROW(
          read(header(format, "element other " + count + "\nproperty list uchar int n\nelement vertex 0\n" +
                                  xyz + "element face 0\n" + corner_list)),
          Error);
    }
  }
  const std::string declared =
      "element vertex 0\n" + xyz + "element face 1\nproperty list uint int vertex_indices\n";
  const std::string body = bytes_of(0xffffffffu) + std::string(64, '\0');
  EXPECT_THAT(error_of(header("binary_little_endian", declared) + body).what(),
              HasSubstr("4294967295 items"));
  EXPECT_THROW(read(header("ascii", declared) + "4294967295 0 0 0\n"), Error);
  EXPECT_THROW(read(header("ascii", declared) + "-3 0 0 0\n"), Error);
}

TEST_F(Ply, HeadersThatMakeNoSense) {
  const std::string end = "end_header\n", ascii = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 0\n" + xyz, face = "element face 0\n" + corner_list;
  ASSERT_NO_THROW(read(ascii + vertex + face + end));
  for (const std::string& bad : std::vector<std::string>{
           "", "plx\n", "ply\n" + vertex + face + end, "ply\nformat ascii 2.0\n" + vertex + face + end,
           "ply\nformat utf8 1.0\n" + vertex + face + end, ascii + vertex + face, ascii + vertex + end,
           ascii + face + end, ascii + "property float x\n" + vertex + face + end,
           ascii + vertex + vertex + face + end, ascii + vertex + "property float x\n" + face + end,
           ascii + vertex + "property half h\n" + face + end,
           ascii + vertex + "property list float int l\n" + face + end,
           ascii + vertex + "proprety float w\n" + face + end,
           ascii + "element vertex many\n" + xyz + face + end,
           ascii + "element vertex 0 0\n" + xyz + face + end,
           ascii + "element vertex 0\nproperty float x\n" + face + end,
           ascii + vertex + "element face 0\nproperty list uchar float vertex_indices\n" + end}) {
    const Error error = error_of(bad);
    EXPECT_THAT(error.location.file, HasSubstr("mesh.ply")) << bad;
    EXPECT_GT(error.location.line, 0) << bad;
  }
}

TEST_F(Ply, FilesThatAreNotThere) {
  EXPECT_THROW(read_ply(folder_.path() / "none.ply"), Error);
  EXPECT_THROW(read_ply(folder_.path()), Error);
}

}  // namespace
}  // namespace vitrail::ply_test
