// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/scene_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include "bundle/checksum.h"
#include "bundle/light_names.h"
#include "scene/daylight/given_sky.h"
#include "scene/records/light_traits.h"
#include "scene/records/material_traits.h"
#include "scene/spectra/matrix_r.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Property {
  const char* name;
  std::size_t values;
  double least, most;
  const char* range;  // in words
};
constexpr Property properties[] = {{"scale", 1, 0, infinite, "a scale is a number that is not negative"},
                                   {"sun", 3, -infinite, infinite, "a direction has three numbers, x:y:z"},
                                   {"turbidity", 1, 1, 10, "a turbidity is in [1, 10]"},
                                   {"ground", 1, 0, 1, "a ground reflects a share in [0, 1]"},
                                   {"color", 3, 0, 1, "a colour has three numbers in [0, 1], r:g:b"},
                                   {"roughness", 1, 0, 1, "a roughness is in [0, 1]"},
                                   {"sky", 0, 0, 0, "a sky is told as of --sky"}};

constexpr const char* has_its_axes = "the bundle knows which of its axes are up and north";

constexpr std::string_view sky_property = ".sky=";

// "lamp.scale=2": where the dot and the equals sign are; npos: it has none. The words of a sky have such
// signs themselves.
struct Places {
  explicit Places(const std::string& text)
      : equals(text.rfind('=')), dot(equals == text.npos ? text.npos : text.rfind('.', equals)) {
    if (const std::size_t sky = text.find(sky_property); sky != text.npos)
      dot = sky, equals = sky + sky_property.size() - 1;
  }
  std::size_t equals, dot;
};

std::string property_in(const std::string& text) {
  const Places at(text);
  return at.dot == text.npos ? "" : text.substr(at.dot + 1, at.equals - at.dot - 1);
}

[[noreturn]] void refuse(const std::string& text, const std::string& what) {
  throw UsageError(fmt::format("--set {}: {}", text, what));
}

// ---- Lights

// A bundle does not keep the colours that `scaled` would fit anew.
void scale_by(Spectrum& spectrum, double factor) {
  const auto scale = [&](float& value) { value = static_cast<float>(static_cast<double>(value) * factor); };
  if (auto* illuminant = std::get_if<RgbIlluminantSpectrum>(&spectrum))
    scale(illuminant->scale);
  else if (auto* unbounded = std::get_if<RgbUnboundedSpectrum>(&spectrum))
    scale(unbounded->scale);
  else
    spectrum = scaled(spectrum, factor);
}

struct LightScaler {
  double factor;
  void operator()(PointLight& l) const { scale_by(l.intensity, factor); }
  void operator()(SpotLight& l) const { scale_by(l.intensity, factor); }
  void operator()(ProjectionLight& l) const { scale_by(l.scale, factor); }
  void operator()(GoniometricLight& l) const { scale_by(*l.intensity, factor); }
  void operator()(DistantLight& l) const { scale_by(l.irradiance, factor); }
  void operator()(InfiniteLight& l) const { scale_by(l.radiance, factor); }
  void operator()(EnvironmentLight& l) const { scale_by(*l.scale, factor); }
  void operator()(SkyLight& l) const {
    l.sky_scale *= static_cast<float>(factor);
    l.sun_scale *= static_cast<float>(factor);
  }
};

// A light whose power or illuminance is given is normalised to that, whatever its scale.
void scale_given(Light& light, double factor) {
  std::visit(
      [&](auto& l) {
        if constexpr (requires { l.power; })
          if (l.power) *l.power *= static_cast<float>(factor);
        if constexpr (requires { l.illuminance; })
          if (l.illuminance) *l.illuminance *= static_cast<float>(factor);
      },
      light.model);
}

void scale_surface(AreaLight& light, double factor) {
  if (auto* spectrum = std::get_if<Spectrum>(&light.radiance))
    scale_by(*spectrum, factor);
  else
    light.scale *= static_cast<float>(factor);
}

