// SPDX-License-Identifier: Apache-2.0
// BSDFs by the names of their plugins.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "importers/mitsuba/read/bsdf_models.h"
#include "importers/mitsuba/read/builder.h"
#include "importers/reading/suggestion.h"
#include "scene/records/material_traits.h"

namespace vitrail::mitsuba {

namespace {

template <class Made>
struct Plugin {
  std::string_view name;
  Made (*make)(Builder&, const Object&);
};

constexpr std::array<Plugin<MaterialModel>, 28> models{{{"diffuse", diffuse},
                                                        {"roughdiffuse", rough_diffuse},
                                                        {"dielectric", dielectric},
                                                        {"roughdielectric", dielectric},
                                                        {"thindielectric", thin_dielectric},
                                                        {"conductor", conductor},
                                                        {"roughconductor", conductor},
                                                        {"plastic", plastic},
                                                        {"roughplastic", plastic},
                                                        {"pplastic", plastic},
                                                        {"phong", phong},
                                                        {"ward", phong},
                                                        {"difftrans", diffuse_transmitter},
                                                        {"hk", slab},
                                                        {"principled", principled},
                                                        {"principledthin", principled},
                                                        {"hair", hair},
                                                        {"measured", measured},
                                                        {"measured_polarized", measured},
                                                        {"null", nothing},
                                                        {"polarizer", polarizing},
                                                        {"retarder", polarizing},
                                                        {"circular", polarizing},
                                                        {"mask", mask},
                                                        {"blendbsdf", blend},
                                                        {"mixturebsdf", mixture},
                                                        {"lambertian", diffuse},
                                                        {"mirror", conductor}}};

constexpr std::array<Plugin<Material>, 6> adapters{{{"twosided", two_sided},
                                                    {"bumpmap", bump_map},
                                                    {"bump", bump_map},
                                                    {"normalmap", normal_map},
                                                    {"coating", coated},
                                                    {"roughcoating", coated}}};

template <class Plugins>
auto find_plugin(const Plugins& plugins, std::string_view name) {
  const auto found = std::ranges::find_if(plugins, [&](const auto& plugin) { return plugin.name == name; });
  return found == plugins.end() ? nullptr : &*found;
}

Material unknown(Builder& b, const Object& o) {
  std::vector<std::string> names;
  for (const auto& plugin : adapters) names.emplace_back(plugin.name);
  for (const auto& plugin : models) names.emplace_back(plugin.name);
  b.report.approximated(
      fmt::format("bsdf \"{}\" is not known and becomes diffuse{}", o.type, suggestion(o.type, names)),
      o.origin);
  for (const Property& p : o.properties) o.find(p.name);
  return Material{DiffuseMaterial{}};
}

Material of_model(Builder& b, const Object& o) {
  const auto* const plugin = find_plugin(models, o.type);
  Material material = plugin ? Material{plugin->make(b, o)} : unknown(b, o);
  material.two_sided = traits_of(material, b.traits).transmits;
  return material;
}

Material make_material(Builder& b, const Object& o) {
  const auto* const adapter = find_plugin(adapters, o.type);
  Material material = adapter ? adapter->make(b, o) : of_model(b, o);
  report_unused(o, b.report,
                {"reflectance", "diffuse_reflectance", "specular_reflectance", "alpha", "int_ior", "ext_ior",
                 "eta", "k", "material", "opacity", "weight", "base_color", "roughness"});
  material.origin = o.origin;
  return material;
}

}  // namespace

Material inner_material(Builder& b, const Object& o) {
  const Object* bsdf = o.child("bsdf");
  if (!bsdf) b.report.fail(fmt::format("\"{}\" needs a nested bsdf", o.type), o.origin);
  return make_material(b, *bsdf);
}

Id<Material> append(Builder& b, Material material) {
  b.traits.push_back(traits_of(material, b.traits));
  b.sided.push_back(has_sides(material, b.traits.back(), b.sided));
  b.parts.push_back(parts_of(material, b.parts));
  b.scene.materials.push_back(std::move(material));
  return {static_cast<std::uint32_t>(b.scene.materials.size() - 1)};
}

Id<Material> add_material(Builder& b, const Object& o) {
  if (const auto known = b.materials.find(&o); known != b.materials.end()) return known->second;
  const Report::Item before = b.report.begin_item({o.origin, RecordKind::material});
  Material material = make_material(b, o);
  material.name = name_of(o);
  b.report.begin_item(before);
  return b.materials[&o] = append(b, std::move(material));
}

}  // namespace vitrail::mitsuba
