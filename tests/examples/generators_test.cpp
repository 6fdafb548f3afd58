// SPDX-License-Identifier: Apache-2.0
// The generators of large scenes: they write the triangles asked for, sound ones, in little memory, the same
// each time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>

#include "importers/import.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {
namespace {

struct Case {
  std::string example;
  std::uint64_t triangles;
  std::string options;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name = fmt::format("{}{}{}", info.param.example, info.param.triangles, info.param.options);
  std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
  return name;
}

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.example << " --triangles " << c.triangles << ' ' << c.options;
}

struct Generated {
  std::filesystem::path scene;
  nlohmann::json counts;
  std::uint64_t peak_bytes = 0;
};

// Python is asked for the peak of the generator, its child.
Generated generate(const std::filesystem::path& folder, const Case& c) {
  const CommandResult made =
      run(fmt::format("/usr/bin/python3 -c 'import resource, subprocess, sys; "
                      "subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); "
                      "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)' "
                      "/usr/bin/python3 '{}/examples/{}/generate.py' -o '{}' --triangles {} {}",
                      VITRAIL_SOURCE_DIR, c.example, folder.string(), c.triangles, c.options));
  EXPECT_EQ(made.status, 0) << made.output;
  if (made.status != 0) return {};
  return {folder / (c.example + ".pbrt"), read_json(folder / (c.example + ".json")),
          std::stoull(made.output) * 1024};
}

std::string digest(const std::filesystem::path& folder) {
  return run(fmt::format("cd '{}' && find . -type f | LC_ALL=C sort | xargs sha256sum | sha256sum",
                         folder.string()))
      .output;
}

bool has_area(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const auto corner = [&](std::size_t k) { return cast<double>(mesh.positions[t[k]]); };
  return length(cross(corner(1) - corner(0), corner(2) - corner(0))) > 0;
}

// Finite, every triangle with an area, every vertex used.
void expect_sound(const TriangleMesh& mesh, std::size_t number) {
  std::vector<bool> used(mesh.positions.size());
  std::size_t flat = 0;
  for (const auto& t : mesh.triangles) {
    flat += !has_area(mesh, t);
    for (const std::uint32_t corner : t) used[corner] = true;
  }
  EXPECT_EQ(flat, 0u) << "mesh " << number;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "mesh " << number;
  for (const Point3f& p : mesh.positions) {
    if (!is_finite(p)) ADD_FAILURE() << "mesh " << number << " has a vertex that is not finite";
  }
}

class Generators : public testing::TestWithParam<Case> {};

TEST_P(Generators, WriteWhatTheySay) {
  const TemporaryDirectory directory;
  const Generated first = generate(directory / "first", GetParam());
  ASSERT_FALSE(first.scene.empty());
  const auto triangles = first.counts["triangles"].get<std::uint64_t>();
  EXPECT_NEAR(static_cast<double>(triangles), static_cast<double>(GetParam().triangles),
              0.02 * static_cast<double>(GetParam().triangles));
  EXPECT_LT(first.peak_bytes, 100u << 20);

  const CommandResult inspected = run(vitrail("inspect --json '" + first.scene.string() + "'"));
  ASSERT_EQ(inspected.status, 0) << inspected.output;
  EXPECT_EQ(nlohmann::json::parse(inspected.output)["triangles"], triangles);

  const ImportedScene imported = import_scene(first.scene);
  EXPECT_TRUE(imported.diagnostics.empty());
  std::uint64_t stored = 0;
  for (std::size_t i = 0; i < imported.scene.meshes.size(); ++i) {
    stored += imported.scene.meshes[i].triangles.size();
    expect_sound(imported.scene.meshes[i], i);
  }
  EXPECT_EQ(stored, first.counts["unique_triangles"]);
  EXPECT_EQ(imported.scene.meshes.size(), first.counts["meshes"]);
  EXPECT_EQ(imported.scene.instances.size(), first.counts["instances"]);

  generate(directory / "second", GetParam());
  EXPECT_EQ(digest(directory / "first"), digest(directory / "second"));
}

INSTANTIATE_TEST_SUITE_P(Examples, Generators,
                         testing::Values(Case{"city", 80'000, ""},
                                         Case{"city", 200'000, "--trees flattened --seed 3"},
                                         Case{"city", 300'000, "--buildings instances"},
                                         Case{"terrain", 60'000, ""},
                                         Case{"terrain", 300'000, "--plants flattened --seed 3"},
                                         Case{"terrain", 100'000, "--plants none"}),
                         name_of);

// Neighbouring tiles share their border's vertices to the last bit: the edges that one triangle alone has lie
// on the outer border.
TEST(Terrain, TilesMeet) {
  const TemporaryDirectory directory;
  const Generated made = generate(directory / "terrain", {"terrain", 500'000, "--plants none"});
  ASSERT_GT(made.counts["tiles"], 1);
  const Scene scene = import_scene(made.scene).scene;
  std::map<std::array<float, 6>, int> uses;  // an edge by its ends
  for (const Shape& shape : scene.shapes) {
    const std::string& name = scene.materials[shape.material.value].name;
    if (name == "water" || name.starts_with("rock")) continue;
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        Point3f a = mesh.positions[t[k]], b = mesh.positions[t[(k + 1) % 3]];
        if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
        ++uses[{a.x, a.y, a.z, b.x, b.y, b.z}];
      }
  }
  float edge = 0;
  for (const auto& [e, count] : uses) edge = std::max({edge, e[0], e[1]});
  std::size_t inside = 0, outside = 0;
  for (const auto& [e, count] : uses) {
    if (count == 2) continue;
    const bool on_border =
        (e[0] == e[3] && std::abs(e[0]) == edge) || (e[1] == e[4] && std::abs(e[1]) == edge);
    ++(on_border ? outside : inside);
  }
  EXPECT_EQ(inside, 0u);
  EXPECT_GT(outside, 0u);
}

}  // namespace
}  // namespace vitrail::test