void edit_light(Light& light, const SceneEdit& edit) {
  auto* const sky = std::get_if<SkyLight>(&light.model);
  auto* const distant = std::get_if<DistantLight>(&light.model);
  if (edit.property == "scale") {
    std::visit(LightScaler{edit.values[0]}, light.model);
    scale_given(light, edit.values[0]);
  } else if (edit.property == "turbidity" && sky) {
    sky->turbidity = static_cast<float>(edit.values[0]);
  } else if (edit.property == "ground" && sky) {
    sky->ground = static_cast<float>(edit.values[0]);
  } else if (edit.property == "sun" && (sky || distant)) {
    const Vector3d to_sun = normalize(Vector3d{edit.values[0], edit.values[1], edit.values[2]});
    if (sky) sky->to_sun = normalize(transform_vector(inverse(sky->light_to_world), to_sun));
    if (distant) distant->direction = -to_sun;
  } else if (edit.property == "sky" && sky) {
    const Transform stands = sky->light_to_world;
    *sky = *edit.sky;
    sky->light_to_world = stands;
  } else {
    refuse(edit.text, sky       ? "a sky has a scale, a sun, a turbidity, a ground, or another sky"
                      : distant ? "a distant light has a scale and a sun"
                                : "a light has a scale");
  }
}

bool is_called(const std::string& name, const SceneEdit& edit) {
  return !name.empty() && (name == edit.name || typed_name(name) == typed_name(edit.name));
}

// Whether some light has the name.
bool edit_lights(Manifest& m, const LightNames& names, const SceneEdit& edit) {
  bool any = false;
  for (std::size_t i = 0; i < m.area_lights.size(); ++i) {
    if (!is_called(names.area_lights[i], edit)) continue;
    if (edit.property != "scale") refuse(edit.text, "a light has a scale");
    scale_surface(m.area_lights[i], edit.values[0]);
    any = true;
  }
  for (std::size_t i = 0; i < m.lights.size(); ++i)
    if (is_called(names.lights[i], edit)) edit_light(m.lights[i], edit), any = true;
  return any;
}

// Area lights by a material of theirs that the edit names; "" of the others.
LightNames shining_materials(const Manifest& m, const SceneEdit& edit) {
  LightNames names;
  names.area_lights.resize(m.area_lights.size());
  names.lights.resize(m.lights.size());
  for (const Surface& surface : m.surfaces) {
    const std::string& name = m.materials[surface.material].name;
    if (surface.area_light >= 0 && is_called(name, edit))
      names.area_lights[static_cast<std::size_t>(surface.area_light)] = name;
  }
  return names;
}

bool edit_any_light(Manifest& m, const SceneEdit& edit) {
  return edit_lights(m, light_names(m), edit) || edit_lights(m, shining_materials(m, edit), edit) ||
         edit_lights(m, numbered_light_names(m), edit);
}

// ---- Materials

// Its own, not those of what it is made of. Null: it has none.
SpectrumParameter* color_of(MaterialModel& model) {
  return std::visit(
      [](auto& m) -> SpectrumParameter* {
        if constexpr (requires { m.base_color; })
          return &m.base_color;
        else if constexpr (requires { m.diffuse_reflectance; })
          return &m.diffuse_reflectance;
        else if constexpr (requires { m.reflectance; })
          return &m.reflectance;
        else
          return nullptr;
      },
      static_cast<MaterialVariant&>(model));
}

// Smooth surfaces are prepared in another way than rough ones: false where it was one and would be the other.
bool set_alpha(FloatParameter& alpha, double value) {
  const auto* before = std::get_if<float>(&alpha);
  if ((value == 0) != (before && *before == 0)) return false;
  alpha = static_cast<float>(value);
  return true;
}

void set_facets(Roughness& roughness, const SceneEdit& edit) {
  if (!set_alpha(roughness.alpha_u, edit.values[0]) || !set_alpha(roughness.alpha_v, edit.values[0]))
    refuse(edit.text,
           "a smooth surface of a bundle cannot become rough, or a rough one smooth: change the scene and "
           "partition it again");
  roughness.square_root = false;
}

