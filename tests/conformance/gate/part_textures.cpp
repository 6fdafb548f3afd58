// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

Spectrum rgb(double r, double g, double b) { return reflectance_from_rgb({r, g, b}); }

ImageTexture image_of(const SceneParts& s, const char* name) {
  ImageTexture image;
  image.filename = s.image(name);
  return image;
}
Id<Texture> image(SceneParts& s, const char* name) { return s.add(image_of(s, name), false); }

UvMapping thrice() { return {3, 0, 0.2f, 0, 3, 0.1f}; }

TabulatedSpectrum ramp() {
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i)
    table.values.push_back(0.1f + 0.8f * static_cast<float>(i) / static_cast<float>(table_size));
  return table;
}

using S = SceneParts;
constexpr std::array colors{
    ColorValue{"rgb", [](S&) -> SpectrumParameter { return rgb(0.7, 0.4, 0.2); }},
    ColorValue{"spectrum", [](S&) -> SpectrumParameter { return Spectrum{ramp()}; }},
    ColorValue{"image", [](S& s) -> SpectrumParameter { return image(s, "a.png"); }},
    ColorValue{"linear image", [](S& s) -> SpectrumParameter { return image(s, "a.exr"); }},
    ColorValue{"scaled image",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "a.png");
                 texture.scale = 0.5f, texture.invert = true, texture.encoding = Encoding::linear;
                 return s.add(texture, false);
               }},
    ColorValue{"gamma image",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "a.png");
                 texture.encoding = Encoding::gamma, texture.gamma = 1.8f;
                 return s.add(texture, false);
               }},
    ColorValue{"nearest, clamped, sheared",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "b.png");
                 texture.filter = TextureFilter::nearest, texture.wrap = Wrap::clamp;
                 texture.mapping = UvMapping{1.5f, 0.5f, -0.2f, -0.4f, 1.3f, 0.1f};
                 return s.add(texture, false);
               }},
    ColorValue{"mirrored image",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "b.png");
                 texture.wrap = Wrap::mirror, texture.mapping = thrice();
                 return s.add(texture, false);
               }},
    ColorValue{"black around",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "b.png");
                 texture.wrap = Wrap::black, texture.mapping = UvMapping{2, 0, -0.5f, 0, 2, -0.5f};
                 return s.add(texture, false);
               }},
    ColorValue{"by position",
               [](S& s) -> SpectrumParameter {
                 ImageTexture texture = image_of(s, "a.png");
                 texture.mapping = PlanarMapping{rotate(0.3, {0, 0, 1}), {0.5, 0, 0}, {0, 0.5, 0}, 0.1, 0.2};
                 return s.add(texture, false);
               }},
    ColorValue{"checkerboard",
               [](S& s) -> SpectrumParameter {
                 return s.add(CheckerboardTexture{rgb(0.8, 0.1, 0.1), rgb(0.1, 0.2, 0.7), thrice()}, false);
               }},
    ColorValue{"board of images",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> even = image(s, "a.png");
                 return s.add(CheckerboardTexture{even, rgb(0.1, 0.2, 0.7), thrice()}, false);
               }},
    ColorValue{"solid board",
               [](S& s) -> SpectrumParameter {
                 return s.add(CheckerboardTexture{rgb(0.8, 0.1, 0.1), rgb(0.1, 0.2, 0.7), UvMapping{}, true,
                                                  translate({0.25, 0.25, 0.25})},
                              false);
               }},
    ColorValue{"image × number",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> first = image(s, "a.png");
                 return s.add(ProductTexture{first, ConstantSpectrum{0.6f}}, false);
               }},
    ColorValue{"number × image",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> second = image(s, "a.png");
                 return s.add(ProductTexture{ConstantSpectrum{0.6f}, second}, false);
               }},
    ColorValue{"image × colour",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> first = image(s, "a.png");
                 return s.add(ProductTexture{first, rgb(0.9, 0.6, 0.2)}, false);
               }},
    ColorValue{"image × image",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> first = image(s, "a.png"), second = image(s, "b.png");
                 return s.add(ProductTexture{first, second}, false);
               }},
    ColorValue{"colour × colour",
               [](S& s) -> SpectrumParameter {
                 return s.add(ProductTexture{rgb(0.9, 0.6, 0.5), rgb(0.3, 0.9, 0.8)}, false);
               }},
    ColorValue{"mix",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> second = image(s, "a.png");
                 return s.add(MixTexture{rgb(0.9, 0.1, 0.1), second, s.number}, false);
               }},
    ColorValue{
        "bright mix",
        [](S& s) -> SpectrumParameter {
          return s.add(MixTexture{unbounded_from_rgb({1.5, 0.2, 0.1}), rgb(0.1, 0.2, 0.3), 0.7f}, false);
        }},
    ColorValue{"direction",
               [](S& s) -> SpectrumParameter {
                 return s.add(DirectionMixTexture{rgb(0.9, 0.1, 0.1), rgb(0.1, 0.2, 0.8), {0, 0, 1}}, false);
               }},
    ColorValue{"bilinear",
               [](S& s) -> SpectrumParameter {
                 return s.add(BilinearTexture{rgb(0.9, 0.1, 0.1), rgb(0.1, 0.8, 0.1), rgb(0.1, 0.1, 0.9),
                                              rgb(0.8, 0.8, 0.7), UvMapping{}},
                              false);
               }},
    ColorValue{"bilinear of images",
               [](S& s) -> SpectrumParameter {
                 const Id<Texture> corner = image(s, "a.png");
                 return s.add(
                     BilinearTexture{corner, rgb(0.1, 0.8, 0.1), rgb(0.1, 0.1, 0.9), corner, UvMapping{}},
                     false);
               }},
    ColorValue{"dots",
               [](S& s) -> SpectrumParameter {
                 return s.add(DotsTexture{rgb(0.9, 0.1, 0.1), rgb(0.1, 0.2, 0.8), thrice()}, false);
               }},
    ColorValue{"marble",
               [](S& s) -> SpectrumParameter {
                 return s.add(NoiseTexture{NoiseTexture::Kind::marble, {}}, false);
               }},
    ColorValue{"noise",
               [](S& s) -> SpectrumParameter {
                 return s.add(NoiseTexture{NoiseTexture::Kind::fbm, {}}, false);
               }},
    ColorValue{"wind",
               [](S& s) -> SpectrumParameter {
                 return s.add(NoiseTexture{NoiseTexture::Kind::windy, {}}, false);
               }},
    ColorValue{"attribute",
               [](S& s) -> SpectrumParameter {
                 return s.add(MeshAttributeTexture{"vertex_color", 0.8f}, false);
               }},
    ColorValue{"uv", [](S& s) -> SpectrumParameter { return s.add(UvTexture{UvMapping{}}, false); }},
};

