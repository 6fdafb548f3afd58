// SPDX-License-Identifier: Apache-2.0
// Texture graphs: baked by the partitioner, evaluated by the tracer.
#include <fstream>
#include <numbers>

#include "scene/spectra/rgb_bands.h"
#include "scene/system/diagnostics.h"
#include "tests/images/ptex_bytes.h"
#include "tests/partitioner/baked_scene.h"
#include "tracer/textures/noise.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail::texture_graph_test {

namespace {

using test::at_uv;
using test::some_wavelengths;

Spectrum color(double r, double g, double b) { return unbounded_from_rgb({r, g, b}); }

// 2 × 2 numbers: below 1 2, above 3 4.
void write_four(const std::filesystem::path& file) { write_exr_image(file, {2, 2, 1, {3, 4, 1, 2}}); }

TEST(TextureGraph, Checkerboards) {
  test::BakedScene s;
  const Spectrum red = color(0.8, 0.1, 0.1);
  CheckerboardTexture flat{red, ConstantSpectrum{0.25f}, UvMapping{2, 0, 0.5f, 0, 3, 0}}, solid = flat;
  solid.solid = true;
  solid.texture_to_world = scale({2, 2, 2});
  const Id<Texture> a = s.add(flat), b = s.add(solid);
  TextureBaker& baker = s.bake();
  const SpectrumParameter board = baker.bake(a, TextureUse::reflectance),
                          cubes = baker.bake(b, TextureUse::reflectance);
  const FloatParameter number = baker.bake(FloatParameter{a});
  const Textures textures = s.look_up();
  const auto at = [&](double u, double v) { return textures.spectrum(board, at_uv(u, v), some_wavelengths); };
  test::expect_near(at(0.1, 0.1), red, 1e-6);                      // cell (0, 0)
  test::expect_near(at(0.3, 0.1), ConstantSpectrum{0.25f}, 1e-6);  // cell (1, 0)
  test::expect_near(at(0.3, 0.4), red, 1e-6);                      // cell (1, 1)
  test::expect_near(at(-0.3, 0.1), ConstantSpectrum{0.25f}, 1e-6);
  EXPECT_NEAR(textures.number(number, at_uv(0.3, 0.1)), 0.25, 1e-7);
  EXPECT_NEAR(textures.number(number, at_uv(0.1, 0.1)), luminance(red), 1e-6);
  TexturePoint p;
  p.p = {1.9, 0.1, 2.1};  // cells (0, 0, 1)
  test::expect_near(textures.spectrum(cubes, p, some_wavelengths), ConstantSpectrum{0.25f}, 1e-6);
  p.p = {-0.1, 0.1, 2.1};
  test::expect_near(textures.spectrum(cubes, p, some_wavelengths), red, 1e-6);
}

TEST(TextureGraph, NoiseAndDotsAreEvaluated) {
  test::BakedScene s;
  NoiseTexture fbm, marble;
  marble.kind = NoiseTexture::Kind::marble;
  fbm.texture_to_world = translate({1, 2, 3}) * scale({2, 2, 2});
  const Spectrum red = color(0.8, 0.1, 0.1);
  const Id<Texture> number = s.add(fbm, true), grey = s.add(fbm), stone = s.add(marble),
                    dots = s.add(DotsTexture{red, number, UvMapping{2, 0, 0, 0, 2, 0}});
  TextureBaker& baker = s.bake();
  const FloatParameter height = baker.bake(FloatParameter{number});
  const SpectrumParameter value = baker.bake(grey, TextureUse::reflectance),
                          lamp = baker.bake(grey, TextureUse::illuminant),
                          marbled = baker.bake(stone, TextureUse::reflectance),
                          dotted = baker.bake(dots, TextureUse::reflectance);
  EXPECT_TRUE(s.diagnostics.empty());
  const Textures textures = s.look_up();
  const Spectrum white = emission_from_rgb({1, 1, 1});
  int negative = 0, inside = 0;
  for (int i = 0; i < 200; ++i) {
    TexturePoint at = at_uv(0.31 * i, 0.07 * i);
    at.p = {0.37 * i, 0.11 * i, -0.23 * i};
    const double expected = noise_value(fbm, {(at.p.x - 1) / 2, (at.p.y - 2) / 2, (at.p.z - 3) / 2});
    EXPECT_NEAR(textures.number(height, at), expected, 1e-6);
    negative += expected < 0;
    const ConstantSpectrum shown{static_cast<float>(std::max(0.0, expected))};
    test::expect_near(textures.spectrum(value, at, some_wavelengths), shown, 1e-6);
    test::expect_near(textures.spectrum(lamp, at, some_wavelengths), product(white, shown), 1e-5);
    const bool in = inside_dot(2 * at.uv.x, 2 * at.uv.y);
    inside += in;
    test::expect_near(textures.spectrum(dotted, at, some_wavelengths), in ? red : Spectrum{shown}, 1e-5);
    const auto weights = marble_weights(marble, at.p);
    Spectrum blend = ConstantSpectrum{0};
    for (std::size_t k = 0; k < weights.size(); ++k)
      blend = weighted_sum(blend, 1, Spectrum{marble_colors[k]}, weights[k]);
    test::expect_near(textures.spectrum(marbled, at, some_wavelengths), blend, 1e-4);
  }
  EXPECT_GT(negative, 20);
  EXPECT_GT(inside, 10);
}

TEST(TextureGraph, SumsAndProducts) {
  test::BakedScene s;
  write_four(s.directory / "four.exr");
  const Id<Texture> four = s.add(s.image("four.exr"), true);
  const Spectrum red = color(0.8, 0.1, 0.1), blue = color(0.1, 0.2, 0.9);
  const Id<Texture> product = s.add(ProductTexture{red, four}), mix = s.add(MixTexture{red, blue, 0.25f});
  const Id<Texture> by_image = s.add(MixTexture{ConstantSpectrum{1}, ConstantSpectrum{5}, four}, true);
  const Id<Texture> facing = s.add(DirectionMixTexture{red, blue, {0, 0, 1}});
  const Id<Texture> corners = s.add(BilinearTexture{ConstantSpectrum{1}, ConstantSpectrum{2},
                                                    ConstantSpectrum{3}, ConstantSpectrum{7}, UvMapping{}},
                                    true);
  TextureBaker& baker = s.bake();
  const auto use = TextureUse::reflectance;
  const SpectrumParameter baked_product = baker.bake(product, use), baked_mix = baker.bake(mix, use),
                          baked_facing = baker.bake(facing, use);
  const FloatParameter baked_by_image = baker.bake(FloatParameter{by_image}),
                       baked_corners = baker.bake(FloatParameter{corners});
  const Textures textures = s.look_up();
  TexturePoint at = at_uv(0.75, 0.25);  // the lower right number, 2
  at.normal = {0, 0.8, -0.6};
  test::expect_near(textures.spectrum(baked_product, at, some_wavelengths), scaled(red, 2), 1e-3);
  test::expect_near(textures.spectrum(baked_mix, at, some_wavelengths), weighted_sum(red, 0.75, blue, 0.25),
                    3e-5);
  test::expect_near(textures.spectrum(baked_facing, at, some_wavelengths), weighted_sum(red, 0.6, blue, 0.4),
                    3e-5);
  EXPECT_NEAR(textures.number(baked_by_image, at), (1 - 2) * 1 + 2 * 5, 1e-9);
  EXPECT_NEAR(textures.number(baked_corners, at),
              0.25 * 0.75 * 1 + 0.25 * 0.25 * 2 + 0.75 * 0.75 * 3 + 0.75 * 0.25 * 7, 1e-9);
}

TEST(TextureGraph, ColorsMeanWhatTheyAreUsedFor) {
  test::BakedScene s;
  const Spectrum bright = color(3, 1, 0.5);
  const Id<Texture> board = s.add(CheckerboardTexture{bright, bright, UvMapping{}});
  TextureBaker& baker = s.bake();
  const SpectrumParameter reflectance = baker.bake(board, TextureUse::reflectance),
                          factor = baker.bake(board, TextureUse::unbounded),
                          emission = baker.bake(board, TextureUse::illuminant);
  const Textures textures = s.look_up();
  const auto at = [&](const SpectrumParameter& p) {
    return textures.spectrum(p, at_uv(0.1, 0.1), some_wavelengths);
  };
  test::expect_near(at(reflectance), reflectance_from_rgb({1, 1, 0.5}), 1e-6);
  test::expect_near(at(factor), bright, 1e-5);
  test::expect_near(at(emission), emission_from_rgb({3, 1, 0.5}), 1e-5);
}

// As those of an image do: a grey of ½ shines as rgb ½ ½ ½ does.
TEST(TextureGraph, SpectraThatShineAreUnderD65) {
  test::BakedScene s;
  const Id<Texture> grey =
      s.add(CheckerboardTexture{ConstantSpectrum{0.5f}, ConstantSpectrum{0.5f}, UvMapping{}});
  const SpectrumParameter emission = s.bake().bake(grey, TextureUse::illuminant);
  const Textures textures = s.look_up();
  test::expect_near(textures.spectrum(emission, at_uv(0.1, 0.1), some_wavelengths),
                    emission_from_rgb({0.5, 0.5, 0.5}), 1e-5);
}

TEST(TextureGraph, MeansOfImagesSayHowFarTheyAreOff) {
  test::BakedScene s;
  Image two = black_image(2, 1, 1);
  two.values = {0.2f, 0.6f};
  ImageTexture texture = s.image("two.exr");
  texture.encoding = Encoding::linear;
  write_exr_image(texture.filename, two);
  const Id<Texture> id = s.add(texture);
  const auto mean = s.bake().mean(id);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->color.g, 0.4, 1e-6);
  EXPECT_NEAR(mean->deviation, 0.2, 1e-6);
}

