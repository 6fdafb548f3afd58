// SPDX-License-Identifier: Apache-2.0
// The first law where things move: one film, whatever the number of sub-domains, ranks and threads, the
// memory, the kernel, and whether instances that stand still are kept.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "bundle/loaded_domain.h"
#include "bundle/verify.h"
#include "partitioner/partition.h"
#include "tests/support/command.h"
#include "tests/support/ranks.h"
#include "tests/support/render.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"
#include "tracer/intersect/embree_domain.h"

namespace vitrail::test::one_picture_of_motion_test {
namespace {

class Random {
 public:
  double number(double scale) { return (static_cast<double>(bits_() >> 11) * 0x1p-52 - 1) * scale; }
  Vector3d vector(double scale) {
    const double x = number(scale), y = number(scale);
    return {x, y, number(scale)};
  }
  // Every third one mirrors.
  Transform place(double reach, double size, int i) {
    return translate(vector(reach)) * rotate(number(3), vector(1)) *
           scale({i % 3 == 0 ? -size : size, size * (1 + 0.3 * number(1)), size});
  }

 private:
  std::mt19937_64 bits_{5};
};

// Some move a little, some across the scene, some by three keyframes.
Motion motion(Random& random, int i, double size) {
  Transform t = random.place(6, size, i);
  std::vector<Keyframe> keys{{-0.5, t}};
  for (int k = 0; k < (i % 4 == 0 ? 2 : 1); ++k) {
    const double far = i % 5 == 0 ? 6 : 0.7;
    t = translate(random.vector(far)) * t * rotate(random.number(2), random.vector(1)) *
        scale({1 + 0.3 * random.number(1), 1, 1});
    keys.push_back({0.5 + k, t});
  }
  return Motion(std::move(keys));
}

// Tori, spheres of glass, twigs of both that turn within what holds them, one large ring in parts, in a
// moving camera's picture, which keeps its first surfaces too.
Scene moving_forest() {
  Scene scene;
  scene.materials = {Material{DiffuseMaterial{ConstantSpectrum{0.6f}}}, Material{DielectricMaterial{}},
                     Material{DiffuseMaterial{ConstantSpectrum{0}}}};
  scene.area_lights = {{ConstantSpectrum{20}, 1, true}};
  scene.meshes = {bumpy_torus(12), bumpy_torus(60), TriangleMesh{}};
  scene.meshes[2].quadric = Quadric{.kind = QuadricKind::sphere};
  scene.prototypes.resize(4);
  scene.prototypes[0].shapes = {{{0}, {0}}};
  scene.prototypes[1].shapes = {{{2}, {1}, {}, 1.0f, scale({2, 2, 1})},
                                {{0}, {0}, {}, 1.0f, scale({.4, .4, .4})}};
  scene.prototypes[3].shapes = {{{1}, {0}}};
  Random random;
  const auto moved = [&](int i, double size) {
    scene.motions.push_back(motion(random, i, size));
    return Id<Motion>{static_cast<std::uint32_t>(scene.motions.size() - 1)};
  };
  const auto put = [&](std::vector<Instance>& to, std::uint32_t prototype, int i, double size) {
    const Id<Motion> m = moved(i, size);
    to.push_back({{prototype}, scene.motions[m.value].at(0), {}, m});
  };
  for (int i = 0; i < 4; ++i) put(scene.prototypes[2].instances, static_cast<std::uint32_t>(i % 2), i, 0.3);
  scene.prototypes[2].instances.push_back({{0}, random.place(2, 0.5, 1)});
  for (int i = 0; i < 24; ++i) put(scene.instances, static_cast<std::uint32_t>(i % 3), i, 0.4);
  for (int i = 0; i < 24; ++i)
    scene.instances.push_back({{static_cast<std::uint32_t>(i % 3)}, random.place(7, 0.4, i)});
  put(scene.instances, 3, 1, 2);
  add_shape(scene, add_quads(scene, {{{{-20, -20, -9}, {20, -20, -9}, {20, 20, -9}, {-20, 20, -9}}}}),
            scene.materials[0]);
  add_shape(scene, add_quads(scene, {{{{-3, -3, 9}, {-3, 3, 9}, {3, 3, 9}, {3, -3, 9}}}}), scene.materials[2],
            AreaLight{ConstantSpectrum{20}, 1, true});
  scene.lights.push_back({InfiniteLight{ConstantSpectrum{0.3f}}});
  set_camera(scene, {18, -16, 12}, {0, 0, 0}, {0, 0, 1}, 0.8, 40, 40);
  const Transform camera = std::get<PerspectiveCamera>(scene.camera).camera_to_world;
  scene.camera_motion = Motion({{0, camera}, {1, rotate(0.05, {0, 0, 1}) * camera}});
  scene.film.layers.bits = 0;
  for (const Layer layer : {Layer::position, Layer::depth, Layer::motion, Layer::crypto_object})
    scene.film.layers.add(layer);
  scene.film.layers.in_camera_space = true;
  return scene;
}

class OnePictureOfMotion : public testing::Test {
 protected:
  std::filesystem::path bundle(const std::string& name, PartitionOptions options) {
    if (options.domain_bytes == 0) options.domain_bytes = 200'000;
    stats_ = partition(scene_, directory_ / name, options);
    for (const VerifyFinding& f : verify_bundle(directory_ / name).problems)
      ADD_FAILURE() << f.file << ": " << f.what;
    return directory_ / name;
  }
  std::string render(const std::filesystem::path& bundle, int ranks, const std::string& more = "",
                     const std::string& environment = "") {
    const auto stats = directory_ / "stats.json";
    const CommandResult done = run(fmt::format("{} {} '{}' -o '{}' --force --spp 4 --stats '{}' {}",
                                               environment, vitrail_on(ranks, "render"), bundle.string(),
                                               (directory_ / "a.film").string(), stats.string(), more));
    EXPECT_EQ(done.status, 0) << done.output;
    if (done.status != 0) return "";
    const auto json = read_json(stats);
    EXPECT_EQ(json["nonfinite_samples"], 0);
    forwarded_ += json["forwarded_rays"].get<std::uint64_t>();
    return json["film_hash"];
  }

