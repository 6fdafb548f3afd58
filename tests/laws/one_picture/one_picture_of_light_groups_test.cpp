// SPDX-License-Identifier: Apache-2.0
// Groups of lights that a film keeps apart: together they are the picture to the bit, the same whatever the
// number of sub-domains, ranks and threads and the memory, and each is the picture of its lights alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "bundle/manifest.h"
#include "film/film_planes.h"
#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_of_light_groups_test {
namespace {

namespace fs = std::filesystem;

class LightGroupsOfPictures : public testing::Test {
 protected:
  static void must(const std::string& command) {
    const CommandResult result = run(command);
    ASSERT_EQ(result.status, 0) << command << "\n" << result.output;
  }
  // Materials, textures, lights and media of every kind.
  fs::path appearance() {
    must(fmt::format("/usr/bin/python3 '{}/examples/appearance/generate.py' -o '{}' --width 48 --height 32",
                     source_dir(), (directory_ / "appearance").string()));
    return directory_ / "appearance/appearance.pbrt";
  }
  fs::path bundle(const fs::path& scene, int domains) {
    const fs::path bundle = directory_ / fmt::format("{}{}.vit", scene.stem().string(), domains);
    must(fmt::format("{} '{}' -o '{}' --domains {} --quiet", vitrail("partition"), scene.string(),
                     bundle.string(), domains));
    return bundle;
  }
  fs::path written(const std::string& name, const std::string& text) {
    std::ofstream(directory_ / name) << text;
    return directory_ / name;
  }
  Film render(const fs::path& input, const std::string& more, int ranks = 1) {
    const fs::path film = directory_ / "picture.film";
    must(fmt::format("{} '{}' -o '{}' --quiet --force {}", vitrail_on(ranks, "render"), input.string(),
                     film.string(), more));
    return read_film(film, nullptr);
  }
  static WideSum sum_of(const Film& film, std::size_t plane, std::uint32_t pixel) {
    return film.sums()[plane * film.pixels() + pixel];
  }
  // Of a film without bins and layers.
  static void expect_groups_add_up(const Film& film) {
    const std::size_t groups = film.key().groups.names.size();
    ASSERT_GT(groups, 0u);
    for (std::uint32_t p = 0; p < film.pixels(); ++p) {
      WideSum x, y, z, all_y = sum_of(film, y_planes, p);
      all_y += sum_of(film, y_planes + 1, p);
      for (std::size_t g = 0; g < groups; ++g) {
        x += sum_of(film, plane_count + planes_a_group * g, p);
        y += sum_of(film, plane_count + planes_a_group * g + 1, p);
        z += sum_of(film, plane_count + planes_a_group * g + 2, p);
      }
      ASSERT_EQ(x, sum_of(film, x_plane, p)) << p;
      ASSERT_EQ(y, all_y) << p;
      ASSERT_EQ(z, sum_of(film, z_plane, p)) << p;
    }
  }
  static double mean_of_group(const Film& film, const std::string& name) {
    const auto& names = film.key().groups.names;
    const auto group = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    EXPECT_LT(group, names.size()) << name;
    double sum = 0;
    for (std::uint32_t p = 0; p < film.pixels(); ++p) sum += film.mean_of_group(p, group).y;
    return sum / film.pixels();
  }
  static double mean(const Film& film) {
    double sum = 0;
    for (std::uint32_t p = 0; p < film.pixels(); ++p) sum += film.mean(p).y;
    return sum / film.pixels();
  }