// Where means can be read and texels cannot, the report says why it is the mean.
TEST(TextureGraph, PtexWhoseTexelsAreDamagedIsItsMean) {
  test::BakedScene s;
  std::string texels, mean;
  for (int i = 0; i < 8; ++i) test::put(texels, 1.0f);
  test::put(mean, 17.0f);
  PtexTexture ptex{(s.directory / "a.ptx").string(), Encoding::linear};
  std::ofstream(ptex.filename, std::ios::binary) << test::ptex_bytes(
      test::PtexType::single, 1, {{2, 1, mean, test::PtexEncoding::zipped, test::zipped(texels).substr(4)}});
  const Id<Texture> id = s.add(ptex, true);
  EXPECT_EQ(std::get<float>(s.bake().bake(FloatParameter{id})), 17);
  ASSERT_EQ(s.diagnostics.size(), 1u);
  EXPECT_NE(s.diagnostics[0].message.find("its zipped parts are damaged"), std::string::npos);
}

// Two faces: 4 × 2 numbers, and one constant. The corners of a triangle of a face lie where its (u,v) do.
TEST(TextureGraph, PtexShowsTheTexelsOfItsFaces) {
  test::BakedScene s;
  std::string texels, one, mean;
  const auto texel = [](int x, int y) { return static_cast<float>(1 + 3 * x * x + 10 * y); };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) test::put(texels, texel(x, y));
  test::put(one, 100.0f), test::put(mean, 17.0f);
  PtexTexture ptex{(s.directory / "a.ptx").string(), Encoding::linear};
  ptex.scale = 0.5f;
  std::ofstream(ptex.filename, std::ios::binary)
      << test::ptex_bytes(test::PtexType::single, 1,
                          {{2, 1, mean, test::PtexEncoding::zipped, test::zipped(texels)}, {3, 3, one}});
  const Id<Texture> id = s.add(ptex, true);
  const FloatParameter baked = s.bake().bake(FloatParameter{id});
  ASSERT_EQ(s.baker->attributes().size(), 1u);
  const PtexTiles tiles = *s.baker->attributes()[0].tiles;
  const Textures textures = s.look_up();
  const auto at = [&](float face, double u, double v) {  // in the triangle (0,0) (1,0) (0,1)
    AttributeValue value;
    value.weights = {static_cast<float>(1 - u - v), static_cast<float>(u), static_cast<float>(v)};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2f place = tiles.at(face, {k == 1 ? 1.0f : 0.0f, k == 2 ? 1.0f : 0.0f});
      value.corners[k] = {place.x, place.y, 0};
    }
    TexturePoint point;
    point.attributes = std::span(&value, 1);
    return textures.number(baked, point);
  };
  const auto smoothed = [&](int x, int y) {
    double sum = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        sum += (dx == 0 ? 4 : 1) * (dy == 0 ? 4 : 1) / 36.0 *
               static_cast<double>(texel(std::clamp(x + dx, 0, 3), std::clamp(y + dy, 0, 1)));
    return sum / 2;
  };
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_NEAR(at(0, (x + 0.5) / 4, (y + 0.5) / 2), smoothed(x, y), 2e-3) << x << " " << y;
  EXPECT_NEAR(at(0, 0.25, 0.25), (smoothed(0, 0) + smoothed(1, 0)) / 2, 2e-3);
  EXPECT_NEAR(at(0, 0, 0), smoothed(0, 0), 2e-3);  // nothing of what lies beside it
  EXPECT_NEAR(at(0, 1, 0), smoothed(3, 0), 2e-3);
  EXPECT_NEAR(at(1, 0.3, 0.9), 50, 1e-3);
  EXPECT_EQ(at(2, 0.5, 0.5), 0);
  EXPECT_EQ(s.diagnostics.size(), 1u);
}

