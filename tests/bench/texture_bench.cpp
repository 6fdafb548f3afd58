// SPDX-License-Identifier: Apache-2.0
// Nanoseconds a texture lookup, and texels a second that are baked.
#include <benchmark/benchmark.h>

#include <random>

#include "bundle/texture_file.h"
#include "partitioner/appearance/bake_image.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/support/temporary_directory.h"
#include "tracer/textures/textures.h"

namespace vitrail {

namespace {

constexpr SampledWavelengths some_wavelengths{{430, 512.5f, 601, 700}, {1, 1, 1, 1}};

Image noise(int size, int levels) {
  Image image = black_image(size, size, 3);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> u(0, levels - 1);
  for (float& v : image.values) v = static_cast<float>(0.05 + 0.9 * u(random) / levels);
  return image;
}

struct Bundle {
  test::TemporaryDirectory directory;
  std::vector<Texture> textures;

  explicit Bundle(int size) {
    std::filesystem::create_directories(directory / "textures");
    const ReflectanceFitter fitter;
    write_baked_image(directory / "textures/0.tex", rows_of(noise(size, 8)), TextureUse::reflectance, true,
                      fitter);
    write_baked_image(directory / "textures/1.tex", rows_of(noise(size, 8)), TextureUse::number, true,
                      fitter);
    ImageTexture image;
    image.filename = "textures/0.tex";
    add(image);
    image.filter = TextureFilter::trilinear;
    add(image);
    image.filter = TextureFilter::nearest;
    add(image);
    image.filename = "textures/1.tex";
    image.filter = TextureFilter::bilinear;
    add(image, true);
    add(CheckerboardTexture{reflectance_from_rgb({0.8, 0.1, 0.1}), ConstantSpectrum{0.25f},
                            UvMapping{7, 0, 0, 0, 7, 0}});
  }
  void add(TextureModel model, bool is_float = false) {
    textures.emplace_back();
    textures.back().model = std::move(model);
    textures.back().is_float = is_float;
  }
};

std::vector<TexturePoint> points(double extent) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(0, extent);
  std::vector<TexturePoint> result(4096);
  for (TexturePoint& p : result) {
    p.uv = {u(random), u(random)};
    p.uv_width = 0.01;
  }
  return result;
}

void look_up(benchmark::State& state, const SpectrumParameter& parameter, double extent,
             std::uint64_t budget = 1ull << 30) {
  static const Bundle bundle(512);
  const Textures textures(bundle.textures, bundle.directory.path(), budget);
  const std::vector<TexturePoint> at = points(extent);
  for (const TexturePoint& p : at)
    benchmark::DoNotOptimize(textures.spectrum(parameter, p, some_wavelengths));
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(textures.spectrum(parameter, at[i++ % at.size()], some_wavelengths));
}

const auto registered = [] {
  const auto add = [](const char* name, SpectrumParameter parameter, double extent, std::uint64_t budget) {
    benchmark::RegisterBenchmark(name, [=](benchmark::State& s) { look_up(s, parameter, extent, budget); });
  };
  constexpr std::uint64_t all = 1 << 30, little = 8 << 14;
  add("constant", ConstantSpectrum{0.5f}, 1, all);
  add("constant_color", reflectance_from_rgb({0.8, 0.1, 0.1}), 1, all);
  add("bilinear_near", Id<Texture>{0}, 0.05, all);
  add("bilinear", Id<Texture>{0}, 1, all);
  add("trilinear", Id<Texture>{1}, 1, all);
  add("nearest", Id<Texture>{2}, 1, all);
  add("bilinear_number", Id<Texture>{3}, 1, all);
  add("checkerboard", Id<Texture>{4}, 1, all);
  add("bilinear_read", Id<Texture>{0}, 1, little);
  return 0;
}();

// Colours that all differ, and few of them.
void bake(benchmark::State& state) {
  const test::TemporaryDirectory directory;
  const Image image = noise(512, static_cast<int>(state.range(0)));
  const ReflectanceFitter fitter;
  for (auto _ : state)
    write_baked_image(directory / "a.tex", rows_of(image), TextureUse::reflectance, false, fitter);
  state.counters["texels"] = benchmark::Counter(static_cast<double>(image.pixels() * state.iterations()),
                                                benchmark::Counter::kIsRate);
}
BENCHMARK(bake)->Arg(256)->Arg(8)->UseRealTime();

}  // namespace

}  // namespace vitrail

BENCHMARK_MAIN();