// False where it has none.
bool set_roughness(MaterialModel& model, const SceneEdit& edit) {
  return std::visit(
      [&](auto& m) {
        if constexpr (requires { m.base_color; })
          m.roughness = static_cast<float>(edit.values[0]);
        else if constexpr (requires { m.phong_size; })  // POV-Ray's own, whose exponent is 1/roughness
          m.roughness = std::max(static_cast<float>(edit.values[0]), 1e-4f);
        else if constexpr (requires { m.roughness; })
          set_facets(m.roughness, edit);
        else if constexpr (requires { m.interface_roughness; })
          set_facets(m.interface_roughness, edit);
        else
          return false;
        return true;
      },
      static_cast<MaterialVariant&>(model));
}

// False where neither it nor what it is made of has the property.
bool edit_material(Manifest& m, std::size_t material, const SceneEdit& edit) {
  MaterialModel& model = m.materials[material].model;
  if (edit.property == "roughness") {
    if (set_roughness(model, edit)) return true;
  } else if (SpectrumParameter* const color = color_of(model)) {
    *color = resolved(reflectance_from_rgb({edit.values[0], edit.values[1], edit.values[2]}), m.settings.rgb);
    return true;
  }
  bool any = false;
  for (const Id<Material> part : parts_of(model)) any |= edit_material(m, part.value, edit);
  return any;
}

bool edit_materials(Manifest& m, const SceneEdit& edit) {
  bool any = false;
  for (std::size_t i = 0; i < m.materials.size(); ++i) {
    if (!is_called(m.materials[i].name, edit)) continue;
    if (!edit_material(m, i, edit)) refuse(edit.text, fmt::format("this material has no {}", edit.property));
    any = true;
  }
  return any;
}

// Of lights, or of materials that have one.
std::set<std::string> names_of(const Manifest& m, bool of_lights) {
  std::set<std::string> names;
  const LightNames lights = light_names(m);
  if (of_lights)
    for (const auto* list : {&lights.area_lights, &lights.lights}) names.insert(list->begin(), list->end());
  else
    for (const Material& material : m.materials) names.insert(material.name);
  names.erase("");
  return names;
}

// "Desk, Lamp, 3 more".
std::string list_of(const std::set<std::string>& names) {
  std::vector<std::string> shown(names.begin(), names.end());
  constexpr std::size_t most = 20;
  const std::size_t more = shown.size() - std::min(shown.size(), most);
  shown.resize(shown.size() - more);
  if (more > 0) shown.push_back(fmt::format("{} more", more));
  return fmt::format("{}", fmt::join(shown, ", "));
}

// "there is Desk, Lamp; did you mean Lamp? vitrail inspect lists all".
std::string words_about_names(const Manifest& m, const SceneEdit& edit, bool of_lights) {
  const std::set<std::string> names = names_of(m, of_lights);
  const std::string meant = closest_word(edit.name, {names.begin(), names.end()});
  return fmt::format("there is {}; {}vitrail inspect lists all",
                     names.empty() ? "none with a name" : list_of(names),
                     meant.empty() ? "" : fmt::format("did you mean {}? ", meant));
}

[[noreturn]] void refuse_name(const Manifest& m, const SceneEdit& edit, bool of_lights) {
  const std::set<std::string> others = names_of(m, !of_lights);
  const bool is_other =
      std::ranges::any_of(others, [&](const std::string& name) { return is_called(name, edit); });
  const char* const other =
      of_lights ? "this is a material that does not shine, and " : "this is a light, and ";
  refuse(edit.text, fmt::format("{}no {} has this name; {}", is_other ? other : "",
                                of_lights ? "light" : "material", words_about_names(m, edit, of_lights)));
}

// Throws UsageError unless there is one. By its number: the text names it so, whatever the file calls it.
SceneEdit change_the_sky(Manifest& m, const SceneEdit& edit) {
  std::vector<std::size_t> skies;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < m.lights.size(); ++i) {
    if (!std::holds_alternative<SkyLight>(m.lights[i].model)) continue;
    skies.push_back(i);
    names.push_back(numbered_light_names(m).lights[i]);
  }
  if (skies.empty())
    throw UsageError(
        "--sky: the bundle has no sky that another could replace: give --sky to partition, and then each "
        "render takes its own");
  if (skies.size() > 1)
    throw UsageError(fmt::format("--sky: the bundle has {} skies: give --set NAME.sky= to one of {}",
                                 skies.size(), fmt::join(names, ", ")));
  SceneEdit named{
      fmt::format("{}{}{}", names[0], sky_property, edit.text), names[0], edit.property, {}, edit.sky};
  edit_light(m.lights[skies[0]], named);
  return named;
}