constexpr std::array numbers{
    NumberValue{"0.3", [](S&) -> FloatParameter { return 0.3f; }},
    NumberValue{"grey image", [](S& s) -> FloatParameter { return s.add(image_of(s, "grey.exr"), true); }},
    NumberValue{"8-bit image", [](S& s) -> FloatParameter { return s.add(image_of(s, "grey.png"), true); }},
    NumberValue{"raw image",
                [](S& s) -> FloatParameter {
                  ImageTexture texture = image_of(s, "grey.png");
                  texture.encoding = Encoding::linear;
                  return s.add(texture, true);
                }},
    NumberValue{"colour image", [](S& s) -> FloatParameter { return s.add(image_of(s, "a.png"), true); }},
    NumberValue{
        "board",
        [](S& s) -> FloatParameter {
          return s.add(CheckerboardTexture{ConstantSpectrum{0.8f}, ConstantSpectrum{0.2f}, thrice()}, true);
        }},
    NumberValue{"image × number",
                [](S& s) -> FloatParameter {
                  const Id<Texture> first = s.add(image_of(s, "grey.exr"), true);
                  return s.add(ProductTexture{first, ConstantSpectrum{0.5f}}, true);
                }},
    NumberValue{"number × number",
                [](S& s) -> FloatParameter {
                  return s.add(ProductTexture{ConstantSpectrum{0.5f}, ConstantSpectrum{0.8f}}, true);
                }},
    NumberValue{"mix",
                [](S& s) -> FloatParameter {
                  const Id<Texture> amount = s.add(image_of(s, "grey.exr"), true);
                  return s.add(MixTexture{ConstantSpectrum{0.9f}, ConstantSpectrum{0.1f}, amount}, true);
                }},
    NumberValue{"bilinear",
                [](S& s) -> FloatParameter {
                  return s.add(BilinearTexture{ConstantSpectrum{0.1f}, ConstantSpectrum{0.4f},
                                               ConstantSpectrum{0.6f}, ConstantSpectrum{0.9f}, UvMapping{}},
                               true);
                }},
    NumberValue{"noise",
                [](S& s) -> FloatParameter {
                  return s.add(NoiseTexture{NoiseTexture::Kind::wrinkled, {}}, true);
                }},
    NumberValue{"wind",
                [](S& s) -> FloatParameter {
                  return s.add(NoiseTexture{NoiseTexture::Kind::windy, {}}, true);
                }},
    NumberValue{"marble",
                [](S& s) -> FloatParameter {
                  return s.add(NoiseTexture{NoiseTexture::Kind::marble, {}}, true);
                }},
};

}  // namespace

std::span<const ColorValue> color_values() { return colors; }
std::span<const NumberValue> number_values() { return numbers; }

}  // namespace vitrail::test
