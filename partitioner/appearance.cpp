// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "partitioner/texture_mean.h"
#include "scene/rgb_to_spectrum.h"

namespace vitrail {

namespace {

Spectrum each_nm(auto&& value) {
  TabulatedSpectrum table;
  for (int i = 0; i < table_size; ++i) table.values.push_back(static_cast<float>(value(lambda_min_nm + i)));
  const Spectrum spectrum = table;
  return is_constant(spectrum) ? ConstantSpectrum{table.values.front()} : spectrum;
}

// a/b; b is an index of refraction, so above 0.
Spectrum ratio(const Spectrum& a, const Spectrum& b) {
  if (b == Spectrum{ConstantSpectrum{1}}) return resolved(a);
  const Spectrum above = resolved(a), below = resolved(b);
  return each_nm([&](double l) { return evaluate(above, l) / std::max(1e-6, evaluate(below, l)); });
}

// ((η−1)² + k²) / ((η+1)² + k²): Fresnel's reflectance of a metal at normal incidence. The denominator is ≥
// k²; 0 only where η = −1 and k = 0.
Spectrum normal_reflectance(const Spectrum& eta, const Spectrum& k) {
  return each_nm([&](double l) {
    const double n = evaluate(eta, l), kappa = evaluate(k, l);
    const double below = (n + 1) * (n + 1) + kappa * kappa;
    return below > 0 ? ((n - 1) * (n - 1) + kappa * kappa) / below : 1.0;
  });
}

bool is_one(const SpectrumParameter& p) { return p == SpectrumParameter{ConstantSpectrum{1}}; }
bool is_zero(const FloatParameter& p) { return p == FloatParameter{0.0f}; }
bool is_rough(const Roughness& r) { return !is_zero(r.alpha_u) || !is_zero(r.alpha_v); }

// A material and what it does not show.
struct Reduced {
  bundle::Material material;
  std::vector<std::string> notes;
};

// Of one material, after those that it refers to.
class Reducer {
 public:
  Reducer(const TextureMeans& means, const std::vector<Reduced>& before, const Material& material)
      : means_(means), before_(before), material_(material) {}

  Reduced reduce() {
    if (material_.displacement) note("its bump map is left out");
    if (material_.normal_map) note("its normal map is left out");
    bundle::Material reduced = std::visit(*this, material_.model);
    return {std::move(reduced), std::move(notes_)};
  }

  bundle::Material operator()(const DiffuseMaterial& m) {
    if (!is_zero(m.sigma_deg)) note("sigma (Oren-Nayar roughness) becomes 0, Lambertian");
    return diffuse(m.reflectance);
  }
  bundle::Material operator()(const DielectricMaterial& m) {
    if (is_rough(m.roughness)) note("the rough surface becomes a smooth one");
    if (!is_one(m.reflectance_factor) || !is_one(m.transmittance_factor))
      note("the factors of reflection and transmission become 1: Fresnel's equations alone");
    return bundle::DielectricMaterial{ratio(m.eta, m.exterior_eta)};
  }
  bundle::Material operator()(const ThinDielectricMaterial&) {
    note("light goes straight through, without the reflection of the thin sheet");
    return bundle::InterfaceMaterial{};
  }
  bundle::Material operator()(const ConductorMaterial& m) { return metal(m.metal, m.reflectance_factor); }
  bundle::Material operator()(const CoatedConductorMaterial& m) {
    return metal(m.metal, ConstantSpectrum{1});
  }
  bundle::Material operator()(const PlasticMaterial& m) { return coated(m.diffuse_reflectance); }
  bundle::Material operator()(const CoatedDiffuseMaterial& m) { return coated(m.reflectance); }
  bundle::Material operator()(const DiffuseTransmissionMaterial& m) {
    note("becomes diffuse with its reflectance; transmission is left out");
    return diffuse(m.reflectance, static_cast<double>(m.scale));
  }
  bundle::Material operator()(const PrincipledMaterial& m) {
    if (means_.of(m.spec_trans).value > 0.5) {
      note("is mostly transparent and becomes a smooth dielectric");
      return bundle::DielectricMaterial{ConstantSpectrum{m.eta}};
    }
    note("becomes diffuse with its base colour");
    return diffuse(m.base_color);
  }
  bundle::Material operator()(const SubsurfaceMaterial& m) {
    if (const auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior)) {
      note("becomes diffuse with the reflectance of its interior");
      return diffuse(effective->reflectance);
    }
    return grey("its interior");
  }
  bundle::Material operator()(const HairMaterial& m) {
    if (!m.color) return grey("its fibres");
    note("becomes diffuse with its colour");
    return diffuse(*m.color);
  }
  bundle::Material operator()(const MeasuredMaterial&) { return grey("its measurements"); }
  bundle::Material operator()(const InterfaceMaterial&) { return bundle::InterfaceMaterial{}; }
  bundle::Material operator()(const BlendMaterial& m) {
    const bool second = means_.of(m.amount).value > 0.5;
    note(fmt::format("the {} of two, the heavier one, stands for the blend", second ? "second" : "first"));
    return other(second ? m.second : m.first);
  }
  bundle::Material operator()(const MaskMaterial& m) {
    if (m.opacity == FloatParameter{1.0f}) return other(m.material);
    if (means_.of(m.opacity).value < 0.5) {
      note("is mostly transparent (opacity below 0.5) and becomes an interface that light passes unchanged");
      return bundle::InterfaceMaterial{};
    }
    note("becomes opaque");
    return other(m.material);
  }
  bundle::Material operator()(const TwoSidedMaterial& m) {
    if (m.front == m.back) return other(m.front);
    note("the front's material is on both sides");
    return other(m.front);
  }

