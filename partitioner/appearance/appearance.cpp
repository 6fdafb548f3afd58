// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/appearance.h"

#include <fmt/format.h>

#include "bundle/instance.h"
#include "images/texture_values.h"
#include "partitioner/appearance/bake_materials.h"
#include "partitioner/appearance/bake_media.h"
#include "partitioner/appearance/bake_textures.h"
#include "partitioner/appearance/requirements.h"
#include "partitioner/placing/wedged_panes.h"
#include "scene/daylight/sky_model.h"
#include "scene/records/curve_uses.h"
#include "scene/records/kinds.h"
#include "scene/records/light_traits.h"
#include "scene/records/material_traits.h"
#include "scene/shapes/curve.h"

namespace vitrail {

namespace {

class Notes {
 public:
  Notes(const Scene& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}
  void approximated(std::string message, const Origin& origin) {
    add(Fidelity::approximated, std::move(message), origin);
  }
  void dropped(std::string message, const Origin& origin) {
    add(Fidelity::dropped, std::move(message), origin);
  }

 private:
  void add(Fidelity fidelity, std::string message, const Origin& origin) {
    const SourceLocation place = location(scene_, origin);
    diagnostics_.push_back({fidelity, std::move(message), place, place});
  }
  const Scene& scene_;
  Diagnostics& diagnostics_;
};

// What the shapes use, by the ids of the scene.
struct Used {
  std::vector<bool> materials, area_lights, media, opacities;
};

Used used_in(const Scene& scene) {
  Used used{std::vector<bool>(scene.materials.size()), std::vector<bool>(scene.area_lights.size()),
            std::vector<bool>(scene.media.size()), std::vector<bool>(scene.textures.size())};
  const auto use = [&](const Shape& shape) {
    used.materials.at(shape.material.value) = true;
    if (shape.area_light) used.area_lights.at(shape.area_light->value) = true;
    for (const auto& medium : {shape.interior, shape.exterior})
      if (medium) used.media.at(medium->value) = true;
    if (const auto* texture = std::get_if<Id<Texture>>(&shape.opacity))
      used.opacities.at(texture->value) = true;
  };
  for (const Shape& shape : scene.shapes) use(shape);
  std::vector<bool> reached(scene.prototypes.size());
  for (const Instance& instance : scene.instances) reached.at(instance.prototype.value) = true;
  for (std::size_t i = scene.prototypes.size(); i-- > 0;) {
    if (!reached[i]) continue;
    for (const Shape& shape : scene.prototypes[i].shapes) use(shape);
    for (const Instance& inner : scene.prototypes[i].instances) reached.at(inner.prototype.value) = true;
  }
  if (scene.camera_medium) used.media.at(scene.camera_medium->value) = true;
  // Materials refer to smaller ids alone.
  for (std::size_t i = scene.materials.size(); i-- > 0;)
    if (used.materials[i])
      for (const Id<Material> part : parts_of(scene.materials[i].model)) used.materials.at(part.value) = true;
  return used;
}

// Gives what is used new ids in the old order; `take` makes record i and says whether there is one.
std::vector<std::int32_t> renumbered(const std::vector<bool>& used, auto&& take) {
  std::vector<std::int32_t> ids(used.size(), -1);
  std::int32_t next = 0;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i] && take(i, ids)) ids[i] = next++;
  return ids;
}

void bake_media(const Scene& scene, const Used& used, Appearance& result, Notes& report) {
  result.medium_ids = renumbered(used.media, [&](std::size_t i, const auto&) {
    const Medium& medium = scene.media[i];
    std::vector<std::string> notes;
    std::optional<Medium> baked = bake_medium(medium, scene.settings.rgb, notes);
    for (const std::string& note : notes) {
      const std::string message = fmt::format("medium \"{}\": {}", medium.name, note);
      if (baked)
        report.approximated(message, medium.origin);
      else
        report.dropped(message + "; light passes it unchanged", medium.origin);
    }
    if (!baked) return false;
    result.media.push_back(std::move(*baked));
    return true;
  });
}

