// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/conformance/gate/scene_parts.h"

namespace vitrail::test {

namespace {

using S = SceneParts;
using M = MaterialModel;

Roughness rough(float alpha) { return {alpha, alpha}; }
const Spectrum one = ConstantSpectrum{1};

const std::array materials{
    MaterialValue{"diffuse", [](const S& s) -> M { return DiffuseMaterial{s.color}; }},
    MaterialValue{"rough diffuse",
                  [](const S& s) -> M {
                    return DiffuseMaterial{s.color, 25.0f};
                  }},
    MaterialValue{"glass", [](const S&) -> M { return DielectricMaterial{}; }},
    MaterialValue{"BK7 in water",
                  [](const S&) -> M {
                    return DielectricMaterial{NamedSpectrum{"glass-BK7"}, ConstantSpectrum{1.33f}};
                  }},
    MaterialValue{"tinted glass",
                  [](const S& s) -> M {
                    DielectricMaterial glass;
                    glass.transmittance_factor = s.color;
                    return glass;
                  }},
    MaterialValue{"rough glass", [](const S&) -> M { return DielectricMaterial{.roughness = rough(0.3f)}; }},
    MaterialValue{"thin glass", [](const S&) -> M { return ThinDielectricMaterial{}; }},
    MaterialValue{"tinted thin glass",
                  [](const S& s) -> M {
                    ThinDielectricMaterial glass;
                    glass.transmittance_factor = s.color;
                    return glass;
                  }},
    MaterialValue{"copper", [](const S&) -> M { return ConductorMaterial{}; }},
    MaterialValue{"rough gold",
                  [](const S& s) -> M {
                    return ConductorMaterial{
                        ComplexIndex{NamedSpectrum{"metal-Au-eta"}, NamedSpectrum{"metal-Au-k"}},
                        {s.number, s.number}};
                  }},
    MaterialValue{"brushed metal",
                  [](const S& s) -> M {
                    return ConductorMaterial{NormalReflectance{s.color},
                                             {0.15f, 0.4f, Roughness::Distribution::beckmann}};
                  }},
    MaterialValue{"mirror",
                  [](const S& s) -> M {
                    return ConductorMaterial{PerfectReflector{}, {}, s.color};
                  }},
    MaterialValue{"plastic", [](const S& s) -> M { return PlasticMaterial{s.color}; }},
    MaterialValue{"rough plastic",
                  [](const S& s) -> M {
                    PlasticMaterial plastic{s.color};
                    plastic.roughness = rough(0.2f);
                    plastic.nonlinear = true;
                    return plastic;
                  }},
    MaterialValue{"coated diffuse",
                  [](const S& s) -> M {
                    return CoatedDiffuseMaterial{s.color, ConstantSpectrum{1.5f}, rough(0.3f)};
                  }},
    MaterialValue{"coated conductor",
                  [](const S&) -> M {
                    return CoatedConductorMaterial{ComplexIndex{}, rough(0.3f)};
                  }},
    MaterialValue{"coated mirror",
                  [](const S& s) -> M {
                    return CoatedConductorMaterial{NormalReflectance{s.color}, {s.number, s.number}};
                  }},
    MaterialValue{
        "leaf",
        [](const S& s) -> M {
          return DiffuseTransmissionMaterial{s.color, Spectrum{reflectance_from_rgb({0.2, 0.3, 0.1})}, 0.9f};
        }},
    MaterialValue{"principled",
                  [](const S& s) -> M {
                    PrincipledMaterial m{.base_color = s.color, .roughness = s.number};
                    m.clearcoat = 0.5f, m.sheen = 0.3f;
                    return m;
                  }},
    MaterialValue{"tinted principled",
                  [](const S& s) -> M {
                    return PrincipledMaterial{.base_color = s.color, .roughness = 0.4f, .spec_tint = 0.4f};
                  }},
    MaterialValue{"principled metal",
                  [](const S& s) -> M {
                    return PrincipledMaterial{
                        .base_color = s.color, .roughness = 0.4f, .anisotropic = 0.5f, .metallic = 0.9f};
                  }},
    MaterialValue{"principled glass",
                  [](const S& s) -> M {
                    return PrincipledMaterial{.base_color = s.color, .roughness = 0.4f, .spec_trans = 0.8f};
                  }},
    MaterialValue{
        "thin principled",
        [](const S& s) -> M {
          return PrincipledMaterial{
              .base_color = s.color, .roughness = 0.4f, .flatness = 0.2f, .diff_trans = 0.6f, .thin = true};
        }},
    MaterialValue{"thin principled glass",
                  [](const S& s) -> M {
                    return PrincipledMaterial{
                        .base_color = s.color, .roughness = s.number, .spec_trans = 0.9f, .thin = true};
                  }},
    MaterialValue{
        "wax",
        [](const S&) -> M {
          SubsurfaceMaterial m{SubsurfaceMaterial::Coefficients{one, unbounded_from_rgb({3, 2, 1})}};
          m.eta = NamedSpectrum{"glass-BK7"};
          return m;
        }},
    MaterialValue{"skin",
                  [](const S&) -> M {
                    return SubsurfaceMaterial{SubsurfaceMaterial::Named{"Skin1"}, 10};
                  }},
    MaterialValue{"marble block",
                  [](const S& s) -> M {
                    return SubsurfaceMaterial{SubsurfaceMaterial::Effective{s.color, one}};
                  }},
    MaterialValue{"hair",
                  [](const S&) -> M {
                    HairMaterial hair;
                    hair.eumelanin = 0.3f;
                    return hair;
                  }},
    MaterialValue{"coloured hair",
                  [](const S& s) -> M {
                    HairMaterial hair;
                    hair.color = s.color;
                    return hair;
                  }},
    MaterialValue{"nothing", [](const S&) -> M { return InterfaceMaterial{}; }},
};

Material other() { return {DiffuseMaterial{Spectrum{reflectance_from_rgb({0.1, 0.6, 0.3})}}}; }
FloatParameter wave(S& s) {
  ImageTexture image;
  image.filename = s.image("grey.exr");
  const Id<Texture> height = s.add(image, true);
  return s.add(ProductTexture{height, ConstantSpectrum{0.4f}}, true);
}
Id<Texture> normals(S& s) {
  ImageTexture image;
  image.filename = s.image("normal.png");
  image.encoding = Encoding::linear;
  return s.add(image, false);
}
FloatParameter height_image(S& s) {
  ImageTexture image;
  image.filename = s.image("grey.exr");
  return s.add(image, true);
}
Id<Material> blend(S& s, Material a, Material b) {
  const Id<Material> first = s.add(std::move(a)), second = s.add(std::move(b));
  return s.add({BlendMaterial{first, second, 0.5f}});
}

constexpr std::array wrappers{
    WrapperValue{"alone", [](S& s, Material m) { return s.add(std::move(m)); }},
    WrapperValue{"one side",
                 [](S& s, Material m) {
                   m.two_sided = false;
                   return s.add(std::move(m));
                 }},
    WrapperValue{"mask",
                 [](S& s, Material m) {
                   const Id<Material> inner = s.add(std::move(m));
                   return s.add({MaskMaterial{s.number, inner}});
                 }},
    WrapperValue{
        "mask of a mask",
        [](S& s, Material m) {
          const Id<Material> inner = s.add(std::move(m)), middle = s.add({MaskMaterial{0.7f, inner}});
          return s.add({MaskMaterial{s.number, middle}});
        }},
    WrapperValue{"blend",
                 [](S& s, Material m) {
                   const Id<Material> first = s.add(std::move(m)), second = s.add(other());
                   return s.add({BlendMaterial{first, second, s.number}});
                 }},
    WrapperValue{"blend with nothing",
                 [](S& s, Material m) {
                   const Id<Material> first = s.add(std::move(m)), second = s.add({InterfaceMaterial{}});
                   return s.add({BlendMaterial{first, second, 0.4f}});
                 }},
    WrapperValue{"blend of a mask",
                 [](S& s, Material m) {
                   const Id<Material> inner = s.add(std::move(m)),
                                      first = s.add({MaskMaterial{s.number, inner}}), second = s.add(other());
                   return s.add({BlendMaterial{first, second, 0.3f}});
                 }},
    WrapperValue{"blend of blends",
                 [](S& s, Material m) {
                   const Id<Material> inner = s.add(std::move(m)), second = s.add(other()),
                                      both = s.add({BlendMaterial{inner, second, 0.3f}});
                   return s.add({BlendMaterial{second, both, s.number}});
                 }},
    WrapperValue{"two sides",
                 [](S& s, Material m) {
                   const Id<Material> back = s.add(other()), front = s.add(std::move(m));
                   return s.add({TwoSidedMaterial{front, back}});
                 }},
    WrapperValue{"bump",
                 [](S& s, Material m) {
                   m.displacement = wave(s);
                   return s.add(std::move(m));
                 }},
    WrapperValue{"normal map",
                 [](S& s, Material m) {
                   m.normal_map = normals(s);
                   return s.add(std::move(m));
                 }},
    WrapperValue{"shadowed normal map",
                 [](S& s, Material m) {
                   m.normal_map = normals(s);
                   m.bump_shadowing = true;
                   return s.add(std::move(m));
                 }},
    WrapperValue{"blend of bumps",
                 [](S& s, Material m) {
                   Material second = other();
                   m.displacement = second.displacement = height_image(s);
                   return blend(s, std::move(m), std::move(second));
                 }},
    WrapperValue{"mask of a bump",
                 [](S& s, Material m) {
                   m.displacement = height_image(s);
                   const Id<Material> inner = s.add(std::move(m));
                   return s.add({MaskMaterial{0.6f, inner}});
                 }},
    WrapperValue{"blend of normal maps",
                 [](S& s, Material m) {
                   Material second = other();
                   m.normal_map = second.normal_map = normals(s);
                   return blend(s, std::move(m), std::move(second));
                 }},
};

}  // namespace

std::span<const MaterialValue> material_values() { return materials; }
std::span<const WrapperValue> wrapper_values() { return wrappers; }

}  // namespace vitrail::test
