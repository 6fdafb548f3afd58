// SPDX-License-Identifier: Apache-2.0
// Media stand between Camera and WorldBegin: the camera's has to be known when the world begins.
#include <array>

#include "importers/pbrt/writer.h"

namespace vitrail::pbrt {

namespace {

void grid(Parameters& p, std::string_view type_and_name, const Grid& g, bool sizes) {
  if (sizes) {
    p.integer("nx", g.nx).integer("ny", g.ny).integer("nz", g.nz);
    p.numbers("point3 p0", std::array{g.bounds.lower.x, g.bounds.lower.y, g.bounds.lower.z});
    p.numbers("point3 p1", std::array{g.bounds.upper.x, g.bounds.upper.y, g.bounds.upper.z});
  }
  p.numbers(type_and_name, g.values);
}

// A coefficient that has to be one value.
void coefficient(Parameters& p, std::string_view name, const VolumeParameter& value) {
  if (const auto* spectrum = std::get_if<Spectrum>(&value)) {
    p.spectrum(name, *spectrum);
    return;
  }
  p.approximated(fmt::format("the grid of its {} becomes 1", name));
  p.spectrum(name, Spectrum{ConstantSpectrum{1}});
}

void coefficients(Parameters& p, const Medium& m) {
  if (const auto* named = std::get_if<NamedMedium>(&m.coefficients)) {
    p.text("preset", named->name);
  } else if (const auto* both = std::get_if<AbsorptionScattering>(&m.coefficients)) {
    coefficient(p, "sigma_a", both->sigma_a);
    coefficient(p, "sigma_s", both->sigma_s);
  } else {  // σₛ = σₜ·albedo, σₐ = σₜ·(1 − albedo)
    const auto& e = std::get<ExtinctionAlbedo>(m.coefficients);
    const auto *t = std::get_if<Spectrum>(&e.sigma_t), *albedo = std::get_if<Spectrum>(&e.albedo);
    if (!t || !albedo) p.approximated("the grids of its extinction and albedo become 1");
    const Spectrum one = ConstantSpectrum{1}, sigma_t = t ? *t : one, a = albedo ? *albedo : one;
    p.approximated("extinction and albedo become absorption and scattering");
    p.spectrum("sigma_s", product(sigma_t, a))
        .spectrum("sigma_a", product(sigma_t, weighted_sum(one, 1, a, -1)));
  }
}

void emission(Parameters& p, const Medium& m) {
  if (m.emission) {
    const auto* color = std::get_if<RgbIlluminantSpectrum>(&*m.emission);
    if (color)
      p.numbers("rgb Le", color->rgb);
    else
      p.approximated("its emission is normalised to luminance 1, as pbrt does"),
          p.spectrum("Le", *m.emission);
  }
  if (m.emission_factor != 1) p.number("Lescale", m.emission_factor);
}

// The parameters of a medium; gives its type, or nothing where pbrt has no such medium.
const char* medium_type(Parameters& p, const Medium& m) {
  p.number("scale", m.scale).number("g", m.g);
  const auto* both = std::get_if<AbsorptionScattering>(&m.coefficients);
  const auto* sigma_a = both ? std::get_if<Grid>(&both->sigma_a) : nullptr;
  const auto* sigma_s = both ? std::get_if<Grid>(&both->sigma_s) : nullptr;
  if (sigma_a || sigma_s) {
    grid(p, "rgb sigma_a", sigma_a ? *sigma_a : *sigma_s, true);
    if (sigma_s) grid(p, "rgb sigma_s", *sigma_s, false);
    if (m.emission_scale) grid(p, "rgb Le", *m.emission_scale, false);
    if (m.emission_factor != 1) p.number("Lescale", m.emission_factor);
    return "rgbgrid";
  }
  coefficients(p, m);
  emission(p, m);
  if (const auto* cloud = std::get_if<CloudDensity>(&m.density)) {
    const Bounds3d& b = cloud->bounds;
    p.numbers("point3 p0", std::array{b.lower.x, b.lower.y, b.lower.z});
    p.numbers("point3 p1", std::array{b.upper.x, b.upper.y, b.upper.z});
    p.number("density", cloud->density)
        .number("wispiness", cloud->wispiness)
        .number("frequency", cloud->frequency);
    return "cloud";
  }
  const auto* density = std::get_if<Grid>(&m.density);
  if (!density) return "homogeneous";
  if (m.temperature_scale != 1) p.number("temperaturescale", m.temperature_scale);
  if (m.temperature_offset != 0) p.number("temperatureoffset", m.temperature_offset);
  if (density->values.empty()) {
    if (density->field.empty()) p.approximated("its file is read as NanoVDB");
    p.file("filename", density->filename);
    return "nanovdb";
  }
  grid(p, "float density", *density, true);
  if (m.temperature) grid(p, "float temperature", *m.temperature, false);
  if (m.emission_scale) grid(p, "float Lescale", *m.emission_scale, false);
  return "uniformgrid";
}

}  // namespace

void write_media(Writer& w) {
  for (std::size_t i = 0; i < w.scene.media.size(); ++i) {
    const Medium& medium = w.scene.media[i];
    Parameters p(w, fmt::format("medium \"{}\"", w.media[i]), medium.origin, RecordKind::medium);
    const char* type = medium_type(p, medium);
    w.transform(medium.medium_to_world);
    w.line(fmt::format("MakeNamedMedium {} \"string type\" \"{}\"{}", in_quotes(w.media[i]), type, p.list()));
    if (medium.medium_to_world != Transform{}) w.line("Identity");
  }
}

}  // namespace vitrail::pbrt
