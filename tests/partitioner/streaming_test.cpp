// SPDX-License-Identifier: Apache-2.0
// Partitioning a scene of which only a part is in memory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bundle/verify.h"
#include "importers/import.h"
#include "importers/writing/write_ply.h"
#include "partitioner/partition.h"
#include "tests/partitioner/bundle_contents.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::streaming_test {

namespace {

using test::bumpy_torus;
using test::contents;
using test::files_of_records;
using test::scene_of;

class Streaming : public ::testing::Test {
 protected:
  // A scene of meshes with files of their own; two shapes are of the same one, and one shines.
  std::filesystem::path written_scene() const {
    for (int i = 0; i < 5; ++i) write_ply(bumpy_torus(20 + 5 * i), directory / fmt::format("{}.ply", i));
    std::ofstream scene(directory / "scene.pbrt");
    scene << "WorldBegin\n";
    for (int i = 0; i < 6; ++i) {
      scene << "AttributeBegin\n";
      if (i == 4) scene << "AreaLightSource \"diffuse\" \"rgb L\" [1 2 3]\n";
      scene << fmt::format("Translate {} {} 0\nRotate {} 0 1 1\n", i, 2 * i, 17 * i)
            << fmt::format("Shape \"plymesh\" \"string filename\" \"{}.ply\"\nAttributeEnd\n", i % 5);
    }
    return directory / "scene.pbrt";
  }
  test::TemporaryDirectory directory;
  std::filesystem::path out = directory / "scene.vit";
};

TEST_F(Streaming, BucketsChangeTheCutsAlone) {
  const Scene scene = scene_of(test::adversarial_soup());
  partition(scene, out, {.domains = 11});
  const Manifest whole = read_manifest(out);
  for (const std::uint32_t at_once : {1u, 2u, 5u}) {
    const PartitionStats s = partition(scene, out, {.domains = 11, .domains_at_once = at_once});
    const Manifest m = read_manifest(out);
    EXPECT_GE(s.buckets, 11 / at_once);
    EXPECT_GT(s.spill_bytes, 0u);
    EXPECT_EQ(m.scene_hash, whole.scene_hash);
    EXPECT_EQ(m.bounds, whole.bounds);
    EXPECT_EQ(m.scale, whole.scale);
    EXPECT_EQ(s.duplicates, 0u);
    EXPECT_LT(s.area_error, 1e-6);
    EXPECT_TRUE(verify_bundle(out).problems.empty());
    EXPECT_EQ(contents(out).size(), 11u + files_of_records) << "nothing of the buckets is left";
  }
}

TEST_F(Streaming, BucketsAreBalanced) {
  const Scene scene = scene_of(bumpy_torus(150));
  for (const std::uint32_t domains : {8u, 23u, 64u}) {
    const PartitionStats s = partition(scene, out, {.domains = domains, .domains_at_once = 3});
    EXPECT_LT(static_cast<double>(s.triangles_max), 1.3 * s.triangles_mean) << domains << " domains";
  }
}

TEST_F(Streaming, BytesDoNotDependOnTheThreads) {
  const Scene scene = import_scene(written_scene(), MeshMemory(0)).scene;
  std::map<std::string, std::string> first;
  for (const int threads : {1, 2, 5}) {
    partition(scene, out, {.domains = 9, .domains_at_once = 2, .threads = threads});
    if (first.empty()) first = contents(out);
    EXPECT_TRUE(contents(out) == first) << threads << " threads give another bundle";
  }
}

TEST_F(Streaming, DeferredMeshesGiveTheSameBytes) {
  const std::filesystem::path file = written_scene();
  const Scene all = import_scene(file).scene, none = import_scene(file, MeshMemory(0)).scene;
  for (const TriangleMesh& mesh : none.meshes) EXPECT_TRUE(mesh.deferred && mesh.triangles.empty());
  for (const std::uint32_t at_once : {0u, 2u}) {
    partition(all, out, {.domains = 7, .domains_at_once = at_once});
    const auto expected = contents(out);
    EXPECT_FALSE(read_manifest(out).emissive_triangles.empty());
    partition(none, out, {.domains = 7, .domains_at_once = at_once});
    EXPECT_TRUE(contents(out) == expected) << at_once;
  }
}

// Meshes that no file of their own holds go to one without a name.
TEST_F(Streaming, MeshesInTheSceneFileGiveTheSameBytes) {
  const auto patch = [](int x, const char* more) {
    return fmt::format(
        "Shape \"trianglemesh\" \"point3 P\" [{0} 0 0 {1} 0 0 {1} 1 .5 {0} 1 0] "
        "\"integer indices\" [0 1 2 0 2 3] {2}\n",
        x, x + 1, more);
  };
  std::ofstream(directory / "in.pbrt")
      << "WorldBegin\n"
      << patch(0, "") << patch(2, "\"point2 uv\" [0 0 1 0 1 1 0 1]")
      << patch(4, "\"normal N\" [0 0 1 0 0 1 0 1 1 0 0 1]")
      << "Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 2 1 0 1 3 1 2 3 0 3 2] "
         "\"point3 P\" [7 0 0 8 0 0 7 1 0 7 0 1]\n";
  std::ofstream(directory / "in.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 1\nusemtl a\nf 1//1 2//1 3//1\n"
                                         "v 3 0 0\nv 4 0 0\nv 4 1 1\nusemtl b\nf 4 5 6\n";
  for (const char* name : {"in.pbrt", "in.obj"}) {
    const Scene all = import_scene(directory / name).scene,
                none = import_scene(directory / name, MeshMemory(0)).scene;
    ASSERT_EQ(none.meshes.size(), all.meshes.size());
    for (std::size_t i = 0; i < all.meshes.size(); ++i) {
      TriangleMesh storage;
      ASSERT_TRUE(none.meshes[i].deferred) << name;
      EXPECT_EQ(loaded(none.meshes[i], storage), all.meshes[i]) << name;
    }
    partition(all, out, {.domains = 3});
    const auto expected = contents(out);
    partition(none, out, {.domains = 3});
    EXPECT_TRUE(contents(out) == expected) << name;
  }
}

TEST_F(Streaming, FileThatIsCutShortMeanwhile) {
  const Scene scene = import_scene(written_scene(), MeshMemory(0)).scene;
  std::filesystem::resize_file(directory / "3.ply", 4000);
  try {
    partition(scene, out, {.domains = 7, .domains_at_once = 2});
    FAIL() << "the file is not whole";
  } catch (const Error& error) {
    EXPECT_NE(error.location.file.find("3.ply"), std::string::npos);
  }
  write_ply(bumpy_torus(9), directory / "3.ply");
  EXPECT_THROW(partition(scene, out, {.domains = 7, .domains_at_once = 2}), Error);
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with("scene.vit"));
}

TEST_F(Streaming, StopsWhereProgressThrows) {
  const Scene scene = scene_of(bumpy_torus(60));
  for (const double moment : {0.0, 0.2, 0.5, 0.9}) {
    const auto stop = [&](double fraction, const char*) {
      if (fraction >= moment) throw MachineError("stopped");
    };
    EXPECT_THROW(partition(scene, out, {.domains = 9, .domains_at_once = 2}, stop), MachineError);
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  }
}

TEST_F(Streaming, SaysWhatMemoryIsNeeded) {
  try {
    partition(scene_of(bumpy_torus(60)), out, {.domains = 2, .memory_bytes = 1 << 20});
    FAIL() << "it cannot fit";
  } catch (const MachineError& error) {
    EXPECT_NE(std::string(error.what()).find("try --memory "), std::string::npos);
  }
}

}  // namespace

}  // namespace vitrail::streaming_test
