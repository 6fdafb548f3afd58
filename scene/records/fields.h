// SPDX-License-Identifier: Apache-2.0
// It lists the fields of records once for all code that goes through them: to search textures and (u,v), to
// write bundles and read them, to check fields, or to count what they need. `visit_fields(record, f)` calls f
// once with all fields, in the order that bundles have. Names and origins are not among them.
#pragma once

#include <concepts>
#include <type_traits>

#include "scene/records/light.h"
#include "scene/records/material.h"
#include "scene/records/texture.h"

namespace vitrail {

// It is T, or const T.
template <class A, class T>
concept Is = std::same_as<std::remove_const_t<A>, T>;
template <class A, class... T>
concept IsOneOf = (Is<A, T> || ...);

// ---- Textures

auto visit_fields(Is<UvMapping> auto& m, auto&& f) { return f(m.a, m.b, m.c, m.d, m.e, m.f); }
auto visit_fields(IsOneOf<SphericalMapping, GlobeMapping> auto& m, auto&& f) { return f(m.texture_to_world); }
auto visit_fields(Is<CylindricalMapping> auto& m, auto&& f) { return f(m.texture_to_world, m.of_direction); }
auto visit_fields(Is<PlanarMapping> auto& m, auto&& f) {
  return f(m.texture_to_world, m.v1, m.v2, m.offset_s, m.offset_t);
}
auto visit_fields(Is<AttributeMapping> auto& m, auto&& f) { return f(m.slot); }

auto visit_fields(Is<ImageTexture> auto& t, auto&& f) {
  return f(t.filename, t.mapping, t.wrap, t.filter, t.encoding, t.gamma, t.scale, t.invert, t.number,
           t.primaries);
}
auto visit_fields(Is<CheckerboardTexture> auto& t, auto&& f) {
  return f(t.even, t.odd, t.mapping, t.solid, t.texture_to_world);
}
auto visit_fields(Is<ProductTexture> auto& t, auto&& f) { return f(t.first, t.second); }
auto visit_fields(Is<MixTexture> auto& t, auto&& f) { return f(t.first, t.second, t.amount); }
auto visit_fields(Is<DirectionMixTexture> auto& t, auto&& f) { return f(t.first, t.second, t.direction); }
auto visit_fields(Is<BilinearTexture> auto& t, auto&& f) { return f(t.v00, t.v01, t.v10, t.v11, t.mapping); }
auto visit_fields(Is<DotsTexture> auto& t, auto&& f) { return f(t.inside, t.outside, t.mapping); }
auto visit_fields(Is<NoiseTexture> auto& t, auto&& f) {
  return f(t.kind, t.texture_to_world, t.octaves, t.roughness, t.scale, t.variation);
}
auto visit_fields(Is<PtexTexture> auto& t, auto&& f) { return f(t.filename, t.encoding, t.gamma, t.scale); }
auto visit_fields(Is<MeshAttributeTexture> auto& t, auto&& f) { return f(t.name, t.scale); }
auto visit_fields(Is<UvTexture> auto& t, auto&& f) { return f(t.mapping); }
auto visit_fields(Is<PatternTurbulence> auto& t, auto&& f) {
  return f(t.amount, t.octaves, t.lambda, t.omega);
}
auto visit_fields(Is<PatternBrick> auto& b, auto&& f) { return f(b.size, b.mortar); }
auto visit_fields(Is<PatternCrackle> auto& c, auto&& f) { return f(c.form, c.metric, c.offset, c.solid); }
auto visit_fields(Is<PatternStop> auto& s, auto&& f) { return f(s.at, s.value); }
auto visit_fields(Is<PatternStep> auto& s, auto&& f) { return f(s.op, s.index, s.value); }
auto visit_fields(Is<PatternFractal> auto& p, auto&& f) {
  return f(p.kind, p.is_julia, p.seed, p.exponent, p.iterations, p.outside, p.inside, p.outside_factor,
           p.inside_factor);
}
// It leaves out what belongs to a formula, which refers to no other records, and `by_uv`.
auto visit_fields(Is<PatternTexture> auto& t, auto&& f) {
  return f(t.kind, t.texture_to_world, t.repeat, t.turbulence, t.noise, t.frequency, t.phase, t.wave,
           t.exponent, t.direction, t.brick, t.crackle, t.arms, t.agate_turb, t.iterations, t.map);
}

// ---- Materials

auto visit_fields(Is<Roughness> auto& r, auto&& f) {
  return f(r.alpha_u, r.alpha_v, r.distribution, r.square_root, r.masking);
}
auto visit_fields(Is<ComplexIndex> auto& m, auto&& f) { return f(m.eta, m.k); }
auto visit_fields(Is<NormalReflectance> auto& m, auto&& f) { return f(m.reflectance); }
auto visit_fields(Is<PerfectReflector> auto&, auto&& f) { return f(); }
auto visit_fields(Is<CoatingVolume> auto& v, auto&& f) {
  return f(v.thickness, v.g, v.albedo, v.max_depth, v.samples);
}

auto visit_fields(Is<DiffuseMaterial> auto& m, auto&& f) { return f(m.reflectance, m.sigma_deg); }
auto visit_fields(Is<DielectricMaterial> auto& m, auto&& f) {
  return f(m.eta, m.exterior_eta, m.roughness, m.reflectance_factor, m.transmittance_factor, m.priority);
}
auto visit_fields(Is<ThinDielectricMaterial> auto& m, auto&& f) {
  return f(m.eta, m.exterior_eta, m.reflectance_factor, m.transmittance_factor);
}
auto visit_fields(Is<ConductorMaterial> auto& m, auto&& f) {
  return f(m.metal, m.roughness, m.reflectance_factor);
}
auto visit_fields(Is<PlasticMaterial> auto& m, auto&& f) {
  return f(m.diffuse_reflectance, m.specular_reflectance, m.eta, m.exterior_eta, m.roughness, m.nonlinear);
}
auto visit_fields(Is<CoatedDiffuseMaterial> auto& m, auto&& f) {
  return f(m.reflectance, m.eta, m.roughness, m.volume);
}
auto visit_fields(Is<CoatedConductorMaterial> auto& m, auto&& f) {
  return f(m.metal, m.conductor_roughness, m.interface_eta, m.interface_roughness, m.volume);
}
auto visit_fields(Is<DiffuseTransmissionMaterial> auto& m, auto&& f) {
  return f(m.reflectance, m.transmittance, m.scale);
}
auto visit_fields(Is<PrincipledMaterial> auto& m, auto&& f) {
  return f(m.base_color, m.roughness, m.anisotropic, m.metallic, m.spec_trans, m.spec_tint, m.sheen,
           m.sheen_tint, m.flatness, m.clearcoat, m.clearcoat_gloss, m.diff_trans, m.eta, m.thin, m.below);
}
auto visit_fields(Is<SubsurfaceMaterial::Coefficients> auto& c, auto&& f) { return f(c.sigma_a, c.sigma_s); }
auto visit_fields(Is<SubsurfaceMaterial::Effective> auto& e, auto&& f) {
  return f(e.reflectance, e.mean_free_path);
}
auto visit_fields(Is<SubsurfaceMaterial::Named> auto& n, auto&& f) { return f(n.name); }
auto visit_fields(Is<SubsurfaceMaterial> auto& m, auto&& f) {
  return f(m.interior, m.scale, m.g, m.eta, m.roughness);
}
auto visit_fields(Is<HairMaterial> auto& m, auto&& f) {
  return f(m.sigma_a, m.color, m.eumelanin, m.pheomelanin, m.eta, m.exterior_eta, m.beta_m, m.beta_n,
           m.alpha_deg, m.along_v);
}
auto visit_fields(Is<MeasuredMaterial> auto& m, auto&& f) { return f(m.filename, m.sheet); }
auto visit_fields(Is<InterfaceMaterial> auto&, auto&& f) { return f(); }
auto visit_fields(Is<BlendMaterial> auto& m, auto&& f) { return f(m.first, m.second, m.amount); }
auto visit_fields(Is<MaskMaterial> auto& m, auto&& f) { return f(m.opacity, m.material); }
auto visit_fields(Is<TwoSidedMaterial> auto& m, auto&& f) { return f(m.front, m.back); }
auto visit_fields(Is<TabulatedMaterial> auto& m, auto&& f) { return f(m.format, m.filename, m.table); }
auto visit_fields(Is<SlabMaterial> auto& m, auto&& f) { return f(m.sigma_a, m.sigma_s, m.thickness, m.g); }
auto visit_fields(Is<FinishMaterial> auto& m, auto&& f) {
  return f(m.reflectance, m.highlight, m.brilliance, m.phong, m.phong_size, m.specular, m.roughness);
}
auto visit_fields(Is<GlazedMaterial> auto& m, auto&& f) {
  return f(m.finish, m.mirror_min, m.mirror_max, m.tint, m.falloff, m.metallic, m.fresnel, m.conserves_energy,
           m.through, m.eta);
}
auto visit_fields(Is<Material> auto& m, auto&& f) {
  return f(m.model, m.two_sided, m.displacement, m.normal_map, m.bump_shadowing);
}

// ---- Lights

auto visit_fields(Is<AreaLight> auto& l, auto&& f) {
  return f(l.radiance, l.scale, l.two_sided, l.directional, l.sampled);
}
auto visit_fields(Is<Fading> auto& l, auto&& f) { return f(l.fade_distance, l.fade_power); }
auto visit_fields(Is<PointLight> auto& l, auto&& f) { return f(l.position, l.intensity, l.fading); }
auto visit_fields(Is<SpotLight> auto& l, auto&& f) {
  return f(*l.light_to_world, l.intensity, l.beam_deg, l.cutoff_deg, l.falloff, l.texture, l.fading,
           l.tightness);
}
auto visit_fields(Is<ProjectionLight> auto& l, auto&& f) {
  return f(*l.light_to_world, *l.image, l.scale, l.fov_deg, l.irradiance, l.power);
}
auto visit_fields(Is<GoniometricLight> auto& l, auto&& f) {
  return f(*l.light_to_world, *l.intensity, l.filename, l.latitude_longitude, l.power, l.encoding, l.number);
}
auto visit_fields(Is<DistantLight> auto& l, auto&& f) { return f(l.direction, l.irradiance); }
auto visit_fields(Is<InfiniteLight> auto& l, auto&& f) { return f(l.radiance); }
auto visit_fields(Is<EnvironmentLight> auto& l, auto&& f) {
  return f(l.filename, *l.light_to_world, l.projection, *l.scale, l.illuminance, *l.portal, l.encoding,
           l.primaries);
}
auto visit_fields(Is<SkyDistribution> auto& s, auto&& f) {
  return f(s.a, s.b, s.base, s.c, s.d, s.e, s.diffuse_lx);
}
auto visit_fields(Is<SkyLight> auto& l, auto&& f) {
  return f(*l.light_to_world, l.to_sun, l.turbidity, *l.albedo, l.sky_scale, l.sun_scale, l.sun_diameter_deg,
           l.limb_darkening, *l.distribution, l.color_temperature_k, l.ground);
}

// It is a record whose fields are listed here.
template <class T>
concept HasFields = requires(T& record) {
  visit_fields(record, [](auto&...) {});
};

}  // namespace vitrail
