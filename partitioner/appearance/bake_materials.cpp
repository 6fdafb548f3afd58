// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/bake_materials.h"

#include <fmt/format.h>

#include <cmath>

#include "partitioner/appearance/table_files.h"
#include "scene/models/hair_color.h"
#include "scene/models/subsurface_media.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {

namespace {

// Between equal indices light goes straight on, however rough the facets are.
bool is_no_interface(const DielectricMaterial& m) {
  return is_constant(m.eta) && is_constant(m.exterior_eta) &&
         std::abs(evaluate(m.eta, 550) / evaluate(m.exterior_eta, 550) - 1) < 1e-6;
}

class MaterialBaker {
 public:
  MaterialBaker(const std::vector<std::int32_t>& ids, TextureBaker& textures, TableBaker& tables,
                BakedMaterial& result)
      : ids_(ids), textures_(textures), tables_(tables), result_(result) {}

  MaterialModel operator()(DiffuseMaterial m) {
    reflectance(m.reflectance), number(m.sigma_deg);
    return m;
  }
  MaterialModel operator()(DielectricMaterial m) {
    m.eta = resolved(m.eta), m.exterior_eta = resolved(m.exterior_eta);
    if (is_no_interface(m)) m.roughness = {};
    roughness(m.roughness), factor(m.reflectance_factor), factor(m.transmittance_factor);
    return m;
  }
  MaterialModel operator()(ThinDielectricMaterial m) {
    m.eta = resolved(m.eta), m.exterior_eta = resolved(m.exterior_eta);
    factor(m.reflectance_factor), factor(m.transmittance_factor);
    return m;
  }
  MaterialModel operator()(ConductorMaterial m) {
    metal(m.metal), roughness(m.roughness), factor(m.reflectance_factor);
    return m;
  }
  MaterialModel operator()(PlasticMaterial m) {
    reflectance(m.diffuse_reflectance), factor(m.specular_reflectance), roughness(m.roughness);
    return m;
  }
  MaterialModel operator()(CoatedDiffuseMaterial m) {
    m.eta = resolved(m.eta);
    reflectance(m.reflectance), roughness(m.roughness), coating(m.volume);
    return m;
  }
  MaterialModel operator()(CoatedConductorMaterial m) {
    m.interface_eta = resolved(m.interface_eta);
    metal(m.metal), roughness(m.conductor_roughness), roughness(m.interface_roughness), coating(m.volume);
    return m;
  }
  MaterialModel operator()(DiffuseTransmissionMaterial m) {
    reflectance(m.reflectance), reflectance(m.transmittance);
    return m;
  }
  MaterialModel operator()(PrincipledMaterial m) {
    reflectance(m.base_color);
    for (FloatParameter* p :
         {&m.roughness, &m.anisotropic, &m.metallic, &m.spec_trans, &m.spec_tint, &m.sheen, &m.sheen_tint,
          &m.flatness, &m.clearcoat, &m.clearcoat_gloss, &m.diff_trans})
      number(*p);
    return m;
  }
  // A dielectric boundary around a medium; where that depends on the place, what is known of its colour.
  MaterialModel operator()(SubsurfaceMaterial m) {
    const auto render = [&](SpectrumParameter& p) {
      if (auto* spectrum = std::get_if<Spectrum>(&p)) *spectrum = textures_.as_rendered(*spectrum);
    };
    const auto render_mean = [&](SpectrumParameter& p, const char* name) {
      if (std::holds_alternative<Id<Texture>>(p))
        if (const auto mean = textures_.mean(p)) {
          note(fmt::format(
              "the texture of its {} becomes the mean of that, rgb {:.3g} {:.3g} {:.3g}, from which "
              "it is {:.2g} in the root mean square",
              name, mean->color.r, mean->color.g, mean->color.b, mean->deviation));
          p = unbounded_from_rgb(mean->color);
        }
      render(p);
    };
    if (auto* given = std::get_if<SubsurfaceMaterial::Coefficients>(&m.interior))
      render_mean(given->sigma_a, "absorption"), render_mean(given->sigma_s, "scattering");
    auto* effective = std::get_if<SubsurfaceMaterial::Effective>(&m.interior);
    if (effective) render(effective->reflectance), render_mean(effective->mean_free_path, "mean free path");
    std::optional<Medium> medium = interior_of(m);
    if (!medium && effective) {
      std::string how = "a texture of its interior: it becomes diffuse with the reflectance of that";
      if (const auto* path = std::get_if<Spectrum>(&effective->mean_free_path))
        how += fmt::format(", without the spread of light below it by a mean free path of {:.3g}",
                           static_cast<double>(m.scale) * evaluate(resolved(*path), 550));
      note(std::move(how));
      return (*this)(DiffuseMaterial{effective->reflectance});
    }
    if (!medium) return grey("its interior");
    if (auto* measured = std::get_if<AbsorptionScattering>(&medium->coefficients))
      for (VolumeParameter* v : {&measured->sigma_a, &measured->sigma_s})
        *v = textures_.as_rendered(std::get<Spectrum>(*v));
    result_.interior = std::move(medium);
    return (*this)(DielectricMaterial{m.eta, ConstantSpectrum{1}, m.roughness});
  }
  // Concentrations that do not depend on the place become the absorption that they lead to.
  MaterialModel operator()(HairMaterial m) {
    if (m.sigma_a) {
      m.sigma_a = textures_.bake(*m.sigma_a, TextureUse::unbounded);
      m.color.reset();
    } else if (m.color) {
      reflectance(*m.color);
    } else {
      for (auto* melanin : {&m.eumelanin, &m.pheomelanin}) *melanin = textures_.bake(melanin->value_or(0.0f));
      const auto* eumelanin = std::get_if<float>(&*m.eumelanin);
      const auto* pheomelanin = std::get_if<float>(&*m.pheomelanin);
      if (eumelanin && pheomelanin)
        m.sigma_a = textures_.as_rendered(
            melanin_absorption(static_cast<double>(*eumelanin), static_cast<double>(*pheomelanin)));
    }
    if (m.sigma_a || m.color) m.eumelanin.reset(), m.pheomelanin.reset();
    number(m.beta_m), number(m.beta_n), number(m.alpha_deg);
    return m;
  }
  MaterialModel operator()(const MeasuredMaterial& m) {
    if (m.sheet) return MeasuredMaterial{"", m.sheet};
    return grey("its measurements");
  }
  MaterialModel operator()(const TabulatedMaterial& m) {
    return TabulatedMaterial{m.format, "", tables_.bake(m)};
  }
  MaterialModel operator()(SlabMaterial m) {
    factor(m.sigma_a), factor(m.sigma_s);
    return m;
  }
  MaterialModel operator()(FinishMaterial m) {
    factor(m.reflectance), factor(m.highlight);
    return m;
  }
  MaterialModel operator()(GlazedMaterial m) {
    for (SpectrumParameter* p :
         {&m.finish.reflectance, &m.finish.highlight, &m.mirror_min, &m.mirror_max, &m.tint, &m.through})
      factor(*p);
    return m;
  }
  MaterialModel operator()(const InterfaceMaterial& m) { return m; }
  MaterialModel operator()(BlendMaterial m) {
    part(m.first), part(m.second), number(m.amount);
    return m;
  }
  MaterialModel operator()(MaskMaterial m) {
    part(m.material), number(m.opacity);
    return m;
  }
  MaterialModel operator()(TwoSidedMaterial m) {
    part(m.front), part(m.back);
    return m;
  }

