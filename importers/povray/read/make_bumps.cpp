// SPDX-License-Identifier: Apache-2.0
// normal {}: patterns that tilt normals (scene/models/pattern_normal.h), as the displacement of materials.
// Several normals of a map or a list are several materials, blended by the pattern.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/image_values.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"
#include "scene/models/pattern_normal.h"

namespace vitrail::pov {

namespace {

constexpr int pieces = 16;  // straight ones, in place of each curved piece of a slope_map

// The cubic between two entries of a slope_map, by their heights and slopes (Hermite), t from 0 to 1. Slopes
// are those of t: POV-Ray shows [0 <0, 1>] [0.5 <1, 1>] as a straight line.
double height_between(const BlendEntry& a, const BlendEntry& b, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * a.color.v[0] + (t3 - 2 * t2 + t) * a.color.v[1] +
         (3 * t2 - 2 * t3) * b.color.v[0] + (t3 - t2) * b.color.v[1];
}

bool is_straight(const BlendEntry& a, const BlendEntry& b) {
  const double rise = b.color.v[0] - a.color.v[0];
  constexpr double tolerance = 1e-9;
  return std::abs(a.color.v[1] - rise) < tolerance && std::abs(b.color.v[1] - rise) < tolerance;
}

void add_stop(PatternTexture& t, double at, double value) {
  PatternStop stop;
  stop.at = static_cast<float>(std::clamp(at, 0.0, 1.0));
  stop.value = Spectrum{ConstantSpectrum{static_cast<float>(value)}};
  t.map.push_back(std::move(stop));
}

void add_slopes(PatternTexture& t, const BlendMap& map, double height) {
  const auto stop = [&](double at, double value) { add_stop(t, at, value * height); };
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    const BlendEntry& a = map.entries[i];
    stop(a.at, a.color.v[0]);
    if (i + 1 == map.entries.size()) break;
    const BlendEntry& b = map.entries[i + 1];
    if (!(b.at > a.at) || is_straight(a, b)) continue;
    for (int k = 1; k < pieces; ++k) {
      const double u = static_cast<double>(k) / pieces;
      stop(a.at + u * (b.at - a.at), height_between(a, b, u));
    }
  }
  std::ranges::stable_sort(t.map, {}, &PatternStop::at);
}

bool has_normals(const Bump& bump) {
  return bump.map && std::ranges::any_of(bump.map->entries, [](const BlendEntry& e) { return !!e.bump; });
}

}  // namespace

PatternTexture Surfaces::carrier_of(const SpectrumParameter& height, const Transform& to_world) const {
  PatternTexture t;
  t.kind = PatternTexture::Kind::planar;  // any: the map has one value
  t.texture_to_world = to_world;
  t.map.push_back({0, height});
  return t;
}

// povray tilts by the difference between pixels, however large they are: the step of our gradient is one.
std::optional<FloatParameter> Surfaces::bump_of_image(const Bump& bump, const Transform& to_world) {
  const ImageMap& image = *bump.pattern.image;
  if (image.map_type != 0 || bump.pattern.uv_mapping) {
    dropped("a bump_map that is not planar: the surface is smooth", bump.place);
    return std::nullopt;
  }
  if (image.filename.empty()) return std::nullopt;
  const ImageValues values(reader_, image, bump.place);
  const double steps = std::sqrt(static_cast<double>(values.width()) * values.height()) * bump_step;
  const double size = 1 / steps;
  const SpectrumParameter height =
      image_texture(image, bump.pattern, to_world, Part::grey, false, bump.size * bump_step, bump.place);
  return add(carrier_of(height, to_world * scale({size, size, size})), true, bump.place);
}

std::optional<FloatParameter> Surfaces::bump_of_pigment(const Bump& bump, const Transform& to_world,
                                                        double height) {
  const Pigment& pigment = *bump.pattern.pigment;
  if (pigment.pattern.uv_mapping) {
    dropped("a normal by a pigment in (u,v): the surface is smooth", bump.place);
    return std::nullopt;
  }
  note_modifiers(bump.pattern, bump.place);
  if (bump.map) approximated("a slope_map of a pigment_pattern: without it", bump.place);
  const SpectrumParameter grey =
      color_texture(pigment, to_world * pigment.to_object, Part::grey, height, false);
  if (!std::holds_alternative<Id<vitrail::Texture>>(grey)) return std::nullopt;  // even
  return add(carrier_of(grey, to_world), true, bump.place);
}

