// SPDX-License-Identifier: Apache-2.0
// The first law, for instances: the film of a scene that keeps them is that of the scene flattened, bit for
// bit, whatever the number of sub-domains, ranks and threads, and the memory.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "bundle/loaded_domain.h"
#include "bundle/triangle_number.h"
#include "bundle/verify.h"
#include "farm/scheduler/residency.h"
#include "partitioner/partition.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/ranks.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::test::kept_instances_test {
namespace {

constexpr std::uint64_t mib = 1 << 20;

Id<Material> add(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return {static_cast<std::uint32_t>(scene.materials.size() - 1)};
}

Id<TriangleMesh> add_torus(Scene& scene, int n) {
  TriangleMesh mesh = bumpy_torus(n);
  for (const Point3f& p : mesh.positions) mesh.uvs.push_back({p.x, p.y + p.z});
  scene.meshes.push_back(std::move(mesh));
  return {static_cast<std::uint32_t>(scene.meshes.size() - 1)};
}

// With a grid of faces that do not lie in a plane, so that its triangles differ.
Id<TriangleMesh> add_leaf(Scene& scene) {
  std::vector<std::array<Point3f, 4>> quads;
  const auto at = [](int i, int j) {
    const auto x = static_cast<float>(i), y = static_cast<float>(j);
    return Point3f{x / 4 - 0.5f, y / 4 - 0.5f, 0.02f * x * y};
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return add_quads(scene, quads);
}

class Placer {
 public:
  double number(double scale) { return (static_cast<double>(bits_() >> 11) * 0x1p-52 - 1) * scale; }
  Vector3d vector(double scale) {
    const double x = number(scale), y = number(scale);
    return {x, y, number(scale)};
  }
  // Turned, stretched, every third one mirrored.
  Transform place(Vector3d where, double size, int i) {
    const double mirror = i % 3 == 0 ? -1 : 1;
    return translate(where) * rotate(number(3), vector(1)) *
           scale({mirror * size, size * (1 + 0.4 * number(1)), size * (i % 5 == 0 ? 0.2 : 1)});
  }

 private:
  std::mt19937_64 bits_{11};
};

// Rocks with textures, leaves with masks and with holes, twigs that hold both, lamps with holes, one large
// ring that spans everything, and a floor, all of it far from the origin.
Scene forest(Vector3d far) {
  Scene scene;
  scene.textures = {Texture{CheckerboardTexture{ConstantSpectrum{0.1f}, ConstantSpectrum{0.8f}}},
                    Texture{CheckerboardTexture{ConstantSpectrum{0}, ConstantSpectrum{1}}}};
  scene.textures[1].is_float = true;
  const Id<Material> board = add(scene, Material{DiffuseMaterial{Id<Texture>{0}}});
  const Id<Material> green = add(scene, Material{DiffuseMaterial{ConstantSpectrum{0.4f}}});
  const Id<Material> mask = add(scene, Material{MaskMaterial{Id<Texture>{1}, green}});
  const Id<Material> glass = add(scene, Material{DielectricMaterial{}});
  const Id<Material> black = add(scene, Material{DiffuseMaterial{ConstantSpectrum{0}}});
  scene.area_lights = {{ConstantSpectrum{30}, 1, true}};
  const Id<TriangleMesh> rock = add_torus(scene, 12), ring = add_torus(scene, 60), leaf = add_leaf(scene);

  Placer random;
  scene.prototypes.resize(5);
  scene.prototypes[0].shapes = {{rock, board}, {leaf, mask, {}, 1.0f, translate({0, 0, 1})}};
  scene.prototypes[1].shapes = {{leaf, green, {}, Id<Texture>{1}}};
  scene.prototypes[1].shapes[0].flip_orientation = true;
  for (int i = 0; i < 6; ++i) {
    const std::uint32_t part = i % 2;
    scene.prototypes[2].instances.push_back(
        {Id<Prototype>{part}, random.place(random.vector(3), part == 0 ? 0.3 : 1.5, i)});
  }
  scene.prototypes[2].shapes = {{rock, glass, {}, 1.0f, scale({0.3, 0.3, 0.3})}};
  scene.prototypes[3].shapes = {{leaf, black, Id<AreaLight>{0}, Id<Texture>{1}}};
  scene.prototypes[4].shapes = {{ring, board}};

  for (int i = 0; i < 60; ++i) {
    const std::uint32_t prototype = static_cast<std::uint32_t>(i) % 4;
    scene.instances.push_back({Id<Prototype>{prototype}, random.place(far + random.vector(8), 0.6, i)});
  }
  scene.instances.push_back({Id<Prototype>{4}, random.place(far, 2.5, 1)});
  scene.instances.push_back({Id<Prototype>{4}, random.place(far + Vector3d{0, 1, 0}, 2.2, 3)});
  scene.instances.push_back({Id<Prototype>{0}, translate(far) * scale({1, 1, 0})});  // cannot be kept
  const Id<TriangleMesh> floor =
      add_quads(scene, {{{{-20, -20, -9}, {20, -20, -9}, {20, 20, -9}, {-20, 20, -9}}}});
  scene.shapes.push_back({floor, green, {}, 1.0f, translate(far)});
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{0.3f}}});
  const Point3d target = Point3d{} + far;
  set_camera(scene, target + Vector3d{18, -16, 12}, target, {0, 0, 1}, 0.8, 48, 48);
  return scene;
}

