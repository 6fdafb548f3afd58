// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_textures.h"

#include <random>
#include <span>

#include "partitioner/appearance/row_halver.h"
#include "scene/spectra/matrix_r.h"
#include "tests/partitioner/baked_scene.h"
#include "tracer/textures/baked_image.h"

namespace vitrail::bake_textures_test {

namespace {

using test::at_uv;
using test::some_wavelengths;

Image colors(int width, int height, float greatest) {
  Image image = black_image(width, height, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> u(0, greatest);
  for (float& v : image.values) v = u(random);
  return image;
}

RGB color_of(const Image& image, int x, int y) {
  const float* const v = &image.values[static_cast<std::size_t>(3 * (y * image.width + x))];
  return {v[0], v[1], v[2]};
}

// Every pixel of the file, looked up where it should be.
void expect_pixels(test::BakedScene& s, const SpectrumParameter& parameter, const Image& image,
                   Spectrum (*spectrum_of)(RGB), double tolerance) {
  const Textures textures = s.look_up();
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const TexturePoint at = at_uv((x + 0.5) / image.width, 1 - (y + 0.5) / image.height);
      test::expect_near(textures.spectrum(parameter, at, some_wavelengths),
                        spectrum_of(color_of(image, x, y)), tolerance);
    }
}

TEST(BakeTextures, ReflectancesOfLinearPixels) {
  test::BakedScene s;
  const Image image = colors(70, 40, 1);
  write_exr_image(s.directory / "a.exr", image);
  const Id<Texture> id = s.add(s.image("a.exr"));
  const SpectrumParameter baked = s.bake().bake(id, TextureUse::reflectance);
  ASSERT_EQ(s.baker->files().size(), 1u);
  EXPECT_EQ(s.baker->files()[0].name, "textures/000000.tex");
  EXPECT_EQ(s.baker->files()[0].bytes, std::filesystem::file_size(s.directory / "b.vit/textures/000000.tex"));
  expect_pixels(
      s, baked, image, [](RGB c) { return Spectrum{reflectance_from_rgb(c)}; }, 1e-3);
}

TEST(BakeTextures, ImagesKeepTheirMappingWrapAndFilter) {
  test::BakedScene s;
  write_exr_image(s.directory / "a.exr", colors(3, 2, 1));
  ImageTexture image = s.image("a.exr");
  image.mapping = UvMapping{2, 3, 0.25, 0.5};
  image.wrap = Wrap::mirror;
  image.filter = TextureFilter::trilinear;
  const SpectrumParameter baked = s.bake().bake(s.add(image), TextureUse::reflectance);
  s.look_up();
  const auto& kept = std::get<ImageTexture>(s.baked.at(std::get<Id<Texture>>(baked).value).model);
  EXPECT_EQ(kept.mapping, image.mapping);
  EXPECT_EQ(kept.wrap, image.wrap);
  EXPECT_EQ(kept.filter, image.filter);
}

// The file of rows that come one by one is that of the whole image.
TEST(BakeTextures, RowsMakeTheSameFile) {
  test::BakedScene s;
  const ReflectanceFitter fitter;
  for (const auto use :
       {TextureUse::reflectance, TextureUse::unbounded, TextureUse::number, TextureUse::vector}) {
    const Image image = colors(131, 77, 3);
    const ImageRows rows{131, 77, [&](const std::function<void(Image)>& visit) {
                           constexpr std::size_t stride = 131 * 3;
                           for (auto row = image.values.begin(); row != image.values.end(); row += stride)
                             visit({131, 1, 3, {row, row + stride}});
                         }};
    const auto one = write_baked_image(s.directory / "one.tex", rows, use, true, fitter);
    const auto all = write_baked_image(s.directory / "all.tex", rows_of(image), use, true, fitter);
    EXPECT_EQ(one.hash, all.hash);
    EXPECT_EQ(one.bytes, std::filesystem::file_size(s.directory / "one.tex"));
    TextureFile(s.directory / "one.tex").check_tiles();
  }
}

TEST(BakeTextures, UnboundedPixels) {
  test::BakedScene s;
  const Image image = colors(9, 5, 3);
  write_exr_image(s.directory / "a.exr", image);
  const Id<Texture> id = s.add(s.image("a.exr"));
  expect_pixels(s, s.bake().bake(id, TextureUse::unbounded), image, unbounded_from_rgb, 3e-3);
}

TEST(BakeTextures, PixelsThatEmit) {
  test::BakedScene s;
  const Image image = colors(9, 5, 20);
  write_exr_image(s.directory / "a.exr", image);
  const Id<Texture> id = s.add(s.image("a.exr"));
  expect_pixels(
      s, s.bake().bake(id, TextureUse::illuminant), image,
      [](RGB c) { return Spectrum{emission_from_rgb(c)}; }, 1e-2);
}

// The colour of light that is D65 times the spectrum, or the spectrum itself.
RGB color_of(const Textures& textures, const SpectrumParameter& parameter, const TexturePoint& at,
             bool shines) {
  XYZ xyz{};
  for (std::size_t i = 0; i < table_size; ++i) {
    SampledWavelengths w = some_wavelengths;
    w.lambda_nm.fill(static_cast<float>(lambda_min_nm) + static_cast<float>(i));
    const double light = shines ? 1 : static_cast<double>(cie_d65()[i]),
                 value = static_cast<double>(textures.spectrum(parameter, at, w).v[0]) * light /
                         cie_y_integral_nm;
    xyz.x += value * static_cast<double>(cie_1931()[i][0]);
    xyz.y += value * static_cast<double>(cie_1931()[i][1]);
    xyz.z += value * static_cast<double>(cie_1931()[i][2]);
  }
  return xyz_to_srgb(xyz);
}

// Each pixel has the spectrum that a colour of its own would have, within what 21 bits of its three numbers
// hold, and its colour comes back; greys among them too.
TEST(BakeTextures, ColorsByMatrixR) {
  for (const auto& [use, greatest] : {std::pair{TextureUse::reflectance, 1.0f},
                                      {TextureUse::unbounded, 3.0f},
                                      {TextureUse::illuminant, 20.0f}}) {
    test::BakedScene s;
    s.scene.settings.rgb = RgbMethod::matrix_r;
    Image image = colors(9, 5, greatest);
    for (std::size_t c = 0; c < 3; ++c) image.values[c] = 0.25f * greatest, image.values[3 + c] = 0.995f;
    image.values[4] = 1;
    write_exr_image(s.directory / "a.exr", image);
    const Id<Texture> id = s.add(s.image("a.exr"));
    const SpectrumParameter baked = s.bake().bake(id, use);
    const Textures textures = s.look_up();
    const bool shines = use == TextureUse::illuminant;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const TexturePoint at = at_uv((x + 0.5) / image.width, 1 - (y + 0.5) / image.height);
        const RGB c = color_of(image, x, y), back = color_of(textures, baked, at, shines);
        const Spectrum own = shines                         ? Spectrum{emission_from_rgb(c)}
                             : use == TextureUse::unbounded ? unbounded_from_rgb(c)
                                                            : Spectrum{reflectance_from_rgb(c)};
        const double most = std::max({c.r, c.g, c.b});
        if (most > 1 || use != TextureUse::unbounded)  // of others the scale differs
          test::expect_near(textures.spectrum(baked, at, some_wavelengths),
                            resolved(own, RgbMethod::matrix_r), 4e-3 * (most > 1 ? 2 * most : 1));
        for (const auto channel : {&RGB::r, &RGB::g, &RGB::b})
          EXPECT_NEAR(back.*channel, c.*channel, 1e-3 * std::max(1.0, 2 * most)) << x << ' ' << y;
      }
  }
}

// In bands a pixel has its own three numbers, whether they are kept as floats or as codes; beside it the
// mean.
TEST(BakeTextures, ColorsByBands) {
  const auto expect_bands = [](const SampledSpectrum& value, RGB c) {
    const std::array wanted{c.b, c.g, c.r, c.r};  // at `some_wavelengths`
    for (std::size_t i = 0; i < hero_count; ++i)
      EXPECT_NEAR(static_cast<double>(value.v[i]), wanted[i], 1e-6 * std::max(1.0, wanted[i]));
  };
  test::BakedScene s;
  s.scene.settings.rgb = RgbMethod::bands;
  const Image image = colors(9, 5, 20);
  write_exr_image(s.directory / "a.exr", image);
  test::write_png(s.directory / "b.png", 2, 1, 3, {255, 0, 51, 0, 255, 51});
  ImageTexture codes = s.image("b.png");
  codes.encoding = Encoding::linear, codes.filter = TextureFilter::bilinear, codes.wrap = Wrap::clamp;
  const Id<Texture> floats = s.add(s.image("a.exr")), bytes = s.add(codes);
  TextureBaker& baker = s.bake();
  std::vector<SpectrumParameter> baked;
  for (const TextureUse use : {TextureUse::unbounded, TextureUse::illuminant})
    baked.push_back(baker.bake(floats, use));
  for (const TextureUse use : {TextureUse::reflectance, TextureUse::illuminant})
    baked.push_back(baker.bake(bytes, use));
  const Textures textures = s.look_up();
  EXPECT_EQ(textures.image(std::get<Id<Texture>>(baked[2])).file().info().format, TexelFormat::band_code);
  for (std::size_t i = 0; i < 2; ++i)
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        expect_bands(textures.spectrum(baked[i], at_uv((x + 0.5) / image.width, 1 - (y + 0.5) / image.height),
                                       some_wavelengths),
                     color_of(image, x, y));
  for (std::size_t i = 2; i < 4; ++i) {
    expect_bands(textures.spectrum(baked[i], at_uv(0.25, 0.5), some_wavelengths), {1, 0, 0.2});
    expect_bands(textures.spectrum(baked[i], at_uv(0.5, 0.5), some_wavelengths), {0.5, 0.5, 0.2});
  }
}

TEST(BakeTextures, DecodesScalesAndInverts) {
  test::BakedScene s;
  test::write_png(s.directory / "a.png", 2, 2, 3, {0, 51, 255, 10, 20, 30, 90, 90, 90, 200, 100, 0});
  ImageTexture plain = s.image("a.png"), changed = plain, linear = plain, power = plain;
  changed.scale = 0.5f, changed.invert = true;
  linear.encoding = Encoding::linear;
  power.encoding = Encoding::gamma, power.gamma = 2;
  const Id<Texture> ids[]{s.add(plain, true), s.add(changed, true), s.add(linear, true), s.add(power, true)};
  TextureBaker& baker = s.bake();
  std::vector<FloatParameter> baked;
  for (const Id<Texture> id : ids) baked.push_back(baker.bake(FloatParameter{id}));
  const Textures textures = s.look_up();
  const TexturePoint upper_left = at_uv(0.25, 0.75), lower_left = at_uv(0.25, 0.25);
  const double decoded = (srgb_decode(0.2) + 1) / 3;  // the mean of 0, 51/255, 255/255
  EXPECT_NEAR(textures.number(baked[0], upper_left), decoded, 1e-6);
  EXPECT_NEAR(textures.number(baked[0], lower_left), srgb_decode(90.0 / 255), 1e-6);
  EXPECT_NEAR(textures.number(baked[1], upper_left), 1 - decoded / 2, 1e-6);
  EXPECT_NEAR(textures.number(baked[2], upper_left), 1.2 / 3, 1e-6);
  EXPECT_NEAR(textures.number(baked[3], upper_left), 1.04 / 3, 1e-6);
}

// The same file is one image for each number that is taken from it.
TEST(BakeTextures, NumbersOfChannels) {
  test::BakedScene s;
  test::write_png(s.directory / "a.png", 1, 1, 4, {51, 102, 204, 153});
  const std::vector<std::pair<ImageNumber, double>> expected{{ImageNumber::mean, 1.4 / 3},
                                                             {ImageNumber::green, 0.4},
                                                             {ImageNumber::alpha, 0.6},
                                                             {ImageNumber::alpha_or_mean, 0.6}};
  std::vector<Id<Texture>> ids;
  for (const auto& [number, value] : expected) {
    ImageTexture texture = s.image("a.png");
    texture.encoding = Encoding::linear, texture.number = number;
    ids.push_back(s.add(texture, true));
  }
  TextureBaker& baker = s.bake();
  std::vector<FloatParameter> baked;
  for (const Id<Texture> id : ids) baked.push_back(baker.bake(FloatParameter{id}));
  EXPECT_EQ(baker.files().size(), expected.size());
  const Textures textures = s.look_up();
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(textures.number(baked[i], at_uv(0.5, 0.5)), expected[i].second, 1e-6) << i;
}

TEST(BakeTextures, GreysAreNumbersAndNormalMapsExact) {
  test::BakedScene s;
  test::write_png(s.directory / "grey.png", 2, 1, 3, {9, 9, 9, 200, 200, 200});
  test::write_png(s.directory / "normal.png", 2, 1, 3, {128, 127, 255, 1, 2, 3});
  const Id<Texture> grey = s.add(s.image("grey.png")), normal = s.add(s.image("normal.png"));
  TextureBaker& baker = s.bake();
  const SpectrumParameter spectrum = baker.bake(grey, TextureUse::reflectance);
  const Id<Texture> vector = baker.bake_vector(normal);
  const auto format = [&](const char* name) { return TextureFile(s.directory / name).info().format; };
  baker.files();
  EXPECT_EQ(format("b.vit/textures/000000.tex"), TexelFormat::number_code);
  EXPECT_EQ(format("b.vit/textures/000001.tex"), TexelFormat::vector_8);
  const Textures textures = s.look_up();
  test::expect_near(textures.spectrum(spectrum, at_uv(0.8, 0.5), some_wavelengths),
                    ConstantSpectrum{static_cast<float>(srgb_decode(200.0 / 255))}, 1e-6);
  EXPECT_EQ(textures.vector(vector, at_uv(0.2, 0.5)),
            (std::array<double, 3>{128 / 255.0, 127 / 255.0, 255 / 255.0}));
  EXPECT_EQ(textures.vector(vector, at_uv(0.8, 0.5)),
            (std::array<double, 3>{1 / 255.0, 2 / 255.0, 3 / 255.0}));
}

TEST(BakeTextures, OneFileForOneUse) {
  test::BakedScene s;
  write_exr_image(s.directory / "a.exr", colors(8, 8, 1));
  ImageTexture other = s.image("a.exr"), filtered = other;
  other.wrap = Wrap::clamp;
  filtered.filter = TextureFilter::trilinear;
  const Id<Texture> a = s.add(s.image("a.exr")), b = s.add(other), c = s.add(filtered);
  TextureBaker& baker = s.bake();
  const SpectrumParameter first = baker.bake(a, TextureUse::reflectance);
  EXPECT_EQ(baker.bake(a, TextureUse::reflectance), first);
  EXPECT_NE(baker.bake(b, TextureUse::reflectance), first);
  EXPECT_EQ(baker.files().size(), 1u);
  baker.bake(FloatParameter{a});
  EXPECT_EQ(baker.files().size(), 2u);
  baker.bake(c, TextureUse::reflectance);
  ASSERT_EQ(baker.files().size(), 3u);
  EXPECT_EQ(TextureFile(s.directory / "b.vit/textures/000000.tex").info().levels, 1u);
  EXPECT_EQ(TextureFile(s.directory / "b.vit/textures/000002.tex").info().levels, 4u);
  EXPECT_EQ(TextureFile(s.directory / "b.vit/textures/000002.tex").hash(), baker.files()[2].hash);
}

TEST(BakeTextures, ImagesOfLights) {
  test::BakedScene s;
  write_exr_image(s.directory / "a.exr", colors(8, 4, 5));
  TextureBaker& baker = s.bake();
  const std::string name = baker.bake_image(s.image("a.exr"), TextureUse::illuminant, {});
  EXPECT_EQ(baker.bake_image(s.image("a.exr"), TextureUse::illuminant, {}), name);
  const TextureFileInfo info = TextureFile(s.directory / "b.vit" / name).info();
  EXPECT_EQ(info.levels, 4u);
  EXPECT_EQ(info.format, TexelFormat::illuminant);
}

TEST(BakeTextures, ImageThatCannotBeRead) {
  test::BakedScene s;
  s.scene.files = {"scene.pbrt"};
  const Id<Texture> id = s.add(s.image("none.png"));
  s.scene.textures.back().origin = {0, 7, 3};
  TextureBaker& baker = s.bake();
  try {
    baker.bake(id, TextureUse::reflectance);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("none.png"), std::string::npos) << error.what();
    EXPECT_EQ(error.location.file, "scene.pbrt");
    EXPECT_EQ(error.location.line, 7);
  }
  EXPECT_FALSE(std::filesystem::exists(s.directory / "b.vit/textures"));
}

