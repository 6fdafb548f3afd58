// SPDX-License-Identifier: Apache-2.0
// Pigments as textures.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "images/image_files.h"
#include "importers/povray/read/formula.h"
#include "importers/povray/read/image_values.h"
#include "importers/povray/read/pattern_field.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/pigment_patterns.h"
#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"
#include "scene/models/texture_mapping.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

namespace {

PatternStop number_stop(double at, float value) {
  PatternStop stop;
  stop.at = static_cast<float>(std::clamp(at, 0.0, 1.0));
  stop.value = Spectrum{ConstantSpectrum{value}};
  return stop;
}

// Of a list whose pattern is a formula: how many places its numbers have; else 0.
std::size_t places_of_formula(const PatternTexture& t, Word kind) {
  return t.kind == PatternTexture::Kind::formula ? places_of_list(kind) : 0;
}

// Steps in place of mixtures. The last value is that of all places after it.
void add_places(PatternTexture& t, const std::vector<SpectrumParameter>& values, std::size_t places) {
  for (std::size_t i = 0; i < places; ++i)
    for (const std::size_t end : {i, i + 1})
      t.map.push_back(
          {static_cast<float>(beginning_of_place(end, places)), values.at(std::min(i, values.size() - 1))});
}

// With an entry more wherever a colour between two of them falls below 0, as POV-Ray shows 0 from there on.
std::vector<BlendEntry> without_negative(const std::vector<BlendEntry>& entries) {
  std::vector<BlendEntry> all;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    all.push_back(entries[i]);
    if (i + 1 == entries.size() || entries[i].pigment || entries[i + 1].pigment) continue;
    const auto &a = entries[i].color.v, &b = entries[i + 1].color.v;
    std::array<double, 3> crossings{};  // shares of the way; 0: none
    for (std::size_t k = 0; k < 3; ++k)
      if ((a[k] < 0) != (b[k] < 0)) crossings[k] = a[k] / (a[k] - b[k]);
    std::ranges::sort(crossings);
    for (const double share : crossings) {
      if (!(share > 0 && share < 1)) continue;
      BlendEntry between = entries[i];
      between.at += share * (entries[i + 1].at - entries[i].at);
      for (std::size_t k = 0; k < between.color.v.size(); ++k) between.color.v[k] += share * (b[k] - a[k]);
      all.push_back(std::move(between));
    }
  }
  for (BlendEntry& entry : all)
    for (std::size_t k = 0; k < 3; ++k) entry.color.v[k] = std::max(entry.color.v[k], 0.0);
  return all;
}

double all_through(const Numbers& color) { return std::max(color.v[3], 0.0) + std::max(color.v[4], 0.0); }

// Adds entries between two that let light through: the tint of their mixtures is no mixture of their tints.
void add_mixtures(std::vector<BlendEntry>& all, const BlendEntry& from, const BlendEntry& to) {
  constexpr int pieces = 6;
  for (int i = 1; i < pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    BlendEntry between = from;
    between.at += share * (to.at - from.at);
    for (std::size_t k = 0; k < between.color.v.size(); ++k)
      between.color.v[k] += share * (to.color.v[k] - from.color.v[k]);
    all.push_back(std::move(between));
  }
}

// Returns the entries with a `filter` also for what lets nothing through: towards one that does, the tint of
// what shows through is a mixture of both colours, in the share that `filter` has there.
std::vector<BlendEntry> with_filters(const std::vector<BlendEntry>& entries) {
  std::vector<BlendEntry> all;
  const auto lets_through = [&](std::size_t i) {
    return i < entries.size() && !entries[i].pigment && all_through(entries[i].color) > 0;
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].pigment || all_through(entries[i].color) > 0) {
      all.push_back(entries[i]);
      if (lets_through(i) && lets_through(i + 1)) add_mixtures(all, entries[i], entries[i + 1]);
      continue;
    }
    for (const std::size_t other : {i - 1, i + 1}) {
      BlendEntry entry = entries[i];
      entry.color.v[3] = lets_through(other)
                             ? std::max(entries[other].color.v[3], 0.0) / all_through(entries[other].color)
                             : 0;
      entry.color.v[4] = 1 - entry.color.v[3];
      all.push_back(std::move(entry));
    }
  }
  return all;
}

