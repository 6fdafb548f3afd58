// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/write/write_patterns.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "images/texture_values.h"
#include "importers/povray/write/write_pigments.h"
#include "scene/models/pattern_normal.h"

namespace vitrail::povray {

namespace {

using Kind = PatternTexture::Kind;
using Wave = PatternTexture::Wave;

std::string triple(Vector3d v) { return fmt::format("<{},{},{}>", v.x, v.y, v.z); }

const char* name_of(Kind kind) {
  constexpr std::array names{
      "checker", "hexagon", "brick",   "gradient", "boxed",   "cylindrical", "planar", "spherical", "cells",
      "leopard", "marble",  "onion",   "radial",   "spiral1", "wood",        "agate",  "bozo",      "bumps",
      "crackle", "dents",   "granite", "ripples",  "waves",   "wrinkles",    "mandel"};
  static_assert(names.size() == static_cast<std::size_t>(Kind::formula));
  return names.at(static_cast<std::size_t>(kind));
}

std::string kind_text(const PatternTexture& t) {
  std::string text = name_of(t.kind);
  if (t.kind == Kind::gradient) text += " " + triple(t.direction);
  if (t.kind == Kind::spiral1) text += fmt::format(" {}", t.arms);
  if (t.kind == Kind::mandel) text += fmt::format(" {}", t.iterations);
  if (t.kind == Kind::agate) text += fmt::format(" agate_turb {}", t.agate_turb);
  if (t.kind == Kind::crackle)
    text += fmt::format(" form {} metric {} offset {}{}", triple(t.crackle.form), t.crackle.metric,
                        t.crackle.offset, t.crackle.solid ? " solid" : "");
  if (t.noise == NoiseGenerator::original && !is_of_places(t.kind)) text += " noise_generator 1";
  return text;
}

std::string wave_text(const PatternTexture& t) {
  constexpr std::array waves{"ramp", "triangle", "sine", "scallop", "cubic", "poly"};
  std::string text = fmt::format(" {}_wave", waves.at(static_cast<std::size_t>(t.wave)));
  if (t.wave == Wave::poly) text += fmt::format(" {}", t.exponent);
  if (t.frequency != 1) text += fmt::format(" frequency {}", t.frequency);
  if (t.phase != 0) text += fmt::format(" phase {}", t.phase);
  return text;
}

// A warp is an axis, and the way along it.
std::string tiles(Vector3d size) {
  std::string text;
  if (size.x > 0) text += fmt::format(" warp {{ repeat x*{} }}", size.x);
  if (size.y > 0) text += fmt::format(" warp {{ repeat y*{} }}", size.y);
  if (size.z > 0) text += fmt::format(" warp {{ repeat z*{} }}", size.z);
  return text;
}

std::string turbulence_text(const PatternTexture& t) {
  const PatternTurbulence& u = t.turbulence;
  if (u.amount == Vector3d{} && t.kind != Kind::agate) return "";
  return fmt::format(" turbulence {} octaves {} lambda {} omega {}", triple(u.amount), u.octaves, u.lambda,
                     u.omega);
}

// How far a normal map tilts, where its image can be read.
std::string mean_tilt(const TextureModel& model) {
  const auto* texture = std::get_if<ImageTexture>(&model);
  if (!texture) return "";
  try {
    const Image image = texture_values(*texture, read_stored_image(texture->filename), ImageUse::vector);
    if (image.channels < 3) return "";
    double sum = 0, count = 0;
    for (std::size_t i = 0; i + 2 < image.values.size();
         i += static_cast<std::size_t>(image.channels), ++count) {
      const auto part = [&](std::size_t c) { return 2 * static_cast<double>(image.values[i + c]) - 1; };
      sum += std::atan2(std::hypot(part(0), part(1)), part(2));
    }
    return fmt::format("; it tilts them by {:.2g} degrees in the mean", sum / count * 180 / std::numbers::pi);
  } catch (const Error&) {  // which the texture says
    return "";
  }
}

}  // namespace

std::string pattern_text(const PatternTexture& t, const std::vector<std::string>& values) {
  std::string text = kind_text(t);
  if (is_of_places(t.kind)) {
    for (const std::string& value : values) text += fmt::format(" pigment {{ {} }}", value);
    if (t.kind == Kind::brick)
      text += fmt::format(" brick_size {} mortar {}", triple(t.brick.size), t.brick.mortar);
    return text + turbulence_text(t) + tiles(t.repeat);
  }
  text += wave_text(t) + turbulence_text(t) + " pigment_map {";
  for (std::size_t i = 0; i < values.size(); ++i) text += fmt::format(" [{} {}]", t.map[i].at, values[i]);
  if (values.empty()) text += " [0 rgb 0] [1 rgb 1]";
  return text + " }" + tiles(t.repeat);
}

std::optional<std::string> normal_text(const PatternTexture& t) {
  if (t.kind == Kind::formula) return std::nullopt;
  std::vector<double> heights;  // of an amount of 1
  for (const PatternStop& stop : t.map) {
    const auto* constant = std::get_if<Spectrum>(&stop.value);
    if (!constant) return std::nullopt;
    heights.push_back(evaluate(*constant, lambda_min_nm) / bump_height);
  }
  if (heights.empty()) return std::nullopt;
  std::string text = kind_text(t) + turbulence_text(t);
  if (is_of_places(t.kind)) {
    if (t.kind == Kind::brick)
      text += fmt::format(" brick_size {} mortar {}", triple(t.brick.size), t.brick.mortar);
    text += fmt::format(" bump_size {}", heights.back());
  } else if (pushes_by_itself(t.kind)) {
    text += fmt::format(" frequency {} phase {} bump_size {}", t.frequency, t.phase, heights.back());
  } else {
    text += wave_text(t) + " bump_size 1 slope_map {";
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double before = i > 0 ? heights[i] - heights[i - 1] : 0,
                   after = i + 1 < heights.size() ? heights[i + 1] - heights[i] : 0;
      if (i > 0) text += fmt::format(" [{} <{},{}>]", t.map[i].at, heights[i], before);
      if (i + 1 < heights.size() || i == 0)
        text += fmt::format(" [{} <{},{}>]", t.map[i].at, heights[i], after);
    }
    text += " }";
  }
  return text + tiles(t.repeat);
}

