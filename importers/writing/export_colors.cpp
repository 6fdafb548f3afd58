// SPDX-License-Identifier: Apache-2.0
#include "importers/writing/export_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/models/pattern.h"
#include "scene/models/texture_mapping.h"
#include "scene/shapes/deferred_mesh.h"

namespace vitrail {

namespace {

RGB rgb(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

RGB without_negatives(RGB c) { return {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)}; }

template <class Value>
TabulatedSpectrum sample(Value&& value) {
  TabulatedSpectrum table;
  table.values.resize(table_size);
  for (int i = 0; i < table_size; ++i)
    table.values[static_cast<std::size_t>(i)] = static_cast<float>(value(lambda_min_nm + i));
  return table;
}

RGB under_d65(const TabulatedSpectrum& factor) {
  TabulatedSpectrum light = factor;
  for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] *= cie_d65()[i];
  return without_negatives(xyz_to_srgb(to_xyz(light)));
}

// Fresnel's equations for unpolarised light from vacuum.
double fresnel(double cos_i, double eta) {
  const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
  if (sin2_t >= 1) return 1;
  const double cos_t = std::sqrt(1 - sin2_t);
  const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return (parallel * parallel + perpendicular * perpendicular) / 2;
}

}  // namespace

RGB signed_emission_rgb(const Spectrum& emission) {
  if (const auto* light = std::get_if<RgbIlluminantSpectrum>(&emission)) return rgb(light->rgb);
  return xyz_to_srgb(to_xyz(resolved(emission)));
}

RGB emission_rgb(const Spectrum& emission) { return without_negatives(signed_emission_rgb(emission)); }

RGB factor_rgb(const Spectrum& factor) {
  const Spectrum values = resolved(factor);
  if (const auto* c = std::get_if<ConstantSpectrum>(&values)) return {c->value, c->value, c->value};
  if (const auto* c = std::get_if<SigmoidSpectrum>(&values)) return rgb(c->rgb);
  if (const auto* c = std::get_if<RgbUnboundedSpectrum>(&values)) return rgb(c->rgb);
  if (const auto* c = std::get_if<RgbIlluminantSpectrum>(&values)) return rgb(c->rgb);
  return under_d65(sample([&](double lambda_nm) { return evaluate(values, lambda_nm); }));
}

bool is_rgb(const Spectrum& spectrum) {
  return std::holds_alternative<ConstantSpectrum>(spectrum) ||
         std::holds_alternative<SigmoidSpectrum>(spectrum) ||
         std::holds_alternative<RgbUnboundedSpectrum>(spectrum) ||
         std::holds_alternative<RgbIlluminantSpectrum>(spectrum);
}

double index_of_refraction(const Spectrum& eta) { return evaluate(resolved(eta), 587.6); }

double dispersion_ratio(const Spectrum& eta) {
  const Spectrum values = resolved(eta);
  const double red = evaluate(values, 700);
  return red > 0 ? evaluate(values, 400) / red : 1;
}

RGB normal_reflectance_rgb(const Metal& metal) {
  if (std::holds_alternative<PerfectReflector>(metal)) return {1, 1, 1};
  if (const auto* normal = std::get_if<NormalReflectance>(&metal)) {
    const auto* value = std::get_if<Spectrum>(&normal->reflectance);
    return value ? factor_rgb(*value) : RGB{0.5, 0.5, 0.5};
  }
  const auto& index = std::get<ComplexIndex>(metal);
  const auto* eta = std::get_if<Spectrum>(&index.eta);
  const auto* k = std::get_if<Spectrum>(&index.k);
  if (!eta || !k) return {0.5, 0.5, 0.5};
  const Spectrum etas = resolved(*eta), ks = resolved(*k);
  return under_d65(sample([&](double lambda_nm) {
    const double n = evaluate(etas, lambda_nm), kappa = evaluate(ks, lambda_nm);
    const double above = (n + 1) * (n + 1) + kappa * kappa;
    return above > 0 ? ((n - 1) * (n - 1) + kappa * kappa) / above : 1.0;
  }));
}

RGB mean_of_noise(const NoiseTexture& noise) {
  constexpr double octave = 0.218;  // of |noise|
  if (noise.kind == NoiseTexture::Kind::marble) return {0.805, 0.803, 0.840};
  if (noise.kind != NoiseTexture::Kind::wrinkled) return {0, 0, 0};
  double sum = 0, weight = 1;
  for (int i = 0; i < noise.octaves; ++i, weight *= static_cast<double>(noise.roughness)) sum += weight;
  return {octave * sum, octave * sum, octave * sum};
}