  TemporaryDirectory directory_;
};

TEST_F(LightGroupsOfPictures, AreTheSameWhateverTheDomainsRanksThreadsAndMemory) {
  const fs::path scene = appearance();
  std::string hash;
  for (const int domains : {1, 3, 8}) {
    const fs::path cut = bundle(scene, domains);
    std::uint64_t bytes = 0, largest = 0;
    for (const DomainInfo& d : read_manifest(cut).domains)
      bytes += d.bytes, largest = std::max(largest, d.bytes);
    for (const int ranks : {1, 3})
      for (const bool little : {false, true}) {
        const std::string memory =
            little ? fmt::format("--domain-memory {} --shuffle-delivery 3", std::max(largest, bytes / 4))
                   : "";
        const Film film =
            render(cut, fmt::format("--spp 3 --light-groups --threads {} {}", domains, memory), ranks);
        const std::string found = fmt::format("{:016x}", film.hash());
        if (hash.empty()) hash = found;
        EXPECT_EQ(found, hash) << domains << " domains, " << ranks << " ranks " << memory;
        expect_groups_add_up(film);
      }
  }
}

TEST_F(LightGroupsOfPictures, ChangeNoBitOfThePicture) {
  const fs::path cut = bundle(appearance(), 3);
  for (const char* more : {"", "--splat --clamp 2", "--adaptive --spp 8", "--integrator direct"}) {
    const Film without = render(cut, fmt::format("--spp 4 {}", more));
    const Film with = render(cut, fmt::format("--spp 4 --light-groups {}", more));
    for (std::size_t i = 0; i < plane_count * with.pixels(); ++i)
      ASSERT_EQ(with.sums()[i], without.sums()[i]) << more;
    expect_groups_add_up(with);
  }
}

// A floor under lights of every kind that is far, near, of surfaces.
std::string floor_under(const std::string& lights) {
  return R"(LookAt 0 -4 3  0 0 0  0 0 1
Camera "perspective" "float fov" 40
Sampler "independent" "integer pixelsamples" 256
Film "rgb" "integer xresolution" 24 "integer yresolution" 24
WorldBegin
Material "diffuse" "rgb reflectance" [.7 .5 .3]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 -1 0 1 -1 0 1 1 0 -1 1 0]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 1 0 1 1 0 1 1 1 -1 1 1]
)" + lights;
}

TEST_F(LightGroupsOfPictures, EachIsThePictureOfItsLights) {
  const std::string point = "LightSource \"point\" \"point3 from\" [0 -1 2] \"rgb I\" [2 3 4]\n";
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [.1 .2 .4]\n";
  const std::string glow = "LightSource \"infinite\" \"rgb L\" [.3 .2 .1]\n";
  const std::string lamp =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [5 4 3]\nTranslate .5 .5 .8\n"
      "Shape \"sphere\" \"float radius\" .2\nAttributeEnd\n";
  const std::string dark_lamp =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [0 0 0]\nTranslate .5 .5 .8\n"
      "Shape \"sphere\" \"float radius\" .2\nAttributeEnd\n";
  const Film all = render(written("all.pbrt", floor_under(point + sky + glow + lamp)), "--light-groups");
  expect_groups_add_up(all);
  EXPECT_EQ(all.key().groups.names,
            (std::vector<std::string>{"area-1", "point-2", "infinite-3", "infinite-4"}));
  const auto alone = [&](const std::string& light) {
    return mean(render(written("one.pbrt", floor_under(light)), ""));
  };
  EXPECT_NEAR(mean_of_group(all, "point-2") / alone(point + dark_lamp), 1, 0.02);
  EXPECT_NEAR(mean_of_group(all, "infinite-3") / alone(sky + dark_lamp), 1, 0.02);
  EXPECT_NEAR(mean_of_group(all, "infinite-4") / alone(glow + dark_lamp), 1, 0.02);
  EXPECT_NEAR(mean_of_group(all, "area-1") / alone(lamp), 1, 0.02);
}

TEST_F(LightGroupsOfPictures, ShineThroughGlassAndMedia) {
  const std::string inside =
      "AttributeBegin\nMaterial \"dielectric\"\nTranslate 0 0 .5\nShape \"sphere\" \"float radius\" .4\n"
      "AttributeEnd\n"
      "MakeNamedMedium \"fire\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [1 1 "
      "1] \"rgb Le\" [1 .5 .2]\n"
      "AttributeBegin\nMaterial \"interface\"\nMediumInterface \"fire\" \"\"\nTranslate -.6 0 .3\n"
      "Shape \"sphere\" \"float radius\" .25\nAttributeEnd\n"
      "LightSource \"distant\" \"point3 from\" [0 -1 3] \"point3 to\" [0 0 0] \"rgb L\" [1 1 1]\n"
      "LightSource \"point\" \"point3 from\" [0 -1 2] \"rgb I\" [2 3 4]\n";
  const fs::path scene = written("glass.pbrt", floor_under(inside));
  std::string hash;
  for (const int domains : {1, 6}) {
    const Film film = render(bundle(scene, domains), "--light-groups --spp 16", domains > 1 ? 2 : 1);
    expect_groups_add_up(film);
    EXPECT_GT(mean_of_group(film, "medium-1"), 0);
    EXPECT_GT(mean_of_group(film, "distant-1"), 0);
    EXPECT_GT(mean_of_group(film, "point-2"), 0);
    const std::string found = fmt::format("{:016x}", film.hash());
    if (hash.empty()) hash = found;
    EXPECT_EQ(found, hash);
  }
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_light_groups_test
