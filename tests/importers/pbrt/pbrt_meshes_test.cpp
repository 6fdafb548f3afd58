// SPDX-License-Identifier: Apache-2.0
// Meshes are read ahead of the scene: nothing may show that.
#include <fmt/format.h>

#include "tests/importers/pbrt/pbrt_text.h"

namespace vitrail::pbrt_meshes_test {
namespace {

// A mesh whose first vertex says its number; the larger the number, the sooner it is read.
std::string numbered_ply(int number, int count) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float extra{}\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n",
      3 + 100 * (count - number), number);
  for (int i = 0; i < 3 + 100 * (count - number); ++i)
    text += fmt::format("{} {} {} 0\n", number, i % 2, i % 3);
  return text + "3 0 1 2\n";
}

std::string shape(const std::string& file) {
  return fmt::format("Shape \"plymesh\" \"string filename\" \"{}\"\n", file);
}

TEST(PbrtMeshes, ComeInTheOrderOfTheScene) {
  constexpr int count = 60;
  const TemporaryFolder folder;
  std::string scene = "Film \"rgb\" WorldBegin # \"59.ply\" \"none.ply\"\n";
  for (int i = 0; i < count; ++i) {
    folder.write(fmt::format("{}.ply", i), numbered_ply(i, count));
    scene += shape(fmt::format("{}.ply", i)) + (i % 7 == 0 ? shape("3.ply") : "");
  }
  const ImportedScene imported = read_pbrt(folder.write("scene.pbrt", scene));
  // Of the second directive the mesh of 3.ply is the second.
  std::vector<int> order;
  for (int i = 0; i < count; ++i)
    if (i != 3) order.push_back(i);
  order.insert(order.begin() + 1, 3);
  ASSERT_EQ(imported.scene.meshes.size(), order.size());
  ASSERT_EQ(imported.scene.shapes.size(), 69u);
  ASSERT_EQ(imported.diagnostics.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(imported.scene.meshes[i].positions[0].x, static_cast<float>(order[i]));
    EXPECT_EQ(imported.diagnostics[i].message, fmt::format("property extra{} of element vertex", order[i]));
  }
}

TEST(PbrtMeshes, OnlyTheFirstErrorIsSaid) {
  const TemporaryFolder folder;
  std::string scene = "Film \"rgb\" WorldBegin\n";
  for (int i = 0; i < 20; ++i) {
    folder.write(fmt::format("{}.ply", i), i < 11 ? numbered_ply(i, 20) : "ply\nformat nonsense\n");
    scene += shape(fmt::format("{}.ply", i));
  }
  try {
    read_pbrt(folder.write("scene.pbrt", scene));
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(error.location.file.ends_with("/11.ply")) << error.location.file;
  }
  // A file that is named but not a shape's is nobody's error.
  EXPECT_NO_THROW(read_pbrt(
      folder.write("fine.pbrt", "Film \"rgb\" WorldBegin\n" + shape("1.ply") + "# \"11.ply\"\n" + triangle)));
}

TEST(PbrtMeshes, ProgressGrowsAndStopsTheReading) {
  const TemporaryFolder folder;
  std::string scene = "Film \"rgb\" WorldBegin\n";
  for (int i = 0; i < 20; ++i) {
    folder.write(fmt::format("{}.ply", i), numbered_ply(i, 20));
    scene += shape(fmt::format("{}.ply", i));
  }
  const std::filesystem::path file = folder.write("scene.pbrt", scene);
  double last = 0;
  read_pbrt(file, MeshMemory{}, [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
  });
  EXPECT_GT(last, 0.9);
  EXPECT_THROW(read_pbrt(file, MeshMemory{}, [](double) { throw MachineError("stop"); }), MachineError);
}

}  // namespace
}  // namespace vitrail::pbrt_meshes_test