// Beyond an image that is there once, and by the alpha of its file.
bool has_clear_parts(const ImageMap& image) {
  if (image.once) return true;
  std::error_code error;
  if (!std::filesystem::is_regular_file(image.filename, error)) return false;
  try {
    return read_image_layout(image.filename).channels % 2 == 0;
  } catch (const Error&) {
    return false;  // who reads it says so
  }
}

// The axis of images around things is y, of ours z.
Transform exchanged_y_z() {
  Transform t;
  t.m = {{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}};
  return t;
}

// What a pigment's transforms do to (u, v, 0).
UvMapping uv_mapping_of(Transform to_uv, const std::vector<Warp>& warps) {
  for (const Warp& warp : warps)
    if (warp.kind == Warp::Kind::transform) to_uv = to_uv * warp.transform;
  return is_invertible(to_uv) ? uv_mapping(to_uv) : UvMapping{};
}

}  // namespace

Id<vitrail::Texture> Surfaces::add(TextureModel model, bool is_float, const Place& place) {
  vitrail::Texture texture;
  texture.model = std::move(model);
  texture.is_float = is_float;
  texture.origin = origin(place);
  return append(scene_.textures, std::move(texture));
}

double Surfaces::share_through(const Numbers& color) const {
  double filter = std::max(color.v[3], 0.0);
  if (reader_.version < 3.7)
    filter *= std::clamp(reader_.linear(std::max({color.v[0], color.v[1], color.v[2]})), 0.0, 1.0);
  return std::min(filter + std::max(color.v[4], 0.0), 1.0);
}

Spectrum Surfaces::filtered(const Numbers& color) const {
  const double filter = std::max(color.v[3], 0.0), transmit = std::max(color.v[4], 0.0);
  const double all = std::max(share_through(color), 1e-6);
  const auto part = [&](std::size_t i) {
    return std::clamp((reader_.linear(color.v[i]) * filter + transmit) / all, 0.0, 1.0);
  };
  return unbounded_from_rgb({part(0), part(1), part(2)});
}

SpectrumParameter Surfaces::tinted(const SpectrumParameter& value, const Look& look, const Place& place) {
  return look.tint ? add(ProductTexture{value, *look.tint}, false, place) : value;
}

float Surfaces::opacity_of(const Numbers& color) const {
  return static_cast<float>(std::clamp(1 - share_through(color), 0.0, 1.0));
}

Spectrum Surfaces::spectrum_of(const Numbers& color, Part part, double factor) const {
  if (part == Part::opacity) return ConstantSpectrum{opacity_of(color)};
  if (part == Part::filtered) return filtered(color);
  if (part == Part::grey) return ConstantSpectrum{static_cast<float>(grey_of(color) * factor)};
  const RGB c{reader_.linear(color.v[0]) * factor, reader_.linear(color.v[1]) * factor,
              reader_.linear(color.v[2]) * factor};
  if (part == Part::radiance) return emission_from_rgb(c);
  return part == Part::factor ? unbounded_from_rgb(c) : Spectrum{reflectance_from_rgb(c)};
}

FloatParameter Surfaces::opacity_of(const Pigment& pigment, const Transform& to_world, bool by_uv) {
  if (pigment.color) return opacity_of(*pigment.color);
  if (const auto& image = pigment.pattern.image) {
    const double opaque = std::clamp(1 - image->filter_all - image->transmit_all, 0.0, 1.0);
    const bool has_parts = pigment.pattern.kind == Word::image_map_ && opaque > 0 && has_clear_parts(*image);
    if (!has_parts) return static_cast<float>(opaque);
    const SpectrumParameter texture = color_texture(pigment, to_world, Part::opacity, opaque, by_uv);
    const auto* const id = std::get_if<Id<vitrail::Texture>>(&texture);
    return id ? FloatParameter{*id} : FloatParameter{static_cast<float>(opaque)};
  }
  if (!pigment.map) return 1.0f;
  float least = 1, most = 0;
  for (const BlendEntry& entry : pigment.map->entries) {
    const float opacity = entry.pigment ? opacity_of(mean_color(*entry.pigment)) : opacity_of(entry.color);
    least = std::min(least, opacity), most = std::max(most, opacity);
  }
  if (least >= most) return pigment.map->entries.empty() ? 1.0f : least;
  const SpectrumParameter texture = color_texture(pigment, to_world, Part::opacity, 1, by_uv);
  if (const auto* id = std::get_if<Id<vitrail::Texture>>(&texture)) return *id;
  return opacity_of(mean_color(pigment));
}