// pbrt's filter blends what the file stores, by a cubic B-spline, and what comes of it is decoded.
TEST(TextureGraph, PtexIsSmoothedBeforeItIsDecoded) {
  test::BakedScene s;
  std::string texels, mean;
  const auto texel = [](int x, int y) { return (7 * x + 5 * y + 3 * x * y) % 11 / 10.0; };
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) test::put(texels, static_cast<float>(texel(x, y)));
  test::put(mean, 0.5f);
  PtexTexture ptex{(s.directory / "a.ptx").string()};
  std::ofstream(ptex.filename, std::ios::binary) << test::ptex_bytes(
      test::PtexType::single, 1, {{2, 2, mean, test::PtexEncoding::zipped, test::zipped(texels)}});
  const Id<Texture> id = s.add(ptex, true);
  const FloatParameter baked = s.bake().bake(FloatParameter{id});
  const PtexTiles tiles = *s.baker->attributes()[0].tiles;
  const Textures textures = s.look_up();
  const auto spline = [](double t) {
    t = std::abs(t);
    return t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : t < 2 ? (2 - t) * (2 - t) * (2 - t) / 6 : 0;
  };
  double greatest = 0, sum = 0, expected_sum = 0;
  for (double v = 0.02; v < 1; v += 0.06)
    for (double u = 0.02; u < 1; u += 0.06) {
      double stored = 0;
      for (int y = -2; y < 6; ++y)
        for (int x = -2; x < 6; ++x)
          stored += spline(4 * u - 0.5 - x) * spline(4 * v - 0.5 - y) *
                    texel(std::clamp(x, 0, 3), std::clamp(y, 0, 3));
      AttributeValue value;
      value.weights = {1, 0, 0};
      const Point2f place = tiles.at(0, {static_cast<float>(u), static_cast<float>(v)});
      value.corners[0] = {place.x, place.y, 0};
      TexturePoint point;
      point.attributes = std::span(&value, 1);
      const double found = textures.number(baked, point), expected = std::pow(stored, 2.2);
      greatest = std::max(greatest, std::abs(found - expected));
      sum += found, expected_sum += expected;
    }
  EXPECT_LT(greatest, 0.01);
  EXPECT_NEAR(sum / expected_sum, 1, 2e-3);
}