TEST(BakeTextures, ValuesThatAreNotFiniteCountAsZero) {
  test::BakedScene s;
  Image image = colors(2, 1, 1);
  image.values[0] = std::numeric_limits<float>::quiet_NaN();
  image.values[4] = std::numeric_limits<float>::infinity();
  write_exr_image(s.directory / "a.exr", image);
  const Id<Texture> id = s.add(s.image("a.exr"));
  const SpectrumParameter baked = s.bake().bake(id, TextureUse::illuminant);
  EXPECT_EQ(s.diagnostics.size(), 1u);
  image.values[0] = image.values[4] = 0;
  expect_pixels(
      s, baked, image, [](RGB c) { return Spectrum{emission_from_rgb(c)}; }, 1e-3);
}

TEST(BakeTextures, PtexThatCannotBeReadIsGrey) {
  test::BakedScene s;
  PtexTexture ptex;
  ptex.scale = 0.5f;
  EXPECT_EQ(s.bake().bake(s.add(ptex), TextureUse::reflectance), SpectrumParameter{ConstantSpectrum{0.25f}});
  EXPECT_EQ(s.diagnostics.size(), 1u);
}

double mean_of(const Image& image) {
  double sum = 0;
  for (const float v : image.values) sum += static_cast<double>(v);
  return sum / static_cast<double>(image.values.size());
}

