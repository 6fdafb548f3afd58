// SPDX-License-Identifier: Apache-2.0
// The scenes of Mitsuba's documentation against its pictures: JPEGs of 8 bits, encoded as sRGB, without tone
// mapping, of unknown sample counts. Large ones are rendered at half their size. Means of blocks of 16 × 16
// pixels are compared as one sees them, encoded, in [0,1]; so the blocks of JPEG vanish, and one sample a
// pixel is enough but for the blur of a lens.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "film/image_io.h"
#include "scene/spectra/color.h"
#include "tests/conformance/corpus_render.h"
#include "tests/support/command.h"

namespace vitrail::test::docs_picture_test {
namespace {

constexpr int block = 16, large = 900;  // pixels: on each axis; a picture's width

// The mean and the 95th percentile of |difference| over blocks and channels, and the greatest |mean
// difference| of a channel.
struct Difference {
  double mean = 0, percentile_95 = 0, tint = 0;
};

struct Agreement {
  Difference most;
  int samples = 1;  // a pixel
};

// What each scene reaches with these samples and a fifth more. It is noise for the most part: pictures of 16
// samples by Mitsuba 3.9.1 itself are 0.001 to 0.007 from these in the mean, and tinted by up to 0.0033. The
// bunny's reference is of three colours: light of many scatterings is greener by its spectrum, in Mitsuba
// too; and its floor is lighter than Mitsuba 3.9.1 makes it, whose picture is 0.03 off.
const std::map<std::string, Agreement> agreements{
    {"bsdf_conductor_gold", {{0.0175, 0.048, 0.004}}},
    {"bsdf_mask_after", {{0.0175, 0.046, 0.004}}},
    {"bsdf_plastic_preserve", {{0.0165, 0.043, 0.004}}},
    {"bsdf_roughconductor_anisotropic_aluminium", {{0.02, 0.056, 0.004}}},
    {"bsdf_roughplastic_ggx", {{0.015, 0.041, 0.004}}},
    {"bsdf_thindielectric_glass", {{0.0215, 0.06, 0.004}}},
    {"bsdf_twosided_cbox_onesided", {{0.0085, 0.034, 0.002}}},
    {"emitter_spot_texture", {{0.004, 0.011, 0.002}}},
    {"integrator_direct_both", {{0.017, 0.048, 0.002}}},
    {"medium_homogeneous_sss", {{0.06, 0.2, 0.053}}},
    {"sensor_orthographic", {{0.0165, 0.044, 0.003}}},
    {"sensor_thinlens", {{0.0073, 0.02, 0.004}, 4}},
    {"shape_cylinder_twosided", {{0.0165, 0.044, 0.004}}},
    {"shape_rectangle_parameterization", {{0.017, 0.044, 0.004}}},
    {"shape_sphere_light_analytic", {{0.0055, 0.019, 0.002}}},
    {"variants_cbox_spectral", {{0.008, 0.024, 0.001}}},
};

// The mean of a block's channel, and whether the picture may have cut values off in it.
struct Block {
  double mean = 0;
  bool clipped = false;
};

Block block_of(const Image& image, int left, int top, int side, int channel) {
  constexpr float white = 0.97f;  // encoded 252 of 255: JPEG blurs what is cut off
  Block b;
  for (int y = top; y < top + side; ++y)
    for (int x = left; x < left + side; ++x) {
      const float value = image.values[static_cast<std::size_t>((y * image.width + x) * 3 + channel)];
      b.mean += static_cast<double>(value) / (side * side);
      b.clipped |= value >= white;
    }
  return b;
}

// Of an image that is so many times smaller than the reference. Where the reference is cut off, a brighter
// block is as good.
Difference difference(const Image& image, const Image& reference, int smaller) {
  Difference d;
  std::vector<double> sizes;
  for (int channel = 0; channel < 3; ++channel) {
    double sum = 0;
    for (int y = 0; y + block <= image.height; y += block)
      for (int x = 0; x + block <= image.width; x += block) {
        const Block expected = block_of(reference, smaller * x, smaller * y, smaller * block, channel);
        const double shown = std::clamp(block_of(image, x, y, block, channel).mean, 0.0, 1.0);
        const double off = srgb_encode(shown) - srgb_encode(expected.mean);
        sizes.push_back(expected.clipped ? std::max(-off, 0.0) : std::abs(off));
        sum += expected.clipped ? std::min(off, 0.0) : off;
        d.mean += sizes.back();
      }
    d.tint = std::max(d.tint, 3 * std::abs(sum));
  }
  const auto count = static_cast<double>(sizes.size());
  d.mean /= count;
  d.tint /= count;
  std::sort(sizes.begin(), sizes.end());
  d.percentile_95 = sizes[static_cast<std::size_t>(0.95 * count)];
  return d;
}

class DocsPicture : public ::testing::TestWithParam<CorpusScene> {};

TEST_P(DocsPicture, IsMatched) {
  const CorpusScene& scene = GetParam();
  const auto& [most, samples] = agreements.at(scene.name());
  const TemporaryDirectory directory;
  const std::filesystem::path picture = directory / "picture.exr";
  const Image expected = read_picture(corpus() / scene.references.at(0)).rgb;
  const int smaller = expected.width >= large ? 2 : 1;
  const std::string wrong = render_scene(
      corpus() / scene.path, picture, fmt::format("--spp {} --width {}", samples, expected.width / smaller));
  if (!wrong.empty()) return conclude(false, scene.name(), wrong);
  const Image shown = read_picture(picture).rgb;
  ASSERT_EQ(shown.width, expected.width / smaller);
  ASSERT_EQ(shown.height, expected.height / smaller);
  const Difference d = difference(shown, expected, smaller);
  conclude(d.mean <= most.mean && d.percentile_95 <= most.percentile_95 && d.tint <= most.tint, scene.name(),
           fmt::format("|difference| {:.4f}   95 % below {:.4f}   mean of a channel off by {:.4f}", d.mean,
                       d.percentile_95, d.tint));
}

std::vector<CorpusScene> documented_scenes() {
  std::vector<CorpusScene> scenes;
  for (const CorpusScene& scene : corpus_scenes())
    if (scene.path.starts_with("mitsuba-data/docs/")) scenes.push_back(scene);
  return scenes;
}

TEST(DocsPictureScenes, AreThere) {
  if (corpus().empty()) GTEST_SKIP() << "no corpus";
  EXPECT_FALSE(documented_scenes().empty());
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DocsPicture);
INSTANTIATE_TEST_SUITE_P(Corpus, DocsPicture, ::testing::ValuesIn(documented_scenes()),
                         [](const auto& scene) { return case_name(scene.param.name()); });

}  // namespace
}  // namespace vitrail::test::docs_picture_test
