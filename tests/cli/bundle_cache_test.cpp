// SPDX-License-Identifier: Apache-2.0
// Domains and objects of a scene that are cut once, and kept for the next render.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <utime.h>

#include <cmath>
#include <fstream>
#include <set>

#include "partitioner/caching/world_key.h"
#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::bundle_cache_test {
namespace {

namespace fs = std::filesystem;

struct View {
  double eye_x = 0;
  std::string more = "";   // of the scene
  double radiance = 1;     // of the lamp
  double red = .5;         // of the floor
  double mesh_x = 0;       // where the mesh stands
  std::string shape = "";  // of the mesh
  double turn_deg = 0;     // of the mesh about its middle
};

class BundleCacheCli : public ::testing::Test {
 protected:
  BundleCacheCli() {
    write_mesh(0);
    write_scene({});
  }

  // Waves of 2·120² triangles, whose middle vertex is `up` higher.
  void write_mesh(double up) const {
    constexpr int n = 120;
    std::ofstream out(directory_ / "waves.obj");
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const double lift = x == n / 2 && y == n / 2 ? up : 0;
        out << fmt::format("v {:.6f} {:.6f} {:.6f}\n", x * 2. / n - 1, y * 2. / n - 1,
                           4 + .1 * std::sin(x * .3) * std::cos(y * .2) + lift);
      }
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const int a = y * (n + 1) + x + 1;
        out << fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
      }
  }

  void write_scene(const View& v) const {
    std::ofstream(directory_ / "scene.xml") << fmt::format(
        R"(<scene version='3.0.0'><sensor type='perspective'><transform name='to_world'>
<lookat origin='{},0,0' target='0,0,4' up='0,1,0'/></transform><film type='hdrfilm'>
<integer name='width' value='16'/><integer name='height' value='16'/></film></sensor>
<emitter type='constant'/>{}
<shape type='sphere'><point name='center' x='0' y='0' z='-4'/><emitter type='area'>
<rgb name='radiance' value='{}'/></emitter></shape>
<shape type='rectangle'><transform name='to_world'><translate z='5'/></transform><emitter type='area'>
<rgb name='radiance' value='{}'/></emitter></shape>
<shape type='obj'><string name='filename' value='waves.obj'/>{}
<transform name='to_world'><rotate z='1' angle='{}'/><translate x='{}'/></transform>
<bsdf type='diffuse'><rgb name='reflectance' value='{},.5,.5'/></bsdf></shape></scene>)",
        v.eye_x, v.more, v.radiance, v.radiance, v.shape, v.turn_deg, v.mesh_x, v.red);
  }

  CommandResult verb(const std::string& words) const {
    return run(
        fmt::format("cd '{}' && XDG_CACHE_HOME='{}' {}", directory_.path().string(), cache_, vitrail(words)));
  }
  std::set<std::string> entries() const {
    std::set<std::string> names;
    const fs::path folder = fs::path(cache_) / "vitrail" / "bundles";
    if (fs::exists(folder))
      for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
    return names;
  }
  fs::path only_entry() const {
    EXPECT_EQ(entries().size(), 1u);
    return fs::path(cache_) / "vitrail" / "bundles" / *entries().begin();
  }
  static auto links(const fs::path& file) { return fs::hard_link_count(file); }

  // As render does it, through the cache. Its bundle has to be that of a partition without one, byte by byte.
  void expect_right_bundle(const std::string& options = "") const {
    const CommandResult made = verb(fmt::format(
        "partition scene.xml -o kept.vit --quiet --force --no-summary --keep-domains {}", options));
    ASSERT_EQ(made.status, 0) << made.output;
    const CommandResult anew = verb(
        fmt::format("partition scene.xml -o anew.vit --quiet --force --no-summary --no-cache {}", options));
    ASSERT_EQ(anew.status, 0) << anew.output;
    const CommandResult same = run(fmt::format("diff -r '{}' '{}'", (directory_ / "kept.vit").string(),
                                               (directory_ / "anew.vit").string()));
    EXPECT_EQ(same.status, 0) << same.output;
  }

  TemporaryDirectory directory_;
  std::string cache_ = (directory_ / "cache").string();
};

