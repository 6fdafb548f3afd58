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
#include "scene/records/nesting.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::generators_test {
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
                      source_dir(), c.example, folder.string(), c.triangles, c.options));
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
                                         Case{"city", 300'000, "--buildings instances --nested"},
                                         Case{"terrain", 60'000, ""},
                                         Case{"terrain", 300'000, "--plants flattened --seed 3"},
                                         Case{"terrain", 100'000, "--plants none"}),
                         name_of);

// Those that take no number of triangles.
TEST(SmallGenerators, WriteTheSameEachTime) {
  const TemporaryDirectory directory;
  for (const std::string scene : {"cloud/cloud.pbrt --cells 16", "product/product.gltf --detail 0.2"}) {
    const std::string file = scene.substr(0, scene.find(' ')), options = scene.substr(file.size()),
                      folder = file.substr(0, file.find('/'));
    for (const std::string run_of : {"first/", "second/"}) {
      const CommandResult made =
          run(fmt::format("/usr/bin/python3 '{}/examples/{}/generate.py' -o '{}'{}", source_dir(), folder,
                          (directory / (run_of + folder)).string(), options));
      ASSERT_EQ(made.status, 0) << made.output;
    }
    const CommandResult exact =
        run(vitrail("inspect --strict '" + (directory / ("first/" + file)).string() + "'"));
    EXPECT_EQ(exact.status, 0) << exact.output;
  }
  EXPECT_EQ(digest(directory / "first"), digest(directory / "second"));
}

// Of all triangles of a material in the world: their number, area, centre and a wave summed over them, which
// notices what is elsewhere.
struct Matter {
  std::size_t triangles = 0;
  double area = 0, wave = 0;
  Vector3d centre{};  // times the area
};

std::map<std::string, Matter> matter(const Scene& nested) {
  const Scene scene = without_nested_instances(nested);
  std::map<std::string, Matter> all;
  const auto add = [&](const Shape& shape, const Transform& to_world) {
    const TriangleMesh& mesh = scene.meshes[shape.mesh.value];
    Matter& m = all[scene.materials[shape.material.value].name];
    for (const auto& t : mesh.triangles) {
      std::array<Point3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = transform_point(to_world, cast<double>(mesh.positions[t[k]]));
      const double area = 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
      const Vector3d c = ((p[0] - Point3d{}) + (p[1] - Point3d{}) + (p[2] - Point3d{})) * (1.0 / 3);
      ++m.triangles, m.area += area, m.centre = m.centre + c * area;
      m.wave += area * std::sin(0.9 * c.x + 1.3 * c.y + 1.9 * c.z);
    }
  };
  for (const Shape& shape : scene.shapes) add(shape, shape.object_to_world);
  for (const Instance& instance : scene.instances)
    for (const Shape& shape : scene.prototypes[instance.prototype.value].shapes)
      add(shape, instance.prototype_to_world * shape.object_to_world);
  return all;
}

// Instances within instances, the same flattened by the generator, and by `partition --flatten`, to the bit.
TEST(City, NestedIsTheSameScene) {
  const TemporaryDirectory directory;
  constexpr const char* options = "--nested --buildings instances --width 160 --height 90";
  const Generated nested = generate(directory / "nested", {"city", 200'000, options});
  const Generated flat =
      generate(directory / "flat", {"city", 200'000, fmt::format("{} --trees flattened", options)});
  const Scene scene = import_scene(nested.scene).scene, flat_scene = import_scene(flat.scene).scene;
  EXPECT_TRUE(has_nested_instances(scene));
  EXPECT_FALSE(has_nested_instances(flat_scene));
  EXPECT_EQ(nested.counts["triangles"], flat.counts["triangles"]);
  EXPECT_LT(nested.counts["unique_triangles"], flat.counts["unique_triangles"]);
  const auto kept = matter(scene), copied = matter(flat_scene);
  ASSERT_EQ(kept.size(), copied.size());
  for (const auto& [name, a] : kept) {
    const Matter& b = copied.at(name);
    EXPECT_EQ(a.triangles, b.triangles) << name;
    EXPECT_NEAR(a.area / b.area, 1, 1e-5) << name;
    EXPECT_LT(length(a.centre * (1 / a.area) - b.centre * (1 / b.area)), 1e-3)
        << name;  // six digits are written
    EXPECT_NEAR(a.wave / a.area, b.wave / b.area, 2e-3) << name;
  }

  std::map<std::string, nlohmann::json> films;
  for (const std::string how : {"--domains 9", "--domains 2 --flatten"}) {
    const auto bundle = (directory / "city.vit").string(), film = (directory / "city.film").string();
    const CommandResult made =
        run(fmt::format("{} '{}' -o '{}' {}", vitrail("partition"), nested.scene.string(), bundle, how));
    ASSERT_EQ(made.status, 0) << made.output;
    const CommandResult done =
        run(fmt::format("{} '{}' -o '{}' --force --spp 4 --threads 2 --stats '{}.json'", vitrail("render"),
                        bundle, film, film));
    ASSERT_EQ(done.status, 0) << done.output;
    films[how] = read_json(film + ".json")["film_hash"];
  }
  EXPECT_EQ(films["--domains 9"], films["--domains 2 --flatten"]);
}

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
}  // namespace vitrail::test::generators_test