TEST(TextureGraph, MappingsByPosition) {
  test::BakedScene s;
  const Transform place = translate({10, 0, 0}) * scale({2, 2, 2});
  const auto corners = [&](const TextureMapping& mapping) {  // shows s + 10·t
    return s.add(BilinearTexture{ConstantSpectrum{0}, ConstantSpectrum{10}, ConstantSpectrum{1},
                                 ConstantSpectrum{11}, mapping},
                 true);
  };
  const Id<Texture> sphere = corners(SphericalMapping{place}), cylinder = corners(CylindricalMapping{place}),
                    plane = corners(PlanarMapping{place, {1, 0, 0}, {0, 0, 2}, 0.5, 0.25});
  TextureBaker& baker = s.bake();
  const FloatParameter on_sphere = baker.bake(FloatParameter{sphere}),
                       on_cylinder = baker.bake(FloatParameter{cylinder}),
                       on_plane = baker.bake(FloatParameter{plane});
  std::vector<Texture> moved = baker.take_textures();
  move(moved, {-10, 1, 0});
  const Textures textures(moved, s.directory / "b.vit", 0);
  TexturePoint at;
  at.p = {0.6, 1 - 0.6, 0};  // (0.3, −0.3, 0) in texture space
  EXPECT_NEAR(textures.number(on_sphere, at), 0.5 + 10 * 0.875, 1e-12);
  EXPECT_NEAR(textures.number(on_cylinder, at), 0.5 - 0.125, 1e-12);
  EXPECT_NEAR(textures.number(on_plane, at), 0.3 + 0.5 + 10 * 0.25, 1e-12);
  at.p = {0, 1, 0};  // the origin
  EXPECT_NEAR(textures.number(on_sphere, at), 0, 1e-12);
}

