// SPDX-License-Identifier: Apache-2.0
// docs/reference/tolerated-deviations.md: each row, with each reader that has such a thing.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "importers/import.h"
#include "scene/system/diagnostics.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::tolerated_deviations_test {
namespace {

struct Case {
  const char* row;  // words of its line in the page
  std::string file, text;
  const char* refused = nullptr;  // what the error says
  const char* said = nullptr;     // what the report says; null: nothing of this row's kind
};

const std::string mark = "\xef\xbb\xbf", windows = "C:\\models\\wood.png",
                  square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n";

std::string obj(const std::string& map) {
  return "mtllib " + map + "\n" + square + "usemtl m\nf 1/1 2/1 3/1\n";
}
std::string ply(const std::string& comment, const std::string& first_u = "0") {
  return "ply\nformat ascii 1.0\n" + comment +
         "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty "
         "float "
         "v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " +
         first_u + " 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
}
std::string pbrt(const std::string& inside) { return "Film \"rgb\" WorldBegin\n" + inside + "\n"; }
std::string pbrt_image(const std::string& name) {
  return pbrt("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + name + "\"");
}
std::string pbrt_triangle(const std::string& x, const std::string& u) {
  return pbrt("Shape \"trianglemesh\" \"point3 P\" [" + x + " 0 0 1 0 0 0 1 0] \"point2 uv\" [" + u +
              " 0 1 0 0 1]");
}
std::string mitsuba(const std::string& inside, const char* version = "3.0.0") {
  return fmt::format("<scene version=\"{}\">{}</scene>", version, inside);
}
std::string mitsuba_image(const std::string& name) {
  return mitsuba(
      "<bsdf type=\"diffuse\" id=\"m\"><texture type=\"bitmap\" name=\"reflectance\"><string "
      "name=\"filename\" value=\"" +
      name + "\"/></texture></bsdf><shape type=\"rectangle\"><ref id=\"m\"/></shape>");
}
std::string mitsuba_shape(const std::string& kind, const std::string& file, const std::string& more = "",
                          const char* version = "3.0.0") {
  return mitsuba(
      "<shape type=\"" + kind + "\"><string name=\"filename\" value=\"" + file + "\"/>" + more + "</shape>",
      version);
}
std::string pbrt_spectrum(const std::string& file) {
  return pbrt("LightSource \"point\" \"spectrum I\" \"" + file + "\"");
}

std::vector<Case> cases() {
  const char *bom = "a mark of UTF-8", *slashes = "`textures\\wood.png`", *drive = "`C:\\models\\wood.png`",
             *letters = "`Wood.PNG` for", *keywords = "keywords in other letter cases",
             *attribute = "attribute that is not finite", *position = "a position that is not finite",
             *undefined = "a material that is never defined", *odd = "an odd count of numbers",
             *colors = "colours of vertices", *texture = "TextureFile", *smoothing = "smoothing groups",
             *named = "several bsdfs by name", *angle = "`maxSmoothAngle`", *unseen = "`Tr 1` without `d`";
  const std::string red = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n",
                    group = square + "s 1\nf 1 2 3\n";
  return {
      {bom, "a.obj", mark + obj("red.mtl")},
      {bom, "a.ply", mark + ply("")},
      {bom, "a.pbrt", mark + pbrt("")},
      {bom, "a.xml", mark + mitsuba("")},
      {slashes, "a.obj", obj("sub\\sub.mtl")},
      {slashes, "a.ply", ply("comment TextureFile sub\\wood.png\n")},
      {slashes, "a.pbrt", pbrt_image("sub\\\\wood.png")},
      {slashes, "a.xml", mitsuba_image("sub\\wood.png")},
      {drive, "a.obj", obj("C:\\models\\red.mtl")},
      {drive, "a.ply", ply("comment TextureFile " + windows + "\n")},
      {letters, "a.obj", obj("RED.mtl")},
      {letters, "a.ply", ply("comment TextureFile Wood.PNG\n")},
      {keywords, "a.obj", obj("kd.mtl")},
      {keywords, "a.ply", ply("COMMENT x\n"), "unknown word"},
      {keywords, "a.pbrt", pbrt("SHAPE \"sphere\""), "unknown directive"},
      {attribute, "a.obj", square + "vn nan 0 1\nf 1//1 2//1 3//1\n", nullptr, "not finite"},
      {attribute, "a.obj", square + "vn 0 -1.#IND00 1\nf 1//1 2//1 3//1\n", nullptr, "not finite"},
      {attribute, "a.obj", square + "vt 1.#QNAN -nan(ind)\nf 1/2 2/2 3/2\n", nullptr, "not finite"},
      {attribute, "a.ply", ply("", "nan"), nullptr, "not finite"},
      {attribute, "a.ply", ply("", "1.#INF"), nullptr, "not finite"},
      {attribute, "a.pbrt", pbrt_triangle("0", "nan"), "finite"},
      {attribute, "b.pbrt", pbrt("Shape \"plymesh\" \"string filename\" \"nan.ply\""), nullptr, "not finite"},
      {attribute, "a.xml", mitsuba_shape("ply", "nan.ply"), nullptr, "not finite"},
      {position, "a.obj", "v nan 0 0\nf 1 1 1\n", "finite"},
      {position, "a.obj", "v 0 1.#IND 0\nf 1 1 1\n", "finite"},
      {position, "a.ply", ply("").replace(ply("").find("0 0 0 "), 1, "inf"), "finite"},
      {position, "a.pbrt", pbrt_triangle("nan", "0"), "finite"},
      {undefined, "a.obj", square + "usemtl none\nf 1 2 3\n", nullptr, "not defined"},
      {undefined, "a.pbrt", pbrt("NamedMaterial \"none\" Shape \"sphere\""), "none"},
      {undefined, "a.xml", mitsuba("<shape type=\"sphere\"><ref id=\"none\"/></shape>"), "none"},
      {odd, "a.pbrt", pbrt_spectrum("odd.spd"), nullptr, "odd"},
      {colors, "a.obj", red},
      {texture, "a.ply", ply("comment TextureFile wood.png\n")},
      {texture, "a.xml", mitsuba_shape("ply", "textured.ply")},
      {unseen, "a.obj", obj("tr.mtl"), nullptr, "taken as opaque"},
      {smoothing, "a.obj", group},
      {smoothing, "a.xml", mitsuba_shape("obj", "smooth.obj")},
      {named, "a.xml",
       mitsuba_shape("obj", "named.obj",
                     "<bsdf type=\"diffuse\" name=\"a\"/><bsdf type=\"diffuse\" name=\"b\"/>", "0.6.0")},
      {angle, "a.xml",
       mitsuba_shape("ply", "textured.ply", "<float name=\"maxSmoothAngle\" value=\"30\"/>", "0.6.0")},
  };
}

// Words of the rows: what else a report says (that a view is added) does not count.
bool is_of_a_row(const std::string& message) {
  for (const char* words : {"not finite", "no such file", "not used", "TextureFile", "smoothing", "odd",
                            "colours", "bsdf", "not defined", "opaque"})
    if (message.find(words) != std::string::npos) return true;
  return false;
}

TEST(ToleratedDeviations, EachRowWithEachReader) {
  const test::TemporaryDirectory folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  std::filesystem::create_directory(folder / "sub");
  for (const char* name : {"wood.png", "sub/wood.png"}) write(name, "an image that nobody opens");
  for (const char* name : {"red.mtl", "sub/sub.mtl"}) write(name, "newmtl m\nKd 1 0 0\n");
  write("kd.mtl", "NEWMTL m\nkd 1 0 0\n");
  write("tr.mtl", "newmtl m\nKd 1 0 0\nTr 1\n");
  write("nan.ply", ply("", "nan"));
  write("textured.ply", ply("comment TextureFile wood.png\n"));
  write("smooth.obj", square + "s 1\nf 1 2 3\n");
  write("named.obj", square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
  write("odd.spd", "400 1 500 2 600 3 700");
  std::ifstream page(std::string(test::source_dir()) + "/docs/reference/tolerated-deviations.md");
  const std::string rows{std::istreambuf_iterator<char>(page), {}};
  for (const Case& c : cases()) {
    EXPECT_THAT(rows, testing::HasSubstr(c.row));
    const auto file = write(c.file, c.text);
    std::string said;
    try {
      for (const Diagnostic& d : import_scene(file).diagnostics)
        if (is_of_a_row(d.message)) said += d.message + "\n";
      EXPECT_EQ(c.refused, nullptr) << c.row << ", " << c.file << " is read";
      if (c.said)
        EXPECT_THAT(said, testing::HasSubstr(c.said)) << c.row << ", " << c.file;
      else
        EXPECT_EQ(said, "") << c.row << ", " << c.file;
    } catch (const Error& error) {
      ASSERT_NE(c.refused, nullptr) << c.row << ", " << c.file << ": " << error.what();
      EXPECT_THAT(error.what(), testing::HasSubstr(c.refused)) << c.row << ", " << c.file;
    }
  }
}

}  // namespace
}  // namespace vitrail::tolerated_deviations_test