 private:
  void note(std::string_view what) { result_.notes.emplace_back(what); }
  void reflectance(SpectrumParameter& p) { p = textures_.bake(p, TextureUse::reflectance); }
  // Above 1 where a blend makes a sum of lobes.
  void factor(SpectrumParameter& p) { p = textures_.bake(p, TextureUse::unbounded); }
  void number(FloatParameter& p) { p = textures_.bake(p); }
  void part(Id<Material>& id) { id.value = static_cast<std::uint32_t>(ids_.at(id.value)); }
  void roughness(Roughness& r) { number(r.alpha_u), number(r.alpha_v); }
  void coating(CoatingVolume& v) { number(v.thickness), number(v.g), reflectance(v.albedo); }
  void metal(Metal& metal) {
    if (auto* index = std::get_if<ComplexIndex>(&metal)) {
      index->eta = textures_.bake(index->eta, TextureUse::unbounded);
      index->k = textures_.bake(index->k, TextureUse::unbounded);
    } else if (auto* normal = std::get_if<NormalReflectance>(&metal)) {
      reflectance(normal->reflectance);
    }
  }
  MaterialModel grey(const char* what) {
    note(fmt::format("becomes diffuse with a reflectance of 0.50; {} cannot be shown", what));
    return DiffuseMaterial{};
  }

  const std::vector<std::int32_t>& ids_;
  TextureBaker& textures_;
  TableBaker& tables_;
  BakedMaterial& result_;
};

}  // namespace

Id<ScatteringTable> TableBaker::bake(const TabulatedMaterial& material) {
  const auto [known, is_new] =
      known_.try_emplace({material.format, material.filename}, static_cast<std::uint32_t>(tables_.size()));
  if (is_new && material.format == TabulatedMaterial::Format::fourier)
    tables_.push_back(read_fourier_table(material.filename));
  else if (is_new)
    tables_.push_back(read_adaptive_table(material.filename));
  return {known->second};
}

BakedMaterial bake_material(const Material& material, const std::vector<std::int32_t>& ids,
                            TextureBaker& textures, TableBaker& tables) {
  BakedMaterial result;
  result.material.name = material.name;
  result.material.two_sided = material.two_sided;
  result.material.bump_shadowing = material.bump_shadowing;
  result.material.casts_shadow = material.casts_shadow;
  result.material.model = std::visit(MaterialBaker(ids, textures, tables, result), material.model);
  if (material.displacement) {
    result.material.displacement = textures.bake(*material.displacement);
    if (textures.reads_attribute(*result.material.displacement))
      result.notes.push_back("its bumps leave out textures by face and attributes of meshes");
  }
  if (material.normal_map) result.material.normal_map = textures.bake_vector(*material.normal_map);
  return result;
}

}  // namespace vitrail
