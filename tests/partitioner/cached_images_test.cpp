// SPDX-License-Identifier: Apache-2.0
// Baked images that are kept for the next time.
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <vector>

#include "partitioner/caching/file_cache.h"
#include "tests/partitioner/baked_scene.h"

namespace vitrail::cached_images_test {

namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

struct CachedScene : test::BakedScene {
  fs::path cache = directory / "cache";

  void write_noise(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<unsigned char> pixels(3 * 150 * 150);
    for (unsigned char& v : pixels) v = static_cast<unsigned char>(random() >> 24);
    test::write_png(directory / "a.png", 150, 150, 3, pixels);
  }
  // The content of the file that is baked into a bundle of its own.
  std::string bake(const ImageTexture& image, TextureUse use, bool cached = true) {
    static int bundles = 0;
    const fs::path bundle = directory / ("b" + std::to_string(bundles++));
    TextureBaker own(scene, bundle, diagnostics, {.cache = cached ? cache : fs::path()});
    const std::string name = own.bake_image(image, use, {});
    const std::uint64_t bytes = own.files().at(0).bytes;
    const std::string content = content_of(bundle / name);
    EXPECT_EQ(bytes, content.size());
    return content;
  }
  std::vector<fs::path> entries() const {
    std::vector<fs::path> all;
    if (fs::exists(cache))
      for (const auto& entry : fs::directory_iterator(cache)) all.push_back(entry.path());
    return all;
  }
};

TEST(CachedImages, AreTheSame) {
  CachedScene s;
  s.write_noise(1);
  const ImageTexture image = s.image("a.png");
  const std::string fresh = s.bake(image, TextureUse::reflectance, false);
  EXPECT_TRUE(s.entries().empty());
  EXPECT_EQ(s.bake(image, TextureUse::reflectance), fresh);
  EXPECT_EQ(s.entries().size(), 1u);
  EXPECT_EQ(s.bake(image, TextureUse::reflectance), fresh);
  EXPECT_EQ(s.entries().size(), 1u);
}

TEST(CachedImages, AreKnownByContentAndUse) {
  CachedScene s;
  s.write_noise(1);
  ImageTexture image = s.image("a.png");
  const std::string first = s.bake(image, TextureUse::reflectance);
  fs::copy_file(s.directory / "a.png", s.directory / "b.png");
  EXPECT_EQ(s.bake(s.image("b.png"), TextureUse::reflectance), first);
  EXPECT_EQ(s.entries().size(), 1u);
  EXPECT_NE(s.bake(image, TextureUse::illuminant), first);
  image.scale = 0.5f;
  EXPECT_NE(s.bake(image, TextureUse::reflectance), first);
  image.scale = 1, image.encoding = Encoding::linear;
  EXPECT_NE(s.bake(image, TextureUse::reflectance), first);
  EXPECT_EQ(s.entries().size(), 4u);
  s.write_noise(2);
  EXPECT_NE(s.bake(s.image("a.png"), TextureUse::reflectance), first);
  EXPECT_EQ(s.entries().size(), 5u);
}

TEST(CachedImages, AreTakenFromTheCacheAndMadeAnewWhereItIsDamaged) {
  CachedScene s;
  s.write_noise(1);
  const ImageTexture image = s.image("a.png");
  const std::string first = s.bake(image, TextureUse::reflectance);
  const fs::path entry = s.entries().at(0);
  const fs::path other = s.directory / "other";
  std::ofstream(other) << "what another maker made";
  FileCache(s.cache).keep(entry.filename().string(), other, {23, 5, 0, 0});
  EXPECT_EQ(s.bake(image, TextureUse::reflectance), "what another maker made");
  fs::resize_file(entry, fs::file_size(entry) - 1);
  EXPECT_EQ(s.bake(image, TextureUse::reflectance), first);
  EXPECT_EQ(s.bake(image, TextureUse::reflectance), first);
}

TEST(CachedImages, SayAgainWhatWasNotExact) {
  CachedScene s;
  std::ofstream out(s.directory / "a.pfm", std::ios::binary);
  out << "PF\n64 64\n-1.0\n";
  std::vector<float> values(3 * 64 * 64, 0.25f);
  values[7] = std::numeric_limits<float>::infinity(), values[9] = 0.5f;
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
  out.close();
  s.bake(s.image("a.pfm"), TextureUse::reflectance);
  s.bake(s.image("a.pfm"), TextureUse::reflectance);
  EXPECT_EQ(s.entries().size(), 1u);
  ASSERT_EQ(s.diagnostics.size(), 2u);
  EXPECT_NE(s.diagnostics[0].message.find("1 values are not finite"), std::string::npos);
  EXPECT_EQ(s.diagnostics[0].message, s.diagnostics[1].message);
}

}  // namespace

}  // namespace vitrail::cached_images_test