void bake_materials(const Scene& scene, const Used& used, TextureBaker& textures, Appearance& result,
                    Notes& report) {
  TableBaker tables;
  result.material_interiors.assign(scene.materials.size(), -1);
  result.material_ids = renumbered(used.materials, [&](std::size_t i, const auto& ids) {
    const Material& material = scene.materials[i];
    BakedMaterial baked = bake_material(material, ids, textures, tables);
    if (baked.interior) {
      if (scene.settings.max_depth < unlimited_depth)
        baked.notes.emplace_back("the depth: its interior would use it up, so paths end by roulette alone");
      result.material_interiors[i] = static_cast<std::int32_t>(result.media.size());
      result.media.push_back(std::move(*baked.interior));
    }
    result.materials.push_back(std::move(baked.material));
    for (const Id<Material> part : parts_of(material.model)) {
      const auto* dielectric = std::get_if<DielectricMaterial>(&scene.materials[part.value].model);
      if (dielectric && dielectric->priority != 0)
        report.approximated("the priority of a dielectric that is part of another material is not looked at",
                            material.origin);
    }
    const std::string name = material.name.empty() ? "" : fmt::format(" \"{}\"", material.name);
    for (const std::string& note : baked.notes)
      report.approximated(fmt::format("material{} ({}): {}", name, kind_of(material.model), note),
                          material.origin);
    return true;
  });
  result.tables = tables.take();
}

// Whether curves with gaps may become tubes: where something keeps no balls.
bool may_have_tubes(const Scene& scene, const Shape& shape) {
  const auto keeps_balls = [](const Transform& t) { return is_affine(t) && is_similarity(t); };
  const auto all_do = [&](const std::vector<Instance>& instances) {
    return std::ranges::all_of(instances,
                               [&](const Instance& i) { return keeps_balls(i.prototype_to_world); });
  };
  return is_of_curves(scene, shape) && !shape.area_light && shape.opacity != FloatParameter{1.0f} &&
         !(keeps_balls(shape.object_to_world) && all_do(scene.instances) &&
           std::ranges::all_of(scene.prototypes, all_do, &Prototype::instances));
}

void add_outer_walls(const Scene& scene, Appearance& result) {
  result.outer_wall_ids.assign(scene.materials.size(), -1);
  const std::vector<MaterialTraits> traits = traits_of(scene.materials);
  const auto append = [&](Material material) {
    result.materials.push_back(std::move(material));
    return Id<Material>{static_cast<std::uint32_t>(result.materials.size() - 1)};
  };
  const auto add = [&](const Shape& shape) {
    const std::uint32_t id = shape.material.value;
    std::int32_t& outer = result.outer_wall_ids[id];
    const InnerWall inner = inner_wall(traits[id]);
    if (inner == InnerWall::as_the_outer || outer >= 0 || !may_have_tubes(scene, shape)) return;
    outer = result.material_ids.at(id);
    if (inner == InnerWall::nothing_by_itself || outer < 0) return;
    const Id<Material> of_curve{static_cast<std::uint32_t>(outer)}, nothing = append({InterfaceMaterial{}});
    Material hollow = result.materials[of_curve.value];
    hollow.model = TwoSidedMaterial{of_curve, nothing};
    outer = static_cast<std::int32_t>(append(std::move(hollow)).value);
  };
  for (const Shape& shape : scene.shapes) add(shape);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) add(shape);
}

// The images of lights are baked like any other.
struct LightBaker {
  TextureBaker& textures;
  SourceLocation where;

  LightModel operator()(PointLight l) const {
    l.intensity = textures.as_rendered(l.intensity);
    return l;
  }
  LightModel operator()(SpotLight l) const {
    l.intensity = textures.as_rendered(l.intensity);
    if (l.texture) {
      const SpectrumParameter baked = textures.bake(SpectrumParameter{*l.texture}, TextureUse::unbounded);
      l.texture = std::get<Id<Texture>>(baked);
    }
    return l;
  }
  LightModel operator()(ProjectionLight l) const {
    l.scale = textures.as_rendered(l.scale);
    l.image = textures.bake(l.image, TextureUse::illuminant);
    return l;
  }
  LightModel operator()(GoniometricLight l) const {
    l.intensity = textures.as_rendered(l.intensity);
    l.filename = textures.bake_image(image_of(l), TextureUse::number, where);
    l.encoding = {}, l.number = {};  // they are in its values
    return l;
  }
  LightModel operator()(DistantLight l) const {
    l.irradiance = textures.as_rendered(l.irradiance);
    return l;
  }
  LightModel operator()(InfiniteLight l) const {
    l.radiance = textures.as_rendered(l.radiance);
    return l;
  }
  LightModel operator()(EnvironmentLight l) const {
    l.scale = textures.as_rendered(l.scale);
    l.filename = textures.bake_image(image_of(l), TextureUse::illuminant, where);
    l.encoding = {}, l.primaries = {};  // they are in its values
    return l;
  }
  LightModel operator()(SkyLight l) const {
    l.albedo = textures.as_rendered(l.albedo);
    return l;
  }
};