TEST(TextureGraph, AttributesOfMeshes) {
  test::BakedScene s;
  const Id<Texture> a = s.add(MeshAttributeTexture{"color", 0.5f}),
                    b = s.add(MeshAttributeTexture{"wear"}, true);
  TextureBaker& baker = s.bake();
  const SpectrumParameter reflectance = baker.bake(a, TextureUse::reflectance),
                          emission = baker.bake(a, TextureUse::illuminant);
  const FloatParameter wear = baker.bake(FloatParameter{b}), number = baker.bake(FloatParameter{a});
  using Attribute = TextureBaker::Attribute;
  EXPECT_EQ(baker.attributes(), (std::vector<Attribute>{{"color", TextureUse::reflectance},
                                                        {"wear", TextureUse::number},
                                                        {"color", TextureUse::number}}));
  const RGB green{0.1, 0.7, 0.2};
  const ReflectanceFitter fitter;
  const auto everywhere = [](std::array<float, 3> v) {
    return AttributeValue{{v, v, v}, {0.25f, 0.25f, 0.5f}};
  };
  const std::array attributes{everywhere(attribute_value(green, TextureUse::reflectance, fitter)),
                              everywhere(attribute_value({0.25, 0.5, 0.75}, TextureUse::number, fitter)),
                              everywhere(attribute_value(green, TextureUse::number, fitter))};
  const std::array<float, 3> black = attribute_value({0, 0, 0}, TextureUse::reflectance, fitter);
  EXPECT_EQ(black, (std::array<float, 3>{-200, -200, -200}));
  const Textures textures = s.look_up();
  TexturePoint at;
  at.attributes = attributes;
  const Spectrum expected = reflectance_from_rgb(green);
  test::expect_near(textures.spectrum(reflectance, at, some_wavelengths), scaled(expected, 0.5), 1e-4);
  test::expect_near(textures.spectrum(emission, at, some_wavelengths),
                    product(scaled(expected, 0.5), emission_from_rgb({1, 1, 1})), 1e-4);
  EXPECT_NEAR(textures.number(wear, at), 0.5, 1e-7);
  EXPECT_NEAR(textures.number(number, at), 0.5 / 3, 1e-7);
  at.attributes = {};
  EXPECT_EQ(textures.number(wear, at), 0);
}