Image halved(const Image& image) {
  RowHalver halver(image.width, image.height, image.channels);
  Image half{std::max(1, image.width / 2), 0, image.channels, {}};
  const auto stride = static_cast<std::size_t>(image.width * image.channels);
  for (std::size_t at = 0; at < image.values.size(); at += stride)
    halver.add(std::span(image.values).subspan(at, stride), [&](std::span<const float> row) {
      half.values.insert(half.values.end(), row.begin(), row.end());
      ++half.height;
    });
  return half;
}

TEST(RowHalver, KeepsTheMeanAndThePlace) {
  for (const auto [width, height] : {std::array{8, 4}, {7, 5}, {1, 9}, {3, 1}, {129, 65}}) {
    Image image = colors(width, height, 1);
    const double mean = mean_of(image);
    while (image.pixels() > 1) {
      const Image half = halved(image);
      ASSERT_EQ(half.width, std::max(1, image.width / 2));
      ASSERT_EQ(half.height, std::max(1, image.height / 2));
      image = half;
      EXPECT_NEAR(mean_of(image), mean, 1e-6);
    }
  }
  Image row{4, 1, 1, {1, 3, 10, 20}};
  EXPECT_EQ(halved(row).values, (std::vector<float>{2, 15}));
  Image odd{3, 1, 1, {1, 5, 7}};
  EXPECT_NEAR(static_cast<double>(halved(odd).values[0]), 13.0 / 3, 1e-6);
}

}  // namespace

}  // namespace vitrail::bake_textures_test
