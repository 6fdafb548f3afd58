// SPDX-License-Identifier: Apache-2.0
#include "importers/reading/integrator.h"

#include <fmt/format.h>

#include <algorithm>

#include "importers/reading/suggestion.h"
#include "scene/records/light_traits.h"
#include "scene/records/material_traits.h"

namespace vitrail {

namespace {

using Kind = AskedIntegrator::Kind;

bool has_smooth(const Scene& scene) {
  return std::ranges::any_of(traits_of(scene.materials),
                             [](const MaterialTraits& t) { return t.lobes.smooth; });
}

bool has_smooth_glass(const Scene& scene) {
  return std::ranges::any_of(traits_of(scene.materials),
                             [](const MaterialTraits& t) { return t.lobes.smooth && t.transmits; });
}

// Those that no ray meets.
bool has_lamps_without_size(const Scene& scene) {
  return std::ranges::any_of(scene.lights,
                             [](const Light& light) { return !traits_of(light.model).surrounds; });
}

bool has_media(const Scene& scene) {
  const auto in = [](const std::vector<Shape>& shapes) {
    return std::ranges::any_of(shapes, [](const Shape& s) { return s.interior || s.exterior; });
  };
  return scene.camera_medium || in(scene.shapes) ||
         std::ranges::any_of(scene.prototypes, [&](const Prototype& p) { return in(p.shapes); }) ||
         std::ranges::any_of(scene.materials, [](const Material& m) {
           return std::holds_alternative<SubsurfaceMaterial>(m.model);
         });
}

constexpr const char* caustics =
    "what mirrors and curved glass throw from small lamps is missed, or noisy; render --integrator photon "
    "shows it";

}  // namespace

AskedIntegrator asked_for(const std::string& name, std::span<const NamedIntegrator> known,
                          const std::vector<std::string>& also_named) {
  const auto found = std::ranges::find(known, name, &NamedIntegrator::first);
  if (found != known.end()) return {name, found->second};
  std::vector<std::string> names = also_named;
  for (const NamedIntegrator& other : known) names.emplace_back(other.first);
  return {name, Kind::other, suggestion(name, names)};
}

std::vector<std::string> settle_integrator(const AskedIntegrator& asked, Scene& scene) {
  std::vector<std::string> differences;
  const auto becomes = [&](const std::string& what) {
    differences.push_back(fmt::format("integrator \"{}\" becomes {}", asked.name, what));
  };
  const bool smooth = has_smooth(scene);
  if (asked.kind == Kind::both_ends && smooth) becomes(fmt::format("a path tracer: {}", caustics));
  if (asked.kind == Kind::from_lamps && smooth)
    becomes(fmt::format("a path tracer, which also shows what the camera sees by mirrors and glass: {}",
                        caustics));
  if (asked.kind == Kind::by_chance && has_lamps_without_size(scene))
    becomes("a path tracer, which also finds the lamps that no ray meets");
  if (asked.kind == Kind::direct && has_smooth_glass(scene))
    becomes("direct light that also comes straight through panes, behind which that one's is dark");
  if (asked.kind == Kind::other) becomes("a path tracer" + asked.suggestion);
  if (!scene.settings.photons) return differences;
  if (has_media(scene)) {
    scene.settings.photons.reset();
    becomes(fmt::format("a path tracer, as photons do not cross media here: {}", caustics));
  } else if (asked.kind == Kind::photon_map) {
    becomes("progressive photon mapping, in which each sample of the picture has photons of its own");
  }
  return differences;
}

namespace {

bool leave_out_media(std::vector<Shape>& shapes) {
  bool any = false;
  for (Shape& shape : shapes) {
    any |= shape.interior || shape.exterior;
    shape.interior.reset();
    shape.exterior.reset();
  }
  return any;
}

}  // namespace

bool leave_out_media(Scene& scene) {
  bool any = scene.camera_medium.has_value();
  scene.camera_medium.reset();
  any |= leave_out_media(scene.shapes);
  for (Prototype& prototype : scene.prototypes) any |= leave_out_media(prototype.shapes);
  return any;
}

}  // namespace vitrail