// In bands a vertex has its three numbers, and what shines has no D65.
TEST(TextureGraph, AttributesOfBandsAreNumbers) {
  test::BakedScene s;
  s.scene.settings.rgb = RgbMethod::bands;
  const auto a = s.add(MeshAttributeTexture{"color"});
  TextureBaker& baker = s.bake();
  const SpectrumParameter reflectance = baker.bake(a, TextureUse::reflectance),
                          emission = baker.bake(a, TextureUse::illuminant);
  ASSERT_EQ(baker.attributes(), (std::vector{TextureBaker::Attribute{"color", TextureUse::vector}}));
  const ReflectanceFitter fitter;
  const RGB corners[]{{0.1, 0.7, 0.2}, {0.5, 0.1, 0}, {0.3, 0.3, 0.8}};
  AttributeValue value{{}, {0.25f, 0.25f, 0.5f}};
  for (std::size_t i = 0; i < 3; ++i)
    value.corners[i] = attribute_value(corners[i], TextureUse::vector, fitter);
  const Textures textures = s.look_up();
  TexturePoint at;
  at.attributes = {&value, 1};
  for (const SpectrumParameter& parameter : {reflectance, emission})
    test::expect_near(textures.spectrum(parameter, at, some_wavelengths), band_spectrum({0.3, 0.35, 0.45}),
                      1e-6);
}

// Their spectra would multiply to another colour: teal times yellow has a quarter more red.
TEST(TextureGraph, AColorTimesAnImageIsTheProductOfTheirNumbers) {
  test::BakedScene s;
  write_exr_image(s.directory / "yellow.exr", {1, 1, 3, {0.8f, 0.7f, 0.1f}});
  ImageTexture image = s.image("yellow.exr");
  image.encoding = Encoding::linear;
  const Id<Texture> yellow = s.add(image), vertices = s.add(MeshAttributeTexture{"color"});
  const Spectrum teal = color(0.2, 0.7, 0.7), bright = color(4, 1, 2);
  const Id<Texture> of_image = s.add(ProductTexture{teal, yellow}),
                    swapped = s.add(ProductTexture{yellow, teal}),
                    bright_image = s.add(ProductTexture{bright, yellow}),
                    of_vertices = s.add(ProductTexture{teal, vertices});
  TextureBaker& baker = s.bake();
  const SpectrumParameter a = baker.bake(of_image, TextureUse::reflectance),
                          b = baker.bake(swapped, TextureUse::illuminant),
                          c = baker.bake(bright_image, TextureUse::unbounded),
                          plain = baker.bake(yellow, TextureUse::reflectance);
  baker.bake(of_vertices, TextureUse::reflectance);
  EXPECT_EQ(baker.attributes(), (std::vector<TextureBaker::Attribute>{
                                    {"color", TextureUse::reflectance, nullptr, Tint{0.2f, 0.7f, 0.7f}}}));
  const Textures textures = s.look_up();
  const auto at = [&](const SpectrumParameter& p) {
    return textures.spectrum(p, at_uv(0.5, 0.5), some_wavelengths);
  };
  test::expect_near(at(a), reflectance_from_rgb({0.16, 0.49, 0.07}), 2e-3);
  test::expect_near(at(b), emission_from_rgb({0.16, 0.49, 0.07}), 2e-3);
  test::expect_near(at(c), unbounded_from_rgb({3.2, 0.7, 0.2}), 8e-3);
  test::expect_near(at(plain), reflectance_from_rgb({0.8, 0.7, 0.1}), 2e-3);
}

