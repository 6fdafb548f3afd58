// SPDX-License-Identifier: Apache-2.0
// Scenes that nobody here made, against pictures by pbrt-v4 and Nori, whose variances are not known.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>

#include "compare/metrics.h"
#include "film/image_io.h"
#include "tests/conformance/corpus_render.h"
#include "tests/conformance/nori_scene.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"

namespace vitrail::test::picture_reference_test {
namespace {

namespace fs = std::filesystem;

struct Agreement {
  const char* scene;
  const char* reference;
  int samples;                    // a pixel; a quarter of 16 without VITRAIL_LONG_TESTS
  double reference_samples = 0;   // a pixel; 0: as its file says
  double shapes = 0;              // squared error that is due to shapes of triangles
  double reference_variance = 4;  // that its samples have at most, over ours
  int of_samples = 16;            // a tenth of whose noise is the limit
};

void PrintTo(const Agreement& a, std::ostream* out) { *out << a.scene; }

class PictureReference : public ::testing::TestWithParam<Agreement> {};

// A scene of pbrt with the reference's resolution, in a folder where the files it names are found: some
// references are smaller than the scene asks for. Its plastics are those that the reference has: pbrt-v4
// makes v3's its coats, which are not what v3 shows.
fs::path resized(const TemporaryDirectory& directory, const fs::path& scene, int width, int height) {
  fs::copy(scene.parent_path(), directory / "scene", fs::copy_options::recursive);
  std::ifstream in(scene);
  std::string text(std::istreambuf_iterator<char>(in), {});
  text = std::regex_replace(text, std::regex(R"("integer xresolution"\s*\[?\s*\d+\s*\]?)"),
                            fmt::format("\"integer xresolution\" [{}]", width));
  text = std::regex_replace(text, std::regex(R"("integer yresolution"\s*\[?\s*\d+\s*\]?)"),
                            fmt::format("\"integer yresolution\" [{}]", height));
  text = std::regex_replace(text, std::regex(R"re("plastic"(?:\s+"color Ks"\s*\[[^\]]*\])?\s+"color Kd")re"),
                            "\"coateddiffuse\" \"color reflectance\"");
  const fs::path copy = directory / "scene" / scene.filename().string();
  std::ofstream(copy) << text;
  return copy;
}

fs::path prepared(const TemporaryDirectory& directory, const fs::path& scene, const Image& reference) {
  if (scene.extension() == ".pbrt") return resized(directory, scene, reference.width, reference.height);
  const fs::path file = directory / "scene.xml";
  std::ofstream(file) << read_nori(scene).at(0).mitsuba;
  return file;
}

// Means over all values of two pictures a, b of different seeds and the reference r, relative to r² + 0.01.
struct Errors {
  double noise = 0;   // (a − b)²/2: a's own variance
  double shared = 0;  // (a − r)(b − r): the square of what both are off by, and r's variance
};

Errors errors(const Image& a, const Image& b, const Image& r) {
  Errors sum;
  for (std::size_t i = 0; i < r.values.size(); ++i) {
    const auto at = [i](const Image& image) { return static_cast<double>(image.values[i]); };
    const double scale = 1 / ((at(r) * at(r) + 0.01) * static_cast<double>(r.values.size()));
    sum.noise += scale * (at(a) - at(b)) * (at(a) - at(b)) / 2;
    sum.shared += scale * (at(a) - at(r)) * (at(b) - at(r));
  }
  return sum;
}

// Means within 1 %; what two films of different seeds are both off by must be the reference's noise: its
// samples may have up to four times our variance, whose wavelengths are stratified, and more where ours are
// better chosen. 2e-4: an error of 1.4 %
// in every pixel. A tenth of the noise of 16 samples, or as is said: what an estimate from noisy pictures
// may itself be off by.
TEST_P(PictureReference, IsMatched) {
  const Agreement& a = GetParam();
  if (corpus().empty()) GTEST_SKIP() << "there is no corpus here; set VITRAIL_CORPUS";
  const fs::path reference = corpus() / a.reference;
  if (!fs::exists(reference)) GTEST_SKIP() << "the corpus has no " << a.reference;
  const Picture shown = read_picture(reference);
  const double reference_samples = a.reference_samples > 0 ? a.reference_samples : shown.samples_per_pixel;
  ASSERT_GT(reference_samples, 0);
  const bool takes_few =
      a.samples == 16 && !std::string_view(a.scene).ends_with("01_cornell.pbrt");  // whose means are noisy
  const int samples = takes_few ? of_all(16, 4) : a.samples;
  const TemporaryDirectory directory;
  const fs::path scene = prepared(directory, corpus() / a.scene, shown.rgb);
  const fs::path first = directory / "1.exr", second = directory / "2.exr";
  std::string wrong = render_scene(scene, first, fmt::format("--spp {} --seed 1", samples));
  if (wrong.empty()) wrong = render_scene(scene, second, fmt::format("--spp {} --seed 2", samples));
  if (!wrong.empty()) return conclude(false, a.scene, wrong);
  const Errors e = errors(read_picture(first).rgb, read_picture(second).rgb, shown.rgb);
  const double noise = e.noise * samples, off = e.shared - a.reference_variance * noise / reference_samples;
  const MeanRatios means = mean_ratios(read_picture(first).rgb, shown.rgb);
  const double worst =
      std::max({std::abs(means.x - 1), std::abs(means.luminance - 1), std::abs(means.z - 1)});
  conclude(worst <= 0.01 && off <= 0.1 * noise / a.of_samples + 2e-4 + a.shapes, a.scene,
           fmt::format("mean ratios X Y Z {:.4f} {:.4f} {:.4f}   squared error {:.5f} beside noise {:.5f}",
                       means.x, means.luminance, means.z, off, e.noise));
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, PictureReference,
    ::testing::Values(
        Agreement{"pbrt-v4/scenes/01_cornell.pbrt", "pbrt-v4/ref/01_cornell.exr", 16},
        Agreement{"pbrt-v4/scenes/02_conductors.pbrt", "pbrt-v4/ref/02_conductors.exr", 16},
        Agreement{"pbrt-v4/scenes/03_dielectric.pbrt", "pbrt-v4/ref/03_dielectric.exr", 16},
        Agreement{"pbrt-v4/scenes/04_prism.pbrt", "pbrt-v4/ref/04_prism.exr", 16, 0, 0, 4, 64},
        Agreement{"pbrt-v4/scenes/05_rough_dielectric.pbrt", "pbrt-v4/ref/05_rough_dielectric.exr", 16},
        Agreement{"pbrt-v4/scenes/07_lights.pbrt", "pbrt-v4/ref/07_lights.exr", 16},
        Agreement{"pbrt-v4/scenes/09_textures.pbrt", "pbrt-v4/ref/09_textures.exr", 16},
        Agreement{"pbrt-v4/scenes/10_instances.pbrt", "pbrt-v4/ref/10_instances.exr", 16},
        // The edges of curves are those of triangles.
        Agreement{"pbrt-v4/scenes/11_shapes.pbrt", "pbrt-v4/ref/11_shapes.exr", 16, 0, 4e-4},
        Agreement{"pbrt-v4/scenes/14_ortho.pbrt", "pbrt-v4/ref/14_ortho.exr", 16},
        Agreement{"pbrt/cornell-box/scene.pbrt", "pbrt/cornell-box/scene_ref_pbrtv4.exr", 3, 128},
        Agreement{"pbrt/spheres-point/cornell.pbrt", "pbrt/spheres-point/cornell_ref_pbrtv4.exr", 5, 256},
        Agreement{"pbrt/killeroo-simple/killeroo-simple.pbrt",
                  "pbrt/killeroo-simple/killeroo-simple_ref_pbrtv4.exr", 6, 256, 0, 16},
        Agreement{"pbrt/sphere-env/sphere-dump.pbrt", "pbrt/sphere-env/sphere-dump_ref_pbrtv4.exr", 5, 64},
        Agreement{"nori/pa4/cbox/cbox-distributed.xml", "nori/refs/cbox-distributed.exr", 4, 512},
        Agreement{"nori/pa5/veach_mi/veach_mis.xml", "nori/refs/veach_mis.exr", 2, 128}),
    [](const auto& a) {
      return case_name(std::filesystem::path(a.param.scene).replace_extension().string());
    });

}  // namespace
}  // namespace vitrail::test::picture_reference_test
