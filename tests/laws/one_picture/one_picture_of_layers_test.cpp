// SPDX-License-Identifier: Apache-2.0
// What a film keeps of the first surfaces is, like its picture, the same bit for bit whatever the number of
// sub-domains, ranks and threads and the memory, and however often the run was stopped; and the picture is
// what it is without.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "bundle/manifest.h"
#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_of_layers_test {
namespace {

constexpr const char* all_aovs =
    "--aov albedo,position,geo_normal,sh_normal,uv,depth,shape_index,material_index,prim_index,motion,alpha,"
    "cryptomatte";

// Materials, textures, lights and media of every kind.
class OnePictureOfLayers : public testing::Test {
 protected:
  void SetUp() override {
    must(fmt::format("/usr/bin/python3 '{}/examples/appearance/generate.py' -o '{}' --width 48 --height 32",
                     source_dir(), (directory_ / "appearance").string()));
  }
  std::filesystem::path bundle(int domains, const std::string& name = "appearance.pbrt") {
    const auto bundle = directory_ / fmt::format("{}{}.vit", name, domains);
    must(fmt::format("{} '{}' -o '{}' --domains {} --quiet {}", vitrail("partition"),
                     (directory_ / "appearance" / name).string(), bundle.string(), domains, all_aovs));
    return bundle;
  }
  static void must(const std::string& command) {
    const CommandResult result = run(command);
    ASSERT_EQ(result.status, 0) << command << "\n" << result.output;
  }
  Film render(const std::filesystem::path& bundle, const std::string& more, int ranks = 1,
              const std::string& film = "picture.film", bool anew = true) {
    must(fmt::format("{} '{}' -o '{}' --quiet {} {}", vitrail_on(ranks, "render"), bundle.string(),
                     (directory_ / film).string(), anew ? "--force" : "", more));
    return read_film(directory_ / film, nullptr);
  }