TEST(TextureGraph, UvAsAColor) {
  test::BakedScene s;
  const Id<Texture> uv = s.add(UvTexture{});
  const SpectrumParameter baked = s.bake().bake(uv, TextureUse::reflectance);
  const Textures textures = s.look_up();
  test::expect_near(textures.spectrum(baked, at_uv(2.3, 0.75), some_wavelengths),
                    reflectance_from_rgb({0.3, 0.75, 0}), 0.02);
}

TEST(TextureGraph, FiltersByFootprint) {
  test::BakedScene s;
  Image stripes = black_image(256, 256, 1);
  for (std::size_t i = 0; i < stripes.values.size(); i += 2) stripes.values[i] = 1;
  write_exr_image(s.directory / "a.exr", stripes);
  ImageTexture image = s.image("a.exr");
  image.filter = TextureFilter::trilinear;
  image.mapping = UvMapping{2, 0, 0, 0, 1, 0};
  const Id<Texture> id = s.add(image, true);
  const FloatParameter baked = s.bake().bake(FloatParameter{id});
  const Textures textures = s.look_up();
  TexturePoint at = at_uv(0.25 / 256, 0.5);  // the centre of texel 0 in s
  EXPECT_NEAR(textures.number(baked, at), 1, 1e-6);
  at.uv_width = 1.0 / 512;  // one texel in s
  EXPECT_NEAR(textures.number(baked, at), 1, 1e-6);
  at.uv_width = std::numbers::sqrt2 / 512;  // half way to the level of greys
  EXPECT_NEAR(textures.number(baked, at), 0.75, 1e-6);
  for (const double width : {2.0 / 512, 0.1, 1.0, 1e30, double(INFINITY)}) {
    at.uv_width = width;
    EXPECT_NEAR(textures.number(baked, at), 0.5, 1e-6);
  }
}

TEST(TextureGraph, WithinItsBudget) {
  test::BakedScene s;
  write_exr_image(s.directory / "a.exr", black_image(512, 512, 1));
  write_four(s.directory / "four.exr");
  const Id<Texture> a = s.add(s.image("a.exr"), true), b = s.add(s.image("four.exr"), true);
  TextureBaker& baker = s.bake();
  const FloatParameter first = baker.bake(FloatParameter{a}), second = baker.bake(FloatParameter{b});
  constexpr std::uint64_t budget = 100'000;
  const Textures textures = s.look_up(budget);
  for (int i = 0; i < 2000; ++i) {
    textures.number(first, at_uv(i * 0.377, i * 0.119));
    ASSERT_EQ(textures.number(second, at_uv(0.25, 0.25)), 1);
  }
  EXPECT_GT(textures.tile_loads(), 64u);
  EXPECT_LE(textures.resident_bytes(), budget);
  EXPECT_GT(textures.resident_bytes(), budget / 2);
}

TEST(TextureGraph, GraphsThatMakeNoSense) {
  const test::TemporaryDirectory directory;
  const auto refused = [&](const std::vector<Texture>& textures) {
    EXPECT_THROW(Textures(textures, directory.path(), 1 << 20), Error);
  };
  std::vector<Texture> one(1);
  one[0].model = ProductTexture{Id<Texture>{0}, ConstantSpectrum{1}};
  refused(one);
  one[0].model = MeshAttributeTexture{"x"};
  refused(one);
  one[0].model =
      CheckerboardTexture{ConstantSpectrum{1}, ConstantSpectrum{0}, SphericalMapping{scale({0, 0, 0})}};
  refused(one);
  std::vector<Texture> doubling(41);
  doubling[0].model = BilinearTexture{};
  for (std::uint32_t i = 1; i < doubling.size(); ++i)
    doubling[i].model = ProductTexture{Id<Texture>{i - 1}, Id<Texture>{i - 1}};
  refused(doubling);
}

}  // namespace

}  // namespace vitrail::texture_graph_test