// Shapes of one mesh that become instances: on three surfaces, mirrored, some that shine, one that is
// flattened; the forest's objects beside them.
Scene crowd() {
  Scene scene = forest({});
  const Id<TriangleMesh> stone = add_torus(scene, 50);
  Placer random;
  for (int i = 0; i < 160; ++i) {
    Shape shape{stone, Id<Material>{i % 2 == 0 ? 0u : 1u}, {}, 1.0f, random.place(random.vector(8), 0.5, i)};
    if (i % 3 == 0) shape.flip_orientation = true;  // those that are mirrored
    if (i > 40 && i % 2 == 1) shape.area_light = Id<AreaLight>{0};
    scene.shapes.push_back(shape);
  }
  scene.shapes.push_back({stone, Id<Material>{0}, {}, 1.0f, scale({1, 1, 0})});
  return scene;
}

class Films {
 public:
  explicit Films(const Scene& scene) : scene_(scene) {}

  std::filesystem::path bundle(const std::string& name, const PartitionOptions& options) const {
    partition(scene_, directory_ / name, options);
    for (const VerifyFinding& f : verify_bundle(directory_ / name).problems)
      ADD_FAILURE() << f.file << ": " << f.what;
    return directory_ / name;
  }

  nlohmann::json render(const std::filesystem::path& bundle, int ranks, int threads,
                        const std::string& more = "") const {
    const auto stats = directory_ / "stats.json";
    const CommandResult done = run(fmt::format(
        "{} '{}' -o '{}' --force --spp 4 --threads {} --stats '{}' {}", vitrail_on(ranks, "render"),
        bundle.string(), (directory_ / "a.film").string(), threads, stats.string(), more));
    EXPECT_EQ(done.status, 0) << done.output;
    return done.status == 0 ? read_json(stats) : nlohmann::json();
  }

 private:
  const Scene& scene_;
  TemporaryDirectory directory_;
};

// A quarter of the bundle for domains and objects, but room for what the greatest domain needs.
std::string quarter(const Manifest& m, const nlohmann::json& everything, int threads) {
  std::uint64_t largest = 0;
  for (std::uint32_t d = 0; d < m.domains.size(); ++d) largest = std::max(largest, bytes_needed(m, d));
  const std::uint64_t domains = std::max(bytes_of_all(m) / 4, largest);
  const std::uint64_t rank = std::max(everything["setup_peak_rss_bytes"].get<std::uint64_t>() + mib,
                                      everything["base_rss_bytes"].get<std::uint64_t>() +
                                          (9 + static_cast<unsigned>(threads)) * mib + domains + domains / 4);
  return fmt::format("--memory {} --domain-memory {}", rank, domains);
}

// Each number of ranks and each of threads meets some of domains; with VITRAIL_LONG_TESTS all of them.
std::vector<int> ranks_with(int domains) {
  if (are_long()) return {1, 2};
  return {domains == 8 ? 2 : 1};
}
std::vector<int> threads_with(int domains) {
  if (are_long()) return {1, 2};
  return {domains == 64 ? 2 : 1};
}