bool is_far(const Light& light) { return traits_of(light.model).is_far(); }

void turn_off_lamps(Manifest& m) {
  for (AreaLight& light : m.area_lights) scale_surface(light, 0);
  for (Light& light : m.lights) {
    if (is_far(light)) continue;
    std::visit(LightScaler{0}, light.model);
    scale_given(light, 0);
  }
  for (Medium& medium : m.media)
    medium.emission.reset(), medium.emission_scale.reset(), medium.temperature.reset();
}

void make(Manifest& m, const SceneEdit& edit) {
  const bool of_material = edit.property == "color" || edit.property == "roughness";
  if (!(of_material ? edit_materials(m, edit) : edit_any_light(m, edit))) refuse_name(m, edit, !of_material);
}

}  // namespace

bool is_scene_edit(const std::string& text) {
  return std::ranges::find(properties, property_in(text), &Property::name) != std::end(properties);
}

SceneEdit parse_scene_edit(const std::string& text) {
  const Places at(text);
  const auto* const property = std::ranges::find(properties, property_in(text), &Property::name);
  if (property == std::end(properties) || at.dot == 0)
    refuse(text, "it has to be NAME.PROPERTY=VALUE, as in lamp.scale=2");
  SceneEdit edit{text, text.substr(0, at.dot), property->name, {}, {}};
  if (edit.property == "sky") {
    const GivenSky given = parse_sky(text.substr(at.equals + 1));
    if (!given.up.empty() || !given.north.empty()) refuse(text, has_its_axes);
    edit.sky = given.light;
    return edit;
  }
  std::istringstream list(text.substr(at.equals + 1));
  for (std::string part; std::getline(list, part, ':');) {
    double value = 0;
    const char* const end = part.data() + part.size();
    const auto [parsed, failed] = std::from_chars(part.data(), end, value);
    if (failed != std::errc() || parsed != end || !std::isfinite(value)) refuse(text, property->range);
    if (value < property->least || value > property->most) refuse(text, property->range);
    edit.values.push_back(value);
  }
  if (edit.values.size() != property->values) refuse(text, property->range);
  if (edit.property == "sun" && !(std::hypot(edit.values[0], edit.values[1], edit.values[2]) > 0))
    refuse(text, "this direction has no length");
  return edit;
}

SceneEdit parse_sky_edit(const std::string& words) {
  const GivenSky given = parse_sky(words);
  if (!given.up.empty() || !given.north.empty())
    throw UsageError(fmt::format("--sky {}: {}", words, has_its_axes));
  return {words, "", "sky", {}, given.light};
}

SceneEdit lamps_off() { return {"lamps=off", "", "lamps", {}, {}}; }

std::string words_of_lamps(const Manifest& m) {
  const LightNames names = light_names(m);
  std::set<std::string> off(names.area_lights.begin(), names.area_lights.end());
  for (std::size_t i = 0; i < m.lights.size(); ++i)
    if (!is_far(m.lights[i])) off.insert(names.lights[i]);
  off.insert(names.media.begin(), names.media.end());
  off.erase("");
  const bool is_dark = std::ranges::none_of(m.lights, is_far);
  return fmt::format("{} off{}",
                     off.empty() ? "no light is" : list_of(off) + (off.size() > 1 ? " are" : " is"),
                     is_dark ? "; no other light is there, and the picture is black" : "");
}

void edit_scene(std::span<const SceneEdit> edits, Manifest& m) {
  if (edits.empty()) return;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  for (const SceneEdit& edit : edits) {
    std::string text = edit.text;
    if (edit.property == "lamps")
      turn_off_lamps(m);
    else if (edit.name.empty())
      text = change_the_sky(m, edit).text;
    else
      make(m, edit);
    hasher.add(std::as_bytes(std::span(text)));
    hasher.add(std::as_bytes(std::span("\n", 1)));
  }
  m.scene_hash = hasher.digest();
}

}  // namespace vitrail