RGB mean_of_pattern(const PatternTexture& t) {
  constexpr int points = 4096;
  constexpr double side = 16;
  // The additive sequence of the number g, g⁴ = g + 1 (Roberts 2018).
  constexpr double g = 1.2207440846057596;
  constexpr std::array steps{1 / g, 1 / (g * g), 1 / (g * g * g)};
  const auto color = [&](std::size_t place) {
    const auto* spectrum = std::get_if<Spectrum>(&t.map[place].value);
    return spectrum ? factor_rgb(*spectrum) : RGB{0.5, 0.5, 0.5};
  };
  RGB sum;
  const auto add = [&](const RGB& c, double weight) {
    sum = {sum.r + c.r * weight, sum.g + c.g * weight, sum.b + c.b * weight};
  };
  for (int i = 0; i < points; ++i) {
    const auto coordinate = [&](std::size_t axis) {
      const double x = 0.5 + i * steps[axis];
      return side * (x - std::floor(x) - 0.5);
    };
    Point3d p{coordinate(0), coordinate(1), coordinate(2)};
    if (t.by_uv) p = transform_point(inverse(t.texture_to_world), {p.x / side + 0.5, p.y / side + 0.5, 0});
    if (t.map.empty()) {
      const double value = pattern_value(t, p);
      add({value, value, value}, 1.0 / points);
      continue;
    }
    const PatternMix mix = pattern_mix(t, p);
    add(color(mix.first), (1 - mix.amount) / points);
    add(color(mix.second), mix.amount / points);
  }
  return sum;
}

std::optional<CheckerboardTexture> as_checkerboard(const PatternTexture& t) {
  if (t.kind != PatternTexture::Kind::checker || t.map.size() != 2) return std::nullopt;
  if (t.turbulence.amount != Vector3d{} || t.repeat != Vector3d{}) return std::nullopt;
  CheckerboardTexture board;
  board.even = t.map[0].value, board.odd = t.map[1].value;
  board.solid = !t.by_uv;
  if (t.by_uv)
    board.mapping = uv_mapping(t.texture_to_world);
  else
    board.texture_to_world = t.texture_to_world;
  return board;
}

std::optional<RGB> mean_of_attribute(const Scene& scene, const MeshAttributeTexture& texture) {
  RGB sum;
  double count = 0;
  for (const TriangleMesh& stored : scene.meshes) {
    TriangleMesh storage;
    for (const MeshAttribute& a : loaded(stored, storage).attributes) {
      if (a.name != texture.name) continue;
      const std::size_t step = a.channels == 3 ? 3 : 1;
      const auto value = [&](std::size_t i) { return static_cast<double>(a.values[i]); };
      for (std::size_t i = 0; i + step <= a.values.size(); i += step, ++count)
        sum = {sum.r + value(i), sum.g + value(i + step / 2), sum.b + value(i + step - 1)};
    }
  }
  if (count == 0) return std::nullopt;
  const double factor = static_cast<double>(texture.scale) / count;
  return RGB{sum.r * factor, sum.g * factor, sum.b * factor};
}

SheetColors colors_at_normal(const MeasuredSheet& sheet) {
  const std::size_t cosines = sheet.cosines.size();
  const auto at_normal = [&](const std::vector<float>& values) {
    std::vector<SpectrumSample> samples;
    for (std::size_t i = 0; i < sheet.wavelengths_nm.size(); ++i)
      samples.push_back({static_cast<double>(sheet.wavelengths_nm[i]),
                         static_cast<double>(values[(i + 1) * cosines - 1])});  // cosines ascend
    return factor_rgb(tabulate(samples, true));
  };
  return {at_normal(sheet.reflectance), at_normal(sheet.transmittance)};
}

TabulatedSpectrum as_seen_at_whole_nm(const TabulatedSpectrum& table) {
  if (table.samples.empty()) return table;
  const auto first_not_below = [](double nm) { return [nm](const SpectrumSample& s) { return s[0] < nm; }; };
  // Of two neighbours together, which share what lies between them: an end between them is none too many.
  double off = 0, all = 0, before = 0;
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const double nm = lambda_min_nm + static_cast<double>(i), mean = static_cast<double>(table.values[i]);
    const auto next = std::ranges::partition_point(table.samples, first_not_below(nm));
    double there = 0;
    if (next != table.samples.end() && (*next)[0] == nm)
      there = (*next)[1];
    else if (next != table.samples.end() && next != table.samples.begin()) {
      const auto& [from, a] = *(next - 1);
      const auto& [to, b] = *next;
      there = a + (b - a) * (nm - from) / (to - from);
    }
    const double here = there * table.sample_factor - mean;
    off += std::abs(before + here) / 2;
    before = here;
    all += std::abs(mean);
  }
  TabulatedSpectrum seen = table;
  off += std::abs(before) / 2;
  if (off > 1e-3 * all) seen.samples.clear();
  return seen;
}

std::string digits_of(const TabulatedSpectrum& table, double sample) {
  return table.samples.empty() ? fmt::format("{}", static_cast<float>(sample)) : fmt::format("{}", sample);
}

double diffuse_fresnel_outside(double eta) {
  if (!(eta > 0)) return 0;
  constexpr int steps = 1000;  // midpoint rule in μ = cos θ of 2∫F μ dμ
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double mu = (i + 0.5) / steps;
    sum += 2 * fresnel(mu, eta) * mu / steps;
  }
  return sum;
}

double diffuse_fresnel_inside(double eta) {
  return eta > 0 ? 1 - (1 - diffuse_fresnel_outside(eta)) / (eta * eta) : 0;
}

}  // namespace vitrail