SpectrumParameter Surfaces::radiance_of(const Pigment& pigment, const Transform& to_world) {
  return color_texture(pigment, to_world * pigment.to_object, Part::radiance, 1, false);
}

SpectrumParameter Surfaces::radiance_of(const std::vector<Shared<Pigment>>& pigments,
                                        const Transform& to_world) {
  SpectrumParameter radiance = radiance_of(*pigments.front(), to_world);
  for (std::size_t i = 1; i < pigments.size(); ++i) {
    const Pigment& above = *pigments[i];
    const FloatParameter opacity = opacity_of(above, to_world * above.to_object, false);
    radiance = add(MixTexture{radiance, radiance_of(above, to_world), opacity}, false, above.place);
  }
  return radiance;
}

Numbers mean_color(const Pigment& pigment) {
  if (pigment.color) return *pigment.color;
  if (!pigment.map || pigment.map->entries.empty()) return Finish::grey(0.5);
  const auto& entries = pigment.map->entries;
  const auto color = [](const BlendEntry& e) { return e.pigment ? mean_color(*e.pigment) : e.color; };
  Numbers sum = Finish::grey(0);
  double weights = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double before = i ? entries[i - 1].at : std::min(entries[i].at, 0.0);
    const double after = i + 1 < entries.size() ? entries[i + 1].at : std::max(entries[i].at, 1.0);
    const double weight =
        std::max(pigment.pattern.kind == Word::average_ ? entries[i].at : (after - before) / 2, 1e-6);
    const Numbers c = color(entries[i]);
    for (std::size_t k = 0; k < 5; ++k) sum.v[k] += weight * c.v[k];
    weights += weight;
  }
  for (double& v : sum.v) v /= weights;
  return sum;
}

SpectrumParameter Surfaces::color_texture(const Pigment& pigment, const Transform& around, Part part,
                                          double factor, bool around_by_uv) {
  const bool own_uv = pigment.pattern.uv_mapping, by_uv = (around_by_uv || own_uv) && !uvs_are_places_;
  const Transform to_world = own_uv ? uv_space_ * pigment.to_object : around;
  if (pigment.color || pigment.pattern.kind == Word::none)
    return spectrum_of(mean_color(pigment), part, factor);
  const Pattern& pattern = pigment.pattern;
  if (pattern.image && pattern.kind == Word::image_map_)
    return image_texture(*pattern.image, pattern, to_world, part, by_uv, factor, pigment.place);
  if (pattern.kind == Word::average_ && pigment.map)
    return average_texture(pigment, to_world, part, factor, by_uv);
  if (const auto both =
          as_pattern_of_pigment(pattern, pigment.map ? pigment.map->entries : default_entries(pattern))) {
    note_modifiers(pattern, pigment.place);
    return color_texture(*both, to_world * both->to_object, part, factor, by_uv);
  }
  auto made = pattern_texture(pattern, to_world, by_uv, pigment.place);
  if (!made && pattern.kind == Word::function_)
    return spectrum_of(PatternField(reader_, pigment).mean(), part, factor);
  if (!made) return spectrum_of(pigment.quick_color.value_or(mean_color(pigment)), part, factor);
  std::vector<BlendEntry> entries = pigment.map ? pigment.map->entries : default_entries(pattern);
  if (const std::size_t places = places_of_formula(*made, pattern.kind)) {
    std::vector<SpectrumParameter> values;
    for (const BlendEntry& entry : entries)
      values.push_back(entry_texture(entry, to_world, part, factor, by_uv));
    add_places(*made, values, places);
    return add(std::move(*made), is_number(part), pigment.place);
  }
  if (!is_of_places(made->kind)) entries = without_negative(entries);
  if (part == Part::filtered && !is_of_places(made->kind)) entries = with_filters(entries);
  for (const BlendEntry& entry : entries) {
    PatternStop stop;
    stop.at = static_cast<float>(std::clamp(entry.at, 0.0, 1.0));
    if (is_of_places(made->kind)) stop.at = 0;
    if (!made->map.empty() && !is_of_places(made->kind)) stop.at = std::max(stop.at, made->map.back().at);
    stop.value = entry_texture(entry, to_world, part, factor, by_uv);
    made->map.push_back(std::move(stop));
  }
  return add(std::move(*made), is_number(part), pigment.place);
}

