// SPDX-License-Identifier: Apache-2.0
// normal { quilted }: the Scene has no such pattern. In each unit cube povray pushes normals away from its
// middle, by amount·g(r) at the distance r from it, with g = g₀ + control0·g₁ + control1·g₂. The height whose
// slope that is is here a polynomial of u = r²/¾, and u the mean of the squares of three patterns.
#include <array>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"
#include "scene/models/pattern_normal.h"

namespace vitrail::pov {

namespace {

// Of r, r³, r⁵, fitted to what povray 3.7 shows for r up to √¾: within 0.03, where g reaches 0.9.
constexpr std::array<double, 3> without_control{-0.0188, 0.4676, 0.7665}, by_control0{0.5567, -0.431, -0.476},
    by_control1{0.0564, 2.0611, -2.2984};

SpectrumParameter constant(double value) { return Spectrum{ConstantSpectrum{static_cast<float>(value)}}; }

}  // namespace

// |2t − 1| along an axis, with t what is beyond whole numbers.
std::optional<SpectrumParameter> Surfaces::distance_from_middles(const Pattern& quilted, Vector3d axis,
                                                                 const Transform& to_world,
                                                                 const Place& place) {
  Pattern along = quilted;
  along.kind = Word::gradient_, along.direction = axis, along.wave = Word::triangle_wave_;
  auto made = pattern_texture(along, to_world, false, place);
  if (!made) return std::nullopt;
  made->map.resize(2);
  made->map[0].value = constant(1);
  made->map[1].at = 1, made->map[1].value = constant(0);
  return add(std::move(*made), true, place);
}

std::optional<FloatParameter> Surfaces::bump_of_quilts(const Bump& bump, const Transform& to_world) {
  const auto mix = [&](const SpectrumParameter& first, const SpectrumParameter& second,
                       const FloatParameter& amount) {
    return add(MixTexture{first, second, amount}, true, bump.place);
  };
  // A floor lies between two cubes: povray takes the upper one, and so do all points of the gradient.
  const double above = 1.05 * bump_step;
  const Transform shifted = to_world * translate({-above, -above, -above});
  std::optional<SpectrumParameter> squares;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vector3d direction;
    (axis == 0 ? direction.x : axis == 1 ? direction.y : direction.z) = 1;
    const auto distance = distance_from_middles(bump.pattern, direction, shifted, bump.place);
    if (!distance) return std::nullopt;
    const SpectrumParameter square = add(ProductTexture{*distance, *distance}, true, bump.place);
    squares = squares ? mix(*squares, square, 1 / static_cast<float>(axis + 1)) : square;
  }
  const Id<vitrail::Texture> u = std::get<Id<vitrail::Texture>>(*squares);
  // −g/2r is the slope of the height by s = r² = ¾u: its terms in u, u², u³.
  std::array<double, 3> c;
  double power = 0.75;
  for (std::size_t i = 0; i < 3; ++i, power *= 0.75)
    c[i] = -height_of(bump, to_world) / bump_height * power / (2 * (static_cast<double>(i) + 1)) *
           (without_control[i] + bump.pattern.control0 * by_control0[i] +
            bump.pattern.control1 * by_control1[i]);
  const SpectrumParameter last = mix(constant(c[0] + c[1]), constant(c[0] + c[1] + c[2]), u);
  const SpectrumParameter slope = mix(constant(c[0]), last, u);
  return add(carrier_of(mix(constant(0), slope, u), to_world), true, bump.place);
}

}  // namespace vitrail::pov