// As requirements_of finds it: also what other materials have become.
bool is_refracting(const std::vector<Material>& baked) {
  return std::ranges::any_of(baked, [](const Material& material) {
    const auto* glass = std::get_if<DielectricMaterial>(&material.model);
    return glass && glass->roughness.alpha_u == FloatParameter{0.0f} &&
           glass->roughness.alpha_v == FloatParameter{0.0f};
  });
}

// Paths find the light of the sun behind panes alone (docs/why/one-picture.md).
void report_wedges(const Scene& scene, Notes& report) {
  const WedgedPanes found = wedged_panes(scene);
  if (found.count > 0)
    report.approximated(
        fmt::format("{} of glass with faces up to {:.2g} rad off parallel, which neither float glass nor the "
                    "file's decimals explain: only --integrator photon brings sunlight through",
                    found.count == 1 ? "a pane" : fmt::format("{} panes", found.count), found.widest_rad),
        found.widest);
}

// Nothing would come through a medium without end.
void report_endless_medium(const Scene& scene, const Light& light, Notes& report) {
  if (!scene.camera_medium || !traits_of(light.model).is_far()) return;
  const Medium& medium = scene.media.at(scene.camera_medium->value);
  if (std::holds_alternative<std::monostate>(medium.density))
    report.approximated(
        "light from infinitely far crosses as much of the medium around the camera as the scene is wide. "
        "pbrt and Mitsuba do so where they choose a light; their rays that meet nothing bring no light",
        light.origin);
}

// Of area lights that have no name, the first that one of their shapes has.
std::vector<std::string> names_of_area_lights(const Scene& scene) {
  std::vector<std::string> names;
  for (const AreaLight& light : scene.area_lights) names.push_back(light.name);
  const auto name_by = [&](const std::vector<Shape>& shapes) {
    for (const Shape& shape : shapes)
      if (shape.area_light && names.at(shape.area_light->value).empty())
        names[shape.area_light->value] = shape.name;
  };
  name_by(scene.shapes);
  for (const Prototype& prototype : scene.prototypes) name_by(prototype.shapes);
  return names;
}

}  // namespace

Appearance appearance_of(const Scene& scene, const std::filesystem::path& bundle, const ImageBaking& images) {
  Appearance result;
  Notes report(scene, result.diagnostics);
  TextureBaker textures(scene, bundle, result.diagnostics, images);
  const Used used = used_in(scene);
  bake_media(scene, used, result, report);
  bake_materials(scene, used, textures, result, report);
  add_outer_walls(scene, result);
  const std::vector<std::string> names = names_of_area_lights(scene);
  result.area_light_ids = renumbered(used.area_lights, [&](std::size_t i, const auto&) {
    AreaLight light = scene.area_lights[i];
    light.name = names[i];
    light.radiance = textures.bake(light.radiance, TextureUse::illuminant);
    if (std::holds_alternative<Spectrum>(light.radiance)) light.scale = 1;  // it is of a texture
    result.area_lights.push_back(std::move(light));
    return true;
  });
  result.opacities.resize(scene.textures.size(), 1.0f);
  for (std::uint32_t i = 0; i < used.opacities.size(); ++i)
    if (used.opacities[i]) result.opacities[i] = textures.bake(FloatParameter{Id<Texture>{i}});
  const bool glass = is_refracting(result.materials);
  result.lights.reserve(scene.lights.size());
  for (const Light& light : scene.lights) {
    Light baked = light;
    baked.model = std::visit(LightBaker{textures, location(scene, light.origin)}, light.model);
    baked.origin = {};
    result.lights.push_back(std::move(baked));
    if (const auto* sky = std::get_if<SkyLight>(&light.model); sky && glass && SkyModel(*sky).has_sun())
      report.approximated(
          "mirrors and curved glass throw sunlight. Only photons (--integrator photon) find this light on "
          "smooth "
          "glass, and on what scatters below a smooth surface",
          light.origin);
    report_endless_medium(scene, light, report);
    const auto* environment = std::get_if<EnvironmentLight>(&light.model);
    if (environment && *environment->portal)
      report.approximated("environment light: its portal is not looked at, it shines from everywhere",
                          light.origin);
  }
  if (glass && std::ranges::any_of(scene.lights, [](const Light& l) { return traits_of(l.model).parallel; }))
    report_wedges(scene, report);
  result.attributes = textures.attributes();
  if (scene.settings.rgb == RgbMethod::matrix_r &&
      std::ranges::any_of(result.attributes, [](const auto& a) { return a.use == TextureUse::reflectance; }))
    report.approximated("the colours of vertices become spectra by Jakob and Hanika's method", {});
  result.texture_files = textures.files();
  result.textures = textures.take_textures();
  return result;
}

}  // namespace vitrail
