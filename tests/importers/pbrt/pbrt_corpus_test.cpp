// SPDX-License-Identifier: Apache-2.0
// Every pbrt file of the corpus is imported, with triangles, a light or a report of their absence, and valid
// indices.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "importers/pbrt/read/pbrt.h"
#include "tests/support/paths.h"

namespace vitrail::pbrt_corpus_test {
namespace {

namespace fs = std::filesystem;

fs::path corpus() {
  const char* chosen = std::getenv("VITRAIL_CORPUS");
  return chosen ? fs::path(chosen) : fs::path(test::source_dir()) / ".." / "shared" / "corpus";
}

std::vector<fs::path> pbrt_files() {
  std::vector<fs::path> files;
  for (const char* folder : {"pbrt", "pbrt-v4"}) {
    if (!fs::exists(corpus() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(corpus() / folder))
      if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Files below another scene's folder name their own includes from there.
struct WorkingDirectory {
  explicit WorkingDirectory(const fs::path& to) : before(fs::current_path()) { fs::current_path(to); }
  ~WorkingDirectory() { fs::current_path(before); }
  fs::path before;
};

// And quadrics.
std::size_t primitives_of(const Scene& scene, const std::vector<Shape>& shapes) {
  std::size_t count = 0;
  for (const Shape& shape : shapes) {
    EXPECT_LT(shape.mesh.value, scene.meshes.size());
    EXPECT_LT(shape.material.value, scene.materials.size());
    if (shape.area_light) {
      EXPECT_LT(shape.area_light->value, scene.area_lights.size());
    }
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    count += mesh.quadric ? 1 : mesh.triangles.size();
  }
  return count;
}

TEST(PbrtCorpus, EveryFileIsImported) {
  if (!fs::exists(corpus() / "pbrt")) GTEST_SKIP() << "no corpus: set VITRAIL_CORPUS to its folder";
  const std::vector<fs::path> files = pbrt_files();
  ASSERT_GT(files.size(), 2u);
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    const WorkingDirectory directory(file.parent_path().parent_path());
    try {
      const ImportedScene imported = read_pbrt(file);
      const Scene& scene = imported.scene;
      std::size_t primitives = primitives_of(scene, scene.shapes);
      for (const Prototype& prototype : scene.prototypes)
        primitives += primitives_of(scene, prototype.shapes);
      EXPECT_GT(primitives, 0u);
      for (const TriangleMesh& mesh : scene.meshes)
        for (const auto& triangle : mesh.triangles)
          EXPECT_LT(std::max({triangle[0], triangle[1], triangle[2]}), mesh.positions.size());
      EXPECT_GT(scene.lights.size() + scene.area_lights.size(), 0u);
    } catch (const Error& error) {
      ADD_FAILURE() << to_string(error.location) << ": " << error.what() << "\n" << error.excerpt;
    }
  }
}

}  // namespace
}  // namespace vitrail::pbrt_corpus_test