 private:
  void note(std::string what) { notes_.push_back(std::move(what)); }

  Spectrum value(const SpectrumParameter& parameter) {
    const MeanSpectrum mean = means_.of(parameter);
    if (!mean.is_exact) note(fmt::format("a value of {:.2f} stands for its texture", luminance(mean.value)));
    return mean.value;
  }
  bundle::Material diffuse(const SpectrumParameter& reflectance, double factor = 1) {
    if (!material_.two_sided) note("its black back is as its front");
    return bundle::DiffuseMaterial{scaled(value(reflectance), factor)};
  }
  bundle::Material coated(const SpectrumParameter& reflectance) {
    note("becomes diffuse with its reflectance; the coating or gloss is left out");
    return diffuse(reflectance);
  }
  bundle::Material grey(const char* what) {
    note(fmt::format("becomes diffuse with a reflectance of 0.50; {} cannot be shown", what));
    return diffuse(ConstantSpectrum{0.5f});
  }
  bundle::Material metal(const Metal& metal, const SpectrumParameter& factor) {
    Spectrum reflectance = ConstantSpectrum{1};
    if (const auto* index = std::get_if<ComplexIndex>(&metal))
      reflectance = normal_reflectance(value(index->eta), value(index->k));
    else if (const auto* normal = std::get_if<NormalReflectance>(&metal))
      reflectance = value(normal->reflectance);
    reflectance = product(reflectance, value(factor));
    note(fmt::format("becomes diffuse with its reflectance at normal incidence, {:.2f} on average",
                     luminance(reflectance)));
    return diffuse(reflectance);
  }
  bundle::Material other(Id<Material> id) {
    const Reduced& reduced = before_.at(id.value);
    notes_.insert(notes_.end(), reduced.notes.begin(), reduced.notes.end());
    return reduced.material;
  }