// What the map has at 1.
double Surfaces::height_of(const Bump& bump, const Transform& to_world) {
  const double height = bump.size * bump_height;
  if (bump.scaled) return height;
  // A height of the world, where ours is of the pattern's space.
  const double size = std::cbrt(std::abs(determinant3(to_world)));
  if (std::abs(length(transform_vector(to_world, {1, 0, 0})) - size) > 1e-6 * size ||
      std::abs(length(transform_vector(to_world, {0, 1, 0})) - size) > 1e-6 * size)
    approximated("no_bump_scale of a pattern that is not scaled evenly: by its mean scale", bump.place);
  return height / size;
}

std::optional<FloatParameter> Surfaces::bump_texture(const Bump& bump, const Transform& to_world) {
  if (bump.pattern.kind == Word::none || bump.size == 0 || !is_invertible(to_world)) return std::nullopt;
  if (bump.pattern.kind == Word::bump_map_ && bump.pattern.image) return bump_of_image(bump, to_world);
  if (bump.pattern.kind == Word::pigment_pattern_ && bump.pattern.pigment)
    return bump_of_pigment(bump, to_world, height_of(bump, to_world));
  if (bump.pattern.kind == Word::quilted_) return bump_of_quilts(bump, to_world);
  if (!pattern_record(bump.pattern)) {
    dropped(fmt::format("a normal of this pattern ({}): the surface is smooth", name_of(bump.pattern.kind)),
            bump.place);
    return std::nullopt;
  }
  auto made = pattern_texture(bump.pattern, to_world, false, bump.place);
  if (!made) return std::nullopt;
  const double height = height_of(bump, to_world);
  if (bump.map && bump.map->kind == Word::slope_map_ && !is_of_places(made->kind) &&
      !pushes_by_itself(made->kind)) {
    add_slopes(*made, *bump.map, height);
  } else if (const std::size_t places = places_of_list(bump.pattern.kind);
             places > 0 && made->kind == PatternTexture::Kind::formula) {
    const double second = beginning_of_place(1, places);
    add_stop(*made, 0, 0);
    add_stop(*made, second, 0);
    add_stop(*made, second, height);
  } else {
    add_stop(*made, 0, 0);
    add_stop(*made, is_of_places(made->kind) ? 0 : 1, height);
  }
  return add(std::move(*made), true, bump.place);
}

Id<Material> Surfaces::bumpy(const Body& body, const Bump* bump, const Transform& to_world) {
  if (!bump || !has_normals(*bump)) {
    displacement_ = bump ? bump_texture(*bump, to_world) : std::nullopt;
    const Id<Material> made = material_of(body);
    displacement_.reset();
    return made;
  }
  std::optional<Id<Material>> result;
  const BlendMap& map = *bump->map;
  const bool average = bump->pattern.kind == Word::average_;
  const bool list = !average && map.kind == Word::normal_map_ && map.entries.back().at >= 1 &&
                    places_of_list(bump->pattern.kind) > 0;
  double before = 0, weights = 0;
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    const BlendEntry& entry = map.entries[i];
    const Bump* const inner = entry.bump.get();
    const Id<Material> made = bumpy(body, inner, inner ? to_world * inner->to_object : to_world);
    weights += entry.at;
    if (result) {
      const FloatParameter amount =
          average ? FloatParameter{static_cast<float>(weights > 0 ? entry.at / weights : 0)}
                  : amount_texture(bump->pattern, to_world, false, before, entry.at, bump->place, list, i);
      result = add(BlendMaterial{*result, made, amount}, bump->place);
    } else {
      result = made;
    }
    before = entry.at;
  }
  if (!list) approximated("normals between two of a map: a mixture of both", bump->place);
  return *result;
}

}  // namespace vitrail::pov
