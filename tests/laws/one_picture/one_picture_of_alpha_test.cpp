// SPDX-License-Identifier: Apache-2.0
// Alpha, and lamps that the camera does not see, are like the picture the same bit for bit however it is cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "bundle/manifest.h"
#include "film/film_progress.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::one_picture_of_alpha_test {
namespace {

namespace fs = std::filesystem;

class OnePictureOfAlpha : public testing::Test {
 protected:
  static void must(const std::string& command) {
    const CommandResult result = run(command);
    ASSERT_EQ(result.status, 0) << command << "\n" << result.output;
  }
  fs::path bundle(const fs::path& scene, int domains) {
    const fs::path bundle = directory_ / fmt::format("{}{}.vit", scene.stem().string(), domains);
    must(fmt::format("{} '{}' -o '{}' --domains {} --quiet", vitrail("partition"), scene.string(),
                     bundle.string(), domains));
    return bundle;
  }
  Film render(const fs::path& input, const std::string& more, int ranks = 1) {
    const fs::path film = directory_ / "picture.film";
    must(fmt::format("{} '{}' -o '{}' --quiet --force {}", vitrail_on(ranks, "render"), input.string(),
                     film.string(), more));
    return read_film(film, nullptr);
  }
  static double alpha(const Film& film, std::uint32_t pixel) {
    return film.mean_of_layer(pixel, Layer::alpha, 0);
  }

  TemporaryDirectory directory_;
};

// Materials, textures, lights and media of every kind.
TEST_F(OnePictureOfAlpha, WhateverTheDomainsRanksThreadsAndMemory) {
  must(fmt::format("/usr/bin/python3 '{}/examples/appearance/generate.py' -o '{}' --width 48 --height 32",
                   source_dir(), (directory_ / "appearance").string()));
  std::string hash;
  for (const int domains : {1, 3, 8}) {
    const fs::path cut = bundle(directory_ / "appearance/appearance.pbrt", domains);
    std::uint64_t bytes = 0, largest = 0;
    for (const DomainInfo& d : read_manifest(cut).domains)
      bytes += d.bytes, largest = std::max(largest, d.bytes);
    for (const int ranks : {1, 3}) {
      const std::string memory =
          ranks > 1 ? fmt::format("--domain-memory {} --shuffle-delivery 3", std::max(largest, bytes / 4))
                    : "";
      const Film film =
          render(cut, fmt::format("--spp 4 --alpha --hide-emitters --threads {} {}", domains, memory), ranks);
      const std::string found = fmt::format("{:016x}", film.hash());
      if (hash.empty()) hash = found;
      EXPECT_EQ(found, hash) << domains << " domains, " << ranks << " ranks " << memory;
    }
  }
}

// A card of which half is there, a lamp, and a wall that covers the left half of the picture, under a sky.
TEST_F(OnePictureOfAlpha, IsWhatCoversAPixel) {
  const fs::path scene = directory_ / "cards.pbrt";
  std::ofstream(scene) << R"(LookAt 0 0 5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-1 1 -1 1]
Sampler "independent" "integer pixelsamples" 256
PixelFilter "box" "float xradius" .5 "float yradius" .5
Film "rgb" "integer xresolution" 8 "integer yresolution" 8
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [0 -1 -1 1 -1 -1 1 1 -1 0 1 -1]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [4 4 4]
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-1 0 0 1 0 0 1 .5 0 -1 .5 0]
AttributeEnd
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "float alpha" .5 "point3 P" [-1 .75 1 1 .75 1 1 1 1 -1 1 1]
)";
  const auto row = [](std::uint32_t y, std::uint32_t x) { return 8 * y + x; };
  const Film shown = render(scene, "--alpha"), hidden = render(scene, "--alpha --hide-emitters");
  for (const std::uint32_t y : {4u, 5u, 6u, 7u}) {
    EXPECT_EQ(alpha(hidden, row(y, 2)), 1) << "the wall";
    EXPECT_EQ(alpha(hidden, row(y, 6)), 0) << "beside it";
    EXPECT_EQ(hidden.mean(row(y, 6)), XYZ{}) << "the sky is hidden";
    EXPECT_GT(shown.mean(row(y, 6)).y, 0.5) << "the sky is seen";
    EXPECT_EQ(alpha(shown, row(y, 6)), 0) << "and covers nothing";
  }
  for (const std::uint32_t y : {2u, 3u}) {
    EXPECT_EQ(alpha(shown, row(y, 6)), 1) << "the lamp";
    EXPECT_EQ(alpha(hidden, row(y, 6)), 0) << "the lamp is passed";
    EXPECT_EQ(hidden.mean(row(y, 6)), XYZ{});
    EXPECT_EQ(alpha(hidden, row(y, 2)), 1) << "the wall behind it";
    EXPECT_GT(shown.mean(row(y, 6)).y, 2 * shown.mean(row(6, 6)).y);
  }
  double half = 0;
  for (std::uint32_t x = 4; x < 8; ++x) half += alpha(hidden, row(0, x)) / 4;
  EXPECT_NEAR(half, 0.5, 4.5 * 0.5 / std::sqrt(4 * 256.0)) << "half of it is there";
  EXPECT_NE(shown.key(), hidden.key()) << "they are no samples of one picture";
}

}  // namespace
}  // namespace vitrail::test::one_picture_of_alpha_test