  const TextureMeans& means_;
  const std::vector<Reduced>& before_;
  const Material& material_;
  std::vector<std::string> notes_;
};

constexpr std::array material_kinds{"diffuse",
                                    "dielectric",
                                    "thin dielectric",
                                    "conductor",
                                    "plastic",
                                    "coated diffuse",
                                    "coated conductor",
                                    "diffuse transmission",
                                    "principled",
                                    "subsurface",
                                    "hair",
                                    "measured",
                                    "interface",
                                    "blend",
                                    "mask",
                                    "two-sided"};
static_assert(material_kinds.size() == std::variant_size_v<MaterialModel>);

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

void for_each_shape(const Scene& scene, auto&& use) {
  for (const Shape& shape : scene.shapes) use(shape);
  for (const Prototype& prototype : scene.prototypes)
    for (const Shape& shape : prototype.shapes) use(shape);
}

void reduce_materials(const Scene& scene, const TextureMeans& means, const std::set<std::uint32_t>& used,
                      Appearance& result, Notes& report) {
  std::vector<Reduced> all;
  for (std::uint32_t id = 0; id < scene.materials.size(); ++id) {
    const Material& material = scene.materials[id];
    all.push_back(Reducer(means, all, material).reduce());
    result.materials.push_back(all.back().material);
    if (!used.contains(id)) continue;
    const std::string name = material.name.empty() ? "" : fmt::format(" \"{}\"", material.name);
    for (const std::string& note : all.back().notes)
      report.approximated(
          fmt::format("material{} ({}): {}", name, material_kinds[material.model.index()], note),
          material.origin);
  }
}

void reduce_area_lights(const Scene& scene, const TextureMeans& means, const std::set<std::uint32_t>& used,
                        Appearance& result, Notes& report) {
  for (std::uint32_t id = 0; id < scene.area_lights.size(); ++id) {
    const AreaLight& light = scene.area_lights[id];
    const MeanSpectrum radiance = means.of(light.radiance);
    const bool textured = std::holds_alternative<Id<Texture>>(light.radiance);
    result.area_lights.push_back({textured ? scaled(product(radiance.value, emission_from_rgb({1, 1, 1})),
                                                    static_cast<double>(light.scale))
                                           : radiance.value,
                                  light.two_sided});
    if (!used.contains(id)) continue;
    if (!radiance.is_exact) report.approximated("area light: one value stands for its texture", light.origin);
    if (light.directional)
      report.approximated("area light: shines in all directions, not along its normal alone", light.origin);
  }
}

// Cones and images only dim a point light in some directions: it shows with its greatest intensity.
struct LightReducer {
  const Origin& origin;
  Notes& report;
  using Result = bundle::Light;

  Result operator()(const PointLight& l) const {
    return bundle::PointLight{l.position, resolved(l.intensity)};
  }
  Result operator()(const DistantLight& l) const {
    return bundle::DistantLight{l.direction, resolved(l.irradiance)};
  }
  Result operator()(const InfiniteLight& l) const { return bundle::InfiniteLight{resolved(l.radiance)}; }
  Result operator()(const SpotLight& l) const {
    report.approximated("spot light: shines in all directions, like its middle", origin);
    return bundle::PointLight{transform_point(l.light_to_world, {0, 0, 0}), resolved(l.intensity)};
  }
  Result operator()(const ProjectionLight& l) const { return without_image(l.light_to_world, l.scale); }
  Result operator()(const GoniometricLight& l) const { return without_image(l.light_to_world, l.intensity); }
  Result operator()(const EnvironmentLight& l) const {
    report.approximated("environment light: the same light from everywhere stands for its image", origin);
    return bundle::InfiniteLight{product(resolved(l.scale), emission_from_rgb({1, 1, 1}))};
  }

 private:
  Result without_image(const Transform& to_world, const Spectrum& intensity) const {
    report.approximated("point light with an image: shines in all directions; its image is left out", origin);
    return bundle::PointLight{transform_point(to_world, {0, 0, 0}),
                              product(resolved(intensity), emission_from_rgb({1, 1, 1}))};
  }
};

}  // namespace

Appearance appearance_of(const Scene& scene) {
  Appearance result;
  Notes report(scene, result.diagnostics);
  const TextureMeans means(scene.textures);
  std::set<std::uint32_t> materials, lights, media;
  for_each_shape(scene, [&](const Shape& shape) {
    materials.insert(shape.material.value);
    if (shape.area_light) lights.insert(shape.area_light->value);
    for (const auto& medium : {shape.interior, shape.exterior})
      if (medium) media.insert(medium->value);
  });
  if (scene.camera_medium) media.insert(scene.camera_medium->value);
  reduce_materials(scene, means, materials, result, report);
  reduce_area_lights(scene, means, lights, result, report);
  for (const Light& light : scene.lights)
    result.lights.push_back(std::visit(LightReducer{light.origin, report}, light.model));
  for (const std::uint32_t id : media)
    report.dropped(fmt::format("medium \"{}\": light passes it unchanged", scene.media.at(id).name),
                   scene.media[id].origin);
  result.camera = scene.camera;
  return result;
}

}  // namespace vitrail
