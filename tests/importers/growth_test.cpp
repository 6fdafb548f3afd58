// SPDX-License-Identifier: Apache-2.0
// Eight times as many things take about eight times as long, not 64 times.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>

#include "importers/export.h"
#include "importers/import.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::growth_test {
namespace {

constexpr int few = 1000, many = 8 * few;
constexpr double least_s = 0.01;  // below this a clock of 10 ms says nothing

class Growth : public ::testing::Test {
 protected:
  // Processor time of the quickest of three: whatever else the machine does.
  static double seconds(const std::function<void()>& work) {
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      const std::clock_t start = std::clock();
      work();
      least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return std::max(least, least_s);
  }

  // `write(n)` makes the file, `work` is timed.
  void expect_linear(const std::function<void(int)>& write, const std::function<void()>& work) {
    write(few);
    const double before = seconds(work);
    write(many);
    EXPECT_LT(seconds(work) / before, 24);
  }

  std::string repeated(const std::function<std::string(int)>& line, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += line(i);
    return text;
  }

  void expect_export_is_linear(const Scene& few_records, const Scene& many_records, const char* file) {
    const double before = seconds([&] { export_scene(few_records, folder_ / file); });
    EXPECT_LT(seconds([&] { export_scene(many_records, folder_ / file); }) / before, 24) << file;
  }

  TemporaryFolder folder_;
};

Scene with_materials(int count, const std::function<Material(int)>& make) {
  Scene scene;
  scene.meshes.push_back({.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  for (int i = 0; i < count; ++i) {
    scene.materials.push_back(make(i));
    scene.shapes.push_back({Id<TriangleMesh>{0}, Id<Material>{static_cast<std::uint32_t>(i)}});
  }
  return scene;
}

TEST_F(Growth, EqualNames) {
  const auto make = [](int) {
    Material material{DiffuseMaterial{}};
    material.name = "same";
    return material;
  };
  for (const char* file : {"a.xml", "a.pbrt", "a.obj"})
    expect_export_is_linear(with_materials(few, make), with_materials(many, make), file);
}

TEST_F(Growth, TexturesOfBumpsAndNormals) {
  const auto scene = [&](int count) {
    std::vector<Texture> textures;
    Scene made = with_materials(count, [&](int) {
      const auto next = static_cast<std::uint32_t>(textures.size());
      textures.push_back({ImageTexture{(folder_ / "none.png").string()}, true});
      textures.push_back({ProductTexture{Id<Texture>{next}, Spectrum{ConstantSpectrum{0.5f}}}, true});
      textures.push_back({ImageTexture{(folder_ / "none.png").string()}});
      Material material{DiffuseMaterial{}};
      material.displacement = Id<Texture>{next + 1};
      material.normal_map = Id<Texture>{next + 2};
      return material;
    });
    made.textures = std::move(textures);
    return made;
  };
  expect_export_is_linear(scene(few), scene(many), "a.xml");
}

TEST_F(Growth, MaterialsOfMtl) {
  folder_.write("a.png", "");
  const auto write = [&](int count) {
    folder_.write("a.mtl", repeated(
                               [&](int i) {
                                 return fmt::format("newmtl m{}\nKd {:.6f}\nKa 1 1 1\nmap_Kd a.png\n", i,
                                                    0.1 + 0.8 * i / count);
                               },
                               count));
    folder_.write("a.obj",
                  "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" +
                      repeated([](int i) { return fmt::format("usemtl m{}\nf 1 2 3\n", i); }, count));
  };
  expect_linear(write, [&] {
    const ImportedScene imported = import_scene(folder_ / "a.obj");
    EXPECT_EQ(imported.scene.textures.size(), imported.scene.materials.size());
  });
}

// Of n levels of two instances each.
TEST_F(Growth, NestedObjectsAreWrittenWithTheRootOfTheirShapes) {
  std::string text =
      "WorldBegin ObjectBegin \"o0\" Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ObjectEnd\n";
  constexpr int levels = 20;
  for (int i = 0; i < levels; ++i)
    text += fmt::format(
        "ObjectBegin \"o{0}\" ObjectInstance \"o{1}\" Translate {2} 0 0 ObjectInstance \"o{1}\" ObjectEnd\n",
        i + 1, i, 1 << i);
  folder_.write("nested.pbrt", text + fmt::format("ObjectInstance \"o{}\"\n", levels));
  const Scene scene = import_scene(folder_ / "nested.pbrt").scene;
  for (const char* file : {"a.xml", "a.pbrt", "a.pov"}) {
    export_scene(scene, folder_ / file);
    EXPECT_LT(std::filesystem::file_size(folder_ / file), 4u << 20) << file;
  }
}

// An object of n shapes of one mesh of 4n vertices, in n places.
TEST_F(Growth, InstancesOfLargeObjects) {
  const auto scene = [](std::uint32_t count) {
    Scene made = with_materials(1, [](int) { return Material{DiffuseMaterial{}}; });
    for (std::uint32_t i = 3; i < 4 * count; ++i) made.meshes[0].positions.push_back({1, 1, 1});
    const Shape shape = made.shapes[0];
    made.shapes.clear();
    Prototype& prototype = made.prototypes.emplace_back();
    prototype.shapes.resize(count, shape);
    for (std::uint32_t i = 0; i < count; ++i)
      made.instances.push_back({{0}, translate({static_cast<double>(i), 0, 0}), {}});
    return made;
  };
  expect_export_is_linear(scene(few), scene(many), "a.xml");
}

}  // namespace
}  // namespace vitrail::growth_test