std::string bumps_of(Context& context, const Material& material) {
  if (material.normal_map)
    context.dropped(fmt::format("normal map: POV-Ray tilts normals by heights only{}",
                                mean_tilt(context.scene.textures.at(material.normal_map->value).model)),
                    material.origin);
  if (!material.displacement) return "";
  const auto* id = std::get_if<Id<Texture>>(&*material.displacement);
  if (!id) return "";  // a constant height tilts nothing
  const TextureModel& model = context.scene.textures.at(id->value).model;
  if (const auto* pattern = std::get_if<PatternTexture>(&model))
    if (const auto text = normal_text(*pattern))
      return fmt::format(" normal {{ {} {} }}", *text,
                         matrix(context.units.to_pov * pattern->texture_to_world));
  const auto* image = std::get_if<ImageTexture>(&model);
  const auto file =
      image ? image_of(context, *image, ImageUse::number, material.origin) : std::optional<std::string>{};
  if (!file || !std::holds_alternative<UvMapping>(image->mapping)) {
    context.dropped("displacement that is not an image by uv", material.origin);
    return "";
  }
  context.approximated("displacement: as a bump map, whose heights POV-Ray measures in its own way",
                       material.origin);
  return fmt::format(" normal {{ uv_mapping bump_map {{ {} interpolate 2 bump_size {} }} }}", *file,
                     image->scale);
}

// A vector of length r and any direction is added to the normal. Its part along the surface has the slopes of
// GGX, α²·u/(1 − u) squared, if r² is α² times a gamma variable of shape 3/2 over an exponential one; without
// the latter, those of Beckmann. Sines and cosines of r ≤ 1 suffice for α = 1 of GGX, where r = 1.
const char* facet_functions() {
  return "#declare Facet_cell = function { pattern { cells } }\n"
         "#declare Facet_log = function(x,y,z) { -ln(max(1e-9, Facet_cell(x,y,z))) }\n"
         "#declare Facet_ggx = function(x,y,z,a) { a / (1 - min(.999, pow(a,5))) * pow(Facet_cell(x,y,z), "
         "1/3)\n"
         "  / sqrt(max(1e-9, 1 - pow(Facet_cell(x,y,z), 2/3))) }\n"
         "#declare Facet_beckmann = function(x,y,z,a) { a * sqrt(Facet_log(x,y,z) + Facet_log(x,y,z+100)\n"
         "  * pow(cos(2*pi*Facet_cell(x,y+100,z+100)),2)) }\n"
         "#declare Facet_up = function(x,y,z) { 2*Facet_cell(x+100,y,z) - 1 }\n"
         "#declare Facet_turn = function(x,y,z) { 2*pi*Facet_cell(x,y+100,z) }\n"
         "#declare Facet_slope = function(x,y,z) { Facet_up(x,y,z)*(z-floor(z)) + "
         "sqrt(1-pow(Facet_up(x,y,z),2))\n"
         "  * (cos(Facet_turn(x,y,z))*(x-floor(x)) + sin(Facet_turn(x,y,z))*(y-floor(y))) }\n";
}

// POV-Ray 3.7 tilts by 2/15 of a function's gradient (measured). Turned, so that no plane lies between cubes.
std::string facet_text(double alpha, bool beckmann, double size) {
  return fmt::format(
      "function {{ min(1, Facet_{}(x,y,z,{})) * Facet_slope(x,y,z) }} 7.5 accuracy 0.001 rotate <31,47,59> "
      "scale {}",
      beckmann ? "beckmann" : "ggx", alpha, size);
}

// Fits, within .02, of integrals at 32° from the normal.
double facet_albedo(double alpha, bool beckmann) {
  const double squared = alpha * alpha;
  return 1 / (1 + (beckmann ? 0.9 * squared * std::exp(-0.16 / squared) : 1.9 * squared));
}

// Of the light that the metal reflects from one facet, so much does not leave: what meets the interface
// beyond the critical angle, and Fresnel's share of the rest.
RGB with_interface(RGB bare, const CoatedFacets& f) {
  const double normal = (f.eta - 1) * (f.eta - 1) / ((f.eta + 1) * (f.eta + 1)), squared = f.alpha * f.alpha;
  const double slope = std::tan(std::asin(std::min(1.0, 1 / f.eta)) / 2);
  const double beyond = squared / (squared + slope * slope), back = beyond + (1 - beyond) * normal;
  const double way = std::cbrt(f.interface_albedo) * f.entering,
               again = f.interface_albedo * f.entering * f.entering;
  const auto whole = [&](double r) {
    return (normal +
            (1 - normal) * way * way * f.albedo * r * (1 - back) / (1 - back * again * f.albedo * r)) /
           f.albedo;
  };
  return {whole(bare.r), whole(bare.g), whole(bare.b)};
}

}  // namespace vitrail::povray