SpectrumParameter Surfaces::entry_texture(const BlendEntry& entry, const Transform& to_world, Part part,
                                          double factor, bool by_uv) {
  if (!entry.pigment) return spectrum_of(entry.color, part, factor);
  return color_texture(*entry.pigment, to_world * entry.pigment->to_object, part, factor, by_uv);
}

// The mean of all entries, by the weights that stand in their places.
SpectrumParameter Surfaces::average_texture(const Pigment& pigment, const Transform& to_world, Part part,
                                            double factor, bool by_uv) {
  std::optional<SpectrumParameter> mean;
  double weights = 0;
  for (const BlendEntry& entry : pigment.map->entries) {
    if (!(entry.at > 0)) continue;
    weights += entry.at;
    const SpectrumParameter value = entry_texture(entry, to_world, part, factor, by_uv);
    const auto amount = static_cast<float>(entry.at / weights);
    mean = mean ? add(MixTexture{*mean, value, amount}, is_number(part), pigment.place) : value;
  }
  return mean.value_or(spectrum_of(mean_color(pigment), part, factor));
}

SpectrumParameter Surfaces::grain(double amount, const Place& place) {
  constexpr double size = 1e-4;  // of a grain
  PatternTexture grains;
  grains.kind = PatternTexture::Kind::cells;
  grains.texture_to_world = scale({size, size, size});
  grains.map = {number_stop(0, static_cast<float>(1 + amount)),
                number_stop(1, static_cast<float>(1 - amount))};
  return add(std::move(grains), false, place);
}

void Surfaces::note_modifiers(const Pattern& pattern, const Place& place) {
  const bool changed = pattern.frequency != 1 || pattern.phase != 0 || pattern.turbulence != Vector3d{} ||
                       (pattern.wave != Word::none && pattern.wave != Word::ramp_wave_);
  if (changed)
    approximated("waves and turbulence of a pattern that asks a pigment: those of the pigment alone", place);
}

FloatParameter Surfaces::amount_texture(const Pattern& pattern, const Transform& to_world, bool by_uv,
                                        double from, double to, const Place& place, bool list,
                                        std::size_t index) {
  BlendEntry first, second;
  first.at = from, first.color = Finish::grey(0);
  second.at = to, second.color = Finish::grey(1);
  if (const auto both = as_pattern_of_pigment(pattern, {first, second})) {
    note_modifiers(pattern, place);
    const SpectrumParameter amount = color_texture(*both, to_world * both->to_object, Part::grey, 1, by_uv);
    if (const auto* id = std::get_if<Id<vitrail::Texture>>(&amount)) return *id;
    return static_cast<float>(grey_of(mean_color(*both)));
  }
  if (pattern.kind == Word::image_pattern_ && pattern.image && from == 0 && to == 1) {
    const SpectrumParameter amount =
        image_texture(*pattern.image, pattern, to_world, Part::grey, by_uv, 1, place);
    if (const auto* id = std::get_if<Id<vitrail::Texture>>(&amount)) return *id;
  }
  auto made = pattern_texture(pattern, to_world, by_uv, place);
  if (!made) return 0.5f;
  const auto stop = [&](double at, float value) { made->map.push_back(number_stop(at, value)); };
  if (const std::size_t places = list ? places_of_formula(*made, pattern.kind) : 0) {
    std::vector<SpectrumParameter> values(places, Spectrum{ConstantSpectrum{0}});
    values[std::min(index, places - 1)] = Spectrum{ConstantSpectrum{1}};
    add_places(*made, values, places);
  } else if (list) {
    for (std::size_t i = 0; i <= std::max<std::size_t>(index, 1); ++i) stop(0, i == index ? 1.0f : 0.0f);
    if (made->kind == PatternTexture::Kind::hexagon && index < 2) stop(0, 0);
  } else {
    stop(from, 0);
    stop(to, 1);
  }
  return add(std::move(*made), true, place);
}

