// SPDX-License-Identifier: Apache-2.0
// Masks. pbrt has none among its materials, but shapes have an "alpha": so what masks take away, wherever
// they stand in a material, is taken out of it. (1 − w)·a + w·b, of which shares A and B are there, is there
// by (1 − w)·A + w·B, and w·B of that is b. An alpha takes the light of a surface away, too: where one
// shines, what is not there is a sheet of index 1.
#include <algorithm>

#include "importers/pbrt/write/writer.h"
#include "scene/records/light_traits.h"
#include "scene/records/material_traits.h"

namespace vitrail::pbrt {

namespace {

const float* constant(const FloatParameter& p) { return std::get_if<float>(&p); }
bool is(const FloatParameter& p, float value) { return p == FloatParameter{value}; }

FloatParameter add_texture(Writer& w, const char* kind, const Parameters& inputs) {
  const auto id = static_cast<std::uint32_t>(w.textures.size());
  const std::string name = Writer::add_name(w.textures, "coverage");
  w.line(fmt::format("Texture {} \"float\" \"{}\"{}", in_quotes(name), kind, inputs.list()));
  return Id<Texture>{id};
}

FloatParameter product(Writer& w, const FloatParameter& a, const FloatParameter& b) {
  if (is(a, 1) || is(b, 0)) return b;
  if (is(b, 1) || is(a, 0)) return a;
  if (constant(a) && constant(b)) return *constant(a) * *constant(b);
  Parameters p(w, "coverage", {}, RecordKind::material);
  return add_texture(w, "scale", p.number("tex", a).number("scale", b));
}

FloatParameter mix(Writer& w, const FloatParameter& a, const FloatParameter& b,
                   const FloatParameter& amount) {
  if (is(amount, 0) || a == b) return a;
  if (is(amount, 1)) return b;
  if (is(a, 0)) return product(w, b, amount);
  if (constant(a) && constant(b) && constant(amount))
    return *constant(a) + (*constant(b) - *constant(a)) * *constant(amount);
  Parameters p(w, "coverage", {}, RecordKind::material);
  return add_texture(w, "mix", p.number("tex1", a).number("tex2", b).number("amount", amount));
}

// The weight of the second of two materials in what is there of them.
FloatParameter amount_of(Writer& w, const Material& material, const BlendMaterial& m) {
  const FloatParameter &first = w.coverage[m.first.value], &second = w.coverage[m.second.value];
  if (first == second || is(m.amount, 0) || is(m.amount, 1)) return m.amount;
  if (is(first, 0)) return 1.0f;
  if (is(second, 0)) return 0.0f;
  if (constant(first) && constant(second) && constant(m.amount)) {
    const float of_second = *constant(m.amount) * *constant(second);
    return of_second / (of_second + (1 - *constant(m.amount)) * *constant(first));
  }
  w.approximated("masks within a blend by textures: what is there of both is blended as they are",
                 material.origin, RecordKind::material);
  return m.amount;
}

FloatParameter coverage_of(Writer& w, const Material& material) {
  if (std::holds_alternative<InterfaceMaterial>(material.model)) return 0.0f;
  if (const auto* mask = std::get_if<MaskMaterial>(&material.model))
    return product(w, mask->opacity, w.coverage[mask->material.value]);
  if (const auto* sided = std::get_if<TwoSidedMaterial>(&material.model))
    return w.coverage[sided->front.value];
  if (const auto* blend = std::get_if<BlendMaterial>(&material.model))
    return mix(w, w.coverage[blend->first.value], w.coverage[blend->second.value], blend->amount);
  return 1.0f;
}

bool has_lights_without_extent(const Scene& scene) {
  return std::ranges::any_of(scene.lights,
                             [](const Light& light) { return !traits_of(light.model).surrounds; });
}

// Where going straight does not count, the scene is of a path tracer that connects to lights so, too.
void report_depth(Writer& w) {
  const RenderSettings& s = w.scene.settings;
  const std::vector<MaterialTraits> traits = traits_of(w.scene.materials);
  const auto has = [&](bool masks) {
    for (std::size_t i = 0; i < traits.size(); ++i)
      if (traits[i].counts && is_made_of_others(w.scene.materials[i]) == masks) return true;
    return false;
  };
  if (!s.straight_counts && has(false) && has_lights_without_extent(w.scene))
    w.approximated("lights without extent do not shine through thin sheets in pbrt", w.scene.camera_origin,
                   RecordKind::integrator);
  if (s.max_depth >= unlimited_depth) return;
  if (s.straight_counts && has(true))
    w.approximated("the depth: pbrt does not count going through where a mask leaves nothing",
                   w.scene.camera_origin, RecordKind::integrator);
  if (!s.straight_counts && has(false))
    w.approximated("the depth: pbrt counts going straight through thin sheets", w.scene.camera_origin,
                   RecordKind::integrator);
}

std::string add_material(Writer& w, const char* wanted, const char* kind, const Parameters& p) {
  std::string name = Writer::add_name(w.materials, wanted);
  w.line(fmt::format("MakeNamedMaterial {} \"string type\" \"{}\"{}", in_quotes(name), kind, p.list()));
  return name;
}

// Of each kind one is enough.
const std::string& made_once(std::string& name, auto&& make) {
  if (name.empty()) name = make();
  return name;
}

// A surface that shines where nothing of it is there.
const std::string& sheer(Writer& w) {
  return made_once(w.sheer, [&] {
    return add_material(w, "sheer", "thindielectric",
                        Parameters(w, "", {}, RecordKind::material).number("eta", 1.0f));
  });
}

const std::string& nothing(Writer& w) {
  return made_once(w.nothing, [&] {
    return add_material(w, "nothing", "interface", Parameters(w, "", {}, RecordKind::material));
  });
}

std::string shining(Writer& w, const Shape& shape, const FloatParameter& coverage) {
  if (has_lights_without_extent(w.scene))
    w.approximated("what shines and lets light pass: lights without extent do not shine through it",
                   shape.origin, RecordKind::shape);
  // An interface never counts for the depth, a mask where the scene says so.
  const RenderSettings& settings = w.scene.settings;
  if (settings.max_depth < unlimited_depth && (!settings.straight_counts || is(coverage, 0)))
    w.approximated("what shines and lets light pass: going through it counts for the depth", shape.origin,
                   RecordKind::shape);
  if (is(coverage, 0)) return sheer(w);
  return made_once(w.shining[shape.material.value], [&] {
    Parameters p(w, "", {}, RecordKind::material);
    p.texts("materials", {sheer(w), w.materials.at(shape.material.value)}).number("amount", coverage);
    return add_material(w, "shining", "mix", p);
  });
}

}  // namespace

void write_coverage(Writer& w) {
  for (const Material& material : w.scene.materials) {
    const auto* blend = std::get_if<BlendMaterial>(&material.model);
    w.amounts.push_back(blend ? amount_of(w, material, *blend) : FloatParameter{0.0f});
    w.coverage.push_back(coverage_of(w, material));
  }
  report_depth(w);
}

ShapeSurface surface_of(Writer& w, const Shape& shape) {
  const FloatParameter& coverage = w.coverage.at(shape.material.value);
  const std::string& name = w.materials.at(shape.material.value);
  if (is(coverage, 1)) return {name, shape.opacity};
  if (shape.area_light) return {shining(w, shape, coverage), shape.opacity};
  if (is(coverage, 0)) {
    const Material& material = w.scene.materials.at(shape.material.value);
    return {std::holds_alternative<InterfaceMaterial>(material.model) ? name : nothing(w), shape.opacity};
  }
  if (shape.interior != shape.exterior)
    w.approximated("a mask where a medium begins: what passes it does not enter the medium", shape.origin,
                   RecordKind::shape);
  const auto [known, is_new] = w.alphas.try_emplace({opacity_key(shape.opacity), opacity_key(coverage)});
  if (is_new) known->second = product(w, shape.opacity, coverage);
  return {name, known->second};
}

}  // namespace vitrail::pbrt