TEST_F(BundleCacheCli, IsOfWhatTheManifestAloneSaysNothing) {
  expect_right_bundle();
  const auto first = entries();
  ASSERT_EQ(first.size(), 1u);
  const std::pair<const char*, View> views[] = {
      {"a camera", {.eye_x = .5}},
      {"a sun",
       {.more = "<emitter type='directional'><vector name='direction' x='1' y='2' z='3'/></emitter>"}},
      {"brighter lamps", {.radiance = 3}},
      {"a colour", {.red = .1}},
      {"a path's depth",
       {.more = "<integrator type='path'><integer name='max_depth' value='3'/></integrator>"}},
  };
  for (const auto& [what, view] : views) {
    SCOPED_TRACE(what);
    write_scene(view);
    expect_right_bundle();
    EXPECT_EQ(entries(), first);
    EXPECT_EQ(links(directory_ / "kept.vit" / "domains" / "000000.dom"), 2u);
  }
}

TEST_F(BundleCacheCli, NeverServesAnotherScene) {
  expect_right_bundle();
  std::size_t known = 1;
  const auto expect_new = [&](const char* what, const std::string& options = "") {
    SCOPED_TRACE(what);
    expect_right_bundle(options);
    EXPECT_EQ(entries().size(), ++known);
  };
  // Of the same size and time.
  struct stat before {};
  const fs::path mesh = directory_ / "waves.obj";
  ASSERT_EQ(::stat(mesh.c_str(), &before), 0);
  write_mesh(.001);
  ASSERT_EQ(static_cast<std::uintmax_t>(before.st_size), fs::file_size(mesh));
  const utimbuf then{before.st_atime, before.st_mtime};
  ASSERT_EQ(::utime(mesh.c_str(), &then), 0);
  expect_new("a mesh");
  write_scene({.mesh_x = .25});
  expect_new("a place");
  write_scene({.turn_deg = 90});
  expect_new("a turn");
  write_scene({.shape = "<boolean name='flip_normals' value='true'/>"});
  expect_new("a side");
  write_scene({.more = "<shape type='sphere'><point name='center' x='0' y='1' z='3'/></shape>"});
  expect_new("another object");
  write_scene({});
  expect_new("a mesh option", "--decimate .9");
  expect_new("a number of domains", "--domains 3");
  expect_new("a budget", "--memory 700M");
  write_scene({.radiance = 0});
  expect_right_bundle();
}

TEST_F(BundleCacheCli, GivesRenderTheSameFilm) {
  ASSERT_EQ(verb("render scene.xml -o a.film --spp 2 --quiet --no-cache").status, 0);
  EXPECT_TRUE(entries().empty());
  for (const char* film : {"b.film", "c.film"}) {
    const CommandResult made = verb(fmt::format("render scene.xml -o {} --spp 2 --quiet", film));
    ASSERT_EQ(made.status, 0) << made.output;
    EXPECT_EQ(entries().size(), 1u);
    const CommandResult same = verb(fmt::format("compare a.film {}", film));
    EXPECT_EQ(same.status, 0) << same.output;
  }
  // Its own bundle is gone, and the entry has its files alone again.
  EXPECT_EQ(links(only_entry() / "domains" / "000000.dom"), 1u);
}

// What is kept are files, whichever form the bundle has that they came from.
TEST_F(BundleCacheCli, ServesFilesAndPacks) {
  const auto pack = directory_ / "kept.vit" / "domains" / "pack-0000";
  for (const bool packed_first : {false, true}) {
    fs::remove_all(cache_);
    for (const bool packed : {packed_first, !packed_first}) {
      expect_right_bundle(packed ? "--domains 3 --pack 1G" : "--domains 3");
      EXPECT_EQ(fs::exists(pack), packed);
      EXPECT_EQ(links(only_entry() / "domains" / "000000.dom"), packed ? 1u : 2u);
    }
  }
}

