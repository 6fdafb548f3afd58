// SPDX-License-Identifier: Apache-2.0
#include "partitioner/partition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <map>
#include <random>

#include "bundle/verify.h"
#include "scene/system/diagnostics.h"
#include "tests/partitioner/bundle_contents.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_scenes.h"

namespace vitrail::partition_test {

namespace {

namespace fs = std::filesystem;
using test::bumpy_torus;
using test::contents;
using test::files_of_records;
using test::scene_of;

std::vector<std::string> names_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Partition : public ::testing::Test {
 protected:
  test::TemporaryDirectory directory;
  fs::path out = directory.path() / "scene.vit";
};

TEST_F(Partition, BytesDoNotDependOnTheThreads) {
  const Scene scene = scene_of(test::adversarial_soup());
  std::map<std::string, std::string> first;
  for (const int threads : {1, 2, 5}) {
    partition(scene, out, {.domains = 11, .threads = threads});
    const auto files = contents(out);
    EXPECT_EQ(files.size(), 11u + files_of_records);
    if (first.empty()) first = files;
    EXPECT_TRUE(files == first) << threads << " threads give another bundle";
  }
}

TEST_F(Partition, DomainsAreBalanced) {
  const Scene scene = scene_of(bumpy_torus(150));
  for (const std::uint32_t domains : {2u, 3u, 8u, 23u, 64u, 150u}) {
    const PartitionStats s = partition(scene, out, {.domains = domains});
    EXPECT_EQ(s.domains, domains);
    EXPECT_EQ(s.input_triangles, 45000u);
    EXPECT_LT(static_cast<double>(s.triangles_max), 1.3 * s.triangles_mean) << domains << " domains";
    EXPECT_EQ(s.duplicates, 0u);
    EXPECT_LT(s.area_error, 1e-6);
    EXPECT_TRUE(verify_bundle(out).problems.empty());
  }
}

// So many objects, each `rows` times, where `place(object, row)` says.
Scene scene_with_objects(std::uint32_t objects, int rows, const auto& place) {
  Scene scene = scene_of(bumpy_torus(20));
  for (std::uint32_t i = 0; i < objects; ++i) {
    scene.meshes.push_back(bumpy_torus(40));
    Shape shape = scene.shapes[0];
    shape.mesh = Id<TriangleMesh>{i + 1};
    scene.prototypes.push_back({"", {shape}});
    for (int row = 0; row < rows; ++row)
      scene.instances.push_back({Id<Prototype>{i}, translate(place(i, row))});
  }
  return scene;
}

// Forty objects that stand in rows: a domain that sees a few of them needs only those.
TEST_F(Partition, DomainBytesCountObjects) {
  const Scene scene = scene_with_objects(40, 12, [](std::uint32_t i, int row) {
    return Vector3d{20.0 * i, 20.0 * row, 0};
  });
  const std::uint64_t all = partition(scene, out, {.domains = 1}).domain_bytes_max;
  const PartitionStats s = partition(scene, out, {.domain_bytes = all / 4});
  EXPECT_EQ(s.objects, 40u);
  EXPECT_GE(s.domains, 4u);
  EXPECT_LE(s.domain_bytes_max, all / 4);
}

// Of a size far beyond --domain-bytes: its parts go to different domains.
TEST_F(Partition, DomainBytesDivideObjects) {
  Scene scene = scene_of(bumpy_torus(20));
  scene.meshes.push_back(bumpy_torus(200));
  Shape shape = scene.shapes[0];
  shape.mesh = Id<TriangleMesh>{1};
  scene.prototypes.push_back({"", {shape}});
  for (int i = 0; i < 3; ++i) scene.instances.push_back({Id<Prototype>{0}, translate({20.0 * i, 0, 0})});
  constexpr std::uint64_t bytes = 1'500'000;
  const PartitionStats s = partition(scene, out, {.domain_bytes = bytes});
  EXPECT_GT(s.bundle_bytes, 3 * bytes);
  EXPECT_GT(s.objects, 1u);
  EXPECT_LE(s.domain_bytes_max, bytes);
}

// Objects that all lie in one place: domains share its cell, and each has some of them.
TEST_F(Partition, DomainBytesPartObjectsThatStandInOnePlace) {
  const Scene scene = scene_with_objects(20, 4, [](std::uint32_t i, int row) {
    return Vector3d{0, 20.0 * row, 0.01 * i};
  });
  constexpr std::uint64_t bytes = 600'000;  // for two or three objects of 200 kB
  const PartitionStats s = partition(scene, out, {.domain_bytes = bytes});
  EXPECT_LE(s.domain_bytes_max, bytes);
  EXPECT_EQ(s.duplicates, 0u);
  for (const VerifyFinding& f : verify_bundle(out).problems) ADD_FAILURE() << f.file << ": " << f.what;
  const Manifest m = read_manifest(out);
  EXPECT_TRUE(std::ranges::any_of(m.kd_nodes, [](const KdNode& n) { return n.axis == KdNode::no_axis; }));
  std::uint64_t instances = 0;
  for (const DomainInfo& d : m.domains) instances += d.instances;
  EXPECT_GE(instances, 80u);
  EXPECT_LT(instances, 160u) << "none of those that share a cell has what another has";
}

// The same whatever threads wrote it.
TEST_F(Partition, DomainsThatShareACellAreNumberedTheSame) {
  const Scene scene = scene_with_objects(20, 4, [](std::uint32_t i, int row) {
    return Vector3d{0, 20.0 * row, 0.01 * i};
  });
  partition(scene, out, {.domains = 4, .domain_bytes = 300'000, .threads = 1});
  const auto alone = contents(out);
  partition(scene, out, {.domains = 4, .domain_bytes = 300'000, .threads = 4});
  EXPECT_EQ(contents(out), alone);
}

TEST_F(Partition, DomainBytesThatCannotBe) {
  const Scene scene = scene_with_objects(20, 4, [](std::uint32_t i, int row) {
    return Vector3d{0, 20.0 * row, 0.01 * i};
  });
  constexpr std::uint64_t bytes = 8000;
  try {
    partition(scene, out, {.domain_bytes = bytes});
    FAIL();
  } catch (const UsageError& e) {
    const std::string text = e.what(), before = "which takes ";
    ASSERT_THAT(text, ::testing::HasSubstr(before));
    EXPECT_GT(std::stoull(text.substr(text.find(before) + before.size())) * 1024, bytes);
  }
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Partition, StatisticsAgreeWithTheManifest) {
  const PartitionStats s = partition(scene_of(bumpy_torus(100)), out, {.domains = 16, .durable = true});
  const Manifest m = read_manifest(out);
  std::uint64_t triangles = 0, pieces = 0, bytes = 0;
  for (const DomainInfo& d : m.domains) {
    triangles += d.triangles;
    pieces += d.pieces;
  }
  for (const auto& [name, text] : contents(out)) bytes += text.size();
  EXPECT_EQ(s.pieces, pieces);
  EXPECT_EQ(s.cut_triangles, m.cut_triangles);
  EXPECT_EQ(triangles, s.input_triangles - s.cut_triangles + s.pieces);
  EXPECT_EQ(s.triangles_mean, static_cast<double>(triangles) / 16);
  EXPECT_EQ(s.bundle_bytes, bytes);
  EXPECT_GT(s.peak_rss_bytes, 0u);
}

TEST_F(Partition, SceneHashDoesNotDependOnTheCuts) {
  const Scene scene = scene_of(bumpy_torus(30));
  partition(scene, out, {.domains = 1});
  const std::uint64_t hash = read_manifest(out).scene_hash;
  partition(scene, out, {.domains = 9});
  EXPECT_EQ(read_manifest(out).scene_hash, hash);
}

TEST_F(Partition, DomainsGetTheSizeAskedFor) {
  const PartitionStats s = partition(scene_of(bumpy_torus(150)), out, {.domain_bytes = 200'000});
  EXPECT_GT(s.domains, 10u);
  EXPECT_NEAR(static_cast<double>(s.bundle_bytes) / static_cast<double>(s.domains), 200'000, 40'000);
  EXPECT_EQ(partition(scene_of(bumpy_torus(20)), out, {}).domains, 1u);
}

TEST_F(Partition, MoreDomainsThanTriangles) {
  TriangleMesh mesh;
  mesh.positions.assign(3, {1, 2, 3});
  mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
  EXPECT_EQ(partition(scene_of(mesh), out, {.domains = 7}).triangles_max, 2u);
  const Manifest m = read_manifest(out);
  EXPECT_EQ(m.domains.size(), 7u);
  for (std::uint32_t i = 0; i < 7; ++i)
    check_domain(m, i, MappedDomain(domain_path(out, i)), domain_path(out, i));
  EXPECT_EQ(partition(scene_of({}), out, {.domains = 5}).triangles_max, 0u);
  EXPECT_EQ(read_manifest(out).domains.size(), 5u);
}

// Triangles that reach through many domains, so that planes part few of them and cut the rest.
TriangleMesh large_triangles(int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-1, 1);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    for (int k = 0; k < 3; ++k) mesh.positions.push_back({place(random), place(random), place(random)});
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

TEST_F(Partition, CuttingStopsWhereItPartsNothing) {
  const Scene scene = scene_of(large_triangles(10'000));
  for (const std::uint32_t at_once : {0u, 40u}) {
    const PartitionStats s = partition(scene, out, {.domains = 4096, .domains_at_once = at_once});
    EXPECT_EQ(s.domains_planned, 4096u);
    EXPECT_LT(s.domains, 3072u);
    EXPECT_GT(s.domains, 16u);
    EXPECT_LT(s.pieces, 4096u * 128u);
    EXPECT_EQ(s.duplicates, 0u);
    EXPECT_LT(s.area_error, 1e-6);
    EXPECT_TRUE(verify_bundle(out).problems.empty());
    EXPECT_EQ(contents(out).size(), s.domains + files_of_records);
  }
  EXPECT_EQ(partition(scene, out, {.domains = 8}).domains, 8u) << "so few are made";
}

TEST_F(Partition, TightBoundsHoldEveryPart) {
  partition(scene_of(bumpy_torus(60)), out, {.domains = 8});
  const Manifest m = read_manifest(out);
  Bounds3f all;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const MappedDomain mapped(domain_path(out, i));
    const Bounds3f tight = m.domains[i].tight_bounds;
    for (const Point3d& p : mapped.pieces().vertices)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GT(p[axis], tight.lower[axis]);
        EXPECT_LT(p[axis], tight.upper[axis]);
      }
    extend(all, tight);
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_LT(all.lower[axis], m.bounds.lower[axis]);
}

TEST_F(Partition, ReplacesAnOlderBundleAndLeavesNothingElse) {
  const Scene scene = scene_of(bumpy_torus(20));
  partition(scene, out, {.domains = 4});
  partition(scene, out / "", {.domains = 2});
  EXPECT_EQ(read_manifest(out).domains.size(), 2u);
  EXPECT_EQ(contents(out).size(), 2u + files_of_records);
  EXPECT_EQ(names_in(directory.path()), std::vector<std::string>{"scene.vit"});
}

TEST_F(Partition, OfALinkTheBundleBehindItIsReplaced) {
  fs::create_directory(directory / "disk");
  fs::create_directory_symlink("disk/real.vit", out);
  for (const std::uint32_t domains : {2u, 3u}) {
    partition(scene_of(bumpy_torus(10)), out, {.domains = domains});
    EXPECT_TRUE(fs::is_symlink(out));
    EXPECT_EQ(read_manifest(directory / "disk/real.vit").domains.size(), domains);
    EXPECT_EQ(names_in(directory / "disk"), std::vector<std::string>{"real.vit"});
  }
}

TEST_F(Partition, NeverTouchesWhatIsNotABundle) {
  fs::create_directory(out);
  std::ofstream(out / "thesis.txt") << "years of work";
  EXPECT_THROW(partition(scene_of(bumpy_torus(20)), out, {}), UsageError);
  EXPECT_EQ(names_in(out), std::vector<std::string>{"thesis.txt"});
  EXPECT_EQ(names_in(directory.path()), std::vector<std::string>{"scene.vit"});
}

TEST_F(Partition, FailureLeavesTheOldBundle) {
  Scene scene = scene_of(bumpy_torus(20));
  partition(scene, out, {.domains = 3});
  const auto before = contents(out);
  scene.film.width = 0;  // found when the manifest is written, after the domains
  EXPECT_THROW(partition(scene, out, {.domains = 2}), Error);
  EXPECT_TRUE(contents(out) == before);
  EXPECT_EQ(names_in(directory.path()), std::vector<std::string>{"scene.vit"});
}

TEST_F(Partition, ProgressRisesToOne) {
  double last = 0;
  bool rises = true;
  partition(scene_of(bumpy_torus(30)), out, {.domains = 6}, [&](double fraction, const char*) {
    rises &= fraction >= last;
    last = fraction;
  });
  EXPECT_TRUE(rises);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST_F(Partition, TooManyDomains) {
  EXPECT_THROW(partition(scene_of(bumpy_torus(10)), out, {.domains = 1'000'000}), UsageError);
}

}  // namespace

}  // namespace vitrail::partition_test
