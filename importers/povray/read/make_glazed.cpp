// SPDX-License-Identifier: Apache-2.0
// Surfaces of POV-Ray that mirror by angle, or are clear and shine: their mirror and highlights are the same
// however much light goes through.
#include <algorithm>

#include "importers/povray/read/reader.h"
#include "importers/povray/read/surfaces.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail::pov {

void set_highlights(FinishMaterial& m, const Finish& finish, double share) {
  m.phong = static_cast<float>(std::max(finish.phong, 0.0) / share);
  m.phong_size = static_cast<float>(std::max(finish.phong_size, 0.0));
  m.specular = static_cast<float>(std::max(finish.specular, 0.0) / share);
  m.roughness = static_cast<float>(std::max(finish.roughness, 1e-6));
}

// As at normal incidence; at grazing angles POV-Ray's become white.
SpectrumParameter Surfaces::highlight_color(const Pigment& pigment, const Finish& finish,
                                            const Transform& to_world, const Look& look) {
  const SpectrumParameter white = Spectrum{ConstantSpectrum{1}};
  if (!(finish.metallic > 0)) return tinted(white, look, finish.place);
  approximated("metallic highlights: of one colour at every angle", finish.place);
  const SpectrumParameter color = color_texture(pigment, to_world, Part::reflectance, 1, look.by_uv);
  if (finish.metallic >= 1) return tinted(color, look, finish.place);
  return tinted(add(MixTexture{white, color, static_cast<float>(finish.metallic)}, false, pigment.place),
                look, finish.place);
}

bool Surfaces::is_glazed(const Finish& finish, const Interior* interior, float opacity) const {
  if (!glazes_) return false;
  if (opacity < 1 && interior && interior->ior > 1.0001) return true;
  if (finish.diffuse_back > 0 || finish.crand > 0) return false;
  const auto is_any = [](const Numbers& n) { return std::max({n.v[0], n.v[1], n.v[2]}) > 0; };
  const auto differs = [&](std::size_t i) {
    return finish.reflection_min.v[i] != finish.reflection_max.v[i];
  };
  const bool mirrors = is_any(finish.reflection_min) || is_any(finish.reflection_max);
  if (opacity >= 1) return mirrors && (finish.fresnel || differs(0) || differs(1) || differs(2));
  return mirrors || finish.phong > 0 || finish.specular > 0;
}

Id<Material> Surfaces::glazed(const Body& body) {
  const Finish& finish = body.finish;
  const auto factors = [&](const Numbers& n) -> SpectrumParameter {
    return Spectrum{
        unbounded_from_rgb({reader_.linear(n.v[0]), reader_.linear(n.v[1]), reader_.linear(n.v[2])})};
  };
  GlazedMaterial m;
  const double solid = static_cast<double>(body.solid.value_or(1.0f));
  m.finish.reflectance = tinted(color_texture(body.pigment, body.to_world, Part::factor,
                                              reader_.linear(finish.diffuse) * solid, body.look.by_uv),
                                body.look, body.place);
  m.finish.highlight = highlight_color(body.pigment, finish, body.to_world, body.look);
  m.finish.brilliance = static_cast<float>(std::max(finish.brilliance, 0.0));
  set_highlights(m.finish, finish, 1);
  m.mirror_min = factors(finish.reflection_min);
  m.mirror_max = factors(finish.reflection_max);
  m.metallic = static_cast<float>(std::clamp(finish.reflection_metallic, 0.0, 1.0));
  if (m.metallic > 0) m.tint = color_texture(body.pigment, body.to_world, Part::factor, 1, body.look.by_uv);
  m.falloff = static_cast<float>(std::max(finish.reflection_falloff, 0.0));
  m.fresnel = finish.fresnel;
  m.conserves_energy = finish.conserve_energy;
  if (body.look.interior && body.look.interior->ior > 0) m.eta = static_cast<float>(body.look.interior->ior);
  if (solid < 1) {
    const Numbers color = body.pigment.color.value_or(mean_color(body.pigment));
    const double filter = std::max(color.v[3], 0.0), transmit = std::max(color.v[4], 0.0);
    const auto part = [&](std::size_t i) { return reader_.linear(color.v[i]) * filter + transmit; };
    m.through = tinted(Spectrum{unbounded_from_rgb({part(0), part(1), part(2)})}, body.look, body.place);
  }
  if (finish.diffuse_back > 0) dropped("diffuse behind glass", finish.place);
  if (finish.crand > 0) dropped("crand of glass", finish.place);
  if (finish.irid > 0) dropped("irid", finish.place);
  if (finish.subsurface) dropped("subsurface", finish.place);
  return add(std::move(m), body.pigment.place);
}

}  // namespace vitrail::pov