TEST_F(BundleCacheCli, MakesDamagedEntriesAnew) {
  expect_right_bundle();
  const fs::path entry = only_entry();
  const auto damage = [&](const char* file, auto change) {
    SCOPED_TRACE(file);
    fs::remove_all(directory_ / "kept.vit");
    change(entry / file);
    expect_right_bundle();
    EXPECT_EQ(links(only_entry() / "domains" / "000000.dom"), 2u);
  };
  const auto flip = [](const fs::path& file) {
    std::fstream f(file, std::ios::binary | std::ios::in | std::ios::out);
    f.seekg(static_cast<std::streamoff>(fs::file_size(file) / 2));
    const int byte = f.get();
    f.seekp(-1, std::ios::cur);
    f.put(static_cast<char>(byte ^ 1));
  };
  const auto halve = [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) / 2); };
  const auto remove = [](const fs::path& file) { fs::remove(file); };
  damage("domains/000000.dom", flip);
  damage("domains/000000.dom", halve);
  damage("domains/000000.dom", remove);
  for (const char* file : {"kept.json", "manifest.json", "materials.bin", "lights.bin", "domains.bin"}) {
    damage(file, flip);
    damage(file, halve);
    damage(file, remove);
  }
}

TEST_F(BundleCacheCli, GoesWithoutWhereItCannotBe) {
  std::ofstream(fs::path(cache_)) << "a file, not a folder";
  expect_right_bundle();
  cache_ = "/proc";
  expect_right_bundle();
}

TEST_F(BundleCacheCli, CopiesFromAnotherFileSystem) {
  if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "no other file system";
  cache_ = fmt::format("/dev/shm/vitrail-test-{}", ::getpid());
  for (int i = 0; i < 2; ++i) {
    expect_right_bundle();
    EXPECT_EQ(entries().size(), 1u);
  }
  fs::remove_all(cache_);
}

TEST_F(BundleCacheCli, GoesOnWhereTheDiskIsFull) {
  const std::string in_namespace =
      fmt::format("mkdir -p '{0}' && mount -t tmpfs -o size=256k none '{0}'", cache_);
  if (run(fmt::format("unshare -m sh -c \"{}\"", in_namespace)).status != 0) GTEST_SKIP() << "no namespace";
  const CommandResult made = run(
      fmt::format("cd '{}' && unshare -m sh -c \"{} && XDG_CACHE_HOME='{}' {} && ls '{}/vitrail/bundles'\"",
                  directory_.path().string(), in_namespace, cache_,
                  vitrail("render scene.xml -o a.film --spp 1 --quiet"), cache_));
  EXPECT_EQ(made.status, 0) << made.output;
  EXPECT_EQ(made.output, "");
}

TEST_F(BundleCacheCli, IsSharedByRendersAtOnce) {
  const std::string one = vitrail("render scene.xml --spp 1 --quiet -o");
  const CommandResult all =
      run(fmt::format("cd '{}' && export XDG_CACHE_HOME='{}' && for i in 1 2 3; do {} $i.film & p=\"$p $!\"; "
                      "done && for i in $p; "
                      "do wait $i || exit; done",
                      directory_.path().string(), cache_, one));
  ASSERT_EQ(all.status, 0) << all.output;
  EXPECT_EQ(entries().size(), 1u);
  for (const char* film : {"2.film", "3.film"})
    EXPECT_EQ(verb(fmt::format("compare 1.film {}", film)).status, 0);
}

TEST_F(BundleCacheCli, ClearsAwayWhatAKilledRenderLeft) {
  expect_right_bundle();
  const fs::path entry = only_entry(), left = entry.string() + ".tmp4000001";
  fs::rename(entry, left);
  expect_right_bundle();
  EXPECT_EQ(only_entry(), entry);
}

// A sphere's world, and what another program makes of it.
TEST(WorldKey, IsOfTheProgramThatCuts) {
  TemporaryDirectory directory;
  std::ofstream(directory / "one") << "program 1";
  std::ofstream(directory / "two") << "program 2";
  Scene scene;
  scene.meshes.emplace_back().positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.materials.push_back({DiffuseMaterial{}});
  scene.shapes.push_back({{0}, {0}});
  const World world = world_of(scene, "");
  const auto key = [&](const char* program) {
    return WorldKey(world, scene.settings, {}, directory / program).text();
  };
  EXPECT_EQ(key("one"), key("one"));
  EXPECT_NE(key("one"), key("two"));
}

}  // namespace
}  // namespace vitrail::test::bundle_cache_test