std::optional<PatternTexture> Surfaces::pattern_texture(const Pattern& pattern, const Transform& to_world,
                                                        bool by_uv, const Place& place) {
  std::optional<PatternTexture> made = pattern_record(pattern);
  if (!made) {
    dropped(fmt::format("this pattern ({}): the mean of its colours", name_of(pattern.kind)), place);
    return std::nullopt;
  }
  PatternTexture& t = *made;
  t.texture_to_world = to_world;
  t.by_uv = by_uv && !uvs_are_places_;
  for (const Warp& warp : pattern.warps) {
    if (warp.kind == Warp::Kind::transform) {
      t.texture_to_world = t.texture_to_world * warp.transform;
    } else if (warp.kind == Warp::Kind::turbulence) {
      const bool has_own = t.turbulence.amount != Vector3d{};
      if (has_own || is_turbulent_by_itself(t.kind)) t = carried(std::move(t));
      t.turbulence = {warp.amount, std::clamp(warp.octaves, 1, 10), static_cast<float>(warp.lambda),
                      static_cast<float>(warp.omega)};
    } else if (warp.kind == Warp::Kind::repeat && t.repeat == Vector3d{0, 0, 0}) {
      t.repeat = warp.amount;
      if (warp.flip != Vector3d{} || warp.offset != Vector3d{})
        approximated("flip and offset of a repetition: without them", place);
    } else {
      dropped("a warp of this kind", place);
    }
  }
  if (!is_invertible(t.texture_to_world)) return std::nullopt;
  return made;
}

// What takes the numbers of a file to those of the scene: as povray 3.7.0.10 shows them. Where numbers stay
// (keeps_numbers), there is nothing to do. Else they are light, by a gamma that stands with the image or by
// sRGB's curve; a scene that has no gamma takes light for its own numbers.
void Surfaces::set_encoding(ImageTexture& texture, const ImageMap& image) const {
  constexpr double srgb = 2.2;  // about
  const std::optional<double> scene = reader_.gamma();
  const bool for_export = reader_.for_export;
  const double screen = scene.value_or(srgb);
  double gamma = image.gamma.value_or(srgb);
  bool by_curve = false;
  if (keeps_numbers(reader_, image)) {
    gamma = for_export ? screen : 1;
    by_curve = for_export && !scene;
  } else if (reader_.has_no_gamma()) {
    if (for_export) gamma *= screen;
  } else {
    if (!for_export) gamma /= screen;
    by_curve = !image.gamma && (for_export || scene == 1.0);
  }
  if (by_curve) return;
  texture.gamma = static_cast<float>(gamma);
  texture.encoding = texture.gamma == 1 ? Encoding::linear : Encoding::gamma;
}

SpectrumParameter Surfaces::image_texture(const ImageMap& image, const Pattern& pattern,
                                          const Transform& to_world, Part part, bool by_uv, double factor,
                                          const Place& place) {
  if (image.filename.empty()) return Spectrum{ConstantSpectrum{static_cast<float>(0.5 * factor)}};
  ImageTexture texture;
  texture.filename = std::filesystem::absolute(image.filename).string();
  texture.wrap = image.once ? Wrap::black : Wrap::repeat;
  texture.filter = image.interpolate > 0 ? TextureFilter::bilinear : TextureFilter::nearest;
  texture.scale = static_cast<float>(factor);
  if (is_number(part)) texture.number = part == Part::opacity ? ImageNumber::alpha : ImageNumber::luminance;
  if (is_number(part) && !image.gamma && !image.gamma_srgb)
    texture.encoding = Encoding::linear;  // the numbers of the file
  else
    set_encoding(texture, image);
  if (by_uv) {
    texture.mapping = uv_mapping_of(to_world, pattern.warps);
  } else if (image.map_type == 0) {
    PlanarMapping planar{to_world};
    for (const Warp& warp : pattern.warps)
      if (warp.kind == Warp::Kind::transform)
        planar.texture_to_world = planar.texture_to_world * warp.transform;
      else
        dropped("a warp of an image", place);
    texture.mapping = planar;
  } else if (image.map_type <= 2 && !reader_.for_export) {
    Transform around = to_world;
    for (const Warp& warp : pattern.warps)
      if (warp.kind == Warp::Kind::transform)
        around = around * warp.transform;
      else
        dropped("a warp of an image", place);
    around = around * exchanged_y_z();
    if (image.map_type == 1)
      texture.mapping = GlobeMapping{around};
    else
      texture.mapping = CylindricalMapping{around * scale({-1, -1, 1})};  // ours begins at −x
  } else {
    approximated("an image around a sphere, cylinder or torus: by (u,v) of the surface", place);
    texture.mapping = UvMapping{-1, 0, 1, 0, 1, 0};  // of a sphere u runs the other way
  }
  return add(std::move(texture), is_number(part), place);
}

}  // namespace vitrail::pov
