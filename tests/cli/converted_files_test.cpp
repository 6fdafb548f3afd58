// SPDX-License-Identifier: Apache-2.0
// What convert reads it does not write over, whatever it is called, and what it writes beside a scene takes
// no other scene's names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::converted_files_test {
namespace {

using ::testing::HasSubstr;

class ConvertedFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((directory_ / name).parent_path());
    std::ofstream(directory_ / name) << text;
    return path(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream in(directory_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  CommandResult convert(const std::string& arguments) const {
    return run(vitrail("convert") + " " + arguments);
  }
  // A mesh that ends at x, of more triangles than are written into a scene's own file.
  static std::string ply(const std::string& x) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 100\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n" +
        x + " 0 0\n0 1 0\n";
    for (int i = 0; i < 100; ++i) text += "3 0 1 2\n";
    return text;
  }
  static std::string scene(const std::string& mesh) {
    return "WorldBegin\nShape \"plymesh\" \"string filename\" \"" + mesh + "\"\n";
  }
  TemporaryDirectory directory_;
};

TEST_F(ConvertedFiles, MeshesOfTheInputStay) {
  write("room-meshes/000000.ply", ply("1"));
  const std::string in = write("room.pbrt", scene("room-meshes/000000.ply"));
  const CommandResult result = convert(in + " " + path("room.xml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(read("room-meshes/000000.ply"), ply("1"));
  EXPECT_THAT(read("room.xml"), HasSubstr("room-meshes/000000-2.ply"));
  EXPECT_EQ(run(vitrail("inspect") + " " + path("room.xml")).status, 0);
}

TEST_F(ConvertedFiles, MeshesOfAnotherSceneStay) {
  write("a.ply", ply("1"));
  write("b.ply", ply("2"));
  ASSERT_EQ(convert(write("a.pbrt", scene("a.ply")) + " " + path("out.xml")).status, 0);
  const std::string first = read("out-meshes/000000.ply");
  ASSERT_EQ(convert(write("b.pbrt", scene("b.ply")) + " -o " + path("out.pbrt")).status, 0);
  EXPECT_EQ(read("out-meshes/000000.ply"), first);
  EXPECT_THAT(read("out.pbrt"), HasSubstr("out-meshes/000000-2.ply"));
  // The same again replaces its own.
  ASSERT_EQ(convert(path("a.pbrt") + " " + path("out.pbrt")).status, 0);
  EXPECT_THAT(read("out.pbrt"), HasSubstr("out-meshes/000000-2.ply"));
  EXPECT_EQ(read("out-meshes/000000-2.ply"), first);
  EXPECT_FALSE(std::filesystem::exists(path("out-meshes/000000-3.ply")));
}

TEST_F(ConvertedFiles, MaterialsThatWereReadStay) {
  const std::string materials = "newmtl red\nKd 1 0 0\n";
  write("out.mtl", materials);
  const std::string in = write("in.obj", "mtllib out.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const CommandResult result = convert(in + " " + path("out.obj"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(read("out.mtl"), materials);
  EXPECT_THAT(read("out.obj"), HasSubstr("mtllib out-2.mtl"));
}

TEST_F(ConvertedFiles, NoOutputReplacesAnInput) {
  write("mesh.ply", ply("1"));
  write("part.pbrt", "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n");
  const std::string image = write("leaf.png", "no image, and never opened");
  const std::string in = write("in.pbrt",
                               "WorldBegin\nInclude \"part.pbrt\"\nTexture \"t\" \"spectrum\" \"imagemap\" "
                               "\"string filename\" \"leaf.png\"\n");
  std::filesystem::create_hard_link(path("part.pbrt"), path("hard.pbrt"));
  std::filesystem::create_symlink(path("part.pbrt"), path("soft.pbrt"));
  const std::string before = read("part.pbrt");
  for (const char* output : {"part.pbrt", "hard.pbrt", "soft.pbrt", "mesh.ply", "in.pbrt"}) {
    const CommandResult refused = convert(in + " " + path(output));
    EXPECT_EQ(refused.status, 2) << output << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("is an input of this command"));
  }
  for (const std::string& report : {in, path("part.pbrt"), path("mesh.ply"), image}) {
    const CommandResult refused = convert(in + " " + path("out.xml") + " --report " + report);
    EXPECT_EQ(refused.status, 2) << report << refused.output;
    EXPECT_FALSE(std::filesystem::exists(path("out.xml"))) << report;
  }
  EXPECT_EQ(convert(in + " " + path("out.xml") + " --report " + path("out.xml")).status, 2);
  EXPECT_EQ(read("part.pbrt"), before);
  EXPECT_EQ(read("mesh.ply"), ply("1"));
  EXPECT_EQ(read("leaf.png"), "no image, and never opened");
}

TEST_F(ConvertedFiles, OtherVerbsTooKeepWhatTheyRead) {
  const std::string in = write("in.pbrt", "WorldBegin Shape \"sphere\"\n");
  const std::string before = read("in.pbrt");
  EXPECT_EQ(run(vitrail("partition") + " " + in + " -o " + path("a.vit") + " --stats " + in).status, 2);
  EXPECT_FALSE(std::filesystem::exists(path("a.vit")));
  EXPECT_EQ(run(vitrail("render") + " " + in + " -o " + path("a.exr") + " --stats " + in).status, 2);
  EXPECT_EQ(read("in.pbrt"), before);
  ASSERT_EQ(run(vitrail("render") + " " + in + " -o " + path("a.exr") + " --spp 1 --crop 0,8,0,8").status, 0);
  const std::string picture = read("a.exr");
  EXPECT_EQ(
      run(vitrail("compare") + " " + path("a.exr") + " " + path("a.exr") + " --heatmap " + path("a.exr"))
          .status,
      2);
  EXPECT_EQ(read("a.exr"), picture);
}

}  // namespace
}  // namespace vitrail::test::converted_files_test
