// SPDX-License-Identifier: Apache-2.0
// Images that are baked once, and kept for the next start.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::image_cache_test {
namespace {

namespace fs = std::filesystem;

class ImageCache : public ::testing::Test {
 protected:
  ImageCache() {
    std::ofstream image(directory_ / "noise.ppm", std::ios::binary);
    image << "P6 200 200 255\n";
    std::mt19937 random(1);
    for (int i = 0; i < 3 * 200 * 200; ++i) image.put(static_cast<char>(random() >> 24));
    std::ofstream(directory_ / "scene.xml")
        << "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'>"
           "<integer name='width' value='8'/><integer name='height' value='8'/></film></sensor>"
           "<emitter type='constant'/><shape type='sphere'><point name='center' x='0' y='0' z='4'/>"
           "<bsdf type='diffuse'><texture name='reflectance' type='bitmap'>"
           "<string name='filename' value='noise.ppm'/></texture></bsdf></shape></scene>";
  }
  CommandResult verb(const std::string& words) const {
    return run(fmt::format("cd '{}' && XDG_CACHE_HOME='{}' {}", directory_.path().string(),
                           (directory_ / "cache").string(), vitrail(words)));
  }
  std::ptrdiff_t entries() const {
    const fs::path folder = directory_ / "cache" / "vitrail" / "images";
    return fs::exists(folder) ? std::distance(fs::directory_iterator(folder), fs::directory_iterator()) : 0;
  }
  std::string texture_of(const std::string& bundle) const {
    std::ifstream file(directory_ / bundle / "textures" / "000000.tex", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryDirectory directory_;
};

TEST_F(ImageCache, KeepsWhatImagesAreBakedTo) {
  const CommandResult without = verb("partition scene.xml -o a.vit --quiet --no-cache");
  ASSERT_EQ(without.status, 0) << without.output;
  EXPECT_EQ(entries(), 0);
  EXPECT_EQ(verb("partition scene.xml -o b.vit --quiet").status, 0);
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(verb("partition scene.xml -o c.vit --quiet").status, 0);
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(texture_of("a.vit").substr(0, 7), "VITRTEX");
  EXPECT_EQ(texture_of("b.vit"), texture_of("a.vit"));
  EXPECT_EQ(texture_of("c.vit"), texture_of("a.vit"));
}

TEST_F(ImageCache, ServesRenderToo) {
  EXPECT_EQ(verb("render scene.xml -o a.film --spp 1 --quiet --no-cache").status, 0);
  EXPECT_EQ(entries(), 0);
  EXPECT_EQ(verb("render scene.xml -o b.film --spp 1 --quiet").status, 0);
  EXPECT_EQ(entries(), 1);
  EXPECT_EQ(verb("render scene.xml -o c.film --spp 1 --quiet").status, 0);
  const CommandResult same = verb("compare b.film c.film");
  EXPECT_EQ(same.status, 0) << same.output;
}

}  // namespace
}  // namespace vitrail::test::image_cache_test