void expect_the_flattened_film(const Scene& scene, const std::vector<int>& counts) {
  const Films films(scene);
  const auto flat = films.bundle("flat.vit", {.domains = 1, .flatten = true});
  const nlohmann::json reference = films.render(flat, 1, 2);
  ASSERT_FALSE(reference.is_null());
  EXPECT_EQ(reference["nonfinite_samples"], 0);
  EXPECT_TRUE(read_manifest(flat).objects.empty());
  const auto check = [&](const nlohmann::json& stats, const std::string& what) {
    ASSERT_FALSE(stats.is_null()) << what;
    EXPECT_EQ(stats["film_hash"], reference["film_hash"]) << what;
    const auto budget = stats["memory_budget_bytes"].get<std::uint64_t>();
    if (budget > 0) {
      EXPECT_LE(stats["peak_rss_bytes"].get<std::uint64_t>(), budget) << what;
    }
  };
  const auto flat_8 = films.bundle("flat-8.vit", {.domains = 8, .flatten = true});
  check(films.render(flat_8, 2, 2), "flattened, 8 domains");
  for (const int domains : counts) {
    const auto kept = films.bundle(fmt::format("{}.vit", domains),
                                   {.domains = static_cast<std::uint32_t>(domains), .domain_bytes = 200'000});
    const Manifest m = read_manifest(kept);
    EXPECT_GT(m.objects.size(), 6u) << "the ring is in parts";
    for (const int ranks : ranks_with(domains))
      for (const int threads : threads_with(domains)) {
        const std::string what = fmt::format("{} domains, {} ranks, {} threads", domains, ranks, threads);
        const nlohmann::json all = films.render(kept, ranks, threads);
        check(all, what);
        if (all.is_null()) return;
        check(films.render(kept, ranks, threads, quarter(m, all, threads)),
              what + ", a quarter of the memory");
      }
  }
}

TEST(KeptInstances, HaveTheFilmOfTheFlattenedScene) { expect_the_flattened_film(forest({}), {1, 8, 64}); }

TEST(KeptInstances, FarFromTheOrigin) { expect_the_flattened_film(forest({1e6, -2e6, 3e5}), {1, 8}); }

TEST(KeptInstances, ShapesThatShareAMesh) {
  const Scene scene = crowd();
  const TemporaryDirectory directory;
  partition(scene, directory / "kept.vit", {.domains = 2});
  partition(forest({}), directory / "forest.vit", {.domains = 2});
  EXPECT_EQ(read_manifest(directory / "kept.vit").objects.size(),
            read_manifest(directory / "forest.vit").objects.size() + 2)
      << "those of the third surface are too few";
  expect_the_flattened_film(scene, {1, 8});
}

// In parts that are in memory one after the other.
TEST(KeptInstances, OutOfCore) {
  Scene scene = forest({});
  scene.shapes.push_back(
      {add_torus(scene, 400), Id<Material>{1}, {}, 1.0f, translate({0, 0, -6}) * scale({4, 4, 1})});
  const Films films(scene);
  const nlohmann::json reference =
      films.render(films.bundle("flat.vit", {.domains = 1, .flatten = true}), 1, 2);
  const TemporaryDirectory directory;
  const PartitionStats stats =
      partition(scene, directory / "kept.vit", {.domains = 16, .memory_bytes = 56 * mib});
  EXPECT_GT(stats.buckets, 1u);
  EXPECT_GT(stats.instances, 60u);
  const nlohmann::json kept = films.render(directory / "kept.vit", 1, 2);
  ASSERT_FALSE(reference.is_null() || kept.is_null());
  EXPECT_EQ(kept["film_hash"], reference["film_hash"]);
}

// A unit square of n · m quads.
Id<TriangleMesh> add_grid(Scene& scene, int n, int m) {
  std::vector<std::array<Point3f, 4>> quads;
  const auto at = [&](int i, int j) {
    return Point3f{static_cast<float>(i) / static_cast<float>(n) - 0.5f,
                   static_cast<float>(j) / static_cast<float>(m) - 0.5f, 0};
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  return add_quads(scene, quads);
}

// With instances below the floor, in up to three levels, of a square of 2·side² triangles: so many that,
// where side is 46, numbers begin anew within the first of the forest's lamps.
Scene on_sand(Scene scene, int side) {
  constexpr std::uint64_t before_lamp =
      322 + 1696 + 16;  // what has no instance, three instances, half a lamp
  Prototype next;
  next.shapes = {{add_grid(scene, side, side), Id<Material>{1}}};
  std::vector<Instance> sand;
  std::uint64_t left = triangle_numbers - before_lamp, triangles = 2 * 46 * 46 * 1'000'000ull;
  std::array<std::uint64_t, 4> counts;  // of level 3, 2, 1, 0
  for (std::uint64_t& count : counts) {
    count = left / triangles;
    left -= count * triangles;
    triangles /= 100;
  }
  for (std::size_t level = 0; level < 4; ++level) {
    scene.prototypes.push_back(std::exchange(next, {}));
    const Id<Prototype> it{static_cast<std::uint32_t>(scene.prototypes.size() - 1)};
    for (std::uint64_t i = 0; i < counts[3 - level]; ++i)
      sand.push_back({it, translate({0, 0, -9.5 - 0.01 * static_cast<double>(i)}) * scale({30, 30, 1})});
    for (int i = 0; i < 100; ++i)
      next.instances.push_back(
          {it, translate({i % 10 * 0.1 - 0.45, i / 10 * 0.1 - 0.45, 0}) * scale({0.1, 0.1, 1})});
  }
  scene.instances.insert(scene.instances.begin(), sand.begin(), sand.end());
  scene.shapes.push_back({add_grid(scene, static_cast<int>(left / 2), 1),
                          Id<Material>{1},
                          {},
                          1.0f,
                          translate({0, 0, -9.5}) * scale({30, 30, 1})});
  return scene;
}

// What is seen is the same, the numbers of its triangles are not (laws/exact/instances_test.cpp has the
// hits).
TEST(KeptInstances, OfMoreTrianglesThanNumbers) {
  const Scene few = on_sand(forest({}), 8), many = on_sand(forest({}), 46);
  const Films films_of_few(few), films(many);
  const auto small = films_of_few.bundle("small.vit", {.domains = 1});
  ASSERT_LT(read_manifest(small).triangles, triangle_numbers);
  const nlohmann::json reference = films_of_few.render(small, 1, 2);
  for (const PartitionOptions& options :
       {PartitionOptions{.domains = 1}, {.domains = 3, .domain_bytes = 100'000}}) {
    const auto large = films.bundle("large.vit", options);
    const Manifest m = read_manifest(large);
    EXPECT_GT(m.triangles, triangle_numbers);
    const auto anew = std::ranges::find(m.emissive_triangles, 0u, &EmissiveTriangle::triangle);
    ASSERT_TRUE(anew > m.emissive_triangles.begin() && anew < m.emissive_triangles.end());
    EXPECT_EQ((anew - 1)->triangle, triangle_numbers - 1);
    for (const int ranks : {1, 2})
      EXPECT_EQ(films.render(large, ranks, 2)["film_hash"], reference["film_hash"])
          << options.domains << " domains, " << ranks << " ranks";
  }
}

void expect_the_flattened_lights(const Scene& scene) {
  const TemporaryDirectory directory;
  partition(scene, directory / "kept.vit", {.domains = 2});
  partition(scene, directory / "flat.vit", {.domains = 2, .flatten = true});
  const Manifest kept = read_manifest(directory / "kept.vit"), flat = read_manifest(directory / "flat.vit");
  EXPECT_EQ(kept.triangles, flat.triangles);
  EXPECT_EQ(kept.bounds, flat.bounds);
  EXPECT_EQ(kept.offset, flat.offset);
  ASSERT_GT(kept.emissive_triangles.size(), 100u);
  ASSERT_EQ(kept.emissive_triangles.size(), flat.emissive_triangles.size());
  for (std::size_t i = 0; i < kept.emissive_triangles.size(); ++i) {
    EXPECT_EQ(kept.emissive_triangles[i].triangle, flat.emissive_triangles[i].triangle);
    EXPECT_EQ(kept.emissive_triangles[i].p[1], flat.emissive_triangles[i].p[1]);
  }
}

TEST(KeptInstances, LightsOfInstancesShineTheSame) { expect_the_flattened_lights(forest({})); }

TEST(KeptInstances, LightsOfShapesThatShareAMeshShineTheSame) { expect_the_flattened_lights(crowd()); }

}  // namespace
}  // namespace vitrail::test::kept_instances_test