  Scene scene_ = moving_forest();
  TemporaryDirectory directory_;
  PartitionStats stats_;
  std::uint64_t forwarded_ = 0;
};

TEST_F(OnePictureOfMotion, WhateverTheDomainsRanksMemoryAndKernels) {
  const auto whole = bundle("1.vit", {.domains = 1});
  const std::string film = render(whole, 1, "--threads 2");
  ASSERT_FALSE(film.empty());
  for (const int domains : {8, 64}) {
    const auto cut = bundle(fmt::format("{}.vit", domains), {.domains = static_cast<std::uint32_t>(domains)});
    EXPECT_EQ(read_manifest(cut).scene_hash, read_manifest(whole).scene_hash);
    std::uint64_t bytes = 0, largest = 0;
    const Manifest m = read_manifest(cut);
    for (std::uint32_t d = 0; d < m.domains.size(); ++d) {
      largest = std::max(largest, bytes_needed(m, d));
      bytes += m.domains[d].bytes;
    }
    EXPECT_GT(m.objects.size(), 20u);
    const std::string little =
        fmt::format("--domain-memory {} --shuffle-delivery 1", std::max(largest, bytes / 4));
    EXPECT_EQ(render(cut, 1, "--threads 2"), film) << domains;
    EXPECT_EQ(render(cut, 2, "--threads 1 " + little), film) << domains;
    EXPECT_EQ(render(cut, 3, "--threads 1 --distribution decompose"), film) << domains;
    for (const Kernel kernel : available_kernels())
      EXPECT_EQ(render(cut, 1, "", fmt::format("VITRAIL_KERNEL={}", name(kernel))), film) << name(kernel);
  }
  EXPECT_GT(forwarded_, 1000u);
  EXPECT_EQ(render(bundle("flat.vit", {.domains = 8, .flatten = true}), 1), film) << "flattened";
}

TEST_F(OnePictureOfMotion, OutOfCore) {
  scene_.meshes.push_back(bumpy_torus(400));
  scene_.shapes.push_back({{static_cast<std::uint32_t>(scene_.meshes.size() - 1)},
                           {0},
                           {},
                           1.0f,
                           translate({0, 0, -6}) * scale({4, 4, 1})});
  const std::string film = render(bundle("whole.vit", {.domains = 1}), 1);
  const auto parts = bundle("parts.vit", {.domains = 16, .memory_bytes = std::uint64_t{56} << 20});
  EXPECT_GT(stats_.buckets, 1u);
  EXPECT_EQ(render(parts, 1), film);
}

// Nothing of motion is in a bundle where nothing moves.
TEST_F(OnePictureOfMotion, CostsNothingWhereThereIsNone) {
  scene_.camera_motion = {};
  scene_.motions.clear();
  scene_.film.layers.remove(Layer::motion);
  const auto still = [](std::vector<Instance>& instances) {
    for (Instance& instance : instances) instance.motion.reset();
  };
  still(scene_.instances);
  for (Prototype& prototype : scene_.prototypes) still(prototype.instances);
  const auto path = bundle("still.vit", {.domains = 2});
  std::ifstream file(path / "manifest.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text.find("motion"), std::string::npos);
  EXPECT_EQ(text.find("shutter"), std::string::npos);
  EXPECT_FALSE(read_manifest(path).requirements.motion);
}

// Every kernel and the reference traversal find the same at any time; and what they find is within the
// bounds.
TEST_F(OnePictureOfMotion, TheReferenceTraversalSeesTheSame) {
  const auto path = bundle("1.vit", {.domains = 1, .domain_bytes = 1 << 30});
  const Manifest m = read_manifest(path);
  const auto domain = load_domain(m, path, 0);
  const EmbreeDomain embree(domain->view());
  Random random;
  int hits = 0, moved = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d from = random.vector(12), to = random.vector(5) - from;
    const Ray ray{cast<float>(Point3d{} + from), cast<float>(to)};
    const double time = 0.5 + random.number(0.7);
    Hit reference;
    embree.closest(prepare(ray, time), reference);
    Hit earlier;
    embree.closest(prepare(ray, time - 0.1), earlier);
    hits += reference.triangle != no_triangle;
    moved += reference.t != earlier.t;
    for (const Kernel kernel : available_kernels()) {
      Hit hit;
      kernel_functions(kernel).closest(domain->view(), prepare(ray, time), hit);
      ASSERT_EQ(hit.triangle, reference.triangle) << name(kernel) << ' ' << i;
      ASSERT_EQ(hit.t, reference.t);
      const float beyond = static_cast<float>(std::min(reference.t * 1.001, 1e30));
      ASSERT_EQ(kernel_functions(kernel).occluded(domain->view(), prepare(ray, time), beyond),
                embree.occluded(prepare(ray, time), beyond));
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(moved, 50);
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_motion_test