  TemporaryDirectory directory_;
};

TEST_F(OnePictureOfLayers, WhateverTheDomainsRanksThreadsAndMemory) {
  std::string hash;
  for (const int domains : {1, 3, 8}) {
    const auto cut = bundle(domains);
    std::uint64_t bytes = 0, largest = 0;
    for (const DomainInfo& d : read_manifest(cut).domains)
      bytes += d.bytes, largest = std::max(largest, d.bytes);
    for (const int ranks : {1, 3})
      for (const int threads : {1, 4})
        for (const bool little : {false, true}) {
          // Without VITRAIL_LONG_TESTS half of them: each two numbers meet, with all memory or with little.
          if (!are_long() && ((domains == 3) + (ranks == 3) + (threads == 4) + little) % 2 == 1) continue;
          const std::string memory =
              little ? fmt::format("--domain-memory {} --shuffle-delivery 3", std::max(largest, bytes / 4))
                     : "";
          const Film film = render(cut, fmt::format("--spp 3 --threads {} {}", threads, memory), ranks);
          const std::string found = fmt::format("{:016x}", film.hash());
          if (hash.empty()) hash = found;
          EXPECT_EQ(found, hash) << domains << " domains, " << ranks << " ranks, " << threads << " threads "
                                 << memory;
          EXPECT_EQ(film.refused(), Refused{});
        }
  }
  fmt::print("film {}\n", hash);
}

// A ray that is handed on keeps its end.
TEST_F(OnePictureOfLayers, OfNearAndFarPlanes) {
  const auto scene = [](const char* planes) {
    return fmt::format(
        "<scene version='3.0.0'><integrator type='volpath'/><sensor type='thinlens'>{}"
        "<float name='aperture_radius' value='.1'/><float name='focus_distance' value='5'/>"
        "<medium type='homogeneous'><float name='sigma_t' value='.2'/></medium><transform name='to_world'>"
        "<lookat origin='0,1,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'>"
        "<integer name='width' value='32'/><integer name='height' value='32'/></film></sensor>"
        "<emitter type='constant'/><shape type='sphere'><float name='radius' value='.7'/>"
        "<bsdf type='dielectric'/></shape><shape type='rectangle'><transform name='to_world'>"
        "<scale value='4'/><translate z='-1'/></transform></shape><shape type='cube'><transform "
        "name='to_world'><scale value='.4'/><rotate y='1' angle='30'/><translate x='1'/></transform></shape>"
        "<shape type='cube'><transform name='to_world'><scale value='.3'/><translate y='-1'/></transform>"
        "</shape></scene>",
        planes);
  };
  const auto write = [&](const char* name, const char* planes) {
    std::ofstream(directory_ / "appearance" / name) << scene(planes);
  };
  write("clip.xml", "<float name='near_clip' value='4.3'/><float name='far_clip' value='5.6'/>");
  write("whole.xml", "");
  const std::uint64_t hash = render(bundle(1, "clip.xml"), "--spp 4").hash();
  EXPECT_NE(render(bundle(1, "whole.xml"), "--spp 4").hash(), hash);
  const auto cut = bundle(8, "clip.xml");
  std::uint64_t largest = 0;
  for (const DomainInfo& d : read_manifest(cut).domains) largest = std::max(largest, d.bytes);
  for (const int ranks : {1, 3})
    for (const std::string& memory :
         {std::string(), fmt::format("--domain-memory {} --shuffle-delivery 3", largest)})
      EXPECT_EQ(render(cut, "--spp 4 " + memory, ranks).hash(), hash) << ranks << " ranks " << memory;
}

TEST_F(OnePictureOfLayers, ResumedCroppedAndMerged) {
  const auto cut = bundle(4);
  const Film whole = render(cut, "--spp 6 --seed 5", 1, "whole.film");
  render(cut, "--spp 2 --seed 5", 3, "steps.film");
  render(cut, "--spp 3 --seed 5", 1, "steps.film", false);
  EXPECT_EQ(render(cut, "--spp 6 --seed 5", 3, "steps.film", false).hash(), whole.hash());

  const Film part = render(cut, "--spp 6 --seed 5 --crop 10,30,5,25", 3, "part.film");
  for (std::uint32_t p = 0; p < part.pixels(); ++p) {
    const std::uint32_t q = (5 + p / 20) * 48 + 10 + p % 20;
    for (std::size_t i = 0; i < layer_count; ++i) {
      const auto layer = static_cast<Layer>(i);
      for (std::size_t plane = 0; plane < kind_of(layer).sums; ++plane)
        ASSERT_EQ(part.mean_of_layer(p, layer, plane), whole.mean_of_layer(q, layer, plane));
      if (kind_of(layer).is_id()) {
        ASSERT_EQ(part.id(p, layer), whole.id(q, layer));
      }
      if (kind_of(layer).is_matte) {
        ASSERT_EQ(part.matte(p, layer), whole.matte(q, layer));
      }
    }
  }

  const Film other = render(cut, "--spp 6 --seed 6", 1, "other.film");
  Film a = whole, b = other;
  a.merge(other);
  b.merge(whole);
  EXPECT_EQ(a.hash(), b.hash());
  must(fmt::format("{} '{}' '{}' -o '{}'", vitrail("develop"), (directory_ / "whole.film").string(),
                   (directory_ / "other.film").string(), (directory_ / "merged.exr").string()));
}

TEST_F(OnePictureOfLayers, ThePictureDoesNotKnowOfThem) {
  for (const char* scene : {"appearance.pbrt", "appearance.xml"}) {
    const auto cut = bundle(4, scene);
    const Film with = render(cut, "--spp 4", 1, "with.film");
    const Film without = render(cut, "--spp 4 --aov none", 1, "without.film");
    EXPECT_TRUE(with.layers().any());
    EXPECT_FALSE(without.layers().any());
    for (std::uint32_t p = 0; p < with.pixels(); ++p) {
      ASSERT_EQ(with.mean(p), without.mean(p)) << p;
      ASSERT_EQ(with.variance_of_mean(p), without.variance_of_mean(p)) << p;
    }
    EXPECT_EQ(run(fmt::format("{} '{}' -o '{}'", vitrail("render"), cut.string(),
                              (directory_ / "without.film").string()) +
                  " --spp 8")
                  .status,
              3)
        << "a film of other layers is not gone on with";
  }
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_layers_test
